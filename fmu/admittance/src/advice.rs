//! Gains that are accepted, but probably not meant: for the lightest mass that the robot shows.
//!
//! ```text
//! K T/M_min > 0.25      the sampled coupling rings
//! M_n < M_min/10        a stiff hand makes the loop grow
//! ```
//!
//! **K T/M.** The force K y of one sample changes the robot's velocity by K T/M of the velocity error. With the backward
//! difference the loop without a hand is stable up to K T/M = 1.88 to 1.95, and up to 0.78 with one sample of delay
//! (`tests/stability.rs`). A quarter leaves a factor of 7 and of 3, and the error of a held force settles without ringing.
//!
//! **M_n/M.** A hand of stiffness k_h pulls nominal and robot; where M_n is the lighter one, the nominal runs ahead and the
//! coupling carries the robot after it too late. To first order in 1/K the continuous loop is stable while
//!
//! ```text
//! k_h² (M − M_n) < K D_n (k_h + M_n K_P²)
//! ```
//!
//! so the largest soft hand is k_h = K_P √(K D_n) √(M_n/(M − M_n)): without a limit at M_n = M, and at M_n = M/10, where the
//! last root is 1/3, a third of what the gains K_P, K, D_n alone give. Below, it goes down with √M_n. The harness's command
//! `exo tune` has the exact sampled limit for given gains; this module only warns, and changes nothing.

use crate::{Gains, Real, Settings};

/// Largest K T/M_min that raises no advice.
pub const KT_OVER_M_MAX: Real = 0.25;
/// Smallest M_n/M_min that raises no advice.
pub const MN_OVER_M_MIN: Real = 0.1;

/// What the gains of one axis, or of several, are advised against.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Advice {
    /// K T/M_min above [`KT_OVER_M_MAX`].
    pub stiff_coupling: bool,
    /// M_n/M_min below [`MN_OVER_M_MIN`].
    pub light_nominal: bool,
}

/// Advice on the gains of one axis of a robot whose effective mass along it is `M_min` (kg, > 0) where it is lightest.
///
/// Both bounds are compared as products, so that a value on the bound raises nothing.
pub fn advise(settings: &Settings, gains: &Gains, M_min: Real) -> Advice {
    Advice {
        stiff_coupling: gains.K * settings.T > KT_OVER_M_MAX * M_min,
        light_nominal: gains.M_n < MN_OVER_M_MIN * M_min,
    }
}

impl Advice {
    /// What either of two is advised against.
    pub const fn or(self, other: Self) -> Self {
        Self {
            stiff_coupling: self.stiff_coupling || other.stiff_coupling,
            light_nominal: self.light_nominal || other.light_nominal,
        }
    }

    /// Number in interfaces: 0 none, 1 K T/M_min, 2 M_n/M_min, 3 both.
    pub const fn number(self) -> i32 {
        self.stiff_coupling as i32 + 2 * self.light_nominal as i32
    }

    /// What to say to the user; empty if there is nothing to say.
    pub const fn message(self) -> &'static str {
        match (self.stiff_coupling, self.light_nominal) {
            (false, false) => "",
            (true, false) => "K T/M_min is above 0.25: expect ringing, lower K or T",
            (false, true) => "M_n is below M_min/10: a stiff hand can make the loop grow",
            (true, true) => {
                "K T/M_min is above 0.25: expect ringing, lower K or T; M_n is below M_min/10: a stiff hand can make the \
                 loop grow"
            }
        }
    }
}
