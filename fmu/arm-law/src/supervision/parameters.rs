//! Times and thresholds.

use admittance::parameters::{check, in_range};
use admittance::{ParameterError, Real};
use fmu_declaration::check::Expected;
use fmu_declaration::range::POSITIVE;
use fmu_declaration::{Rows, Start};

/// What can be set. Times are rounded to whole ticks. The start values: half a second to engage and to stop, a heartbeat of
/// 10 Hz or more, no hold but by request.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Parameters {
    /// For how long sensors and heartbeat must have been good before the controller is ready.
    #[parameter(108, unit = SECOND, range = NOT_NEGATIVE, start = 0.1)]
    pub init_time: Real,
    /// Time in which the authority rises from 0 to 1; one tick at least.
    #[parameter(109, unit = SECOND, range = NOT_NEGATIVE, start = 0.5)]
    pub engage_time: Real,
    /// Time in which the authority falls to 0 in a soft stop; one tick at least.
    #[parameter(110, unit = SECOND, range = NOT_NEGATIVE, start = 0.5)]
    pub soft_stop_time: Real,
    /// Time within which heartbeat must change; 0 = it is not watched.
    #[parameter(111, unit = SECOND, range = NOT_NEGATIVE, start = 0.1)]
    pub heartbeat_timeout: Real,
    /// Magnitude of f_h below which the hand is at rest and the controller holds by itself; 0 = it never does.
    #[parameter(112, unit = NEWTON, range = NOT_NEGATIVE)]
    pub hold_enter: Real,
    /// Magnitude of f_h above which the hand is no longer at rest; not below hold_enter.
    #[parameter(113, unit = NEWTON, range = NOT_NEGATIVE)]
    pub hold_leave: Real,
    /// For how long f_h must have been below hold_enter before the hand is at rest.
    #[parameter(114, unit = SECOND, range = NOT_NEGATIVE, start = 0.5)]
    pub hold_time: Real,
    /// Time in which supervision brings a moving nominal to rest; one tick at least.
    #[parameter(115, unit = SECOND, range = NOT_NEGATIVE, start = 0.05)]
    pub hold_brake: Real,
    /// For how long limits may act before diagnostic reports it; 0 = it does not.
    #[parameter(116, unit = SECOND, range = NOT_NEGATIVE)]
    pub saturation_time: Real,
    /// Farthest that the nominal's handle moves while nobody varies the force of the hand; then it holds. 0 = any distance.
    #[parameter(190, unit = METRE, range = NOT_NEGATIVE)]
    pub drift_distance: Real,
    /// Change of the hand's force that shows a hand, if it comes within drift_time.
    #[parameter(191, unit = NEWTON, range = POSITIVE, start = 0.3)]
    pub drift_band: Real,
    /// Time within which a hand varies its force by drift_band; what takes longer is a drift.
    #[parameter(192, unit = SECOND, range = POSITIVE, start = 1.0)]
    pub drift_time: Real,
    /// For how long a force that nobody varies may press on a nominal that is held for it, before a soft stop; 0 = for ever.
    #[parameter(193, unit = SECOND, range = NOT_NEGATIVE)]
    pub drift_stop_time: Real,
    /// Largest error of ft.mass that is reckoned with: a change of force that it explains, as the tool turns, shows no hand.
    #[parameter(194, unit = KILOGRAM, range = NOT_NEGATIVE)]
    pub drift_mass: Real,
}

impl Parameters {
    /// Whether a supervisor can be built with them.
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        in_range(self)?;
        if self.hold_leave < self.hold_enter {
            return Err(ParameterError::OutOfRange {
                name: "hold_leave",
                axis: None,
                value: self.hold_leave,
                expected: Expected::Text("a value not less than hold_enter"),
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
    /// Within which a hand varies its force, ≥ 1.
    pub drift: u32,
    /// Of a steady force before it stops; 0 = never.
    pub drift_stop: u32,
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
            drift: ticks(parameters.drift_time),
            drift_stop: ticks(parameters.drift_stop_time),
        })
    }
}
