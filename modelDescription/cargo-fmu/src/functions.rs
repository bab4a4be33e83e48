//! The functions that a library exports.

use fmu_export::legality::Function;
use std::collections::BTreeSet;

/// Functions that are called without an instance, so that they are not in the table of legal calls.
const WITHOUT_INSTANCE: [&str; 3] = ["fmi2GetTypesPlatform", "fmi2GetVersion", "fmi2Instantiate"];

/// Their C names.
pub fn exported() -> BTreeSet<String> {
    let called_on_an_instance = Function::LIST.iter().map(|function| function.name());
    called_on_an_instance
        .chain(WITHOUT_INSTANCE)
        .map(str::to_owned)
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn co_simulation_has_34_functions() {
        assert_eq!(super::exported().len(), 34, "FMI 2.0.5, fmi2Functions.h");
    }
}
