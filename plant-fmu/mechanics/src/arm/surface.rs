//! The table under the arm and the wall in front of it.

use crate::wall::Wall;

/// A compliant plane with dry friction. Along the normal it is a [`Wall`]: pushes only, has a deflection of its own.
/// Along each tangential axis of the base frame friction opposes the pad's velocity w_t, rigidly:
///
/// ```text
/// −f_t ∈ μ λ Sgn(w_t)
/// ```
///
/// (a box; the combined force of both axes reaches √2 μ λ on a diagonal).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Surface {
    /// Position of the plane (m): z of the table, x of the wall.
    pub position: f64,
    /// Stiffness k (N/m).
    pub k: f64,
    /// Damping c (N·s/m).
    pub c: f64,
    /// Coefficient of friction μ per tangential axis.
    pub mu: f64,
}

/// Which way a surface pushes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// The table: pushes along +z.
    Up,
    /// The wall: pushes along −x.
    Back,
}

impl Facing {
    /// Axis of the normal in the base frame, 0 to 2.
    pub const fn axis(self) -> usize {
        match self {
            Self::Up => 2,
            Self::Back => 0,
        }
    }

    /// Direction of the push along that axis.
    pub const fn sign(self) -> f64 {
        match self {
            Self::Up => 1.0,
            Self::Back => -1.0,
        }
    }
}

impl Surface {
    /// How far a point with the coordinate `x` along the normal's axis (m) is behind the plane (m); negative outside.
    pub fn penetration(&self, facing: Facing, x: f64) -> f64 {
        facing.sign() * (self.position - x)
    }

    /// The normal's law.
    pub(crate) fn wall(&self) -> Wall {
        Wall {
            q: 0.0,
            k: self.k,
            c: self.c,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn below_the_table_and_beyond_the_wall_is_inside() {
        let surface = Surface {
            position: 0.25,
            k: 1e5,
            c: 300.0,
            mu: 0.4,
        };
        assert_eq!(surface.penetration(Facing::Up, 0.0), 0.25);
        assert_eq!(surface.penetration(Facing::Up, 0.5), -0.25);
        assert_eq!(surface.penetration(Facing::Back, 0.5), 0.25);
        assert_eq!(surface.penetration(Facing::Back, 0.0), -0.25);
    }
}
