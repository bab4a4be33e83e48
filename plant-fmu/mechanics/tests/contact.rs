//! The wall against the closed forms of a linear Kelvin–Voigt contact.

#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

use mechanics::friction::Friction;
use mechanics::testbed::{Forces, Parameters, Testbed};
use mechanics::wall::Wall;

const NO_FRICTION: Friction = Friction { F_c: 0.0, b: 0.0 };
const WALL: Wall = Wall {
    q: 0.3,
    k: 1e5,
    c: 300.0,
};
const MASS_KG: f64 = 6.0;

fn push(tau_h: f64) -> Forces {
    Forces {
        tau_h,
        ..Forces::default()
    }
}

/// The mass touches the wall at t = 0 with velocity `dq_start`.
fn landing(dq_start: f64) -> Testbed {
    Testbed::new(
        Parameters {
            M: MASS_KG,
            friction: NO_FRICTION,
            wall: WALL,
        },
        WALL.q,
        dq_start,
    )
    .unwrap()
}

/// While in contact M s̈ + c ṡ + k s = 0: decay rate δ and angular frequency ω_d (1/s).
fn contact_modes() -> (f64, f64) {
    let delta = WALL.c / (2.0 * MASS_KG);
    (delta, (WALL.k / MASS_KG - delta * delta).sqrt())
}

#[test]
fn a_steady_push_deflects_the_wall_by_force_over_stiffness() {
    let mut plant = landing(0.0);
    plant.advance(&push(5.0), 25_000, 8e-5); // 2 s = 50 decay times
    // The oscillation has died down to e^{−50}, 2e-22 of the 2e-5 m/s with which it began; the rest is rounding.
    assert!(
        (plant.state().s / (5.0 / WALL.k) - 1.0).abs() < 1e-14,
        "{:e}",
        plant.state().s / (5.0 / WALL.k) - 1.0
    );
    assert!(
        (plant.tau_e() + 5.0).abs() < 1e-12,
        "{:e}",
        plant.tau_e() + 5.0
    );
    assert!((plant.q() - WALL.q - 5.0 / WALL.k).abs() < 6e-17); // one unit in the last place of 0.3 m
    assert!(
        plant.energy().residual.abs() < 1e-18,
        "{:e}",
        plant.energy().residual
    );
}

#[test]
fn with_friction_the_rest_deflection_lies_within_its_limits() {
    let mut plant = Testbed::new(
        Parameters {
            wall: WALL,
            ..Parameters::default()
        },
        0.29,
        0.0,
    )
    .unwrap();
    let F_c = Parameters::default().friction.F_c;
    plant.advance(&push(5.0), 50_000, 8e-5);
    assert_eq!(plant.dq(), 0.0);
    let wall = -plant.tau_e();
    assert!((5.0 - F_c..=5.0 + F_c).contains(&wall), "{wall}");
    assert!((5.0 + plant.tau_f() + plant.tau_e()).abs() < 1e-9);
}

#[test]
fn contact_motion_converges_to_the_damped_oscillation_with_order_one() {
    let (v_0, (delta, omega)) = (0.5, contact_modes());
    let t = 0.8 * std::f64::consts::PI / omega; // past the deepest point, before the wall lets go
    // s = (v_0/ω_d) e^{−δ t} sin ω_d t
    let exact = v_0 / omega * (-delta * t).exp() * (omega * t).sin();
    let error = |n: u32| {
        let mut plant = landing(v_0);
        plant.advance(&Forces::default(), n, t / f64::from(n));
        assert!(plant.tau_e() < 0.0);
        plant.q() - WALL.q - exact
    };
    let (e_1, e_2) = (error(4_000), error(8_000));
    assert!(e_1.abs() < 2e-3 * exact, "{e_1:e}");
    assert!((e_1 / e_2 - 2.0).abs() < 5e-3, "{e_1:e} {e_2:e}"); // second-order terms: ω_d dt = 6e-4
}

#[test]
fn restitution_converges_to_the_closed_form_with_order_one() {
    let (v_0, (delta, omega)) = (0.5, contact_modes());
    // The wall lets go when λ = −M s̈ = 0, before it has relaxed: tan ω_d t = 2 δ ω_d/(δ² − ω_d²), and there
    // ds/dt = −v_0 e^{−δ t}.
    let t = (2.0 * delta * omega).atan2(delta * delta - omega * omega) / omega;
    let exact = (-delta * t).exp();
    assert!((0.55..0.65).contains(&exact), "{exact}"); // damping ratio 0.194
    let error = |n: u32| {
        let mut plant = landing(v_0);
        plant.advance(&Forces::default(), n, 0.1 / f64::from(n));
        assert_eq!(plant.tau_e(), 0.0);
        assert_eq!(plant.energy().loss_impact, 0.0); // it started in touch, and did not land again
        -plant.dq() / v_0 - exact
    };
    // λ passes through zero with a slope, so the moment of release hardly matters: order one remains.
    let (e_1, e_2) = (error(40_000), error(80_000));
    assert!(e_1.abs() < 1e-3, "{e_1:e}");
    assert!((e_1 / e_2 - 2.0).abs() < 2e-2, "{e_1:e} {e_2:e}");
}

/// Share of the rebound speed that is missing from the closed form of an undamped wall of stiffness `k`: all of it comes back.
fn missing(k: f64, dt: f64) -> f64 {
    let wall = Wall { k, c: 0.0, ..WALL };
    let parameters = Parameters {
        M: MASS_KG,
        friction: NO_FRICTION,
        wall,
    };
    let mut plant = Testbed::new(parameters, wall.q, 0.5).unwrap();
    let contact = std::f64::consts::PI * (MASS_KG / k).sqrt();
    plant.advance(
        &Forces::default(),
        (2.0 * contact / dt).ceil() as u32 + 2,
        dt,
    );
    assert_eq!(plant.tau_e(), 0.0);
    1.0 + plant.dq() / 0.5
}

#[test]
fn rebound_speed_loses_at_the_default_substep_what_is_said_and_2_percent_at_the_substep_that_is_advised()
 {
    let wall = |k| Wall { k, ..WALL };
    for (k, measured) in [
        (1e5, 0.0161),
        (1e6, 0.0499),
        (1e7, 0.148),
        (1e8, 0.395),
        (1e9, 0.751),
    ] {
        let (lost, said) = (missing(k, 8e-5), wall(k).rebound_lost(MASS_KG, 8e-5));
        assert!((lost - measured).abs() < 0.01 * measured, "{k:e}: {lost}");
        // The formula is of first order in ω dt, 0.01 to 1.
        assert!((said - lost).abs() < 0.08 * lost, "{k:e}: {said} {lost}");
    }
    for k in [1e5, 1e6, 1e7, 1e8, 1e9] {
        let dt = wall(k).longest_substep(MASS_KG, 0.02);
        let lost = missing(k, dt);
        assert!((0.015..=0.0202).contains(&lost), "{k:e} {dt:e}: {lost}");
        assert!((wall(k).rebound_lost(MASS_KG, dt) - 0.02).abs() < 1e-12);
    }
    assert!(
        wall(1e5).longest_substep(MASS_KG, 0.02) > 8e-5,
        "the start values are not warned of"
    );
}

#[test]
fn the_wall_never_pulls_and_the_released_surface_relaxes_alone() {
    let mut plant = landing(1.0);
    let mut behind = 0;
    for _ in 0..2_500 {
        plant.advance(&Forces::default(), 1, 8e-5);
        assert!(plant.tau_e() <= 0.0);
        let (s, pen) = (plant.state().s, plant.state().q.minus(WALL.q));
        assert!(s >= pen.max(0.0));
        behind += u32::from(s > pen && s > 1e-6);
    }
    // The mass leaves at 0.6 m/s while the surface is pressed in by c v/k = 1.8 mm; it relaxes to 1 µm in
    // ln 1800 · c/k = 22 ms, 280 substeps.
    assert!((270..300).contains(&behind), "{behind}");
    assert_eq!(plant.tau_e(), 0.0);
}

#[test]
fn the_landing_loss_vanishes_with_the_substep() {
    let lost = |n: u32| {
        let mut plant = Testbed::new(
            Parameters {
                M: MASS_KG,
                friction: NO_FRICTION,
                wall: WALL,
            },
            0.25,
            0.5,
        )
        .unwrap();
        plant.advance(&Forces::default(), n, 0.2 / f64::from(n));
        assert!(plant.dq() < 0.0);
        plant.energy().loss_impact / (0.5 * MASS_KG * 0.25)
    };
    // λ over the landing substep is about c v, the gap at most v dt: a share of at most 2 c dt/M of ½ M v².
    for n in [2_500, 25_000, 250_000] {
        let share = lost(n);
        assert!(
            share >= 0.0 && share <= 2.0 * WALL.c * (0.2 / f64::from(n)) / MASS_KG * 1.1,
            "{n}: {share:e}"
        );
    }
}
