//! The wall experiment of the testbed with the law alone: how long each law keeps pushing after the human has reversed.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod robot;
use admittance::{Gains, Law};
use core::f64::consts::TAU;
use robot::tick;

const T: f64 = 0.002;
const SUBSTEPS: u32 = 25;
const WALL: f64 = 0.3;

/// A 6 kg mass with Coulomb and viscous friction before a spring-damper wall that does not pull; backward Euler, in which
/// friction and wall are solved together.
#[derive(Default)]
struct Testbed {
    q: f64,
    dq: f64,
    /// compression of the wall's spring, m
    wall: f64,
}

impl Testbed {
    fn hold(&mut self, u: f64) {
        let (M, F_c, b, k, c) = (6.0, 0.64, 0.19, 1e5, 300.0);
        let h = T / f64::from(SUBSTEPS);
        // The largest force that friction can take from `push` leaves the velocity at 0 or on push's side.
        let velocity = |push: f64, inertia: f64| (push - push.clamp(-F_c, F_c)) / inertia;
        for _ in 0..SUBSTEPS {
            let push = M / h * self.dq + u;
            self.dq = velocity(push, M / h + b);
            let stiffness = k + c / h;
            self.wall *= c / h / stiffness; // what a free damper and spring relax to
            let gap = self.q - WALL - self.wall;
            if gap + h * self.dq > 0.0 {
                self.dq = velocity(push - stiffness * gap, M / h + b + stiffness * h);
                self.wall = self.q + h * self.dq - WALL;
            }
            self.q += h * self.dq;
        }
    }
}

/// 10 s of a sine of 4.17 N, then 5 N towards the wall, and from 20 s on away from it (zero at 20.25 s).
fn f_h(t: f64) -> f64 {
    if t < 10.0 {
        4.17 * (TAU * 0.31 * t).sin()
    } else if t < 20.0 {
        5.0 * ((t - 10.0) / 0.5).min(1.0)
    } else {
        5.0 - 10.0 * ((t - 20.0) / 0.5).min(1.0)
    }
}

/// Seconds from 20.25 s until the mass is 1 mm off the wall, and the largest energy created until then (J).
fn release(which: Law, M_n: f64, D_n: f64) -> (f64, f64) {
    let mut law = robot::law(
        which,
        T,
        Gains {
            M_n,
            D_n,
            K: 30.0,
            K_P: 10.0,
            f_max: 12.5,
        },
    );
    let mut testbed = Testbed::default();
    let mut created = f64::MIN;
    for k in 0..30_000 {
        let t = T * f64::from(k);
        let tick = tick(&mut law, testbed.q, f_h(t));
        created = created.max(law.ledger().G());
        if t >= 20.25 && testbed.q < WALL - 1e-3 {
            return (t - 20.25, created);
        }
        testbed.hold(tick.f.x + f_h(t));
    }
    panic!("{which:?} with {M_n} kg: not by 60 s");
}

/// The figures come from an independent implementation of law and testbed, printed to three digits; two samples of
/// tolerance where the substep is the same.
#[test]
fn the_bounded_law_releases_within_half_a_second_and_the_standard_one_within_twenty() {
    const NOMINALS: [(f64, f64); 4] = [(0.1, 0.5), (5.0, 0.5), (5.0, 5.0), (10.0, 0.5)];
    for (which, expected) in [
        (Law::Standard, [10.18, 17.04, 10.72, 19.55]),
        (Law::Passive, [0.096, 0.584, 0.818, 1.404]),
        (Law::PassiveApplied, [8.37, 14.33, 9.01, 16.28]),
        (Law::PassiveBounded, [0.092, 0.332, 0.342, 0.434]),
    ] {
        for ((M_n, D_n), expected) in NOMINALS.into_iter().zip(expected) {
            let (delay, created) = release(which, M_n, D_n);
            let rounding = if expected > 5.0 { 0.005 } else { 0.0005 };
            assert!(
                (delay - expected).abs() < 2.0 * T + rounding,
                "{which:?} at {M_n} kg, {D_n}: {delay} s"
            );
            assert!(
                which != Law::PassiveBounded || created <= 1e-9,
                "{created} J"
            ); // rounding of 3e4 ticks
        }
    }
}
