//! What tells the states of one model from those of another: computed once in the life of a library, because it takes
//! every variable's row and is asked for with every state.

use crate::model::Model;
use std::any::TypeId;
use std::sync::OnceLock;

/// Length of a guid in braces.
pub(crate) const GUID: usize = 38;

/// The identity of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    guid: [u8; GUID],
    /// Tells layouts of the state apart that the interface, and so the guid, does not: CRC-32 of the start state as bytes.
    pub(crate) layout: u32,
}

impl Identity {
    /// The identity of `M`.
    ///
    /// # Errors
    /// A sentence when the model's serialization fails.
    pub(crate) fn of<M: Model>() -> Result<Self, String> {
        // No heap: nothing of it is lost when the library is unloaded. A static is shared by all `M`; an FMU has one model,
        // a program with several computes anew.
        static KNOWN: OnceLock<(TypeId, Identity)> = OnceLock::new();
        match KNOWN.get() {
            Some((model, identity)) if *model == TypeId::of::<M>() => Ok(*identity),
            _ => {
                let identity = Self::computed::<M>()?;
                let _ = KNOWN.set((TypeId::of::<M>(), identity));
                Ok(identity)
            }
        }
    }

    fn computed<M: Model>() -> Result<Self, String> {
        let guid = M::DESCRIPTION.guid();
        let length = guid.len();
        let guid = guid
            .into_bytes()
            .try_into()
            .map_err(|_| format!("a guid of {length} bytes, expected {GUID}"))?;
        let layout = postcard::to_allocvec(&M::default())
            .map(|bytes| crc32fast::hash(&bytes))
            .map_err(|e| format!("the model cannot be serialized: {e}"))?;
        Ok(Self { guid, layout })
    }

    /// The guid, as in the XML.
    pub(crate) fn guid(&self) -> &str {
        std::str::from_utf8(&self.guid).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Log, Refusal, Step};
    use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
    use serde::{Deserialize, Serialize};

    macro_rules! model {
        ($name:ident) => {
            #[derive(Clone, Serialize, Deserialize, Rows, Start)]
            struct $name {
                #[output(0)]
                x: f64,
            }

            impl Declare for $name {
                const DESCRIPTION: Description<Self> = Description {
                    name: stringify!($name),
                    about: "one number",
                    stepping: Stepping::Exact,
                    experiment: Experiment {
                        start: 0.0,
                        stop: 1.0,
                        tolerance: 1e-6,
                        step: 0.1,
                    },
                    variables: Self::ROWS,
                };
            }

            impl Model for $name {
                fn initialize(&mut self, _: f64, _: &mut Log<'_>) -> Result<(), Refusal> {
                    Ok(())
                }
                fn step(&mut self, _: Step, _: &mut Log<'_>) -> Result<(), Refusal> {
                    Ok(())
                }
            }
        };
    }
    model!(One);
    model!(Other);

    #[test]
    fn two_models_in_one_program_keep_their_own_identity() {
        for _ in 0..2 {
            assert_eq!(
                Identity::of::<One>().map(|i| i.guid().to_owned()),
                Ok(One::DESCRIPTION.guid())
            );
            assert_eq!(
                Identity::of::<Other>().map(|i| i.guid().to_owned()),
                Ok(Other::DESCRIPTION.guid())
            );
        }
    }
}
