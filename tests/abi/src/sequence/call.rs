//! One call of a random sequence, and the number that stands for it.

use super::Subject;

/// A value to be set; `Text` picks one of [`TEXTS`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// For fmi2SetReal.
    Real(f64),
    /// For fmi2SetInteger.
    Integer(i32),
    /// For fmi2SetBoolean.
    Boolean(bool),
    /// For fmi2SetString.
    Text(usize),
}

/// Texts that are set.
pub const TEXTS: [&str; 3] = ["", "a label", "100% #r1# \u{fc}\u{65e5}"];

/// A call, or a few that belong together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Call {
    /// fmi2FreeInstance, and fmi2Instantiate of the one that takes its place.
    Renew,
    /// fmi2SetupExperiment
    Setup(f64),
    /// fmi2EnterInitializationMode
    Enter,
    /// fmi2ExitInitializationMode
    Exit,
    /// fmi2Terminate
    Terminate,
    /// fmi2Reset
    Reset,
    /// fmi2Set… of the variable at this position.
    Set(usize, Value),
    /// fmi2SetReal of all Real inputs to the largest numbers there are.
    Ruin,
    /// fmi2Get… of the variable at this position.
    Get(usize),
    /// fmi2GetReal of a variable and one that there is not.
    GetUnknown(usize),
    /// fmi2SetReal with null pointers.
    Null,
    /// fmi2DoStep: beside the expected time (s), step size (s).
    Step(f64, f64),
    /// fmi2GetFMUstate into a slot.
    Save(usize),
    /// fmi2SetFMUstate from a slot.
    Restore(usize),
    /// fmi2FreeFMUstate of a slot.
    Free(usize),
    /// fmi2SerializeFMUstate and fmi2DeSerializeFMUstate of a slot.
    ThroughBytes(usize),
    /// fmi2DeSerializeFMUstate of a slot's bytes with this one changed.
    Damaged(usize, usize),
    /// fmi2SetDebugLogging
    Logging(bool),
    /// Any function of the table with good arguments and no effect.
    Other(&'static str),
}

/// Slots for FMU states, shared by both instances.
pub const SLOTS: usize = 3;

/// Functions without an effect on the instance.
const OTHERS: [&str; 10] = [
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
    "fmi2SerializedFMUstateSize",
];

/// Takes one digit of a number with several.
fn digit(number: &mut u32, base: usize) -> usize {
    let base = base.max(1) as u32;
    let digit = *number % base;
    *number /= base;
    digit as usize
}

/// The instance (0 or 1) and the call that a number stands for. Good steps and settings are the most frequent.
pub fn decode(mut number: u32, subject: &Subject) -> (usize, Call) {
    let instance = digit(&mut number, 2);
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let kind = digit(&mut number, 64);
    let mut one_of = |values: &[f64]| values[digit(&mut number, values.len())];
    let period = subject.fmu.step_size;
    let call = match kind {
        0 => Call::Setup(one_of(&[0.0, 1.5, -2.0, nan, inf])),
        1..=6 => Call::Enter,
        7..=12 => Call::Exit,
        13 => Call::Terminate,
        14 => Call::Reset,
        15 => Call::Renew,
        16 => Call::Ruin,
        17..=33 => Call::Step(0.0, period * one_of(&[1.0, 0.1, 1.0 / 3.0, 1.5, 1.0, 2.0])),
        34 => Call::Step(0.0, one_of(&[0.0, -1.0, nan, inf, -inf, 5e-324])),
        35 => Call::Step(one_of(&[0.3, -0.3, nan, inf]), period),
        36..=47 => {
            let among = match kind {
                36..=43 => &subject.inputs,
                44..=45 => &subject.parameters,
                _ => &subject.all,
            };
            let position = among[digit(&mut number, among.len())];
            Call::Set(position, subject.value(position, digit(&mut number, 64)))
        }
        48..=51 => Call::Get(digit(&mut number, subject.fmu.variables.len())),
        52 => Call::GetUnknown(digit(&mut number, subject.fmu.variables.len())),
        53 => Call::Null,
        54..=55 => Call::Save(digit(&mut number, SLOTS)),
        56..=57 => Call::Restore(digit(&mut number, SLOTS)),
        58 => Call::Free(digit(&mut number, SLOTS)),
        59 => Call::ThroughBytes(digit(&mut number, SLOTS)),
        60 => Call::Damaged(digit(&mut number, SLOTS), number as usize),
        61 => Call::Logging(digit(&mut number, 2) == 0),
        _ => Call::Other(OTHERS[digit(&mut number, OTHERS.len())]),
    };
    (instance, call)
}
