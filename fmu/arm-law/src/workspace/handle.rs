//! The axes of the handle within the workspace: those of [`admittance`], held by edges where any is near.

use super::Near;
use admittance::axis::{AxisProposal, AxisSensed, Driven};
use admittance::edges::Edge;
use admittance::settling::Keep;
use admittance::tick::{Coordinates, Tick};
use admittance::{Axes, Real, Request, Settings};
use nalgebra::Vector3;

/// The handle's three axes between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HandleAxes(pub Axes<3>);

/// Where the handle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its position, m.
    pub p: Vector3<Real>,
    /// The limits of the workspace, where any is near.
    pub near: Option<Near>,
}

/// The axes at a tick, before they act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    axes: [AxisSensed; 3],
    near: Option<Near>,
}

/// What they ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proposal {
    axes: [AxisProposal; 3],
    edges: Option<Held>,
}

/// The edges of a proposal, and whether they hold it back.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Held {
    edges: [Edge<3>; 4],
    acts: bool,
}

impl Coordinates<3> for HandleAxes {
    type Place = Place;
    type Request = Request<3>;
    type Sensed = Sensed;
    type Proposal = Proposal;
    type Driven = [Driven; 3];

    fn settings(&self) -> &Settings {
        self.0.settings()
    }

    #[inline]
    fn is_engaged(&self) -> bool {
        self.0.is_engaged()
    }

    #[inline]
    fn sense(&self, place: &Place) -> Sensed {
        Sensed {
            axes: self.0.sense(&place.p),
            near: place.near,
        }
    }

    #[inline]
    fn stored(&self, sensed: &Sensed) -> Real {
        self.0.stored(&sensed.axes)
    }

    fn springs(&self, sensed: &Sensed) -> Real {
        self.0.springs(&sensed.axes)
    }

    fn masses(&self, sensed: &Sensed) -> Real {
        self.0.masses(&sensed.axes)
    }

    fn reduce(&self, sensed: &mut Sensed, keep: Keep) {
        self.0.reduce(&mut sensed.axes, keep);
    }

    #[inline]
    fn propose(&self, sensed: &Sensed, f_h: &Vector3<Real>, request: &Request<3>) -> Proposal {
        let mut proposal = Proposal {
            axes: self.0.propose(&sensed.axes, f_h, request),
            edges: None,
        };
        if let Some(near) = &sensed.near {
            let e = proposal.axes.map(|axis| axis.e_nr());
            let edges = near.edges(&e.into());
            let acts = self.0.keep_within(&edges, &mut proposal.axes);
            proposal.edges = Some(Held { edges, acts });
        }
        proposal
    }

    #[inline]
    fn f(&self, proposal: &Proposal) -> Vector3<Real> {
        self.0.f(&proposal.axes)
    }

    #[inline]
    fn driven(&self, proposal: &Proposal, f: &Vector3<Real>) -> [Driven; 3] {
        let driven = self.0.driven(&proposal.axes, f);
        match &proposal.edges {
            None => driven,
            Some(Held { edges, acts }) => {
                self.0
                    .driven_within(edges, *acts, &proposal.axes, driven, f)
            }
        }
    }

    #[inline]
    fn taken(&self, proposal: &Proposal, driven: &[Driven; 3], f: &Vector3<Real>) -> Real {
        self.0.taken(&proposal.axes, driven, f)
    }

    #[inline]
    fn supplied(&self, proposal: &Proposal, driven: &[Driven; 3]) -> Real {
        self.0.supplied(&proposal.axes, driven)
    }

    #[inline]
    fn exchanged(&self, proposal: &Proposal, driven: &[Driven; 3]) -> Real {
        self.0.exchanged(&proposal.axes, driven)
    }

    #[inline]
    fn show(&self, proposal: &Proposal, driven: &[Driven; 3], tick: &mut Tick<3>) {
        self.0.show(&proposal.axes, driven, tick);
    }

    #[inline]
    fn commit(&mut self, proposal: &Proposal, driven: &[Driven; 3], f: &Vector3<Real>) {
        self.0.commit(&proposal.axes, driven, f);
    }

    fn rest(&mut self) {
        self.0.rest();
    }
}
