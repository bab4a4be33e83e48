//! The tare's life: requested, running, done; and every way to fail.

use crate::synthetic::Random;
use arm_law::wrench::tare::TareSettings;
use arm_law::wrench::validity::Checks;
use arm_law::wrench::{Conditioned, Conditioner, Sample, Sensor, TareFailure, TareState, Wrench};
use nalgebra::Vector3;

const T: f64 = 0.001;
const BIAS: [f64; 6] = [1.0, -2.0, 0.5, 0.1, -0.05, 0.02];
/// Samples of the tare: 0.1 s.
const N: usize = 100;

fn conditioner() -> Conditioner {
    let sensor = Sensor {
        checks: Checks {
            range_force: 300.0,
            ..Checks::default()
        },
        tare: TareSettings {
            time: N as f64 * T,
            ..TareSettings::default()
        },
        ..Sensor::default()
    };
    Conditioner::new(sensor, T).unwrap()
}

/// A tare from the first sample on; `at` changes the k-th sample.
fn tared(at: impl Fn(usize, &mut Sample)) -> (Conditioner, Vec<Conditioned>) {
    let mut conditioner = conditioner();
    let random = &mut Random(9);
    let ticks = (0..N + 20)
        .map(|k| {
            let mut sample = Sample {
                wrench: BIAS.map(|bias| bias + 0.02 * random.normal()).into(),
                tare: true,
                ..Sample::default()
            };
            at(k, &mut sample);
            conditioner.step(&sample)
        })
        .collect();
    (conditioner, ticks)
}

/// A tare that fails so, at sample `when`, and leaves the bias alone.
fn fails(failure: TareFailure, when: usize, at: impl Fn(usize, &mut Sample)) {
    let (conditioner, ticks) = tared(at);
    for (k, tick) in ticks.iter().enumerate() {
        let expected = if k < when {
            TareState::Running
        } else {
            TareState::Failed(failure)
        };
        assert_eq!(tick.tare, expected, "sample {k}");
    }
    assert_eq!(conditioner.bias(), Wrench::ZERO);
}

#[test]
fn a_tare_runs_for_its_time_and_then_has_the_bias() {
    let (conditioner, ticks) = tared(|_, _| ());
    for (k, tick) in ticks.iter().enumerate() {
        let done = k + 1 >= N;
        let expected = if done {
            TareState::Done
        } else {
            TareState::Running
        };
        assert_eq!(tick.tare, expected, "sample {k}");
        assert!(done || tick.hand == Wrench::ZERO);
        assert!(tick.hand.force.amax() < 0.1); // five standard deviations of the noise
    }
    let error = conditioner.bias() - BIAS.into();
    // σ/√n = 0.002 on each component, times five.
    assert!(error.components().iter().all(|x| x.abs() < 0.01));
}

#[test]
fn only_a_change_to_true_starts_one() {
    let mut conditioner = conditioner();
    let mut step = |tare: bool, force: f64| {
        conditioner
            .step(&Sample {
                wrench: [force; 6].into(),
                tare,
                ..Sample::default()
            })
            .tare
    };
    assert_eq!(step(false, 0.1), TareState::Off);
    let mut states: Vec<_> = (0..3 * N).map(|_| step(true, 0.1)).collect();
    assert_eq!(states.pop(), Some(TareState::Done));
    assert_eq!(
        states.iter().filter(|s| **s == TareState::Running).count(),
        N - 1
    );
    assert_eq!(step(false, 0.1), TareState::Done);
    assert_eq!(step(true, 0.3), TareState::Running);
    // Asking again while it runs neither restarts nor prolongs it.
    for k in 2..N {
        assert_eq!(step(k % 2 == 1, 0.3), TareState::Running);
    }
    assert_eq!(step(false, 0.3), TareState::Done);
    assert!((conditioner.bias().force - Vector3::repeat(0.3)).amax() < 1e-15); // rounding
}

#[test]
fn a_tare_fails_at_a_fault_and_at_the_end_of_the_range() {
    fails(TareFailure::Fault, 40, |k, sample| {
        if k == 40 {
            sample.wrench.torque.y = f64::NAN;
        }
    });
    fails(TareFailure::Fault, 40, |k, sample| {
        if k == 40 {
            sample.wrench.force.z = -300.0;
        }
    });
}

#[test]
fn a_tare_fails_when_any_joint_moves_either_way() {
    for joint in 0..3 {
        for sign in [1.0, -1.0] {
            // 19 mrad/s: 1.2 mrad after 63.2 samples.
            fails(TareFailure::Moved, 64, |k, sample| {
                sample.q[joint] = 1.0 + sign * 0.019 * T * k as f64;
            });
        }
    }
}

#[test]
fn a_tare_fails_when_any_component_scatters_or_drifts() {
    for i in 0..6 {
        let scale = if i < 3 { 1.0 } else { 0.1 };
        let add = |sample: &mut Sample, x: f64| {
            let mut components = sample.wrench.components();
            components[i] += scale * x;
            sample.wrench = components.into();
        };
        fails(TareFailure::Unsteady, N - 1, |k, sample| {
            add(sample, if k % 2 == 0 { 0.6 } else { -0.6 });
        });
        fails(TareFailure::Unsteady, N - 1, |k, sample| {
            add(sample, 2.0 * k as f64 / N as f64); // a ramp of 2 has a deviation of 2/√12 = 0.58
        });
    }
}

#[test]
fn a_tare_fails_when_somebody_leans_on_the_handle() {
    for i in 0..6 {
        fails(TareFailure::TooLarge, N - 1, |_, sample| {
            let mut components = sample.wrench.components();
            components[i] += if i < 3 { 25.0 } else { 2.5 };
            sample.wrench = components.into();
        });
    }
}

#[test]
fn a_tare_that_fails_keeps_the_bias_of_the_one_before() {
    let (mut conditioner, _) = tared(|_, _| ());
    let bias = conditioner.bias();
    let again = |tare: bool, force: f64| Sample {
        wrench: [force; 6].into(),
        tare,
        ..Sample::default()
    };
    conditioner.step(&again(false, 1.0));
    conditioner.step(&again(true, 1.0));
    let tick = conditioner.step(&again(true, f64::NAN));
    assert_eq!(tick.tare, TareState::Failed(TareFailure::Fault));
    assert_ne!(bias, Wrench::ZERO);
    assert_eq!(conditioner.bias(), bias);
}

#[test]
fn signals_beyond_the_numbers_fail_and_leave_no_bias_that_is_none() {
    fails(TareFailure::Unsteady, N - 1, |k, sample| {
        sample.wrench.torque.x = if k % 2 == 0 { 1e300 } else { -1e300 };
    });
}

#[test]
fn without_limits_any_finite_mean_is_a_bias_and_no_other() {
    let any = TareSettings {
        time: N as f64 * T,
        spread_force: 0.0,
        spread_torque: 0.0,
        max_force: 0.0,
        max_torque: 0.0,
        ..TareSettings::default()
    };
    let sensor = Sensor {
        tare: any,
        ..Sensor::default()
    };
    let last = |amplitude: f64| {
        let mut conditioner = Conditioner::new(sensor, T).unwrap();
        let ticks = (0..N).map(|k| {
            conditioner.step(&Sample {
                wrench: [if k % 2 == 0 { amplitude } else { -amplitude }; 6].into(),
                tare: true,
                ..Sample::default()
            })
        });
        ticks.last().unwrap().tare
    };
    assert_eq!(last(1e6), TareState::Done);
    assert_eq!(last(1e300), TareState::Failed(TareFailure::Unsteady));
}

#[test]
fn numbers_are_those_of_the_interface() {
    let states = [
        TareState::Off,
        TareState::Running,
        TareState::Done,
        TareState::Failed(TareFailure::Fault),
    ];
    assert_eq!(states.map(TareState::number), [0, 1, 2, 3]);
    let failures = [
        TareFailure::Fault,
        TareFailure::Moved,
        TareFailure::Unsteady,
        TareFailure::TooLarge,
    ];
    assert_eq!(failures.map(TareFailure::number), [1, 2, 3, 4]);
    assert_eq!(states[3].failure(), Some(TareFailure::Fault));
    assert_eq!(states[2].failure(), None);
}
