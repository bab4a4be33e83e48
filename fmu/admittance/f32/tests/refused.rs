//! A tick that is refused leaves the law as it was, where positions are counted from included.

use admittance_f32::one_axis::{AxisInputs, AxisOutputs, AxisParameters, NotFinite, OneAxis};

#[test]
fn a_refused_tick_at_which_it_would_engage_changes_nothing() {
    let mut law = OneAxis::new(&AxisParameters::default()).expect("legal");
    let mut outputs = AxisOutputs::default();
    let inputs = AxisInputs {
        q: 123.456,
        tau_h: 1.0,
        engage: 1,
        ..AxisInputs::default()
    };
    let (before, shown) = (law, outputs);
    let refused = AxisInputs {
        tau_h: f32::NAN,
        ..inputs
    };
    assert_eq!(law.tick(&refused, &mut outputs), Err(NotFinite));
    assert_eq!((law, outputs), (before, shown));
    assert_eq!(law.tick(&inputs, &mut outputs), Ok(()));
    assert_ne!(law, before);
}
