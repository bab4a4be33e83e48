//! `#[derive(Rows)]`: the rows of a struct, from the attributes of its fields. `#[derive(Start)]`: its [`Default`].
//!
//! The attribute `#[interface(…)]` of the package `fmu-export` gives a struct both, and what else a model has: its
//! description, `Clone` and serde's traits. `#[group]` does so for a struct that is a part of a model. The keys of
//! `interface` are
//!
//! | key | what | without it |
//! |---|---|---|
//! | `step = 0.01` | communication step size, of a sampled model its period, s | must be there |
//! | `start = 0.0`, `stop = 10.0` | the default experiment, s | 0 to 1 |
//! | `tolerance = 1e-6` | of no effect; importers warn when it is missing | 1e-6 |
//! | `sampled` | it runs ticks of a sample period; between them outputs hold | it integrates to the end of every step |
//! | `name = "Tank"` | name of the model, a C identifier | the struct's |
//! | `about = "…"` | one sentence | the struct's documentation |
//!
//! A field is a row if it bears one of
//!
//! | attribute | what |
//! |---|---|
//! | `#[input(n, …)]`, `#[output(n, …)]`, `#[parameter(n, …)]`, `#[calculated(n, …)]`, `#[local(n, …)]` | the row number n; the field's documentation is its description. All rows have numbers, or none has: then their places count |
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
//! | `integers = 0..=1` | bounds of an integer | those of its type |
//! | `items = LAW` | an integer that is one of an `Enumeration`'s items | |
//! | `boolean` | an `i32` that is 0 or 1 | |
//! | `max_size = 64` | most bytes of a `Vec<u8>` | any number |
//! | `mime_type = "image/png"` | what the bytes of a `Vec<u8>` are | `application/octet-stream` |
//! | `name = "energy.H"` | the name; a vector's has `[i]` | the field's |
//! | `start = 0.5` | the start value, for `Start` | `Default::default()` |
//! | `tunable` | a parameter that may be changed in a run | fixed |
//! | `discrete`, `continuous` | of an input or output | `f64` and `f32` continuous, others discrete; `#[rows(discrete)]` on the struct: all discrete |
//! | `from = ["q[i]", "A1"]` | what an output's initial value follows from | nothing |
//! | `nan` | a sensor that can fail so | |
//! | `typed` | the XML declares the enumeration as a type | as an Integer |

//! The type of the field, or of the elements of an array `[T; N]`, is the type of the variable:
//!
//! | field | FMI 2.0 | FMI 3.0 |
//! |---|---|---|
//! | `f64` | Real | Float64 |
//! | `f32` | Real | Float32 |
//! | `i8`, `u8`, `i16`, `u16` | Integer with the bounds of the type | Int8, UInt8, Int16, UInt16 |
//! | `i32` | Integer | Int32 |
//! | `i32` with `items` | Integer, with `typed` Enumeration | Enumeration |
//! | `u32`, `i64`, `u64` | – | UInt32, Int64, UInt64 |
//! | `bool`, `i32` with `boolean` | Boolean | Boolean |
//! | `String` | String | String |
//! | `Vec<u8>` | – | Binary |
//!
//! A model with a variable that FMI 2.0 has no type for has archives of FMI 3.0 alone. An alias of a type stands for `f64` or
//! `f32`; write the other types by their names. A variable has at most 256 elements; an array that is none may have any number.
//! Of an array of arrays the inner ones have at most 32 elements, as serde has it.

use proc_macro::TokenStream;
use quote::quote;

mod access;
mod attribute;
mod interface;
mod rows;
mod start;

/// The rows of a struct.
#[proc_macro_derive(
    Rows,
    attributes(rows, input, output, parameter, calculated, local, part)
)]
pub fn rows(item: TokenStream) -> TokenStream {
    rows_of(item, &quote!(::fmu_declaration))
}

/// The rows of a struct, in a crate that depends on `fmu-export` alone, which has this as its `Rows`.
#[proc_macro_derive(
    ExportedRows,
    attributes(rows, input, output, parameter, calculated, local, part)
)]
pub fn exported_rows(item: TokenStream) -> TokenStream {
    rows_of(item, &quote!(::fmu_export::declaration))
}

fn rows_of(item: TokenStream, root: &proc_macro2::TokenStream) -> TokenStream {
    syn::parse::<syn::DeriveInput>(item)
        .and_then(|item| rows::derive(&item, root))
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

/// A struct as a model's interface, in a crate that depends on `fmu-export`.
#[proc_macro_attribute]
pub fn interface(keys: TokenStream, item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::ItemStruct);
    syn::parse::<interface::Whole>(keys)
        .and_then(|whole| interface::interface(&whole, &item))
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}

/// A struct whose rows are a part of a model's, in a crate that depends on `fmu-export`.
#[proc_macro_attribute]
pub fn group(_: TokenStream, item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::ItemStruct);
    interface::group(&item).into()
}
