//! The law of ArmController.fmu.
//!
//! | module | what |
//! |---|---|
//! | [`parameters`] | what it is built from, and the start values |
//! | [`force_sensor`] | the part of them that is about the hand's force sensor |
//! | [`joint`] | the part about the joint-space form |
//! | [`supervision`] | the part about supervision, and what it is told |
//! | [`signals`] | inputs and outputs of a tick |

pub mod force_sensor;
pub mod joint;
pub mod parameters;
pub mod signals;
pub mod supervision;

use crate::Real;
use crate::gains::{ArmGains, limited_under};
use crate::origin::{Move, Origin};
use crate::pointer::{self, Cause, Place, initialize, read, refusing, with_law};
use crate::refusal::{Bad, Refusal, Status, truth};
use crate::storage::{Storage, fits};
use admittance::Law;
use arm_law::ArmLaw;
use arm_law::arm_law::{self as law, Space};
use force_sensor::Source;
use joint::ArmJointGains;
use nalgebra::Vector3;
use parameters::{ArmParameters, bad};
use signals::{ArmInputs, ArmOutputs};

/// Memory of an arm's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
#[repr(C)]
pub struct ArmState {
    words: [u64; 512],
}

// SAFETY: plain words, enough of them, aligned as the law.
unsafe impl Storage for ArmState {
    type Law = Arm;
    const MARK: u64 = 0x6578_6f5f_6172_6d31; // "exo_arm1"
}
const _: () = assert!(fits::<ArmState>());

/// The law between two ticks.
#[derive(Clone, Copy)]
pub struct Arm {
    law: ArmLaw,
    kind: Law,
    space: Space,
    source: Source,
    tau_max: [Real; 3],
    origin: Origin<3>,
}

impl Arm {
    fn new(parameters: &ArmParameters) -> Result<Self, Bad> {
        let of_law = parameters.of_law()?;
        Ok(Self {
            law: ArmLaw::new(&of_law).map_err(bad)?,
            kind: of_law.settings.law,
            space: of_law.space,
            source: parameters.ft.source()?,
            tau_max: parameters.tau_max,
            origin: Origin::default(),
        })
    }

    fn tune(&mut self, gains: &ArmGains) -> Result<(), Bad> {
        let kind = self.kind;
        let gains = gains.of_law().map(|gains| limited_under(kind, gains));
        self.law.tune(gains).map_err(bad)
    }

    fn tune_joints(&mut self, gains: &ArmJointGains) -> Result<(), Bad> {
        let gains = gains.of_law(&self.tau_max);
        self.law.tune_joints(gains).map_err(bad)
    }

    fn tick(&mut self, inputs: &ArmInputs) -> Result<ArmOutputs, Cause> {
        let mut next = *self;
        let q = Vector3::from(inputs.q);
        // In joint space the law counts from zero: the nominal arm is one at the angles themselves.
        let engage = truth("engage", inputs.engage)? && self.space == Space::Task;
        if let Some(Move { q_0, .. }) = next.origin.moves(&q, engage) {
            next.law
                .count_from(&q_0)
                .map_err(|_| inputs.why_not_finite())?;
        }
        let told = inputs.of_law(next.origin.counted(&q), self.source)?;
        let mut outputs = law::Outputs::default();
        next.law
            .tick(&told, &mut outputs)
            .map_err(|law::NotFinite| inputs.why_not_finite())?;
        next.origin.ticked(outputs.outcome.engaged);
        *self = next;
        Ok(ArmOutputs::of_tick(&self.law, &outputs))
    }
}

/// Writes the start values into `parameters`.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_defaults(parameters: *mut ArmParameters) -> Status {
    pointer::status(Place::at(parameters).map(|place| place.write(ArmParameters::default())))
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
        initialize(state, Arm::new(&parameters)?);
        Ok(())
    })
}

/// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Where one is refused, the
/// gains stay as they were.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_tune(
    state: *mut ArmState,
    gains: *const ArmGains,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let gains = read(gains)?;
        with_law(state, |arm| Ok(arm.tune(&gains)?))
    })
}

/// Other gains of the joint-space form, likewise.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_tune_joints(
    state: *mut ArmState,
    gains: *const ArmJointGains,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let gains = read(gains)?;
        with_law(state, |arm| Ok(arm.tune_joints(&gains)?))
    })
}

/// One tick, every T. Where the status is not 0, `outputs` and `state` stay as they were; `refusal`, which may be null, says
/// which input was refused.
#[unsafe(no_mangle)]
pub extern "C" fn exo_arm_tick(
    state: *mut ArmState,
    inputs: *const ArmInputs,
    outputs: *mut ArmOutputs,
    refusal: *mut Refusal,
) -> Status {
    refusing(refusal, || {
        let (inputs, outputs) = (read(inputs)?, Place::at(outputs)?);
        outputs.write(with_law(state, |arm| arm.tick(&inputs))?);
        Ok(())
    })
}
