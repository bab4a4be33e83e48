//! `#[interface(…)]`: a struct as a whole model's interface. `#[group]`: a struct whose rows are part of one.

use crate::attribute::about;
use crate::start::is_long;
use proc_macro2::TokenStream;
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Expr, Ident, ItemStruct, LitStr, Result, Token, Type, parse_quote};

/// What stands in the brackets.
pub struct Whole {
    name: Option<LitStr>,
    about: Option<LitStr>,
    sampled: bool,
    start: Option<Expr>,
    stop: Option<Expr>,
    tolerance: Option<Expr>,
    step: Expr,
}

impl Parse for Whole {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let (mut name, mut about, mut sampled) = (None, None, false);
        let (mut start, mut stop, mut tolerance, mut step) = (None, None, None, None);
        while !input.is_empty() {
            let key: Ident = input.parse()?;
            if key == "sampled" {
                sampled = true;
            } else {
                input.parse::<Token![=]>()?;
                match key.to_string().as_str() {
                    "name" => name = Some(input.parse()?),
                    "about" => about = Some(input.parse()?),
                    "start" => start = Some(input.parse()?),
                    "stop" => stop = Some(input.parse()?),
                    "tolerance" => tolerance = Some(input.parse()?),
                    "step" => step = Some(input.parse()?),
                    _ => {
                        let message = format!(
                            "unknown key {key}, expected one of step, stop, start, tolerance, sampled, name, about"
                        );
                        return Err(Error::new(key.span(), message));
                    }
                }
            }
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        let missing = "step is missing: the communication step in seconds, for instance #[interface(step = 0.01)]";
        Ok(Self {
            name,
            about,
            sampled,
            start,
            stop,
            tolerance,
            step: step.ok_or_else(|| Error::new(proc_macro2::Span::call_site(), missing))?,
        })
    }
}

/// The struct with what its derives give it.
pub fn group(item: &ItemStruct) -> TokenStream {
    let mut item = item.clone();
    for field in &mut item.fields {
        let is_long = matches!(&field.ty, Type::Array(array) if is_long(&array.len));
        if is_long && !field.attrs.iter().any(|a| a.path().is_ident("serde")) {
            (field.attrs).push(parse_quote!(#[serde(with = "::fmu_export::arrays")]));
        }
    }
    quote! {
        #[derive(
            ::core::clone::Clone,
            ::fmu_export::serde::Serialize,
            ::fmu_export::serde::Deserialize,
            ::fmu_export::Rows,
            ::fmu_export::Start,
        )]
        #[serde(crate = "::fmu_export::serde")]
        #item
    }
}

/// The same, and its description.
pub fn interface(whole: &Whole, item: &ItemStruct) -> Result<TokenStream> {
    let model = &item.ident;
    let name = whole
        .name
        .as_ref()
        .map_or_else(|| model.to_string(), LitStr::value);
    let about = whole
        .about
        .as_ref()
        .map_or_else(|| about(&item.attrs), LitStr::value);
    if about.is_empty() {
        let message = "say in one sentence what the model is: a comment `///` above the struct, or about = \"…\"";
        return Err(Error::new(model.span(), message));
    }
    let stepping = if whole.sampled {
        quote!(Sampled)
    } else {
        quote!(Exact)
    };
    let step = &whole.step;
    let or = |value: &Option<Expr>, default: f64| {
        value
            .as_ref()
            .map_or(quote!(#default), |value| quote!(#value))
    };
    let start = or(&whole.start, 0.0);
    let stop = or(&whole.stop, 1.0);
    let tolerance = or(&whole.tolerance, 1e-6);
    let declared = group(item);
    Ok(quote! {
        #declared

        impl ::fmu_export::Declare for #model {
            const DESCRIPTION: ::fmu_export::declaration::Description<Self> = ::fmu_export::declaration::Description {
                name: #name,
                about: #about,
                stepping: ::fmu_export::declaration::Stepping::#stepping,
                experiment: ::fmu_export::declaration::Experiment {
                    start: #start,
                    stop: #stop,
                    tolerance: #tolerance,
                    step: #step,
                },
                variables: <Self as ::fmu_export::Rows>::ROWS,
            };
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(whole: &str, item: &ItemStruct) -> String {
        let whole = match syn::parse_str::<Whole>(whole) {
            Ok(whole) => whole,
            Err(refusal) => return refusal.to_string(),
        };
        interface(&whole, item)
            .expect_err("it is refused")
            .to_string()
    }

    #[test]
    fn what_is_missing_or_unknown_is_said_where_it_is_written() {
        let told: ItemStruct = parse_quote! {
            /// A tank.
            struct Tank { x: f64 }
        };
        let untold: ItemStruct = parse_quote! { struct Tank { x: f64 } };
        assert!(refused("", &told).starts_with("step is missing"));
        assert!(
            refused("step = 1.0, period = 2.0", &told)
                .starts_with("unknown key period, expected one of step,")
        );
        assert!(refused("step = 1.0", &untold).starts_with("say in one sentence"));
    }

    #[test]
    fn a_row_without_a_number_among_numbered_ones_is_refused() {
        let mixed = parse_quote! {
            struct Tank {
                #[input(0)]
                u: f64,
                #[output]
                y: f64,
            }
        };
        let refusal = crate::rows::derive(&mixed, &quote!(::fmu_declaration)).expect_err("mixed");
        assert!(refusal.to_string().ends_with("number all rows, or none"));
    }
}
