//! A tick that is refused leaves the law as it was, where positions are counted from included.

use arm_law_f32::arm_law::{ArmLaw, NotFinite};
use arm_law_f32::{ArmInputs, ArmOutputs, ArmParameters};

#[test]
fn a_refused_tick_at_which_it_would_engage_changes_nothing() {
    let parameters = ArmParameters {
        K: [1e6; 3],
        ..ArmParameters::default()
    };
    let mut law = ArmLaw::new(&parameters).expect("legal");
    let mut outputs = ArmOutputs::default();
    let inputs = ArmInputs {
        q: [0.1, -1.4, 1.6],
        engage: 1,
        ..ArmInputs::default()
    };
    let before = law;
    let overflowing = ArmInputs {
        f_h: [f32::MAX; 3], // K y is beyond all numbers
        ..inputs
    };
    assert_eq!(law.tick(&overflowing, &mut outputs), Err(NotFinite));
    assert_eq!(law, before);
    assert_eq!(law.tick(&inputs, &mut outputs), Ok(()));
    assert_ne!(law, before);
}
