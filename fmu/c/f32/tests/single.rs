//! Single precision against the law in double precision.

#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters};
use admittance_f64::{Admittance, Gains, Settings};
use exo_law_f32::axis::{AxisState, exo_axis_init, exo_axis_tick};
use exo_law_f32::refusal::Status;
use nalgebra::Vector1;
use std::mem::MaybeUninit;
use std::ptr::null_mut;

fn memory<X>() -> Box<X> {
    // SAFETY: the types of the interface are numbers, for which zeros are a value.
    Box::new(unsafe { MaybeUninit::<X>::zeroed().assume_init() })
}

/// Largest difference of the forces (N) over 10 s of a motion about `place` (m), and the largest force.
fn difference(place: f64) -> (f64, f64) {
    let mut state = memory::<AxisState>();
    let status = exo_axis_init(&mut *state, &AxisParameters::default(), null_mut());
    assert_eq!(status, Status::Ok);
    let gains = Gains {
        M_n: 5.0,
        D_n: 0.5,
        K: 30.0,
        K_P: 10.0,
        f_max: 12.5,
    };
    let mut exact = Admittance::new(Settings::default(), [gains]).expect("valid");
    let mut outputs = memory::<AxisOutputs>();
    let (mut largest, mut force) = (0.0_f64, 0.0_f64);
    for k in 0..5_000 {
        let t = f64::from(k) * 0.002;
        let inputs = AxisInputs {
            q: place + 0.1 * (0.9 * t).sin(),
            tau_h: (6.0 * (0.7 * t).sin()) as f32,
            ..AxisInputs::default()
        };
        let status = exo_axis_tick(&mut *state, &inputs, &mut *outputs, null_mut());
        assert_eq!(status, Status::Ok);
        let tick = exact.step(&Vector1::new(inputs.q), &Vector1::new(inputs.tau_h.into()));
        largest = largest.max((f64::from(outputs.tau_a) - tick.f.x).abs());
        force = force.max(tick.f.x.abs());
    }
    (largest, force)
}

#[test]
fn the_force_does_not_lose_digits_far_from_zero() {
    // 1e-3 f_max is what the issue asks for. At 1 km a float's step is 6e-5 m: dq would be wrong by 0.03 m/s, the force
    // by 1 N, were positions not counted from where the law engaged.
    for place in [0.0, 0.3, 1_000.0] {
        let (largest, force) = difference(place);
        assert!(force > 5.0);
        assert!(
            largest > 0.0 && largest <= 1e-3 * 12.5,
            "{place} m: {largest} N"
        );
    }
}
