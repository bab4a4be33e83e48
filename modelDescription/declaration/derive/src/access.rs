//! The type of a row, from that of its field.

use crate::attribute::{Row, constant};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{Error, Expr, Ident, RangeLimits, Result, Type};

/// The keys that not every type has, and which have them.
const KEYS_OF_TYPES: [(&str, &str); 9] = [
    ("unit", "f64 and f32"),
    ("range", "f64 and f32; an integer has integers = low..=high"),
    ("nan", "f64 and f32"),
    ("integers", "integers; f64 and f32 have range = low..=high"),
    ("items", "i32"),
    ("typed", "an i32 with items"),
    ("boolean", "i32"),
    ("max_size", "Vec<u8>"),
    ("mime_type", "Vec<u8>"),
];

/// Everything after `Access::` in the row of the `field`, which is `of` a type whose elements are of the type `element`; and
/// whether it is a Real.
pub fn access(
    field: &Ident,
    of: &Type,
    element: &Type,
    attribute: &Row,
    root: &TokenStream,
) -> Result<(TokenStream, bool)> {
    let kind = match element {
        Type::Path(path) => path.path.segments.last().map(|s| s.ident.to_string()),
        _ => None,
    };
    let Some(kind) = kind else {
        return Err(Error::new_spanned(
            of,
            "expected a number, a Boolean, a String or a Vec<u8>",
        ));
    };
    // With the field's type, so that the compiler points at it where it is none of the interface.
    let place =
        quote!(::<Self, #of>(::core::mem::offset_of!(Self, #field), |whole: &Self| &whole.#field));
    let plain = quote!(#root::place::of_field #place);
    let word = quote!(#root::place::of_word #place);
    let (access, keys): (_, &[&str]) = match kind.as_str() {
        "i32" if attribute.has("boolean") => (quote!(Boolean { at: #word }), &["boolean"]),
        "i32" if attribute.has("items") => {
            let items = attribute.key("items");
            let declared = if attribute.has("typed") {
                quote!(Enumeration)
            } else {
                quote!(Integer)
            };
            let access = quote!(Enumeration {
                of: &#items, declared: #root::Declared::#declared, at: #plain
            });
            (access, &["items", "typed"])
        }
        "i8" | "u8" | "i16" | "u16" | "i32" => {
            let bounds = integers(attribute, &kind, &|bound| quote!(#bound as i32))?;
            (quote!(Integer { #bounds, at: #plain }), &["integers"])
        }
        "u32" | "i64" | "u64" => {
            let bounds = integers(
                attribute,
                &kind,
                &|bound| quote!(#root::integer::Bound::new(#bound as i128)),
            )?;
            (quote!(Wide { #bounds, at: #plain }), &["integers"])
        }
        "bool" => (quote!(Boolean { at: #plain }), &[]),
        "String" => (quote!(String { at: #plain }), &[]),
        "Vec" => {
            let mime_type = attribute
                .key("mime_type")
                .map_or(quote!(#root::variable::ANY_BYTES), |told| quote!(#told));
            let max_size = attribute.key("max_size").map_or(
                quote!(::core::option::Option::None),
                |most| quote!(::core::option::Option::Some(#most)),
            );
            let access = quote!(Binary { mime_type: #mime_type, max_size: #max_size, at: #plain });
            (access, &["max_size", "mime_type"])
        }
        _ => {
            let access = real(attribute, &plain, root)?;
            (access, &["unit", "range", "nan"])
        }
    };
    check_keys(attribute, keys)?;
    Ok((access, keys.contains(&"unit")))
}

/// No key that this row has not.
fn check_keys(attribute: &Row, keys: &[&str]) -> Result<()> {
    for (key, of) in KEYS_OF_TYPES {
        if let Some(key) = attribute.span(key).filter(|_| !keys.contains(&key)) {
            return Err(Error::new(key.span(), format!("{key} is for {of}")));
        }
    }
    Ok(())
}

/// Bounds of an integer of the type `kind`, each as the row has it, by `shown`.
fn integers(
    attribute: &Row,
    kind: &str,
    shown: &dyn Fn(TokenStream) -> TokenStream,
) -> Result<TokenStream> {
    let kind = format_ident!("{kind}");
    let (least, most) = (quote!(#kind::MIN), quote!(#kind::MAX));
    let (low, high) = match attribute.key("integers") {
        Some(range) => bounds(range, &least, &most)?,
        None => (least, most),
    };
    // As the field's type first: a bound beyond it does not compile.
    let bound = |of: TokenStream| {
        let shown = shown(quote!(bound));
        quote!({ let bound: #kind = #of; #shown })
    };
    let (low, high) = (bound(low), bound(high));
    Ok(quote!(min: #low, max: #high))
}

fn real(attribute: &Row, at: &TokenStream, root: &TokenStream) -> Result<TokenStream> {
    let unit = attribute
        .key("unit")
        .map_or(quote!(#root::unit::NONE), |unit| {
            constant(unit, "unit", root)
        });
    let range = match attribute.key("range") {
        None => quote!(#root::range::FINITE),
        Some(range @ Expr::Range(_)) => {
            let (low, high) = bounds(range, &quote!(f64::NEG_INFINITY), &quote!(f64::INFINITY))?;
            let words = match (low.to_string(), high.to_string()) {
                (low, high) if high.contains("INFINITY") => {
                    format!("a finite value, at least {low}")
                }
                (low, high) => format!("{} to {}", joined(&low), joined(&high)),
            };
            quote!(#root::Range::new(#low, #high, #words))
        }
        Some(range) => constant(range, "range", root),
    };
    Ok(quote!(Real { unit: #unit, range: #range, at: #at }))
}

/// Tokens of a number without the spaces between sign and digits.
fn joined(number: &str) -> String {
    number.replace("- ", "-")
}

/// Low and high of `a..=b`, `a..`, `..=b`.
fn bounds(
    range: &Expr,
    least: &TokenStream,
    most: &TokenStream,
) -> Result<(TokenStream, TokenStream)> {
    let Expr::Range(bounds) = range else {
        return Err(Error::new_spanned(range, "expected low..=high"));
    };
    if matches!(bounds.limits, RangeLimits::HalfOpen(_)) && bounds.end.is_some() {
        return Err(Error::new_spanned(
            range,
            "the upper bound is included: low..=high",
        ));
    }
    let low = bounds
        .start
        .as_ref()
        .map_or(least.clone(), |low| quote!(#low));
    let high = bounds
        .end
        .as_ref()
        .map_or(most.clone(), |high| quote!(#high));
    Ok((low, high))
}

#[cfg(test)]
mod tests {
    use syn::{DeriveInput, parse_quote};

    #[test]
    fn a_key_that_the_type_has_not_is_refused_and_says_which_types_have_it() {
        let refused = |item: DeriveInput| {
            let refusal = crate::rows::derive(&item, &quote::quote!(::fmu_declaration));
            refusal.expect_err("it is refused").to_string()
        };
        let integer = parse_quote!(
            struct S {
                #[input(unit = METRE)]
                x: u8,
            }
        );
        assert_eq!(refused(integer), "unit is for f64 and f32");
        let range = parse_quote!(
            struct S {
                #[input(range = 0..=5)]
                x: i64,
            }
        );
        assert!(refused(range).ends_with("an integer has integers = low..=high"));
        let real = parse_quote!(
            struct S {
                #[input(integers = 0..=5)]
                x: f32,
            }
        );
        assert!(refused(real).starts_with("integers is for integers"));
        let items = parse_quote!(
            struct S {
                #[input(items = MODE)]
                x: u32,
            }
        );
        assert_eq!(refused(items), "items is for i32");
        let size = parse_quote!(
            struct S {
                #[input(max_size = 8)]
                x: String,
            }
        );
        assert_eq!(refused(size), "max_size is for Vec<u8>");
    }
}
