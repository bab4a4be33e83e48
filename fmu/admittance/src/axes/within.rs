//! Axes that edges bound together: [`crate::edges`].

use super::Axes;
use crate::Real;
use crate::axis::{AxisProposal, Driven};
use crate::edges::{Edge, keeps, kept};
use nalgebra::SVector;

impl<const N: usize> Axes<N> {
    /// Keeps what the axes have proposed within `edges`.
    pub fn keep_within<const E: usize>(
        &self,
        edges: &[Edge<N>; E],
        proposal: &mut [AxisProposal; N],
    ) {
        if keeps(edges, &velocities(&proposal.map(|axis| axis.wish()))) {
            return;
        }
        let wish = self.within(edges, proposal, |_| None);
        for ((axis, proposal), wish) in self.axes.iter().zip(proposal).zip(wish) {
            axis.moved(proposal, wish);
        }
    }

    /// How the nominals move within `edges` while they feel the forces `f` (N). Without edges they would move as `driven`.
    ///
    /// An axis that gets what it asked for keeps to its wish; where that one is held, by a force that several axes share, all
    /// are looked at anew.
    pub fn driven_within<const E: usize>(
        &self,
        edges: impl FnOnce() -> [Edge<N>; E],
        proposal: &[AxisProposal; N],
        driven: [Driven; N],
        f: &SVector<Real, N>,
    ) -> [Driven; N] {
        let feels = self.settings.law.row().feels_what_is_delivered();
        if !feels || (0..N).all(|i| f[i] == proposal[i].f_demand()) {
            return driven; // as proposed
        }
        let edges = edges();
        let is_held = proposal.iter().any(|axis| axis.wish().held);
        if !is_held && keeps(&edges, &velocities(&driven)) {
            return driven;
        }
        self.within(&edges, proposal, |i| Some(f[i]))
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
