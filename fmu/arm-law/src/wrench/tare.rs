//! The sensor's bias, found while nobody touches the handle.
//!
//! ```text
//! off ──request──▶ running ──n samples──▶ done
//!                     └── fault, moved, unsteady, too large ──▶ failed
//! ```
//!
//! A request is the input's change to true. Over `time` the mean of what is left of the reading without the tool's weight
//! is the bias; since the weight has been taken off, one pose is enough for all. From n samples of white noise σ the
//! bias is off by σ/√n: 0.01 N of 0.2 N in half a second. A tare that fails leaves the bias as it was.
//!
//! It fails when what it sees is not a bias at rest: the sensor has a fault (an end of the range among them), a joint has
//! moved by more than `motion`, a component's standard deviation exceeds `spread`, or the mean exceeds `max`. The last
//! one is the only guard against a hand that rests on the handle: **a constant push cannot be told from a bias**. Set
//! `max` to what the sensor may really drift.

use super::{Fault, Wrench};
use admittance::{Real, real};
use fmu_declaration::{Rows, Start};
use nalgebra::Vector3;

/// How far a tare has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TareState {
    /// None was asked for.
    Off,
    /// The samples are being taken.
    Running,
    /// The bias is that of the last tare.
    Done,
    /// The last tare found no bias.
    Failed(TareFailure),
}

/// Why a tare found no bias.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum TareFailure {
    /// The sensor had a fault.
    Fault = 1,
    /// A joint moved.
    Moved = 2,
    /// The reading scattered or drifted.
    Unsteady = 3,
    /// What was found is too large for a bias.
    TooLarge = 4,
}

/// What a tare asks for. The start values: half a second; the least count of a 14-bit encoder three times over; a hand's tremor
/// does not pass.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct TareSettings {
    /// Time for which a tare takes samples.
    #[parameter(91, name = "ft.tare_time", unit = SECOND, range = POSITIVE, start = 0.5)]
    pub time: Real,
    /// Motion of a joint beyond which a tare fails.
    #[parameter(92, name = "ft.tare_motion", unit = RADIAN, range = NOT_NEGATIVE, start = 1.2e-3)]
    pub motion: Real,
    /// Standard deviation of a force component beyond which a tare fails; 0 = any.
    #[parameter(93, name = "ft.tare_spread_force", unit = NEWTON, range = NOT_NEGATIVE, start = 0.5)]
    pub spread_force: Real,
    /// Standard deviation of a moment component beyond which a tare fails; 0 = any.
    #[parameter(94, name = "ft.tare_spread_torque", unit = NEWTON_METRE, range = NOT_NEGATIVE, start = 0.05)]
    pub spread_torque: Real,
    /// Force component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any.
    #[parameter(95, name = "ft.tare_max_force", unit = NEWTON, range = NOT_NEGATIVE, start = 20.0)]
    pub max_force: Real,
    /// Moment component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any.
    #[parameter(96, name = "ft.tare_max_torque", unit = NEWTON_METRE, range = NOT_NEGATIVE, start = 2.0)]
    pub max_torque: Real,
}

/// The tare between two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tare {
    settings: TareSettings,
    /// Samples that make a tare.
    needed: u32,
    requested: bool,
    progress: Progress,
}

/// How far it has come, and what it has found so far.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Progress {
    pub state: TareState,
    pub bias: Wrench,
    count: u32,
    start: Vector3<Real>,
    mean: [Real; 6],
    /// Sum of the squared deviations from the mean (Welford): no cancellation, also in single precision.
    deviation: [Real; 6],
}

impl TareState {
    /// The number by which the interface knows it: 0 off, 1 running, 2 done, 3 failed.
    pub fn number(self) -> i32 {
        match self {
            Self::Off => 0,
            Self::Running => 1,
            Self::Done => 2,
            Self::Failed(_) => 3,
        }
    }

    /// Why it failed, if it did.
    pub fn failure(self) -> Option<TareFailure> {
        match self {
            Self::Failed(failure) => Some(failure),
            Self::Off | Self::Running | Self::Done => None,
        }
    }
}

impl TareFailure {
    /// The number by which the interface knows it; 0 stands for none.
    pub fn number(self) -> i32 {
        self as i32
    }
}

impl Tare {
    /// No bias so far, at sample period `T` (s).
    pub fn new(settings: TareSettings, T: Real) -> Self {
        Self {
            settings,
            needed: real::max(1.0, settings.time / T + 0.5) as u32,
            requested: false,
            progress: Progress {
                state: TareState::Off,
                bias: Wrench::ZERO,
                count: 0,
                start: Vector3::zeros(),
                mean: [0.0; 6],
                deviation: [0.0; 6],
            },
        }
    }

    /// How far it has come.
    pub fn state(&self) -> TareState {
        self.progress.state
    }

    /// Whether none runs, and none was requested at the last sample.
    #[inline]
    pub(super) fn is_quiet(&self) -> bool {
        self.state() != TareState::Running && !self.requested
    }

    /// What the last tare that was done has found, else zero.
    pub fn bias(&self) -> &Wrench {
        &self.progress.bias
    }

    /// One sample: whether a tare is `requested`, the reading without the tool's weight, the sensor's fault, the joint
    /// angles `q` (rad). What changes by it but the request, into `progress`; nothing while no tare runs.
    #[inline]
    pub(super) fn sampled(
        &self,
        requested: bool,
        unladen: &Wrench,
        fault: Option<Fault>,
        q: impl FnOnce() -> Vector3<Real>,
        progress: &mut Option<Progress>,
    ) {
        let is_running = self.state() == TareState::Running;
        let asked = requested && !self.requested;
        if asked || is_running {
            *progress = Some(self.taken(unladen, fault, &q()));
        }
    }

    /// Goes on from a sample at which a tare was `requested` or not, and what changed by it.
    #[inline]
    pub(super) fn keep(&mut self, requested: bool, progress: Option<&Progress>) {
        self.requested = requested;
        if let Some(progress) = progress {
            self.progress = *progress;
        }
    }

    /// One more sample of a tare that runs, or begins.
    #[cold]
    fn taken(&self, unladen: &Wrench, fault: Option<Fault>, q: &Vector3<Real>) -> Progress {
        let mut progress = match self.state() {
            TareState::Running => self.progress,
            TareState::Off | TareState::Done | TareState::Failed(_) => Progress {
                state: TareState::Running,
                bias: self.progress.bias,
                count: 0,
                start: *q,
                mean: [0.0; 6],
                deviation: [0.0; 6],
            },
        };
        progress.state = progress.with(unladen, fault, q, self);
        progress
    }
}

impl Progress {
    /// The state after one more sample of a `tare`.
    fn with(
        &mut self,
        unladen: &Wrench,
        fault: Option<Fault>,
        q: &Vector3<Real>,
        tare: &Tare,
    ) -> TareState {
        let TareSettings {
            motion,
            spread_force,
            spread_torque,
            max_force,
            max_torque,
            ..
        } = tare.settings;
        if fault.is_some() {
            return TareState::Failed(TareFailure::Fault);
        }
        let moved = |(q, start): (&Real, &Real)| !within(q - start, motion);
        if q.iter().zip(&self.start).any(moved) {
            return TareState::Failed(TareFailure::Moved);
        }
        self.count += 1;
        let statistics = self.mean.iter_mut().zip(&mut self.deviation);
        for ((mean, deviation), x) in statistics.zip(unladen.components()) {
            let before = x - *mean;
            *mean += before / self.count as Real;
            *deviation += before * (x - *mean);
        }
        if self.count < tare.needed {
            return TareState::Running;
        }
        let spread = Wrench::from(
            self.deviation
                .map(|deviation| real::sqrt(deviation / self.count as Real)),
        );
        let mean = Wrench::from(self.mean);
        if !all_within(&spread, spread_force, spread_torque) {
            TareState::Failed(TareFailure::Unsteady)
        } else if !all_within(&mean, max_force, max_torque) {
            TareState::Failed(TareFailure::TooLarge)
        } else {
            self.bias = mean;
            TareState::Done
        }
    }
}

/// Whether |`x`| ≤ `limit`; NaN is not.
fn within(x: Real, limit: Real) -> bool {
    real::abs(x) <= limit
}

/// Whether every component is finite and within its limit; a limit of 0 is none.
fn all_within(wrench: &Wrench, force: Real, torque: Real) -> bool {
    let good = |x: &Real, limit: Real| x.is_finite() && (limit == 0.0 || within(*x, limit));
    wrench.force.iter().all(|x| good(x, force)) && wrench.torque.iter().all(|x| good(x, torque))
}
