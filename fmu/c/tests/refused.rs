//! A tick that is refused leaves no torque in the outputs, so that a program that does not look at the status writes none.

#![allow(non_snake_case, reason = "the paper's symbols")]

#[cfg(feature = "f32")]
use exo_law_f32 as exo_law;

use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters};
use arm_law::{ArmInputs, ArmOutputs, ArmParameters};
use exo_law::arm::{ArmState, exo_arm_init, exo_arm_tick};
use exo_law::axis::{AxisState, exo_axis_init, exo_axis_tick};
use exo_law::refusal::{Refusal, Status};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

fn memory<T>() -> Box<T> {
    // SAFETY: the types of the interface are numbers, for which zeros are a value.
    Box::new(unsafe { MaybeUninit::<T>::zeroed().assume_init() })
}

/// What is done wrong, and how that is refused.
type Spoilt<T> = (fn(&mut T), Status);

/// A place where no refusal can be written.
fn askew() -> *mut Refusal {
    std::ptr::without_provenance_mut(align_of::<Refusal>() + 1)
}

/// An arm's law that pushes: state, what went in, what came out.
fn pushing_arm() -> (Box<ArmState>, ArmInputs, Box<ArmOutputs>) {
    let (mut state, mut outputs) = (memory(), memory::<ArmOutputs>());
    let status = exo_arm_init(&mut *state, &ArmParameters::default(), null_mut());
    assert_eq!(status, Status::Ok);
    let inputs = ArmInputs {
        f_h: [5.0, 2.0, -3.0],
        ..ArmInputs::default()
    };
    for _ in 0..100 {
        let status = exo_arm_tick(&mut *state, &inputs, &mut *outputs, null_mut());
        assert_eq!(status, Status::Ok);
    }
    let ArmOutputs {
        tau_a,
        f_a,
        tau_demand,
        ..
    } = *outputs;
    let all = [tau_a, f_a, tau_demand].concat();
    assert!(all.iter().all(|torque| *torque != 0.0), "{all:?}");
    (state, inputs, outputs)
}

#[test]
fn a_refused_tick_of_the_arm_leaves_no_torque_and_the_next_one_goes_on() {
    let refused: [Spoilt<ArmInputs>; 3] = [
        (|i| i.q[1] = f64::NAN, Status::Refused),
        (|i| i.q[2] = f64::INFINITY, Status::Refused),
        (|i| i.engage = 2, Status::Refused),
    ];
    for (spoil, expected) in refused {
        let (mut state, inputs, mut outputs) = pushing_arm();
        let before = *outputs;
        let mut bad = inputs;
        spoil(&mut bad);
        let status = exo_arm_tick(&mut *state, &bad, &mut *outputs, null_mut());
        assert_eq!(status, expected);
        let without = ArmOutputs {
            tau_a: [0.0; 3],
            f_a: [0.0; 3],
            tau_demand: [0.0; 3],
            ..before
        };
        assert_eq!(*outputs, without);

        let (mut other, mut wanted) = (pushing_arm().0, memory());
        exo_arm_tick(&mut *other, &inputs, &mut *wanted, null_mut());
        let status = exo_arm_tick(&mut *state, &inputs, &mut *outputs, null_mut());
        assert_eq!((status, *outputs), (Status::Ok, *wanted));
    }
}

#[test]
fn a_call_of_the_arm_with_a_bad_pointer_leaves_no_torque() {
    let mut nothing = memory::<ArmState>();
    for (which, expected) in [
        (0, Status::Null),
        (1, Status::Null),
        (2, Status::Misaligned),
        (3, Status::NotInitialized),
    ] {
        let (mut state, inputs, mut outputs) = pushing_arm();
        let (state, inputs, refusal): (*mut ArmState, *const ArmInputs, _) = match which {
            0 => (null_mut(), &raw const inputs, null_mut()),
            1 => (&raw mut *state, null(), null_mut()),
            2 => (&raw mut *state, &raw const inputs, askew()),
            _ => (&raw mut *nothing, &raw const inputs, null_mut()),
        };
        let status = exo_arm_tick(state, inputs, &mut *outputs, refusal);
        assert_eq!(status, expected);
        let all = [outputs.tau_a, outputs.f_a, outputs.tau_demand].concat();
        assert!(all.iter().all(|torque| *torque == 0.0), "{all:?}");
    }
}

#[test]
fn a_refused_tick_of_an_axis_leaves_no_force_and_the_next_one_goes_on() {
    let pushing = || {
        let (mut state, mut outputs) = (memory::<AxisState>(), memory::<AxisOutputs>());
        let status = exo_axis_init(&mut *state, &AxisParameters::default(), null_mut());
        assert_eq!(status, Status::Ok);
        let inputs = AxisInputs {
            tau_h: 3.0,
            ..AxisInputs::default()
        };
        for _ in 0..100 {
            exo_axis_tick(&mut *state, &inputs, &mut *outputs, null_mut());
        }
        assert!(outputs.tau_a != 0.0 && outputs.tau_demand != 0.0);
        (state, inputs, outputs)
    };
    let refused: [Spoilt<AxisInputs>; 3] = [
        (|i| i.q = f64::NAN, Status::Refused),
        (|i| i.tau_h = admittance::Real::INFINITY, Status::Refused),
        (|i| i.hold = -1, Status::Refused),
    ];
    for (spoil, expected) in refused {
        let (mut state, inputs, mut outputs) = pushing();
        let before = *outputs;
        let mut bad = inputs;
        spoil(&mut bad);
        let status = exo_axis_tick(&mut *state, &bad, &mut *outputs, askew());
        assert_eq!(status, Status::Misaligned);
        assert!(outputs.tau_a == 0.0 && outputs.tau_demand == 0.0);
        *outputs = before;
        let status = exo_axis_tick(&mut *state, &bad, &mut *outputs, null_mut());
        assert_eq!(status, expected);
        let without = AxisOutputs {
            tau_a: 0.0,
            tau_demand: 0.0,
            dq_d: 0.0,
            ..before
        };
        assert_eq!(*outputs, without);

        let (mut other, mut wanted) = (pushing().0, memory());
        exo_axis_tick(&mut *other, &inputs, &mut *wanted, null_mut());
        let status = exo_axis_tick(&mut *state, &inputs, &mut *outputs, null_mut());
        assert_eq!((status, *outputs), (Status::Ok, *wanted));
    }
}
