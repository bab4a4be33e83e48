//! Live gain changes that do not raise the stored energy.
//!
//! | change | kept | so that |
//! |---|---|---|
//! | K K_P raised | K K_P e, the spring's force | its energy falls by the ratio |
//! | K K_P lowered | e | its energy falls by the ratio |
//! | K M_n raised | K M_n v_n² | the nominal's energy stays |
//! | K M_n lowered | v_n | it falls |
//! | f_max raised under `passive_applied` | Φ(e) at most | a spring beyond its limit gains nothing |
//! | D_n, or f_max otherwise | all | neither stores; the next slip sees the new bound |

use crate::real::{self, sat};
use crate::storage::{extension, spring};
use crate::{Gains, Law, Real};

/// Position error (m) and nominal velocity (m/s) with which the gains `to` take over from the gains `from`.
pub fn taken_over(law: Law, from: &Gains, to: &Gains, e: Real, v_n: Real) -> (Real, Real) {
    if from == to {
        return (e, v_n);
    }
    let spring_ratio = from.K * from.K_P / (to.K * to.K_P);
    let mass_ratio = from.K * from.M_n / (to.K * to.M_n);
    let e_kept = e * spring_ratio.min(1.0);
    let e_most = extension(law, to, spring(law, from, e));
    (sat(e_kept, e_most), v_n * real::sqrt(mass_ratio.min(1.0)))
}
