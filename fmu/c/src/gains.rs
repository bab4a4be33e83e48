//! What may be changed while the law runs.

use crate::Real;
use admittance::{Bounds, Law};
use nalgebra::Vector3;

/// Gains of the arm along x, y, z of the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ArmGains {
    /// Nominal mass, kg, > 0.
    pub Lambda_n: [Real; 3],
    /// Nominal damping, N·s/m, ≥ 0.
    pub D_n: [Real; 3],
    /// Control gain, N·s/m, > 0.
    pub K: [Real; 3],
    /// Ratio of the coupling's spring to its damper, 1/s, > 0.
    pub K_P: [Real; 3],
    /// Largest force on the robot under `passive_bounded`, N, > 0; the other laws live on the torque limits alone.
    pub f_max: [Real; 3],
}

/// Gains of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct AxisGains {
    /// Nominal mass, kg, > 0.
    pub M_n: Real,
    /// Nominal damping, N·s/m, ≥ 0.
    pub D_n: Real,
    /// Control gain, N·s/m, > 0.
    pub K: Real,
    /// Ratio of the coupling's spring to its damper, 1/s, > 0.
    pub K_P: Real,
    /// Largest force on the robot, N, > 0.
    pub tau_max: Real,
}

impl Default for ArmGains {
    /// Those of ArmController.fmu.
    fn default() -> Self {
        Self {
            Lambda_n: [5.0; 3],
            D_n: [20.0; 3],
            K: [1000.0; 3],
            K_P: [20.0; 3],
            f_max: [400.0; 3],
        }
    }
}

impl Default for AxisGains {
    /// Those of TestbedController.fmu.
    fn default() -> Self {
        Self {
            M_n: 5.0,
            D_n: 0.5,
            K: 30.0,
            K_P: 10.0,
            tau_max: 12.5,
        }
    }
}

impl ArmGains {
    /// The law's gains.
    pub(crate) fn of_law(&self) -> [admittance::Gains; 3] {
        let all = Vector3::from(self.Lambda_n)
            .zip_zip_map(&self.D_n.into(), &self.K.into(), |M_n, D_n, K| {
                (M_n, D_n, K)
            })
            .zip_zip_map(
                &self.K_P.into(),
                &self.f_max.into(),
                |(M_n, D_n, K), K_P, f_max| admittance::Gains {
                    M_n,
                    D_n,
                    K,
                    K_P,
                    f_max,
                },
            );
        all.into()
    }
}

impl From<AxisGains> for admittance::Gains {
    fn from(gains: AxisGains) -> Self {
        let AxisGains {
            M_n,
            D_n,
            K,
            K_P,
            tau_max,
        } = gains;
        Self {
            M_n,
            D_n,
            K,
            K_P,
            f_max: tau_max,
        }
    }
}

/// The gains that a law uses: f_max of the arm belongs to a spring that slips.
pub(crate) fn limited_under(law: Law, gains: admittance::Gains) -> admittance::Gains {
    let f_max = if law.row().slips() {
        gains.f_max
    } else {
        Real::INFINITY
    };
    admittance::Gains { f_max, ..gains }
}

/// A limit of the interface, where 0 stands for none.
pub(crate) fn or_none(limit: Real) -> Real {
    if limit == 0.0 { Real::INFINITY } else { limit }
}

/// Bounds of the nominal in a box, or without one.
pub(crate) fn bounds(speed: Real, boxed: Option<(Real, Real)>) -> Bounds {
    match boxed {
        Some((q_min, q_max)) => Bounds {
            speed: or_none(speed),
            q_min,
            q_max,
        },
        None => Bounds {
            speed: or_none(speed),
            ..Bounds::default()
        },
    }
}
