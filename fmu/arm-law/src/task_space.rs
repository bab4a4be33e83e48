//! One tick: the law at the handle, its torques and its ledger at the joints.
//!
//! The law acts on the handle's position p; tau_a = Jᵀ f_a is held at the joints. Over a sample it does tau_a·Δq of
//! work there, whatever the path; f_a·Δp differs from it by the curvature of p(q), second order in Δq. So the ledger
//! here is kept with tau_a and q, which is exact, also where each joint is clipped by itself.
//!
//! The storage is that of the law without f_max for all laws but `passive_bounded`: ½ K K_P e² for a spring whose force the
//! joints deliver a share of. Under `standard` and `passive_applied` a spring that winds up behind saturated joints then
//! counts as energy created, up to some MJ: it is what these laws would have to be able to give back.

use crate::kinematics::Pose;
use crate::limits::{Limits, TorqueLimiting};
use crate::singularity::Singularity;
use admittance::{Admittance, Gains, Ledger, ParameterError, Real, Settings, Tick};
use nalgebra::Vector3;

/// The law between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TaskSpace {
    admittance: Admittance<3>,
    ledger: Ledger<3>,
    gains: [Gains; 3],
    limits: Limits,
    singularity: Singularity,
}

/// What happened at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// What the law did, in the base frame. Its force is what it asks for within f_max, times the common factor.
    pub law: Tick<3>,
    /// Force at the handle that tau amounts to, base frame, N: J⁻ᵀ tau. Clipped where J cannot be inverted: what was asked
    /// for.
    pub f_a: Vector3<Real>,
    /// Torques on the joints, N·m.
    pub tau: Vector3<Real>,
    /// Jᵀ K y before any limit, N·m.
    pub tau_demand: Vector3<Real>,
    /// Whether a limit leaves less than tau_demand.
    pub saturated: bool,
    /// Whether the nominal is slowed before a singularity.
    pub slowed: bool,
}

impl TaskSpace {
    /// A law out of the loop. The caller has checked `limits` and `singularity`.
    ///
    /// # Errors
    /// The first parameter of the law out of its range, or a law that is not offered.
    pub fn new(
        settings: Settings,
        gains: [Gains; 3],
        limits: Limits,
        singularity: Singularity,
    ) -> Result<Self, ParameterError> {
        Ok(Self {
            admittance: Admittance::new(settings, gains)?,
            ledger: Ledger::new(&settings),
            gains,
            limits,
            singularity,
        })
    }

    /// Other gains from the next tick on, taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first gain out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.admittance.tune(gains)?;
        self.gains = gains;
        Ok(())
    }

    /// One tick at joint angles `q` (rad), where the handle is at `pose`, with the human's force `f_h` (N, base frame).
    ///
    /// # Errors
    /// A damping that is not finite.
    pub fn step(
        &mut self,
        pose: &Pose,
        q: &Vector3<Real>,
        f_h: &Vector3<Real>,
    ) -> Result<Outcome, ParameterError> {
        let damping = self.singularity.damping(pose.sigma_min);
        self.admittance.tune(self.gains.map(|gains| Gains {
            D_n: gains.D_n + damping,
            ..gains
        }))?;

        let proposal = self.admittance.propose(&pose.p, f_h);
        let asked = pose.J.tr_mul(&proposal.f());
        let delivered = self.limits.deliver(&asked);
        let law = self.admittance.commit(proposal, delivered.s);

        let f_a = match self.limits.limiting {
            TorqueLimiting::Clip if delivered.limited => {
                let inverse = pose.J.transpose().try_inverse();
                inverse.map_or(law.f, |inverse| inverse * delivered.tau)
            }
            _ => law.f,
        };
        self.count(q, &delivered.tau, law.supplied);
        Ok(Outcome {
            law,
            f_a,
            tau: delivered.tau,
            tau_demand: pose.J.tr_mul(&law.f_demand),
            saturated: law.saturated || delivered.limited,
            slowed: damping > 0.0,
        })
    }

    /// One tick out of the loop: no torque, the nominal at the handle. The energy that was stored is given up; the next
    /// [`step`](Self::step) engages anew.
    pub fn rest(&mut self, pose: &Pose, q: &Vector3<Real>) -> Outcome {
        let law = self.admittance.rest(&pose.p);
        self.count(q, &Vector3::zeros(), law.supplied);
        Outcome {
            law,
            f_a: Vector3::zeros(),
            tau: Vector3::zeros(),
            tau_demand: Vector3::zeros(),
            saturated: false,
            slowed: false,
        }
    }

    /// ΔG = ΔH + tau·Δq − (K/alpha) f_h v_m T of the sample that ends, and what the one that begins starts with.
    fn count(&mut self, q: &Vector3<Real>, tau: &Vector3<Real>, supplied: Real) {
        let H = self.admittance.ledger().H();
        self.ledger = self.ledger.settled(H, q).opened(tau, supplied);
    }

    /// Energy stored and created, as of the last tick; the work is that at the joints.
    pub fn ledger(&self) -> &Ledger<3> {
        &self.ledger
    }
}
