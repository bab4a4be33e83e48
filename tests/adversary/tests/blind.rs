//! The arm's position drops out: what the torque did in that sample nobody sees, and the tank pays for the worst.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::{Bounds, Gains, Reach, Request, Settings};
use adversary::audit::Sum;
use adversary::random::Random;
use adversary::subject::{Arm, Order, Setup, Subject, supply};
use nalgebra::Vector3;

/// The most that was created beyond what the ledger says, J.
fn run(delayed: bool, seed: u64) -> f64 {
    let settings = Settings {
        T: 0.001,
        delayed,
        E_0: 1.0,
        ..Settings::default()
    };
    let gains = Gains {
        M_n: 5.0,
        D_n: 20.0,
        K: 1000.0,
        K_P: 20.0,
        f_max: 400.0,
    };
    let setup = Setup {
        settings,
        gains: [gains; 3],
        bounds: [Bounds::default(); 3],
        reach: Reach {
            v_max: Vector3::repeat(2.0),
            a_max: Vector3::repeat(f64::INFINITY),
        },
        rate: f64::INFINITY,
        tau_max: 150.0,
        clip: false,
        lag: 1.0,
    };
    let mut law = Arm::build(&setup).expect("valid parameters");
    let mut random = Random::new(seed);
    let order = Order::Run(Request::default());
    let mut q = Arm::home();
    let (mut said, mut most) = (Vector3::zeros(), f64::MIN);
    let mut out = Sum::default();
    for k in 0..20_000 {
        // A push that fills the spring, then, the hand off, one sample in the dark in which the arm goes where the torque
        // drives it.
        let dark = k % 100 == 99;
        let f_h = Vector3::new(30.0, -20.0, 25.0)
            * if k % 100 < 98 {
                random.within(0.5, 1.0)
            } else {
                0.0
            };
        let acting;
        if dark {
            law.blind();
            acting = if delayed { said } else { Vector3::zeros() };
            said = Vector3::zeros();
        } else {
            let seen = law.tick(&q, &f_h, &order);
            assert!(
                seen.tank >= -1e-12 && !seen.debt,
                "seed {seed}, tick {k}: {} J",
                seen.tank
            );
            most = most.max(out.value() + seen.H - seen.G);
            let brought = supply(&setup, &setup.gains, &f_h, &order, &seen);
            out.add(-brought.energy, brought.size);
            acting = if delayed { said } else { seen.tau };
            said = seen.tau;
        }
        let next_dark = k % 100 == 98 || dark;
        let step = if next_dark {
            acting.map(|tau| 2.0 * 0.001 * (1.0 - 1e-9) * f64::signum(tau))
        } else {
            Vector3::zeros()
        };
        out.add(acting.dot(&step), acting.abs().dot(&step.abs()));
        q += step;
    }
    most
}

#[test]
fn the_ledger_never_says_less_than_was_created() {
    for (delayed, seed) in [(false, 1), (false, 2), (true, 3), (true, 4)] {
        let beyond = run(delayed, seed);
        println!("delay {delayed}: {beyond} J");
        assert!(beyond <= 1e-9, "delay {delayed}: {beyond} J"); // rounding of 20,000 samples of some J
    }
}
