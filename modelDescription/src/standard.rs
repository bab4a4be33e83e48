//! The versions of the standard, and ways of calling a model, for which an archive is written.

use crate::entry::Kind;
use crate::{Interface, Package};
use fmu_declaration::Stepping;

/// What an archive is for. The library in it is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Standard {
    /// FMI 2.0, co-simulation.
    #[default]
    Fmi2,
    /// FMI 3.0, co-simulation.
    Fmi3,
    /// FMI 3.0, scheduled execution of a sampled model: the importer's scheduler calls each tick by the model's clock. It is an
    /// archive of its own: a co-simulation FMU with a clock must have an event mode (FMI 3.0, section 4.4), and interface
    /// types that share an archive have the same variables (2.5.2).
    Fmi3Scheduled,
}

impl Standard {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Fmi2, Self::Fmi3, Self::Fmi3Scheduled];

    /// Those that a model has: scheduled execution is for sampled ones, FMI 2.0 for those all of whose variables have a type
    /// there ([`Interface::beyond_fmi2`]).
    pub fn of(interface: &Interface) -> impl Iterator<Item = Self> + use<> {
        let sampled = interface.stepping == Stepping::Sampled;
        let in_fmi2 = interface.beyond_fmi2().is_none();
        Self::ALL.into_iter().filter(move |one| match one {
            Self::Fmi2 => in_fmi2,
            Self::Fmi3 => true,
            Self::Fmi3Scheduled => sampled,
        })
    }

    /// For humans.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Fmi2 => "FMI 2.0, co-simulation",
            Self::Fmi3 => "FMI 3.0, co-simulation",
            Self::Fmi3Scheduled => "FMI 3.0, scheduled execution",
        }
    }

    /// Folder of such archives below that of FMI 2.0, and of their committed descriptions; empty: that folder itself.
    pub const fn folder(self) -> &'static str {
        match self {
            Self::Fmi2 => "",
            Self::Fmi3 => "fmi3",
            Self::Fmi3Scheduled => "fmi3/scheduled",
        }
    }

    /// Whether it is FMI 3.0.
    pub const fn is_fmi3(self) -> bool {
        !matches!(self, Self::Fmi2)
    }

    /// The description in the archive.
    pub fn description(self, interface: &Interface, package: Package<'_>) -> String {
        match self {
            Self::Fmi2 => crate::xml(interface, package),
            Self::Fmi3 | Self::Fmi3Scheduled => crate::xml3::write(interface, package, self),
        }
    }

    /// What it calls the text by which a library knows its description.
    pub const fn token(self) -> &'static str {
        if self.is_fmi3() {
            "instantiationToken"
        } else {
            "guid"
        }
    }

    /// What it calls a row: a vector of FMI 2.0 keeps its `[i]`.
    pub fn name(self, row: &str) -> String {
        if self.is_fmi3() {
            crate::arrays::name(row)
        } else {
            row.to_owned()
        }
    }

    /// What it calls a type.
    pub const fn type_name(self, kind: &Kind) -> &'static str {
        match (self.is_fmi3(), kind) {
            (false, Kind::Real { .. }) => "Real",
            (true, Kind::Real { single: true, .. }) => "Float32",
            (true, Kind::Real { .. }) => "Float64",
            (false, Kind::Integer { .. }) => "Integer",
            (true, Kind::Integer { of, .. }) => of.name(),
            (_, Kind::Boolean { .. }) => "Boolean",
            (_, Kind::String { .. }) => "String",
            (_, Kind::Binary { .. }) => "Binary",
            (_, Kind::Enumeration { .. }) => "Enumeration",
        }
    }

    /// Folder under `binaries/` of a platform, which is given as FMI 2.0 and its vendors name it. FMI 3.0: section 2.5.1.4.1.
    pub fn platform(self, fmi2: &str) -> &str {
        match (self, fmi2) {
            (Self::Fmi2, _) => fmi2,
            (_, "linux64") => "x86_64-linux",
            (_, "win64") => "x86_64-windows",
            (_, "darwin64") => "x86_64-darwin",
            // What FMI 2.0 has no name for is named as in FMI 3.0.
            _ => fmi2,
        }
    }
}
