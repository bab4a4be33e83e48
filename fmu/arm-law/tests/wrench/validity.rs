//! Each way to fail is named, within two samples of its onset, and lets no force through.

use crate::synthetic::Random;
use arm_law::wrench::validity::Checks;
use arm_law::wrench::{Conditioner, Fault, Sample, Sensor, Wrench};
use nalgebra::Vector3;

const T: f64 = 0.001;

fn checks() -> Checks {
    Checks {
        range_force: 200.0,
        range_torque: 20.0,
        rate_force: 2000.0,
        rate_torque: 200.0,
        stuck_samples: 2,
        dropout_samples: 2,
        recovery_time: 0.02,
    }
}

fn conditioner(checks: Checks) -> Conditioner {
    let sensor = Sensor {
        checks,
        ..Sensor::default()
    };
    Conditioner::new(sensor, T).unwrap()
}

/// A hand that pushes some newtons, as a sound sensor with noise shows it: bits differ from sample to sample.
fn sound(k: usize, random: &mut Random) -> Wrench {
    let t = k as f64 * T;
    Wrench {
        force: Vector3::new(9.0 * (5.0 * t).sin(), -6.0, 4.0 * t.cos()) + random.vector(0.05),
        torque: Vector3::new(0.4, -0.2, 0.3 * (3.0 * t).sin()) + random.vector(0.002),
    }
}

/// Codes and forces of `n` samples that `failing` makes from number, sound reading and the one before.
fn run(
    checks: Checks,
    n: usize,
    failing: impl Fn(usize, Wrench, Wrench) -> (Wrench, bool),
) -> Vec<(Option<Fault>, Vector3<f64>)> {
    let mut conditioner = conditioner(checks);
    let random = &mut Random(7);
    let mut before = Wrench::ZERO;
    (0..n)
        .map(|k| {
            let (wrench, valid) = failing(k, sound(k, random), before);
            before = wrench;
            let tick = conditioner.step(&Sample {
                wrench,
                valid,
                ..Sample::default()
            });
            (tick.fault, tick.hand.force)
        })
        .collect()
}

const ONSET: usize = 50;

/// A failure that begins at ONSET and stays must bear `name` from its second sample on.
fn named(fault: Fault, failing: impl Fn(Wrench, Wrench) -> (Wrench, bool)) {
    let ticks = run(checks(), 80, |k, sound, before| {
        if k < ONSET {
            (sound, true)
        } else {
            failing(sound, before)
        }
    });
    for (k, (found, force)) in ticks.into_iter().enumerate() {
        if k < ONSET {
            assert_eq!(found, None, "sample {k}");
            assert!(force.norm() > 1.0);
        } else if k > ONSET {
            assert_eq!(found, Some(fault), "sample {k}");
        }
        assert!(found.is_none() || force == Vector3::zeros(), "sample {k}");
    }
}

#[test]
fn every_component_that_is_not_finite_is_named() {
    for i in 0..6 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            named(Fault::NotFinite, |sound, _| {
                let mut components = sound.components();
                components[i] = value;
                (components.into(), true)
            });
        }
    }
}

#[test]
fn every_component_at_the_end_of_its_range_is_named() {
    for i in 0..6 {
        for sign in [1.0, -1.0] {
            named(Fault::OverRange, |sound, _| {
                let mut components = sound.components();
                components[i] = sign * if i < 3 { 200.0 } else { 20.0 };
                (components.into(), true)
            });
        }
    }
}

#[test]
fn a_reading_that_stays_bit_for_bit_is_named() {
    named(Fault::Stuck, |_, before| (before, true));
}

#[test]
fn a_reading_of_exactly_zero_is_named() {
    named(Fault::Dropout, |_, _| (Wrench::ZERO, true));
}

#[test]
fn the_sensors_own_word_is_believed() {
    named(Fault::Dropout, |sound, _| (sound, false));
}

#[test]
fn a_sensor_that_jumps_all_the_time_is_named() {
    let random = std::cell::RefCell::new(Random(8));
    named(Fault::Rate, |sound, before| {
        let sign = before.force.x.signum();
        let mut components = sound.components();
        components[0] = -sign * (30.0 + random.borrow_mut().within(1.0));
        (components.into(), true)
    });
}

#[test]
fn every_jump_is_named_at_once_and_for_the_recovery_time() {
    for i in 0..6 {
        let ticks = run(checks(), 100, |k, sound, _| {
            let mut components = sound.components();
            components[i] += if k >= ONSET && i < 3 {
                2.5
            } else if k >= ONSET {
                0.25
            } else {
                0.0
            };
            (components.into(), true)
        });
        let faulty: Vec<_> = (0..100).filter(|k| ticks[*k].0.is_some()).collect();
        // The jump itself, and 20 sound samples of which the last one ends it.
        assert_eq!(faulty, (ONSET..ONSET + 20).collect::<Vec<_>>());
        assert!(faulty.iter().all(|k| ticks[*k].0 == Some(Fault::Rate)));
    }
}

#[test]
fn the_way_back_does_not_rename_a_fault() {
    let ticks = run(checks(), 120, |k, sound, _| {
        if (50..60).contains(&k) {
            (Wrench::ZERO, true)
        } else {
            (sound, true)
        }
    });
    assert_eq!(ticks[50].0, Some(Fault::Rate)); // from 6 N to 0 in a sample
    for (k, tick) in ticks.iter().enumerate() {
        let expected = (51..80).contains(&k).then_some(Fault::Dropout);
        assert!(k == 50 || tick.0 == expected, "sample {k}: {:?}", tick.0);
    }
}

#[test]
fn a_fault_ends_when_the_signal_has_been_sound_for_the_recovery_time() {
    for n in 1..300 {
        let recovery_time = T * n as f64;
        let checks = Checks {
            recovery_time,
            ..checks()
        };
        // A second fault within the recovery starts it anew.
        let again = 1 + n / 2;
        let ticks = run(checks, 3 * n + 5, |k, sound, _| {
            (sound, k != 0 && k != again)
        });
        let faulty = ticks.iter().filter(|(fault, _)| fault.is_some()).count();
        assert_eq!(faulty, again + n, "{n} samples");
        assert!(ticks[faulty].0.is_none());
    }
}

#[test]
fn a_change_across_a_gap_is_no_jump() {
    let ticks = run(checks(), 120, |k, sound, _| {
        let mut components = sound.components();
        match k {
            50..60 => components[1] = f64::NAN,
            60.. => components[1] += 9.0,
            _ => {}
        }
        (components.into(), true)
    });
    let faulty: Vec<_> = (0..120).filter(|k| ticks[*k].0.is_some()).collect();
    assert_eq!(faulty, (50..79).collect::<Vec<_>>());
    assert!(faulty.iter().all(|k| ticks[*k].0 == Some(Fault::NotFinite)));
}

#[test]
fn a_sound_sensor_has_no_fault() {
    let ticks = run(checks(), 20_000, |_, sound, _| (sound, true));
    assert!(ticks.iter().all(|(fault, _)| fault.is_none()));
}

#[test]
fn what_is_off_finds_nothing_but_what_is_not_finite() {
    let off = Checks::default();
    let wild = |k: usize, _: Wrench, _: Wrench| {
        let component = match k % 4 {
            0 | 1 => 0.0,
            2 => 1e9,
            _ => -1e9,
        };
        ([component; 6].into(), true)
    };
    assert!(run(off, 100, wild).iter().all(|(fault, _)| fault.is_none()));
    let ticks = run(off, 1, |_, _, _| ([f64::NAN; 6].into(), true));
    assert_eq!(ticks[0].0, Some(Fault::NotFinite));
}

#[test]
fn numbers_and_names_belong_together() {
    let numbers: Vec<_> = Fault::ALL.map(|fault| fault.number()).to_vec();
    assert_eq!(numbers, [1, 2, 3, 4, 5]);
    assert_eq!(
        Fault::ALL.map(|fault| fault.name()),
        ["not_finite", "over_range", "rate", "stuck", "dropout"]
    );
}
