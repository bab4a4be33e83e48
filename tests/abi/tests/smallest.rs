//! The smallest example, `modelDescription/export/examples/integrator.rs`, packed by `cargo xtask fmu`: an FMU like any other.

use abi::fmu::directory;
use abi::{Fmu, Status};

#[test]
fn the_smallest_example_is_an_fmu_that_integrates() {
    let fmu = Fmu::open_in(&directory().join("test"), "integrator");
    let names: Vec<_> = fmu.variables.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["u", "y", "version", "git_hash"]);
    let integrator = fmu.instantiate();
    integrator.initialize(0.0);
    // Powers of two: every product and sum is exact.
    let (h, mut y) = (0.125, 0.0);
    for k in 0..40 {
        let u = f64::from(k) - 10.0;
        assert_eq!(integrator.set_real(&[fmu.reference("u")], &[u]), Status::OK);
        assert_eq!(integrator.step(f64::from(k) * h, h), Status::OK);
        y += u * h;
        assert_eq!(integrator.real(fmu.reference("y")), y);
    }
    assert_eq!(y, 47.5, "0.125 times the sum of -10 to 29");
}

#[test]
fn the_smallest_example_has_at_most_40_lines() {
    let text = include_str!("../../../modelDescription/export/examples/integrator.rs");
    assert!(text.lines().count() <= 40);
}
