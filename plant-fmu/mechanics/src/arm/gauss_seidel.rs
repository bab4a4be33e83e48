//! Projected Gauss–Seidel: one force after the other is set to what its own law asks for, until nothing changes.
//!
//! The slow and simple way to the same solution: the solver's last resort, and its oracle in the tests.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::disc::Slip;
use super::problem::{FACINGS, Path, Problem, Solution};

/// Sweeps after which the solver takes what there is.
pub const SWEEPS: u32 = 300;
/// Converged when no impulse changes by more than this part of the largest.
const CHANGE: f64 = 1e-15;

/// Solves `problem` from zero impulses in at most `sweeps` sweeps.
pub fn solve(problem: &Problem, sweeps: u32) -> Solution {
    let inverse = problem.A.try_inverse().unwrap_or_else(Matrix3::zeros);
    let J = &problem.J;
    let spread = inverse * J.transpose();
    let S = J * spread;
    let mobility = S.diagonal();

    let mut v = inverse * problem.b;
    let mut joint = Vector3::<f64>::zeros();
    let mut normal = [0.0; 2];
    let mut tangent = [Vector3::<f64>::zeros(); 2];
    let mut count = 0;
    while count < sweeps {
        count += 1;
        let (mut change, mut largest): (f64, f64) = (0.0, problem.b.amax());
        for i in 0..3 {
            let law = &problem.joints[i];
            let own = inverse[(i, i)];
            let without = v[i] - own * joint[i];
            let slid = law.friction(-without / own);
            let moved = (without + own * slid).max(law.low).min(law.high);
            let next = if moved == without + own * slid {
                slid
            } else {
                (moved - without) / own
            };
            let difference = next - joint[i];
            joint[i] = next;
            v += inverse.column(i) * difference;
            change = change.max(difference.abs());
            largest = largest.max(next.abs());
        }
        for (k, facing) in FACINGS.iter().enumerate() {
            let contact = &problem.contacts[k];
            let axis = facing.axis();
            // n (1 + κ dt W) = pressure without the impulse itself
            let w = J * v;
            let pressure =
                contact.pressure(*facing, &w) + contact.kappa_dt * mobility[axis] * normal[k];
            let next = (pressure / (1.0 + contact.kappa_dt * mobility[axis])).max(0.0);
            let difference = next - normal[k];
            normal[k] = next;
            v += spread.column(axis) * (facing.sign() * difference);
            change = change.max(difference.abs());
            largest = largest.max(next);
        }
        for (k, facing) in FACINGS.iter().enumerate() {
            let (contact, [i, j]) = (&problem.contacts[k], facing.plane());
            let w = J * (v - spread * tangent[k]);
            let t = Slip {
                S: Matrix2::new(S[(i, i)], S[(i, j)], S[(i, j)], S[(j, j)]),
                w: Vector2::new(w[i], w[j]),
                n: normal[k],
                c: Vector2::zeros(), // the normal has its own turn
                mu: contact.mu,
            }
            .friction();
            let mut next = Vector3::zeros();
            (next[i], next[j]) = (t.x, t.y);
            let difference = next - tangent[k];
            tangent[k] = next;
            v += spread * difference;
            change = change.max(difference.amax());
        }
        if change <= CHANGE * largest {
            break;
        }
    }
    Solution {
        v,
        joint,
        normal,
        tangent: tangent[0] + tangent[1],
        path: Path::Swept(count),
    }
}
