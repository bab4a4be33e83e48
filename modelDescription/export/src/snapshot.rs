//! FMU state: a copy of an instance, and its bytes.
//!
//! | offset | length | what |
//! |---|---|---|
//! | 0 | 8 | magic `FMI2STAT` |
//! | 8 | 4 | version of this format, little-endian |
//! | 12 | 38 | guid of the FMU, ASCII |
//! | 50 | 4 | CRC-32 of the model's start state as bytes, and of the names and types in it: changes with the layout of the state |
//! | 54 | 8 | length of the payload, little-endian |
//! | 62 | 4 | CRC-32 of the payload, little-endian |
//! | 66 | … | payload: phase, clock and the model, by serde and postcard (floats bit for bit) |

use crate::access::check;
use crate::clock::Clock;
use crate::identity::{self, Identity};
use crate::legality::Phase;
use crate::model::Model;
use crate::outputs::Outputs;
use fmu_declaration::Causality;
use serde::{Deserialize, Serialize};

const MAGIC: &[u8; 8] = b"FMI2STAT";
/// 2: the clock has the sum of the steps.
const VERSION: u32 = 2;
const GUID: std::ops::Range<usize> = 12..12 + identity::GUID;
const LAYOUT: usize = 50;
const LENGTH: usize = 54;
const CHECKSUM: usize = 62;
const HEADER: usize = 66;

/// Everything of an instance that a run depends on.
#[derive(Clone, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Snapshot<M: Model> {
    /// Phase of the life cycle.
    pub(crate) phase: Phase,
    /// Start time, current communication point and the steps between them.
    pub(crate) clock: Clock,
    /// The model with all parameters, inputs, outputs and states.
    pub(crate) model: M,
}

impl<M: Model> Snapshot<M> {
    /// The bytes.
    ///
    /// # Errors
    /// A sentence when the model's serialization fails.
    pub fn to_bytes(&self) -> Result<Vec<u8>, String> {
        let payload = postcard::to_allocvec(self)
            .map_err(|e| format!("the model cannot be serialized: {e}"))?;
        let mut bytes = Vec::with_capacity(HEADER + payload.len());
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        let own = Identity::of::<M>()?;
        bytes.extend_from_slice(own.guid().as_bytes());
        bytes.extend_from_slice(&own.layout.to_le_bytes());
        bytes.extend_from_slice(&(payload.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&crc32fast::hash(&payload).to_le_bytes());
        debug_assert_eq!(bytes.len(), HEADER);
        bytes.extend_from_slice(&payload);
        Ok(bytes)
    }

    /// Reads the bytes back, in this process or another. Bytes after the payload are ignored.
    ///
    /// # Errors
    /// A sentence that says what was expected and what came: too short, another magic, version, FMU or checksum.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        if bytes.len() < HEADER {
            return Err(format!(
                "serialized state: expected at least {HEADER} bytes, got {}",
                bytes.len()
            ));
        }
        if &bytes[..8] != MAGIC {
            return Err(
                "serialized state: these bytes are not an FMU state of this exporter".into(),
            );
        }
        let version = u32::from_le_bytes(word(bytes, 8));
        if version != VERSION {
            return Err(format!(
                "serialized state: expected format version {VERSION}, got {version}"
            ));
        }
        let (guid, own) = (String::from_utf8_lossy(&bytes[GUID]), Identity::of::<M>()?);
        if guid != own.guid() {
            return Err(format!(
                "serialized state: expected guid {}, got {guid} (another FMU or version)",
                own.guid()
            ));
        }
        if u32::from_le_bytes(word(bytes, LAYOUT)) != own.layout {
            return Err(
                "serialized state: from another version of this FMU, with other internal states"
                    .into(),
            );
        }
        let length = u64::from_le_bytes(word(bytes, LENGTH));
        let rest = &bytes[HEADER..];
        let Some(payload) = usize::try_from(length).ok().and_then(|n| rest.get(..n)) else {
            return Err(format!(
                "serialized state: expected {length} bytes after the header, got {}",
                rest.len()
            ));
        };
        let (expected, got) = (
            u32::from_le_bytes(word(bytes, CHECKSUM)),
            crc32fast::hash(payload),
        );
        if expected != got {
            return Err(format!(
                "serialized state: damaged, expected checksum {expected:08x}, got {got:08x}"
            ));
        }
        match postcard::take_from_bytes::<Self>(payload) {
            Ok((snapshot, [])) => snapshot.checked(),
            Ok((_, rest)) => Err(format!(
                "serialized state: {} bytes too many for this model",
                rest.len()
            )),
            Err(e) => Err(format!("serialized state: not a state of this model: {e}")),
        }
    }

    /// With numbers that a run can lead to, as far as calls check them or a step depends on them to end: bytes with a right
    /// checksum may still be forged.
    fn checked(self) -> Result<Self, String> {
        match self.objection() {
            Ok(()) => Ok(self),
            Err(reason) => Err(format!("serialized state: {reason}")),
        }
    }

    fn objection(&self) -> Result<(), String> {
        let initialized = !matches!(self.phase, Phase::Instantiated | Phase::InitializationMode);
        self.clock.check(initialized)?;
        for causality in [Causality::Parameter, Causality::Input] {
            check(&self.model, causality).map_err(|refusal| refusal.0)?;
        }
        // What a failed step left behind may be anything, and what comes before an initialization is built anew by it.
        if initialized && self.phase != Phase::Error {
            self.model.fits(&self.clock).map_err(|refusal| refusal.0)?;
            Outputs::new().check(&self.model)?;
        }
        Ok(())
    }
}

/// `N` bytes at `offset` of a slice that is long enough.
fn word<const N: usize>(bytes: &[u8], offset: usize) -> [u8; N] {
    let mut word = [0; N];
    word.copy_from_slice(&bytes[offset..offset + N]);
    word
}
