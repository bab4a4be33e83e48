//! The arm controller as a model.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod axes;
mod encoders;
mod energy;
mod force_sensor;
mod inside;
mod joint_space;
mod limits;
mod refusals;
mod robot;
mod rows;
#[path = "../../../../tests/controllers/samples.rs"]
mod samples;
mod servo;
mod singularity;
mod start;
mod stiff_hand;
mod supervision;
mod ticks;
mod tuning;
mod workspace;

use arm_controller::ArmController;
use arm_controller::ArmController as Controller;
use fmu_export::{Log, Model, Step};

/// Sample period of the default controller, s.
const T: f64 = 0.001;

fn controller(change: impl FnOnce(&mut ArmController)) -> ArmController {
    let mut controller = ArmController::default();
    change(&mut controller);
    controller
}

fn initialized(change: impl FnOnce(&mut ArmController)) -> ArmController {
    let mut controller = controller(change);
    controller
        .initialize(0.0, &mut Log::silent())
        .expect("valid parameters");
    controller
}

/// Step number `k` of length `h` (s) from 0 on.
fn step(controller: &mut ArmController, k: u32, h: f64) {
    let step = Step::at(f64::from(k) * h, h);
    controller.step(step, &mut Log::silent()).expect("a step");
}

/// The human pushes.
fn pushed(controller: &mut Controller) {
    controller.inputs.f_h = [3.0, -2.0, 5.0];
}

/// Another force and another position.
fn told_otherwise(controller: &mut Controller) {
    controller.inputs.f_h = [-100.0; 3];
    controller.inputs.q = [0.0; 3];
}

/// One tick a step.
fn tick(controller: &mut ArmController, k: u32) {
    step(controller, k, T);
    assert_eq!(controller.tick, k as i32);
}
