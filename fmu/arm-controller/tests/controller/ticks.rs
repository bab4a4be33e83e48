//! Ticks that do not come in time.

use crate::{ArmController, initialized};
use admittance::timing::{EARLY, IN_TIME, LATE};
use fmu_export::{Model, Step};

#[test]
fn a_step_that_is_longer_than_those_before_is_a_late_tick_with_the_right_velocity() {
    let mut c = initialized(|_| ());
    let start = c.inputs.q;
    let mut t = 0.0;
    let mut go = |c: &mut ArmController, h: f64| {
        let by = [0.5, -0.3, 0.2].map(|dq| dq * t); // rad
        c.inputs.q = core::array::from_fn(|i| start[i] + by[i]);
        let step = Step::at(t, h);
        c.step(step, &mut fmu_export::Log::silent())
            .expect("a step");
        t += h;
    };
    for _ in 0..20 {
        go(&mut c, 0.001);
    }
    let dp = c.outputs.dp;
    let near = |c: &ArmController| (0..3).all(|i| (c.outputs.dp[i] - dp[i]).abs() < 0.01);
    // 6.1 ms, and then two that are there at once.
    for (h, tick, timing) in [
        (0.0061, 20, IN_TIME), // this step's own beginning was in time
        (0.0009, 26, LATE),
        (0.0001, 27, IN_TIME),
        (0.001, 28, EARLY),
        (0.001, 29, IN_TIME),
    ] {
        go(&mut c, h);
        assert!(near(&c), "{:?} and {dp:?}", c.outputs.dp);
        assert_eq!((c.tick, c.outputs.timing), (tick, timing), "h = {h}");
        assert_eq!(c.outputs.encoder_fault, 0);
    }
}
