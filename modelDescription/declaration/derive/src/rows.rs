//! `impl Rows`.

use crate::access::access;
use crate::attribute::{Part, Role, Row, is_discrete};
use proc_macro2::TokenStream;
use quote::quote;
use syn::{Data, DeriveInput, Error, Expr, Field, Fields, Ident, Result, Type};

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
                const __COUNT: usize = 0 #(+ #counts)*;
                const SORTED: [#root::Variable<#name>; __COUNT] = #root::compose::#order(#name::rows_as_written());
                &SORTED
            };
        }

        impl #name {
            #[doc(hidden)]
            // No name that the struct's own expressions may have.
            const fn rows_as_written<const __COUNT: usize>() -> [#root::Variable<Self>; __COUNT] {
                let mut rows = [#root::Variable::NOTHING; __COUNT];
                let mut n = 0;
                #(#writes)*
                assert!(n == __COUNT);
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
    let (access, is_real) = access(field, of, element, attribute, root)?;

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
