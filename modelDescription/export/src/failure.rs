//! What a call may come back with.

/// Why a call did not do what was asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// Refused: nothing has changed, the phase stays.
    Refused(String),
    /// The model failed in the middle of a change: the instance enters the error phase.
    Broken(String),
}

impl From<String> for Failure {
    fn from(reason: String) -> Self {
        Self::Refused(reason)
    }
}

/// Shorthand for the result of an instance's method.
pub type Outcome = Result<(), Failure>;
