//! The rights matrix ([`abi::rights`]): every variable of every committed description, in every phase, by Set and Get.

use abi::rights::{readable, settable};
use abi::{Fmu, Instance, Kind, Phase, Status, Variable};

/// A value of a variable, compared bit for bit.
#[derive(Clone, Debug, PartialEq)]
enum Value {
    Real(u64),
    Integer(i32),
    Boolean(i32),
    Text(String),
}

fn get(instance: &Instance, variable: &Variable) -> Value {
    let r = variable.reference;
    match variable.kind {
        Kind::Real {} => Value::Real(instance.real(r).to_bits()),
        Kind::Integer {} | Kind::Enumeration {} => Value::Integer(instance.integer(r)),
        Kind::Boolean {} => Value::Boolean(instance.boolean(r)),
        Kind::String {} => Value::Text(instance.string(r)),
    }
}

fn set(instance: &Instance, variable: &Variable, value: &Value) -> Status {
    let r = [variable.reference];
    match value {
        Value::Real(bits) => instance.set_real(&r, &[f64::from_bits(*bits)]),
        Value::Integer(value) => instance.set_integer(&r, &[*value]),
        Value::Boolean(value) => instance.set_boolean(&r, &[*value]),
        Value::Text(text) => instance.set_string(r[0], text),
    }
}

/// Another value than this one that the row's bounds allow.
fn another(variable: &Variable, value: &Value) -> Value {
    let (min, max) = variable.bounds.unwrap_or((f64::MIN, f64::MAX));
    match value {
        Value::Real(bits) => {
            let value = f64::from_bits(*bits);
            let step = 1e-3 * value.abs().max(1e-3);
            let other = [value + step, value - step, min, max]
                .into_iter()
                .find(|other| *other != value && (min..=max).contains(other));
            Value::Real(other.expect("more than one value").to_bits())
        }
        Value::Integer(value) if f64::from(*value) < max => Value::Integer(value + 1),
        Value::Integer(value) => Value::Integer(value - 1),
        Value::Boolean(value) => Value::Boolean(1 - value),
        Value::Text(text) => Value::Text(format!("{text}+")),
    }
}

#[test]
fn set_follows_causality_variability_and_phase_for_every_variable() {
    for fmu in Fmu::all() {
        let variables = fmu.committed_variables();
        for phase in Phase::ALL {
            for v in &variables {
                let cell = format!("{} {} in {phase:?}", fmu.name, v.name);
                let instance = phase.enter(&fmu);
                let value = get(&instance, v);
                let new = another(v, &value);
                let before = instance.bytes();
                instance.messages();
                if !settable(v, phase) {
                    assert_eq!(set(&instance, v, &new), Status::ERROR, "{cell}");
                    let text = instance.message();
                    assert!(text.starts_with("fmi2Set"), "{cell}: {text}");
                    assert!(
                        instance.bytes() == before,
                        "{cell}: a refused Set changed something"
                    );
                    assert_eq!(get(&instance, v), value, "{cell}");
                    continue;
                }
                // Before the run nothing but the right counts; during it a model may object to what it is told with a
                // parameter, never to the value it has.
                let new = if v.causality == "parameter" && phase == Phase::StepComplete {
                    value
                } else {
                    new
                };
                assert_eq!(
                    set(&instance, v, &new),
                    Status::OK,
                    "{cell}: {:?}",
                    instance.messages()
                );
                assert_eq!(get(&instance, v), new, "{cell}");
            }
        }
    }
}

#[test]
fn get_is_allowed_for_every_variable_in_every_phase_and_changes_nothing_but_initial_values() {
    for fmu in Fmu::all() {
        let variables = fmu.committed_variables();
        for phase in Phase::ALL {
            let instance = phase.enter(&fmu);
            // In Initialization Mode the first Get computes the initial values, which are then shown.
            get(&instance, &variables[0]);
            let before = instance.bytes();
            for v in &variables {
                assert!(readable(v, phase), "{} {} in {phase:?}", fmu.name, v.name);
                get(&instance, v);
            }
            assert!(
                instance.bytes() == before,
                "{} {phase:?}: reading changed something",
                fmu.name
            );
        }
    }
}

#[test]
fn a_refused_get_in_initialization_mode_computes_no_initial_values() {
    let mut computed = Vec::new();
    for fmu in Fmu::all() {
        let instance = Phase::InitializationMode.enter(&fmu);
        let real = |v: &&Variable| v.kind == (Kind::Real {});
        let inputs = fmu.variables.iter().filter(|v| v.causality == "input");
        for input in inputs.filter(real) {
            // So that there is something to compute.
            assert_eq!(instance.set_real(&[input.reference], &[0.5]), Status::OK);
        }
        let before = instance.bytes();
        let good = fmu.variables.iter().find(real).expect("a Real").reference;
        // A good one first: what comes before the bad one counts as little.
        assert_eq!(instance.get_real(&[good, u32::MAX]), Err(Status::ERROR));
        assert!(instance.bytes() == before, "{}", fmu.name);
        assert_eq!(
            instance.get_integer(&[good]),
            Err(Status::ERROR),
            "{}: type",
            fmu.name
        );
        assert!(instance.bytes() == before, "{}", fmu.name);
        assert!(instance.get_real(&[good]).is_ok());
        if instance.bytes() != before {
            computed.push(fmu.name.clone());
        }
    }
    // Without these the test would see nothing.
    assert!(
        computed.contains(&"Lag".to_owned()) && computed.len() > 3,
        "{computed:?}"
    );
}

#[test]
fn the_inputs_start_values_are_used_when_they_are_never_set() {
    for fmu in Fmu::products() {
        let instance = Phase::StepComplete.enter(&fmu);
        for v in fmu
            .committed_variables()
            .iter()
            .filter(|v| v.causality == "input")
        {
            let start = v
                .start
                .as_deref()
                .unwrap_or_else(|| panic!("{}: no start", v.name));
            let expected = match v.kind {
                Kind::Real {} => Value::Real(start.parse::<f64>().expect("a number").to_bits()),
                Kind::Boolean {} => Value::Boolean(i32::from(start == "true")),
                Kind::String {} => Value::Text(start.into()),
                Kind::Integer {} | Kind::Enumeration {} => {
                    Value::Integer(start.parse().expect("a number"))
                }
            };
            assert_eq!(get(&instance, v), expected, "{} {}", fmu.name, v.name);
        }
        assert_eq!(instance.step(0.0, fmu.step_size), Status::OK);
    }
}
