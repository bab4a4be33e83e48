//! The position-servo form: the nominal trajectory as the command of drives that close the PI loop themselves.
//!
//! Footnote of sec:standard_adm: a robot that is not torque controlled gets q_n and dq_n, and its *measured* torque takes
//! the place of tau_a in the reaction (eq:obs_dyn). The drive's loop must be the law's,
//!
//! ```text
//! tau(t) = sat(K((dq_d − dq) + K_P (q_d − q)), f_max)        eq:dob_input, in the drive
//! ```
//!
//! with the same K, K_P and f_max. Sampled, at t_k, with tau_m the mean of the drive's torque over the sample that ended:
//!
//! ```text
//! e   = q_n − q                           under passive_bounded within ±f_max/(K K_P), q_n = q + e
//! y   = tau_m/K                           0 under standard
//! v_m = (2 M_n v_n/T + f_h − alpha y)/(2 M_n/T + D_n),   v_n⁺ = 2 v_m − v_n,   q_n⁺ = q_n + T v_m
//! q_d = q_n + T v_m/2,   dq_d = v_m       the command for the sample that begins
//! ```
//!
//! It is written for any [`Coordinates`] whose couplings are each a drive's own, with constant gains: the
//! axes, and the arm's joints. Forces at an arm's handle are no drive's.
//!
//! **Which instant.** The drive holds the command for one period. The held values with which its mean torque is that of a
//! drive that follows q_n(t) = q_n + v_m(t − t_k) are the trajectory's means: its middle, not its start (a lag of T/2,
//! which K_P turns into a force K K_P T v/2) and not its end.
//!
//! **What changes against the torque form.** With Δq what the robot really moves and w = v_m − Δq/T, the drive's mean
//! torque is K(w + K_P(e + T w/2)) as long as it does not saturate and the robot's path is straight within the sample. The
//! torque form has to guess Δq = T dq; here nothing is guessed. In exchange the reaction is one sample late:
//!
//! ```text
//! ΔG = −(K/alpha) D_n v_m² T − K w² T + T v_m (tau_k − tau_{k−1})
//! ```
//!
//! The torque form's K w δ and K δ² (the motion that the last difference did not foretell) are gone, and with them the
//! limit K T/M < 1.9: the fast loop is the drive's. In their place stands T v_m Δtau: the nominal feels tau late by T. With
//! a soft drive tau_m is K times the last sample's v_m, and v_m,k+1 = (1 − a/2) v_m,k − (a/2) v_m,k−1, a = alpha T/M_n: the
//! late reaction needs M_n > alpha T/2, 1 g at 500 Hz. A tight drive gives back tau = M dv, that is (alpha M/(K M_n)) dv_n,
//! late: that needs M_n > alpha M/K, which is less than alpha T as soon as K T/M > 1.
//!
//! **Saturation.** What is measured is what was delivered. So `passive`, whose nominal feels what was *not* delivered,
//! has no servo form and is refused; below the limit `passive_applied` is the same law. Under `passive_bounded` the spring
//! slips as in the torque form, and at the limit the reset applies (docs/specification.md section 1, passive_bounded): v_n⁺ = v_b if
//! v_b² ≤ v_n⁺², v_b = (y − K_P e)/(1 + K_P T/2) + dq. Three things differ, since a drive is never the law to the last digit:
//!
//! * A coupling is at its limit where |tau_m| ≥ f_max, and also where the spring is at the bound at which it slips: a drive
//!   that gives up 1 % earlier is at its limit too.
//! * Only a nominal that runs ahead is set back: sgn(tau_m)(v_n⁺ − v_b) > 0. At a wall v_b is about 0. Without the
//!   direction, a nominal that the human pulls off the wall would be stopped at every tick.
//! * In v_b, y is within ±f_max/K and y − K_P e is 0 where it would point back: a drive with a larger limit does not let the
//!   nominal run ahead of the robot, and one with smaller gains does not throw it back. An exact drive has neither.
//!
//! **Energy.** H as in [`storage`](crate::storage), ΔG = ΔH + tau_m Δq − (K/alpha) f_h v_m T, known at t_{k+1}. The drive's torque varies
//! within the sample, so tau_m Δq is its work up to K a² T³/12 at an acceleration a; the true work is the smaller one.
//! The torque is the drive's: the law cannot share it out beforehand. Under a law that keeps its tank it does what its
//! command can: it settles as the torque form does, and a tank below zero has the drive stand still at q, where it
//! takes energy only, while the human's work on the nominal repays. So the tank ends a sample no further below zero than that
//! sample carried it: `docs/passivity.md`, the servo form.

mod axes;
mod command;
mod drive;
mod feedback;

pub use command::{Command, Inputs};
pub use drive::Drive;
pub use feedback::{FAULT, Fault, Feedback, message};

use crate::ledger::{Flow, Ledger};
use crate::real::{self, sat};
use crate::settling::Settlement;
use crate::tick::{Coordinates, Refused, Tick};
use crate::{ParameterError, Reach, Real, Settings};
use nalgebra::SVector;

/// Coordinates whose couplings drives can close, each its own.
pub trait Drivable<const N: usize>: Coordinates<N> {
    /// The couplings, as the drives have them.
    fn drive(&self) -> Drive<N>;
    /// The nominals' mean velocities in the sample that begins, m/s.
    fn v_m(&self, driven: &Self::Driven) -> SVector<Real, N>;
    /// The nominals move on. Where `v_b` has a velocity (m/s), and one of no more energy, a nominal is set back to it.
    fn follow(&mut self, proposal: &Self::Proposal, driven: &Self::Driven, v_b: &[Option<Real>; N]);
}

/// The law in servo form between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Servo<L, const N: usize> {
    law: L,
    ledger: Ledger<N>,
    feedback: Feedback<N>,
    /// what the drives measured at the last tick, N
    tau_m: SVector<Real, N>,
    /// whether there was one
    ticked: bool,
}

impl<L: Drivable<N>, const N: usize> Servo<L, N> {
    /// `law`, out of the loop, on a robot with this `reach`.
    ///
    /// # Errors
    /// A law without a servo form, or the first value of the reach out of its range.
    pub fn of(law: L, reach: &Reach<N>) -> Result<Self, ParameterError> {
        reach.check()?;
        let settings = *law.settings();
        if !settings.law.row().servo {
            return Err(ParameterError::NoServoForm(settings.law));
        }
        // What was measured over a sample has worked in it, whatever the wiring delays.
        let measured = Settings {
            delayed: false,
            ..settings
        };
        Ok(Self {
            ledger: Ledger::new(&measured, reach),
            feedback: Feedback::new(settings.T),
            law,
            tau_m: SVector::zeros(),
            ticked: false,
        })
    }

    /// One tick in the loop; the first one engages with q_n = q, v_n = 0, and its nominals do not feel what was measured.
    /// Nothing has happened until `accept` has seen the command and the energy G (J), and says yes.
    ///
    /// # Errors
    /// `accept` says no: the law is as it was.
    pub fn tick(
        &mut self,
        inputs: &Inputs<'_, L, N>,
        accept: impl FnOnce(&Command<N>, Real) -> bool,
    ) -> Result<(), Refused> {
        let Inputs {
            place,
            q,
            f_h,
            tau_m,
            request,
            after,
        } = *inputs;
        let (law, T) = (&self.law, self.law.settings().T);

        // 1. Settle. The sample that ends is known now, and what its force did.
        let ledger = self.measured(tau_m);
        let mut sensed = law.sense(place, after);
        let mut settlement = ledger.settle(law, &mut sensed, q);
        if !law.is_engaged() {
            settlement = settlement.without_motion();
        }
        let owes = ledger.terms.kept && settlement.tank < -settlement.rounding;
        let mut feedback = self.feedback;
        if after == 1.0 {
            let moved = ledger.q.map(|last| q - last);
            feedback.compare(&law.drive(), tau_m, moved.as_ref(), T);
        }

        // 2. Propose. The nominals feel what was measured. In debt they feel nothing, so that the human's work repays.
        let felt = if law.is_engaged() && !owes {
            *tau_m
        } else {
            SVector::zeros()
        };
        let proposal = law.propose(&sensed, f_h, request);
        let driven = law.driven(&proposal, &felt);
        let v_m = law.v_m(&driven);
        let mut command = Command::at_rest(q);
        let tick = &mut command.tick;
        law.show(&proposal, &driven, tick);
        tick.f_demand = SVector::zeros();
        tick.outside_bounds = settlement.is_outside();
        tick.engaged = true;
        let v_b = self.set_back(&felt, &v_m, tick);

        // 3. Command. In debt the drives stand still: there they only take.
        if !owes {
            (command.q_d, command.dq_d) = (command.tick.q_n + v_m * (T / 2.0), v_m);
        }
        if !accept(&command, settlement.G()) {
            return Err(Refused);
        }

        // 4. Commit. The nominals move on, and the sample that begins is booked.
        let flow = Flow {
            supplied: law.supplied(&proposal, &driven),
            exchanged: law.exchanged(&proposal, &driven),
        };
        feedback.command(command.q_d - q - command.dq_d * (T / 2.0), command.dq_d);
        self.law.follow(&proposal, &driven, &v_b);
        self.book(ledger, &settlement, Some(q), tau_m, flow);
        self.feedback = feedback;
        Ok(())
    }

    /// One tick out of the loop at positions `q` (m), with `tau_m` (N) as in [`tick`](Self::tick): the drives are told to stand
    /// still there, and what they do meanwhile is booked. The stored energy is given up; the next tick engages anew. Returns
    /// whether the motion since the last tick exceeded the reach.
    ///
    /// # Errors
    /// `accept` says no to the energy G (J): the law is as it was.
    pub fn rest(
        &mut self,
        q: &SVector<Real, N>,
        tau_m: &SVector<Real, N>,
        accept: impl FnOnce(Real) -> bool,
    ) -> Result<bool, Refused> {
        let ledger = self.measured(tau_m);
        let settlement = ledger.close(0.0, q);
        if !accept(settlement.G()) {
            return Err(Refused);
        }
        Ok(self.leave(ledger, &settlement, Some(q), tau_m))
    }

    /// The same where the positions at this tick are not known, or no numbers: the tank pays for the most that the forces
    /// `tau_m` (N) can have done since the last one.
    pub fn abandon(&mut self, tau_m: &SVector<Real, N>) -> bool {
        let ledger = self.measured(tau_m);
        let settlement = ledger.close_unseen();
        self.leave(ledger, &settlement, None, tau_m)
    }

    fn leave(
        &mut self,
        ledger: Ledger<N>,
        ended: &Settlement<N>,
        q: Option<&SVector<Real, N>>,
        tau_m: &SVector<Real, N>,
    ) -> bool {
        self.law.rest();
        self.feedback.rest();
        self.book(ledger, ended, q, tau_m, Flow::default());
        ended.is_outside()
    }

    /// The ledger, once it is known that the forces `tau_m` (N) acted in the sample that ends.
    fn measured(&self, tau_m: &SVector<Real, N>) -> Ledger<N> {
        let mut ledger = self.ledger;
        if self.ticked {
            ledger.acting = *tau_m;
        }
        ledger
    }

    fn book(
        &mut self,
        mut ledger: Ledger<N>,
        ended: &Settlement<N>,
        q: Option<&SVector<Real, N>>,
        tau_m: &SVector<Real, N>,
        flow: Flow,
    ) {
        ledger.book(ended, q, &SVector::zeros(), flow);
        self.ledger = ledger;
        (self.tau_m, self.ticked) = (*tau_m, true);
    }

    /// The velocities (m/s) to which nominals are set back that move on with `v_m` (m/s) from where the `tick` shows them,
    /// feel `felt` (N), and run ahead of a coupling at its limit. Whether any coupling is at its limit, the tick shows
    /// from then on.
    fn set_back(
        &self,
        felt: &SVector<Real, N>,
        v_m: &SVector<Real, N>,
        tick: &mut Tick<N>,
    ) -> [Option<Real>; N] {
        let slips = self.law.settings().law.row().slips();
        let (drive, T) = (self.law.drive(), self.law.settings().T);
        let mut set_back = [None; N];
        for (i, set_back) in set_back.iter_mut().enumerate() {
            let (K, K_P) = (drive.K[i], drive.K_P[i]);
            let (tau_m, e) = (felt[i], tick.e_nr[i]);
            let spring = K * K_P * real::abs(e);
            let limited = real::abs(tau_m) >= drive.f_max[i]
                || slips && spring >= drive.f_max[i] * (1.0 - ROUNDING);
            tick.saturated |= limited;
            let side = if tau_m < 0.0 { -1.0 } else { 1.0 };
            let y_s = sat(tau_m, drive.f_max[i]) / K;
            let lead = side * (y_s - K_P * e) / (1.0 + K_P * T / 2.0);
            let v_b = tick.dq[i] + side * real::max(lead, 0.0);
            let v_next = 2.0 * v_m[i] - tick.dq_n[i];
            if limited && slips && side * (v_next - v_b) > 0.0 {
                *set_back = Some(v_b);
            }
        }
        set_back
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.law.settings().T
    }

    /// Counts positions from a place that is further on by `by` (m).
    pub fn count_from(&mut self, by: &SVector<Real, N>) {
        self.ledger.count_from(by);
    }

    /// The law in its coordinates.
    pub fn law(&self) -> &L {
        &self.law
    }

    /// The law in its coordinates, to be bounded, or tuned in what is not the drives'.
    pub fn law_mut(&mut self) -> &mut L {
        &mut self.law
    }

    /// What the drives measured at the last tick, N.
    pub fn tau_m(&self) -> &SVector<Real, N> {
        &self.tau_m
    }

    /// What is wrong with what the drives measure.
    pub fn feedback(&self) -> &Feedback<N> {
        &self.feedback
    }

    /// Energy stored and created, as of the last tick.
    pub fn ledger(&self) -> &Ledger<N> {
        &self.ledger
    }
}

/// Of a spring's force at the bound to which it has been cut.
const ROUNDING: Real = 8.0 * Real::EPSILON;
