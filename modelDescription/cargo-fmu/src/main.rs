//! `cargo fmu`.

fn main() {}
