//! The axes of the handle within the workspace: those of [`admittance`], held by edges where any is near.

use super::Near;
use super::edges::EDGES;
use admittance::axes::{AxesDriven, AxesProposal, AxesSensed};
use admittance::edges::Edge;
use admittance::settling::Keep;
use admittance::tick::{Coordinates, Tick};
use admittance::{Axes, Real, Request, Settings};
use nalgebra::Vector3;

/// The handle's three axes between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HandleAxes {
    /// The axes.
    pub axes: Axes<3>,
    /// The limits of the workspace during a tick at which any is near; none between ticks.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub near: Option<Near>,
}

impl HandleAxes {
    /// The edges of a nominal that is ahead of the handle as proposed.
    fn edges(near: &Near, proposal: &AxesProposal<3>) -> [Edge<3>; EDGES] {
        near.edges(proposal.e_nr())
    }

    #[cold]
    #[inline(never)]
    fn propose_within(
        &self,
        near: &Near,
        sensed: AxesSensed<3>,
        f_h: &Vector3<Real>,
        request: Request<3>,
    ) -> AxesProposal<3> {
        let mut proposal = self.axes.propose(&sensed, f_h, &request);
        let edges = Self::edges(near, &proposal);
        self.axes.keep_within(&edges, &mut proposal);
        proposal
    }

    #[cold]
    #[inline(never)]
    fn driven_within(
        &self,
        near: &Near,
        proposal: AxesProposal<3>,
        f: Vector3<Real>,
    ) -> AxesDriven<3> {
        let edges = || Self::edges(near, &proposal);
        let driven = self.axes.driven(&proposal, &f);
        self.axes.driven_within(edges, &proposal, driven, &f)
    }
}

impl Coordinates<3> for HandleAxes {
    type Place = Vector3<Real>;
    type Request = Request<3>;
    type Sensed = AxesSensed<3>;
    type Proposal = AxesProposal<3>;
    type Driven = AxesDriven<3>;

    fn settings(&self) -> &Settings {
        self.axes.settings()
    }

    #[inline]
    fn is_engaged(&self) -> bool {
        self.axes.is_engaged()
    }

    #[inline]
    fn sense(&self, p: &Vector3<Real>, after: Real) -> AxesSensed<3> {
        self.axes.sense(p, after)
    }

    #[inline(always)]
    fn stored(&self, sensed: &AxesSensed<3>) -> Real {
        self.axes.stored(sensed)
    }

    fn springs(&self, sensed: &AxesSensed<3>) -> Real {
        self.axes.springs(sensed)
    }

    fn masses(&self, sensed: &AxesSensed<3>) -> Real {
        self.axes.masses(sensed)
    }

    fn reduce(&self, sensed: &mut AxesSensed<3>, keep: Keep) {
        self.axes.reduce(sensed, keep);
    }

    #[inline(always)]
    fn propose(
        &self,
        sensed: &AxesSensed<3>,
        f_h: &Vector3<Real>,
        request: &Request<3>,
    ) -> AxesProposal<3> {
        match &self.near {
            None => self.axes.propose(sensed, f_h, request),
            Some(near) => self.propose_within(near, *sensed, f_h, *request),
        }
    }

    #[inline]
    fn f(&self, proposal: &AxesProposal<3>) -> Vector3<Real> {
        self.axes.f(proposal)
    }

    #[inline(always)]
    fn driven(&self, proposal: &AxesProposal<3>, f: &Vector3<Real>) -> AxesDriven<3> {
        match &self.near {
            None => self.axes.driven(proposal, f),
            Some(near) => self.driven_within(near, *proposal, *f),
        }
    }

    #[inline(always)]
    fn taken(&self, proposal: &AxesProposal<3>, driven: &AxesDriven<3>, f: &Vector3<Real>) -> Real {
        self.axes.taken(proposal, driven, f)
    }

    #[inline]
    fn supplied(&self, proposal: &AxesProposal<3>, driven: &AxesDriven<3>) -> Real {
        self.axes.supplied(proposal, driven)
    }

    #[inline]
    fn exchanged(&self, proposal: &AxesProposal<3>, driven: &AxesDriven<3>) -> Real {
        self.axes.exchanged(proposal, driven)
    }

    #[inline]
    fn show(&self, proposal: &AxesProposal<3>, driven: &AxesDriven<3>, tick: &mut Tick<3>) {
        self.axes.show(proposal, driven, tick);
    }

    #[inline]
    fn commit(&mut self, proposal: &AxesProposal<3>, driven: &AxesDriven<3>, f: &Vector3<Real>) {
        self.axes.commit(proposal, driven, f);
    }

    fn rest(&mut self) {
        self.axes.rest();
    }
}
