//! The functions that a library exports.

use fmu_export::legality::Function;

/// Functions that are called without an instance, so that they are not in the table of legal calls.
const WITHOUT_INSTANCE: [&str; 3] = ["fmi2GetTypesPlatform", "fmi2GetVersion", "fmi2Instantiate"];

/// Their C names.
pub fn exported() -> Vec<&'static str> {
    let called_on_an_instance = Function::LIST.iter().map(|function| function.name());
    called_on_an_instance.chain(WITHOUT_INSTANCE).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn co_simulation_has_34_functions() {
        let mut names = super::exported();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), 34, "FMI 2.0.5, fmi2Functions.h");
    }
}
