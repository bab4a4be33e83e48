//! `#[derive(Rows)]`: the rows of a struct, from the attributes of its fields. `#[derive(Start)]`: its [`Default`].
//!
//! A field is a row if it bears one of
//!
//! | attribute | what |
//! |---|---|
//! | `#[input(n, …)]`, `#[output(n, …)]`, `#[parameter(n, …)]`, `#[calculated(n, …)]`, `#[local(n, …)]` | the row number n; the field's documentation is its description |
//! | `#[part]` | the rows of the struct in this field |
//! | `#[part(each)]` | the field is an array of structs: their rows become vectors |
//! | `#[part(from = 40)]` | the part's numbers count from there |
//! | `#[part(prefix = "left.")]` | what comes before the part's names |
//! | `#[part(about = [("f_h[i]", "…")])]` | another description of some of its rows, by their names without prefix |
//!
//! and without any of them it is none: a state that the interface does not show. After the number may stand
//!
//! | key | what | without it |
//! |---|---|---|
//! | `unit = NEWTON` | one of `fmu_declaration::unit` | 1 |
//! | `range = POSITIVE`, `range = 0.0..=10.0` | one of `fmu_declaration::range`, or bounds | any number |
//! | `integers = 0..=1` | bounds of an integer | any |
//! | `items = LAW` | an integer that is one of an `Enumeration`'s items | |
//! | `boolean` | an `i32` that is 0 or 1 | |
//! | `name = "energy.H"` | the name; a vector's has `[i]` | the field's |
//! | `start = 0.5` | the start value, for `Start` | `Default::default()` |
//! | `tunable` | a parameter that may be changed in a run | fixed |
//! | `discrete`, `continuous` | of an input or output | Reals continuous, others discrete; `#[rows(discrete)]` on the struct: all discrete |
//! | `from = ["q[i]", "A1"]` | what an output's initial value follows from | nothing |
//! | `nan` | a sensor that can fail so | |
//! | `typed` | the XML declares the enumeration as a type | as an Integer |

use proc_macro::TokenStream;

mod attribute;
mod rows;
mod start;

/// The rows of a struct.
#[proc_macro_derive(
    Rows,
    attributes(rows, input, output, parameter, calculated, local, part)
)]
pub fn rows(item: TokenStream) -> TokenStream {
    rows::derive(&syn::parse_macro_input!(item as syn::DeriveInput))
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}

/// The start values of a struct: its `Default`.
#[proc_macro_derive(
    Start,
    attributes(rows, input, output, parameter, calculated, local, part, start)
)]
pub fn start(item: TokenStream) -> TokenStream {
    start::derive(&syn::parse_macro_input!(item as syn::DeriveInput))
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}
