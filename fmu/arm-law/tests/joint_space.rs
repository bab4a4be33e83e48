//! The law in joint space, eq:obs_dyn and eq:dob_input: against the law of one axis, its own energy formula, and the continuous equations.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::ledger::Flow;
use admittance::tick::{Coordinates, Tick as Shown};
use admittance::{Admittance, Gains, Law, Ledger, Reach, Real, Settings};
use arm_law::ParameterError;
use arm_law::joint_space::{Angles, JointGains, JointRequest, Joints};
use arm_law::kinematics::Kinematics;
use arm_law::nominal::{Link, NominalArm};
use fmu_declaration::check::Expected;
use nalgebra::Vector3;
use proptest::prelude::*;

const T: Real = 0.001;
const START: [Real; 3] = [0.0, -1.48096, 1.70138];

fn settings(law: Law) -> Settings {
    Settings {
        law,
        T,
        ..Settings::default()
    }
}

fn geometry() -> Kinematics {
    Kinematics::default()
}

/// The law with a ledger: what a caller does whose robot takes the torques as they are.
struct Run {
    joints: Joints,
    ledger: Ledger<3>,
}

/// A tick of it.
struct Tick {
    tau: Vector3<Real>,
    law: Shown<3>,
    H: Real,
}

impl Run {
    fn new(settings: Settings, arm: NominalArm, gains: JointGains) -> Self {
        Self {
            joints: Joints::new(settings, arm, geometry(), gains).unwrap(),
            ledger: Ledger::new(&settings, &Reach::default()),
        }
    }

    /// One tick; the robot gets the share `s` of what is asked for.
    fn tick(&mut self, q: &Vector3<Real>, tau_h: &Vector3<Real>, s: Real) -> Tick {
        let sensed = self.joints.sense(&Angles::new(q), 1.0);
        let H = self.joints.stored(&sensed);
        let proposal = self
            .joints
            .propose(&sensed, tau_h, &JointRequest::default());
        let tau = self.joints.f(&proposal) * s;
        let driven = self.joints.driven(&proposal, &tau);
        let mut law = Shown::at_rest(q);
        self.joints.show(&proposal, &driven, &mut law);
        let ended = self.ledger.close(H, q);
        self.ledger.book(
            &ended,
            Some(q),
            &tau,
            Flow {
                supplied: self.joints.supplied(&proposal, &driven),
                exchanged: self.joints.exchanged(&proposal, &driven),
            },
        );
        self.joints.commit(&proposal, &driven, &tau);
        Tick { tau, law, H }
    }
}

fn vectors(most: Real) -> impl Strategy<Value = Vector3<Real>> {
    [-most..most, -most..most, -most..most].prop_map(Vector3::from)
}

fn gains() -> impl Strategy<Value = JointGains> {
    let each =
        |least: Real, most: Real| [least..most, least..most, least..most].prop_map(Vector3::from);
    (
        each(0.0, 10.0),
        1.0..300.0,
        each(1.0, 50.0),
        each(1.0, 30.0),
    )
        .prop_map(|(D_n, K, K_P, tau_max)| JointGains {
            D_n,
            K,
            K_P,
            tau_max,
        })
}

/// Rotors so light that the links, and with them C_n, decide.
fn swinging() -> NominalArm {
    NominalArm {
        rotor: [0.02; 3],
        ..NominalArm::default()
    }
}

/// No links: three rotors, each an axis by itself.
fn rotors(rotor: [Real; 3]) -> NominalArm {
    let nothing = Link {
        m: 0.0,
        x: 0.0,
        z: 0.0,
        I_xx: 0.0,
        I_yy: 0.0,
        I_zz: 0.0,
        I_xz: 0.0,
    };
    NominalArm {
        links: [nothing; 3],
        rotor,
    }
}

/// A smooth motion (rad) about the start pose, of at most 4 rad/s on each joint, and torques of the human (N·m).
fn smooth(seed: u32) -> impl Fn(Real) -> (Vector3<Real>, Vector3<Real>) {
    let a = Real::from(seed % 7) * 0.4;
    move |t| {
        let wave = |i: Real, w: Real| (w * t + a + i).sin();
        let start = Vector3::from(START);
        let still = |i: Real| (a + i).sin(); // at t = 0 the pose is the start pose
        let q = start
            + Vector3::new(
                0.5 * (wave(0.0, 2.0) - still(0.0)),
                0.4 * (wave(1.0, 3.1) - still(1.0)) + 0.01 * wave(0.5, 60.0),
                0.6 * (wave(2.0, 4.3) - still(2.0)),
            );
        (
            q,
            Vector3::new(
                4.0 * wave(0.3, 2.2),
                6.0 * wave(1.3, 1.7),
                3.0 * wave(2.3, 5.0),
            ),
        )
    }
}

proptest! {
    /// Without links M_n is constant and diagonal, C_n is 0, and the joints are three axes of [`Admittance`]: under every
    /// law, limited or not, with jumps of the pose at every sample.
    #[test]
    fn without_links_each_joint_is_the_law_of_one_axis(
        gains in gains(),
        rotor in [0.05..2.0, 0.05..2.0, 0.05..2.0_f64],
        motion in prop::collection::vec((vectors(0.02), vectors(40.0)), 60),
        number in 1..5,
    ) {
        // A tank that never runs dry: the joints are compared without a budget.
        let settings = Settings { E_0: 1e9, ..settings(Law::try_from(number).unwrap()) };
        let limited = matches!(settings.law, Law::PassiveApplied | Law::PassiveBounded);
        let mut run = Run::new(settings, rotors(rotor), gains);
        let mut axes = [0, 1, 2].map(|i| {
            let f_max = if limited { gains.tau_max[i] } else { Real::INFINITY };
            let gains = Gains { M_n: rotor[i], D_n: gains.D_n[i], K: gains.K, K_P: gains.K_P[i], f_max };
            Admittance::new(settings, [gains]).unwrap()
        });
        for (q, tau_h) in motion {
            let tick = run.tick(&q, &tau_h, 1.0);
            for (i, axis) in axes.iter_mut().enumerate() {
                let expected = axis.step(&[q[i]].into(), &[tau_h[i]].into());
                // The same equations with the operations in another order: rounding, of sums that cancel.
                prop_assert!((tick.tau[i] - expected.f.x).abs() < 1e-9 * (1.0 + expected.f_demand.x.abs()));
                prop_assert!((tick.law.e_nr[i] - expected.e_nr.x).abs() < 1e-12);
                prop_assert!((tick.law.dq_n[i] - expected.dq_n.x).abs() < 1e-10 * (1.0 + expected.dq_n.x.abs()));
            }
        }
        let G: Real = axes.iter().map(|axis| axis.ledger().G()).sum();
        prop_assert!((run.ledger.G() - G).abs() < 1e-9 * (1.0 + G.abs()));
    }

    /// ΔG = −(k/alpha) v_mᵀ D_n v_m T − k T |w|² + k Σ (1 − K_P T/2) w δ + ½ k Σ K_P δ², with M_n and C_n nowhere in it:
    /// for jumps of the pose that no robot makes.
    #[test]
    fn every_sample_creates_what_the_formula_says(
        gains in gains(),
        alpha in 0.2..5.0_f64,
        motion in prop::collection::vec((vectors(0.3), vectors(40.0)), 40),
    ) {
        let settings = Settings { alpha, ..settings(Law::Passive) };
        let mut run = Run::new(settings, swinging(), gains);
        let JointGains { D_n, K, K_P, .. } = gains;
        let mut before: Option<(Vector3<Real>, Tick, Vector3<Real>, Real)> = None;
        for (q, tau_h) in motion {
            let q = q + Vector3::from(START);
            let tick = run.tick(&q, &tau_h, 1.0);
            if let Some((q_before, last, tau_h, G)) = before {
                let moved = q - q_before;
                let delta = moved - last.law.dq * T;
                // q_n⁺ = q_n + T v_m
                let v_m = (tick.law.q_n - last.law.q_n) / T;
                let w = v_m - last.law.dq;
                let created = (0..3).map(|i| {
                    -K / alpha * D_n[i] * v_m[i] * v_m[i] * T - K * T * w[i] * w[i]
                        + K * w[i] * delta[i] * (1.0 - K_P[i] * T / 2.0)
                        + 0.5 * K * K_P[i] * delta[i] * delta[i]
                });
                let formula: Real = created.sum();
                let scale = last.H + tick.H + last.tau.dot(&moved).abs() + (K / alpha * tau_h.dot(&v_m) * T).abs()
                    + K * T * w.norm_squared() + G.abs();
                // Rounding of the sums that ΔG is the difference of; v_m is a difference of angles over T.
                prop_assert!((run.ledger.G() - G - formula).abs() < 1e-11 * scale, "{formula} {scale}");
            }
            before = Some((q, tick, tau_h, run.ledger.G()));
        }
    }

    /// Under `passive_bounded` each joint keeps to its torque limit, and so does its spring alone.
    #[test]
    fn bounded_keeps_each_joints_torque_and_spring_within_its_limit(
        gains in gains(),
        motion in prop::collection::vec((vectors(0.02), vectors(200.0)), 60),
    ) {
        let mut run = Run::new(settings(Law::PassiveBounded), swinging(), gains);
        for (q, tau_h) in motion {
            let tick = run.tick(&q, &tau_h, 1.0);
            for i in 0..3 {
                prop_assert!(tick.tau[i].abs() <= gains.tau_max[i]);
                let spring = gains.K * gains.K_P[i] * tick.law.e_nr[i].abs();
                prop_assert!(spring <= gains.tau_max[i] * (1.0 + 4e-16)); // the products' rounding
            }
        }
    }

    /// Other gains take over without adding energy, also where they widen the limits of springs that slip.
    #[test]
    fn gains_that_take_over_do_not_raise_the_stored_energy(from in gains(), to in gains(), tau_h in vectors(40.0), number in 2..5) {
        let settings = Settings { tuning_time: 0.0, ..settings(Law::try_from(number).unwrap()) };
        let mut run = Run::new(settings, swinging(), from);
        let q = Vector3::from(START);
        for _ in 0..50 {
            run.tick(&q, &tau_h, 1.0);
        }
        let kept = run.joints.stored(&run.joints.sense(&Angles::new(&q), 1.0));
        run.joints.tune(to).unwrap();
        let taken_over = run.joints.stored(&run.joints.sense(&Angles::new(&q), 1.0));
        prop_assert!(taken_over <= kept * (1.0 + 1e-14), "{kept} → {taken_over}"); // rounding
    }
}

/// Joints pressed by an arm that is moved about for 20 s: clamped and slipping most of the time, and no energy created.
#[test]
fn bounded_creates_no_energy_under_smooth_motion_while_limited() {
    for seed in 0..7 {
        let motion = smooth(seed);
        let gains = JointGains {
            tau_max: Vector3::new(20.0, 40.0, 15.0),
            ..JointGains::default()
        };
        let mut run = Run::new(settings(Law::PassiveBounded), swinging(), gains);
        let (mut most, mut limited) = (Real::MIN, 0);
        for k in 0..20_000 {
            let (q, tau_h) = motion(T * Real::from(k));
            let tick = run.tick(&q, &tau_h, 1.0);
            most = most.max(run.ledger.G());
            limited += u32::from(tick.tau != tick.law.f_demand);
        }
        assert!(limited > 5_000, "{limited}");
        // Starting to move within a sample, Δv = 5 rad/s at most on each of three joints, costs k T Δv²/4 each.
        let begin = 3.0 * gains.K * T * 25.0 / 4.0;
        assert!(most < begin, "seed {seed}: G reaches {most} J");
    }
}

/// q̇_n = v, M_n(q) dv/dt = tau_h − (C_n(q, dq) + D_n) v − alpha y at every instant, by RK4 with its own Christoffel C_n.
fn continuous(
    arm: &NominalArm,
    gains: &JointGains,
    motion: &impl Fn(Real) -> (Vector3<Real>, Vector3<Real>),
    t_end: Real,
    n: usize,
) -> (Vector3<Real>, Vector3<Real>) {
    let h = t_end / n as Real;
    let dq = |t: Real| (motion(t + 1e-5).0 - motion(t - 1e-5).0) / 2e-5;
    let f = |t: Real, (q_n, v): (Vector3<Real>, Vector3<Real>)| {
        let ((q, tau_h), dq) = (motion(t), dq(t));
        let body = arm.at(&geometry(), &q);
        let y = v - dq + gains.K_P.component_mul(&(q_n - q));
        let torque = tau_h - body.C(&dq) * v - gains.D_n.component_mul(&v) - y;
        (v, body.M.lu().solve(&torque).unwrap())
    };
    let (mut q_n, mut v) = (motion(0.0).0, Vector3::zeros());
    for i in 0..n {
        let t = h * i as Real;
        let k1 = f(t, (q_n, v));
        let k2 = f(t + h / 2.0, (q_n + k1.0 * (h / 2.0), v + k1.1 * (h / 2.0)));
        let k3 = f(t + h / 2.0, (q_n + k2.0 * (h / 2.0), v + k2.1 * (h / 2.0)));
        let k4 = f(t + h, (q_n + k3.0 * h, v + k3.1 * h));
        q_n += (k1.0 + k2.0 * 2.0 + k3.0 * 2.0 + k4.0) * (h / 6.0);
        v += (k1.1 + k2.1 * 2.0 + k3.1 * 2.0 + k4.1) * (h / 6.0);
    }
    (q_n, v)
}

/// (q_n, v_n) at `t_end` by the sampled law.
fn sampled(
    arm: NominalArm,
    gains: JointGains,
    motion: &impl Fn(Real) -> (Vector3<Real>, Vector3<Real>),
    t_end: Real,
    n: u32,
) -> (Vector3<Real>, Vector3<Real>) {
    let period = t_end / Real::from(n);
    let settings = Settings {
        T: period,
        ..settings(Law::Passive)
    };
    let mut run = Run::new(settings, arm, gains);
    (0..n).for_each(|k| {
        let (q, tau_h) = motion(period * Real::from(k));
        run.tick(&q, &tau_h, 1.0);
    });
    let (q, tau_h) = motion(t_end);
    let tick = run.tick(&q, &tau_h, 1.0);
    (tick.law.q_n, tick.law.dq_n)
}

fn errors(
    motion: &impl Fn(Real) -> (Vector3<Real>, Vector3<Real>),
    samples: [u32; 3],
) -> [Real; 3] {
    let (arm, gains, t_end) = (swinging(), JointGains::default(), 2.0);
    let (q_n, v) = continuous(&arm, &gains, motion, t_end, 20_000);
    samples.map(|n| {
        let found = sampled(arm, gains, motion, t_end, n);
        (found.0 - q_n).amax().max((found.1 - v).amax())
    })
}

/// At a robot that stands still nothing is held that changes: the midpoint rule is of second order.
#[test]
fn at_a_standing_robot_the_error_falls_with_the_square_of_the_sample_time() {
    let still = |_| (Vector3::from(START), Vector3::new(2.0, -3.0, 1.5));
    // At 2 s the transient is over; e^(−t) is not, with one time constant at 0.2 s and one at 1/K_P.
    let errors = errors(&still, [100, 200, 400]);
    for pair in errors.windows(2) {
        assert!((3.6..4.4).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// Of a moving robot the law knows the pose and the backward difference at the tick, and holds them: first order, like the
/// law of one axis. It is the paper's equation that it converges to, with C_n.
#[test]
fn with_a_moving_robot_the_sampled_law_converges_to_the_papers_equation() {
    let errors = errors(&smooth(3), [2_000, 4_000, 8_000]);
    assert!(errors[2] < 0.01, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((1.9..2.1).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// What the actuators leave is what the nominal of laws 3 and 4 feels, joint by joint; law 2 feels the whole y.
#[test]
fn the_nominal_feels_what_is_delivered_under_laws_3_and_4() {
    let q = Vector3::from(START);
    let nominal_after = |law: Law, s: Real| {
        let mut run = Run::new(settings(law), swinging(), JointGains::default());
        (0..2000).for_each(|_| {
            run.tick(&q, &Vector3::new(3.0, 5.0, 2.0), s);
        });
        run.tick(&q, &Vector3::zeros(), s).law.q_n - q
    };
    // Against a robot that does not give way, e → tau_h/(alpha K_P) under the paper's law, whatever is delivered.
    let paper = Vector3::new(3.0, 5.0, 2.0) / 20.0;
    assert!((nominal_after(Law::Passive, 0.3) - paper).amax() < 1e-3);
    // With a third delivered and felt, the spring must stretch to three times that.
    let felt = nominal_after(Law::PassiveApplied, 0.3);
    assert!(
        felt.zip_map(&paper, |felt, paper| felt / paper).min() > 2.0,
        "{felt}"
    );
}

#[test]
fn a_gain_out_of_range_is_refused_with_joint_and_value_and_the_gains_stay() {
    let mut joints = Joints::new(
        settings(Law::PassiveBounded),
        NominalArm::default(),
        geometry(),
        JointGains::default(),
    )
    .unwrap();
    let before = joints;
    let mut gains = JointGains::default();
    gains.K_P[1] = 0.0;
    assert_eq!(
        joints.tune(gains),
        Err(ParameterError::OutOfRange {
            name: "joint.K_P",
            axis: Some(2),
            value: 0.0,
            expected: Expected::Text("a finite value, at least 1e-6"),
        })
    );
    assert_eq!(joints, before);
}
