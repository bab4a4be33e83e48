//! Two arms, one payload: what they do together, held against one arm, against rigid-body algebra, against themselves.

#![allow(non_snake_case, reason = "the symbols of the equations")]

use mechanics::arm::{Arm, Inputs, Parameters as ArmParameters, Start};
use mechanics::pair::{Bond, Pair, Parameters};

/// 35 kg on a table 20 mm below the pads.
fn parameters() -> Parameters {
    let mut parameters = Parameters::default();
    parameters.arm.payload_m = 35.0;
    parameters.arm.table.z = -0.377;
    parameters
}

/// Torques that press, then lift with the pitch joints and sway with the yaw; `share` of the lifting is left to the arm.
fn lift(t: f64, share: f64) -> Inputs {
    let torque = |yaw: f64, shoulder: f64, elbow: f64| [yaw, shoulder * share, elbow * share];
    Inputs {
        tau_a: if t < 1.0 {
            [0.0, -20.0, -20.0]
        } else {
            let sway = 25.0 * (3.0 * (t - 1.0)).sin();
            torque(sway, 140.0, 90.0)
        },
        vacuum: t > 0.5,
        ..Inputs::default()
    }
}

/// Runs both arms for `seconds` in substeps of `dt` (s); the right one has `share` of the left one's torque. `each` sees
/// every millisecond.
fn run(seconds: f64, dt: f64, share: f64, mut each: impl FnMut(&Pair)) -> Pair {
    let mut pair = Pair::new(parameters(), &Start::default()).expect("legal");
    let n = (1e-3 / dt).round() as u32;
    for k in 0..(seconds * 1e3) as u32 {
        let t = f64::from(k) * 1e-3;
        pair.advance(&[lift(t, 1.0), lift(t, share)], n, dt);
        each(&pair);
    }
    pair
}

#[test]
fn arms_that_do_the_same_are_two_single_arms_with_half_the_payload_bit_for_bit() {
    let half = ArmParameters {
        payload_m: 17.5,
        ..parameters().arm
    };
    let mut single = Arm::new(half, &Start::default()).expect("legal");
    let mut k = 0;
    let mut highest = f64::NEG_INFINITY;
    run(2.0, 1e-4, 1.0, |pair| {
        single.advance(&lift(f64::from(k) * 1e-3, 1.0), 10, 1e-4);
        k += 1;
        for arm in pair.arms() {
            assert_eq!((arm.q(), arm.state()), (single.q(), single.state()));
        }
        assert_eq!((pair.gap(), pair.lambda().norm()), (0.0, 0.0));
        highest = highest.max(single.place().pad.p.z);
    });
    assert!(single.attached() && highest > -0.3, "{highest}"); // it did lift
}

#[test]
fn gap_stays_below_10_um_while_one_arm_does_most_of_the_work() {
    for dt in [1e-3, 1e-4, 2e-5] {
        let (mut gap, mut force, mut rounds): (f64, f64, u32) = (0.0, 0.0, 0);
        let pair = run(2.5, dt, 0.7, |pair| {
            gap = gap.max(pair.gap());
            force = force.max(pair.lambda().norm());
            rounds = rounds.max(pair.rounds());
        });
        println!("{dt:e}: gap {gap:e} m, lambda {force} N, rounds {rounds}");
        assert!(pair.attached());
        let z = pair.arms()[0].place().pad.p.z;
        assert!(z > -0.35, "lifted to {z} m only");
        // Static: λ/k. Besides λ's linear position: ½ |J'| v² dt² = 5e-7 m at 1 rad/s and 1 ms.
        assert!(force > 20.0, "{force}");
        assert!(gap > 0.0 && gap < 1e-5, "{gap:e}");
        assert!(rounds < 12, "{rounds}");
    }
}

#[test]
fn arms_that_share_differ_from_arms_that_do_not() {
    // The same torques without a common payload: the weak arm stays behind by centimetres.
    let alone = |share: f64| {
        let half = ArmParameters {
            payload_m: 17.5,
            ..parameters().arm
        };
        let mut arm = Arm::new(half, &Start::default()).expect("legal");
        for k in 0..2500 {
            arm.advance(&lift(f64::from(k) * 1e-3, share), 10, 1e-4);
        }
        arm.place().pad.p
    };
    assert!((alone(1.0) - alone(0.7)).norm() > 0.02);
}

#[test]
fn every_energy_has_its_formula_and_what_is_left_halves_with_the_substep() {
    let residual = |dt: f64| {
        let balance = run(2.5, dt, 0.7, |_| ()).energy();
        let energy = &balance.arms;
        println!("{dt:e}: {balance:?}");
        assert!(balance.bond > 0.0 && balance.loss_bond > 0.0);
        // The bond moves tens of joules between the arms: without λ's work the arms' own balances do not close.
        let throughput = energy.work_tau.abs() + energy.payload.abs() + energy.loss();
        assert!(energy.residual.abs() < 0.01 * throughput, "{energy:?}");
        energy.residual.abs()
    };
    let (coarse, fine) = (residual(2e-4), residual(1e-4));
    // First order: 2, up to the landing and the grip, which happen at instants that are multiples of dt.
    assert!((1.6..2.5).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

#[test]
fn the_bond_carries_energy_from_the_strong_arm_to_the_weak_one() {
    let pair = run(2.5, 1e-4, 0.7, |_| ());
    let [left, right] = pair.arms();
    let (given, taken) = (left.energy().residual, right.energy().residual);
    println!("given {given} J, taken {taken} J");
    assert!(given > 0.5 && taken < -0.5, "{given} {taken}");
    // What one gives the other gets, up to the first-order terms above.
    assert!((given + taken).abs() < 0.05 * given, "{given} {taken}");
}

#[test]
fn stiction_holds_both_arms_and_a_strain_between_them_exactly() {
    let mut pair = run(2.5, 1e-4, 0.7, |_| ());
    // The drives bear the weight up to half of what stiction can hold: the arms come to rest and stay.
    let hold = Inputs {
        tau_a: [0.0, 100.0, 65.0],
        vacuum: true,
        ..Inputs::default()
    };
    pair.advance(&[hold; 2], 30_000, 1e-4);
    let (q, lambda) = ([0, 1].map(|i| pair.arms()[i].q()), pair.lambda());
    pair.advance(&[hold; 2], 30_000, 1e-4);
    assert_eq!([0, 1].map(|i| pair.arms()[i].q()), q);
    assert!((pair.lambda() - lambda).norm() < 1e-9 * lambda.norm() + 1e-9); // roundings of 1e-16 m · 1e8 N/m
}

#[test]
fn a_soft_bond_stores_and_heats_what_the_balance_would_miss() {
    let run = |dt: f64| {
        let mut parameters = parameters();
        parameters.bond = Bond { k: 2e4, c: 500.0 };
        let start = Start {
            attached: true,
            ..Start::default()
        };
        let mut pair = Pair::new(parameters, &start).expect("legal");
        for k in 0..1_000 {
            let t = 1.0 + f64::from(k) * 1e-3;
            pair.advance(
                &[lift(t, 1.0), lift(t, 0.7)],
                (1e-3 / dt).round() as u32,
                dt,
            );
        }
        pair.energy()
    };
    let (coarse, fine) = (run(2e-4), run(1e-4));
    println!("{fine:?}");
    let bond = fine.bond + fine.loss_bond;
    assert!(bond > 0.02, "{bond}");
    assert!(fine.arms.residual.abs() < 0.1 * bond, "{fine:?}");
    let ratio = coarse.arms.residual / fine.arms.residual; // first order
    assert!((1.8..2.2).contains(&ratio), "{ratio}");
}
