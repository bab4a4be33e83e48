//! What a host with floating-point traps sees of single precision: nothing. Double precision is tried in the FMUs,
//! `tests/abi/tests/floating_point.rs`.
#![cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]

use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters, OneAxis};
use arm_law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use std::ffi::c_int;

#[link(name = "m")]
unsafe extern "C" {
    safe fn feclearexcept(exceptions: c_int) -> c_int;
    safe fn fetestexcept(exceptions: c_int) -> c_int;
}

/// FE_INVALID, FE_DIVBYZERO and FE_OVERFLOW.
const TRAPPED: c_int = 1 | 4 | 8;

fn raises_nothing(what: &str, call: impl FnOnce()) {
    feclearexcept(TRAPPED);
    call();
    assert_eq!(fetestexcept(TRAPPED), 0, "{what}");
}

/// At rest, pushed along one axis, pushed along all, at rest.
fn push(k: i32) -> [f32; 3] {
    match k {
        10..20 => [0.0, 0.0, -800.0],
        20..30 => [5.0, -30.0, 40.0],
        _ => [0.0; 3],
    }
}

#[test]
fn the_arm_s_law_raises_nothing() {
    for law in 1..=4 {
        for space in [1, 2] {
            for alpha in [0.0, 1.0] {
                for tau_rate in [0.0, 500.0] {
                    let mut parameters = ArmParameters::default();
                    (parameters.law, parameters.space, parameters.alpha) = (law, space, alpha);
                    parameters.tau_rate_max = [tau_rate, 0.0, tau_rate];
                    (parameters.ft.deadband, parameters.stiff_hand.active) = (1.0, 1);
                    raises_nothing(&format!("law {law}, space {space}, alpha {alpha}"), || {
                        let mut law = ArmLaw::new(&parameters).expect("accepted");
                        let (mut inputs, mut outputs) =
                            (ArmInputs::default(), ArmOutputs::default());
                        for k in 0..40 {
                            inputs.f_h = push(k);
                            inputs.q[1] += 1e-4 * f64::from(k % 3);
                            law.tick(&inputs, &mut outputs).expect("finite");
                        }
                        assert!(outputs.engaged != 0);
                    });
                }
            }
        }
    }
}

#[test]
fn the_law_of_one_axis_raises_nothing() {
    for law in 1..=4 {
        for alpha in [0.0, 1.0] {
            for tau_rate_max in [0.0, 20.0] {
                let parameters = AxisParameters {
                    law,
                    alpha,
                    tau_rate_max,
                    ..AxisParameters::default()
                };
                raises_nothing(
                    &format!("law {law}, alpha {alpha}, rate {tau_rate_max}"),
                    || {
                        let mut law = OneAxis::new(&parameters).expect("accepted");
                        let (mut inputs, mut outputs) =
                            (AxisInputs::default(), AxisOutputs::default());
                        for k in 0..40 {
                            inputs.tau_h = push(k)[2];
                            inputs.q += 1e-4 * f64::from(k % 3);
                            law.tick(&inputs, &mut outputs).expect("finite");
                        }
                        assert!(outputs.engaged != 0);
                    },
                );
            }
        }
    }
}
