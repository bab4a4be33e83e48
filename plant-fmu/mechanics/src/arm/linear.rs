//! The linear equation that a guess leaves.

use nalgebra::{Matrix3, Vector3};

use super::guess::{Guess, Motion};
use super::problem::{FACINGS, Path, Problem, Solution};
use super::rubbing::Rubbing;

/// The linear equation that a guess leaves of a problem: K v = r in the joints that slide, and in it friction on the
/// surfaces, which is not linear. All of it but `b` of the problem, so that it is put together and inverted once for several b. Inlined, as most substeps solve for one b only: else its
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
    /// Jacobian of the pad in the joints that slide.
    J_free: Matrix3<f64>,
}

impl<'a> Linear<'a> {
    #[inline(always)]
    pub(crate) fn of(guess: &'a Guess, problem: &'a Problem) -> Self {
        let Problem { A, joints, J, .. } = problem;
        let mut K = *A;

        // n = push − κ dt d·w acts along the normal d.
        let mut pushes = [Vector3::zeros(); 2];
        for (k, facing) in FACINGS.iter().enumerate() {
            if guess.pushes[k] {
                let contact = &problem.contacts[k];
                let d = J.row(facing.axis());
                let along = d.transpose();
                K += along * (d * contact.kappa_dt);
                pushes[k] = along * (facing.sign() * contact.push);
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
                Motion::Forward => {
                    held[i] = false;
                    slide[i] = -joints[i].against[0];
                }
                Motion::Backward => {
                    held[i] = false;
                    slide[i] = joints[i].against[1];
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
        let mut v = self.frictionless(&r);
        let mut normal = [0.0; 2];
        let mut tangent = Vector3::zeros();
        if guess.touches() {
            let spread = self.spread();
            let rubbing = self.rubbing(&spread);
            let friction = rubbing.friction(&(problem.J * v));
            v += spread * (friction[0] + friction[1]);
            let w = problem.J * v;
            for (k, facing) in FACINGS.iter().enumerate() {
                if guess.pushes[k] {
                    normal[k] = problem.contacts[k].pressure(*facing, &w);
                    tangent += problem.contacts[k].within(normal[k], &friction[k]);
                }
            }
        }
        // What holds a joint: K v − r − Jᵀ t.
        let joint = Vector3::from_fn(|i, _| {
            if !held[i] {
                return slide[i];
            }
            let back = if guess.touches() {
                problem.J.column(i).dot(&tangent)
            } else {
                0.0
            };
            K.row(i).transpose().dot(&v) - r[i] - back
        });
        Solution {
            v,
            joint,
            normal,
            tangent,
            path: Path::Guessed,
        }
    }

    /// Mobility of the pad (1/kg) at the solution for `b` (N·m·s): ∂w/∂Λ for an impulse Λ on it.
    pub(crate) fn mobility(&self, b: &Vector3<f64>) -> Matrix3<f64> {
        let spread = self.spread();
        let rubbing = self.rubbing(&spread);
        if !self.guess.touches() {
            return rubbing.S;
        }
        let w = self.problem.J * self.frictionless(&self.r(b));
        let friction = rubbing.friction(&w);
        let slipping = w + rubbing.S * (friction[0] + friction[1]);
        rubbing.mobility(&slipping, &friction)
    }

    /// Velocity of the joints per impulse on the pad.
    #[inline(always)]
    fn spread(&self) -> Matrix3<f64> {
        self.inverse * self.J_free.transpose()
    }

    #[inline(always)]
    fn rubbing(&self, spread: &Matrix3<f64>) -> Rubbing<'a> {
        Rubbing {
            problem: self.problem,
            pushes: self.guess.pushes,
            S: self.J_free * spread,
        }
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

    /// Velocity of the joints (rad/s) without friction on the surfaces.
    #[inline(always)]
    fn frictionless(&self, r: &Vector3<f64>) -> Vector3<f64> {
        let mut r_free = r + self.slide - self.K * self.at;
        for i in 0..3 {
            if self.held[i] {
                r_free[i] = self.at[i];
            }
        }
        self.inverse * r_free
    }
}
