//! Whether an arm can exist, and be where it starts: every value by its row, and what its value must be beside others'.

use nalgebra::Vector3;

use super::kinematics::Pose;
use super::parameters::{Parameters, Start, Stops};
use super::rigid_body::Link;
use super::stribeck::Stribeck;
use super::surface::{Facing, Table, Wall};
use crate::parameter::{Bounds, ParameterError, in_range};

const I_YY: Bounds = Bounds::of::<Link>("link.I_yy[i]");
const I_XZ: Bounds = Bounds::of::<Link>("link.I_xz[i]");
const F_S: Bounds = Bounds::of::<Stribeck>("friction.F_s[i]");
const STOP_MAX: Bounds = Bounds::of::<Stops>("stop.max[i]");
const Q_START: Bounds = Bounds::of::<Start>("q_start[i]");
const TABLE_Z: Bounds = Bounds::of::<Table>("table.z");
const WALL_X: Bounds = Bounds::of::<Wall>("wall.x");

impl Parameters {
    /// Checks every value, and that the arm can be where it starts.
    ///
    /// # Errors
    /// Names the first variable that is out of its bounds, its value and the bounds.
    pub fn check(&self, start: &Start) -> Result<(), ParameterError> {
        in_range(self)?;
        in_range(start)?;
        for i in 0..3 {
            self.masses.links[i].check(i)?;
            let Stribeck { F_c, F_s, .. } = self.friction[i];
            F_S.element(i).at_least(F_c).check(F_s)?;
            let Stops { min, max } = self.stops[i];
            STOP_MAX.element(i).at_least(min).check(max)?;
            Q_START
                .element(i)
                .at_least(min)
                .at_most(max)
                .check(start.q[i])?;
        }
        // The pad does not start inside a surface.
        let pad = Pose::at(&Vector3::from(start.q))
            .point(&self.lengths, self.lengths.pad())
            .p;
        TABLE_Z
            .at_most(pad[Facing::Up.axis()])
            .check(self.table.z)?;
        WALL_X.at_least(pad[Facing::Back.axis()]).check(self.wall.x)
    }
}

impl Link {
    /// An inertia that some body can have: no moment exceeds the sum of the others, I_xz² ≤ I_xx I_zz.
    fn check(&self, i: usize) -> Result<(), ParameterError> {
        let Self {
            I_xx,
            I_yy,
            I_zz,
            I_xz,
            ..
        } = *self;
        I_YY.element(i)
            .at_least((I_xx - I_zz).abs())
            .at_most(I_xx + I_zz)
            .check(I_yy)?;
        let most = libm::sqrt(I_xx * I_zz);
        I_XZ.element(i).at_least(-most).at_most(most).check(I_xz)
    }
}
