//! Friction that truly sticks: no creep below F_c, motion above.

#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

use mechanics::testbed::{Forces, Parameters, Testbed};

const SUBSTEP: f64 = 8e-5;

fn seconds(t: f64) -> u32 {
    (t / SUBSTEP).round() as u32
}

fn push(tau_h: f64) -> Forces {
    Forces {
        tau_h,
        ..Forces::default()
    }
}

#[test]
fn nothing_moves_in_20_s_at_999_per_mille_of_stiction() {
    let parameters = Parameters::default();
    for direction in [1.0, -1.0] {
        let force = direction * 0.999 * parameters.friction.F_c;
        let mut plant = Testbed::new(parameters, 0.123, 0.0).unwrap();
        plant.advance(&push(force), seconds(20.0), SUBSTEP);
        assert_eq!(
            (plant.q().to_bits(), plant.dq()),
            (0.123_f64.to_bits(), 0.0)
        );
        // Friction balances the push; dividing the impulse by the substep may round once.
        assert!((plant.tau_f() + force).abs() <= f64::EPSILON * force.abs());
        assert_eq!(
            plant.energy(),
            Testbed::new(parameters, 0.123, 0.0).unwrap().energy()
        );
    }
}

#[test]
fn it_holds_at_stiction_and_breaks_away_above() {
    let parameters = Parameters::default();
    let F_c = parameters.friction.F_c;
    let mut plant = Testbed::default();
    plant.advance(&push(F_c), seconds(1.0), SUBSTEP);
    assert_eq!(plant.q(), 0.0);
    plant.advance(&push(1.001 * F_c), seconds(1.0), SUBSTEP);
    // ½ · 0.001 F_c/M · t² = 53 µm; viscous friction slows it by b t/(3 M) = 1 %.
    let free = 0.5 * 0.001 * F_c / parameters.M;
    assert!(plant.q() < free && plant.q() > 0.98 * free, "{}", plant.q());
}

#[test]
fn a_mass_that_reverses_sticks_between_the_two_directions() {
    // A slow sine below breakaway most of the time: the mass rests exactly, whenever |force| ≤ F_c after a stop.
    let mut plant = Testbed::new(Parameters::default(), -5.0, 0.0).unwrap();
    let F_c = Parameters::default().friction.F_c;
    let mut held = 0;
    for i in 0..10_000 {
        let force = 1.5 * F_c * (0.5 * f64::from(i) * 0.002).sin();
        let (q, at_rest) = (plant.q(), plant.dq() == 0.0);
        plant.advance(&push(force), 25, SUBSTEP);
        if at_rest && force.abs() <= F_c {
            assert_eq!(plant.q().to_bits(), q.to_bits());
            held += 1;
        }
    }
    // |sin| stays below 1/1.5 for 46 % of a period; the mass also coasts through some of it.
    assert!((1_000..4_700).contains(&held), "{held}");
}
