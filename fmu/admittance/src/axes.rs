//! N axes, without a ledger: what several scalars do at one tick.

use crate::bounds::Bounds;
use crate::ledger::{Keep, Stored};
use crate::{Axis, Gains, ParameterError, Real, Settings, axis, real};
use nalgebra::SVector;

/// N axes of the law between two ticks. They start out of the loop; the first tick engages them with q_n = q and v_n = 0.
///
/// A tick: [`sense`](Axes::sense) → the caller settles its ledger, perhaps [`reduced`](Stored::reduced) →
/// [`propose`](Sensed::propose) → the caller's limits → [`commit`](Axes::commit).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axes<const N: usize> {
    settings: Settings,
    axes: SVector<Axis, N>,
    engaged: bool,
}

/// What is asked of the law at a tick, beside its inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request<const N: usize> {
    /// Share of the force that the robot is to get, in [0, 1]: for fading in and out. A NaN counts as 0.
    pub authority: Real,
    /// Whether the nominal stays where it is: the coupling then supports any load without drift.
    pub hold: bool,
    /// Damping on top of D_n, N·s/m, ≥ 0.
    pub damping: SVector<Real, N>,
    /// Speed that the nominal must not exceed, beside its bounds, m/s, ≥ 0; infinite for no limit.
    pub speed: SVector<Real, N>,
}

impl<const N: usize> Default for Request<N> {
    /// The law alone.
    fn default() -> Self {
        Self {
            authority: 1.0,
            hold: false,
            damping: SVector::zeros(),
            speed: SVector::repeat(Real::INFINITY),
        }
    }
}

impl<const N: usize> Request<N> {
    /// The authority within [0, 1].
    pub fn share(&self) -> Real {
        if self.authority > 0.0 {
            real::min(self.authority, 1.0)
        } else {
            0.0
        }
    }
}

/// The axes at a tick, once the position is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed<const N: usize>(SVector<axis::Sensed, N>);

/// What the axes ask for at a tick. Nothing has happened until it is committed; it may be dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Proposal<const N: usize>(SVector<axis::Proposal, N>);

/// What the axes did at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Committed<const N: usize> {
    /// K y before any limit, N.
    pub f_demand: SVector<Real, N>,
    /// Nominal position q + e_nr, m.
    pub q_n: SVector<Real, N>,
    /// Nominal velocity, m/s.
    pub dq_n: SVector<Real, N>,
    /// q_n − q after the slip, m.
    pub e_nr: SVector<Real, N>,
    /// The robot's velocity as the law used it, m/s.
    pub dq: SVector<Real, N>,
    /// Whether one of the [`Bounds`], or hold, kept a nominal back.
    pub held: bool,
    /// Energy (K/alpha) f_h v_m T that the human's port brings in the sample that begins, J. Not finite for alpha = 0.
    pub supplied: Real,
}

impl<const N: usize> Axes<N> {
    /// Out of the loop, without bounds.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law that is not offered.
    pub fn new(settings: Settings, gains: [Gains; N]) -> Result<Self, ParameterError> {
        settings.check()?;
        check(&gains)?;
        let axes = SVector::from(gains).map(|gains| Axis::new(gains, Bounds::default(), 0.0));
        Ok(Self {
            settings,
            axes,
            engaged: false,
        })
    }

    /// Within other bounds from the next tick on.
    ///
    /// # Errors
    /// The first bound out of its range; the bounds stay as they were.
    pub fn bound(&mut self, bounds: [Bounds; N]) -> Result<(), ParameterError> {
        for (axis, bounds) in (1..).zip(&bounds) {
            bounds.check(named::<N>(axis))?;
        }
        self.axes.zip_apply(&SVector::from(bounds), |axis, bounds| {
            *axis = axis.within(bounds);
        });
        Ok(())
    }

    /// Other gains: on a straight line over the tuning time, each step taken over so that the stored energy does not rise.
    ///
    /// # Errors
    /// The first parameter out of its range; the gains stay as they were.
    pub fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        check(&gains)?;
        let ticks = self.settings.tuning_ticks();
        self.axes.zip_apply(&SVector::from(gains), |axis, gains| {
            *axis = axis.tuned(gains, ticks);
        });
        Ok(())
    }

    /// The axes at a tick with positions `q` (m).
    #[must_use]
    pub fn sense(&self, q: &SVector<Real, N>) -> Sensed<N> {
        Sensed(self.axes.zip_map(q, |axis, q| {
            let axis = if self.engaged {
                axis
            } else {
                axis.engaged_at(q)
            };
            axis.sensed(q, &self.settings)
        }))
    }

    /// The nominals move on, while the robot gets the forces `f` (N) along the axes: what the caller's limits left of
    /// [`Proposal::f`].
    ///
    /// Under `passive_applied` and `passive_bounded` the nominal feels `f`, under `passive` the whole y, under `standard`
    /// nothing.
    pub fn commit(&mut self, proposal: Proposal<N>, f: &SVector<Real, N>) -> Committed<N> {
        let Proposal(axes) = proposal;
        let done = axes.zip_map(f, |axis, f| axis.commit(f, &self.settings));
        self.axes = done.map(|axis| axis.axis);
        self.engaged = true;
        Committed {
            f_demand: axes.map(|axis| axis.f_demand()),
            q_n: axes.map(|axis| axis.q_n()),
            dq_n: axes.map(|axis| axis.dq_n()),
            e_nr: axes.map(|axis| axis.e_nr()),
            dq: axes.map(|axis| axis.dq()),
            held: done.iter().any(|axis| axis.held),
            supplied: done.iter().map(|axis| axis.supplied).sum(),
        }
    }

    /// Out of the loop at positions `q` (m): q_n = q, v_n = 0, nothing stored. The next tick engages anew.
    pub fn rest(&mut self, q: &SVector<Real, N>) {
        self.axes.zip_apply(q, |axis, q| *axis = axis.engaged_at(q));
        self.engaged = false;
    }

    /// Whether the law is in the loop: since the last tick that was committed, unless it rests.
    pub fn is_engaged(&self) -> bool {
        self.engaged
    }

    /// What all axes share.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }
}

impl<const N: usize> Stored for Sensed<N> {
    fn stored(&self, settings: &Settings) -> Real {
        self.0.iter().map(|axis| axis.stored(settings)).sum()
    }

    fn spring(&self, settings: &Settings) -> Real {
        self.0.iter().map(|axis| axis.spring(settings)).sum()
    }

    fn masses(&self, settings: &Settings) -> Real {
        self.0.iter().map(|axis| axis.mass(settings)).sum()
    }

    fn reduced(&self, keep: Keep) -> Self {
        Self(self.0.map(|axis| axis.reduced(keep.e, keep.v_n)))
    }
}

impl<const N: usize> Sensed<N> {
    /// What the axes ask for with the human's forces `f_h` (N) along them.
    pub fn propose(
        &self,
        f_h: &SVector<Real, N>,
        request: &Request<N>,
        settings: &Settings,
    ) -> Proposal<N> {
        let each = request
            .damping
            .zip_map(&request.speed, |damping, speed| axis::Request {
                hold: request.hold,
                damping,
                speed,
            });
        Proposal(self.0.zip_zip_map(f_h, &each, |axis, f_h, request| {
            axis.propose(f_h, &request, settings)
        }))
    }
}

impl<const N: usize> Proposal<N> {
    /// The force that the axes ask for within ±f_max, N: what the caller maps to its actuators.
    pub fn f(&self) -> SVector<Real, N> {
        self.0.map(|axis| axis.f())
    }

    /// Energy (J) that the axes are sure to take in the sample that begins, if the robot gets the forces `f` (N):
    /// [`axis::Proposal::taken`].
    pub fn taken(&self, f: &SVector<Real, N>, settings: &Settings) -> Real {
        self.0
            .iter()
            .zip(f)
            .map(|(axis, f)| axis.taken(*f, settings))
            .sum()
    }
}

/// The axis as messages name it: not at all if there is one only.
fn named<const N: usize>(axis: usize) -> Option<usize> {
    (N > 1).then_some(axis)
}

fn check<const N: usize>(gains: &[Gains; N]) -> Result<(), ParameterError> {
    gains
        .iter()
        .zip(1..)
        .try_for_each(|(gains, axis)| gains.check(named::<N>(axis)))
}
