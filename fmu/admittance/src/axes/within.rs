//! Axes that edges bound together: [`crate::edges`].

use super::Axes;
use crate::Real;
use crate::axis::{AxisProposal, Driven};
use crate::edges::{Edge, keeps, kept};
use nalgebra::SVector;

impl<const N: usize> Axes<N> {
    /// Keeps what the axes have proposed within `edges`. Returns whether that takes a force.
    pub fn keep_within<const E: usize>(
        &self,
        edges: &[Edge<N>; E],
        proposal: &mut [AxisProposal; N],
    ) -> bool {
        if keeps(edges, &velocities(&proposal.map(|axis| axis.wish()))) {
            return false;
        }
        let wish = self.within(edges, proposal, |_| None);
        for ((axis, proposal), wish) in self.axes.iter().zip(proposal).zip(wish) {
            axis.moved(proposal, wish);
        }
        true
    }

    /// How the nominals move within `edges` while they feel the forces `f` (N). Without edges they would move as `driven`;
    /// what they have proposed has been `held` by the edges or not.
    pub fn driven_within<const E: usize>(
        &self,
        edges: &[Edge<N>; E],
        held: bool,
        proposal: &[AxisProposal; N],
        driven: [Driven; N],
        f: &SVector<Real, N>,
    ) -> [Driven; N] {
        let feels = self.settings.law.row().feels_what_is_delivered();
        let is_proposed = || (0..N).all(|i| f[i] == proposal[i].f_demand());
        if !feels || is_proposed() || (!held && keeps(edges, &velocities(&driven))) {
            return driven;
        }
        self.within(edges, proposal, |i| Some(f[i]))
    }

    fn within<const E: usize>(
        &self,
        edges: &[Edge<N>; E],
        proposal: &[AxisProposal; N],
        felt: impl Fn(usize) -> Option<Real>,
    ) -> [Driven; N] {
        let (mut free, mut weight) = (SVector::zeros(), SVector::zeros());
        for i in 0..N {
            (free[i], weight[i]) = self.axes[i].free(&proposal[i], felt(i));
        }
        let intervals = core::array::from_fn(|i| proposal[i].interval());
        let v_m = kept(edges, &intervals, &weight, &free);
        core::array::from_fn(|i| Driven {
            v_m: v_m[i],
            held: v_m[i] != free[i],
        })
    }
}

fn velocities<const N: usize>(driven: &[Driven; N]) -> SVector<Real, N> {
    SVector::from_fn(|i, _| driven[i].v_m)
}
