//! The energy of the three joints' springs, and gain changes that do not raise what is stored.
//!
//! H = k (½ v_nᵀ M_n v_n/alpha + ½ eᵀ K_P e): with one k the springs are each joint's own and the nominal's energy scales
//! with k alone, so that [`admittance`]'s rules hold joint by joint, with M_n unchanged.

use super::JointGains;
use admittance::{Gains, Law, Real, retune, storage};
use nalgebra::Vector3;

/// Joint `i` of `gains` for the rules of one axis. They look at ratios of masses, and M_n does not change with the gains.
fn of_joint(gains: &JointGains, i: usize) -> Gains {
    Gains {
        M_n: 1.0,
        D_n: gains.D_n[i],
        K: gains.K,
        K_P: gains.K_P[i],
        f_max: gains.tau_max[i],
    }
}

/// Energy of the springs at position errors `e` (rad), J: ½ k eᵀ K_P e, and Φ(e) under `passive_applied`.
pub fn springs(law: Law, gains: &JointGains, e: &Vector3<Real>) -> Real {
    let spring = |i: usize| storage::spring(law, &of_joint(gains, i), e[i]);
    spring(0) + spring(1) + spring(2)
}

/// Position errors (rad) and nominal velocities (rad/s) with which the gains `to` take over from the gains `from`.
pub fn taken_over(
    law: Law,
    from: &JointGains,
    to: &JointGains,
    e: &Vector3<Real>,
    v_n: &Vector3<Real>,
) -> (Vector3<Real>, Vector3<Real>) {
    let [one, two, three] = [0, 1, 2].map(|i| {
        let (from, to) = (of_joint(from, i), of_joint(to, i));
        retune::taken_over(law, &from, &to, e[i], v_n[i])
    });
    (
        Vector3::new(one.0, two.0, three.0),
        Vector3::new(one.1, two.1, three.1),
    )
}
