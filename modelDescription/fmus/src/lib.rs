//! The list of the FMUs, written once. Everything that goes through all of them reads it: what builds them, their committed
//! descriptions, the tests, the benches. Python reads the names of the committed descriptions, `modelDescription/*.xml`, which a
//! test holds to be those of this list.
//!
//! This crate depends on nothing, so that a list of names costs nobody the compilation of the models. The package `catalogue`
//! depends on all of them; there a row stands for the type, too.
//!
//! ```
//! assert!(fmus::NAMES.contains(&"Testbed"));
//! let arms = fmus::ALL.iter().find(|fmu| fmu.name == "ExoskeletonArms").unwrap();
//! assert_eq!(arms.package(), "exoskeleton-arms");
//! ```

/// Calls the macro `$then` with a row for each FMU: the type that declares it, by its path, and the picture in its interface
/// document, `modelDescription/pictures/<picture>.svg`. What the model does is told in `modelDescription/documents/<Name>.html`. The type's name is the FMU's name, its crate's the package's.
#[macro_export]
macro_rules! each {
    ($then:ident) => {
        $then! {
            testbed_controller::TestbedController, picture "testbed";
            testbed::Testbed, picture "testbed";
            arm_controller::ArmController, picture "arm";
            exoskeleton_arm::ExoskeletonArm, picture "arm";
            exoskeleton_arms::ExoskeletonArms, picture "arms";
            human_operator::HumanOperator, picture "operator";
        }
    };
}

/// One FMU.
#[derive(Clone, Copy, Debug)]
pub struct Fmu {
    /// Its name: archive, library, example target, committed description, icon.
    pub name: &'static str,
    /// Its crate.
    pub crate_name: &'static str,
}

impl Fmu {
    /// Its package, as cargo spells it.
    pub fn package(&self) -> String {
        self.crate_name.replace('_', "-")
    }
}

macro_rules! lists {
    ($($crate_name:ident::$Type:ident, picture $picture:literal;)*) => {
        /// All FMUs.
        pub const ALL: &[Fmu] = &[$(Fmu {
            name: stringify!($Type),
            crate_name: stringify!($crate_name),
        }),*];

        /// Their names.
        pub const NAMES: &[&str] = &[$(stringify!($Type)),*];
    };
}

each!(lists);

#[cfg(test)]
mod tests {
    use super::NAMES;
    use std::path::Path;

    #[test]
    fn the_committed_descriptions_are_those_of_the_list() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let mut committed: Vec<_> = std::fs::read_dir(folder)
            .expect("readable")
            .map(|entry| entry.expect("readable").path())
            .filter(|path| path.extension().is_some_and(|end| end == "xml"))
            .map(|path| path.file_stem().expect("a name").display().to_string())
            .collect();
        committed.sort();
        let mut listed = NAMES.to_vec();
        listed.sort_unstable();
        assert_eq!(committed, listed, "`cargo xtask fmu --bless` writes them");
    }
}
