//! Get and Set: which values and variables are accepted, and what a refusal says. A refused call changes nothing.

use abi::refusal::refused;
use abi::{Fmu, Kind, Phase, Status};
use std::ptr::null;

#[test]
fn nan_and_infinity_are_refused_by_every_real_and_name_it() {
    for fmu in Fmu::all() {
        let instance = Phase::Instantiated.enter(&fmu);
        let settable = |v: &&abi::Variable| matches!(v.causality.as_str(), "input" | "parameter");
        for v in fmu.variables.iter().filter(settable) {
            if v.kind != (Kind::Real {}) {
                continue;
            }
            for (value, text) in [
                (f64::NAN, "NaN"),
                (f64::INFINITY, "inf"),
                (-f64::INFINITY, "-inf"),
            ] {
                if fmu.takes_nan(v) {
                    assert_eq!(instance.set_real(&[v.reference], &[value]), Status::OK);
                    continue;
                }
                let part = format!("{} = {text}", v.name);
                refused(&instance, "fmi2SetReal", &[&part, "finite"], |i| {
                    i.set_real(&[v.reference], &[value])
                });
            }
        }
    }
}

#[test]
fn inputs_are_checked_during_the_run_too() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        for v in fmu
            .variables
            .iter()
            .filter(|v| v.causality == "input" && v.kind == (Kind::Real {}))
        {
            if fmu.takes_nan(v) {
                continue;
            }
            refused(&instance, "fmi2SetReal", &[&v.name, "NaN"], |i| {
                i.set_real(&[v.reference], &[f64::NAN])
            });
        }
        assert_eq!(instance.step(0.0, 0.002), Status::OK);
    }
}

#[test]
fn bounds_are_included_and_beyond_them_is_refused() {
    let fmu = Fmu::lag();
    let instance = Phase::Instantiated.enter(&fmu);
    let (tau, gain) = (fmu.reference("tau"), fmu.reference("gain"));
    for (reference, value) in [(tau, 1e-6), (tau, 1e6), (gain, -1e3), (gain, 1e3)] {
        assert_eq!(instance.set_real(&[reference], &[value]), Status::OK);
        assert_eq!(instance.real(reference), value);
    }
    for (reference, value, parts) in [
        (tau, 0.999_999e-6, ["tau = ", "from 0.000001 to 1000000"]),
        (
            tau,
            1_000_000.1,
            ["tau = 1000000.1 s", "from 0.000001 to 1000000"],
        ),
        (gain, -1000.5, ["gain = -1000.5", "from -1000 to 1000"]),
        (gain, 1000.5, ["gain = 1000.5", "from -1000 to 1000"]),
    ] {
        refused(&instance, "fmi2SetReal", &parts, |i| {
            i.set_real(&[reference], &[value])
        });
    }
}

#[test]
fn a_boolean_other_than_0_and_1_is_refused_by_name() {
    let mut tried = 0;
    for fmu in Fmu::all() {
        let instance = Phase::Instantiated.enter(&fmu);
        let settable = |v: &&abi::Variable| matches!(v.causality.as_str(), "input" | "parameter");
        for v in fmu.variables.iter().filter(settable) {
            if v.kind != (Kind::Boolean {}) {
                continue;
            }
            let before = instance.boolean(v.reference);
            for value in [0x100, -1, 2, i32::MIN, i32::MAX] {
                let part = format!("{} = {value}, expected 0 or 1", v.name);
                refused(&instance, "fmi2SetBoolean", &[&part], |i| {
                    i.set_boolean(&[v.reference], &[value])
                });
                assert_eq!(instance.boolean(v.reference), before);
            }
            for value in [1, 0, before] {
                assert_eq!(instance.set_boolean(&[v.reference], &[value]), Status::OK);
                assert_eq!(instance.boolean(v.reference), value);
            }
            tried += 1;
        }
    }
    assert!(tried > 10, "{tried} Booleans");
}

#[test]
fn an_enumeration_accepts_its_items_only() {
    for (fmu, name, items) in [
        (Fmu::lag(), "method", 2),
        (Fmu::open("TestbedController"), "law", 6),
    ] {
        let instance = Phase::Instantiated.enter(&fmu);
        let reference = fmu.reference(name);
        for item in 1..=items {
            assert_eq!(instance.set_integer(&[reference], &[item]), Status::OK);
            assert_eq!(instance.integer(reference), item);
        }
        for value in [0, items + 1, -1, i32::MIN, i32::MAX] {
            let part = format!("{name} = {value}");
            refused(&instance, "fmi2SetInteger", &[&part, "1 "], |i| {
                i.set_integer(&[reference], &[value])
            });
        }
    }
}

#[test]
fn every_variable_answers_to_its_own_type_only() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        for v in &fmu.variables {
            let r = [v.reference];
            let results = [
                (
                    instance.get_real(&r).is_ok(),
                    v.kind == Kind::Real {},
                    "fmi2GetReal",
                ),
                (
                    instance.get_integer(&r).is_ok(),
                    matches!(v.kind, Kind::Integer {} | Kind::Enumeration {}),
                    "fmi2GetInteger",
                ),
                (
                    instance.get_boolean(&r).is_ok(),
                    v.kind == Kind::Boolean {},
                    "fmi2GetBoolean",
                ),
            ];
            let mut refusals = 0;
            for (got, expected, function) in results {
                assert_eq!(got, expected, "{} {} {function}", fmu.name, v.name);
                refusals += usize::from(!expected);
            }
            let log = instance.messages();
            assert_eq!(log.len(), refusals, "{log:?}");
            for message in log {
                assert!(
                    message.text.contains(&v.name) && message.text.contains("not of type"),
                    "{message:?}"
                );
            }
        }
    }
}

#[test]
fn outputs_and_fixed_parameters_say_why_they_cannot_be_set() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    refused(
        &instance,
        "fmi2SetReal",
        &["y ", "computed by the model"],
        |i| i.set_real(&[fmu.reference("y")], &[1.0]),
    );
    refused(
        &instance,
        "fmi2SetReal",
        &["tau ", "fixed parameter"],
        |i| i.set_real(&[fmu.reference("tau")], &[1.0]),
    );
}

#[test]
fn unknown_value_references_are_refused_by_all_eight_functions() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        let rows = fmu
            .variables
            .iter()
            .map(|v| v.reference / 256)
            .max()
            .expect("variables")
            + 1;
        // No first row has 200 elements.
        for r in [200, 255, 256 * rows, u32::MAX] {
            let name = r.to_string();
            let parts = [name.as_str(), "value reference"];
            refused(&instance, "fmi2GetReal", &parts, |i| {
                i.get_real(&[r]).expect_err("unknown")
            });
            refused(&instance, "fmi2GetInteger", &parts, |i| {
                i.get_integer(&[r]).expect_err("unknown")
            });
            refused(&instance, "fmi2GetBoolean", &parts, |i| {
                i.get_boolean(&[r]).expect_err("unknown")
            });
            refused(&instance, "fmi2GetString", &parts, |i| {
                let mut value = null();
                // SAFETY: pointers to locals, one element each.
                unsafe {
                    (i.library().fmi2GetString)(i.component(), &raw const r, 1, &raw mut value)
                }
            });
            refused(&instance, "fmi2SetReal", &parts, |i| {
                i.set_real(&[r], &[0.0])
            });
            refused(&instance, "fmi2SetInteger", &parts, |i| {
                i.set_integer(&[r], &[0])
            });
            refused(&instance, "fmi2SetBoolean", &parts, |i| {
                i.set_boolean(&[r], &[0])
            });
            refused(&instance, "fmi2SetString", &parts, |i| {
                i.set_string(r, "text")
            });
        }
    }
}

#[test]
fn one_bad_element_refuses_the_whole_array_wherever_it_stands() {
    let fmu = Fmu::lag();
    let instance = Phase::Instantiated.enter(&fmu);
    let names = ["u", "tau", "gain"];
    let references = fmu.references(names);
    for (bad, name) in names.iter().enumerate() {
        let mut values = [2.0, 3.0, 4.0];
        values[bad] = f64::NAN;
        refused(&instance, "fmi2SetReal", &[&format!("{name} = NaN")], |i| {
            i.set_real(&references, &values)
        });
    }
    refused(&instance, "fmi2SetReal", &["y "], |i| {
        i.set_real(&[references[0], fmu.reference("y")], &[2.0, 2.0])
    });
    assert_eq!(instance.set_real(&references, &[2.0, 3.0, 4.0]), Status::OK);
    assert_eq!(instance.get_real(&references), Ok(vec![2.0, 3.0, 4.0]));
}

#[test]
fn a_value_that_only_the_model_can_object_to_is_refused_and_everything_set_with_it_restored() {
    let fmu = Fmu::lag();
    let instance = Phase::StepComplete.enter(&fmu);
    refused(&instance, "fmi2SetReal", &["gain = 13"], |i| {
        i.set_real(&fmu.references(["u", "gain"]), &[5.0, 13.0])
    });
    assert_eq!(instance.step(0.0, 0.01), Status::OK);
    assert_eq!(instance.real(fmu.reference("y")), 0.0, "u = 0 still");
}

#[test]
fn laws_that_are_not_offered_are_refused_and_change_nothing() {
    let fmu = Fmu::open("ArmController");
    let law = fmu.reference("law");
    for item in [5, 6, 7] {
        let instance = fmu.instantiate();
        let named = ["law", &item.to_string(), "passive_bounded"].map(str::to_owned);
        refused(
            &instance,
            "fmi2SetInteger",
            &named.each_ref().map(String::as_str),
            |i| i.set_integer(&[law], &[item]),
        );
        assert_eq!(instance.get_integer(&[law]), Ok(vec![4]));
        assert_eq!(instance.enter_initialization_mode(), Status::OK);
        assert_eq!(instance.exit_initialization_mode(), Status::OK);
        assert_eq!(instance.step(0.0, 0.001), Status::OK);
    }
}
