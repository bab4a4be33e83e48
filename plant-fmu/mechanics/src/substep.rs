//! One substep of the testbed: the implicit equation and its solution in closed form.

use crate::energy::Flow;
use crate::testbed::{Forces, Parameters, State};

/// What one substep did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Substep {
    /// State at its end.
    pub state: State,
    /// Mean force of friction on the mass (N).
    pub tau_f: f64,
    /// Mean force of the wall on the mass (N), ≤ 0.
    pub tau_e: f64,
    /// Energy that crossed the boundaries.
    pub flow: Flow,
}

/// Advances `state` by `dt` (s) with `forces` held. Backward Euler: v = dq⁺ solves
///
/// ```text
/// M (v − dq) = dt (τ_a + τ_h + τ_d − b v) − j_f − j_e                M ddq = τ_a + τ_h + τ_d + τ_f + τ_e
/// j_f ∈ F_c dt Sgn(v),    j_e = max(0, κ (q + dt v − q_wall − s_free)),    κ = k dt + c
/// ```
///
/// j are impulses (N·s). The left side minus the right side increases strictly with v, so there is exactly one
/// solution. It is found without iteration: first as if there were no wall; if that ends beyond the relaxed surface, the
/// solution is in contact, where j_e is linear in v: κ dt adds to the mass that resists. See [`Friction::step`] for the
/// form in which v is computed.
///
/// [`Friction::step`]: crate::friction::Friction::step
#[inline(always)] // into both loops of the testbed: a sixth of their instructions
pub fn substep(parameters: &Parameters, state: &State, forces: &Forces, dt: f64) -> Substep {
    let Parameters { M, friction, wall } = *parameters;
    let State { q, dq, s } = *state;

    let dq_0 = dq.value();
    let m = M + dt * friction.b;
    let i = dt * (forces.tau_a + forces.tau_h + forces.tau_d - friction.b * dq_0);
    let pen = q.minus(wall.q); // of the mass, before the motion; negative: a gap
    let s_free = wall.relaxed(s, dt);
    let beyond = pen - s_free; // of the relaxed surface

    let (mut dq_end, mut j_f) = friction.step(dq, m, i, dt);
    let mut j_e = 0.0;
    if beyond + dt * dq_end.value() > 0.0 {
        let kappa = wall.impedance(dt);
        (dq_end, j_f) = friction.step(dq, m + kappa * dt, i - kappa * (beyond + dt * dq_0), dt);
        j_e = (kappa * (beyond + dt * dq_end.value())).max(0.0); // positive in exact numbers
    }

    let v = dq_end.value();
    let delta_v = v - dq_0;
    let delta_q = dt * v;
    let q_end = q.plus(delta_q);
    // In contact the penetration of the mass, else the relaxed surface: the larger of the two, in exact numbers.
    let s_end = q_end.minus(wall.q).max(s_free);
    let delta_s = s_end - s;
    Substep {
        state: State {
            q: q_end,
            dq: dq_end,
            s: s_end,
        },
        tau_f: 0.0 - j_f / dt - friction.b * v, // 0 − x, as −0 would show at rest
        tau_e: 0.0 - j_e / dt,
        flow: Flow {
            work_tau_a: forces.tau_a * delta_q,
            work_tau_h: forces.tau_h * delta_q,
            work_tau_d: forces.tau_d * delta_q,
            loss_coulomb: j_f * v,
            loss_viscous: friction.b * v * delta_q,
            loss_wall: wall.c * delta_s * (delta_s / dt),
            loss_impact: j_e * ((s - pen) / dt),
            loss_step: 0.5 * M * delta_v * delta_v + wall.energy(delta_s),
        },
    }
}
