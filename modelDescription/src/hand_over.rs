//! The interface as bytes: a library that was built for it hands them over to who packs it, so that the packer need not know
//! the model. The bytes begin with the version of this crate: both sides must have the same.

use crate::{Error, Interface, VERSION};

/// The C function that a library has which was built for handing over, and no other: `const uint8_t *f(size_t *length)`.
pub const SYMBOL: &str = "fmu_interface";

/// What begins the bytes.
const MARK: &str = "fmu-interface";

/// Why bytes are no interface.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// Not written by [`bytes`], or cut off.
    #[error("expected an interface that fmu-export has written, got {0}")]
    Foreign(String),
    /// Written by another version.
    #[error(
        "the model depends on fmu-export {theirs}, expected {VERSION}, the version of this program"
    )]
    Version {
        /// The version that has written it.
        theirs: String,
    },
    /// The declaration breaks a rule.
    #[error("{0}")]
    Declaration(String),
}

/// What a library hands over: its interface, or the rule that its declaration breaks.
///
/// # Panics
/// When postcard cannot write our own types: a programming error that the first test shows.
pub fn bytes(interface: Result<&Interface, &Error>) -> Vec<u8> {
    written(interface.map_err(ToString::to_string))
}

/// What a library hands over that cannot tell its interface, for this reason.
///
/// # Panics
/// As [`bytes`].
pub fn refusal(reason: String) -> Vec<u8> {
    written(Err(reason))
}

fn written(interface: Result<&Interface, String>) -> Vec<u8> {
    postcard::to_allocvec(&(MARK, VERSION, interface)).expect("the types are serializable")
}

/// Reads what a library has handed over. The interface refers to the bytes, as others refer to constants: they live as long
/// as the program.
///
/// # Errors
/// When the bytes come from elsewhere or from another version, or the declaration breaks a rule.
pub fn read(bytes: Vec<u8>) -> Result<Interface, Refused> {
    let foreign = |what: postcard::Error| Refused::Foreign(what.to_string());
    let bytes: &'static [u8] = bytes.leak();
    let ((mark, version), _): ((&str, &str), _) =
        postcard::take_from_bytes(bytes).map_err(foreign)?;
    if mark != MARK {
        return Err(Refused::Foreign(format!("bytes that begin with {mark:?}")));
    }
    if version != VERSION {
        return Err(Refused::Version {
            theirs: version.to_owned(),
        });
    }
    let (_, _, interface): (&str, &str, Result<Interface, String>) =
        postcard::from_bytes(bytes).map_err(foreign)?;
    interface.map_err(Refused::Declaration)
}
