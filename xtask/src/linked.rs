//! What is linked into an FMU's library, held against what this project asks for: an allowed licence, and its text.

use crate::licence;
use crate::process::{Failure, Outcome, workspace};
use fmu_archive::Component;

/// Everything that is linked into the libraries of `package`, by name.
///
/// # Errors
/// When cargo fails, when something foreign has no licence text or a licence that is not allowed.
pub fn components(package: &str) -> Outcome<Vec<Component>> {
    let components = cargo_fmu::linked::components(&workspace(), package)?;
    components.iter().try_for_each(may_be_linked)?;
    Ok(components)
}

/// Whether it may stand in a library of ours.
///
/// # Errors
/// Names the component and what is wrong with its licence.
pub fn may_be_linked(component: &Component) -> Outcome {
    licence::check(&component.id(), &component.license)?;
    if component.is_foreign() && component.texts.is_empty() {
        return Err(Failure::Found(format!(
            "{} ({}) comes without a licence text",
            component.id(),
            component.license
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_fmu_lists_what_it_links_with_texts_sums_and_allowed_licences() {
        for fmu in fmus::ALL {
            let components = components(&fmu.package())
                .unwrap_or_else(|failure| panic!("{}: {failure}", fmu.name));
            let find = |name: &str| components.iter().find(|component| component.name == name);
            for name in ["rust-std", "serde", "postcard", "libm", "uuid"] {
                let component = find(name).unwrap_or_else(|| panic!("{} links {name}", fmu.name));
                assert!(!component.texts.is_empty() && component.purl.is_some());
                assert_eq!(
                    component.sha256.as_ref().map(String::len),
                    (name != "rust-std").then_some(64),
                    "{name}"
                );
            }
            // They run in the compiler, or in tests alone.
            for name in ["serde_derive", "syn", "paste", "proptest", "autocfg"] {
                assert!(find(name).is_none(), "{} links {name}", fmu.name);
            }
            let export = find("fmu-export").expect("it makes the C interface");
            assert!(export.texts.is_empty() && export.purl.is_none(), "our own");
            assert!(export.uses.iter().any(|id| id.starts_with("postcard-")));
            assert!(
                find(&fmu.package()).is_none(),
                "the FMU itself is no part of it"
            );
        }
    }

    #[test]
    fn only_licence_texts_are_taken_from_a_folder() {
        let names: Vec<_> = cargo_fmu::linked::texts(&crate::process::root())
            .expect("readable")
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        assert_eq!(names, ["LICENSE-APACHE", "LICENSE-MIT"]);
    }
}
