//! The stiff-hand detector: what it sees, what it must not see, and that its damping is enough.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod held;
mod meant;
mod measured;
mod parameters;
mod seen;

use admittance::hand::{Detector, StiffHand, Watch};

const T: f64 = 0.001;
const ON: StiffHand = StiffHand {
    active: 1,
    D_max: 200.0,
    f_low: 1.0,
    f_high: 8.0,
    f_min: 1.0,
    growth: 1.1,
    attack: 0.1,
    quiet: 2.0,
    release: 1.0,
    periods: 3,
    probe: 0.5,
    pause: 10.0,
};

fn watch() -> Watch {
    Watch::new(ON, T).expect("valid parameters")
}

/// First time (s) at which a detector that is shown (q, f_h)(t) sees a stiff hand within `duration` (s).
fn detection(duration: f64, mut signals: impl FnMut(f64) -> (f64, f64)) -> Option<f64> {
    let watch = watch();
    let mut detector = Detector::default();
    let ticks = (duration / T) as u32;
    (0..ticks).map(|k| f64::from(k) * T).find(|&t| {
        let (q, f_h) = signals(t);
        detector = detector.sensed(q, f_h, &watch);
        detector.detected()
    })
}

/// A sum of uniform numbers in ±1, seeded: white noise of deviation 1.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        (0..3)
            .map(|_| {
                self.0 = self
                    .0
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
            })
            .sum()
    }
}
