//! A hand too stiff for the gains, on the crude arm with its dry friction.

use crate::robot::{Robot, close_the_loop};
use crate::{T, controller, initialized, tick};
use arm_controller::ArmController;
use fmu_export::{Log, Model};
use nalgebra::Vector3;

/// A hand of 1000 N/m that holds the handle where it is until `let_go` (s), after a push of 6 N upwards for 0.3 s. The swing
/// of x (m) in each second and the largest G (J).
fn held(c: &mut ArmController, let_go: u32, seconds: u32) -> (Vec<f64>, f64) {
    let mut robot = Robot::at_the_start();
    let p_0 = Vector3::from(c.outputs.p);
    let mut most = f64::MIN;
    let swings = (0..seconds)
        .map(|second| {
            let (mut low, mut high) = (f64::MAX, f64::MIN);
            for k in 1000 * second..1000 * (second + 1) {
                let k_h = if second < let_go { 1000.0 } else { 0.0 };
                let push = if k < 300 { 6.0 } else { 0.0 };
                // The handle at the last tick: p of this one follows from q, which the controller has not seen yet.
                let f_h = k_h * (p_0 - Vector3::from(c.outputs.p)) + Vector3::z() * push;
                close_the_loop(c, &mut robot, k, f_h.into());
                (low, high) = (low.min(c.outputs.p[0]), high.max(c.outputs.p[0]));
                most = most.max(c.outputs.G);
            }
            high - low
        })
        .collect();
    (swings, most)
}

#[test]
fn a_swing_that_lasts_without_the_detector_ends_with_it_and_the_damping_is_given_back() {
    let mut without = initialized(|_| ());
    let (alone, _) = held(&mut without, 12, 12);
    let seen = &without.outputs;
    assert!(seen.stiff_hand_detected == 0);
    assert!(seen.stiff_hand_D == [0.0; 3] && seen.stiff_hand_k_h == [0.0; 3]);

    let mut with = initialized(|c| c.parameters.stiff_hand.active = 1);
    let (watched, G) = held(&mut with, 12, 12);
    // Alone the swing keeps its 0.1 m. Watched it is f_min at most, 2 mm at 1000 N/m, and as much again until the damping acts.
    assert!(alone[11] > 0.09, "{alone:?}");
    assert!(watched[3..].iter().all(|x| *x < 0.004), "{watched:?}");
    assert!(G <= 1e-9, "{G} J"); // rounding of one addition a tick to some J
    // The hand is felt where the handle was a tick ago: cos of 1° at 2 Hz.
    assert!((with.outputs.stiff_hand_k_h[0] / 1000.0 - 1.0).abs() < 0.01);

    let mut let_go = initialized(|c| c.parameters.stiff_hand.active = 1);
    held(&mut let_go, 3, 3);
    assert!(let_go.outputs.stiff_hand_detected != 0);
    let mut let_go = initialized(|c| c.parameters.stiff_hand.active = 1);
    held(&mut let_go, 3, 7); // quiet + release + half a swing are 3.5 s
    assert!(let_go.outputs.stiff_hand_detected == 0 && let_go.outputs.stiff_hand_D == [0.0; 3]);
}

#[test]
fn out_of_the_loop_it_is_forgotten() {
    let mut c = initialized(|c| c.parameters.stiff_hand.active = 1);
    held(&mut c, 3, 3);
    assert!(c.outputs.stiff_hand_detected != 0);
    c.inputs.engage = 0;
    tick(&mut c, 3000);
    assert!(c.outputs.stiff_hand_detected == 0 && c.outputs.stiff_hand_D == [0.0; 3]);
    c.inputs.engage = 1;
    tick(&mut c, 3001);
    assert!(c.outputs.stiff_hand_detected == 0 && c.outputs.stiff_hand_k_h == [0.0; 3]);
}

#[test]
fn its_parameters_are_refused_under_their_names() {
    let mut c = controller(|c| c.parameters.stiff_hand.f_high = 0.5);
    let refusal = c.initialize(0.0, &mut Log::silent()).expect_err("refused");
    assert_eq!(
        refusal.to_string(),
        "stiff_hand.f_high = 0.5: expected a value greater than stiff_hand.f_low"
    );
    let mut c = controller(|c| {
        (
            c.parameters.stiff_hand.active,
            c.parameters.stiff_hand.f_high,
        ) = (1, 0.2 / T)
    });
    let refusal = c.initialize(0.0, &mut Log::silent()).expect_err("refused");
    assert_eq!(
        refusal.to_string(),
        "stiff_hand.f_high = 200: expected at most 1/(8 T)"
    );
}
