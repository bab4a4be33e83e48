//! The functions that a library exports.

use fmu_export::legality::{fmi2, fmi3};

/// Functions that are called without an instance, so that they are not in the tables of legal calls.
const WITHOUT_INSTANCE: [&str; 7] = [
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi3GetVersion",
    "fmi3InstantiateModelExchange",
    "fmi3InstantiateCoSimulation",
    "fmi3InstantiateScheduledExecution",
];

/// Their C names.
pub fn exported() -> Vec<&'static str> {
    let fmi2 = fmi2::Function::LIST.iter().map(|function| function.name());
    let fmi3 = fmi3::Function::LIST.iter().map(|function| function.name());
    fmi2.chain(fmi3).chain(WITHOUT_INSTANCE).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn there_are_34_functions_of_fmi_2_and_75_of_fmi_3() {
        let mut names = super::exported();
        names.sort_unstable();
        names.dedup();
        let of = |version| {
            names
                .iter()
                .filter(|name| name.starts_with(version))
                .count()
        };
        assert_eq!(of("fmi2"), 34, "FMI 2.0.5, fmi2Functions.h");
        assert_eq!(of("fmi3"), 75, "FMI 3.0.3, fmi3Functions.h");
        assert_eq!(names.len(), 34 + 75);
    }
}
