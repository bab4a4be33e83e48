//! The law of ArmController.fmu.

use crate::Real;
use crate::pointer::{self, Cause, Place, initialize, read, refusing, with_law, zero};
use crate::refusal::{Bad, Refusal, Status, truths};
use crate::storage::{Storage, fits};
use crate::variable::{self, Variable};
use arm_law::arm_law::NotFinite;
use arm_law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use core::mem::offset_of;
use core::ops::Range;
use fmu_declaration::Rows as _;

/// Memory of an arm's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
#[repr(C)]
pub struct ArmState {
    words: [u64; 640],
}

// SAFETY: plain words, enough of them, aligned as the law.
unsafe impl Storage for ArmState {
    type Law = ArmLaw;
    const MARK: u64 = 0x6578_6f5f_6172_6d33; // "exo_arm3"
}
const _: () = assert!(fits::<ArmState>());

/// What a tick that is refused leaves at 0: the torques, and the velocities that drives are told.
const TORQUES: [Range<usize>; 4] = [
    field(offset_of!(ArmOutputs, tau_a)),
    field(offset_of!(ArmOutputs, f_a)),
    field(offset_of!(ArmOutputs, tau_demand)),
    field(offset_of!(ArmOutputs, dq_d)),
];

const fn field(offset: usize) -> Range<usize> {
    offset..offset + size_of::<[Real; 3]>()
}

/// Writes the start values into `parameters`.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_defaults(parameters: *mut ArmParameters) -> Status {
    pointer::status(Place::at(parameters).map(|place| place.write(ArmParameters::default())))
}

/// Writes the start values into `inputs`: engaged, with good sensors, not enabled.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_inputs_defaults(inputs: *mut ArmInputs) -> Status {
    pointer::status(Place::at(inputs).map(|place| place.write(ArmInputs::default())))
}

/// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
/// which, and `state` stays as it was.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_init(
    state: *mut ArmState,
    parameters: *const ArmParameters,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let (state, parameters) = (Place::at(state)?, read(parameters)?);
        initialize(state, ArmLaw::new(&parameters).map_err(Bad::from)?);
        Ok(())
    })
}

/// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Of the parameters those count
/// that the FMU calls tunable; the others are as they were. Where a gain is refused, all stay as they were.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_tune(
    state: *mut ArmState,
    parameters: *const ArmParameters,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let parameters = read(parameters)?;
        with_law(state, |law| Ok(law.tune(&parameters).map_err(Bad::from)?))
    })
}

/// One tick, every T. Where the status is not 0, `state` stays as it was and `outputs` hold no torque: tau_a, f_a, tau_demand
/// and dq_d are 0, the others as they were; drives so stand still at the last q_d. The robot is then the caller's: brakes, or whatever needs no law. `refusal`, which may
/// be null, says which input was refused.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_tick(
    state: *mut ArmState,
    inputs: *const ArmInputs,
    outputs: *mut ArmOutputs,
    refusal: *mut Refusal,
) -> Status {
    tick_after(state, None, inputs, outputs, refusal)
}

/// The same where the caller measures time: `dt` (s) is the time from the reading of the positions at the last tick to their
/// reading at this one. A tick that is late or early then sees the velocity that there was, and `timing` says so. What else
/// becomes of it: docs/real-time.md. A `dt` that is negative or not finite is refused.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_tick_after(
    state: *mut ArmState,
    dt: f64,
    inputs: *const ArmInputs,
    outputs: *mut ArmOutputs,
    refusal: *mut Refusal,
) -> Status {
    tick_after(state, Some(dt), inputs, outputs, refusal)
}

fn tick_after(
    state: *mut ArmState,
    dt: Option<f64>,
    inputs: *const ArmInputs,
    outputs: *mut ArmOutputs,
    refusal: *mut Refusal,
) -> Status {
    zero(outputs, &TORQUES);
    refusing(refusal, || {
        let (inputs, outputs) = (read(inputs)?, Place::at(outputs)?);
        truths(&inputs, ArmInputs::ROWS)?;
        let mut shown = ArmOutputs::default();
        with_law(state, |law| {
            let after = dt.map_or(Ok(1.0), |dt| Bad::periods(dt, law.T()))?;
            law.tick_after(after, &inputs, &mut shown)
                .map_err(|NotFinite| why_not_finite(&inputs))
        })?;
        outputs.write(shown);
        Ok(())
    })
}

/// Describes the variable number `i` of the structs of the arm, from 0: parameters, then inputs, then outputs.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_variable(i: usize, variable: *mut Variable) -> Status {
    variable::describe::<ArmParameters, ArmInputs, ArmOutputs>(i, variable)
}

/// Why the result of a tick is not finite.
fn why_not_finite(inputs: &ArmInputs) -> Cause {
    Bad::sensed("q", &inputs.q.map(|q| q as Real))
        .or(Bad::sensed("tau_a_measured", &inputs.tau_a_measured))
        .map_or(Status::NotFinite.into(), Cause::from)
}
