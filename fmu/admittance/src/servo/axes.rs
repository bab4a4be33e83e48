//! The servo form of independent axes.

use super::{Drivable, Drive, Servo};
use crate::{Axes, Bounds, Gains, ParameterError, Reach, Settings};

impl<const N: usize> Servo<Axes<N>, N> {
    /// N axes, out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range, or a law without a servo form.
    pub fn new(
        settings: Settings,
        gains: [Gains; N],
        reach: &Reach<N>,
    ) -> Result<Self, ParameterError> {
        if !settings.law.row().servo {
            return Err(ParameterError::NoServoForm(settings.law));
        }
        Self::of(Axes::new(settings, gains)?, reach)
    }

    /// Within other bounds from the next tick on.
    ///
    /// # Errors
    /// The first bound out of its range; the bounds stay as they were.
    pub fn bound(&mut self, bounds: [Bounds; N]) -> Result<(), ParameterError> {
        self.law.bound(bounds)
    }

    /// Another nominal mass and damping: on a straight line over the tuning time, each step taken over so that the stored
    /// energy does not rise. The other gains are the drives' as well, which this law cannot change; `names` are those of K,
    /// K_P and f_max in the message.
    ///
    /// # Errors
    /// A gain out of its range, or a gain of the drives other than it was; all gains stay as they were.
    pub fn tune(
        &mut self,
        gains: [Gains; N],
        names: [&'static str; 3],
    ) -> Result<(), ParameterError> {
        for (axis, gains) in (1..).zip(&gains) {
            gains.check((N > 1).then_some(axis))?;
        }
        self.law.drive().is_kept(&Drive::of(&gains), names)?;
        self.law.tune(gains)
    }
}
