//! What an arm can be, and what it refuses to be.

use mechanics::arm::{Arm, Parameters, Start};

fn refusal(change: impl FnOnce(&mut Parameters, &mut Start)) -> String {
    let (mut parameters, mut start) = (Parameters::default(), Start::default());
    change(&mut parameters, &mut start);
    Arm::new(parameters, &start)
        .expect_err("refused")
        .to_string()
}

#[test]
fn impossible_parameters_are_refused_with_name_value_and_range() {
    for (message, expected) in [
        (
            refusal(|p, _| p.masses.links[1].m = -3.5),
            "link.m[2] = -3.5 kg: expected 0.001 to 10000.0 kg",
        ),
        (
            refusal(|p, _| p.lengths.L_1 = 0.0),
            "L1 = 0.0 m: expected 0.01 to 10.0 m",
        ),
        (
            refusal(|p, _| p.lengths.A_1 = f64::NAN),
            "A1 = NaN m: expected 0.0 to 10.0 m",
        ),
        (
            refusal(|_, s| s.q[2] = 2.7),
            "q_start[3] = 2.7 rad: expected 0.1 to 2.6 rad",
        ),
        (
            refusal(|_, s| s.q[0] = -1.3),
            "q_start[1] = -1.3 rad: expected -1.2 to 1.2 rad",
        ),
        (
            refusal(|_, s| s.dq[1] = f64::INFINITY),
            "dq_start[2] = inf rad/s: expected -100.0 to 100.0 rad/s",
        ),
        (
            refusal(|p, _| p.stops[0].max = -1.5),
            "stop.max[1] = -1.5 rad: expected -1.2 to 10.0 rad",
        ),
        (
            refusal(|p, _| p.friction[0].F_s = 11.0),
            "friction.F_s[1] = 11.0 N.m: expected 12.0 to 1000000.0 N.m",
        ),
        (
            refusal(|p, _| p.friction[2].v_s = 0.0),
            "friction.v_s[3] = 0.0 rad/s: expected 0.0001 to 1000.0 rad/s",
        ),
        (
            refusal(|p, _| p.masses.gear[1] = 0.0),
            "gear[2] = 0.0 1: expected 1.0 to 10000.0 1",
        ),
        (
            refusal(|p, _| p.masses.rotor[0] = -1e-5),
            "rotor.I[1] = -1e-5 kg.m2: expected 0.0 to 1.0 kg.m2",
        ),
        (
            refusal(|p, _| p.payload_m = -1.0),
            "payload.m = -1.0 kg: expected 0.0 to 10000.0 kg",
        ),
        (
            refusal(|p, _| p.vacuum.F_max = -1.0),
            "vacuum.F_max = -1.0 N: expected 0.0 to 1000000000.0 N",
        ),
        (
            refusal(|p, _| p.drive_cutoff = -1.0),
            "drive.cutoff = -1.0 Hz: expected 0.0 to 1000000.0 Hz",
        ),
        (
            refusal(|p, _| p.table.k = 0.0),
            "table.k = 0.0 N/m: expected 1.0 to 10000000.0 N/m",
        ),
        (
            refusal(|p, _| p.wall.c = -1.0),
            "wall.c = -1.0 N.s/m: expected 0.0 to 100000.0 N.s/m",
        ),
        (
            refusal(|p, _| p.wall.mu = 1.5),
            "wall.mu = 1.5 1: expected 0.0 to 1.0 1",
        ),
    ] {
        assert_eq!(message, expected);
    }
}

#[test]
fn an_inertia_that_no_body_has_is_refused() {
    // Link 2: I_xx = 0.006, I_zz = 0.034: I_yy within their difference and sum, |I_xz| within their geometric mean.
    for moment in [0.027, 0.041] {
        let message = refusal(|p, _| p.masses.links[1].I_yy = moment);
        assert!(
            message.starts_with(&format!("link.I_yy[2] = {moment} kg.m2: expected 0.028")),
            "{message}"
        );
    }
    let message = refusal(|p, _| p.masses.links[1].I_xz = 0.015);
    assert!(
        message.starts_with("link.I_xz[2] = 0.015 kg.m2: expected -0.01428"),
        "{message}"
    );
}

#[test]
fn the_pad_starts_outside_of_table_and_wall_and_may_touch_them() {
    let pad = Arm::default().place().pad.p;
    let with = |table: f64, wall: f64| {
        let mut parameters = Parameters::default();
        (parameters.table.z, parameters.wall.x) = (table, wall);
        Arm::new(parameters, &Start::default())
    };
    assert!(with(pad.z, pad.x).is_ok());
    let table = with(pad.z + 1e-6, pad.x).expect_err("refused").to_string();
    assert!(
        table.starts_with("table.z = -0.35") && table.contains("expected -1000.0 to -0.35"),
        "{table}"
    );
    let wall = with(pad.z, pad.x - 1e-6).expect_err("refused").to_string();
    assert!(
        wall.starts_with("wall.x = 0.4") && wall.contains("expected 0.4"),
        "{wall}"
    );
}

#[test]
fn the_default_is_accepted_and_shows_its_start() {
    let arm = Arm::new(Parameters::default(), &Start::default()).unwrap();
    assert_eq!(arm, Arm::default());
    assert_eq!(<[f64; 3]>::from(arm.q()), Start::default().q);
    assert_eq!(
        arm.dp().amax() + arm.f_e().amax() + arm.tau_applied().amax() + arm.tension(),
        0.0
    );
    assert!(!arm.contact() && !arm.attached());
    assert_eq!((arm.energy().kinetic, arm.energy().residual), (0.0, 0.0));
}
