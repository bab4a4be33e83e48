//! A guess of which forces hold, slide and push, and the linear equation that it leaves.

use nalgebra::{Matrix3, Vector3};

use super::problem::{FACINGS, Path, Problem, Solution};

/// What a joint does, or the pad along one axis, as far as dry friction and stops are concerned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Motion {
    /// Held at rest, by friction or by a stop that it leans on.
    #[default]
    Held,
    /// Slides in the positive direction, friction at its limit.
    Forward,
    /// Slides in the negative direction, friction at its limit.
    Backward,
    /// Joint: arrives at the upper stop.
    High,
    /// Joint: arrives at the lower stop.
    Low,
}

/// Which forces hold, slide and push. Kept from one substep to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Guess {
    /// The joints.
    pub joint: [Motion; 3],
    /// Which surfaces push: table, wall.
    pub pushes: [bool; 2],
    /// The axes of the pad, while a surface pushes.
    pub pad: [Motion; 3],
}

/// A tangential force is not needed where other forces hold its axis already: where its pivot has shrunk to this part
/// of the largest diagonal element. Rounding leaves 1e-15; real geometry stays far above.
const REDUNDANT: f64 = 1e-11;

impl Motion {
    /// Sense of sliding: 1, −1, or 0 where friction is not at its limit.
    pub fn sense(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
            Self::Held | Self::High | Self::Low => 0.0,
        }
    }
}

impl Guess {
    /// Does a surface that pushes rub along this axis of the pad?
    pub(crate) fn rubs(&self, axis: usize) -> bool {
        (self.pushes[0] && FACINGS[0].axis() != axis)
            || (self.pushes[1] && FACINGS[1].axis() != axis)
    }

    /// Takes the guess for granted and solves what remains: sliding forces are at their limits, held joints and axes
    /// have a velocity instead of an equation, surfaces that push are springs.
    pub fn solve(&self, problem: &Problem) -> Solution {
        let Problem {
            A, b, joints, J, ..
        } = problem;
        let (mut K, mut r) = (*A, *b);

        // n = push − κ dt d·v acts along u: the normal, and the friction of the axes that slide with it.
        let touching = self.pushes[0] || self.pushes[1];
        for (k, facing) in FACINGS.iter().enumerate() {
            if self.pushes[k] {
                let contact = &problem.contacts[k];
                let mut u = Vector3::zeros();
                for axis in 0..3 {
                    u[axis] = -self.pad[axis].sense() * contact.mu;
                }
                u[facing.axis()] = facing.sign();
                let u = J.tr_mul(&u);
                let d = J.row(facing.axis()) * (facing.sign() * contact.kappa_dt);
                K += u * d;
                r += u * contact.push;
            }
        }

        let mut held = [true; 3];
        let mut at = Vector3::zeros();
        let mut slide = Vector3::zeros();
        for i in 0..3 {
            match self.joint[i] {
                Motion::Held => {}
                Motion::High => at[i] = joints[i].high,
                Motion::Low => at[i] = joints[i].low,
                Motion::Forward | Motion::Backward => {
                    held[i] = false;
                    slide[i] = -self.joint[i].sense() * joints[i].limit;
                }
            }
        }
        let (mut K_free, mut r_free, mut J_free) = (K, r + slide - K * at, *J);
        for i in 0..3 {
            if held[i] {
                for other in 0..3 {
                    K_free[(other, i)] = 0.0;
                    K_free[(i, other)] = 0.0;
                    J_free[(other, i)] = 0.0;
                }
                K_free[(i, i)] = 1.0;
                r_free[i] = at[i];
            }
        }
        // Singular only for parameters at which Coulomb friction itself has no solution: then the check fails.
        let inverse = K_free.try_inverse().unwrap_or_else(Matrix3::zeros);
        let mut v = inverse * r_free;

        let mut normal = [0.0; 2];
        let mut tangent = Vector3::zeros();
        let mut back = Vector3::zeros();
        if touching {
            let axes = [0, 1, 2].map(|axis| self.pad[axis] == Motion::Held && self.rubs(axis));
            if axes.contains(&true) {
                let spread = inverse * J_free.transpose();
                tangent = hold(J_free * spread, -(J * v), axes);
                v += spread * tangent;
                back = J.tr_mul(&tangent);
            }
            let w = J * v;
            for (k, facing) in FACINGS.iter().enumerate() {
                if self.pushes[k] {
                    normal[k] = problem.contacts[k].pressure(*facing, &w);
                }
            }
            let grip = problem.grip(&normal);
            for axis in 0..3 {
                tangent[axis] -= self.pad[axis].sense() * grip[axis];
            }
        }
        let needed = K * v - r - back;
        let joint = Vector3::from_fn(|i, _| if held[i] { needed[i] } else { slide[i] });
        Solution {
            v,
            joint,
            normal,
            tangent,
            path: Path::Guessed,
        }
    }
}

/// Impulses t along the chosen `axes` with S t = y there, by elimination on the largest remaining pivot. Axes that the
/// others hold already get none.
fn hold(mut S: Matrix3<f64>, mut y: Vector3<f64>, axes: [bool; 3]) -> Vector3<f64> {
    let least = REDUNDANT * S.diagonal().amax();
    let mut t = Vector3::zeros();
    let mut used = [false; 3];
    for _ in 0..3 {
        let mut pivot = 0;
        let mut size = 0.0;
        for axis in 0..3 {
            if axes[axis] && !used[axis] && S[(axis, axis)].abs() > size {
                (pivot, size) = (axis, S[(axis, axis)].abs());
            }
        }
        if size <= least {
            break;
        }
        used[pivot] = true;
        for row in 0..3 {
            if row != pivot && axes[row] {
                let factor = S[(row, pivot)] / S[(pivot, pivot)];
                for column in 0..3 {
                    S[(row, column)] -= factor * S[(pivot, column)];
                }
                y[row] -= factor * y[pivot];
            }
        }
    }
    for axis in 0..3 {
        if used[axis] {
            t[axis] = y[axis] / S[(axis, axis)];
        }
    }
    t
}
