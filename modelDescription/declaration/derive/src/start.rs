//! `impl Default`.

use crate::attribute::Role;
use crate::rows::fields;
use proc_macro2::TokenStream;
use quote::quote;
use syn::{DeriveInput, Expr, ExprLit, Field, Lit, Result, Type};

pub fn derive(item: &DeriveInput) -> Result<TokenStream> {
    let name = &item.ident;
    let mut values = Vec::new();
    for (field, declared) in fields(item)? {
        let value = start(declared)?.map_or_else(|| default(&declared.ty), |value| quote!(#value));
        values.push(quote!(#field: #value));
    }
    Ok(quote! {
        impl ::core::default::Default for #name {
            fn default() -> Self {
                Self { #(#values),* }
            }
        }
    })
}

/// The default value of a type; the standard library has none for long arrays.
fn default(of: &Type) -> TokenStream {
    match of {
        Type::Array(array) if is_long(&array.len) => {
            let element = default(&array.elem);
            quote!(::core::array::from_fn(|_| #element))
        }
        _ => quote!(::core::default::Default::default()),
    }
}

/// Whether an array of the length `len` may be longer than the 32 elements for which serde and `Default` know arrays.
pub fn is_long(len: &Expr) -> bool {
    let Expr::Lit(ExprLit {
        lit: Lit::Int(len), ..
    }) = len
    else {
        return true;
    };
    len.base10_parse::<usize>().is_ok_and(|len| len > 32)
}

/// The start value that the field says: `start = …` in its row, or `#[start(…)]`.
fn start(field: &Field) -> Result<Option<Expr>> {
    for attribute in &field.attrs {
        if attribute.path().is_ident("start") {
            return attribute.parse_args().map(Some);
        }
    }
    Ok(match Role::of(field)? {
        Role::Row(row) => row.key("start").cloned(),
        Role::Part(_) | Role::State => None,
    })
}
