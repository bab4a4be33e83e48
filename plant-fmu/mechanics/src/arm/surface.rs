//! The table under the arm and the wall in front of it.

use crate::wall;
use fmu_declaration::{Rows, Start};

/// A compliant plane with dry friction. Along the normal it is a [`Wall`](wall::Wall): pushes only, has a deflection of its
/// own. In the plane friction opposes the pad's velocity w_t, rigidly:
///
/// ```text
/// −f_t ∈ μ λ Sgn(w_t),   Sgn(w) = w/|w|, Sgn(0) = unit disc
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Position of the plane (m): z of the table, x of the wall.
    pub position: f64,
    /// Stiffness k (N/m).
    pub k: f64,
    /// Damping c (N·s/m).
    pub c: f64,
    /// Coefficient of friction μ.
    pub mu: f64,
}

/// The horizontal surface under the pad.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Table {
    /// height of the table, at most that of the pad at the start; -10: none in reach
    #[parameter(27, name = "table.z", unit = METRE, range = -1e3..=1e3, start = -10.0)]
    pub z: f64,
    /// stiffness of the table
    #[parameter(28, name = "table.k", unit = NEWTON_PER_METRE, range = 1.0..=1e7, start = 1e5)]
    pub k: f64,
    /// damping of the table
    #[parameter(29, name = "table.c", unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e5, start = 300.0)]
    pub c: f64,
    // More than 1 could jam the arm rigidly (Painlevé), where Coulomb's law has no solution.
    /// coefficient of friction on the table, the same in every direction
    #[parameter(30, name = "table.mu", range = 0.0..=1.0, start = 0.4)]
    pub mu: f64,
}

/// The vertical surface in front of the pad.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wall {
    /// distance of the wall ahead, at least that of the pad at the start; 10: none in reach
    #[parameter(31, name = "wall.x", unit = METRE, range = -1e3..=1e3, start = 10.0)]
    pub x: f64,
    /// stiffness of the wall
    #[parameter(32, name = "wall.k", unit = NEWTON_PER_METRE, range = 1.0..=1e7, start = 1e5)]
    pub k: f64,
    /// damping of the wall
    #[parameter(33, name = "wall.c", unit = NEWTON_SECOND_PER_METRE, range = 0.0..=1e5, start = 300.0)]
    pub c: f64,
    // More than 1 could jam the arm rigidly (Painlevé), where Coulomb's law has no solution.
    /// coefficient of friction on the wall, the same in every direction
    #[parameter(34, name = "wall.mu", range = 0.0..=1.0, start = 0.4)]
    pub mu: f64,
}

impl Table {
    /// As a surface.
    pub fn surface(&self) -> Surface {
        Surface {
            position: self.z,
            k: self.k,
            c: self.c,
            mu: self.mu,
        }
    }
}

impl Wall {
    /// As a surface.
    pub fn surface(&self) -> Surface {
        Surface {
            position: self.x,
            k: self.k,
            c: self.c,
            mu: self.mu,
        }
    }
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

    /// The other two axes: the plane.
    pub const fn plane(self) -> [usize; 2] {
        match self {
            Self::Up => [0, 1],
            Self::Back => [1, 2],
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

/// A contact that is too stiff for the substep; of the table or the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooStiff {
    /// The stiffness' variable: `table.k`, `wall.k`.
    pub name: &'static str,
    /// Its value (N/m).
    pub k: f64,
    /// Share of the rebound speed that the substep costs.
    pub lost: f64,
    /// Longest substep (s) that costs no more than was asked.
    pub longest: f64,
}

impl Surface {
    /// How far a point with the coordinate `x` along the normal's axis (m) is behind the plane (m); negative outside.
    pub fn penetration(&self, facing: Facing, x: f64) -> f64 {
        facing.sign() * (self.position - x)
    }

    /// The normal's law.
    pub(crate) fn wall(&self) -> wall::Wall {
        wall::Wall {
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
