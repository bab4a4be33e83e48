//! The checks of sensed positions, one axis: 1 m/s at 10 ms is 10 mm a sample.

use admittance::Reach;
use admittance::encoder::{Believed, Checks, Encoders, Fault, Positions};
use nalgebra::Vector1;

const T: f64 = 0.01;

fn encoders(change: impl FnOnce(&mut Checks<1>)) -> Encoders<1> {
    let mut checks = Checks {
        range: Vector1::new(2.0),
        stuck: Vector1::new(0.0),
        samples: 3,
    };
    change(&mut checks);
    let reach = Reach {
        v_max: Vector1::new(1.0),
        a_max: Vector1::new(f64::INFINITY),
    };
    Encoders::new(checks, &reach, T)
}

fn positions(q: f64) -> Positions<1> {
    Positions {
        q: Vector1::new(q),
        valid: true,
        after: 1.0,
    }
}

fn read(encoders: &mut Encoders<1>, q: f64) -> Believed<1> {
    at(encoders, &positions(q), true, 0.0)
}

/// As the laws do: what is sound is kept, what is not is read.
fn at(
    encoders: &mut Encoders<1>,
    reading: &Positions<1>,
    in_loop: bool,
    force: f64,
) -> Believed<1> {
    if encoders.is_sound(reading) {
        encoders.keep(reading);
        return reading.believed();
    }
    encoders.read(reading, in_loop, &Vector1::new(force))
}

fn told(believed: &Believed<1>) -> Option<f64> {
    believed.q.map(|q| q.x)
}

#[test]
fn readings_that_follow_one_another_are_believed_to_the_bit() {
    let mut encoders = encoders(|_| ());
    for q in [0.3, 0.31, 0.3, 0.295, 0.305, 1.0 / 3.0 - 0.02] {
        let believed = read(&mut encoders, q);
        assert_eq!(
            (told(&believed), believed.doubted, believed.fault),
            (Some(q), false, None)
        );
    }
}

#[test]
fn a_jump_is_doubted_and_the_position_goes_on_as_it_moved() {
    let mut encoders = encoders(|_| ());
    read(&mut encoders, 0.5);
    read(&mut encoders, 0.504);
    for expected in [0.508, 0.512] {
        let believed = read(&mut encoders, 1.2);
        assert!(believed.doubted);
        assert_eq!(believed.fault, Some(Fault::Jump));
        assert!((told(&believed).unwrap() - expected).abs() < 1e-15);
    }
    // The way back: within a sample's way of where the position has gone on to.
    let believed = read(&mut encoders, 0.515);
    assert_eq!(
        (told(&believed), believed.doubted, believed.fault),
        (Some(0.515), false, None)
    );
}

#[test]
fn a_jump_that_stays_is_a_fault_until_as_many_readings_have_followed_one_another() {
    let mut encoders = encoders(|_| ());
    read(&mut encoders, 0.5);
    let mut seen = Vec::new();
    for q in [1.2, 1.21, 1.2, 1.2, 0.2, 0.2, 0.2, 0.2] {
        let believed = read(&mut encoders, q);
        seen.push((told(&believed), believed.fault));
    }
    let jump = Some(Fault::Jump);
    assert_eq!(
        seen,
        [
            (Some(0.5), jump), // doubted
            (Some(0.5), jump), // doubted
            (None, jump),      // the third
            (None, jump),      // one that follows
            (None, jump),      // one that does not
            (None, jump),
            (None, jump),
            (Some(0.2), None),
        ]
    );
}

#[test]
fn out_of_the_loop_a_jump_is_named_and_taken_over() {
    let mut encoders = encoders(|_| ());
    let mut at_rest = |q| at(&mut encoders, &positions(q), false, 0.0);
    at_rest(0.5);
    let believed = at_rest(1.2);
    assert_eq!(
        (told(&believed), believed.doubted, believed.fault),
        (Some(1.2), false, Some(Fault::Jump))
    );
    assert_eq!(at_rest(1.2).fault, None);
}

#[test]
fn a_position_that_cannot_be_is_over_range_however_it_was_reached() {
    let mut encoders = encoders(|_| ());
    read(&mut encoders, 1.999);
    for q in [2.001, 2.001] {
        let believed = read(&mut encoders, q);
        assert_eq!(
            (believed.doubted, believed.fault),
            (true, Some(Fault::OverRange))
        );
    }
    assert_eq!(told(&read(&mut encoders, 2.001)), None);
    let mut fresh = encoders_of_the_test();
    assert_eq!(told(&read(&mut fresh, 1e300)), None); // nothing to go on from
}

fn encoders_of_the_test() -> Encoders<1> {
    encoders(|_| ())
}

#[test]
fn a_position_that_stands_still_while_its_force_changes_is_stuck_until_it_moves() {
    let mut encoders = encoders(|checks| checks.stuck.x = 4.0);
    let mut with = |q, force| at(&mut encoders, &positions(q), true, force);
    for force in [0.0, 2.0, 3.9, 1.0, -3.9] {
        assert_eq!(with(0.5, force).fault, None, "{force}");
    }
    let believed = with(0.5, -4.0);
    assert_eq!(
        (told(&believed), believed.fault),
        (None, Some(Fault::Stuck))
    );
    for _ in 0..5 {
        assert_eq!(with(0.5, 0.0).fault, Some(Fault::Stuck));
    }
    for q in [0.501, 0.502] {
        assert_eq!(with(q, 0.0).fault, Some(Fault::Stuck));
    }
    assert_eq!(with(0.503, 0.0).fault, None);
}

#[test]
fn what_is_marked_invalid_or_is_no_number_is_not_known_for_as_long_as_that_lasts() {
    for (bad, fault) in [
        (
            Positions {
                valid: false,
                ..positions(0.5)
            },
            Fault::Invalid,
        ),
        (positions(f64::NAN), Fault::NotFinite),
        (positions(f64::INFINITY), Fault::NotFinite),
    ] {
        let mut encoders = encoders(|_| ());
        read(&mut encoders, 0.5);
        let believed = at(&mut encoders, &bad, true, 0.0);
        assert_eq!((told(&believed), believed.fault), (None, Some(fault)));
        assert_eq!(told(&read(&mut encoders, 1.7)), Some(1.7)); // wherever it is then
    }
}

#[test]
fn a_reading_that_is_old_may_have_moved_as_far_as_its_age_allows() {
    let aged = |after, q| Positions {
        after,
        ..positions(q)
    };
    let mut encoders = encoders(|_| ());
    let mut read = |positions| at(&mut encoders, &positions, true, 0.0);
    read(aged(1.0, 0.5));
    let moved = read(aged(3.0, 0.53));
    assert_eq!((told(&moved), moved.fault), (Some(0.53), None));
    // 10 mm a tick: three ticks further on.
    let doubted = read(aged(3.0, 0.7));
    assert!((told(&doubted).unwrap() - 0.56).abs() < 1e-15);
    assert_eq!(read(aged(2.0, 0.575)).fault, None);
}

#[test]
fn a_reading_that_comes_early_may_have_moved_as_far_as_one_in_time() {
    // What a clock says of a few microseconds is not what a jump is judged by.
    let mut encoders = encoders(|_| ());
    for (after, q) in [(1.0, 0.5), (0.0, 0.505), (1e-9, 0.51), (1.0, 0.515)] {
        let reading = Positions {
            after,
            ..positions(q)
        };
        assert_eq!(
            at(&mut encoders, &reading, true, 0.0).fault,
            None,
            "{after}"
        );
    }
}

#[test]
fn without_samples_jumps_are_believed_and_the_range_still_counts() {
    let mut encoders = encoders(|checks| checks.samples = 0);
    for q in [0.5, 1.5, -1.5] {
        assert_eq!(told(&read(&mut encoders, q)), Some(q));
    }
    assert_eq!(told(&read(&mut encoders, 2.5)), None);
    assert_eq!(told(&read(&mut encoders, 1.5)), Some(1.5));
}

#[test]
fn every_fault_has_a_number_and_a_name_of_its_own() {
    for (number, fault) in (1..).zip(Fault::ALL) {
        assert_eq!(fault.number(), number);
    }
    let mut names = Fault::ALL.map(Fault::name);
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn a_robot_that_really_is_faster_than_it_should_be_is_believed() {
    // 0.2 mm more in each sample, on from 10 mm.
    let mut encoders = encoders(|_| ());
    let (mut q, mut step) = (0.0, 0.0);
    for k in 0..120 {
        q += step;
        step += 2e-4;
        let believed = read(&mut encoders, q);
        assert_eq!((told(&believed), believed.fault), (Some(q), None), "{k}");
        if q > 1.9 {
            break;
        }
    }
    assert!(step > 0.02);
}

#[test]
fn from_rest_no_more_than_the_largest_speed_is_believed_whatever_the_acceleration() {
    for (way, fault) in [(0.009_999, None), (0.010_001, Some(Fault::Jump))] {
        let mut encoders = encoders(|_| ());
        read(&mut encoders, 0.5);
        assert_eq!(read(&mut encoders, 0.5 + way).fault, fault, "{way}");
    }
}
