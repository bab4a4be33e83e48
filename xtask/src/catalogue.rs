//! The table of the FMUs. The descriptions written from their declarations are committed as
//! `modelDescription/<Name>.xml`, so that an interface change is a diff that someone reads.

use crate::process::{Failure, Outcome, at, root};
use model_description::Interface;
use std::path::PathBuf;

/// One FMU.
pub struct Fmu {
    /// Its name: archive, library and example target.
    pub name: &'static str,
    /// The package that it is built from.
    pub package: &'static str,
    /// Signs and frames, as an `<svg>` element.
    pub picture: &'static str,
    /// `model.png`.
    pub icon: &'static [u8],
    read: fn() -> Result<Interface, model_description::Error>,
}

macro_rules! picture {
    ($name:literal) => {
        include_str!(concat!("../../modelDescription/pictures/", $name, ".svg"))
    };
}

macro_rules! icon {
    ($name:literal) => {
        include_bytes!(concat!("../../modelDescription/icons/", $name, ".png"))
    };
}

/// All FMUs.
pub const FMUS: [Fmu; 6] = [
    Fmu {
        name: "TestbedController",
        package: "testbed-controller",
        picture: picture!("testbed"),
        icon: icon!("TestbedController"),
        read: Interface::of::<testbed_controller::TestbedController>,
    },
    Fmu {
        name: "Testbed",
        package: "testbed",
        picture: picture!("testbed"),
        icon: icon!("Testbed"),
        read: Interface::of::<testbed::Testbed>,
    },
    Fmu {
        name: "ArmController",
        package: "arm-controller",
        picture: picture!("arm"),
        icon: icon!("ArmController"),
        read: Interface::of::<arm_controller::ArmController>,
    },
    Fmu {
        name: "ExoskeletonArm",
        package: "exoskeleton-arm",
        picture: picture!("arm"),
        icon: icon!("ExoskeletonArm"),
        read: Interface::of::<exoskeleton_arm::ExoskeletonArm>,
    },
    Fmu {
        name: "ExoskeletonArms",
        package: "exoskeleton-arms",
        picture: picture!("arm"),
        icon: icon!("ExoskeletonArms"),
        read: Interface::of::<exoskeleton_arms::ExoskeletonArms>,
    },
    Fmu {
        name: "HumanOperator",
        package: "human-operator",
        picture: picture!("arm"),
        icon: icon!("HumanOperator"),
        read: Interface::of::<human_operator::HumanOperator>,
    },
];

impl Fmu {
    /// Its interface.
    pub fn interface(&self) -> Outcome<Interface> {
        let interface = (self.read)().map_err(|cause| Failure::Declaration {
            fmu: self.name,
            cause,
        })?;
        if interface.name == self.name {
            Ok(interface)
        } else {
            Err(Failure::Found(format!(
                "{}: its declaration is named {}",
                self.name, interface.name
            )))
        }
    }

    /// The committed description.
    pub fn committed(&self) -> PathBuf {
        root()
            .join("modelDescription")
            .join(self.name)
            .with_extension("xml")
    }

    /// Whether the committed description is the one that the declaration gives now.
    pub fn is_committed(&self, interface: &Interface) -> bool {
        std::fs::read_to_string(self.committed())
            .is_ok_and(|text| text == model_description::xml(interface))
    }

    /// Writes the description into the place where it is committed.
    pub fn bless(&self, interface: &Interface) -> Outcome {
        let path = self.committed();
        std::fs::write(&path, model_description::xml(interface)).map_err(at(&path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use export::log::{ALL, Category};

    #[test]
    fn committed_descriptions_are_what_the_declarations_give() {
        for fmu in FMUS {
            let interface = fmu
                .interface()
                .unwrap_or_else(|failure| panic!("{failure}"));
            assert!(
                fmu.is_committed(&interface),
                "modelDescription/{}.xml is not what the declaration gives: run `cargo xtask fmu --bless` and read the diff",
                fmu.name
            );
        }
    }

    #[test]
    fn declared_log_categories_are_those_of_the_exporter() {
        let mut exported: Vec<_> = Category::LIST
            .map(|category| category.name())
            .map(|(name, about)| (name.to_str().expect("ASCII"), about))
            .into();
        exported.push((ALL.to_str().expect("ASCII"), "all categories"));
        assert_eq!(model_description::xml::LOG_CATEGORIES, *exported);
    }

    #[test]
    fn guids_differ_between_the_fmus() {
        let guids: std::collections::BTreeSet<_> = FMUS
            .iter()
            .map(|fmu| fmu.interface().expect("legal").guid)
            .collect();
        assert_eq!(guids.len(), FMUS.len());
    }
}
