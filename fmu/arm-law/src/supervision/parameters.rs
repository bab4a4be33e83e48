//! Times and thresholds.

use admittance::parameters::{NOT_NEGATIVE, POSITIVE, check};
use admittance::{ParameterError, Real};

/// What can be set. Times are rounded to whole ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// For how long sensors and heartbeat must have been good before the controller is ready, s.
    pub init_time: Real,
    /// Duration over which the authority rises from 0 to 1, s; one tick at least.
    pub engage_time: Real,
    /// Duration over which it falls to 0, s; one tick at least.
    pub soft_stop_time: Real,
    /// Time within which the heartbeat must change, s; 0 = it is not watched.
    pub heartbeat_timeout: Real,
    /// Magnitude of f_h below which the hand is at rest, N; 0 = the controller never holds by itself.
    pub hold_enter: Real,
    /// Magnitude of f_h above which it no longer is, N, ≥ `hold_enter`.
    pub hold_leave: Real,
    /// For how long f_h must have been below `hold_enter`, s.
    pub hold_time: Real,
    /// Duration over which a moving nominal is brought to rest, s; one tick at least.
    pub hold_brake: Real,
    /// For how long limits may act before they are reported, s; 0 = they are not.
    pub saturation_time: Real,
}

impl Default for Parameters {
    /// Half a second to engage and to stop, a heartbeat of 10 Hz or more, no hold but by request.
    fn default() -> Self {
        Self {
            init_time: 0.1,
            engage_time: 0.5,
            soft_stop_time: 0.5,
            heartbeat_timeout: 0.1,
            hold_enter: 0.0,
            hold_leave: 0.0,
            hold_time: 0.5,
            hold_brake: 0.05,
            saturation_time: 0.0,
        }
    }
}

impl Parameters {
    /// Whether a supervisor can be built with them.
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        check(
            None,
            &[
                ("init_time", self.init_time, NOT_NEGATIVE),
                ("engage_time", self.engage_time, NOT_NEGATIVE),
                ("soft_stop_time", self.soft_stop_time, NOT_NEGATIVE),
                ("heartbeat_timeout", self.heartbeat_timeout, NOT_NEGATIVE),
                ("hold_enter", self.hold_enter, NOT_NEGATIVE),
                ("hold_leave", self.hold_leave, NOT_NEGATIVE),
                ("hold_time", self.hold_time, NOT_NEGATIVE),
                ("hold_brake", self.hold_brake, NOT_NEGATIVE),
                ("saturation_time", self.saturation_time, NOT_NEGATIVE),
            ],
        )?;
        if self.hold_leave < self.hold_enter {
            return Err(ParameterError::OutOfRange {
                name: "hold_leave",
                axis: None,
                value: self.hold_leave,
                expected: "a value not less than hold_enter",
            });
        }
        Ok(())
    }
}

/// Durations in ticks: what the supervisor counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Durations {
    /// Of the checks before it is ready.
    pub init: u32,
    /// Of the rise of the authority, ≥ 1.
    pub engage: u32,
    /// Of its fall, ≥ 1.
    pub soft_stop: u32,
    /// Within which the heartbeat must change; 0 = not watched.
    pub heartbeat: u32,
    /// Of a small force before it counts as a hand at rest.
    pub hold: u32,
    /// Of the nominal's braking, ≥ 1.
    pub brake: u32,
    /// Of saturation before it is reported; 0 = never.
    pub saturation: u32,
}

impl Durations {
    /// Those of `parameters` at a sample period of `T` (s).
    ///
    /// # Errors
    /// The first parameter out of its range.
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub fn new(parameters: &Parameters, T: Real) -> Result<Self, ParameterError> {
        check(None, &[("T", T, POSITIVE)])?;
        parameters.check()?;
        // A cast saturates; a time that is not 0 lasts one tick at least.
        let ticks = |time: Real| match (time / T + 0.5) as u32 {
            0 if time > 0.0 => 1,
            ticks => ticks,
        };
        Ok(Self {
            init: ticks(parameters.init_time),
            engage: ticks(parameters.engage_time).max(1),
            soft_stop: ticks(parameters.soft_stop_time).max(1),
            heartbeat: ticks(parameters.heartbeat_timeout),
            hold: ticks(parameters.hold_time),
            brake: ticks(parameters.hold_brake).max(1),
            saturation: ticks(parameters.saturation_time),
        })
    }
}
