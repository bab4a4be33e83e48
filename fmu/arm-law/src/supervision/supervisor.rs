//! One tick of supervision.

use super::condition::{Condition, Conditions};
use super::diagnostic::Diagnostic;
use super::drift::{Cause, DriftWatch, Felt, Seen};
use super::parameters::{Durations, Parameters};
use super::ramp::Ramp;
use super::state::State;
use super::table::{FAULTS, next};
use super::watch::{Edge, Hand, Heartbeat, Lasting};
use admittance::{ParameterError, Real};

/// What supervision sees at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Whether the controller may run at all.
    pub enable: bool,
    /// Whether it is to be in the loop; a rising edge in `ready` engages, false stops softly.
    pub engage: bool,
    /// Its rising edge acknowledges a fault.
    pub acknowledge: bool,
    /// Whether the emergency stop is pressed.
    pub emergency_stop: bool,
    /// Whether the nominal is to stand still.
    pub hold: bool,
    /// A counter that changes as long as its sender lives.
    pub heartbeat: i32,
    /// Whether the human's force can be trusted: what conditions it has found no fault, and it is finite.
    pub ft_valid: bool,
    /// Whether the joint angles can be trusted: what checks them has found no fault.
    pub encoder_valid: bool,
    /// |f_h|, N: whether the hand is at rest.
    pub force: Real,
    /// The same as a vector in the sensor's frame, with what a drift of the sensor is told from; only for a watch on drift.
    pub felt: Felt,
}

impl Default for Inputs {
    /// Off, with good sensors.
    fn default() -> Self {
        Self {
            enable: false,
            engage: false,
            acknowledge: false,
            emergency_stop: false,
            hold: false,
            heartbeat: 0,
            ft_valid: true,
            encoder_valid: true,
            force: 0.0,
            felt: Felt::default(),
        }
    }
}

/// What the law must do at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// Stay out of the loop: no torque, q_n = q, v_n = 0.
    Rest,
    /// Run.
    Run {
        /// Share of its force that reaches the robot and, where the law says so, the nominal; in [0, 1].
        authority: Real,
        /// 1: the nominal is free. Below: its speed along an axis stays within this share of the one that it had at the last
        /// tick at which it was free; 0: it stands still.
        freedom: Real,
    },
}

/// What came of the law's tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Whether all its results are finite.
    pub finite: bool,
    /// Whether it owes energy and gives no torque until that is repaid.
    pub debt: bool,
    /// Whether the motion exceeded the bounds of the passivity argument.
    pub outside_bounds: bool,
    /// Whether the robot got less than the law asked for.
    pub saturated: bool,
    /// Speed of the nominal's handle, m/s.
    pub speed: Real,
}

impl Default for Report {
    /// Nothing to report.
    fn default() -> Self {
        Self {
            finite: true,
            debt: false,
            outside_bounds: false,
            saturated: false,
            speed: 0.0,
        }
    }
}

impl Report {
    /// There is no result.
    pub const NOT_FINITE: Self = Self {
        finite: false,
        debt: false,
        outside_bounds: false,
        saturated: false,
        speed: 0.0,
    };
}

/// What supervision shows after a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// The state.
    pub state: State,
    /// Why the law does not simply run, as of this tick.
    pub diagnostic: Diagnostic,
    /// The first fault since the last acknowledgement; `None` if there was none.
    pub first_fault: Diagnostic,
    /// Share of its force that the law exerts.
    pub authority: Real,
}

impl Status {
    /// Without supervision: the law does what it must do, and there is nothing to say.
    pub const fn of(demand: Demand) -> Self {
        let (state, authority) = match demand {
            Demand::Rest => (State::Off, 0.0),
            Demand::Run { authority, freedom } if freedom < 1.0 => (State::Hold, authority),
            Demand::Run { authority, .. } => (State::Engaged, authority),
        };
        Self {
            state,
            diagnostic: Diagnostic::None,
            first_fault: Diagnostic::None,
            authority,
        }
    }
}

/// The state machine with its memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Supervisor {
    durations: Durations,
    hold_enter: Real,
    hold_leave: Real,
    state: State,
    first_fault: Diagnostic,
    conditions: Conditions,
    ramp: Ramp,
    engage: Edge,
    acknowledge: Edge,
    heartbeat: Heartbeat,
    hand: Hand,
    drift: Option<DriftWatch>,
    /// the warning of the watch on drift, as of this tick
    warning: Diagnostic,
    good: Lasting,
    saturated: Lasting,
}

impl Supervisor {
    /// Off, with a sample period of `T` (s).
    ///
    /// # Errors
    /// The first parameter out of its range.
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub fn new(parameters: &Parameters, T: Real) -> Result<Self, ParameterError> {
        let durations = Durations::new(parameters, T)?;
        Ok(Self {
            drift: DriftWatch::new(parameters, &durations, T),
            warning: Diagnostic::None,
            durations,
            hold_enter: parameters.hold_enter,
            hold_leave: parameters.hold_leave,
            state: State::Off,
            first_fault: Diagnostic::None,
            conditions: Conditions::default(),
            ramp: Ramp::default(),
            engage: Edge::new(),
            acknowledge: Edge::new(),
            heartbeat: Heartbeat::new(),
            hand: Hand::default(),
            good: Lasting::default(),
            saturated: Lasting::default(),
        })
    }

    /// A tick begins: what the law must do. [`judge`](Self::judge) ends it.
    pub fn step(&mut self, inputs: &Inputs) -> Demand {
        let before = self.state;
        let seen = self.see(inputs);
        if before.acts() {
            self.latch(seen);
        }
        self.conditions = seen
            .with(
                Condition::Stopped,
                before == State::SoftStop && self.stopped(),
            )
            .with(Condition::Latched, self.first_fault != Diagnostic::None);
        self.state = next(before, self.conditions);
        self.entered();
        self.ramp.advance(before, self.state, &self.durations);
        if self.state.acts() {
            Demand::Run {
                authority: self.ramp.authority(),
                freedom: self.ramp.freedom(),
            }
        } else {
            Demand::Rest
        }
    }

    /// The tick ends: what came of it. If the law's result was not finite the state is now `fault`: the caller drops that
    /// result, lets the law rest and gives no torque.
    pub fn judge(&mut self, report: &Report) -> Status {
        if !report.finite {
            let before = self.state;
            self.conditions = self.conditions.with(Condition::NotFinite, true);
            self.state = next(before, self.conditions);
            self.entered();
            self.ramp.advance(before, self.state, &self.durations);
        }
        if let Some(drift) = &mut self.drift {
            drift.moves(report.speed);
        }
        // While it fades in or out the law gets less than it asks for without any limit.
        let limited = self.ramp.authority() >= 1.0 && report.saturated;
        let long = self.saturated.count(limited) >= self.durations.saturation.max(1);
        Status {
            state: self.state,
            diagnostic: self.diagnostic(report, limited && long && self.durations.saturation > 0),
            first_fault: self.first_fault,
            authority: self.ramp.authority(),
        }
    }

    /// The watch on a drift of the force sensor, if there is one.
    pub const fn drift(&self) -> Option<&DriftWatch> {
        self.drift.as_ref()
    }

    /// What the watch on drift says to the inputs, with a hand that `rests` or not.
    fn watched(&mut self, inputs: &Inputs, rests: bool) -> Seen {
        let acts = self.state.acts();
        let drift = self.drift.as_mut();
        let seen = drift.map_or_else(Seen::default, |drift| {
            drift.step(&inputs.felt, inputs.force, acts, rests)
        });
        self.warning = match seen.warning {
            None => Diagnostic::None,
            Some(Cause::Steady) => Diagnostic::ForceSteady,
            Some(Cause::Tool) => Diagnostic::ToolWeight,
        };
        seen
    }

    /// The conditions that follow from the inputs and the memory of them.
    fn see(&mut self, inputs: &Inputs) -> Conditions {
        self.heartbeat.hear(inputs.heartbeat);
        let rests = self.hand.rests(
            inputs.force,
            self.hold_enter,
            self.hold_leave,
            self.durations.hold,
        );
        let watched = self.watched(inputs, rests);
        let lasts = |cause| watched.lasting && watched.warning == Some(cause);
        let seen = Conditions::default()
            .with(Condition::EmergencyStop, inputs.emergency_stop)
            .with(Condition::EncoderInvalid, !inputs.encoder_valid)
            .with(
                Condition::HeartbeatLost,
                self.heartbeat.lost(self.durations.heartbeat),
            )
            .with(Condition::FtInvalid, !inputs.ft_valid)
            .with(Condition::ForceSteady, lasts(Cause::Steady))
            .with(Condition::ToolWeight, lasts(Cause::Tool))
            .with(Condition::Enabled, inputs.enable)
            .with(Condition::EngageOn, inputs.engage)
            .with(Condition::EngageRises, self.engage.rises(inputs.engage))
            .with(
                Condition::AcknowledgeRises,
                self.acknowledge.rises(inputs.acknowledge),
            )
            .with(Condition::Quiet, inputs.hold || rests || watched.unattended);
        let good = self.state == State::Init && !seen.contain_any(FAULTS);
        seen.with(
            Condition::Prepared,
            self.good.count(good) > self.durations.init,
        )
    }

    fn stopped(&self) -> bool {
        self.ramp.stopped(&self.durations)
    }

    /// What follows from the state that was just decided on.
    fn entered(&mut self) {
        match self.state {
            State::Fault => self.latch(self.conditions),
            State::Off => self.first_fault = Diagnostic::None,
            _ => {}
        }
    }

    /// Keeps the first fault.
    fn latch(&mut self, conditions: Conditions) {
        if self.first_fault == Diagnostic::None {
            self.first_fault = fault(conditions);
        }
    }

    /// The fault, or else the reason with the smallest number.
    fn diagnostic(&self, report: &Report, long_saturated: bool) -> Diagnostic {
        let running = matches!(self.state, State::Engaged | State::Hold);
        let has = |condition| self.conditions.contain(condition);
        let preparing = matches!(self.state, State::Off | State::Init);
        match fault(self.conditions) {
            Diagnostic::None => {}
            fault => return fault,
        }
        [
            (report.debt, Diagnostic::EnergyDebt),
            (report.outside_bounds, Diagnostic::OutsideBounds),
            (long_saturated, Diagnostic::Saturated),
            (self.state == State::Fault, Diagnostic::NotAcknowledged),
            (!has(Condition::Enabled), Diagnostic::NotEnabled),
            (preparing, Diagnostic::Preparing),
            (!has(Condition::EngageOn), Diagnostic::NotEngaged),
            (!running, Diagnostic::EngageStuck),
            (self.warning != Diagnostic::None, self.warning),
        ]
        .into_iter()
        .find_map(|(holds, diagnostic)| holds.then_some(diagnostic))
        .unwrap_or(Diagnostic::None)
    }
}

/// The first of the faults among `conditions`.
fn fault(conditions: Conditions) -> Diagnostic {
    FAULTS
        .iter()
        .find(|condition| conditions.contain(**condition))
        .map_or(Diagnostic::None, |condition| Diagnostic::of(*condition))
}
