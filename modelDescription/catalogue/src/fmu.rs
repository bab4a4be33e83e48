//! The list of the FMUs with their types. The descriptions written from their declarations are committed as
//! `modelDescription/<Name>.xml`, those of FMI 3.0 in `modelDescription/fmi3/`, so that an interface change is a diff that
//! someone reads.

use crate::{PACKAGE, root};
use fmu_archive::{Error, Interface, Standard};
use fmu_declaration::Declare;
use std::io;
use std::path::PathBuf;

/// One FMU.
#[derive(Clone, Copy, Debug)]
pub struct Fmu {
    /// Its name: archive, library and example target.
    pub name: &'static str,
    /// What it does, as paragraphs of HTML.
    pub what: &'static str,
    /// Signs and frames, as an `<svg>` element.
    pub picture: &'static str,
    /// `model.png`.
    pub icon: &'static [u8],
    read: fn() -> Result<Interface, Error>,
}

macro_rules! types {
    ($($crate_name:ident::$Type:ident, picture $picture:literal;)*) => {
        /// All FMUs.
        pub const FMUS: &[Fmu] = &[$(Fmu {
            name: stringify!($Type),
            what: include_str!(concat!("../../documents/", stringify!($Type), ".html")),
            picture: include_str!(concat!("../../pictures/", $picture, ".svg")),
            icon: include_bytes!(concat!("../../icons/", stringify!($Type), ".png")),
            read: Interface::of::<$crate_name::$Type>,
        }),*];
    };
}

fmus::each!(types);

impl Fmu {
    /// One by its name.
    pub fn named(name: &str) -> Option<&'static Self> {
        FMUS.iter().find(|fmu| fmu.name == name)
    }

    /// Its interface.
    ///
    /// # Errors
    /// The rule that the declaration breaks.
    pub fn interface(&self) -> Result<Interface, Error> {
        (self.read)()
    }

    /// A model that is not in the list, with the icon of a control loop.
    pub const fn example<D: Declare>(name: &'static str) -> Self {
        Self {
            name,
            what: "",
            picture: "",
            icon: include_bytes!("../../model.png"),
            read: Interface::of::<D>,
        }
    }

    /// The committed description for a version of the standard.
    pub fn committed(&self, standard: Standard) -> PathBuf {
        let folder = root().join("modelDescription").join(standard.folder());
        folder.join(self.name).with_extension("xml")
    }

    /// Whether the committed description is the one that the declaration gives now.
    pub fn is_committed(&self, interface: &Interface, standard: Standard) -> bool {
        let committed = std::fs::read_to_string(self.committed(standard));
        committed.is_ok_and(|text| text == standard.description(interface, PACKAGE))
    }

    /// Writes the description into the place where it is committed.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn bless(&self, interface: &Interface, standard: Standard) -> io::Result<()> {
        let path = self.committed(standard);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        std::fs::write(path, standard.description(interface, PACKAGE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fmu_export::log::{ALL, Category};

    #[test]
    fn committed_descriptions_are_what_the_declarations_give() {
        for fmu in FMUS {
            let interface = fmu
                .interface()
                .unwrap_or_else(|error| panic!("{}: {error}", fmu.name));
            for standard in Standard::of(&interface) {
                assert!(
                    fmu.is_committed(&interface, standard),
                    "{} is not what the declaration gives: run `cargo xtask fmu --bless` and read the diff",
                    fmu.committed(standard).display()
                );
            }
        }
    }

    #[test]
    fn each_declaration_bears_the_name_of_its_type() {
        for fmu in FMUS {
            assert_eq!(fmu.interface().expect("legal").name, fmu.name);
        }
    }

    #[test]
    fn declared_log_categories_are_those_of_the_exporter() {
        let mut exported: Vec<_> = Category::LIST
            .map(|category| category.name())
            .map(|(name, about)| (name.to_str().expect("ASCII"), about))
            .into();
        exported.push((ALL.to_str().expect("ASCII"), "all categories"));
        assert_eq!(fmu_archive::xml::LOG_CATEGORIES, *exported);
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
