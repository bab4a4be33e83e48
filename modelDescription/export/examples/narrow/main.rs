//! The shared library of the model with variables of the small types. The model lies beside it, so that a program can read its declaration
//! without the C symbols.

mod model;

fmu_export::export!(model::Narrow);
