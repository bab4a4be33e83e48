//! The energy of the three joints' springs, and gain changes that do not raise what is stored.
//!
//! H = k (½ v_nᵀ M_n v_n/alpha + ½ eᵀ K_P e): with one k the springs are each joint's own and the nominal's energy scales
//! with k alone, so that [`admittance`]'s rules hold joint by joint, with M_n unchanged.

use super::JointGains;
use admittance::storage::Spring;
use admittance::{Law, Real, retune};
use nalgebra::Vector3;

/// Energy of the springs at position errors `e` (rad), J: ½ k eᵀ K_P e, and Φ(e) under `passive_applied`.
pub fn springs(law: Law, gains: &JointGains, e: &Vector3<Real>) -> Real {
    let spring = |i: usize| Spring::new(law, &gains.of(i)).energy(e[i]);
    spring(0) + spring(1) + spring(2)
}

/// Position errors (rad) of springs that may have slipped: |k K_P e| ≤ tau_max on each joint.
pub fn slipped(law: Law, gains: &JointGains, e: &Vector3<Real>) -> Vector3<Real> {
    Vector3::from([0, 1, 2].map(|i| Spring::new(law, &gains.of(i)).slipped(e[i])))
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
        let (from, to) = (from.of(i), to.of(i));
        retune::taken_over(law, &from, &to, e[i], v_n[i])
    });
    (
        Vector3::new(one.0, two.0, three.0),
        Vector3::new(one.1, two.1, three.1),
    )
}
