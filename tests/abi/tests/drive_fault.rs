//! What the controllers in servo form say of a measured force that is none.

use abi::Fmu;
use abi::Kind;

/// A testbed controller in servo form, pushed with 5 N against a wall for two seconds, `tau_a_measured` being what the drive
/// gives there times `factor`: the warnings, and `drive.fault` at the end.
fn at_a_wall(factor: f64) -> (Vec<String>, i32) {
    let fmu = Fmu::named("TestbedController");
    let [q, tau_h, measured] = fmu.references(["q", "tau_h", "tau_a_measured"]);
    let [q_d, dq_d] = fmu.references(["q_d", "dq_d"]);
    let instance = fmu.instantiate();
    assert_eq!(fmu.variable("form").kind, Kind::Integer {});
    instance.set_integer(&[fmu.reference("form")], &[2]);
    instance.initialize(0.0);
    instance.messages();
    let mut tau = 0.0_f64;
    for k in 0..1000_u32 {
        instance.set_real(&[q, tau_h, measured], &[0.3, 5.0, factor * tau]);
        instance.step(f64::from(k) * 0.002, 0.002);
        let told = [q_d, dq_d].map(|reference| instance.real(reference));
        tau = (30.0 * (told[1] + 10.0 * (told[0] - 0.3))).clamp(-12.5, 12.5);
    }
    let of_warnings = |message: abi::messages::Message| {
        (message.category == "logStatusWarning").then_some(message.text)
    };
    let warnings = instance.messages().into_iter().filter_map(of_warnings);
    (
        warnings.collect(),
        instance.integer(fmu.reference("drive.fault")),
    )
}

#[test]
fn a_measured_force_that_is_none_is_named_by_one_line() {
    assert_eq!(at_a_wall(1.0), (vec![], 0));
    for (factor, number, name) in [(0.0, 1, "missing"), (-1.0, 2, "wrong_sign")] {
        let (warnings, fault) = at_a_wall(factor);
        assert_eq!(fault, number);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        let begins = format!("drive.fault = {number} ({name}): tau_a_measured");
        assert!(warnings[0].starts_with(&begins), "{warnings:?}");
    }
}
