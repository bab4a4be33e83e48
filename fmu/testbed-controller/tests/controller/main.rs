//! The testbed controller as a model: start, ticks, engaging, tunables, refusals.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod encoders;
mod exchange;
#[path = "../../../../tests/controllers/samples.rs"]
mod samples;

use admittance::law::LAW;
use fmu_declaration::{Access, Declare};
use fmu_export::{Log, Model, Step};
use testbed_controller::TestbedController;
use testbed_controller::TestbedController as Controller;

/// Sample period, s.
const T: f64 = 0.002;

fn controller(change: impl FnOnce(&mut TestbedController)) -> TestbedController {
    let mut controller = TestbedController::default();
    change(&mut controller);
    controller
}

fn initialized(change: impl FnOnce(&mut TestbedController)) -> TestbedController {
    let mut controller = controller(change);
    controller
        .initialize(0.0, &mut Log::silent())
        .expect("valid parameters");
    controller
}

/// Step number `k` of length `h` (s) from 0 on.
fn step(controller: &mut TestbedController, k: u32, h: f64) {
    let step = Step::at(f64::from(k) * h, h);
    controller.step(step, &mut Log::silent()).expect("a step");
}

/// The human pushes.
fn pushed(controller: &mut Controller) {
    controller.inputs.tau_h = 3.0;
}

/// Another force and another position.
fn told_otherwise(controller: &mut Controller) {
    controller.inputs.tau_h = -100.0;
    controller.inputs.q = 0.0;
}

/// One tick a step.
fn tick(controller: &mut TestbedController, k: u32) {
    step(controller, k, T);
    assert_eq!(controller.tick, k as i32);
}

#[test]
fn after_initialization_there_is_no_force_and_the_nominal_stands_at_q() {
    let mut controller = initialized(|c| (c.inputs.q, c.inputs.tau_h) = (0.7, 9.0));
    let at_start = |c: &TestbedController, q: f64| {
        assert_eq!(
            (
                c.outputs.tau_a,
                c.outputs.tau_demand,
                c.outputs.q_n,
                c.outputs.dq_n,
                c.outputs.e_nr,
                c.outputs.dq
            ),
            (0.0, 0.0, q, 0.0, 0.0, 0.0)
        );
        assert_eq!(
            (
                c.outputs.saturated != 0,
                c.outputs.engaged != 0,
                c.outputs.outside_bounds != 0,
                c.tick
            ),
            (false, false, false, -1)
        );
        assert_eq!((c.outputs.H, c.outputs.G, c.outputs.tank), (0.0, 0.0, 10.0));
    };
    at_start(&controller, 0.7);
    // Again, after a change and after a run.
    tick(&mut controller, 0);
    controller.inputs.q = 0.8;
    controller
        .initialize(0.0, &mut Log::silent())
        .expect("valid parameters");
    at_start(&controller, 0.8);
}

#[test]
fn the_first_tick_engages_at_q_whatever_q_was_when_initialized() {
    let mut controller = initialized(|_| ());
    controller.inputs.q = 0.25; // an importer that wires late
    tick(&mut controller, 0);
    assert_eq!(
        (
            controller.outputs.q_n,
            controller.outputs.e_nr,
            controller.outputs.dq,
            controller.outputs.tau_a
        ),
        (0.25, 0.0, 0.0, 0.0)
    );
    assert!(controller.outputs.engaged != 0);
}

#[test]
fn until_engage_is_true_there_is_no_force_and_then_it_starts_at_the_sensed_position() {
    let mut controller = initialized(|c| (c.inputs.engage, c.inputs.tau_h) = (0, 8.0));
    for k in 0..5 {
        controller.inputs.q = 0.1 * f64::from(k);
        tick(&mut controller, k);
        assert_eq!(
            (
                controller.outputs.tau_a,
                controller.outputs.q_n,
                controller.outputs.engaged != 0
            ),
            (0.0, controller.inputs.q, false)
        );
    }
    controller.inputs.engage = 1;
    tick(&mut controller, 5);
    assert_eq!(
        (
            controller.outputs.q_n,
            controller.outputs.dq_n,
            controller.outputs.dq,
            controller.outputs.engaged != 0
        ),
        (0.4, 0.0, 0.0, true)
    );
    assert!(controller.outputs.tau_a > 0.0 && controller.outputs.tau_a < 12.5);
    // And out again: the stored energy is given up, none is created.
    tick(&mut controller, 6);
    assert!(controller.outputs.H > 0.0);
    let G = controller.outputs.G;
    controller.inputs.engage = 0;
    tick(&mut controller, 7);
    assert_eq!(
        (
            controller.outputs.tau_a,
            controller.outputs.e_nr,
            controller.outputs.H
        ),
        (0.0, 0.0, 0.0)
    );
    assert!(controller.outputs.G < G);
}

#[test]
fn the_force_obeys_tau_max_and_says_so() {
    let mut controller = initialized(|c| (c.inputs.tau_h, c.parameters.tuning_time) = (6.0, 0.0));
    (0..5000).for_each(|k| tick(&mut controller, k));
    assert_eq!(
        (controller.outputs.tau_a, controller.outputs.saturated != 0),
        (12.5, true)
    );
    assert!(controller.outputs.tau_demand > 12.5);
    controller.parameters.tau_max = 7.0;
    controller.tune(&mut Log::silent()).expect("a valid limit");
    assert_eq!(
        controller.outputs.tau_a, 12.5,
        "a tunable acts at the next tick"
    );
    tick(&mut controller, 5000);
    assert_eq!(controller.outputs.tau_a, 7.0);
    assert!((300.0 * controller.outputs.e_nr).abs() <= 7.0 * (1.0 + 1e-15)); // the product's rounding
}

/// K, K_P and M_n raised a hundredfold while the spring is stretched: the stored energy must not rise with them.
#[test]
fn tuning_does_not_raise_the_stored_energy() {
    let mut controller = initialized(|c| c.inputs.tau_h = 6.0);
    (0..5000).for_each(|k| tick(&mut controller, k));
    let before = controller.clone();
    (
        controller.parameters.K,
        controller.parameters.K_P,
        controller.parameters.M_n,
    ) = (300.0, 100.0, 50.0);
    controller.tune(&mut Log::silent()).expect("valid gains");
    tick(&mut controller, 5000);
    assert!(controller.outputs.G <= before.outputs.G);
    assert!(controller.outputs.e_nr < before.outputs.e_nr);
}

#[test]
fn refusals_name_the_variable_the_value_and_the_range() {
    type Change = fn(&mut TestbedController);
    let cases: [(Change, &str); 19] = [
        (
            |c| c.parameters.law = 9,
            "law = 9: expected 1 (standard), 2 (passive), 3 (passive_applied), 4 (passive_bounded), 5 (natural), 6 (sliding_mode)",
        ),
        (
            |c| (c.parameters.law, c.comparator.M) = (5, 0.0),
            "comparator.M = 0: expected a finite value, at least 1e-6",
        ),
        (
            |c| (c.parameters.law, c.comparator.H) = (6, -1.0),
            "comparator.H = -1: expected a finite value not less than 0",
        ),
        (
            |c| (c.parameters.law, c.parameters.K_P) = (6, 0.0),
            "K_P = 0: expected a finite value, at least 1e-6",
        ),
        (
            |c| (c.parameters.law, c.parameters.T) = (5, -1.0),
            "T = -1: expected a finite value, at least 1e-6",
        ),
        (
            |c| c.parameters.form = 3,
            "form = 3: expected 1 (torque), 2 (position_servo)",
        ),
        (
            |c| (c.parameters.law, c.parameters.form) = (2, 2),
            "law = 2 (passive) has no servo form: expected 1 (standard), 3 (passive_applied), 4 (passive_bounded)",
        ),
        (
            |c| (c.parameters.law, c.parameters.dq_n_max) = (5, 0.5),
            "dq_n_max = 0.5: expected no limit, which the laws 1 to 4 in torque form alone keep",
        ),
        (
            |c| (c.parameters.form, c.parameters.tau_rate_max) = (2, 50.0),
            "tau_rate_max = 50: expected no limit, which the laws 1 to 4 in torque form alone keep",
        ),
        (
            |c| (c.parameters.law, c.parameters.q_n_box) = (6, 1),
            "q_n_min = -1: expected no limit, which the laws 1 to 4 in torque form alone keep",
        ),
        (
            |c| (c.parameters.dq_n_max, c.parameters.tau_rate_max) = (0.5, -1.0),
            "tau_rate_max = -1: expected a finite value not less than 0",
        ),
        (
            |c| (c.parameters.law, c.parameters.form) = (5, 2),
            "law = 5 (natural) has no servo form: expected 1 (standard), 3 (passive_applied), 4 (passive_bounded)",
        ),
        (
            |c| c.parameters.T = 0.0,
            "T = 0: expected a finite value, at least 1e-6",
        ),
        (
            |c| c.parameters.M_n = f64::NAN,
            "M_n = NaN: expected a finite value, at least 1e-6",
        ),
        (
            |c| c.parameters.D_n = -0.1,
            "D_n = -0.1: expected a finite value not less than 0",
        ),
        (
            |c| c.parameters.K = f64::INFINITY,
            "K = inf: expected a finite value, at least 1e-6",
        ),
        (
            |c| c.parameters.tau_max = 0.0,
            "tau_max = 0: expected a finite value, at least 1e-6",
        ),
        (
            |c| c.parameters.E_0 = -1.0,
            "energy.E_0 = -1: expected a finite value not less than 0",
        ),
        (|c| c.parameters.delay = 2, "delay = 2: expected 0 or 1"),
    ];
    for (change, expected) in cases {
        let refusal = controller(change)
            .initialize(0.0, &mut Log::silent())
            .expect_err(expected);
        assert_eq!(refusal.0, expected);
    }
}

#[test]
fn a_refused_gain_leaves_the_law_as_it_was() {
    let (mut tuned, mut untouched) = (
        initialized(|c| c.inputs.tau_h = 6.0),
        initialized(|c| c.inputs.tau_h = 6.0),
    );
    tuned.parameters.K = -1.0;
    assert_eq!(
        tuned.tune(&mut Log::silent()).expect_err("negative").0,
        "K = -1: expected a finite value, at least 1e-6"
    );
    tuned.parameters.K = untouched.parameters.K; // as the C interface restores it
    for k in 0..10 {
        tick(&mut tuned, k);
        tick(&mut untouched, k);
    }
    assert_eq!(tuned, untouched);
}

#[test]
fn a_force_beyond_arithmetic_fails_the_step_instead_of_reaching_the_robot() {
    let mut controller =
        initialized(|c| (c.parameters.law, c.parameters.K, c.inputs.tau_h) = (1, 1e300, 1e300));
    let failure = controller
        .step(Step::at(0.0, 0.02), &mut Log::silent())
        .expect_err("an overflow");
    assert!(
        failure.0.contains("is not finite") && failure.0.contains("tau_h = 1e300 N"),
        "{failure}"
    );
    assert_eq!(controller.outputs.tau_a, 0.0);
}

#[test]
fn with_alpha_zero_the_energy_is_not_defined_and_shown_as_zero() {
    let mut controller = initialized(|c| (c.parameters.alpha, c.inputs.tau_h) = (0.0, 6.0));
    assert_eq!(controller.outputs.tank, 0.0);
    (0..100).for_each(|k| tick(&mut controller, k));
    assert_eq!(
        (
            controller.outputs.H,
            controller.outputs.G,
            controller.outputs.tank
        ),
        (0.0, 0.0, 0.0)
    );
    assert!(controller.outputs.tau_a > 0.0);
}

#[test]
fn the_ledger_knows_of_a_delayed_force_and_the_force_is_the_same() {
    let run = |delay| {
        let mut controller = initialized(|c| (c.parameters.delay, c.inputs.tau_h) = (delay, 6.0));
        let mut forces = Vec::new();
        for k in 0..500 {
            controller.inputs.q = 1e-4 * f64::from(k);
            tick(&mut controller, k);
            forces.push(controller.outputs.tau_a);
        }
        (forces, controller.outputs.G)
    };
    let ((forces, direct), (delayed_forces, delayed)) = (run(0), run(1));
    assert_eq!(forces, delayed_forces);
    // Over equal ways of 1e-4 m, Σ (tau_k − tau_{k−1})·Δq is the last force that has worked so far, that of tick 498.
    let expected = 1e-4 * forces[498];
    assert!(expected > 1e-5);
    assert!(
        (direct - delayed - expected).abs() < 1e-12,
        "{}",
        direct - delayed
    ); // 500 roundings of some 1e-2 J
}

#[test]
fn start_values_lie_within_their_bounds_and_names_are_unique() {
    let start = TestbedController::default();
    let mut names = std::collections::HashSet::new();
    for scalar in TestbedController::DESCRIPTION.scalars() {
        assert!(
            names.insert(scalar.name().to_lowercase()),
            "{} twice",
            scalar.name()
        );
        assert!(
            !scalar.variable.about.is_empty(),
            "{} without description",
            scalar.name()
        );
        match scalar.variable.access {
            Access::Real { range, at, .. } => {
                let value = at.get(&start, scalar.element);
                assert!(range.contains(value), "{} = {value}", scalar.name());
            }
            Access::Integer { min, max, at } => {
                let value = at.get(&start, scalar.element);
                assert!(min <= value && value <= max, "{} = {value}", scalar.name());
            }
            Access::Enumeration { of, at, .. } => {
                let value = at.get(&start, scalar.element);
                assert!(
                    of.items.iter().any(|item| item.value == value),
                    "{} = {value}",
                    scalar.name()
                );
            }
            Access::Wide { .. } | Access::Binary { .. } => panic!("no row is one"),
            Access::Boolean { .. } | Access::String { .. } => {}
        }
    }
}

#[test]
fn the_enumeration_has_the_laws_numbers_and_names() {
    let declared: Vec<_> = LAW
        .items
        .iter()
        .map(|item| (item.value, item.name))
        .collect();
    let laws = admittance::Law::ALL.map(|law| (law.number(), law.name()));
    assert_eq!(declared, laws);
}

#[test]
fn gain_warning_follows_the_gains_at_start_and_at_each_change() {
    assert_eq!(initialized(|_| ()).gain_warning, 0);
    // The lightest nominal of the wall scenario, and K T/M_min = 0.5.
    assert_eq!(initialized(|c| c.parameters.M_n = 0.1).gain_warning, 2);
    let mut controller = initialized(|c| c.parameters.K = 1500.0);
    assert_eq!(controller.gain_warning, 1);
    controller.parameters.M_n = 0.1;
    controller.tune(&mut Log::silent()).expect("valid gains");
    assert_eq!(controller.gain_warning, 3);
    (controller.parameters.K, controller.parameters.M_n) = (30.0, 5.0);
    controller.tune(&mut Log::silent()).expect("valid gains");
    assert_eq!(controller.gain_warning, 0);
    assert_eq!(initialized(|c| c.parameters.M_min = 60.0).gain_warning, 2);
}

#[test]
fn limits_keep_the_nominal_and_say_so() {
    // Pushed freely with 6 N: the nominal would reach 12 m/s.
    let run = |change: fn(&mut TestbedController)| {
        let mut controller = initialized(|c| {
            c.inputs.tau_h = 6.0;
            c.parameters.tau_max = 1e3;
            change(c);
        });
        let (mut dq, mut largest_step, mut before) = (0.0, 0.0_f64, 0.0);
        for k in 0..2000 {
            tick(&mut controller, k);
            largest_step = largest_step.max((controller.outputs.tau_a - before).abs());
            before = controller.outputs.tau_a;
            dq += (controller.outputs.tau_a + 6.0) / 6.0 * 0.002;
            controller.inputs.q += 0.002 * dq;
        }
        (controller, largest_step)
    };
    let (free, free_step) = run(|_| {});
    assert!(free.outputs.dq_n > 1.0 && free.outputs.held == 0 && free.outputs.share == 1.0);
    let (slow, _) = run(|c| c.parameters.dq_n_max = 0.25);
    assert!(slow.outputs.dq_n == 0.25 && slow.outputs.held != 0);
    let (boxed, _) = run(|c| (c.parameters.q_n_box, c.parameters.q_n_max) = (1, 0.1));
    assert!((boxed.outputs.q_n - 0.1).abs() < 1e-15 && boxed.outputs.held != 0);
    let (rated, rated_step) = run(|c| c.parameters.tau_rate_max = 2.0);
    assert!(rated.outputs.held == 0 && rated_step <= 2.0 * 0.002 * (1.0 + 1e-9)); // differences of some N
    assert!(free_step > 2.0 * rated_step);
    let (held, _) = run(|c| c.inputs.hold = 1);
    assert!(held.outputs.q_n == 0.0 && held.outputs.held != 0);
    for controller in [free, slow, boxed, rated, held] {
        assert!(controller.outputs.tank >= 0.0 && controller.outputs.debt == 0);
    }
}
