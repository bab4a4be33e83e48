//! A panic inside a model, provoked with the test model's switch.

use abi::types::{LAST_SUCCESSFUL_TIME, Real};
use abi::{Fmu, Phase, Status};
use std::process::Command;

#[test]
fn a_panic_is_an_error_and_its_text_is_in_the_log_without_printf_directives() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    assert_eq!(
        instance.set_boolean(&[fmu.reference("panic")], &[1]),
        Status::OK
    );
    assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
    let text = instance.message();
    assert!(
        text.starts_with("fmi2DoStep: panic in the model: "),
        "{text}"
    );
    assert!(
        text.contains("provoked with 100 percent certainty"),
        "{text}"
    );
    assert!(text.contains("lag.rs"), "where: {text}");
    assert!(text.contains("fmi2Reset"), "the way out: {text}");
}

#[test]
fn after_a_panic_values_can_be_read_and_steps_are_refused() {
    let fmu = Fmu::lag();
    let instance = Phase::Error.enter(&fmu);
    assert_eq!(instance.boolean(fmu.reference("panic")), 1);
    assert_eq!(instance.string(fmu.reference("label")), "lag");
    let mut time: Real = -1.0;
    // SAFETY: the value is a local.
    let status = unsafe {
        (fmu.library.fmi2GetRealStatus)(instance.component(), LAST_SUCCESSFUL_TIME, &raw mut time)
    };
    assert_eq!((status, time), (Status::OK, 0.0));
    assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
    assert!(
        instance
            .message()
            .contains("not legal in the phase 'error'")
    );
}

/// The same three steps; the last y.
fn run(fmu: &Fmu, instance: &abi::Instance) -> f64 {
    assert_eq!(instance.set_real(&[fmu.reference("u")], &[1.0]), Status::OK);
    instance.initialize(0.0);
    for t in [0.0, 0.25, 0.5] {
        assert_eq!(
            instance.set_real(&[fmu.reference("u")], &[2.0 - t]),
            Status::OK
        );
        assert_eq!(instance.step(t, 0.25), Status::OK);
    }
    instance.real(fmu.reference("y"))
}

#[test]
fn reset_recovers_from_a_panic() {
    let fmu = Fmu::lag();
    let untouched = run(&fmu, &fmu.instantiate());
    let instance = Phase::Error.enter(&fmu);
    assert_eq!(instance.reset(), Status::OK);
    assert_eq!(run(&fmu, &instance).to_bits(), untouched.to_bits());
}

#[test]
fn a_state_from_before_recovers_from_a_panic() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    let mut before = instance.state();
    let bytes = instance.bytes();
    assert_eq!(
        instance.set_boolean(&[fmu.reference("panic")], &[1]),
        Status::OK
    );
    assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
    assert_eq!(instance.set_state(before), Status::OK);
    assert_eq!(instance.bytes(), bytes);
    assert_eq!(instance.step(0.0, 0.01), Status::OK);
    assert_eq!(instance.free_state(&mut before), Status::OK);
}

#[test]
fn one_instance_s_panic_leaves_the_others_alone() {
    let fmu = Fmu::lag();
    let other = fmu.instantiate();
    let broken = Phase::Error.enter(&fmu);
    let untouched = run(&fmu, &fmu.instantiate());
    assert_eq!(run(&fmu, &other).to_bits(), untouched.to_bits());
    drop(broken);
}

/// Runs the ignored test `name` of this file in a process of its own: its exit, stdout and stderr.
fn in_a_process_of_its_own(name: &str) -> (bool, String, String) {
    let output = Command::new(std::env::current_exe().expect("a path"))
        .args(["--ignored", "--exact", name, "--nocapture"])
        .output()
        .expect("this test can be started");
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.success(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

#[test]
fn nothing_is_written_to_the_standard_streams() {
    let (success, stdout, stderr) = in_a_process_of_its_own("refusals_and_panics");
    assert!(success && stdout.contains("1 passed"), "{stdout}{stderr}");
    assert_eq!(stderr, "");
    assert!(
        !stdout.contains("provoked") && !stdout.contains("fmi2"),
        "{stdout}"
    );
}

#[test]
#[ignore = "the body of nothing_is_written_to_the_standard_streams, in a process of its own"]
fn refusals_and_panics() {
    let fmu = Fmu::lag();
    let broken = Phase::Error.enter(&fmu);
    assert_eq!(broken.step(f64::NAN, f64::NAN), Status::ERROR);
    drop(broken);
    // With nobody to tell, too.
    let silent = fmu.instantiate_as(&abi::Setup {
        logger: false,
        ..fmu.setup()
    });
    silent.initialize(0.0);
    assert_eq!(
        silent.set_boolean(&[fmu.reference("panic")], &[1]),
        Status::OK
    );
    assert_eq!(silent.step(0.0, 0.01), Status::ERROR);
    for fmu in Fmu::products() {
        let instance = fmu.instantiate();
        assert_eq!(instance.step(0.0, 0.01), Status::ERROR);
        instance.initialize(0.0);
        assert_eq!(instance.step(0.0, 0.01), Status::OK);
    }
}

#[test]
fn a_library_may_be_closed_before_the_thread_ends_that_saw_its_panic() {
    // The panic's text lies in thread-local memory of the library, whose destructor runs when the thread ends.
    let (success, stdout, stderr) = in_a_process_of_its_own("a_thread_that_outlives_the_library");
    assert!(success && stdout.contains("1 passed"), "{stdout}{stderr}");
}

#[test]
#[ignore = "the body of a_library_may_be_closed_before_the_thread_ends_that_saw_its_panic"]
fn a_thread_that_outlives_the_library() {
    for _ in 0..3 {
        std::thread::spawn(|| {
            let fmu = Fmu::lag();
            drop(Phase::Error.enter(&fmu));
            drop(fmu);
        })
        .join()
        .expect("the thread ends in peace");
    }
}
