//! Random calls on two instances of FMI 3.0, each made on an instance of FMI 2.0 too: both must accept and refuse the same,
//! with the same numbers and the same state, bit for bit. What FMI 2.0 does is held against the standard by
//! [`crate::sequence`].

use super::fmu::{Fmu, Row, Type, Value};
use super::instance::Instance;
use crate::Status;

/// A generator of numbers: xorshift64*.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % n
    }
}

/// One instance by each version, and where the next step begins.
struct Pair {
    two: crate::Instance,
    three: Instance,
    time: f64,
}

/// One call.
#[derive(Clone, Debug)]
enum Call {
    /// Start and stop time.
    Enter(f64, Option<f64>),
    Leave,
    Step(f64, f64),
    Terminate,
    Reset,
    Read(Row),
    Write(Row, Vec<Value>),
    /// To a slot, by FMI 3.0 if so.
    Save(usize, bool),
    Restore(usize),
}

/// What was played.
#[derive(Clone, Copy, Debug, Default)]
pub struct Played {
    /// Calls.
    pub calls: u64,
    /// Those that were accepted.
    pub accepted: u64,
    /// Steps that failed.
    pub broken: u64,
}

const SLOTS: usize = 3;

impl Pair {
    fn new(fmu: &Fmu) -> Self {
        Self {
            two: fmu.fmi2.instantiate(),
            three: fmu.instantiate(),
            time: 0.0,
        }
    }

    /// Makes the call on both: the two statuses.
    fn play(
        &mut self,
        call: &Call,
        slots: &mut [Option<(Vec<u8>, f64)>; SLOTS],
    ) -> Result<(Status, Status), String> {
        let statuses = match call {
            Call::Enter(start, stop) => {
                let set_up = self.two.setup_experiment(*start, *stop);
                let two = match set_up {
                    Status::OK => self.two.enter_initialization_mode(),
                    refused => refused,
                };
                (two, self.three.enter_initialization_mode(*start, *stop))
            }
            Call::Leave => (
                self.two.exit_initialization_mode(),
                self.three.exit_initialization_mode(),
            ),
            Call::Step(t, h) => (self.two.step(*t, *h), self.three.step(*t, *h)),
            Call::Terminate => (self.two.terminate(), self.three.terminate()),
            Call::Reset => (self.two.reset(), self.three.reset()),
            Call::Read(row) => {
                let (two, three) = (read(&self.two, row), self.three.read(row));
                // NaN of a failed sensor is equal to itself here.
                if format!("{two:?}") != format!("{three:?}") {
                    return Err(format!(
                        "{}: {two:?} by FMI 2.0, {three:?} by FMI 3.0",
                        row.name
                    ));
                }
                let status = two.err().unwrap_or(Status::OK);
                (status, status)
            }
            Call::Write(row, values) => {
                (write(&self.two, row, values), self.three.write(row, values))
            }
            Call::Save(slot, by_three) => {
                let bytes = if *by_three {
                    self.three.bytes()
                } else {
                    self.two.bytes()
                };
                slots[*slot] = Some((bytes, self.time));
                (Status::OK, Status::OK)
            }
            Call::Restore(slot) => match &slots[*slot] {
                None => (Status::OK, Status::OK),
                Some((bytes, time)) => {
                    self.time = *time;
                    (self.two.restore(bytes), self.three.restore(bytes))
                }
            },
        };
        match (call, statuses.0) {
            (Call::Step(t, h), Status::OK) => self.time = t + h,
            (Call::Enter(start, _), Status::OK) => self.time = *start,
            (Call::Reset, Status::OK) => self.time = 0.0,
            _ => {}
        }
        Ok(statuses)
    }
}

fn read(instance: &crate::Instance, row: &Row) -> Result<Vec<Value>, Status> {
    let references: Vec<_> = row
        .elements
        .iter()
        .map(|element| element.reference)
        .collect();
    Ok(match row.kind {
        Type::Float64 | Type::Float32 => instance
            .get_real(&references)?
            .into_iter()
            .map(Value::Number)
            .collect(),
        Type::UInt32 | Type::Int64 | Type::UInt64 | Type::Binary => {
            panic!("{}: FMI 2.0 has no such type", row.name)
        }
        Type::Int32 | Type::Enumeration | Type::Int8 | Type::UInt8 | Type::Int16 | Type::UInt16 => {
            let values = instance.get_integer(&references)?;
            values
                .into_iter()
                .map(|value| Value::Integer(value.into()))
                .collect()
        }
        Type::Boolean => {
            let values = instance.get_boolean(&references)?;
            values
                .into_iter()
                .map(|value| Value::Truth(value as u8))
                .collect()
        }
        Type::Text => references
            .iter()
            .map(|&one| Value::Text(instance.string(one)))
            .collect(),
    })
}

fn write(instance: &crate::Instance, row: &Row, values: &[Value]) -> Status {
    let references: Vec<_> = row
        .elements
        .iter()
        .map(|element| element.reference)
        .collect();
    let mut numbers = Vec::new();
    let mut integers = Vec::new();
    let mut status = Status::OK;
    for (value, &reference) in values.iter().zip(&references) {
        match value {
            Value::Number(value) => numbers.push(*value),
            Value::Integer(value) => integers.push(*value as i32),
            Value::Truth(value) => integers.push((*value).into()),
            Value::Text(text) => status = instance.set_string(reference, text),
            Value::Bytes(_) => panic!("{}: FMI 2.0 has no such type", row.name),
        }
    }
    match row.kind {
        Type::Float64 | Type::Float32 => instance.set_real(&references, &numbers),
        Type::Boolean => instance.set_boolean(&references, &integers),
        Type::Text => status,
        _ => instance.set_integer(&references, &integers),
    }
}

/// Values for a row, good ones mostly.
fn values(dice: &mut Dice, row: &Row) -> Vec<Value> {
    let bad = dice.below(40 * row.len());
    let value = |(i, element): (usize, &crate::Variable)| {
        let (low, high) = element.bounds.unwrap_or((-1.0, 1.0));
        let (low, high) = (low.max(-10.0).min(high), high.min(10.0).max(low));
        let share = dice.below(1000) as f64 / 999.0;
        match row.kind {
            Type::Float64 | Type::Float32 if i == bad => {
                Value::Number([f64::NAN, f64::INFINITY, 1e300][dice.below(3)])
            }
            Type::Float64 | Type::Float32 => Value::Number(low + share * (high - low)),
            Type::Int32 | Type::Enumeration if i == bad => {
                Value::Integer([i32::MIN, 77, 0][dice.below(3)].into())
            }
            Type::Boolean if i == bad => Value::Truth(2 + dice.below(254) as u8),
            Type::Boolean => Value::Truth(dice.below(2) as u8),
            Type::Text => Value::Text(["", "text", "ü"][dice.below(3)].into()),
            // What a small type does not hold cannot be passed by FMI 3.0, so that none of them is bad.
            _ => Value::Integer((low + share * (high - low)).round() as i128),
        }
    };
    row.elements.iter().enumerate().map(value).collect()
}

/// Plays `calls` random calls on two pairs.
///
/// # Errors
/// What the two versions did differently, at which call of which seed, and the calls before it.
pub fn play(fmu: &Fmu, calls: u64, seed: u64) -> Result<Played, String> {
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut pairs = [Pair::new(fmu), Pair::new(fmu)];
    let mut slots: [Option<(Vec<u8>, f64)>; SLOTS] = [const { None }; SLOTS];
    let mut played = Played::default();
    let mut journal: Vec<(usize, Call)> = Vec::new();
    for k in 0..calls {
        let which = dice.below(2);
        let pair = &mut pairs[which];
        let row = fmu.rows[dice.below(fmu.rows.len())].clone();
        let inputs: Vec<_> = fmu
            .rows
            .iter()
            .filter(|row| row.causality() == "input")
            .collect();
        let input = inputs[dice.below(inputs.len())].clone();
        let h = fmu.fmi2.step_size * [1.0, 1.0, 1.0, 2.0, 0.5, -1.0][dice.below(6)];
        let call = match dice.below(100) {
            0..8 => {
                let start = [0.0, 0.0, 5.0, f64::NAN][dice.below(4)];
                let steps = [-1.0, 3.0, 5.0, 1e6][dice.below(4)];
                let stop = start + steps * fmu.fmi2.step_size;
                Call::Enter(start, (dice.below(2) == 0).then_some(stop))
            }
            8..16 => Call::Leave,
            16..50 => Call::Step(pair.time + if dice.below(30) == 0 { 1.0 } else { 0.0 }, h),
            50 => Call::Terminate,
            51..54 => Call::Reset,
            54..64 => Call::Read(row),
            64..72 => Call::Write(row.clone(), values(&mut dice, &row)),
            72..90 => Call::Write(input.clone(), values(&mut dice, &input)),
            90..95 => Call::Save(dice.below(SLOTS), dice.below(2) == 0),
            _ => Call::Restore(dice.below(SLOTS)),
        };
        journal.push((which, call.clone()));
        let report = |what: String| {
            let last: Vec<_> = journal.iter().rev().take(12).rev().collect();
            format!(
                "{}, seed {seed}, call {k}: {what}; the last calls: {last:?}",
                fmu.name()
            )
        };
        let (two, three) = pair.play(&call, &mut slots).map_err(report)?;
        if two != three {
            let logs = (pair.two.messages(), pair.three.messages());
            return Err(report(format!(
                "{two:?} by FMI 2.0, {three:?} by FMI 3.0, {logs:?}"
            )));
        }
        let (state, also) = (pair.two.bytes(), pair.three.bytes());
        if state != also {
            let at = state
                .iter()
                .zip(&also)
                .position(|(one, other)| one != other);
            let logs = (pair.two.messages(), pair.three.messages());
            return Err(report(format!(
                "the states differ at byte {at:?}, {logs:?}"
            )));
        }
        played.calls += 1;
        played.accepted += u64::from(two == Status::OK);
        let (told, also) = (pair.two.messages(), pair.three.messages());
        if told.len() != also.len() {
            return Err(report(format!(
                "told {told:?} by FMI 2.0, {also:?} by FMI 3.0"
            )));
        }
        played.broken += u64::from(
            told.iter()
                .any(|message| message.text.contains("needs fmi2Reset")),
        );
    }
    Ok(played)
}
