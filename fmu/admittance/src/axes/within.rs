//! Axes that edges bound together: [`crate::edges`].

use super::{Axes, AxesDriven, AxesProposal};
use crate::Real;
use crate::edges::{Edge, keeps, kept};
use nalgebra::SVector;

impl<const N: usize> Axes<N> {
    /// Keeps what the axes have proposed within `edges`.
    pub fn keep_within<const E: usize>(
        &self,
        edges: &[Edge<N>; E],
        proposal: &mut AxesProposal<N>,
    ) {
        if keeps(edges, &proposal.wish.v_m) {
            return;
        }
        proposal.wish = self.within(edges, proposal, None);
        for i in 0..N {
            let rule = &self.axes[i].rule;
            proposal.f_demand[i] =
                rule.gains.K * rule.coupling(&proposal.sample(i), proposal.wish.v_m[i]);
        }
    }

    /// How the nominals move within `edges` while they feel the forces `f` (N). Without edges they would move as `driven`.
    ///
    /// An axis that gets what it asked for keeps to its wish; where that one is held, by a force that several axes share, all
    /// are looked at anew.
    pub fn driven_within<const E: usize>(
        &self,
        edges: impl FnOnce() -> [Edge<N>; E],
        proposal: &AxesProposal<N>,
        driven: AxesDriven<N>,
        f: &SVector<Real, N>,
    ) -> AxesDriven<N> {
        let feels = self.settings.law.row().feels_what_is_delivered();
        if !feels || *f == proposal.f_demand {
            return driven; // as proposed
        }
        let edges = edges();
        if !proposal.wish.is_held() && keeps(&edges, &driven.v_m) {
            return driven;
        }
        self.within(&edges, proposal, Some(f))
    }

    /// The nominals' velocities within `edges`: while they feel all of K y, or the forces `felt` (N). Each counts with its share
    /// K A of W.
    fn within<const E: usize>(
        &self,
        edges: &[Edge<N>; E],
        proposal: &AxesProposal<N>,
        felt: Option<&SVector<Real, N>>,
    ) -> AxesDriven<N> {
        let (mut free, mut weight) = (SVector::zeros(), SVector::zeros());
        for i in 0..N {
            let (axis, sample) = (&self.axes[i], proposal.sample(i));
            free[i] = match felt {
                None => axis.rule.coupled(&sample),
                Some(f) => axis.rule.driven(&sample, axis.y(f[i])),
            };
            weight[i] = axis.gains().K * axis.rule.inertia(&sample, felt.is_none());
        }
        let v_m = kept(edges, &proposal.interval, &weight, &free);
        AxesDriven {
            v_m,
            held: core::array::from_fn(|i| v_m[i] != free[i]),
        }
    }
}
