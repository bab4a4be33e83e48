//! The law in joint space (eq:obs_dyn, eq:dob_input) at a tick: its budget, its limits, what it shows at the handle.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::bounds::{Bounds, Interval};
use admittance::{Law, Reach, Request, Settings};
use arm_law::handle::HandleTick;
use arm_law::joint_space::boxed::solved;
use arm_law::joint_space::{JointGains, JointParameters, JointSpace, Nominal};
use arm_law::kinematics::{Kinematics, Pose};
use arm_law::limits::{Limits, TorqueLimiting};
use arm_law::nominal::NominalArm;
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

const T: f64 = 0.001;
const START: [f64; 3] = [0.0, -1.48096, 1.70138];
const DQ_MAX: f64 = 6.0;

fn new(law: Law, parameters: &JointParameters) -> Result<JointSpace, arm_law::ParameterError> {
    let settings = Settings {
        law,
        T,
        ..Settings::default()
    };
    let reach = Reach {
        v_max: Vector3::repeat(DQ_MAX),
        a_max: Vector3::repeat(f64::INFINITY),
    };
    let limits = Limits {
        tau_max: Vector3::new(153.0, 259.0, 153.0),
        tau_rate: Vector3::repeat(f64::INFINITY),
        limiting: TorqueLimiting::Scale,
    };
    JointSpace::new(settings, parameters, Kinematics::default(), reach, limits)
}

fn bounded(change: impl FnOnce(&mut JointParameters)) -> JointSpace {
    let mut parameters = JointParameters::default();
    change(&mut parameters);
    new(Law::PassiveBounded, &parameters).unwrap()
}

/// What a tick shows.
struct Shown {
    pose: Pose,
    outcome: HandleTick,
    nominal: Nominal,
}

fn tick(law: &mut JointSpace, q: Vector3<f64>, f_h: [f64; 3], hold: bool) -> Shown {
    let pose = Kinematics::default().at(&q);
    let request = Request {
        hold,
        ..Request::default()
    };
    let mut outcome = HandleTick::at_rest(&pose.p, false);
    let mut nominal = Nominal::at(&q, Matrix3::zeros());
    law.step(&pose, &q, &f_h.into(), &request, &mut outcome, &mut nominal)
        .expect("finite");
    Shown {
        pose,
        outcome,
        nominal,
    }
}

fn interval(low: f64, high: f64) -> Interval {
    Bounds {
        q_min: low,
        q_max: high,
        ..Bounds::default()
    }
    .interval(0.0, 1.0, false)
}

proptest! {
    /// The robot moves as far as it may at every sample, wherever that costs the law most, with any force of the human.
    #[test]
    fn the_tank_stays_above_zero_for_the_worst_motion_within_the_reach(
        K in 10.0..300.0_f64,
        rotor in 0.02..0.5_f64,
        pushes in prop::collection::vec(([-40.0..40.0_f64, -40.0..40.0, -40.0..40.0], 0..4_u8), 200),
    ) {
        let mut law = bounded(|joint| {
            joint.gains.K = K;
            joint.arm.rotor = [rotor; 3];
        });
        let (mut q, mut acted) = (Vector3::from(START), false);
        for (i, (f_h, way)) in pushes.into_iter().enumerate() {
            let outputs = tick(&mut law, q, f_h, false);
            let tank = law.ledger().tank();
            // Rounding of the ledger's sums, of up to some kJ.
            prop_assert!(tank >= -1e-10, "tick {i}: {tank} J");
            acted |= outputs.outcome.share < 1.0;
            // Along the torque, where its work is largest; against it; to and fro; or at rest.
            let sign = outputs.outcome.tau.map(|tau| if tau < 0.0 { -1.0 } else { 1.0 });
            q += match way {
                0 | 1 => sign,
                2 => -sign,
                _ => Vector3::repeat(if i % 2 == 0 { 1.0 } else { -1.0 }),
            } * (DQ_MAX * T);
        }
        prop_assert!(acted || law.ledger().tank() > 0.0);
    }

    /// A v_m = b + R with R only at the ends of the intervals and against the motion there: the conditions of the minimum.
    #[test]
    fn limits_push_only_inwards_and_only_where_they_are_reached(
        diagonal in [0.1..10.0_f64, 0.1..10.0, 0.1..10.0],
        share in -0.99..0.99_f64,
        b in [-5.0..5.0_f64, -5.0..5.0, -5.0..5.0],
        ends in [(0.0..1.0_f64, 0.0..1.0_f64), (0.0..1.0, 0.0..1.0), (0.0..1.0, 0.0..1.0)],
    ) {
        let mut A = Matrix3::from_diagonal(&diagonal.into());
        A.m23 = share * (A.m22 * A.m33).sqrt();
        A.m32 = A.m23;
        let b = Vector3::from(b);
        let intervals = ends.map(|(low, high)| interval(-low, high));
        let solution = solved(&A, &b, &intervals);
        let R = A * solution.v_m - b;
        for (i, (low, high)) in ends.into_iter().enumerate() {
            let v = solution.v_m[i];
            prop_assert!((-low..=high).contains(&v));
            // Rounding of a 2 × 2 system with a condition of up to 200.
            let rounding = 1e-12;
            if v == high && high > -low {
                prop_assert!(R[i] <= rounding, "{R}");
            } else if v == -low && high > -low {
                prop_assert!(R[i] >= -rounding, "{R}");
            } else {
                prop_assert!(R[i].abs() <= rounding, "{R}");
            }
            prop_assert!(R[i].abs() <= rounding || solution.held[i]);
        }
    }
}

/// The negative control: the paper's law under the same adversary empties the tank.
#[test]
fn the_papers_law_has_no_budget_and_empties_the_tank() {
    let mut law = new(Law::Passive, &JointParameters::default()).unwrap();
    let mut q = Vector3::from(START);
    for _ in 0..200 {
        let outputs = tick(&mut law, q, [0.0, 0.0, -20.0], false);
        q += outputs.outcome.tau.map(f64::signum) * (DQ_MAX * T);
    }
    assert!(law.ledger().tank() < -1.0, "{}", law.ledger().tank());
}

#[test]
fn in_hold_the_nominal_stays_where_it_is() {
    let mut law = bounded(|_| ());
    let q = Vector3::from(START);
    for _ in 0..100 {
        tick(&mut law, q, [3.0, 2.0, 6.0], false);
    }
    let before = tick(&mut law, q, [3.0, 2.0, 6.0], true).nominal;
    assert!(before.dq_n.amax() > 1e-3, "{before:?}"); // it was on its way
    for _ in 0..1000 {
        let outputs = tick(&mut law, q, [3.0, 2.0, 6.0], true);
        assert!(outputs.outcome.held);
        assert_eq!(outputs.nominal.q_n, before.q_n);
    }
}

#[test]
fn a_joint_at_its_limit_does_not_stop_the_others() {
    let q = Vector3::from(START);
    let elbow = START[2] + 0.01;
    let mut law = bounded(|joint| joint.bounds[2].q_max = elbow);
    let mut last = tick(&mut law, q, [0.0; 3], false);
    for _ in 0..3000 {
        last = tick(&mut law, q, [0.0, 1.0, 3.0], false);
        assert!(last.nominal.q_n[2] <= elbow + 1e-15); // rounding of q + e
    }
    assert!(last.outcome.held);
    assert!((last.nominal.q_n[2] - elbow).abs() < 1e-12);
    // Pressed against a robot that does not move, e → tau_h/K_P (alpha = 1), but for the springs' limits.
    assert!(
        last.nominal.e_nr[0] > 0.015 && last.nominal.e_nr[1] > 0.03,
        "{:?}",
        last.nominal
    );
}

#[test]
fn the_nominal_keeps_to_its_largest_speed() {
    let mut law = bounded(|joint| {
        joint.bounds = [Bounds {
            speed: 0.05,
            ..Bounds::default()
        }; 3];
    });
    let (mut q, mut fastest) = (Vector3::from(START), 0.0_f64);
    let mut before = q;
    for _ in 0..2000 {
        let nominal = tick(&mut law, q, [0.0, 8.0, 20.0], false).nominal;
        fastest = fastest.max(((nominal.q_n - before) / T).amax());
        before = nominal.q_n;
        q = nominal.q_n; // a robot that follows
    }
    assert!(fastest <= 0.05 * (1.0 + 1e-10), "{fastest}"); // a difference of angles over T
    assert!(fastest > 0.049);
}

#[test]
fn what_is_shown_at_the_handle_is_the_image_of_the_joints() {
    let (mut law, kinematics) = (bounded(|_| ()), Kinematics::default());
    let q = Vector3::from(START);
    for _ in 0..50 {
        tick(&mut law, q, [3.0, 2.0, 6.0], false);
    }
    let Shown {
        pose,
        outcome,
        nominal,
    } = tick(&mut law, q, [3.0, 2.0, 6.0], false);
    let image = kinematics.at(&nominal.q_n);
    assert_eq!(outcome.p_n, image.p);
    assert_eq!(outcome.dp_n, image.J * nominal.dq_n);
    assert_eq!(outcome.e_nr, image.p - pose.p);
    // J⁻ᵀ and back: rounding of torques of some tens of N·m.
    assert!((pose.J.tr_mul(&outcome.f_a) - outcome.tau).amax() < 1e-12);
    assert!(outcome.e_nr.min() > 0.0, "{}", outcome.e_nr); // pushed forwards, left and up
}

/// Neither the coupling nor tau_h = Jᵀ f_h needs an inverse of J.
#[test]
fn a_singularity_does_not_concern_the_joints() {
    let mut law = bounded(|_| ());
    let outputs = tick(
        &mut law,
        Vector3::new(0.0, -0.3, 0.0),
        [5.0, 0.0, 5.0],
        false,
    );
    assert!(outputs.pose.sigma_min < 1e-15);
    for _ in 0..10 {
        let outputs = tick(
            &mut law,
            Vector3::new(0.0, -0.3, 0.0),
            [5.0, 0.0, 5.0],
            false,
        );
        assert_eq!(outputs.outcome.f_a, Vector3::zeros()); // no force amounts to the torques there
        assert!(outputs.outcome.tau.norm() > 0.0);
    }
}

#[test]
fn gains_bounds_and_arms_that_cannot_be_are_refused_and_the_gains_stay() {
    let mut law = bounded(|_| ());
    let before = law;
    let mut gains = JointGains::default();
    gains.D_n[0] = f64::NAN;
    assert!(law.tune(gains).is_err());
    assert_eq!(law, before);

    let refused = |change: fn(&mut JointParameters)| {
        let mut parameters = JointParameters::default();
        change(&mut parameters);
        new(Law::PassiveBounded, &parameters).is_err()
    };
    assert!(refused(|joint| joint.arm = NominalArm {
        rotor: [0.0; 3],
        ..NominalArm::default()
    }));
    assert!(refused(|joint| joint.gains.K = 0.0));
    assert!(refused(|joint| joint.bounds[1].speed = 0.0));
    assert!(!refused(|_| ()));
}
