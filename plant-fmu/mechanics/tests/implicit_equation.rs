//! One substep from random states with random parameters: it solves the implicit equation, contact is complementary, no
//! loss is negative and the energy closes.

#![allow(
    non_snake_case,
    reason = "the paper's symbols with its capitals: M, F_c"
)]

use mechanics::friction::Friction;
use mechanics::substep::{Substep, substep};
use mechanics::testbed::{Forces, Parameters, State};
use mechanics::wall::Wall;
use proptest::prelude::*;

#[derive(Clone, Copy, Debug)]
struct Case {
    parameters: Parameters,
    state: State,
    forces: Forces,
    dt: f64,
}

/// 10^low … 10^high, every decade equally likely.
fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|x| 10_f64.powf(x))
}

/// Zero now and then, else decades.
fn maybe(low: f64, high: f64) -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 4 => decades(low, high)]
}

/// Either sign.
fn signed(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (maybe(low, high), any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}

prop_compose! {
    fn cases()(
        M in decades(-1.0, 2.0), F_c in maybe(-2.0, 2.0), b in maybe(-2.0, 2.0),
        wall_q in -1.0..1.0_f64, k in decades(2.0, 6.0), c in maybe(0.0, 4.0),
        s in maybe(-8.0, -2.0), behind in maybe(-8.0, -1.0), dq in signed(-6.0, 1.0),
        tau_a in signed(-3.0, 3.0), tau_h in signed(-3.0, 3.0), tau_d in signed(-3.0, 3.0), dt in decades(-6.0, -3.0),
    ) -> Case {
        // The mass touches the surface or is behind it.
        let q = wall_q + s - behind;
        Case {
            parameters: Parameters { M, friction: Friction { F_c, b }, wall: Wall { q: wall_q, k, c } },
            state: State { q: q.into(), dq: dq.into(), s: s.max(q - wall_q) },
            forces: Forces { tau_a, tau_h, tau_d },
            dt,
        }
    }
}

fn run(case: &Case) -> Substep {
    substep(&case.parameters, &case.state, &case.forces, case.dt)
}

/// Impulses on the mass if it moves at `v` in the substep, Coulomb friction left out: M (dq − v) + dt Σ τ − dt b v − j_e(v).
fn balance(case: &Case, v: f64) -> f64 {
    let Case {
        parameters: Parameters { M, friction, wall },
        state,
        forces,
        dt,
    } = *case;
    let s_free = state.s * wall.c / (wall.k * dt + wall.c);
    let lambda = (wall.k + wall.c / dt) * (state.q.value() - wall.q + dt * v - s_free);
    M * (state.dq.value() - v)
        + dt * (forces.tau_a + forces.tau_h + forces.tau_d - friction.b * v - lambda.max(0.0))
}

/// The implicit equation by bisection: the balance falls strictly with v, and meets the set F_c dt Sgn(v) once.
fn bisected(case: &Case) -> f64 {
    let limit = case.parameters.friction.F_c * case.dt;
    let at_rest = balance(case, 0.0);
    if at_rest.abs() <= limit {
        return 0.0;
    }
    let friction = limit.copysign(at_rest);
    let reach = (at_rest - friction) / case.parameters.M; // the mass alone resists at least this much
    let (mut low, mut high) = if reach > 0.0 {
        (0.0, reach)
    } else {
        (reach, 0.0)
    };
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if balance(case, middle) > friction {
            low = middle
        } else {
            high = middle
        }
    }
    0.5 * (low + high)
}

/// Sum of the sizes of all impulses in the equation (N·s).
fn impulses(case: &Case, done: &Substep) -> f64 {
    let Case {
        parameters: Parameters { M, .. },
        state,
        forces,
        dt,
    } = *case;
    M * (state.dq.value().abs() + done.state.dq.value().abs())
        + dt * (forces.tau_a.abs()
            + forces.tau_h.abs()
            + forces.tau_d.abs()
            + done.tau_f.abs()
            + done.tau_e.abs())
}

/// What a rounding of the position (at most 3 m: 4.4e-16 m) is worth as an impulse (N·s).
fn rounding_of_the_position(case: &Case) -> f64 {
    4.4e-16 * (case.parameters.wall.k * case.dt + case.parameters.wall.c)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_closed_form_equals_the_bisected_solution(case in cases()) {
        let done = run(&case);
        let m = case.parameters.M; // the least by which the equation's left side grows with v
        let tolerance = (1e-14 * impulses(&case, &done) + 4.0 * rounding_of_the_position(&case)) / m;
        let v = bisected(&case);
        prop_assert!((done.state.dq.value() - v).abs() <= tolerance, "{:e} {v:e} ± {tolerance:e}", done.state.dq.value());
    }

    #[test]
    fn the_forces_that_are_reported_move_the_mass(case in cases()) {
        let (done, Forces { tau_a, tau_h, tau_d }) = (run(&case), case.forces);
        let sum = tau_a + tau_h + tau_d + done.tau_f + done.tau_e;
        let off = case.parameters.M * (done.state.dq.value() - case.state.dq.value()) - case.dt * sum;
        prop_assert!(off.abs() <= 1e-14 * impulses(&case, &done) + rounding_of_the_position(&case), "{off:e}");
        prop_assert!((done.state.q.value() - case.state.q.value() - case.dt * done.state.dq.value()).abs() <= 4.4e-16);
    }

    #[test]
    fn friction_is_in_its_set(case in cases()) {
        let (done, Friction { F_c, b }) = (run(&case), case.parameters.friction);
        let coulomb = -done.tau_f - b * done.state.dq.value();
        let rounding = 1e-15 * (F_c + done.tau_f.abs());
        prop_assert!(coulomb.abs() <= F_c + rounding);
        if done.state.dq.value() != 0.0 {
            prop_assert!((coulomb - F_c.copysign(done.state.dq.value())).abs() <= rounding, "{coulomb:e} {F_c:e}");
        }
    }

    #[test]
    fn the_wall_only_pushes_and_only_where_it_touches(case in cases()) {
        let done = run(&case);
        let pen = done.state.q.minus(case.parameters.wall.q);
        prop_assert!(done.tau_e <= 0.0);
        prop_assert!(done.state.s >= 0.0 && done.state.s >= pen);
        // λ (s − pen) = 0: apart by more than a rounding of the position, no force.
        if done.state.s - pen > 4.4e-16 {
            prop_assert_eq!(done.tau_e, 0.0);
        }
    }

    #[test]
    fn no_loss_is_negative_and_the_energy_closes(case in cases()) {
        let (done, Parameters { M, wall, .. }) = (run(&case), case.parameters);
        let flow = done.flow;
        let losses = [flow.loss_coulomb, flow.loss_viscous, flow.loss_wall, flow.loss_impact, flow.loss_step];
        prop_assert!(losses.iter().all(|&loss| loss >= 0.0), "{flow:?}");

        let stored = |state: &State| 0.5 * M * state.dq.value() * state.dq.value() + wall.energy(state.s);
        let works = [flow.work_tau_a, flow.work_tau_h, flow.work_tau_d];
        let (before, after) = (stored(&case.state), stored(&done.state));
        let residual = works.iter().sum::<f64>() - losses.iter().sum::<f64>() - (after - before);
        let scale = before + after + works.iter().map(|w| w.abs()).sum::<f64>() + losses.iter().sum::<f64>();
        // Roundings of the position (at most 3 m: 4.4e-16 m) times every force that it moves against.
        let surface = (done.state.s - case.state.s).abs() / case.dt;
        let inertia = M * (done.state.dq.value() - case.state.dq.value()).abs() / case.dt;
        let force = inertia + wall.k * (case.state.s + done.state.s) + 2.0 * wall.c * surface - 2.0 * done.tau_e;
        prop_assert!(residual.abs() <= 1e-15 * scale + 4.4e-16 * force, "{residual:e} J of {scale:e} J");
    }
}

#[test]
fn a_grazing_touch_does_not_pull_not_by_rounding_either() {
    // The mass flies to within a rounding of the surface: there the position that the contact force is computed from
    // may come out on the wrong side.
    let wall = Wall {
        q: 0.0,
        k: 1e9,
        c: 0.0,
    };
    let parameters = Parameters {
        M: 1e-3,
        friction: Friction { F_c: 0.0, b: 0.0 },
        wall,
    };
    let mut touched = 0;
    for k in 0..10_000 {
        let (dq, dt) = (1.0 + f64::from(k) * 1e-4, 1e-4);
        let near = (dt * dq).to_bits();
        for gap in (near - 3..=near).map(f64::from_bits) {
            let state = State {
                q: (-gap).into(),
                dq: dq.into(),
                s: 0.0,
            };
            let done = substep(&parameters, &state, &Forces::default(), dt);
            assert!(done.tau_e <= 0.0, "{state:?}: {:e}", done.tau_e);
            touched += u32::from(done.tau_e < 0.0);
        }
    }
    assert!(touched > 100, "{touched}");
}
