//! An initialized arm, and steps of it.
#![allow(dead_code, reason = "each test file uses its part")]

use exoskeleton_arm::ExoskeletonArm;
use fmu_export::{Log, Model, Step};

/// The arm after `change`, initialized at `start_time`, or the text of the refusal.
pub fn started_at(
    start_time: f64,
    change: impl FnOnce(&mut ExoskeletonArm),
) -> Result<ExoskeletonArm, String> {
    let mut arm = ExoskeletonArm::default();
    change(&mut arm);
    arm.initialize(start_time, &mut Log::silent())
        .map_err(|refusal| refusal.0)?;
    Ok(arm)
}

/// The arm after `change`, initialized at 0.
pub fn started(change: impl FnOnce(&mut ExoskeletonArm)) -> ExoskeletonArm {
    started_at(0.0, change).unwrap()
}

/// One step from t to t + h.
pub fn step(arm: &mut ExoskeletonArm, t: f64, h: f64) {
    let step = Step::at(t, h);
    arm.step(step, &mut Log::silent()).unwrap();
}

/// Steps of 1 ms from `from` to `to` (ms).
pub fn run(arm: &mut ExoskeletonArm, from: u32, to: u32) {
    (from..to).for_each(|k| step(arm, f64::from(k) * 1e-3, 1e-3));
}

/// Everything of an arm, as bytes: equal to the last bit.
pub fn bytes(arm: &ExoskeletonArm) -> Vec<u8> {
    postcard::to_allocvec(arm).unwrap()
}
