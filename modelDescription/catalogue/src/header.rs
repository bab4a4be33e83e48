//! The C header of the law's library, made by cbindgen from `fmu/c/src`.

use crate::root;
use std::path::PathBuf;

/// The header's committed place.
pub fn committed() -> PathBuf {
    root().join("fmu/c/include/exo_law.h")
}

/// The header that the source gives.
///
/// # Errors
/// When cbindgen cannot read the source.
pub fn header() -> Result<String, String> {
    let source = root().join("fmu/c");
    let found = |error: &dyn std::fmt::Display| format!("cbindgen: {error}");
    let config =
        cbindgen::Config::from_file(source.join("cbindgen.toml")).map_err(|error| found(&error))?;
    let bindings = cbindgen::Builder::new()
        .with_config(config)
        .with_src(source.join("../admittance/src/lib.rs"))
        .with_src(source.join("../arm-law/src/lib.rs"))
        .with_src(source.join("src/lib.rs"))
        .generate()
        .map_err(|error| found(&error))?;
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).map_err(|error| found(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_header_is_what_the_source_gives() {
        let text = header().unwrap_or_else(|error| panic!("{error}"));
        let committed = std::fs::read_to_string(committed()).expect("is committed");
        assert!(
            committed == text,
            "run `cargo xtask law --bless` and read the diff"
        );
    }
}
