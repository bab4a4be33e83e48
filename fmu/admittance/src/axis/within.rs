//! One axis among several that an edge bounds together.

use super::{Axis, AxisProposal, Driven};
use crate::Real;
use crate::bounds::Interval;

impl Axis {
    /// The nominal's velocity without bounds (m/s), and its share K A of W: while it feels all of K y, or the force `felt`
    /// (N).
    pub(crate) fn free(&self, proposal: &AxisProposal, felt: Option<Real>) -> (Real, Real) {
        let (rule, sample) = (&self.rule, &proposal.sample);
        let v_m = match felt {
            None => rule.coupled(sample).v_m,
            Some(f) => rule.driven(sample, f / rule.gains.K),
        };
        (v_m, rule.gains.K * rule.inertia(sample, felt.is_none()))
    }

    /// The proposal of a nominal that wants to move with `v_m` (m/s), held back or not.
    pub(crate) fn moved(&self, proposal: &mut AxisProposal, wish: Driven) {
        proposal.wish = wish;
        proposal.f_demand = self.rule.gains.K * self.rule.coupling(&proposal.sample, wish.v_m);
    }
}

impl AxisProposal {
    /// Velocities that the axis's own bounds allow.
    pub(crate) fn interval(&self) -> Interval {
        self.interval
    }
}
