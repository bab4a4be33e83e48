//! A target of cargo that becomes a shared library with one model.

use cargo_metadata::{CrateType, Target, TargetKind};
use std::fmt;

/// Such a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cdylib {
    /// Its package.
    pub package: String,
    /// Its name: that of the library's file.
    pub name: String,
    /// Whether it is an example; otherwise it is the package's library.
    pub example: bool,
}

impl Cdylib {
    /// An example of a package.
    pub fn example(package: &str, name: &str) -> Self {
        Self {
            package: package.to_owned(),
            name: name.to_owned(),
            example: true,
        }
    }

    /// What a target of a package is, if it is one.
    pub fn of(package: &str, target: &Target) -> Option<Self> {
        target
            .crate_types
            .contains(&CrateType::CDyLib)
            .then(|| Self {
                package: package.to_owned(),
                name: file_name(&target.name),
                example: target.is_example(),
            })
    }

    /// What cargo is told to build it.
    pub fn arguments(&self) -> Vec<&str> {
        let mut arguments = vec!["--package", &self.package];
        match self.example {
            true => arguments.extend(["--example", &self.name]),
            false => arguments.push("--lib"),
        }
        arguments
    }

    /// Whether cargo means this one.
    pub fn is(&self, target: &Target) -> bool {
        let kind = target.kind.contains(&TargetKind::Example);
        kind == self.example
            && target.crate_types.contains(&CrateType::CDyLib)
            && file_name(&target.name) == self.name
    }
}

impl fmt::Display for Cdylib {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.example { "example" } else { "library" };
        write!(f, "{kind} {} of {}", self.name, self.package)
    }
}

/// Libraries of C have no hyphen in their names; older cargos tell the name with it.
fn file_name(target: &str) -> String {
    target.replace('-', "_")
}
