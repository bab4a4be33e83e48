//! Initialized arms, and steps of them.
#![allow(dead_code, reason = "each test file uses its part")]

use exoskeleton_arms::ExoskeletonArms;
use fmu_export::{Log, Model, Step};

/// The arms after `change`, initialized, or the text of the refusal.
pub fn tried(change: impl FnOnce(&mut ExoskeletonArms)) -> Result<ExoskeletonArms, String> {
    let mut arms = ExoskeletonArms::default();
    change(&mut arms);
    arms.initialize(0.0, &mut Log::silent())
        .map_err(|refusal| refusal.0)?;
    Ok(arms)
}

/// The arms after `change`, initialized.
pub fn started(change: impl FnOnce(&mut ExoskeletonArms)) -> ExoskeletonArms {
    tried(change).unwrap()
}

/// Steps of 1 ms from `from` to `to` (ms).
pub fn run(arms: &mut ExoskeletonArms, from: u32, to: u32) {
    for k in from..to {
        let step = Step::at(f64::from(k) * 1e-3, 1e-3);
        arms.step(step, &mut Log::silent()).unwrap();
    }
}
