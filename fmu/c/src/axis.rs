//! One axis: the law of TestbedController.fmu, for the four laws of the paper's family, in both forms.

use crate::Real;
use crate::pointer::{self, Cause, Place, initialize, read, refusing, with_law, zero};
use crate::refusal::{Bad, Refusal, Status, truths};
use crate::storage::{Storage, fits};
use crate::variable::{self, Variable};
use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters, NotFinite, OneAxis};
use core::mem::offset_of;
use core::ops::Range;
use fmu_declaration::Rows as _;

/// Memory of one axis's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
#[repr(C)]
pub struct AxisState {
    words: [u64; 128],
}

// SAFETY: plain words, enough of them, aligned as the law.
unsafe impl Storage for AxisState {
    type Law = OneAxis;
    const MARK: u64 = 0x6578_6f5f_6178_6932; // "exo_axi2"
}
const _: () = assert!(fits::<AxisState>());

/// What a tick that is refused leaves at 0: the force, and the velocity that a drive is told.
const TORQUES: [Range<usize>; 3] = [
    field(offset_of!(AxisOutputs, tau_a)),
    field(offset_of!(AxisOutputs, tau_demand)),
    field(offset_of!(AxisOutputs, dq_d)),
];

const fn field(offset: usize) -> Range<usize> {
    offset..offset + size_of::<Real>()
}

/// Writes the start values into `parameters`.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_defaults(parameters: *mut AxisParameters) -> Status {
    pointer::status(Place::at(parameters).map(|place| place.write(AxisParameters::default())))
}

/// Writes the start values into `inputs`: engaged, at zero.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_inputs_defaults(inputs: *mut AxisInputs) -> Status {
    pointer::status(Place::at(inputs).map(|place| place.write(AxisInputs::default())))
}

/// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
/// which, and `state` stays as it was.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_init(
    state: *mut AxisState,
    parameters: *const AxisParameters,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let (state, parameters) = (Place::at(state)?, read(parameters)?);
        initialize(state, OneAxis::new(&parameters).map_err(Bad::from)?);
        Ok(())
    })
}

/// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Of the parameters those count
/// that the FMU calls tunable; the others are as they were. Where a gain is refused, all stay as they were.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_tune(
    state: *mut AxisState,
    parameters: *const AxisParameters,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let parameters = read(parameters)?;
        with_law(state, |law| Ok(law.tune(&parameters).map_err(Bad::from)?))
    })
}

/// One tick, every T. Where the status is not 0, `state` stays as it was and `outputs` hold no torque: tau_a, tau_demand and
/// dq_d are 0, the others as they were; a drive so stands still at the last q_d. The robot is then the caller's: brakes, or whatever needs no law. `refusal`, which may
/// be null, says which input was refused.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_tick(
    state: *mut AxisState,
    inputs: *const AxisInputs,
    outputs: *mut AxisOutputs,
    refusal: *mut Refusal,
) -> Status {
    tick_after(state, None, inputs, outputs, refusal)
}

/// The same where the caller measures time: `dt` (s) is the time from the reading of the positions at the last tick to their
/// reading at this one. A tick that is late or early then sees the velocity that there was, and `timing` says so. What else
/// becomes of it: docs/real-time.md. A `dt` that is negative or not finite is refused.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_tick_after(
    state: *mut AxisState,
    dt: f64,
    inputs: *const AxisInputs,
    outputs: *mut AxisOutputs,
    refusal: *mut Refusal,
) -> Status {
    tick_after(state, Some(dt), inputs, outputs, refusal)
}

fn tick_after(
    state: *mut AxisState,
    dt: Option<f64>,
    inputs: *const AxisInputs,
    outputs: *mut AxisOutputs,
    refusal: *mut Refusal,
) -> Status {
    zero(outputs, &TORQUES);
    refusing(refusal, || {
        let (inputs, outputs) = (read(inputs)?, Place::at(outputs)?);
        truths(&inputs, AxisInputs::ROWS)?;
        let mut shown = AxisOutputs::default();
        with_law(state, |law| {
            let after = dt.map_or(Ok(1.0), |dt| Bad::periods(dt, law.T()))?;
            law.tick_after(after, &inputs, &mut shown)
                .map_err(|NotFinite| why_not_finite(&inputs))
        })?;
        outputs.write(shown);
        Ok(())
    })
}

/// Describes the variable number `i` of the structs of one axis, from 0: parameters, then inputs, then outputs.
#[unsafe(no_mangle)]
pub extern "C" fn exo_axis_variable(i: usize, variable: *mut Variable) -> Status {
    variable::describe::<AxisParameters, AxisInputs, AxisOutputs>(i, variable)
}

/// Why the result of a tick is not finite.
fn why_not_finite(inputs: &AxisInputs) -> Cause {
    Bad::sensed("q", &[inputs.q as Real])
        .or(Bad::sensed("tau_h", &[inputs.tau_h]))
        .or(Bad::sensed("tau_a_measured", &[inputs.tau_a_measured]))
        .map_or(Status::NotFinite.into(), Cause::from)
}
