//! The loop in native Rust: against the linked models, and its command line.

use fmu_export::{Log, Model, Step};
use std::path::Path;
use std::process::{Command, Output};
use testbed::Testbed;
use testbed_controller::TestbedController;

const T: f64 = 0.002;

/// tau_h (N) and tau_d (N) of tick k: into the wall, with a disturbance from 0.6 s on.
fn forces(k: u32) -> (f64, f64) {
    let t = f64::from(k) * T;
    let tau_d = if t < 0.6 { 0.0 } else { 3.0 * (9.0 * t).sin() };
    (6.0 * (1.5 * t).cos(), tau_d)
}

/// Runs the program over `n` ticks in `folder`.
fn native_loop(folder: &Path, n: u32, more: &[&str]) -> Output {
    let mut input = String::from("t,tau_h,tau_d\n");
    for k in 0..n {
        let (tau_h, tau_d) = forces(k);
        input += &format!("{:e},{tau_h:e},{tau_d:e}\n", f64::from(k) * T);
    }
    std::fs::write(folder.join("in.csv"), input).expect("written");
    Command::new(env!("CARGO_BIN_EXE_native_loop"))
        .current_dir(folder)
        .arg("--fmu-dir")
        .arg(std::path::absolute(abi::fmu::directory()).expect("a path"))
        .args(["--input", "in.csv", "--output", "out.csv"])
        .args(more)
        .output()
        .expect("the program can be started")
}

/// The same loop with the models linked into this process.
fn linked(n: u32, law: i32, mass: f64) -> Vec<[f64; 6]> {
    let mut log = Log::silent();
    let (mut controller, mut plant) = (TestbedController::default(), Testbed::default());
    (controller.parameters.law, plant.parameters.M) = (law, mass);
    (controller.inputs.tau_h, plant.forces.tau_h) = (forces(0).0, forces(0).0);
    plant.initialize(0.0, &mut log).expect("start values");
    controller.inputs.q = plant.outputs.q;
    controller.initialize(0.0, &mut log).expect("start values");
    (0..n)
        .map(|k| {
            let step = Step::at(f64::from(k) * T, T);
            let (tau_h, tau_d) = forces(k);
            (controller.inputs.q, controller.inputs.tau_h) = (plant.outputs.q, tau_h);
            controller.step(step, &mut log).expect("a step");
            let q = plant.outputs.q;
            plant.forces.tau_a = controller.outputs.tau_a;
            (plant.forces.tau_h, plant.forces.tau_d) = (tau_h, tau_d);
            plant.step(step, &mut log).expect("a step");
            let c = &controller;
            [
                step.t,
                q,
                c.outputs.q_n,
                c.outputs.e_nr,
                c.outputs.tau_a,
                c.outputs.G,
            ]
        })
        .collect()
}

#[test]
fn the_loop_by_dlopen_equals_the_loop_of_the_linked_models() {
    let n = 1500;
    for (law, mass) in [(4, 6.0), (2, 3.5)] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (law_text, mass_text) = (format!("controller.law={law}"), format!("testbed.M={mass}"));
        let output = native_loop(folder.path(), n, &["--set", &law_text, "--set", &mass_text]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && stderr.is_empty(), "{stderr}");
        let text = std::fs::read_to_string(folder.path().join("out.csv")).expect("written");
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("t,q,q_n,e_nr,tau_a,energy.G"));
        let expected = linked(n, law, mass);
        assert!(
            expected.iter().any(|row| row[1] > 0.299),
            "the wall is reached"
        );
        assert_eq!(lines.clone().count(), expected.len());
        for (line, expected) in lines.zip(expected) {
            let got: Vec<f64> = line
                .split(',')
                .map(|n| n.parse().expect("a number"))
                .collect();
            for (got, expected) in got.iter().zip(expected) {
                // The libraries are optimized, this test is not; both add and multiply in the order of the source, so
                // only a fused or reordered operation could differ.
                assert!(
                    (got - expected).abs() <= 1e-12,
                    "law {law}: {line}, expected {expected:?}"
                );
            }
        }
    }
}

#[test]
fn mistakes_on_the_command_line_are_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (more, part) in [
        (&["--set", "controller.K_Q=1"][..], "K_Q"),
        (&["--set", "plant.M=1"], "plant.M=1"),
        (&["--set", "controller.law=2.5"], "law"),
        (&["--set", "controller.law=9"], "law = 9"),
        (&["--set", "testbed.M=-1"], "M = -1"),
        (&["--speed", "9"], "--speed"),
        (&["--set"], "--set needs a value"),
    ] {
        let output = native_loop(folder.path(), 3, more);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{more:?}");
        assert!(stderr.contains(part), "{more:?}: {stderr}");
        assert!(!folder.path().join("out.csv").exists());
    }
}
