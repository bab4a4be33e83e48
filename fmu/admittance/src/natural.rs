//! Natural admittance control: a velocity loop around the response of a desired model that has the robot's own mass.
//!
//! After Newman (1992) and Dohring and Newman (2003). What a robot should not change is its inertia: a desired mass below
//! the real one costs passivity at the hand. So the desired model is the robot without its friction, with a virtual
//! damper that acts on the *robot*, and a velocity loop removes what makes the robot differ from it:
//!
//! ```text
//! f_v = −D_n dq                                   the virtual damper's force on the robot
//! M dv_d = f_h + f_v                              desired model
//! tau = f_v + K((v_d − dq) + K_P ∫(v_d − dq))     the damper itself, and the velocity loop G(s) = K + K K_P/s
//! ```
//!
//! With viscous friction b, M s dq = f_h + tau − b dq and the port's impedance is
//!
//! ```text
//! f_h/dq = M s + D_n + b M s/(M s + G(s))
//! ```
//!
//! The robot's own mass and the damper D_n remain; of the friction only b M s/(M s + G) does. Its real part is
//! negative at low frequencies, b M ω²(M ω² − K K_P)/((K K_P − M ω²)² + K² ω²), never below −b/(r + 2√r) with
//! r = K/(M K_P): see [`least_damping`], the tuning rule for a passive port (f_h ; dq).
//!
//! Sampled (T; dq the backward difference; e = q_d − q; the model by the midpoint rule, the coupling as in
//! [`midpoint`](crate::midpoint)):
//!
//! ```text
//! v_m = v_d + T(f_h − D_n dq)/(2 M),   v_d⁺ = 2 v_m − v_d,   q_d⁺ = q_d + T v_m
//! y   = (v_m − dq) + K_P(e + T(v_m − dq)/2)
//! tau = sat(K y − D_n dq, f_max)
//! ```
//!
//! No force of an environment that the sensor does not see reaches the model. At a wall dq = 0, not even the damper acts,
//! and q_d runs away as ½ f_h t²/M: it sticks, longer than `standard`.

use crate::comparator::{ComparatorTick, Desired};
use crate::midpoint::Sample;
use crate::parameters::check;
use crate::real::{self, sat};
use crate::{Gains, ParameterError, Real, Settings};
use fmu_declaration::range::POSITIVE;

/// The controller between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Natural {
    model: Desired,
    M: Real,
}

impl Natural {
    /// Out of the loop. `M` (kg) is the robot's mass, which takes the place of `gains.M_n`; of the settings only T and
    /// dq_cutoff matter.
    ///
    /// # Errors
    /// The first parameter out of its range; `M` goes by the name `comparator.M`.
    pub fn new(settings: Settings, gains: Gains, M: Real) -> Result<Self, ParameterError> {
        let model = Desired::new(settings, &gains)?;
        check(None, &[("comparator.M", M, POSITIVE)])?;
        Ok(Self { model, M })
    }

    /// Other gains from the next tick on.
    ///
    /// # Errors
    /// The first one out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: Gains) -> Result<(), ParameterError> {
        self.model.tune(&gains)
    }

    /// One tick at position `q` (m) with the human's force `f_h` (N); the first one engages with q_d = q, v_d = 0.
    pub fn step(&mut self, q: Real, f_h: Real) -> ComparatorTick {
        let (q_d, sample) = self.model.sense(q, f_h);
        let Gains { D_n, K, f_max, .. } = self.model.rule.gains;
        let Sample { v_n: v_d, dq, .. } = sample;

        let f_v = -D_n * dq;
        // Not Rule::driven, which rounds otherwise: nothing on the left damps, so that T is not divided by and taken back.
        let v_m = v_d + self.model.settings.T * (f_h + f_v) / (2.0 * self.M);
        let f_demand = f_v + K * self.model.rule.coupling(&sample, v_m);

        self.model.advance(q_d, &sample, v_m);
        ComparatorTick::of(q_d, &sample, sat(f_demand, f_max), f_demand)
    }

    /// One tick out of the loop at position `q` (m): no force; the next [`step`](Self::step) engages anew.
    pub fn rest(&mut self, q: Real) -> ComparatorTick {
        self.model.rest();
        ComparatorTick::at_rest(q)
    }
}

/// Least virtual damping D_n (N·s/m) with which the continuous port (f_h ; dq) is passive, for a robot of mass `M` (kg)
/// with viscous friction `b` (N·s/m) under the velocity loop of gains `K` (N·s/m) and `K_P` (1/s):
///
/// D_n ≥ b/(r + 2√r),  r = K/(M K_P)
///
/// From Re f_h/dq ≥ 0 at every ω: with x = K K_P − M ω² and the least D_n = g b, the quadratic
/// (1 + g)x² − (K K_P + g K²/M)x + g K³K_P/M ≥ 0 for all x needs (1 + g r)² ≤ 4 g(1 + g)r, that is g ≥ 1/(r + 2√r).
pub fn least_damping(M: Real, K: Real, K_P: Real, b: Real) -> Real {
    let r = K / (M * K_P);
    b / (r + 2.0 * real::sqrt(r))
}
