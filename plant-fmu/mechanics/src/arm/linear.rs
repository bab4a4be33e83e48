//! The linear equation that a guess leaves.

use nalgebra::{Matrix3, Vector3};

use super::guess::{Guess, Motion};
use super::problem::{FACINGS, Path, Problem, Solution};
use super::quotient::quotient_if;

/// A tangential force is not needed where other forces hold its axis already: where its pivot has shrunk to this part
/// of the largest diagonal element. Rounding leaves 1e-15; real geometry stays far above.
const REDUNDANT: f64 = 1e-11;

/// The linear equation that a guess leaves of a problem: K v = r in the joints that slide. All of it but `b` of the problem,
/// so that it is put together and inverted once for several b. Inlined, as most substeps solve for one b only: else its
/// matrices go through memory (700 of 22,000 instructions a millisecond).
pub(crate) struct Linear<'a> {
    guess: &'a Guess,
    problem: &'a Problem,
    K: Matrix3<f64>,
    /// Impulses of the surfaces on the joints if the pad did not move (N·m·s); where they push.
    pushes: [Vector3<f64>; 2],
    /// Joints that are held, or arrive at a stop.
    held: [bool; 3],
    /// Velocities of the joints that are held (rad/s).
    at: Vector3<f64>,
    /// Friction of the joints that slide (N·m·s).
    slide: Vector3<f64>,
    /// Inverse of K without the joints that are held.
    inverse: Matrix3<f64>,
    /// Axes of the pad that are held.
    axes: [bool; 3],
    /// Jacobian of the pad in the joints that slide.
    J_free: Matrix3<f64>,
}

impl<'a> Linear<'a> {
    #[inline(always)]
    pub(crate) fn of(guess: &'a Guess, problem: &'a Problem) -> Self {
        let Problem { A, joints, J, .. } = problem;
        let mut K = *A;

        // n = push − κ dt d·v acts along u: the normal, and the friction of the axes that slide with it.
        let mut pushes = [Vector3::zeros(); 2];
        for (k, facing) in FACINGS.iter().enumerate() {
            if guess.pushes[k] {
                let contact = &problem.contacts[k];
                let mut u = Vector3::zeros();
                for axis in 0..3 {
                    u[axis] = -guess.pad[axis].sense() * contact.mu;
                }
                u[facing.axis()] = facing.sign();
                let u = J.tr_mul(&u);
                let d = J.row(facing.axis()) * (facing.sign() * contact.kappa_dt);
                K += u * d;
                pushes[k] = u * contact.push;
            }
        }

        let mut held = [true; 3];
        let mut at = Vector3::zeros();
        let mut slide = Vector3::zeros();
        for i in 0..3 {
            match guess.joint[i] {
                Motion::Held => {}
                Motion::High => at[i] = joints[i].high,
                Motion::Low => at[i] = joints[i].low,
                Motion::Forward | Motion::Backward => {
                    held[i] = false;
                    slide[i] = -guess.joint[i].sense() * joints[i].limit;
                }
            }
        }
        let (mut K_free, mut J_free) = (K, *J);
        for i in 0..3 {
            if held[i] {
                for other in 0..3 {
                    K_free[(other, i)] = 0.0;
                    K_free[(i, other)] = 0.0;
                    J_free[(other, i)] = 0.0;
                }
                K_free[(i, i)] = 1.0;
            }
        }
        Self {
            guess,
            problem,
            K,
            pushes,
            held,
            at,
            slide,
            // Singular only for parameters at which Coulomb friction itself has no solution: then the check fails.
            inverse: K_free.try_inverse().unwrap_or_else(Matrix3::zeros),
            axes: [0, 1, 2].map(|axis| guess.pad[axis] == Motion::Held && guess.rubs(axis)),
            J_free,
        }
    }

    /// The solution for `b` (N·m·s).
    #[inline(always)]
    pub(crate) fn solve(&self, b: &Vector3<f64>) -> Solution {
        let Self {
            guess,
            problem,
            K,
            held,
            slide,
            ..
        } = self;
        let r = self.r(b);
        let (v, held_by) = self.velocity(&r);

        let mut normal = [0.0; 2];
        let mut tangent = held_by;
        let mut back = Vector3::zeros();
        if guess.touches() {
            if self.axes.contains(&true) {
                back = problem.J.tr_mul(&held_by);
            }
            let w = problem.J * v;
            for (k, facing) in FACINGS.iter().enumerate() {
                if guess.pushes[k] {
                    normal[k] = problem.contacts[k].pressure(*facing, &w);
                }
            }
            let grip = problem.grip(&normal);
            for axis in 0..3 {
                tangent[axis] -= guess.pad[axis].sense() * grip[axis];
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

    /// Velocity of the pad (m/s) for `b` (N·m·s).
    pub(crate) fn w(&self, b: &Vector3<f64>) -> Vector3<f64> {
        self.problem.J * self.velocity(&self.r(b)).0
    }

    /// `b` with the impulses of the surfaces (N·m·s).
    #[inline(always)]
    fn r(&self, b: &Vector3<f64>) -> Vector3<f64> {
        let mut r = *b;
        for (pushes, impulse) in self.guess.pushes.iter().zip(&self.pushes) {
            if *pushes {
                r += impulse;
            }
        }
        r
    }

    /// Velocity of the joints (rad/s), and the impulse of the axes that are held on the pad (N·s).
    #[inline(always)]
    fn velocity(&self, r: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let mut r_free = r + self.slide - self.K * self.at;
        for i in 0..3 {
            if self.held[i] {
                r_free[i] = self.at[i];
            }
        }
        let mut v = self.inverse * r_free;
        let mut tangent = Vector3::zeros();
        if self.axes.contains(&true) {
            let spread = self.inverse * self.J_free.transpose();
            tangent = hold(self.J_free * spread, -(self.problem.J * v), self.axes);
            v += spread * tangent;
        }
        (v, tangent)
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
        t[axis] = quotient_if(used[axis], y[axis], S[(axis, axis)]);
    }
    t
}
