//! Every type of FMI 3.0, on the test model `feedthrough`; and the small ones of both versions, on `narrow`.

use abi::Status;
use abi::fmi3::types::TIME;
use abi::fmi3::{Fmu, Instance, Row, Type, Value};
use proptest::prelude::*;
use std::ptr::null;
use std::sync::LazyLock;

/// Name and type of what is fed through: `int8` comes out as `int8_out`.
const FED: [(&str, Type); 14] = [
    ("float32", Type::Float32),
    ("float64", Type::Float64),
    ("int8", Type::Int8),
    ("uint8", Type::UInt8),
    ("int16", Type::Int16),
    ("uint16", Type::UInt16),
    ("int32", Type::Int32),
    ("uint32", Type::UInt32),
    ("int64", Type::Int64),
    ("uint64", Type::UInt64),
    ("boolean", Type::Boolean),
    ("string", Type::Text),
    ("binary", Type::Binary),
    ("option", Type::Enumeration),
];

/// For the many cases of one test.
static FED_BY: LazyLock<Fmu> = LazyLock::new(Fmu::every_type);

/// The smallest and largest values of a type, those beside them, and any.
fn values(kind: Type) -> BoxedStrategy<Value> {
    macro_rules! integers {
        ($t:ty) => {
            prop_oneof![
                Just(<$t>::MIN),
                Just(<$t>::MAX),
                Just(<$t>::MIN + 1),
                Just(<$t>::MAX - 1),
                any::<$t>()
            ]
            .prop_map(|value| Value::Integer(value.into()))
            .boxed()
        };
    }
    match kind {
        Type::Float32 => prop_oneof![
            Just(f32::MIN),
            Just(f32::MAX),
            Just(f32::MIN_POSITIVE),
            Just(-0.0),
            any::<f32>().prop_filter("finite", |value| value.is_finite())
        ]
        .prop_map(|value| Value::Number(value.into()))
        .boxed(),
        Type::Float64 => prop_oneof![
            Just(f64::MIN),
            Just(f64::MAX),
            any::<f64>().prop_filter("finite", |value| value.is_finite())
        ]
        .prop_map(Value::Number)
        .boxed(),
        Type::Int8 => integers!(i8),
        Type::UInt8 => integers!(u8),
        Type::Int16 => integers!(i16),
        Type::UInt16 => integers!(u16),
        Type::Int32 => integers!(i32),
        Type::UInt32 => integers!(u32),
        Type::Int64 => integers!(i64),
        Type::UInt64 => integers!(u64),
        Type::Boolean => (0..=1_u8).prop_map(Value::Truth).boxed(),
        Type::Enumeration => (1..=2_i128).prop_map(Value::Integer).boxed(),
        Type::Text => "[^\0]{0,20}".prop_map(Value::Text).boxed(),
        Type::Binary => proptest::collection::vec(any::<u8>(), 0..=16)
            .prop_map(Value::Bytes)
            .boxed(),
    }
}

fn all_values() -> Vec<BoxedStrategy<Value>> {
    FED.map(|(_, kind)| values(kind)).into()
}

/// Asserts that a call is refused with one message that has `part`, and that nothing changes.
#[track_caller]
fn refused(instance: &Instance, part: &str, call: impl FnOnce(&Instance) -> Status) {
    let before = instance.bytes();
    instance.messages();
    assert_eq!(call(instance), Status::ERROR, "{part}");
    let text = instance.message();
    assert!(text.contains(part), "{part} is not in '{text}'");
    assert_eq!(instance.bytes(), before, "{part} changed something");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_value_of_every_type_is_read_as_it_was_set_and_survives_a_state_as_bytes(values in all_values()) {
        let fmu = &*FED_BY;
        let (first, other) = (fmu.instantiate(), fmu.instantiate());
        first.initialize(0.0);
        for ((name, kind), value) in FED.iter().zip(&values) {
            let row = fmu.row(name);
            prop_assert_eq!(row.kind, *kind);
            prop_assert_eq!(first.write(row, std::slice::from_ref(value)), Status::OK, "{:?}", first.messages());
        }
        prop_assert_eq!(first.step(0.0, 0.1), Status::OK, "{:?}", first.messages());
        let bytes = first.bytes();
        prop_assert_eq!(other.restore(&bytes), Status::OK);
        prop_assert_eq!(other.bytes(), bytes);
        for ((name, _), value) in FED.iter().zip(&values) {
            for instance in [&first, &other] {
                for name in [(*name).to_owned(), format!("{name}_out")] {
                    let read = instance.read(fmu.row(&name)).expect("readable");
                    // In every bit: -0.0 too.
                    prop_assert_eq!(format!("{read:?}"), format!("[{value:?}]"), "{}", name);
                }
            }
        }
    }
}

#[test]
fn start_values_of_every_type_are_those_of_the_declaration() {
    let fmu = Fmu::every_type();
    let instance = fmu.instantiate();
    let integers = |pair: [i128; 2]| pair.map(Value::Integer).to_vec();
    let text = |text: &str| Value::Text(text.into());
    let expected = [
        (
            "float32",
            [0.1_f32, 0.2].map(|x| Value::Number(x.into())).to_vec(),
        ),
        ("int8", integers([-100, 127])),
        ("uint8", integers([0, 255])),
        ("int16", integers([-32_768, 32_767])),
        ("uint16", integers([0, 60_000])),
        ("uint32", integers([0, 4_294_967_295])),
        ("int64", integers([i64::MIN.into(), i64::MAX.into()])),
        ("uint64", integers([1, u64::MAX.into()])),
        ("boolean", [1, 0].map(Value::Truth).to_vec()),
        ("string", ["a b", "<&>"].map(text).to_vec()),
        (
            "binary",
            vec![Value::Bytes(vec![0, 255, 16]), Value::Bytes(vec![])],
        ),
        ("single", vec![Value::Number(2.5)]),
    ];
    for (name, values) in expected {
        let row = fmu.row(&format!("parameter.{name}"));
        assert_eq!(instance.read(row), Ok(values.clone()), "{name}");
        assert_eq!(instance.write(row, &values), Status::OK, "{name}");
    }
    assert_eq!(
        instance.read(fmu.row("binary")),
        Ok(vec![Value::Bytes(b"foo".to_vec())])
    );
}

#[test]
fn a_variable_is_read_by_the_functions_of_its_type_alone() {
    let fmu = Fmu::every_type();
    let instance = fmu.instantiate();
    for row in &fmu.rows {
        for kind in Type::ALL {
            let as_another = Row {
                kind,
                ..row.clone()
            };
            let read = instance.read(&as_another).is_ok();
            assert_eq!(
                read,
                kind.is_called_as(row.kind),
                "{} as {kind:?}",
                row.name
            );
        }
    }
    instance.messages();
    let time = Row {
        reference: TIME,
        ..fmu.row("float32").clone()
    };
    assert!(instance.read(&time).is_err());
    assert!(
        instance
            .message()
            .contains("time (value reference 4294967295) is not of type Float32")
    );
}

#[test]
fn items_and_integers_of_64_bits_are_read_in_one_call() {
    let fmu = Fmu::every_type();
    let instance = fmu.instantiate();
    let references = [
        fmu.row("option").reference,
        fmu.row("parameter.int64").reference,
    ];
    let mut values = [0; 3];
    // SAFETY: arrays of the lengths that are passed; the component is live.
    let status = unsafe {
        let (vr, v) = (references.as_ptr(), values.as_mut_ptr());
        (instance.library().fmi3GetInt64)(instance.component(), vr, 2, v, 3)
    };
    assert_eq!((status, values), (Status::OK, [1, i64::MIN, i64::MAX]));
}

#[test]
fn what_no_variable_of_a_type_accepts_is_refused_by_name_and_value() {
    let fmu = Fmu::every_type();
    let instance = fmu.instantiate();
    instance.initialize(0.0);
    let integer = |value| vec![Value::Integer(value)];
    let bytes = |n: usize| vec![Value::Bytes(vec![7; n])];
    let cases = [
        (
            "float32",
            vec![Value::Number(f64::NAN)],
            "float32 = NaN m, expected a finite value",
        ),
        (
            "float32",
            vec![Value::Number(f64::NEG_INFINITY)],
            "float32 = -inf m, expected a finite value",
        ),
        (
            "parameter.uint16",
            [0, 60_001].map(Value::Integer).to_vec(),
            "parameter.uint16[2] = 60001, expected a value from 0 to 60000",
        ),
        (
            "parameter.uint64",
            [0, 5].map(Value::Integer).to_vec(),
            "parameter.uint64[1] = 0, expected a value from 1 to 18446744073709551615",
        ),
        (
            "option",
            integer(i64::MIN.into()),
            "option = -9223372036854775808, expected an item of Option: 1 first, 2 second",
        ),
        (
            "binary",
            bytes(17),
            "binary has 17 bytes, expected at most 16",
        ),
        (
            "parameter.uint16",
            integer(1),
            "nValues = 1, expected 2, the sum of the variables' sizes",
        ),
        (
            "uint8_out",
            integer(1),
            "uint8_out is computed by the model",
        ),
        (
            "parameter.binary",
            [bytes(1), bytes(1)].concat(),
            "parameter.binary[1] is a fixed parameter",
        ),
    ];
    for (name, values, said) in cases {
        refused(&instance, said, |instance| {
            instance.write(fmu.row(name), &values)
        });
    }
    let early = fmu.instantiate();
    let pair = [-101, 0].map(Value::Integer);
    refused(
        &early,
        "parameter.int8[1] = -101, expected a value from -100 to 127",
        |instance| instance.write(fmu.row("parameter.int8"), &pair),
    );
    let (vr, size, nothing) = (fmu.row("binary").reference, 3, null());
    refused(&instance, "binary is null, expected 3 bytes", |instance| {
        let (vr, size, value) = (&raw const vr, &raw const size, &raw const nothing);
        // SAFETY: null is what is asked about; the other pointers are to locals.
        unsafe { (instance.library().fmi3SetBinary)(instance.component(), vr, 1, size, value, 1) }
    });
    // No bytes need no address.
    let empty = 0;
    let (vr, size, value) = (&raw const vr, &raw const empty, &raw const nothing);
    // SAFETY: as above.
    let status =
        unsafe { (instance.library().fmi3SetBinary)(instance.component(), vr, 1, size, value, 1) };
    assert_eq!(status, Status::OK, "{:?}", instance.messages());
    assert_eq!(instance.read(fmu.row("binary")), Ok(bytes(0)));
}

#[test]
fn a_sensor_in_single_precision_may_fail_where_its_row_says_so() {
    let fmu = Fmu::every_type();
    let instance = fmu.instantiate();
    instance.initialize(0.0);
    assert_eq!(
        instance.write(fmu.row("sensor"), &[Value::Number(f64::NAN)]),
        Status::OK
    );
    assert_eq!(instance.step(0.0, 0.1), Status::OK);
    let read = instance.read(fmu.row("sensor_out")).expect("readable");
    assert!(matches!(read[..], [Value::Number(value)] if value.is_nan()));
    assert_eq!(
        instance.write(fmu.row("sensor"), &[Value::Number(f64::INFINITY)]),
        Status::OK
    );
    instance.messages();
    assert_eq!(instance.step(0.1, 0.1), Status::ERROR);
    assert!(
        instance
            .message()
            .contains("sensor_out = inf m, expected a finite value")
    );
}

#[test]
fn more_bytes_than_a_row_says_do_not_leave_a_model() {
    let fmu = Fmu::every_type();
    let instance = fmu.instantiate();
    instance.initialize(0.0);
    assert_eq!(
        instance.write(fmu.row("doubling"), &[Value::Truth(1)]),
        Status::OK
    );
    assert_eq!(instance.step(0.0, 0.1), Status::OK);
    assert_eq!(
        instance.read(fmu.row("twice")),
        Ok(vec![Value::Bytes(b"foofoo".to_vec())])
    );
    assert_eq!(
        instance.write(fmu.row("binary"), &[Value::Bytes(vec![1; 9])]),
        Status::OK
    );
    instance.messages();
    assert_eq!(instance.step(0.1, 0.1), Status::ERROR);
    let text = instance.message();
    assert!(
        text.contains("twice has 18 bytes, expected at most 16"),
        "{text}"
    );
}

#[test]
fn a_number_beyond_a_small_type_is_refused_by_fmi_2_by_name_and_value() {
    let fmu = Fmu::narrow();
    let kinds = ["gain", "first", "increment", "wrap", "difference"].map(|name| fmu.row(name).kind);
    assert_eq!(
        kinds,
        [
            Type::Float32,
            Type::UInt8,
            Type::Int8,
            Type::UInt16,
            Type::Int16
        ]
    );
    let instance = fmu.fmi2.instantiate();
    let refused = |status: Status, said: &str| {
        assert_eq!(status, Status::ERROR, "{said}");
        let text = instance.message();
        assert!(text.contains(said), "{said} is not in '{text}'");
    };
    let reference = |name| [fmu.fmi2.reference(name)];
    for (name, value, said) in [
        (
            "first[2]",
            256,
            "first[2] = 256, expected a value from 0 to 255",
        ),
        (
            "first[1]",
            -1,
            "first[1] = -1, expected a value from 0 to 255",
        ),
        (
            "increment",
            9,
            "increment = 9, expected a value from -8 to 8",
        ),
        (
            "wrap",
            65_536,
            "wrap = 65536, expected a value from 1 to 65535",
        ),
    ] {
        refused(instance.set_integer(&reference(name), &[value]), said);
    }
    for (name, value, said) in [
        ("gain", 2.1, "gain = 2.1, expected a value from -2 to 2"),
        (
            "offset",
            1e39,
            "offset = 1e39, expected at most 3.4028235e38 in magnitude, as single precision holds",
        ),
        ("offset", f64::NAN, "offset = NaN, expected a finite value"),
    ] {
        refused(instance.set_real(&reference(name), &[value]), said);
    }
    // What single precision rounds is accepted, and read as it is stored.
    assert_eq!(instance.set_real(&reference("offset"), &[0.1]), Status::OK);
    assert_eq!(instance.real(reference("offset")[0]), f64::from(0.1_f32));
}
