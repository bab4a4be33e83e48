//! Where positions are counted from in single precision.
//!
//! The law lives on small differences of positions: q_k − q_{k−1} for the velocity, q_n − q for the spring. A float has 24
//! bits, so a position far from zero leaves few of them for a difference. In single precision the library therefore counts
//! positions from where the law engaged. The difference q − q_0 is formed in double precision, once per position and tick,
//! and then rounded; all else is single precision. In double precision q_0 stays 0.

use crate::Real;
use nalgebra::SVector;

/// The place q_0 from which positions are counted; `None`: from zero, which changes no bit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Origin<const N: usize> {
    q_0: Option<SVector<f64, N>>,
    engaged: bool,
}

/// A move of the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move<const N: usize> {
    /// To where.
    pub q_0: SVector<Real, N>,
    /// By how much.
    pub by: SVector<Real, N>,
}

impl<const N: usize> Default for Origin<N> {
    /// Zero, before any tick.
    fn default() -> Self {
        Self {
            q_0: None,
            engaged: false,
        }
    }
}

impl<const N: usize> Origin<N> {
    /// The place, unless it is zero.
    pub fn place(&self) -> Option<&SVector<f64, N>> {
        self.q_0.as_ref()
    }

    /// Whether it moves at a tick with the positions `q` at which the law may engage: if it is out of the loop.
    pub fn would_move(&self, q: &SVector<f64, N>, engage: bool) -> bool {
        let is_known = q.iter().all(|q| q.is_finite());
        cfg!(feature = "f32") && engage && !self.engaged && is_known
    }

    /// Moves to the positions `q` of such a tick.
    pub fn moves(&mut self, q: &SVector<f64, N>, engage: bool) -> Option<Move<N>> {
        if !self.would_move(q, engage) {
            return None;
        }
        let before = self.q_0.replace(*q).unwrap_or_else(SVector::zeros);
        Some(Move {
            q_0: q.map(|q| q as Real),
            by: (q - before).map(|q| q as Real),
        })
    }

    /// Whether the law was in the loop at the last tick.
    pub const fn is_engaged(&self) -> bool {
        self.engaged
    }

    /// What has become of the tick.
    pub fn ticked(&mut self, engaged: bool) {
        self.engaged = engaged;
    }

    /// q − q_0.
    pub fn counted(&self, q: &SVector<f64, N>) -> SVector<Real, N> {
        match &self.q_0 {
            Some(q_0) if cfg!(feature = "f32") => q - q_0,
            _ => *q,
        }
        .map(|q| q as Real)
    }
}
