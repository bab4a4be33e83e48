//! The position-servo form: the nominal trajectory as the command of a drive that closes the PI loop itself.
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
//! slips as in the torque form, and at the limit |tau_m| ≥ f_max the reset applies (docs/specification.md section 1,
//! step 3): v_n⁺ = v_b if v_b² ≤ v_n⁺², v_b = (y − K_P e)/(1 + K_P T/2) + dq.
//!
//! **Energy.** H as in [`storage`](crate::storage), ΔG = ΔH + tau_m Δq − (K/alpha) f_h v_m T, known at t_{k+1}. The drive's torque varies
//! within the sample, so tau_m Δq is its work up to K a² T³/12 at an acceleration a; the true work is the smaller one.
//! The torque is the drive's, so the law cannot withhold it: the tank is observed, not enforced.

use crate::midpoint::{self, Rule, Sample, slower};
use crate::motion::Sampling;
use crate::real::{self, floored};
use crate::{Gains, Motion, ParameterError, Real, Settings};

/// The law in servo form between two ticks, one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Servo {
    settings: Settings,
    sampling: Sampling,
    rule: Rule,
    q_n: Option<Real>,
    v_n: Real,
    motion: Motion,
    energy: Energy,
}

/// Energy as of the last tick, J; all 0 for alpha = 0, where it is not defined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy {
    /// Stored.
    pub H: Real,
    /// Created so far; negative: dissipated.
    pub G: Real,
    /// E_0 less what was created, refilled up to E_0.
    pub tank: Real,
    q: Option<Real>,
    supplied: Real,
}

/// What happened at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoTick {
    /// Position command of the drive, m: the nominal's in the middle of the sample that begins.
    pub q_d: Real,
    /// Velocity command of the drive, m/s.
    pub dq_d: Real,
    /// Nominal position, after the slip, m.
    pub q_n: Real,
    /// Nominal velocity, m/s.
    pub dq_n: Real,
    /// q_n − q after the slip, m.
    pub e_nr: Real,
    /// The robot's velocity, backward difference, m/s.
    pub dq: Real,
    /// Whether the drive's torque reached f_max in the sample that ended.
    pub saturated: bool,
}

impl Servo {
    /// Out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law without a servo form.
    pub fn new(settings: Settings, gains: Gains) -> Result<Self, ParameterError> {
        settings.check()?;
        gains.check(None)?;
        if !settings.law.row().servo {
            return Err(ParameterError::NoServoForm(settings.law));
        }
        let mut servo = Self {
            settings,
            sampling: Sampling::new(&settings),
            rule: Rule::new(&settings, &gains),
            q_n: None,
            v_n: 0.0,
            motion: Motion::default(),
            energy: Energy::default(),
        };
        servo.energy.tank = if servo.is_energy_defined() {
            settings.E_0
        } else {
            0.0
        };
        Ok(servo)
    }

    /// Another nominal mass and damping, at once; a heavier mass is slowed so that K M_n v_n² does not rise. The other gains
    /// are the drive's as well, which this law cannot change.
    ///
    /// # Errors
    /// A gain out of its range, or a gain of the drive other than it was; all gains stay as they were.
    pub fn tune(&mut self, gains: Gains) -> Result<(), ParameterError> {
        gains.check(None)?;
        let now = self.rule.gains;
        for (name, value, fixed) in [
            ("K", gains.K, now.K),
            ("K_P", gains.K_P, now.K_P),
            ("f_max", gains.f_max, now.f_max),
        ] {
            if value != fixed {
                let expected = "the value at the start, in servo form the drive has it too";
                return Err(ParameterError::of(name, None, value, expected));
            }
        }
        self.v_n *= real::sqrt(real::min(now.M_n / gains.M_n, 1.0));
        self.rule = Rule::new(&self.settings, &gains);
        Ok(())
    }

    /// One tick at position `q` (m), human force `f_h` (N) and `tau_m` (N), the mean of the drive's torque over the sample
    /// that ended; the first tick engages with q_n = q, v_n = 0 and its nominal does not feel `tau_m`.
    pub fn step(&mut self, q: Real, f_h: Real, tau_m: Real) -> ServoTick {
        let Self { settings, rule, .. } = *self;
        let T = settings.T;
        let dq = self.motion.dq(q, 1.0, &self.sampling);
        self.motion = Motion::at(q, dq);
        let e = self.q_n.map_or(0.0, |q_n| rule.spring.slipped(q_n - q));
        let (q_n, v_n) = (q + e, self.v_n);
        self.settle(q, e, tau_m);

        let tau_m = if self.q_n.is_some() { tau_m } else { 0.0 };
        let sample = Sample {
            e,
            v_n,
            dq,
            f_h,
            damping: 0.0,
        };
        let y = tau_m / rule.gains.K;
        let v_m = rule.driven(&sample, y);
        let saturated = real::abs(tau_m) >= rule.gains.f_max;
        let mut v_next = midpoint::end(&sample, v_m);
        if saturated && settings.law.row().slips() {
            v_next = slower(v_next, rule.at_the_bound(&sample, y));
        }
        self.v_n = floored(v_next);
        self.q_n = Some(q_n + T * v_m);
        self.energy.supplied = rule.supplied(&sample, v_m);
        ServoTick {
            q_d: q_n + T * v_m / 2.0,
            dq_d: v_m,
            q_n,
            dq_n: v_n,
            e_nr: e,
            dq,
            saturated,
        }
    }

    /// One tick out of the loop at position `q` (m), with `tau_m` (N) as in [`step`](Self::step): the drive is told to
    /// stand still there, and what it does meanwhile is booked. The stored energy is given up; the next step engages anew.
    pub fn rest(&mut self, q: Real, tau_m: Real) -> ServoTick {
        (self.q_n, self.v_n, self.motion) = (None, 0.0, Motion::default());
        self.settle(q, 0.0, tau_m);
        self.energy.supplied = 0.0;
        ServoTick {
            q_d: q,
            dq_d: 0.0,
            q_n: q,
            dq_n: 0.0,
            e_nr: 0.0,
            dq: 0.0,
            saturated: false,
        }
    }

    /// Energy stored and created, as of the last tick.
    pub fn energy(&self) -> &Energy {
        &self.energy
    }

    /// Settles the sample that ends now with the extension `e` (m) and the torque `tau_m` (N) that acted in it.
    fn settle(&mut self, q: Real, e: Real, tau_m: Real) {
        if !self.is_energy_defined() {
            return;
        }
        let E_0 = self.settings.E_0;
        let H = self.rule.stored(e, self.v_n);
        let last = self.energy;
        let delta_q = last.q.map_or(0.0, |last| q - last);
        let created = H - last.H + tau_m * delta_q - last.supplied;
        self.energy = Energy {
            H,
            G: last.G + created,
            tank: real::min(last.tank - created, E_0),
            q: Some(q),
            ..last
        };
    }

    /// alpha = 0 has no port (f_h ; K v_n/alpha), hence no storage.
    fn is_energy_defined(&self) -> bool {
        self.settings.alpha > 0.0
    }
}
