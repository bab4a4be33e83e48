//! The energy balance over the wall scenario with a disturbance that hits the wall again and again.

use mechanics::testbed::{Forces, Parameters, Testbed};
use std::f64::consts::TAU;

/// Human force of the wall scenario (N): sine in free space, push until 20 s, pull afterwards.
fn tau_h(t: f64) -> f64 {
    match t {
        t if t < 10.0 => 4.17 * (TAU * 0.31 * t).sin(),
        t if t < 20.0 => 5.0 * ((t - 10.0) / 0.5).min(1.0),
        t => 5.0 - 10.0 * ((t - 20.0) / 0.5).min(1.0),
    }
}

/// Bang-bang disturbance (N), at all times.
fn tau_d(t: f64) -> f64 {
    25.0_f64.copysign((TAU * 0.7 * t).sin())
}

#[test]
fn the_balance_closes_over_60_s_of_wall_hits() {
    let mut plant = Testbed::default();
    let wall = Parameters::default().wall;
    let (mut landings, mut apart, mut throughput, mut worst) = (0, true, 0.0_f64, 0.0_f64);
    let mut before = plant.energy();
    for k in 0..30_000_u32 {
        let t = f64::from(k) * 0.002;
        // A saturated actuator that keeps the mass near the wall, so that it hits it all through the run.
        let tau_a = (60.0 * (wall.q - plant.q()) - 10.0 * plant.dq()).clamp(-12.5, 12.5);
        let forces = Forces {
            tau_a,
            tau_h: tau_h(t),
            tau_d: tau_d(t),
        };
        for _ in 0..25 {
            plant.advance(&forces, 1, 8e-5);
            let touching = plant.tau_e() < 0.0;
            landings += u32::from(touching && apart);
            apart = !touching;
        }
        let now = plant.energy();
        throughput += (now.work_tau_a - before.work_tau_a).abs()
            + (now.work_tau_h - before.work_tau_h).abs()
            + (now.work_tau_d - before.work_tau_d).abs();
        worst = worst.max(now.residual.abs());
        before = now;
    }
    println!(
        "{landings} landings, throughput {throughput:.1} J, worst residual {worst:.1e} J\n{before:#?}"
    );
    assert!(landings > 20, "{landings}");
    assert!(throughput > 100.0, "{throughput}");
    // Rounding of the balance itself: ten terms of up to 400 J, half a unit in the last place each (2.8e-14 J).
    assert!(worst < 3e-13, "{worst:e} J of {throughput} J");
    for loss in [
        before.loss_coulomb,
        before.loss_viscous,
        before.loss_wall,
        before.loss_impact,
        before.loss_step,
    ] {
        assert!(loss > 0.0, "{before:?}");
    }
}

#[test]
fn the_balance_closes_at_constant_speed_far_away() {
    // At 10 m/s a rounding of the momentum is worth up to 5e-14 J; 3e-11 J remain of 750 000, were position and
    // velocity plain numbers.
    let mut plant = Testbed::default();
    plant.advance(
        &Forces {
            tau_h: -3.0,
            ..Forces::default()
        },
        750_000,
        8e-5,
    );
    let energy = plant.energy();
    println!(
        "q = {:.1} m, dq = {:.2} m/s, residual {:.1e} J",
        plant.q(),
        plant.dq(),
        energy.residual
    );
    assert!(plant.q() < -300.0 && plant.dq() < -10.0);
    // Rounding of the balance: works of 1200 J, half a unit in the last place 1.1e-13 J, in three large terms.
    assert!(energy.residual.abs() < 3.5e-13, "{:e}", energy.residual);
}

#[test]
fn integrator_and_landing_losses_halve_with_the_substep() {
    let lost = |n: u32| {
        let mut plant = Testbed::new(Parameters::default(), 0.3, 0.8).unwrap();
        plant.advance(&Forces::default(), n, 0.05 / f64::from(n));
        plant.energy().loss_step + plant.energy().loss_impact
    };
    let (coarse, fine) = (lost(10_000), lost(20_000));
    assert!(
        coarse > 0.0 && (coarse / fine - 2.0).abs() < 1e-2,
        "{coarse:e} {fine:e}"
    );
}
