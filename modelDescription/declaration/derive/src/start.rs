//! `impl Default`.

use crate::attribute::Role;
use crate::rows::fields;
use proc_macro2::TokenStream;
use quote::quote;
use syn::{DeriveInput, Expr, Field, Result};

pub fn derive(item: &DeriveInput) -> Result<TokenStream> {
    let name = &item.ident;
    let mut values = Vec::new();
    for (field, declared) in fields(item)? {
        let value = start(declared)?;
        let value = value.map_or(
            quote!(::core::default::Default::default()),
            |value| quote!(#value),
        );
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
