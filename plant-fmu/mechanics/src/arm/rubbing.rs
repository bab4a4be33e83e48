//! Friction of table and wall on the pad, together: each a disc in its own plane.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::disc::Slip;
use super::problem::{FACINGS, Problem};
use super::quotient::quotient_if;

/// A tangential force is not needed where other forces hold its axis already: where its pivot has shrunk to this part
/// of the largest diagonal element. Rounding leaves 1e-15; real geometry stays far above.
const REDUNDANT: f64 = 1e-11;
/// In a corner the surfaces answer each other until no friction changes by more than this part of the largest.
const CHANGE: f64 = 1e-16;
/// … or this often.
const SWEEPS: u32 = 2_000;

/// The axes of each surface's plane.
const PLANES: [[usize; 2]; 2] = [FACINGS[0].plane(), FACINGS[1].plane()];

/// A pad that touches, with the joints' answer to forces on it.
pub(crate) struct Rubbing<'a> {
    pub(crate) problem: &'a Problem,
    /// Which surfaces push: table, wall.
    pub(crate) pushes: [bool; 2],
    /// Mobility of the pad (1/kg), the springs of the surfaces included.
    pub(crate) S: Matrix3<f64>,
}

impl Rubbing<'_> {
    /// Friction of each surface on the pad (N·s), which would move at `w` (m/s) without it; base frame.
    #[inline(always)]
    pub(crate) fn friction(&self, w: &Vector3<f64>) -> [Vector3<f64>; 2] {
        match self.pushes {
            [true, true] => self.in_the_corner(w),
            [table, wall] => [(0, table), (1, wall)].map(|(k, pushes)| {
                if pushes {
                    self.of(k, w)
                } else {
                    Vector3::zeros()
                }
            }),
        }
    }

    /// Friction of surface `k` alone.
    #[inline(always)]
    fn of(&self, k: usize, w: &Vector3<f64>) -> Vector3<f64> {
        let ([i, j], facing) = (PLANES[k], FACINGS[k]);
        let (contact, normal) = (&self.problem.contacts[k], facing.axis());
        let stiff = contact.kappa_dt * facing.sign();
        let t = Slip {
            S: Matrix2::new(self.S[(i, i)], self.S[(i, j)], self.S[(i, j)], self.S[(j, j)]),
            w: Vector2::new(w[i], w[j]),
            n: contact.pressure(facing, w),
            c: Vector2::new(self.S[(normal, i)], self.S[(normal, j)]) * stiff,
            mu: contact.mu,
        }
        .friction();
        let mut friction = Vector3::zeros();
        (friction[i], friction[j]) = (t.x, t.y);
        friction
    }

    /// Both: held together, or one after the other answers what the other leaves.
    #[inline(never)]
    fn in_the_corner(&self, w: &Vector3<f64>) -> [Vector3<f64>; 2] {
        if let Some(held) = self.held(&hold(self.S, -w, [true; 3])) {
            return held;
        }
        let mut t = [Vector3::zeros(); 2];
        for _ in 0..SWEEPS {
            let before = t;
            for k in [0, 1] {
                t[k] = self.of(k, &(w + self.S * t[1 - k]));
            }
            let change = (t[0] - before[0]).amax().max((t[1] - before[1]).amax());
            if change <= CHANGE * t[0].amax().max(t[1].amax()) {
                break;
            }
        }
        t
    }

    /// `t` shared between the surfaces, if they can hold a pad at rest with it.
    fn held(&self, t: &Vector3<f64>) -> Option<[Vector3<f64>; 2]> {
        let grip = [0, 1].map(|k| {
            let contact = &self.problem.contacts[k];
            contact.mu * contact.push.max(0.0) // what presses a pad at rest
        });
        // What each has left along y, the axis of both planes.
        let left = [(grip[0], t.x), (grip[1], t.z)].map(|(grip, t)| grip * grip - t * t);
        if left[0] < 0.0 || left[1] < 0.0 {
            return None;
        }
        let left = left.map(libm::sqrt);
        let both = left[0] + left[1];
        if t.y.abs() > both {
            return None;
        }
        let share = quotient_if(both > 0.0, t.y, both);
        Some([
            Vector3::new(t.x, share * left[0], 0.0),
            Vector3::new(0.0, share * left[1], t.z),
        ])
    }

    /// Mobility of the pad (1/kg) with friction's own answer: ∂w/∂Λ for an impulse Λ on it, at the velocity `w` (m/s) that
    /// it has with the `friction` of the surfaces.
    ///
    /// ```text
    /// dw = S (dΛ + dt),   −dt = μ n (1 − d dᵀ) dw/|w_t| + μ d dn where it slides along d, dw = 0 where it is held
    /// ```
    pub(crate) fn mobility(&self, w: &Vector3<f64>, friction: &[Vector3<f64>; 2]) -> Matrix3<f64> {
        let mut held = [false; 3];
        let mut yields = Matrix3::zeros();
        for k in 0..FACINGS.len() {
            let ([i, j], facing, contact) = (PLANES[k], FACINGS[k], &self.problem.contacts[k]);
            let most = contact.mu * contact.pressure(facing, w);
            if !self.pushes[k] || most <= 0.0 {
                continue;
            }
            let t = Vector2::new(friction[k][i], friction[k][j]);
            let speed = Vector2::new(w[i], w[j]).norm();
            let slides = t.norm() >= (1.0 - 1e-12) * most && speed > 0.0;
            if !slides {
                (held[i], held[j]) = (true, true);
                continue;
            }
            let d = t / -most;
            let normal = facing.axis();
            for (row, d_row) in [(i, d.x), (j, d.y)] {
                for (column, d_column) in [(i, d.x), (j, d.y)] {
                    let own = if row == column { 1.0 } else { 0.0 };
                    yields[(row, column)] += most / speed * (own - d_row * d_column);
                }
                yields[(row, normal)] -= contact.mu * d_row * contact.kappa_dt * facing.sign();
            }
        }
        let S = without(self.S, held);
        let regular = Matrix3::identity() + S * yields;
        regular.try_inverse().unwrap_or_else(Matrix3::zeros) * S
    }
}

/// Mobility that is left when the `axes` are held: S − S_h S_hh⁻¹ S_hᵀ.
fn without(S: Matrix3<f64>, axes: [bool; 3]) -> Matrix3<f64> {
    let columns = [0, 1, 2].map(|column| {
        let s = S.column(column).into_owned();
        s + S * hold(S, -s, axes)
    });
    let mut left = Matrix3::from_columns(&columns);
    for axis in 0..3 {
        if axes[axis] {
            left.row_mut(axis).fill(0.0);
            left.column_mut(axis).fill(0.0);
        }
    }
    left
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
        t[axis] = quotient_if(used[axis], y[axis], S[(axis, axis)]);
    }
    t
}
