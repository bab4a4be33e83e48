//! One tick of the law, whatever its coordinates: settle, propose, deliver, share, commit.

use crate::ledger::{Flow, Ledger};
use crate::rate::Rate;
use crate::settling::{Keep, Settlement};
use crate::{ParameterError, Reach, Real, Settings};
use nalgebra::SVector;

/// The law in its own coordinates: nominals, and the couplings between them and the robot. N axes, or the joints of an arm.
///
/// All but [`commit`](Self::commit) and [`rest`](Self::rest) leave it as it is.
pub trait Coordinates<const N: usize> {
    /// Where the robot is, in these coordinates.
    type Place;
    /// What is asked of the nominals beside the human's force.
    type Request;
    /// The law once the place is known.
    type Sensed: Copy;
    /// What it asks for.
    type Proposal: Copy;
    /// How the nominals move in the sample that begins.
    type Driven;

    /// What stays fixed.
    fn settings(&self) -> &Settings;
    /// Whether it is in the loop: since the last tick that was committed, unless it rests.
    fn is_engaged(&self) -> bool;
    /// The law at `place`, which was read `after` sample periods after the last one: gains on their way take over, the
    /// springs slip.
    fn sense(&self, place: &Self::Place, after: Real) -> Self::Sensed;
    /// Energy stored then, J. 0 for alpha = 0.
    fn stored(&self, sensed: &Self::Sensed) -> Real;
    /// The springs' part of it, J.
    fn springs(&self, sensed: &Self::Sensed) -> Real;
    /// The nominal masses' part of it, J; not as a difference, which would round like the whole.
    fn masses(&self, sensed: &Self::Sensed) -> Real;
    /// Gives up all but these fractions of the position errors and of the nominal velocities.
    fn reduce(&self, sensed: &mut Self::Sensed, keep: Keep);
    /// What it asks for under the human's forces `f_h` (N): nominal and coupling are solved together.
    fn propose(
        &self,
        sensed: &Self::Sensed,
        f_h: &SVector<Real, N>,
        request: &Self::Request,
    ) -> Self::Proposal;
    /// The forces that it asks for, within ±f_max, N.
    fn f(&self, proposal: &Self::Proposal) -> SVector<Real, N>;
    /// How the nominals move if the robot gets the forces `f` (N). What they feel of it, the law says: [`Felt`].
    ///
    /// [`Felt`]: crate::law::Felt
    fn driven(&self, proposal: &Self::Proposal, f: &SVector<Real, N>) -> Self::Driven;
    /// Energy (J) that the law is sure to take in the sample that begins, if the robot gets the forces `f` (N) and the
    /// nominals are `driven` by them.
    fn taken(&self, proposal: &Self::Proposal, driven: &Self::Driven, f: &SVector<Real, N>)
    -> Real;
    /// Energy (K/alpha) f_h·v_m T that the human's port brings in the sample that begins, J. 0 for alpha = 0.
    fn supplied(&self, proposal: &Self::Proposal, driven: &Self::Driven) -> Real;
    /// The terms of the energy that passes the coupling in the sample that begins, at their sizes, J: what rounding is
    /// measured by.
    fn exchanged(&self, proposal: &Self::Proposal, driven: &Self::Driven) -> Real;
    /// Writes f_demand, q_n, dq_n, e_nr, dq and held.
    fn show(&self, proposal: &Self::Proposal, driven: &Self::Driven, tick: &mut Tick<N>);
    /// The nominals move on, while the robot gets the forces `f` (N).
    fn commit(&mut self, proposal: &Self::Proposal, driven: &Self::Driven, f: &SVector<Real, N>);
    /// Out of the loop: nothing is stored. The next tick engages with q_n = q, v_n = 0.
    fn rest(&mut self);
}

/// What brings the law's forces to the robot.
pub trait Actuators<const N: usize> {
    /// What they deliver of the forces `asked` (N) along the law's coordinates.
    fn deliver(&self, asked: &SVector<Real, N>) -> Delivered<N>;
}

/// What the actuators deliver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delivered<const N: usize> {
    /// Forces along the law's coordinates, N: what the nominals may feel.
    pub f: SVector<Real, N>,
    /// Forces of the actuators, N or N·m: what works on the robot.
    pub tau: SVector<Real, N>,
    /// Whether a limit of theirs acts that `f` does not show.
    pub limited: bool,
}

/// Actuators that act along the law's coordinates and deliver what they are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direct;

impl<const N: usize> Actuators<N> for Direct {
    #[inline]
    fn deliver(&self, asked: &SVector<Real, N>) -> Delivered<N> {
        Delivered {
            f: *asked,
            tau: *asked,
            limited: false,
        }
    }
}

/// What is sensed and asked for at a tick.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a, L: Coordinates<N>, const N: usize> {
    /// Where the robot is, in the law's coordinates.
    pub place: &'a L::Place,
    /// The actuators' positions, m or rad: the ledger's.
    pub q: &'a SVector<Real, N>,
    /// Forces of the human along the law's coordinates, N.
    pub f_h: &'a SVector<Real, N>,
    /// Part of the force that the robot is to get, in [0, 1].
    pub authority: Real,
    /// What is asked of the nominals.
    pub request: &'a L::Request,
    /// Sample periods that have passed since the place before this one was read; 1: the tick is in time.
    pub after: Real,
}

/// What happened at a tick; every value is the one at t_k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick<const N: usize> {
    /// Force on the robot along the law's coordinates, N, held until the next tick.
    pub f: SVector<Real, N>,
    /// The same force as the actuators give it, N or N·m.
    pub tau: SVector<Real, N>,
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
    /// Whether a limit of the actuators acts that `f` does not show.
    pub limited: bool,
    /// Whether any coordinate got less than it asked for.
    pub saturated: bool,
    /// Whether one of the [`Bounds`](crate::Bounds), or hold, kept a nominal back.
    pub held: bool,
    /// Share of the force that the energy budget left, in [0, 1]: 1 unless something is wrong.
    pub share: Real,
    /// Whether the motion since the last tick exceeded the [`Reach`], to which the passivity argument is restricted.
    pub outside_bounds: bool,
    /// Whether the law is in the loop.
    pub engaged: bool,
}

/// A result that was not accepted. Nothing has happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

/// A sampled law: the law in its coordinates, its ledger, and what it said last.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sampled<L, const N: usize> {
    law: L,
    ledger: Ledger<N>,
    rate: Rate<N>,
    f: SVector<Real, N>,
    tau: SVector<Real, N>,
}

impl<L: Coordinates<N>, const N: usize> Sampled<L, N> {
    /// Out of the loop, on a robot with this `reach`, without a limit on the forces' rate.
    ///
    /// # Errors
    /// The first value of the reach out of its range.
    pub fn new(law: L, reach: &Reach<N>) -> Result<Self, ParameterError> {
        reach.check()?;
        Ok(Self {
            ledger: Ledger::new(law.settings(), reach),
            law,
            rate: Rate::none(),
            f: SVector::zeros(),
            tau: SVector::zeros(),
        })
    }

    /// The same on a robot with another reach; its ledger starts anew.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn reaching(mut self, reach: &Reach<N>) -> Result<Self, ParameterError> {
        reach.check()?;
        self.ledger = Ledger::new(self.law.settings(), reach);
        Ok(self)
    }

    /// The same with actuators whose forces change no faster than `rate` (N/s), infinite for no limit.
    ///
    /// # Errors
    /// The first rate out of its range.
    pub fn rated(mut self, rate: &SVector<Real, N>) -> Result<Self, ParameterError> {
        self.rate = Rate::new(rate, self.law.settings().T)?;
        Ok(self)
    }

    /// One tick in the loop. Nothing has happened until `accept` has seen the tick and the energy G (J), and says yes.
    ///
    /// # Errors
    /// `accept` says no: the law is as it was.
    #[inline]
    pub fn tick(
        &mut self,
        inputs: &Inputs<'_, L, N>,
        actuators: &impl Actuators<N>,
        accept: impl FnOnce(&Tick<N>, Real) -> bool,
    ) -> Result<(), Refused> {
        let law = &self.law;

        // 1. Settle. The sample that ends is known now: the tank pays for what it created.
        let mut sensed = law.sense(inputs.place, inputs.after);
        let mut settlement = self.ledger.settle(law, &mut sensed, inputs.q);
        if !law.is_engaged() {
            settlement = settlement.without_motion();
        }

        // 2. Propose. Nominal and coupling are solved together.
        let proposal = law.propose(&sensed, inputs.f_h, inputs.request);
        let asked = law.f(&proposal) * inputs.authority;

        // 3. Deliver. What the actuators give of that, within their limits and their rate.
        let Delivered { f, tau, limited } = actuators.deliver(&asked);
        let (mut f, mut tau) = self.on_the_way(f, tau);

        // 4. Share. What the tank covers of that, however the robot moves within its reach.
        let mut driven = law.driven(&proposal, &f);
        let mut share = 1.0;
        let taken = law.taken(&proposal, &driven, &f);
        if !self.ledger.covers(&settlement, &tau, taken) {
            (share, driven) = self.shared(settlement, proposal, f, tau);
            (f, tau) = (f * share, tau * share);
        }

        // 5. Commit. The nominals move on, feeling what the law says, and the sample that begins is booked.
        let flow = Flow {
            supplied: law.supplied(&proposal, &driven),
            exchanged: law.exchanged(&proposal, &driven),
        };
        let mut tick = Tick {
            f,
            tau,
            limited,
            share,
            outside_bounds: settlement.is_outside(),
            engaged: true,
            ..Tick::at_rest(&f)
        };
        law.show(&proposal, &driven, &mut tick);
        tick.saturated = limited || f != tick.f_demand;
        if !accept(&tick, settlement.G()) {
            return Err(Refused);
        }
        self.law.commit(&proposal, &driven, &f);
        self.book(&settlement, Some(inputs.q), f, tau, flow);
        Ok(())
    }

    /// The share of the forces `f` and `tau` that the tank covers, where it does not cover the whole, and how the nominals move
    /// with it. It gets copies: what nothing points at stays in registers in the ticks that do not come here.
    #[cold]
    #[inline(never)]
    fn shared(
        &self,
        settlement: Settlement<N>,
        proposal: L::Proposal,
        f: SVector<Real, N>,
        tau: SVector<Real, N>,
    ) -> (Real, L::Driven) {
        let driven = |share| self.law.driven(&proposal, &(f * share));
        let share = self.ledger.share(&settlement, &tau, |share| {
            self.law.taken(&proposal, &driven(share), &(f * share))
        });
        (share, driven(share))
    }

    /// As far towards the forces `f` and `tau` as the actuators' rate allows.
    #[inline]
    fn on_the_way(
        &self,
        f: SVector<Real, N>,
        tau: SVector<Real, N>,
    ) -> (SVector<Real, N>, SVector<Real, N>) {
        let way = self.rate.way(&self.tau, &tau);
        if way < 1.0 {
            (
                self.f + (f - self.f) * way,
                self.tau + (tau - self.tau) * way,
            )
        } else {
            (f, tau)
        }
    }

    #[inline]
    fn book(
        &mut self,
        ended: &Settlement<N>,
        q: Option<&SVector<Real, N>>,
        f: SVector<Real, N>,
        tau: SVector<Real, N>,
        flow: Flow,
    ) {
        self.ledger.book(ended, q, &tau, flow);
        (self.f, self.tau) = (f, tau);
    }

    /// One tick out of the loop with the actuators at `q` (m or rad): no force. The energy that was stored is given up; the
    /// next [`tick`](Self::tick) engages anew. Returns whether the motion since the last tick exceeded the reach.
    ///
    /// # Errors
    /// `accept` says no to the energy G (J): the law is as it was.
    pub fn rest(
        &mut self,
        q: &SVector<Real, N>,
        accept: impl FnOnce(Real) -> bool,
    ) -> Result<bool, Refused> {
        let settlement = self.ledger.close(0.0, q);
        if !accept(settlement.G()) {
            return Err(Refused);
        }
        Ok(self.leave(&settlement, Some(q)))
    }

    /// The same where the actuators' positions at this tick are not known, or no numbers: the tank pays for the most that the
    /// forces can have done since the last one.
    pub fn abandon(&mut self) -> bool {
        let settlement = self.ledger.close_unseen();
        self.leave(&settlement, None)
    }

    fn leave(&mut self, ended: &Settlement<N>, q: Option<&SVector<Real, N>>) -> bool {
        self.law.rest();
        self.book(
            ended,
            q,
            SVector::zeros(),
            SVector::zeros(),
            Flow::default(),
        );
        ended.is_outside()
    }

    /// Sample period, s.
    pub fn T(&self) -> Real {
        self.law.settings().T
    }

    /// A force begins to act this `part` of a sample after its tick, in (0, 1): [`acts`](Self::acts) says where. Only with a
    /// delay.
    pub fn lag(&mut self, part: Real) {
        self.ledger.lag(part);
    }

    /// The force of the last tick begins to act at the actuators' positions `q` (m or rad); `None` where they are not known.
    pub fn acts(&mut self, q: Option<&SVector<Real, N>>) {
        self.ledger.switch(q);
    }

    /// Counts the actuators' positions from a place that is further on by `by` (m or rad).
    pub fn count_from(&mut self, by: &SVector<Real, N>) {
        self.ledger.count_from(by);
    }

    /// The law in its coordinates.
    pub fn law(&self) -> &L {
        &self.law
    }

    /// The law in its coordinates, to be tuned or bounded.
    pub fn law_mut(&mut self) -> &mut L {
        &mut self.law
    }

    /// What the actuators last got, N or N·m.
    pub fn tau(&self) -> &SVector<Real, N> {
        &self.tau
    }

    /// Energy stored and created, as of the last tick; the work is the actuators'.
    pub fn ledger(&self) -> &Ledger<N> {
        &self.ledger
    }
}

impl<const N: usize> Tick<N> {
    /// Out of the loop at the position `q` (m).
    pub fn at_rest(q: &SVector<Real, N>) -> Self {
        let zeros = SVector::zeros();
        Self {
            f: zeros,
            tau: zeros,
            f_demand: zeros,
            q_n: *q,
            dq_n: zeros,
            e_nr: zeros,
            dq: zeros,
            limited: false,
            saturated: false,
            held: false,
            share: 1.0,
            outside_bounds: false,
            engaged: false,
        }
    }
}
