//! Whether the force that the drives say they gave can be theirs.
//!
//! The servo form lives on `tau_a_measured`. If it is not wired, the nominal feels nothing and the robot sticks to walls; with the
//! wrong sign it is pushed on by what holds it. Neither is seen in the force itself, but both are seen beside the force that
//! the law's own drive would have given over the same sample, which follows from the command and the measured motion
//! ([`Drive::surely`]), whatever pushes the robot. Of both, low-passed against encoder steps ([`SMOOTHED`]), leaky means are taken
//! over [`WATCHED`]:
//!
//! ```text
//! S = ⟨tau_e²⟩,  P = ⟨tau_m tau_e⟩        judged where S > (f_max/10)²
//! P < −S/4   wrong sign        |P| ≤ S/4   missing
//! ```
//!
//! A drive that is the law up to 10 % has P/S within .9 and 1.1; one with a quarter of the law's gains would be called missing.
//! A verdict stays until another one is due, or the law leaves the loop.

use super::Drive;
use crate::Real;
use crate::real::{self, floored};
use core::fmt::{Display, Formatter};
use fmu_declaration::{Enumeration, Item};
use nalgebra::SVector;

/// Time constant of the low pass on the forces, s.
pub const SMOOTHED: Real = 0.02;
/// Time constant of the means, s.
pub const WATCHED: Real = 0.2;
/// The root of ⟨tau_e²⟩ in f_max below which nothing is judged.
const LEAST: Real = 0.1;
/// The ratio of the means below which the measured force is not the drive's.
const LEAST_RATIO: Real = 0.25;

/// What is wrong with a measured force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(i32)]
pub enum Fault {
    /// It does not follow the force that the drive must have given.
    Missing = 1,
    /// It follows it with the opposite sign.
    WrongSign = 2,
}

impl Fault {
    /// The number by which the interface knows it; 0 stands for none.
    pub const fn number(self) -> i32 {
        self as i32
    }
}

/// The type of `drive.fault`.
pub const FAULT: Enumeration = Enumeration {
    name: "DriveFault",
    about: "What is wrong with the measured force of the drive, in the servo form",
    items: &[
        Item::new(0, "none", "nothing"),
        Item::new(
            Fault::Missing.number(),
            "missing",
            "tau_a_measured is not the drive's: not wired, or the drive is off or has other gains than the law",
        ),
        Item::new(
            Fault::WrongSign.number(),
            "wrong_sign",
            "tau_a_measured has the sign of the force on the drive, not of that on the robot",
        ),
    ],
};

/// The item of `drive.fault` with the number `fault`, for a message.
pub fn message(fault: i32) -> impl Display {
    let found = FAULT.items.iter().find(|item| item.value == fault);
    Message(found.unwrap_or(&FAULT.items[0]))
}

struct Message(&'static Item);

impl Display for Message {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        let Item { value, name, about } = self.0;
        write!(f, "drive.fault = {value} ({name}): {about}")
    }
}

/// What is known of N drives' measured forces between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Feedback<const N: usize> {
    /// of one sample in the low pass, and in the means
    smoothing: Real,
    watching: Real,
    drives: SVector<Watched, N>,
    /// whether the drives were told anything in the sample that ends
    commanded: bool,
}

/// One drive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Watched {
    /// the motion that it was told: how far ahead of the robot it begins, m, and its velocity, m/s
    start: Real,
    dq_d: Real,
    /// the forces, low-passed, N
    tau_e: Real,
    tau_m: Real,
    /// the means, N²
    square: Real,
    product: Real,
    fault: Option<Fault>,
}

impl<const N: usize> Feedback<N> {
    /// Nothing known, at a sample period of `T` (s).
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub fn new(T: Real) -> Self {
        Self {
            smoothing: -real::exp_m1(-T / SMOOTHED),
            watching: -real::exp_m1(-T / WATCHED),
            drives: SVector::repeat(Watched::default()),
            commanded: false,
        }
    }

    /// Compares the forces `tau_m` (N) with those that `drive` would have given in the sample of `T` (s) that ends, in which
    /// the robot `moved` (m).
    #[allow(non_snake_case, reason = "the paper's symbol")]
    pub(super) fn compare(
        &mut self,
        drive: &Drive<N>,
        tau_m: &SVector<Real, N>,
        moved: Option<&SVector<Real, N>>,
        T: Real,
    ) {
        let Some(moved) = moved.filter(|_| self.commanded) else {
            return;
        };
        for (i, watched) in self.drives.iter_mut().enumerate() {
            let tau_e = drive.surely(i, watched.start, watched.dq_d, moved[i], T);
            let [smoothing, watching] = [self.smoothing, self.watching];
            let mean = |mean: Real, new: Real, weight: Real| floored(mean + weight * (new - mean));
            watched.tau_e = mean(watched.tau_e, tau_e, smoothing);
            watched.tau_m = mean(watched.tau_m, tau_m[i], smoothing);
            let Watched { tau_e, tau_m, .. } = *watched;
            watched.square = mean(watched.square, tau_e * tau_e, watching);
            watched.product = mean(watched.product, tau_m * tau_e, watching);
            watched.judge(LEAST * drive.f_max[i]);
        }
    }

    /// The drives are told motions with the velocities `dq_d` (m/s) that begin `start` (m) ahead of the robot.
    pub(super) fn command(&mut self, start: SVector<Real, N>, dq_d: SVector<Real, N>) {
        for (i, watched) in self.drives.iter_mut().enumerate() {
            (watched.start, watched.dq_d) = (start[i], dq_d[i]);
        }
        self.commanded = true;
    }

    /// The law leaves the loop: a drive may be switched off then.
    pub(super) fn rest(&mut self) {
        self.drives = SVector::repeat(Watched::default());
        self.commanded = false;
    }

    /// What is wrong, and with which drive, from 0.
    pub fn fault(&self) -> Option<(Fault, usize)> {
        let mut drives = self.drives.iter().zip(0..);
        drives.find_map(|(watched, i)| watched.fault.map(|fault| (fault, i)))
    }

    /// The number of the fault in interfaces, 0 for none.
    pub fn number(&self) -> i32 {
        self.fault().map_or(0, |(fault, _)| fault.number())
    }
}

impl Watched {
    /// Passes a verdict if the drive had to give `least` (N) and more.
    fn judge(&mut self, least: Real) {
        if self.square > least * least {
            self.fault = if self.product > LEAST_RATIO * self.square {
                None
            } else if self.product < -LEAST_RATIO * self.square {
                Some(Fault::WrongSign)
            } else {
                Some(Fault::Missing)
            };
        }
    }
}
