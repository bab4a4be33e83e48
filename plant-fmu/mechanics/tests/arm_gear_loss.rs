//! Gears that lose a share of the torque they carry: what they hold, what arrives, and where the energy goes.

use mechanics::arm::gear_loss::GearLoss;
use mechanics::arm::{Arm, Inputs, Parameters, Start};

const LOSS: GearLoss = GearLoss {
    drive: 0.2,
    back: 0.4,
};
const TAU: f64 = 30.0;

/// The yaw joint alone resists with the loss of its gear: no weight, no other friction there, pitch joints held by theirs.
fn yaw(loss: GearLoss) -> Arm {
    let mut parameters = Parameters {
        drive_cutoff: 0.0,
        ..Parameters::default()
    };
    parameters.masses.gravity = [0.0; 3];
    parameters.gear_loss = [loss, GearLoss::default(), GearLoss::default()];
    (
        parameters.friction[0].F_c,
        parameters.friction[0].F_s,
        parameters.friction[0].b,
    ) = (0.0, 0.0, 0.0);
    for friction in &mut parameters.friction[1..] {
        (friction.F_c, friction.F_s) = (1e4, 1e4);
    }
    Arm::new(parameters, &Start::default()).unwrap()
}

/// The drive turns with `TAU`, a load turns against it with `load` (N·m), at the handle 0.44 m ahead.
fn against(load: f64) -> Inputs {
    Inputs {
        tau_a: [TAU, 0.0, 0.0],
        f_h: [0.0, -load / Arm::default().p().x, 0.0],
        ..Inputs::default()
    }
}

#[test]
fn at_rest_a_gear_holds_between_what_it_passes_on_and_what_drives_it_back() {
    // The drive moves the load below (1 − 0.2) τ, the load moves the drive above τ/(1 − 0.4).
    let (least, most) = ((1.0 - LOSS.drive) * TAU, TAU / (1.0 - LOSS.back));
    for (load, moves) in [
        (least * (1.0 - 1e-9), 1.0),
        (least * (1.0 + 1e-9), 0.0),
        (TAU, 0.0),
        (most * (1.0 - 1e-9), 0.0),
        (most * (1.0 + 1e-9), -1.0),
    ] {
        let mut arm = yaw(LOSS);
        arm.advance(&against(load), 10, 1e-4);
        let dq = arm.dq()[0];
        assert_eq!(
            if dq == 0.0 { 0.0 } else { dq.signum() },
            moves,
            "{load}: {dq:e}"
        );
        // The same the other way round.
        let mut mirrored = yaw(LOSS);
        let Inputs { tau_a, f_h, .. } = against(load);
        let other = Inputs {
            tau_a: tau_a.map(|tau| -tau),
            f_h: f_h.map(|f| -f),
            ..Inputs::default()
        };
        mirrored.advance(&other, 10, 1e-4);
        assert_eq!(mirrored.dq()[0], -dq);
    }
}

#[test]
fn the_share_that_is_lost_is_that_of_what_goes_in() {
    // Driving: the drive's work goes in. Driven back: the load's work goes in, and the drive takes (1 − 0.4) of it.
    for (load, share) in [(10.0, LOSS.drive), (80.0, LOSS.back)] {
        let mut arm = yaw(LOSS);
        arm.advance(&against(load), 3_000, 1e-4);
        let energy = arm.energy();
        let drive = energy.work_tau;
        let goes_in = if load < TAU {
            drive
        } else {
            -drive / (1.0 - LOSS.back)
        };
        assert!(goes_in > 1.0, "{energy:?}");
        assert!(
            (energy.loss_friction / goes_in - share).abs() < 1e-12,
            "{load}: {energy:?}"
        );
        // A first-order residual: C dq and J of the begin of a substep.
        assert!(energy.residual.abs() < 1e-3 * goes_in, "{energy:?}");
    }
}

#[test]
fn the_balance_closes_with_order_one_while_driving_and_back_driving() {
    let run = |n: u32| {
        let parameters = Parameters {
            gear_loss: [LOSS; 3],
            ..Parameters::default()
        };
        let mut arm = Arm::new(parameters, &Start::default()).unwrap();
        for k in 0..8 {
            let up = if k % 2 == 0 { 1.0 } else { -0.6 };
            let inputs = Inputs {
                tau_a: [40.0 * up, 90.0 * up, 45.0 * up],
                f_h: [0.0, -60.0 * up, 40.0],
                ..Inputs::default()
            };
            arm.advance(&inputs, 100 * n, 1e-3 / f64::from(n));
        }
        arm.energy()
    };
    let (coarse, fine) = (run(5), run(10));
    assert!(fine.loss_friction > 2.0, "{fine:?}");
    assert!(fine.residual.abs() < 1e-2 * fine.loss(), "{fine:?}");
    let ratio = coarse.residual / fine.residual;
    assert!((ratio - 2.0).abs() < 0.2, "{ratio}");
}

#[test]
fn without_a_loss_nothing_changes() {
    let mut arms = [yaw(GearLoss::default()), yaw(LOSS)];
    for arm in &mut arms {
        arm.advance(&against(20.0), 100, 1e-4);
    }
    assert_eq!(arms[0].energy().loss_friction, 0.0);
    assert!(arms[1].dq()[0] < 0.7 * arms[0].dq()[0]);
}
