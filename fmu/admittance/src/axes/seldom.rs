//! What several axes do at few ticks only. It gets copies: what nothing points at stays in registers at all others.

use super::{Axes, AxesDriven, AxesProposal, AxesSensed, Request};
use crate::bounds::Interval;
use crate::{Bounds, Real, retune, timing};
use nalgebra::SVector;

impl<const N: usize> Axes<N> {
    /// What is sensed where a tick does not come in time, gains are on their way, or velocities pass a filter; the springs
    /// have not slipped yet.
    #[cold]
    #[inline(never)]
    pub(super) fn sense_otherwise(&self, q: &SVector<Real, N>, after: Real) -> AxesSensed<N> {
        let Self {
            settings,
            sampling,
            axes,
            last,
            ..
        } = self;
        let mut sensed = AxesSensed {
            q: *q,
            dq: SVector::from_fn(|i, _| sampling.dq(last.q[i], last.dq[i], q[i], after)),
            e: SVector::zeros(),
            v_n: last.v_n,
        };
        for i in 0..N {
            let q_n = if after == 1.0 {
                last.q_n[i]
            } else {
                let way = timing::more(after) * settings.T * last.v_n[i];
                Bounds::kept(axes[i].bounds.as_ref(), last.q_n[i], way)
            };
            sensed.e[i] = q_n - q[i];
            if let Some(gains) = axes[i].changed_from() {
                let (e, v_n) = (sensed.e[i], sensed.v_n[i]);
                (sensed.e[i], sensed.v_n[i]) =
                    retune::taken_over(settings.law, gains, axes[i].gains(), e, v_n);
            }
        }
        sensed
    }

    /// Velocities that the nominals may have that are `sensed`.
    #[cold]
    #[inline(never)]
    pub(super) fn intervals(&self, sensed: AxesSensed<N>, request: Request<N>) -> [Interval; N] {
        core::array::from_fn(|i| {
            let bounds = self.axes[i].bounds.as_ref();
            Interval::within(
                bounds,
                sensed.q[i] + sensed.e[i],
                self.settings.T,
                request.hold,
            )
            .no_faster_than(request.speed[i])
        })
    }

    /// How the nominals move that feel the forces `f` (N), which the robot gets.
    #[cold]
    #[inline(never)]
    pub(super) fn driven_by(
        &self,
        proposal: AxesProposal<N>,
        f: SVector<Real, N>,
    ) -> AxesDriven<N> {
        let mut driven = proposal.wish;
        for i in 0..N {
            if f[i] != proposal.f_demand[i] {
                let (rule, y_s) = (&self.axes[i].rule, self.axes[i].y(f[i]));
                let free = rule.driven(&proposal.sample(i), y_s);
                driven.v_m[i] = proposal.interval[i].keep(free);
                driven.held[i] = driven.v_m[i] != free;
            }
        }
        driven
    }

    /// Where the nominals are set back to while they feel the forces `f` (N), which are not all what was asked for.
    #[cold]
    #[inline(never)]
    pub(super) fn at_the_bounds(
        &self,
        proposal: AxesProposal<N>,
        f: SVector<Real, N>,
    ) -> [Option<Real>; N] {
        core::array::from_fn(|i| {
            let axis = &self.axes[i];
            let limited = f[i] != proposal.f_demand[i];
            limited.then(|| axis.rule.at_the_bound(&proposal.sample(i), axis.y(f[i])))
        })
    }
}
