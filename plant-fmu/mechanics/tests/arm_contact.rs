//! Stops, table and wall: what they hold, how they rub.

#![allow(
    non_snake_case,
    reason = "the symbols of mechanics with their capitals: J"
)]

use mechanics::arm::{Arm, Inputs, Parameters, Start};
use nalgebra::Vector3;

/// Weightless, without dry friction in the joints, which leaves equilibrium to the surfaces; viscous friction calms it.
fn weightless() -> Parameters {
    let mut parameters = Parameters {
        drive_cutoff: 0.0,
        ..Parameters::default()
    };
    parameters.masses.gravity = [0.0; 3];
    for friction in &mut parameters.friction {
        (friction.F_c, friction.F_s, friction.b) = (0.0, 0.0, 20.0);
    }
    parameters
}

/// Substep (s) of these tests.
const DT: f64 = 2e-4;
/// Substeps that settle: the surfaces' 3000 N·s/m damp every motion of the arm with 15 1/s or more, exp(−15 · 2) = 1e-13.
const SETTLE: u32 = 10_000;

/// Table `gap` under and wall `gap` before the pad in its start pose.
fn corner(gap: f64) -> Parameters {
    let pad = Arm::default().place().pad.p;
    let mut parameters = weightless();
    parameters.table.z = pad.z - gap;
    parameters.wall.x = pad.x + gap;
    (parameters.table.c, parameters.wall.c) = (3e3, 3e3);
    parameters
}

fn pushed(f_d: [f64; 3]) -> Inputs {
    Inputs {
        f_d,
        ..Inputs::default()
    }
}

#[test]
fn a_joint_arrives_at_its_stop_stays_there_and_leaves_when_pulled() {
    let mut arm = Arm::new(weightless(), &Start::default()).unwrap();
    let push = Inputs {
        tau_a: [100.0, 0.0, 0.0],
        ..Inputs::default()
    };
    let mut before = arm;
    while arm.q()[0] < 1.2 {
        before = arm;
        arm.advance(&push, 1, 1e-4);
        assert!(arm.q()[0] <= 1.2);
    }
    let fast = before.dq()[0];
    assert!(fast > 1.0);
    arm.advance(&push, 5_000, 1e-4);
    assert_eq!((arm.q()[0], arm.dq()[0]), (1.2, 0.0));
    // The pitch joints have no part in it: M₁₂ = M₁₃ = 0.
    let body = mechanics::arm::rigid_body::RigidBody::at(
        &before.place().pose,
        &arm.parameters().lengths,
        &arm.parameters().masses,
        0.0,
    );
    let impact = 0.5 * body.M[(0, 0)] * fast * fast;
    // The torque works on through the last, partial substep: dt/t of the impact's energy.
    assert!(
        (arm.energy().loss_stop / impact - 1.0).abs() < 2e-3,
        "{} {impact}",
        arm.energy().loss_stop
    );

    arm.advance(
        &Inputs {
            tau_a: [-1.0, 0.0, 0.0],
            ..Inputs::default()
        },
        100,
        1e-4,
    );
    assert!(arm.dq()[0] < 0.0, "a stop does not hold back");
}

#[test]
fn a_stop_is_never_passed_not_by_rounding_either() {
    for k in 0..100 {
        let mut parameters = weightless();
        parameters.stops[0].max = 0.01 + 1e-4 * f64::from(k);
        let mut arm = Arm::new(parameters, &Start::default()).unwrap();
        let push = Inputs {
            tau_a: [1000.0, 0.0, 0.0],
            ..Inputs::default()
        };
        arm.advance(&push, 100, DT);
        assert_eq!((arm.q()[0], arm.dq()[0]), (parameters.stops[0].max, 0.0));
    }
}

#[test]
fn lower_stops_hold_the_pitch_joints() {
    let mut arm = Arm::new(weightless(), &Start::default()).unwrap();
    let push = Inputs {
        tau_a: [0.0, -60.0, -60.0],
        ..Inputs::default()
    };
    for _ in 0..300 {
        arm.advance(&push, 50, DT);
        assert!(arm.q()[1] >= -2.0 && arm.q()[2] >= 0.1);
    }
    assert_eq!(
        (arm.q()[1], arm.q()[2], arm.dq()),
        (-2.0, 0.1, Vector3::zeros())
    );
}

#[test]
fn at_rest_the_table_bears_the_load_by_its_stiffness() {
    let parameters = corner(1e-3);
    let mut arm = Arm::new(parameters, &Start::default()).unwrap();
    arm.advance(&pushed([0.0, 0.0, -50.0]), SETTLE, DT);
    assert!(
        (arm.f_e() - Vector3::new(0.0, 0.0, 50.0)).amax() < 1e-9,
        "{}",
        arm.f_e()
    );
    let penetration = parameters.table.z - arm.place().pad.p.z;
    assert!((penetration - 50.0 / 1e5).abs() < 1e-12, "{penetration}");
    assert!((arm.state().s[0] - penetration).abs() < 1e-15);
}

#[test]
fn the_wall_bears_the_load_along_x() {
    let mut arm = Arm::new(corner(1e-3), &Start::default()).unwrap();
    arm.advance(&pushed([60.0, 0.0, 0.0]), SETTLE, DT);
    assert!(
        (arm.f_e() - Vector3::new(-60.0, 0.0, 0.0)).amax() < 1e-9,
        "{}",
        arm.f_e()
    );
}

#[test]
fn surfaces_never_pull() {
    let mut arm = Arm::new(corner(1e-3), &Start::default()).unwrap();
    arm.advance(&pushed([60.0, 0.0, -50.0]), 1_000, DT);
    for _ in 0..2_500 {
        arm.advance(&pushed([-80.0, 0.0, 300.0]), 1, DT);
        let grip = 0.4 * (arm.f_e().z.abs() + arm.f_e().x.abs());
        assert!(
            arm.f_e().z >= -grip
                && arm.f_e().x <= grip
                && (arm.contact() || arm.f_e() == Vector3::zeros())
        );
    }
    assert_eq!((arm.f_e(), arm.contact()), (Vector3::zeros(), false));
    // The surfaces have relaxed with a time constant of 30 ms.
    assert!(
        arm.state().s.iter().all(|s| (0.0..1e-8).contains(s)),
        "{:?}",
        arm.state().s
    );
}

/// Pressed with `press`, then rubbed with `rub` besides: the friction that answers, and the displacement of the pad.
fn rubbed(press: [f64; 3], rub: [f64; 3]) -> (Vector3<f64>, Vector3<f64>) {
    let mut arm = Arm::new(corner(1e-3), &Start::default()).unwrap();
    arm.advance(&pushed(press), SETTLE, DT);
    let (p, f) = (arm.place().pad.p, arm.f_e());
    arm.advance(&pushed([0, 1, 2].map(|i| press[i] + rub[i])), 1_000, DT);
    (arm.f_e() - f, arm.place().pad.p - p)
}

#[test]
fn friction_on_the_table_sticks_up_to_its_limit_and_slides_beyond() {
    // 0.4 · 50 N = 20 N.
    for (along, other) in [(0, 1), (1, 0)] {
        let rub = |size: f64| Vector3::ith(along, size).into();
        let (f, moved) = rubbed([0.0, 0.0, -50.0], rub(-19.0));
        assert!((f[along] - 19.0).abs() < 1e-9, "{f}"); // the rest of settling
        assert!(moved.amax() < 1e-12, "{moved}");
        let (f, moved) = rubbed([0.0, 0.0, -50.0], rub(-21.0));
        assert!((f.xy().norm() - 0.4 * (50.0 + f.z)).abs() < 1e-9, "{f}"); // at the limit of the normal force of that moment
        assert!(
            moved[along] < -1e-4 && moved[other].abs() < moved[along].abs(),
            "{moved}"
        );
    }
}

/// Angles in the plane of the table (rad), and the four quadrants.
fn directions() -> impl Iterator<Item = [f64; 2]> {
    [0.0_f64, 15.0, 30.0, 45.0, 60.0, 90.0, 135.0, -120.0]
        .into_iter()
        .map(|angle| [angle.to_radians().cos(), angle.to_radians().sin()])
}

#[test]
fn the_pad_breaks_away_from_the_table_at_the_same_force_in_every_direction() {
    // μ N = 0.4 · 50 N. Settling leaves 1e-9 N of the normal force.
    for [x, y] in directions() {
        for (share, slides) in [(1.0 - 1e-6, false), (1.0 + 1e-6, true)] {
            let push = 20.0 * share;
            let (_, moved) = rubbed([0.0, 0.0, -50.0], [push * x, push * y, 0.0]);
            // Beyond by 20 µN: over 100 kg and 0.2 s that is 4 nm, and more where the arm is lighter.
            assert_eq!(
                moved.xy().norm() > 1e-10,
                slides,
                "{x} {y} {share}: {moved}"
            );
        }
    }
}

#[test]
fn friction_on_the_table_opposes_the_velocity_in_every_direction() {
    for [x, y] in directions() {
        let mut arm = Arm::new(corner(1e-3), &Start::default()).unwrap();
        arm.advance(&pushed([0.0, 0.0, -50.0]), SETTLE, DT);
        arm.advance(&pushed([25.0 * x, 25.0 * y, -50.0]), 100, DT);
        // The velocity that the solver found, before the joints moved on: of second order in the substep.
        let before = arm;
        arm.advance(&pushed([25.0 * x, 25.0 * y, -50.0]), 1, DT);
        let w = before.place().pad.J * arm.dq();
        let (w, t) = (w.xy(), arm.f_e().xy());
        assert!((t.norm() - 0.4 * arm.f_e().z).abs() < 1e-12 * 20.0, "{t}");
        assert!((t.normalize() + w.normalize()).norm() < 1e-10, "{w} {t}");
    }
}

#[test]
fn friction_on_the_wall_sticks_up_to_its_limit_and_slides_beyond() {
    let (f, moved) = rubbed([60.0, 0.0, 0.0], [0.0, 0.0, 23.0]); // of 24 N
    assert!(
        (f.z + 23.0).abs() < 1e-9 && moved.amax() < 1e-12,
        "{f}{moved}"
    );
    let (f, moved) = rubbed([60.0, 0.0, 0.0], [0.0, 0.0, 26.0]);
    assert!(
        (f.yz().norm() - 0.4 * (60.0 - f.x)).abs() < 1e-9 && moved.z > 1e-4,
        "{f}{moved}"
    );
}

#[test]
fn in_the_corner_table_and_wall_rub_together() {
    // 0.4 · 50 N and 0.4 · 60 N along y: 30 N is more than either holds, 46 N more than both. Friction that bore a part of the
    // press is not there for y: the pad slips until it has turned, and then rests.
    let mut arm = Arm::new(corner(1e-3), &Start::default()).unwrap();
    arm.advance(&pushed([60.0, 0.0, -50.0]), SETTLE, DT);
    arm.advance(&pushed([60.0, 30.0, -50.0]), SETTLE, DT);
    let (p, f) = (arm.place().pad.p, arm.f_e());
    assert!((f - Vector3::new(-60.0, -30.0, 50.0)).amax() < 1e-9, "{f}");
    arm.advance(&pushed([60.0, 30.0, -50.0]), 1_000, DT);
    assert!((arm.place().pad.p - p).amax() < 1e-12);
    let (_, moved) = rubbed([60.0, 0.0, -50.0], [0.0, 46.0, 0.0]);
    assert!(moved.y > 1e-4, "{moved}");
}

/// Speed with which the pad rebounds from an undamped table of stiffness `k`, over that with which it came, in substeps of `dt`.
fn rebound(k: f64, dt: f64) -> f64 {
    let mut parameters = corner(0.0);
    (parameters.table.k, parameters.table.c, parameters.table.mu) = (k, 0.0, 0.0);
    parameters.wall.x = 10.0;
    for friction in &mut parameters.friction {
        friction.b = 0.0;
    }
    let mut arm = Arm::new(parameters, &Start::default()).unwrap();
    // An impulse along z through the pad: it moves as M⁻¹ Jᵀ says, and comes back so.
    let J = arm.place().pad.J;
    let down = arm.body().M.try_inverse().unwrap() * J.transpose() * Vector3::new(0.0, 0.0, -1.0);
    let start = Start {
        dq: (down * 0.5).into(),
        ..Start::default()
    };
    let came = (J * Vector3::from(start.dq)).z;
    arm = Arm::new(parameters, &start).unwrap();
    let mut steps = 0;
    while steps == 0 || arm.contact() {
        arm.advance(&Inputs::default(), 1, dt);
        steps += 1;
    }
    -(J * arm.dq()).z / came
}

#[test]
fn a_table_too_stiff_for_the_substep_is_named_with_the_substep_that_it_needs() {
    for (k, missing) in [(1e5, 0.0134), (1e6, 0.0417), (1e7, 0.1255)] {
        let mut parameters = weightless();
        (parameters.table.k, parameters.table.z) = (k, -0.4);
        let arm = Arm::new(parameters, &Start::default()).unwrap();
        let found = arm.too_stiff(1e-4, 0.02);
        let measured = 1.0 - rebound(k, 1e-4);
        assert!(
            (measured - missing).abs() < 0.01 * missing,
            "{k:e}: {measured}"
        );
        let Some(found) = found else {
            assert!(measured < 0.02, "{k:e}");
            continue;
        };
        assert_eq!((found.name, found.k), ("table.k", k));
        assert!(
            (found.lost - measured).abs() < 0.02 * measured,
            "{found:?} {measured}"
        );
        assert!(1.0 - rebound(k, found.longest) < 0.0205, "{k:e}");
    }
    let mut far = weightless();
    far.table.k = 1e7; // 10 m below
    assert_eq!(
        Arm::new(far, &Start::default())
            .unwrap()
            .too_stiff(1e-4, 0.02),
        None
    );
    far.wall.x = 0.6;
    far.wall.k = 1e7;
    let wall = Arm::new(far, &Start::default())
        .unwrap()
        .too_stiff(1e-4, 0.02);
    assert_eq!(wall.map(|found| found.name), Some("wall.k"));
}
