//! Motion without a wall against closed forms. Backward Euler is of first order: halving the substep halves the error.

#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

use mechanics::friction::Friction;
use mechanics::substep::{Substep, substep};
use mechanics::testbed::{Forces, Parameters, State, Testbed};
use mechanics::wall::Wall;

const MASS_KG: f64 = 6.0;

/// A mass in free space, starting at q = 0 with `dq_start`.
fn free(friction: Friction, dq_start: f64) -> Testbed {
    let wall = Wall {
        q: Wall::NONE,
        ..Parameters::default().wall
    };
    Testbed::new(
        Parameters {
            M: MASS_KG,
            friction,
            wall,
        },
        0.0,
        dq_start,
    )
    .unwrap()
}

fn push(tau_h: f64) -> Forces {
    Forces {
        tau_h,
        ..Forces::default()
    }
}

#[test]
fn viscous_flight_converges_to_the_closed_form_with_order_one() {
    let (b, force, dq_0, t) = (2.0, 5.0, 0.7, 4.0);
    // M dv/dt = F − b v:  v = v_∞ + (v_0 − v_∞) e^{−b t/M},  q = v_∞ t + (v_0 − v_∞)(M/b)(1 − e^{−b t/M})
    let (v_inf, decay) = (force / b, (-b * t / MASS_KG).exp());
    let dq_exact = v_inf + (dq_0 - v_inf) * decay;
    let q_exact = v_inf * t + (dq_0 - v_inf) * (MASS_KG / b) * (1.0 - decay);

    let error = |n: u32| {
        let mut plant = free(Friction { F_c: 0.0, b }, dq_0);
        plant.advance(&push(force), n, t / f64::from(n));
        (plant.q() - q_exact, plant.dq() - dq_exact)
    };
    let (q_1, dq_1) = error(20_000);
    let (q_2, dq_2) = error(40_000);
    // Leading error terms of backward Euler with a = b/M: in v, (v_0 − v_∞) e^{−a t} a² t dt/2; in q, its share of the
    // transient, bounded by the velocity's range times dt.
    let a = b / MASS_KG;
    let dq_leading = (dq_0 - v_inf) * decay * a * a * t * (t / 20_000.0) / 2.0;
    assert!(
        (dq_1 / dq_leading - 1.0).abs() < 1e-3,
        "{dq_1:e} {dq_leading:e}"
    );
    assert!(
        q_1.abs() < (dq_exact - dq_0).abs() * t / 20_000.0,
        "{q_1:e}"
    );
    // Second-order terms: relative a dt = 7e-5.
    assert!((q_1 / q_2 - 2.0).abs() < 1e-3, "{q_1:e} {q_2:e}");
    assert!((dq_1 / dq_2 - 2.0).abs() < 1e-3, "{dq_1:e} {dq_2:e}");
}

#[test]
fn without_friction_the_discrete_motion_is_exactly_that_of_backward_euler() {
    let (force, dt, n) = (3.0, 8e-5, 25_000);
    let mut plant = free(Friction { F_c: 0.0, b: 0.0 }, 0.0);
    plant.advance(&push(force), n, dt);
    // v_n = n dt F/M,  q_n = ½ n (n + 1) dt² F/M; the additions are compensated, a few roundings remain.
    let n = f64::from(n);
    let (dq, q) = (
        n * dt * force / MASS_KG,
        0.5 * n * (n + 1.0) * dt * dt * force / MASS_KG,
    );
    assert!(
        (plant.dq() / dq - 1.0).abs() < 1e-15,
        "{:e}",
        plant.dq() / dq - 1.0
    );
    assert!(
        (plant.q() / q - 1.0).abs() < 1e-15,
        "{:e}",
        plant.q() / q - 1.0
    );
}

#[test]
fn coulomb_friction_stops_the_mass_after_M_v2_over_2_F_c_and_keeps_it_there() {
    let (F_c, dq_0) = (0.64, 0.5);
    let distance = MASS_KG * dq_0 * dq_0 / (2.0 * F_c);
    let stop = |n: u32| {
        let mut plant = free(Friction { F_c, b: 0.0 }, dq_0);
        let dt = 6.0 / f64::from(n); // it stops at 4.6875 s
        plant.advance(&Forces::default(), n, dt);
        assert_eq!(plant.dq(), 0.0);
        let q = plant.q();
        plant.advance(&Forces::default(), n, dt);
        assert_eq!(plant.q().to_bits(), q.to_bits());
        assert!((plant.energy().loss_coulomb - F_c * q).abs() < 1e-12);
        (q - distance, dt)
    };
    for n in [10_000, 20_000, 40_000] {
        // Backward Euler takes each substep's velocity from its end: short by ½ v_0 dt. The last substep, in which the
        // mass stops, adds at most ⅛ F_c dt²/M.
        let (error, dt) = stop(n);
        assert!(
            (error + 0.5 * dq_0 * dt).abs() <= 0.125 * F_c * dt * dt / MASS_KG + 1e-12,
            "{error:e}"
        );
    }
}

#[test]
fn a_viscous_decay_ends_at_zero_without_denormal_numbers() {
    let parameters = Parameters {
        M: MASS_KG,
        friction: Friction { F_c: 0.0, b: 1e4 },
        ..Parameters::default()
    };
    let mut state = State {
        dq: 1.0.into(),
        ..State::default()
    };
    for _ in 0..10_000 {
        let Substep {
            state: end, flow, ..
        } = substep(&parameters, &state, &Forces::default(), 8e-5);
        for x in [end.dq.value(), flow.loss_viscous, flow.loss_step] {
            assert!(x == 0.0 || x.is_normal(), "{x:e}");
        }
        state = end;
    }
    assert_eq!(state.dq.value(), 0.0);

    // All of ½ M v² went into the viscous and the integrator's loss; what the floor dropped does not show.
    let mut plant = free(parameters.friction, 1.0);
    plant.advance(&Forces::default(), 10_000, 8e-5);
    let energy = plant.energy();
    assert_eq!(energy.kinetic, 0.0);
    assert!(energy.residual.abs() < 1e-15, "{:e}", energy.residual); // of 3 J
}
