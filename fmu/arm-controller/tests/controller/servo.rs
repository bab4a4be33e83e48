//! The law in joint space through drives that take positions (footnote of sec:standard_adm): on the arm with its friction, its table and a payload.

use crate::initialized;
use arm_controller::ArmController;
use fmu_export::{Log, Model, Step};
use mechanics::arm::drive::Drive as Lag;
use mechanics::arm::{Arm, Inputs, Parameters, Start};
use nalgebra::Vector3;

/// Sample period, s, and substeps of the plant in it; the drives' cycles are the substeps.
const T: f64 = 0.001;
const SUBSTEPS: u32 = 10;

/// The joints' drives, each with its own gains and limit.
#[derive(Clone, Copy)]
struct Drives {
    K: f64,
    K_P: f64,
    tau_max: [f64; 3],
}

/// The law's own.
const LAW: Drives = Drives {
    K: 400.0,
    K_P: 20.0,
    tau_max: [100.0, 155.0, 140.0],
};

/// What the arm gets from the controller.
#[derive(Clone, Copy)]
enum Form {
    Torque,
    Servo(Drives),
}

/// What a run showed at every tick.
#[derive(Default)]
struct Run {
    z: Vec<f64>,
    attached: Vec<bool>,
    torque: f64,
    least_tank: f64,
    fault: i32,
    debt: bool,
}

/// The payload's course: pressed onto the table with `f_z`(t) (N), the vacuum on from 2 s.
fn course(form: Form, seconds: u32, f_z: impl Fn(f64) -> f64, vacuum: bool) -> Run {
    let mut c = initialized(|c| {
        c.parameters.space = 2;
        c.parameters.tau_max = LAW.tau_max;
        c.parameters.form = if matches!(form, Form::Servo(_)) { 2 } else { 1 };
    });
    let mut plant = plant();
    let lag = Lag::new(plant.parameters().drive_cutoff, T / f64::from(SUBSTEPS));
    let mut run = Run {
        least_tank: f64::INFINITY,
        ..Run::default()
    };
    for k in 0..seconds * 1000 {
        let t = f64::from(k) * T;
        let f_h = [0.0, 0.0, f_z(t)];
        (c.inputs.q, c.inputs.f_h) = (plant.q().into(), f_h);
        c.step(Step::at(t, T), &mut Log::silent()).expect("a step");
        let mut inputs = Inputs {
            f_h,
            vacuum: vacuum && t >= 2.0,
            ..Inputs::default()
        };
        let mut mean = Vector3::zeros();
        for _ in 0..SUBSTEPS {
            inputs.tau_a = match form {
                Form::Torque => c.outputs.tau_a,
                Form::Servo(drives) => asked(&drives, &c, &plant),
            };
            plant.substep(&lag, &inputs, T / f64::from(SUBSTEPS));
            mean += plant.tau_applied() / f64::from(SUBSTEPS);
        }
        c.inputs.tau_a_measured = mean.into();
        run.z.push(plant.p().z);
        run.attached.push(plant.attached());
        run.torque = run.torque.max(mean.amax());
        run.least_tank = run.least_tank.min(c.outputs.tank);
        run.fault = run.fault.max(c.outputs.drive_fault);
        run.debt |= c.outputs.debt != 0;
    }
    run
}

fn plant() -> Arm {
    let mut parameters = Parameters {
        payload_m: 17.5,
        ..Parameters::default()
    };
    parameters.table.z = -0.4171;
    Arm::new(parameters, &Start::default()).expect("an arm")
}

/// Torques that the drives ask for.
fn asked(drives: &Drives, c: &ArmController, plant: &Arm) -> [f64; 3] {
    let (q_d, dq_d) = (Vector3::from(c.outputs.q_d), Vector3::from(c.outputs.dq_d));
    let y = (dq_d - plant.dq()) + (q_d - plant.q()) * drives.K_P;
    let limited = (y * drives.K).zip_map(&Vector3::from(drives.tau_max), |tau, tau_max| {
        tau.clamp(-tau_max, tau_max)
    });
    limited.into()
}

/// 1 in (`from`, `to`), with ramps of half a second.
fn window(t: f64, from: f64, to: f64) -> f64 {
    ((t - from) / 0.5).clamp(0.0, 1.0) - ((t - to) / 0.5).clamp(0.0, 1.0)
}

/// docs/specification.md section 6, Exp 3: press, take the payload, lift it.
fn carry(t: f64) -> f64 {
    -6.0 * window(t, 1.0, 5.0) + 4.0 * window(t, 7.0, 10.0)
}

fn lift(run: &Run) -> f64 {
    let before = run.z[6000..7000].iter().sum::<f64>() / 1000.0;
    run.z[8000..]
        .iter()
        .fold(f64::NEG_INFINITY, |a, z| a.max(*z))
        - before
}

#[test]
fn a_payload_is_carried_through_position_drives_as_it_is_by_torques() {
    let torque = course(Form::Torque, 12, carry, true);
    let servo = course(Form::Servo(LAW), 12, carry, true);
    let (by_torque, by_servo) = (lift(&torque), lift(&servo));
    println!("lift {by_torque} m by torques, {by_servo} m through drives");
    assert!(by_torque > 0.2);
    // The reaction is a sample late, 1 ms beside the course's seconds; friction makes steps of it.
    assert!((by_servo / by_torque - 1.0).abs() < 0.02);
    assert!(servo.attached[11_999] && torque.attached[11_999]);
    assert!(servo.torque <= 155.0 * (1.0 + 1e-12) && servo.torque > 60.0);
    assert_eq!((servo.fault, servo.debt), (0, false));
    assert!(servo.least_tank > 9.0, "{}", servo.least_tank);
}

/// Time from the pull until the hand is 2 mm off the table, s.
fn leaving(form: Form) -> (f64, Run) {
    let press = |t: f64| -20.0 * window(t, 1.0, 4.0) + 10.0 * window(t, 4.0, 60.0);
    let run = course(form, 8, press, false);
    let pressed = run.z[3500..4000].iter().sum::<f64>() / 500.0;
    let left = run.z[4000..].iter().position(|z| *z > pressed + 2e-3);
    let time = left.map_or(f64::INFINITY, |ticks| ticks as f64 * T);
    (time, run)
}

#[test]
fn drives_that_are_not_quite_the_law_let_go_of_the_table_all_the_same() {
    let (exact, run) = leaving(Form::Servo(LAW));
    let (torque, _) = leaving(Form::Torque);
    println!("leaving after {torque} s by torques, {exact} s through drives");
    assert!(exact < 1.0 && (exact - torque).abs() < 0.03);
    assert_eq!((run.fault, run.debt), (0, false));
    for part in [0.9, 1.1] {
        let drives = [
            Drives {
                K: LAW.K * part,
                ..LAW
            },
            Drives {
                K_P: LAW.K_P * part,
                ..LAW
            },
            Drives {
                tau_max: LAW.tau_max.map(|tau| tau * part),
                ..LAW
            },
        ];
        for (i, drives) in drives.into_iter().enumerate() {
            let (time, run) = leaving(Form::Servo(drives));
            println!("{i} × {part}: {time} s");
            assert!(
                (time - exact).abs() < 0.1 * exact,
                "{i} × {part}: {time} {exact}"
            );
            assert_eq!(run.fault, 0);
        }
    }
}

#[test]
fn what_has_no_servo_form_is_refused_by_name() {
    let refused = |change: fn(&mut ArmController)| {
        let mut c = ArmController::default();
        (c.parameters.form, c.parameters.space) = (2, 2);
        change(&mut c);
        c.initialize(0.0, &mut Log::silent())
            .expect_err("no form")
            .0
    };
    assert_eq!(
        refused(|c| c.parameters.space = 1),
        "space = 1: expected 2 (joint) in servo form: drives close the joints' couplings, not those at the handle"
    );
    assert_eq!(
        refused(|c| c.parameters.law = 2),
        "law = 2 (passive) has no servo form: expected 1 (standard), 3 (passive_applied), 4 (passive_bounded)"
    );
    assert_eq!(
        refused(|c| c.parameters.tau_rate_max[1] = 5.0),
        "tau_rate_max[2] = 5: expected no limit, which the torque form alone keeps"
    );
    assert_eq!(
        refused(|c| c.parameters.form = 3),
        "form = 3: expected 1 (torque), 2 (position_servo)"
    );
    let mut c = initialized(|c| (c.parameters.form, c.parameters.space) = (2, 2));
    c.parameters.joint.K = 500.0;
    assert_eq!(
        c.tune(&mut Log::silent()).expect_err("the drives'").0,
        "joint.K = 500: expected the value at the start, in servo form the drive has it too"
    );
}

/// Rest, a fault and angles that are not known have the drives stand still; a soft stop brakes the nominal first.
#[test]
fn supervision_has_the_drives_stand_still() {
    let mut c = initialized(|c| {
        (
            c.parameters.form,
            c.parameters.space,
            c.parameters.supervision,
        ) = (2, 2, 1);
        c.inputs.enable = 1;
        c.inputs.engage = 0;
        c.inputs.f_h = [0.0, 0.0, 5.0];
    });
    let q = c.inputs.q;
    let step = |c: &mut ArmController, k: u32| {
        c.inputs.heartbeat = (k % 2) as i32;
        let step = Step::at(f64::from(k) * T, T);
        c.step(step, &mut Log::silent()).expect("a step");
    };
    (0..2000).for_each(|k| step(&mut c, k));
    assert_eq!(
        (c.outputs.engaged, c.outputs.q_d, c.outputs.dq_d),
        (0, q, [0.0; 3])
    );
    c.inputs.engage = 1;
    (2000..2500).for_each(|k| step(&mut c, k));
    assert!(
        c.outputs.engaged == 1 && c.outputs.dq_d[1] > 0.0,
        "{:?}",
        c.outputs.dq_d
    );
    assert_eq!(c.outputs.tau_a, [0.0; 3]);
    // A soft stop: the nominal brakes within its freedom, then stands.
    let fast = c.outputs.dq_d[1];
    c.inputs.engage = 0;
    step(&mut c, 2500);
    assert!(c.outputs.dq_d[1] <= fast);
    (2501..5000).for_each(|k| step(&mut c, k));
    assert_eq!(
        (c.outputs.engaged, c.outputs.q_d, c.outputs.dq_d),
        (0, q, [0.0; 3])
    );
    // An emergency stop, from the loop, at once.
    c.inputs.engage = 1;
    (5000..5500).for_each(|k| step(&mut c, k));
    assert!(c.outputs.engaged == 1 && c.outputs.dq_d[1] > 0.0);
    c.inputs.emergency_stop = 1;
    step(&mut c, 5500);
    assert_eq!(
        (c.outputs.engaged, c.outputs.q_d, c.outputs.dq_d),
        (0, q, [0.0; 3])
    );
}
