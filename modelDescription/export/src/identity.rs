//! What tells the states of one model from those of another: computed once in the life of a library, because it takes
//! every variable's row and is asked for with every state.

use crate::model::Model;
use crate::shape;
use std::any::TypeId;
use std::sync::OnceLock;

/// Length of a guid in braces.
pub(crate) const GUID: usize = 38;

/// The identity of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    guid: [u8; GUID],
    /// Tells layouts of the state apart that the interface, and so the guid, does not: CRC-32 of the start state as bytes, and
    /// of its shape.
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
        let start = M::default();
        let bytes = postcard::to_allocvec(&start)
            .map_err(|e| format!("the model cannot be serialized: {e}"))?;
        let layout = crc32fast::hash(&bytes) ^ shape::of(&start);
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
    use crate::legality::Phase;
    use crate::snapshot::Snapshot;
    use crate::{Clock, Log, Refusal, Step};
    use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
    use serde::{Deserialize, Serialize};

    macro_rules! model {
        ($name:ident) => {
            model! { $name stringify!($name), }
        };
        ($name:ident $called:expr, $($state:ident)*) => {
            #[derive(Clone, Serialize, Deserialize, Rows, Start)]
            struct $name {
                #[output(0)]
                x: f64,
                $($state: f64,)*
            }

            impl Declare for $name {
                const DESCRIPTION: Description<Self> = Description {
                    name: $called,
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
    model!(Tank "Tank", level speed);
    model!(TankLater "Tank", speed level);
    model!(TankRenamed "Tank", level flow);

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

    #[test]
    fn a_state_of_a_version_whose_hidden_states_changed_places_or_names_is_refused() {
        fn state<M: Model>() -> Snapshot<M> {
            Snapshot {
                phase: Phase::Instantiated,
                clock: Clock::default(),
                model: M::default(),
            }
        }
        let bytes = state::<Tank>().to_bytes().unwrap();
        assert!(Snapshot::<Tank>::from_bytes(&bytes).is_ok());
        assert_eq!(Tank::DESCRIPTION.guid(), TankLater::DESCRIPTION.guid());
        for refused in [
            Snapshot::<TankLater>::from_bytes(&bytes).err(),
            Snapshot::<TankRenamed>::from_bytes(&bytes).err(),
        ] {
            assert_eq!(
                refused.as_deref(),
                Some(
                    "serialized state: from another version of this FMU, with other internal states"
                )
            );
        }
    }
}
