//! The loop that a hand holds, with the detector in it.

use super::{ON, T, watch};
use admittance::hand::{Detector, StiffHand, Watch};
use admittance::midpoint::{Rule, Sample};
use admittance::{Gains, Law, Settings};

/// A free mass under law `passive` with the paper's gains, and a hand of stiffness `k_h(t)` that holds it where it was at
/// 0, kicked by `kick` (N) for 0.3 s. Returns (t, q, D) at each tick.
fn held(watch: &Watch, duration: f64, kick: f64, k_h: impl Fn(f64) -> f64) -> Vec<(f64, f64, f64)> {
    let M = 99.93;
    let gains = Gains {
        M_n: 5.0,
        D_n: 20.0,
        K: 1000.0,
        K_P: 20.0,
        f_max: f64::INFINITY,
    };
    let settings = Settings {
        law: Law::Passive,
        T,
        ..Settings::default()
    };
    let rule = Rule::new(&settings, &gains);
    let (mut q, mut v, mut last, mut q_n, mut v_n) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let mut detector = Detector::default();
    let ticks = (duration / T) as u32;
    (0..ticks)
        .map(|k| {
            let t = f64::from(k) * T;
            let pushed = if t < 0.3 { kick } else { 0.0 };
            let f_h = pushed - k_h(t) * q;
            detector = detector.sensed(q, f_h, watch);
            let dq = (q - last) / T;
            let sample = Sample {
                e: q_n - q,
                v_n,
                dq,
                f_h,
                damping: detector.D(),
            };
            let v_m = rule.coupled(&sample);
            let shown = (t, q, detector.D());
            last = q;
            q_n += T * v_m;
            v_n = 2.0 * v_m - v_n;
            // Backward Euler: the plant's own damping is below 1e-3 1/s.
            v += T / M * (gains.K * rule.coupling(&sample, v_m) + f_h);
            q += T * v;
            shown
        })
        .collect()
}

fn swing(run: &[(f64, f64, f64)], after: f64, before: f64) -> f64 {
    let inside = run.iter().filter(|(t, ..)| (after..before).contains(t));
    let (low, high) = inside.fold((f64::INFINITY, -f64::INFINITY), |(low, high), (_, q, _)| {
        (low.min(*q), high.max(*q))
    });
    high - low
}

#[test]
fn the_loop_that_swings_up_without_the_detector_comes_to_rest_with_it() {
    let off = Watch::new(StiffHand { active: 0, ..ON }, T).expect("valid parameters");
    for k_h in [460.0, 700.0, 1000.0, 2000.0] {
        let alone = held(&off, 6.0, 2.0, |_| k_h);
        assert!(
            swing(&alone, 5.0, 6.0) > 5.0 * swing(&alone, 1.0, 2.0),
            "{k_h} N/m"
        );
        assert!(alone.iter().all(|(.., D)| *D == 0.0));

        let watched = held(&watch(), 6.0, 2.0, |_| k_h);
        let largest = swing(&watched, 0.0, 6.0);
        assert!(watched.iter().any(|(.., D)| *D == ON.D_max), "{k_h} N/m");
        assert!(
            largest < swing(&alone, 0.0, 6.0),
            "{k_h} N/m: {largest} m at the largest"
        );
        // Damped by 0.5 1/s at least (2000 N/m, the closed form), over the two seconds and more since it was seen.
        assert!(swing(&watched, 5.5, 6.0) < 0.5 * largest, "{k_h} N/m");
    }
}

#[test]
fn the_damping_is_given_back_after_the_hand_has_let_go() {
    let run = held(&watch(), 14.0, 2.0, |t| if t < 8.0 { 460.0 } else { 0.0 });
    let seen = run.iter().position(|(.., D)| *D > 0.0).expect("detected");
    let last = run.iter().rposition(|(.., D)| *D > 0.0).expect("damped");
    assert!(run[seen].0 < 8.0);
    // It may have gone and come again before 8 s; after that, quiet + release at most, and a half swing that still ran.
    assert!(
        run[last].0 < 8.0 + ON.quiet + ON.release + 0.5,
        "{} s",
        run[last].0
    );
    // Up and down no faster than attack and release allow (rounding of a sum).
    for pair in run.windows(2) {
        let change = pair[1].2 - pair[0].2;
        let most = ON.D_max * T / if change > 0.0 { ON.attack } else { ON.release };
        assert!(change.abs() <= most + 1e-9);
    }
}

#[test]
fn a_hand_that_stays_stiff_for_a_minute_never_swings_far_again() {
    for k_h in [460.0, 700.0, 2600.0] {
        let run = held(&watch(), 60.0, 0.01, |_| k_h);
        // Damping is given back while the hand is still there and comes again, once the swing has f_min in the band or, at the
        // latest, after two more half swings: σ = 6.9 1/s at 2600 N/m is e² in them.
        let f_min = 2.0 * ON.f_min / k_h;
        assert!(
            run.iter().any(|(t, .., D)| *t > 10.0 && *D > 0.0),
            "{k_h} N/m"
        );
        let again = swing(&run, 10.0, 60.0);
        assert!(again < 10.0 * f_min, "{k_h} N/m: {again} m, {f_min} m");
    }
}
