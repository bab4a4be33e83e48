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

    /// After a tick with the handle at `p` (m) under the human's force `f_h` (N), both in the base frame.
    #[must_use]
    pub fn sensed(self, p: &Vector3<Real>, f_h: &Vector3<Real>) -> Self {
        let Self { watch, axes } = self;
        let [x, y, z] = axes;
        Self {
            watch,
            axes: [
                x.sensed(p.x, f_h.x, &watch),
                y.sensed(p.y, f_h.y, &watch),
                z.sensed(p.z, f_h.z, &watch),
            ],
        }
    }

    /// With nothing seen: the law is out of the loop.
    #[must_use]
    pub fn at_rest(self) -> Self {
        Self {
            axes: [Detector::default(); 3],
            ..self
        }
    }

    /// Whether a stiff hand has been seen on any axis and has not been quiet since.
    pub fn detected(&self) -> bool {
        self.axes.iter().any(Detector::detected)
    }

    /// Damping to be added to D_n, N·s/m.
    pub fn D(&self) -> Vector3<Real> {
        self.axes.map(|axis| axis.D()).into()
    }

    /// Stiffness of the hand in the last half swing that counted, N/m; 0 before the first one.
    pub fn k_h(&self) -> Vector3<Real> {
        self.axes.map(|axis| axis.k_h()).into()
    }
}
