//! FMI 3.0: values by value reference. What the library takes and gives is what the declarations say, and nothing else.

use abi::Status;
use abi::fmi3::types::{CLOCK, TIME};
use abi::fmi3::{Fmu, Instance, Interface, Row, Type, Value};
use fmu_archive::entry::Kind;
use std::ptr::{null, null_mut};

/// Asserts that a call is refused with one message that has all `parts`, and that nothing changes.
#[track_caller]
fn refused(instance: &Instance, parts: &[&str], call: impl FnOnce(&Instance) -> Status) {
    let before = instance.bytes();
    instance.messages();
    assert_eq!(call(instance), Status::ERROR, "{parts:?}");
    let text = instance.message();
    for part in parts {
        assert!(text.contains(part), "{part} is not in '{text}'");
    }
    assert_eq!(instance.bytes(), before, "{parts:?} changed something");
}

#[test]
fn a_row_has_the_type_and_the_size_that_its_declaration_gives_it() {
    for declared in catalogue::FMUS {
        let interface = declared.interface().expect("a legal declaration");
        let fmu = Fmu::new(abi::Fmu::open(declared.name));
        let instance = fmu.instantiate();
        for row in &fmu.rows {
            let scalars = interface.scalars.iter();
            let mut scalars = scalars.filter(|one| one.row.replace("[i]", "") == row.name);
            let scalar = scalars.next().unwrap_or_else(|| panic!("no {}", row.name));
            let expected = match &scalar.kind {
                Kind::Real { single: true, .. } => Type::Float32,
                Kind::Real { .. } => Type::Float64,
                Kind::Integer { of, .. } => *Type::INTEGERS
                    .iter()
                    .find(|kind| format!("{kind:?}") == of.name())
                    .expect("of FMI 2.0"),
                Kind::Enumeration { .. } => Type::Enumeration,
                Kind::Boolean { .. } => Type::Boolean,
                Kind::String { .. } => Type::Text,
                Kind::Binary { .. } => panic!("FMI 2.0 has no such type"),
            };
            let cell = format!("{} {}", fmu.name(), row.name);
            assert_eq!(row.kind, expected, "{cell}");
            assert_eq!(row.len(), 1 + scalars.count(), "{cell}");
            for kind in Type::ALL {
                let as_another = Row {
                    kind,
                    ..row.clone()
                };
                let (read, same) = (instance.read(&as_another), kind.is_called_as(expected));
                assert_eq!(read.is_ok(), same, "{cell} as {kind:?}");
            }
            instance.messages();
            refused(
                &instance,
                &["fmi3GetFloat32: ", "is not of type Float32"],
                |i| {
                    // SAFETY: nothing is written by a refused call; the component is live.
                    unsafe {
                        let vr = &raw const row.reference;
                        (i.library().fmi3GetFloat32)(i.component(), vr, 1, null_mut(), row.len())
                    }
                },
            );
        }
    }
}

#[test]
fn an_array_is_one_value_reference_and_its_elements_have_none() {
    let fmu = Fmu::new(abi::Fmu::open("ArmController"));
    let instance = fmu.instantiate();
    let q = fmu.row("q");
    assert_eq!(q.len(), 3);
    let set = [0.1, 0.2, 0.3].map(Value::Number);
    assert_eq!(
        instance.write(q, &set),
        Status::OK,
        "{:?}",
        instance.messages()
    );
    assert_eq!(instance.read(q), Ok(set.to_vec()));
    let second = Row {
        reference: q.reference + 1,
        elements: vec![q.elements[1].clone()],
        ..q.clone()
    };
    refused(
        &instance,
        &["fmi3SetFloat64: value reference", "is not one of"],
        |i| i.write(&second, &set[..1]),
    );
    for n in [0, 1, 2] {
        refused(&instance, &[&format!("nValues = {n}, expected 3")], |i| {
            i.write(q, &set[..n])
        });
    }
    let twice = [q.reference, q.reference];
    let mut values = [0.0; 6];
    // SAFETY: arrays of the lengths that are passed; the component is live.
    let status = unsafe {
        let (vr, v) = (twice.as_ptr(), values.as_mut_ptr());
        (instance.library().fmi3GetFloat64)(instance.component(), vr, 2, v, 6)
    };
    assert_eq!(status, Status::OK);
    assert_eq!(
        values,
        [0.1, 0.2, 0.3, 0.1, 0.2, 0.3],
        "serialized in the order of the references"
    );
}

#[test]
fn one_bad_element_refuses_the_whole_array_and_names_it() {
    let fmu = Fmu::new(abi::Fmu::open("ArmController"));
    let instance = fmu.instantiate();
    let (q, set) = (fmu.row("q"), [0.1, f64::NAN, 0.3].map(Value::Number));
    refused(
        &instance,
        &["q[2] = NaN rad, expected a finite value"],
        |i| i.write(q, &set),
    );
}

#[test]
fn booleans_are_bytes_0_and_1_and_items_are_those_of_the_enumeration() {
    let fmu = Fmu::new(abi::Fmu::open("TestbedController"));
    let instance = fmu.instantiate();
    let engage = fmu.row("engage");
    for byte in [2, 0x80, 0xFF] {
        refused(
            &instance,
            &["engage", &format!("= {byte}, expected 0 or 1")],
            |i| i.write(engage, &[Value::Truth(byte)]),
        );
    }
    assert_eq!(instance.write(engage, &[Value::Truth(1)]), Status::OK);
    assert_eq!(instance.read(engage), Ok(vec![Value::Truth(1)]));
    let law = fmu.row("law");
    for item in [0, -1, 77, 1 << 40, (1 << 32) + 1] {
        let parts = [
            "fmi3SetInt64: law",
            &format!("= {item}, expected an item of"),
        ];
        refused(&instance, &parts, |i| i.write(law, &[Value::Integer(item)]));
    }
    assert_eq!(instance.write(law, &[Value::Integer(2)]), Status::OK);
    assert_eq!(instance.read(law), Ok(vec![Value::Integer(2)]));
}

#[test]
fn null_pointers_are_refused_where_something_must_stand() {
    let fmu = Fmu::new(abi::Fmu::lag());
    let instance = fmu.instantiate();
    instance.initialize(0.0);
    let vr = &raw const fmu.row("u").reference;
    let (mut value, mut flag) = (1.0, 7);
    let v = &raw mut value;
    let f = &raw mut flag;
    let c = instance.component();
    // SAFETY: null is what these are asked about; the other pointers are to locals.
    unsafe {
        let l = instance.library();
        refused(
            &instance,
            &["fmi3GetFloat64: valueReferences is null"],
            |_| (l.fmi3GetFloat64)(c, null(), 1, v, 1),
        );
        refused(&instance, &["fmi3GetFloat64: values is null"], |_| {
            (l.fmi3GetFloat64)(c, vr, 1, null_mut(), 1)
        });
        refused(&instance, &["fmi3SetFloat64: values is null"], |_| {
            (l.fmi3SetFloat64)(c, vr, 1, null(), 1)
        });
        refused(
            &instance,
            &["fmi3DoStep: eventHandlingNeeded is null"],
            |_| (l.fmi3DoStep)(c, 0.0, 0.1, 1, null_mut(), f, f, v),
        );
        refused(
            &instance,
            &["fmi3DoStep: lastSuccessfulTime is null"],
            |_| (l.fmi3DoStep)(c, 0.0, 0.1, 1, f, f, f, null_mut()),
        );
        refused(&instance, &["fmi3GetFMUState: FMUState is null"], |_| {
            (l.fmi3GetFMUState)(c, null_mut())
        });
        refused(
            &instance,
            &["fmi3SetFMUState: FMUState is null or unknown"],
            |_| (l.fmi3SetFMUState)(c, 16 as *mut _),
        );
        refused(
            &instance,
            &["fmi3SetDebugLogging: categories is null"],
            |_| (l.fmi3SetDebugLogging)(c, 1, 1, null()),
        );
    }
    assert_eq!((value, flag), (1.0, 7));
}

#[test]
fn the_time_is_read_in_every_state_and_cannot_be_set() {
    let fmu = Fmu::new(abi::Fmu::lag());
    let instance = fmu.instantiate();
    assert_eq!(instance.time(), 0.0);
    assert_eq!(instance.enter_initialization_mode(5.0, None), Status::OK);
    assert_eq!(instance.time(), 5.0);
    assert_eq!(instance.exit_initialization_mode(), Status::OK);
    assert_eq!(instance.step(5.0, 0.25), Status::OK);
    assert_eq!(instance.time(), 5.25);
    let time = Row {
        reference: TIME,
        ..fmu.row("u").clone()
    };
    refused(
        &instance,
        &["time is the independent variable: it cannot be set"],
        |i| i.write(&time, &[Value::Number(1.0)]),
    );
    let as_integer = Row {
        kind: Type::Int32,
        ..time
    };
    assert!(instance.read(&as_integer).is_err());
    assert!(
        instance
            .message()
            .contains("time (value reference 4294967295) is not of type Int32")
    );
    assert_eq!(instance.terminate(), Status::OK);
    assert_eq!(instance.time(), 5.25);
}

#[test]
fn the_clock_says_its_interval_where_there_is_one() {
    for fmu in Fmu::sampled() {
        for interface in [Interface::CoSimulation, Interface::ScheduledExecution] {
            let instance = fmu.instantiate_as(interface);
            assert_eq!(instance.enter_initialization_mode(0.0, None), Status::OK);
            let (mut interval, mut qualifier, mut shift) = (f64::NAN, 7, f64::NAN);
            let clock = CLOCK;
            let (vr, l, c) = (&raw const clock, instance.library(), instance.component());
            // SAFETY: pointers to locals; the component is live.
            let statuses = unsafe {
                [
                    (l.fmi3GetIntervalDecimal)(c, vr, 1, &raw mut interval, &raw mut qualifier),
                    (l.fmi3GetShiftDecimal)(c, vr, 1, &raw mut shift),
                ]
            };
            if interface == Interface::ScheduledExecution {
                assert_eq!(statuses, [Status::OK; 2]);
                // fmi3IntervalUnchanged: the interval of a constant clock is known.
                assert_eq!((interval, qualifier, shift), (fmu.fmi2.step_size, 1, 0.0));
            } else {
                assert_eq!(statuses, [Status::ERROR; 2]);
                let log = instance.messages();
                assert!(
                    log.iter()
                        .all(|m| m.text.contains("is not that of a clock")),
                    "{log:?}"
                );
            }
        }
    }
}
