//! The stiff-hand detector on the three axes at the handle.

use admittance::hand::{Detector, StiffHand, Watch};
use admittance::{ParameterError, Real};
use nalgebra::Vector3;

/// One detector an axis of the base frame, between two ticks: [`admittance::hand`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Detectors {
    watch: Watch,
    axes: [Detector; 3],
}

/// What the detectors have made of the samples so far.
pub(crate) type Seen = [Detector; 3];

/// What is known of a stiff hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffHandSeen {
    /// Whether a stiff hand has been seen on any axis and has not been quiet since.
    pub detected: bool,
    /// Damping to be added to D_n, N·s/m.
    pub D: Vector3<Real>,
    /// Stiffness of the hand in the last half swing that counted, N/m; 0 before the first one.
    pub k_h: Vector3<Real>,
}

impl Detectors {
    /// Detectors that have seen nothing yet, with sample period `T` (s).
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn new(hand: StiffHand, T: Real) -> Result<Self, ParameterError> {
        Ok(Self {
            watch: Watch::new(hand, T)?,
            axes: [Detector::default(); 3],
        })
    }

    /// What is seen at a tick with the handle at `p` (m) under the human's force `f_h` (N), both in the base frame; nothing
    /// where nobody watches.
    #[inline]
    pub(crate) fn sensed(&self, p: &Vector3<Real>, f_h: &Vector3<Real>) -> Option<Seen> {
        let [x, y, z] = &self.axes;
        let watch = &self.watch;
        (watch.hand().active != 0).then(|| {
            [
                x.sensed(p.x, f_h.x, watch),
                y.sensed(p.y, f_h.y, watch),
                z.sensed(p.z, f_h.z, watch),
            ]
        })
    }

    /// Goes on from what was seen at a tick.
    #[inline]
    pub(crate) fn keep(&mut self, seen: Option<&Seen>) {
        if let Some(seen) = seen {
            self.axes = *seen;
        }
    }

    /// With nothing seen: the law is out of the loop.
    pub(crate) fn rest(&mut self) {
        if self.watch.hand().active != 0 {
            self.axes = [Detector::default(); 3];
        }
    }

    /// What is known.
    #[inline]
    pub fn known(&self) -> StiffHandSeen {
        if self.watch.hand().active != 0 {
            StiffHandSeen {
                detected: self.axes.iter().any(Detector::detected),
                D: damping(&self.axes),
                k_h: self.axes.map(|axis| axis.k_h()).into(),
            }
        } else {
            StiffHandSeen::default()
        }
    }
}

/// Damping to be added to D_n after so much has been seen, N·s/m.
#[inline]
pub(crate) fn damping(seen: &Seen) -> Vector3<Real> {
    seen.each_ref().map(Detector::D).into()
}

impl Default for StiffHandSeen {
    /// Nothing.
    fn default() -> Self {
        Self {
            detected: false,
            D: Vector3::zeros(),
            k_h: Vector3::zeros(),
        }
    }
}
