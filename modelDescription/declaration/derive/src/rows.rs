//! `impl Rows`.

use crate::attribute::{Part, Role, Row, constant, is_discrete};
use proc_macro2::TokenStream;
use quote::quote;
use syn::{Data, DeriveInput, Error, Expr, Field, Fields, Ident, RangeLimits, Result, Type};

/// The fields of a struct with named fields.
pub fn fields(item: &DeriveInput) -> Result<impl Iterator<Item = (&Ident, &Field)>> {
    match &item.data {
        Data::Struct(data) if matches!(data.fields, Fields::Named(_)) => Ok(data
            .fields
            .iter()
            .filter_map(|field| field.ident.as_ref().map(|name| (name, field)))),
        _ => Err(Error::new_spanned(
            &item.ident,
            "rows are the named fields of a struct",
        )),
    }
}

/// `root` is the path of the package `fmu-declaration`, as the struct's crate sees it.
pub fn derive(item: &DeriveInput, root: &TokenStream) -> Result<TokenStream> {
    let name = &item.ident;
    let discrete = is_discrete(&item.attrs)?;
    let order = if are_numbered(item)? {
        quote!(sorted)
    } else {
        quote!(in_order)
    };
    let (mut counts, mut writes) = (Vec::new(), Vec::new());
    for (field, declared) in fields(item)? {
        match Role::of(declared)? {
            Role::Row(attribute) => {
                let row = row(field, &declared.ty, &attribute, discrete, root)?;
                counts.push(quote!(1));
                writes.push(quote! { rows[n] = #row; n += 1; });
            }
            Role::Part(part) => {
                let Part {
                    each,
                    from,
                    prefix,
                    about,
                } = *part;
                let (of, each) = match (&declared.ty, each) {
                    (Type::Array(array), true) => {
                        let len = &array.len;
                        (array.elem.as_ref(), quote!(#len))
                    }
                    (of, false) => (of, quote!(1)),
                    (of, true) => return Err(Error::new_spanned(of, "each is for an array")),
                };
                let from = from.map_or(quote!(0), |from| quote!(#from));
                let prefix = prefix.map_or(quote!(""), |prefix| quote!(#prefix));
                let about = match about {
                    None => quote!(&[]),
                    Some(list @ Expr::Array(_)) => quote!(&#list),
                    Some(name) => quote!(#name),
                };
                counts.push(quote!(<#of as #root::compose::Rows>::ROWS.len()));
                writes.push(quote! {
                    n = #root::compose::lifted(&mut rows, n, <#of as #root::compose::Rows>::ROWS,
                        #root::compose::Part {
                            offset: ::core::mem::offset_of!(Self, #field), each: #each, from: #from, prefix: #prefix, about: #about,
                        });
                });
            }
            Role::State => {}
        }
    }
    Ok(quote! {
        impl #root::compose::Rows for #name {
            const ROWS: &'static [#root::Variable<Self>] = {
                const N: usize = 0 #(+ #counts)*;
                const SORTED: [#root::Variable<#name>; N] = #root::compose::#order(#name::rows_as_written());
                &SORTED
            };
        }

        impl #name {
            #[doc(hidden)]
            const fn rows_as_written<const N: usize>() -> [#root::Variable<Self>; N] {
                let mut rows = [#root::Variable::NOTHING; N];
                let mut n = 0;
                #(#writes)*
                assert!(n == N);
                rows
            }
        }
    })
}

/// Whether the rows bear numbers: all do, or none does and their places count.
fn are_numbered(item: &DeriveInput) -> Result<bool> {
    let (mut numbered, mut bare) = (false, None);
    for (_, declared) in fields(item)? {
        match Role::of(declared)? {
            Role::Row(row) => {
                numbered |= row.number.is_some();
                bare = bare.or(row.number.is_none().then_some(row.causality));
            }
            Role::Part(part) => numbered |= part.from.is_some(),
            Role::State => {}
        }
    }
    match bare {
        Some(row) if numbered => Err(Error::new(
            row.span(),
            "this row has no number and others have: number all rows, or none",
        )),
        bare => Ok(numbered && bare.is_none()),
    }
}

fn row(
    field: &Ident,
    of: &Type,
    attribute: &Row,
    discrete: bool,
    root: &TokenStream,
) -> Result<TokenStream> {
    let (element, is_vector) = match of {
        Type::Array(array) => (array.elem.as_ref(), true),
        other => (other, false),
    };
    let kind = match element {
        Type::Path(path) => path.path.segments.last().map(|s| s.ident.to_string()),
        _ => None,
    };
    // With the field's type, so that the compiler points at it where it is none of the interface.
    let place =
        quote!(::<Self, #of>(::core::mem::offset_of!(Self, #field), |whole: &Self| &whole.#field));
    let plain = quote!(#root::place::of_field #place);
    let word = quote!(#root::place::of_word #place);
    let (access, is_real) = match kind.as_deref() {
        Some("i32") if attribute.has("boolean") => (quote!(Boolean { at: #word }), false),
        Some("i32") if attribute.has("items") => {
            let items = attribute.key("items");
            let declared = if attribute.has("typed") {
                quote!(Enumeration)
            } else {
                quote!(Integer)
            };
            let access = quote!(Enumeration {
                of: &#items, declared: #root::Declared::#declared, at: #plain
            });
            (access, false)
        }
        Some("i32") => {
            let (low, high) = match attribute.key("integers") {
                Some(range) => bounds(range, &quote!(i32::MIN), &quote!(i32::MAX))?,
                None => (quote!(i32::MIN), quote!(i32::MAX)),
            };
            (quote!(Integer { min: #low, max: #high, at: #plain }), false)
        }
        Some("bool") => (quote!(Boolean { at: #plain }), false),
        Some("String") => (quote!(String { at: #plain }), false),
        Some(_) => {
            let unit = attribute
                .key("unit")
                .map_or(quote!(#root::unit::NONE), |unit| {
                    constant(unit, "unit", root)
                });
            let range = match attribute.key("range") {
                None => quote!(#root::range::FINITE),
                Some(range @ Expr::Range(_)) => {
                    let (low, high) =
                        bounds(range, &quote!(f64::NEG_INFINITY), &quote!(f64::INFINITY))?;
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
            (
                quote!(Real { unit: #unit, range: #range, at: #plain }),
                true,
            )
        }
        None => {
            return Err(Error::new_spanned(
                of,
                "expected a number, a Boolean or a String",
            ));
        }
    };

    let name = attribute.key("name").map_or_else(
        || {
            let name = field.to_string();
            if is_vector {
                quote!(concat!(#name, "[i]"))
            } else {
                quote!(#name)
            }
        },
        |name| quote!(#name),
    );
    let variability = if attribute.causality == "parameter" || attribute.causality == "calculated" {
        if attribute.has("tunable") {
            quote!(Tunable)
        } else {
            quote!(Fixed)
        }
    } else if attribute.has("discrete") || (!attribute.has("continuous") && (discrete || !is_real))
    {
        quote!(Discrete)
    } else {
        quote!(Continuous)
    };
    let causality = match attribute.causality.to_string().as_str() {
        "calculated" => quote!(calculated_parameter),
        _ => {
            let causality = &attribute.causality;
            quote!(#causality)
        }
    };
    let number = attribute
        .number
        .as_ref()
        .map(|number| quote!(.numbered(#number)));
    let field = field.to_string();
    let about = attribute.key("about").map_or_else(
        || {
            let about = &attribute.about;
            quote!(#about)
        },
        |about| quote!(#about),
    );
    let from = attribute.key("from").map(|from| match from {
        Expr::Array(_) => quote!(.initially_from(&#from)),
        _ => quote!(.initially_from(#from)),
    });
    let nan = attribute.has("nan").then(|| quote!(.may_be_nan()));
    Ok(quote! {
        #root::Variable::new(#name, #root::Access::#access)
            #number
            .of_field(#field)
            .#causality(#root::Variability::#variability)
            .about(#about)
            #from
            #nan
    })
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
