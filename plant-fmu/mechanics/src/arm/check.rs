//! Whether an arm can exist, and be where it starts.

use nalgebra::Vector3;

use super::kinematics::{Lengths, Pose};
use super::parameters::{Parameters, Start, Stops};
use super::ranges as range;
use super::rigid_body::Link;
use super::stribeck::Stribeck;
use super::surface::{Facing, Surface};
use crate::{ParameterError, Range};

impl Parameters {
    /// Checks every value, and that the arm can be where it starts.
    ///
    /// # Errors
    /// Names the first variable that is out of its range, its value and the range.
    pub fn check(&self, start: &Start) -> Result<(), ParameterError> {
        let Lengths {
            A_1,
            L_1,
            handle,
            pad,
        } = self.lengths;
        range::A_1.check(A_1)?;
        range::L_1.check(L_1)?;
        range::HANDLE_X.check(handle.x)?;
        range::HANDLE_Z.check(handle.z)?;
        range::PAD_X.check(pad.x)?;
        range::PAD_Z.check(pad.z)?;
        for i in 0..3 {
            self.masses.links[i].check(i)?;
            range::ROTOR[i].check(self.masses.rotor[i])?;
            range::GEAR[i].check(self.masses.gear[i])?;
            range::GRAVITY[i].check(self.masses.gravity[i])?;
            let Stribeck { F_c, F_s, v_s, b } = self.friction[i];
            range::F_C[i].check(F_c)?;
            range::F_S[i].at_least(F_c).check(F_s)?;
            range::V_S[i].check(v_s)?;
            range::B[i].check(b)?;
            let Stops { min, max } = self.stops[i];
            range::STOP_MIN[i].check(min)?;
            range::STOP_MAX[i].at_least(min).check(max)?;
            range::Q_START[i]
                .at_least(min)
                .at_most(max)
                .check(start.q[i])?;
            range::DQ_START[i].check(start.dq[i])?;
        }
        range::DRIVE_CUTOFF.check(self.drive_cutoff)?;
        range::PAYLOAD_M.check(self.payload_m)?;
        range::F_MAX.check(self.vacuum.F_max)?;
        range::F_ATTACH.check(self.vacuum.F_attach)?;

        let pad = Pose::at(&Vector3::from(start.q))
            .point(&self.lengths, pad)
            .p;
        range::TABLE.check(&self.table, |z| z.at_most(pad[Facing::Up.axis()]))?;
        range::WALL.check(&self.wall, |x| x.at_least(pad[Facing::Back.axis()]))
    }
}

impl Link {
    /// Positive mass; an inertia that some body can have: no moment exceeds the sum of the others, I_xz² ≤ I_xx I_zz.
    fn check(&self, i: usize) -> Result<(), ParameterError> {
        let Self {
            m,
            x,
            z,
            I_xx,
            I_yy,
            I_zz,
            I_xz,
        } = *self;
        range::LINK_M[i].check(m)?;
        range::LINK_X[i].check(x)?;
        range::LINK_Z[i].check(z)?;
        range::LINK_I_XX[i].check(I_xx)?;
        range::LINK_I_ZZ[i].check(I_zz)?;
        range::LINK_I_YY[i]
            .at_least((I_xx - I_zz).abs())
            .at_most(I_xx + I_zz)
            .check(I_yy)?;
        let most = libm::sqrt(I_xx * I_zz);
        range::LINK_I_XZ[i]
            .at_least(-most)
            .at_most(most)
            .check(I_xz)
    }
}

impl range::SurfaceRanges {
    /// `outside` narrows the position to where the pad does not start inside the surface.
    fn check(
        &self,
        surface: &Surface,
        outside: impl FnOnce(Range) -> Range,
    ) -> Result<(), ParameterError> {
        outside(self.position).check(surface.position)?;
        self.k.check(surface.k)?;
        self.c.check(surface.c)?;
        self.mu.check(surface.mu)
    }
}
