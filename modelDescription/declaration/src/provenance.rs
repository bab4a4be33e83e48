//! Which build it is: two Strings that every FMU has after its rows, so that a recording can say what made it.
//!
//! They are fixed local variables that are calculated, without a start value: the committed XML would otherwise contain
//! the hash of the commit that it is part of. Their values are the exporter's business.

use crate::description::SCALARS_PER_ROW;

/// The row on which they stand. No model has as many rows, so the value references stay when a model grows; they are
/// below 2²⁴, which every number type of an importer holds.
pub const ROW: u32 = 65_535;

/// One of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// Version of the source.
    Version,
    /// Commit of the source.
    GitHash,
}

/// In the order of the XML, after the rows of the model.
pub const ALL: [Provenance; 2] = [Provenance::Version, Provenance::GitHash];

impl Provenance {
    /// The variable's name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Version => "version",
            Self::GitHash => "git_hash",
        }
    }

    /// The variable's description.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Version => "version of the source that this library was built from",
            Self::GitHash => {
                "git commit of the source that this library was built from, with -dirty appended when the source had changes \
                 beside it, or unknown"
            }
        }
    }

    /// Its value reference.
    pub const fn reference(self) -> u32 {
        ROW * SCALARS_PER_ROW + self as u32
    }

    /// The one with this value reference.
    pub fn find(reference: u32) -> Option<Self> {
        ALL.into_iter().find(|one| one.reference() == reference)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_references_are_fixed_and_found() {
        assert_eq!(ALL.map(Provenance::reference), [16_776_960, 16_776_961]);
        assert!(ALL.iter().all(|one| one.reference() < 1 << 24));
        for one in ALL {
            assert_eq!(Provenance::find(one.reference()), Some(one));
        }
        assert_eq!(Provenance::find(16_776_962), None);
    }
}
