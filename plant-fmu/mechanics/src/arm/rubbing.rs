//! Friction of table and wall on the pad, together: each a disc in its own plane.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::disc::Slip;
use super::problem::{FACINGS, Problem};
use super::quotient::quotient_if;
use crate::FLOOR;

/// A tangential force is not needed where other forces hold its axis already: where its pivot has shrunk to this part
/// of the largest diagonal element. Rounding leaves 1e-15; real geometry stays far above.
const REDUNDANT: f64 = 1e-11;
/// In a corner the surfaces answer each other until no friction changes by more than this part of the largest.
const CHANGE: f64 = 1e-15;
/// … or this often.
const SWEEPS: u32 = 300;
/// Turns from which Newton's iteration in a corner starts.
const TURNS: u32 = 3;
/// Rounds that it has.
const NEWTON: u32 = 12;
/// It ends with a step of this part of the velocity: the next would be its square.
const CLOSE: f64 = 1e-9;

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
            [false, false] => [Vector3::zeros(); 2],
            [true, true] => {
                // Taken apart, so that what one surface answers need not lie in memory where this comes back.
                let [table, wall] = in_the_corner(self.problem, self.S, *w);
                [
                    Vector3::new(table.x, table.y, table.z),
                    Vector3::new(wall.x, wall.y, wall.z),
                ]
            }
            [table, _] => {
                let slip = if table {
                    self.slip(0, w)
                } else {
                    self.slip(1, w)
                };
                let t = slip.friction();
                if table {
                    [Vector3::new(t.x, t.y, 0.0), Vector3::zeros()]
                } else {
                    [Vector3::zeros(), Vector3::new(0.0, t.x, t.y)]
                }
            }
        }
    }

    /// Friction of surface `k` alone.
    fn of(&self, k: usize, w: &Vector3<f64>) -> Vector3<f64> {
        let [i, j] = PLANES[k];
        let t = self.slip(k, w).friction();
        let mut friction = Vector3::zeros();
        (friction[i], friction[j]) = (t.x, t.y);
        friction
    }

    /// The pad on surface `k`.
    #[inline(always)]
    fn slip(&self, k: usize, w: &Vector3<f64>) -> Slip {
        let ([i, j], facing) = (PLANES[k], FACINGS[k]);
        let (contact, normal) = (&self.problem.contacts[k], facing.axis());
        let stiff = contact.kappa_dt * facing.sign();
        Slip {
            S: Matrix2::new(
                self.S[(i, i)],
                self.S[(i, j)],
                self.S[(i, j)],
                self.S[(j, j)],
            ),
            w: Vector2::new(w[i], w[j]),
            n: contact.pressure(facing, w),
            c: Vector2::new(self.S[(normal, i)], self.S[(normal, j)]) * stiff,
            mu: contact.mu,
        }
    }

    /// Both: they hold the pad together, or one of them holds it in its plane, or it slides on both.
    fn of_both(&self, w: &Vector3<f64>) -> [Vector3<f64>; 2] {
        if let Some(held) = self.held(&hold(self.S, -w, [true; 3])) {
            return held;
        }
        self.one_holds(0, w)
            .or_else(|| self.one_holds(1, w))
            .or_else(|| self.both_slide(w))
            .unwrap_or_else(|| self.answered(w))
    }

    /// Surface `k` holds the pad in its plane; on the other one it slides along the axis that is left, which is the normal of
    /// `k`. `None` where the friction of `k` does not suffice for it.
    fn one_holds(&self, k: usize, w: &Vector3<f64>) -> Option<[Vector3<f64>; 2]> {
        let ([i, j], other) = (PLANES[k], 1 - k);
        let mut axes = [false; 3];
        (axes[i], axes[j]) = (true, true);
        let free = FACINGS[k].axis();
        let still = hold(self.S, -w, axes);
        let slips = (w + self.S * still)[free];
        let contact = &self.problem.contacts[other];
        let mut t = [Vector3::zeros(); 2];
        // The other surface's normal is held: it pushes as if the pad did not move.
        t[other][free] = -(contact.mu * contact.push.max(0.0)).copysign(slips);
        t[k] = hold(self.S, -(w + self.S * t[other]), axes);
        let moves = w + self.S * (t[0] + t[1]);
        let own = &self.problem.contacts[k];
        let most = own.mu * own.pressure(FACINGS[k], &moves);
        (moves[free] * slips > 0.0 && most > 0.0 && t[k].norm_squared() <= most * most).then_some(t)
    }

    /// Newton's iteration for a pad that slides on both, from what they answer by turns.
    ///
    /// ```text
    /// v = w + S Σ t(v),   t = −μ n(v) d,   d = v/|v| in the plane
    /// ```
    fn both_slide(&self, w: &Vector3<f64>) -> Option<[Vector3<f64>; 2]> {
        let (start, _) = self.turns(w, TURNS);
        let mut v = w + self.S * (start[0] + start[1]);
        for _ in 0..NEWTON {
            let t = [self.sliding(0, &v)?, self.sliding(1, &v)?];
            let off = v - w - self.S * (t[0] + t[1]);
            let yields = self.yields(&v, &t).1;
            let delta = (Matrix3::identity() + self.S * yields).try_inverse()? * -off;
            v += delta;
            if delta.amax() <= CLOSE * v.amax() {
                return Some([self.sliding(0, &v)?, self.sliding(1, &v)?]);
            }
        }
        None
    }

    /// Friction of surface `k` on a pad that slides on it at `v`; `None` if it does not.
    fn sliding(&self, k: usize, v: &Vector3<f64>) -> Option<Vector3<f64>> {
        let ([i, j], contact) = (PLANES[k], &self.problem.contacts[k]);
        let most = contact.mu * contact.pressure(FACINGS[k], v);
        let speed = libm::hypot(v[i], v[j]);
        if most < 0.0 || speed <= FLOOR {
            return None;
        }
        let mut t = Vector3::zeros();
        (t[i], t[j]) = (-most * (v[i] / speed), -most * (v[j] / speed));
        Some(t)
    }

    /// Friction of both by turns: slow, and where the rest fails.
    fn answered(&self, w: &Vector3<f64>) -> [Vector3<f64>; 2] {
        self.turns(w, SWEEPS).0
    }

    /// Friction after at most `most` turns, and how many it took.
    fn turns(&self, w: &Vector3<f64>, most: u32) -> ([Vector3<f64>; 2], u32) {
        let mut t = [Vector3::zeros(); 2];
        let mut turns = 0;
        while turns < most {
            turns += 1;
            let before = t;
            for k in [0, 1] {
                t[k] = self.of(k, &(w + self.S * t[1 - k]));
            }
            let change = (t[0] - before[0]).amax().max((t[1] - before[1]).amax());
            if change <= CHANGE * t[0].amax().max(t[1].amax()) {
                break;
            }
        }
        (t, turns)
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
        let (held, yields) = self.yields(w, friction);
        let S = without(self.S, held);
        let regular = Matrix3::identity() + S * yields;
        regular.try_inverse().unwrap_or_else(Matrix3::zeros) * S
    }

    /// Which axes are held, and by how much friction yields to a velocity of the others: −∂t/∂w.
    fn yields(&self, w: &Vector3<f64>, friction: &[Vector3<f64>; 2]) -> ([bool; 3], Matrix3<f64>) {
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
        (held, yields)
    }
}

/// [`Rubbing::of_both`] for a pad in the corner, by value: so that nothing of a pad elsewhere has to lie in memory.
#[cold]
#[inline(never)]
fn in_the_corner(problem: &Problem, S: Matrix3<f64>, w: Vector3<f64>) -> [Vector3<f64>; 2] {
    let pushes = [true; 2];
    Rubbing { problem, pushes, S }.of_both(&w)
}

/// Mobility that is left when the `axes` are held: S − S_h S_hh⁻¹ S_hᵀ.
fn without(S: Matrix3<f64>, axes: [bool; 3]) -> Matrix3<f64> {
    let columns = [0, 1, 2].map(|column| {
        let s = S.column(column).into_owned();
        s + S * hold(S, -s, axes)
    });
    let mut left = Matrix3::from_columns(&columns);
    for (axis, held) in axes.into_iter().enumerate() {
        if held {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arm::problem::{Contact, Joint};

    /// Numbers from −1 to 1, the same in every run.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 1_u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state) / f64::from(u32::MAX) * 2.0 - 1.0
        }
    }

    #[test]
    fn in_a_corner_the_closed_forms_and_newton_leave_nothing_to_answering_by_turns() {
        let mut number = numbers();
        let mut by_turns = 0;
        for _ in 0..20_000 {
            let mut matrix = || Matrix3::from_fn(|_, _| number());
            let root = matrix();
            let w = matrix().column(0) * 0.05;
            let contact = |push| Contact {
                push,
                kappa_dt: 0.03,
                mu: 0.4,
            };
            let problem = Problem {
                A: Matrix3::identity(),
                b: Vector3::zeros(),
                joints: [Joint {
                    against: [0.0; 2],
                    low: -1.0,
                    high: 1.0,
                }; 3],
                J: Matrix3::identity(),
                contacts: [contact(0.05), contact(0.05 + 0.04 * number())],
            };
            let rubbing = Rubbing {
                problem: &problem,
                pushes: [true; 2],
                S: root * root.transpose() * 0.3 + Matrix3::identity() * 0.01,
            };
            let found = rubbing
                .held(&hold(rubbing.S, -w, [true; 3]))
                .or_else(|| rubbing.one_holds(0, &w))
                .or_else(|| rubbing.one_holds(1, &w))
                .or_else(|| rubbing.both_slide(&w));
            let (slow, turns) = rubbing.turns(&w, 100_000);
            let Some(found) = found else {
                by_turns += 1;
                continue;
            };
            // By turns it errs by its last change over what the turns converge with.
            if turns < 1_000 {
                let v = [found, slow].map(|t| w + rubbing.S * (t[0] + t[1]));
                assert!(
                    (v[0] - v[1]).amax() < 1e-10,
                    "{turns} {w} {} {}",
                    v[0],
                    v[1]
                );
            }
        }
        assert!(by_turns < 200, "{by_turns}");
    }
}
