//! What an operator means: it is probed at most, and left alone.

use super::{ON, T, watch};
use admittance::hand::Detector;
use std::f64::consts::TAU;

/// What an operator means to do: a nominal of 5 kg and 20 N·s/m from rest, which the robot follows, under a force `F`(t).
pub struct Meant<F> {
    F: F,
    q: f64,
    v: f64,
}

impl<F: FnMut(f64) -> f64> Meant<F> {
    pub fn new(F: F) -> Self {
        let (q, v) = (0.0, 0.0);
        Self { F, q, v }
    }

    /// (q, f_h) at `t`, with the damping `D` on top from then on.
    pub fn at(&mut self, t: f64, D: f64) -> (f64, f64) {
        let (M_n, D_n) = (5.0, 20.0 + D);
        let f_h = (self.F)(t);
        let shown = (self.q, f_h);
        let v_m = (2.0 * M_n * self.v / T + f_h) / (2.0 * M_n / T + D_n);
        self.q += T * v_m;
        self.v = 2.0 * v_m - self.v;
        shown
    }
}

/// A force of amplitude `F` (N) that sets in over `ramp` (s).
pub fn shake(frequency: f64, F: f64, ramp: f64) -> impl FnMut(f64) -> f64 {
    move |t| F * (t / ramp).min(1.0) * (TAU * frequency * t).sin()
}

/// What becomes of what an operator means under a detector that acts.
struct Course {
    detected: bool,
    /// Times at which the damping rose from 0 (s).
    probes: Vec<f64>,
    /// q (m) at each tick, and what it would be without a detector.
    q: Vec<f64>,
    alone: Vec<f64>,
    most: f64,
    last: f64,
}

fn course<F: FnMut(f64) -> f64>(duration: f64, force: impl Fn() -> F) -> Course {
    let watch = watch();
    let (mut moved, mut alone) = (Meant::new(force()), Meant::new(force()));
    let mut detector = Detector::default();
    let mut course = Course {
        detected: false,
        probes: vec![],
        q: vec![],
        alone: vec![],
        most: 0.0,
        last: 0.0,
    };
    for k in 0..(duration / T) as u32 {
        let t = f64::from(k) * T;
        let before = detector.D();
        let (q, f_h) = moved.at(t, before);
        detector = detector.sensed(q, f_h, &watch);
        course.detected |= detector.detected();
        if before == 0.0 && detector.D() > 0.0 {
            course.probes.push(t);
        }
        course.q.push(q);
        course.alone.push(alone.at(t, 0.0).0);
        course.most = course.most.max(detector.D());
        course.last = detector.D();
    }
    course
}

/// Peak to peak of `q` (m) over the last `span` (s) before `end` (s).
fn peak_to_peak(q: &[f64], end: f64, span: f64) -> f64 {
    let part = &q[((end - span) / T) as usize..(end / T) as usize];
    let fold = |f: fn(f64, f64) -> f64, first| part.iter().copied().fold(first, f);
    fold(f64::max, f64::MIN) - fold(f64::min, f64::MAX)
}

#[test]
fn what_an_operator_means_is_no_stiff_hand_at_any_frequency() {
    // The paper's 0.25 to 0.8 Hz with its ramps of 2 s, and shaking in the band that sets in within 0.25 s.
    let slow = [0.25, 0.363, 0.4, 0.6, 0.7, 0.8].map(|frequency| (frequency, [1e-9, 0.5, 2.0]));
    let fast = [1.0, 1.3, 1.6, 2.0, 3.0, 5.0, 7.0].map(|frequency| (frequency, [1e-9, 0.1, 0.25]));
    for (frequency, ramps) in slow.into_iter().chain(fast) {
        for ramp in ramps {
            let course = course(60.0, || shake(frequency, 20.0, ramp));
            assert!(!course.detected, "{frequency} Hz, ramp {ramp} s");
            if frequency < 1.0 {
                assert_eq!(course.most, 0.0, "{frequency} Hz, ramp {ramp} s");
            }
        }
    }
}

#[test]
fn a_shake_that_is_meant_is_probed_once_in_a_pause_and_else_left_alone() {
    for frequency in [1.3, 1.6, 2.3, 4.0] {
        let course = course(29.0, || shake(frequency, 10.0, 0.5));
        let probes = &course.probes;
        assert!(
            (1..=3).contains(&probes.len()),
            "{frequency} Hz: {probes:?} s"
        );
        for pair in probes.windows(2) {
            assert!(pair[1] - pair[0] > ON.pause, "{frequency} Hz: {probes:?} s");
        }
        // The probe adds half of |Z| to the nominal's own Z, in quadrature or in phase: at least two thirds of the motion is
        // left. Its mean drifts meanwhile, since nothing pulls a nominal back: a tenth of the motion in a period, and more
        // where the probe ends within it.
        for n in 4..29 {
            let (end, period) = (f64::from(n), 1.0 / frequency);
            let share =
                peak_to_peak(&course.q, end, period) / peak_to_peak(&course.alone, end, period);
            assert!(
                (0.6..1.3).contains(&share),
                "{frequency} Hz: {share} before {end} s"
            );
        }
        // Before the second probe the motion is the whole one again.
        let (end, period) = (probes[0] + 9.0, 1.0 / frequency);
        let share = peak_to_peak(&course.q, end, period) / peak_to_peak(&course.alone, end, period);
        assert!((share - 1.0).abs() < 1e-3, "{frequency} Hz: {share}");
    }
}

#[test]
fn a_shake_that_is_meant_and_grows_is_probed_and_left_alone() {
    for frequency in [1.3, 1.6, 2.3, 4.0] {
        // By 1.15, 1.5 and 1.9 in a period, from 1 to 30 N.
        for growth in [1.15_f64, 1.5, 1.9] {
            let grows =
                || move |t: f64| growth.powf(frequency * t).min(30.0) * (TAU * frequency * t).sin();
            let grown = f64::ln(30.0) / growth.ln() / frequency;
            let duration = grown + 12.0;
            let course = course(duration, grows);
            assert!(!course.detected, "{frequency} Hz, {growth} a period");
            assert!(
                !course.probes.is_empty(),
                "{frequency} Hz, {growth} a period"
            );
            let span = 1.0 / frequency;
            let shares: Vec<f64> = (1..=100)
                .map(|n| grown + 0.1 * f64::from(n))
                .map(|end| {
                    peak_to_peak(&course.q, end, span) / peak_to_peak(&course.alone, end, span)
                })
                .collect();
            let least = shares.iter().copied().fold(f64::MAX, f64::min);
            let whole = shares.iter().filter(|share| **share > 0.98).count();
            assert!(least > 0.6, "{frequency} Hz, {growth} a period: {least}");
            assert!(
                whole > 60,
                "{frequency} Hz, {growth} a period: {whole} of 100"
            );
        }
    }
}

#[test]
fn a_hand_that_grabs_what_was_meant_before_is_not_left_for_the_pause() {
    let watch = watch();
    let mut detector = Detector::default();
    let mut meant = Meant::new(shake(2.0, 5.0, 0.5));
    let mut probed = 0.0;
    let seen = (0..14_000_u32).map(|k| f64::from(k) * T).find(|&t| {
        let (q, f_h) = if t < 6.0 {
            meant.at(t, detector.D())
        } else {
            let q = 0.005 * (0.8 * (t - 6.0)).exp() * (TAU * 2.0 * t).sin();
            (q, -800.0 * q)
        };
        detector = detector.sensed(q, f_h, &watch);
        assert!(t > 6.0 || !detector.detected(), "{t} s");
        if t < 6.0 && detector.D() > 0.0 {
            probed = t;
        }
        detector.detected()
    });
    assert!(probed > 0.0 && probed + ON.pause > 13.0, "{probed} s");
    // From 4 N to twice the 5 N of before takes 1.1 s, and a period until a run has four half swings; the probe takes one more.
    assert!(seen.expect("detected") < 9.5, "{seen:?}");
}

#[test]
fn whoever_stops_shaking_under_a_probe_gets_the_handle_back_as_it_was() {
    let course = course(20.0, || {
        let mut shake = shake(2.0, 10.0, 0.5);
        move |t| if t < 4.0 { shake(t) } else { 0.0 }
    });
    assert!(
        course.probes.len() == 1 && course.last == 0.0,
        "{:?} s",
        course.probes
    );
    assert!(course.most < ON.D_max / 2.0, "{} N·s/m", course.most);
}
