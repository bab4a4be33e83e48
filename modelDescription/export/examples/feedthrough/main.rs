//! The shared library of the model with variables of every type. The model lies beside it, so that a program can read its declaration
//! without the C symbols.

mod model;

fmu_export::export!(model::Feedthrough);
