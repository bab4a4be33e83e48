//! Variables of every type: what both descriptions say of them, for start values from one end of a type to the other.

mod subject;

use fmu_archive::{Interface, Standard};
use fmu_declaration::{Declare, Description, Experiment, Rows, Stepping};
use proptest::prelude::*;
use std::cell::RefCell;
use subject::{Element, PACKAGE, elements};

/// Parameters of every type with the start values that the test has said.
#[derive(Clone, Debug, Default, PartialEq, Rows)]
struct Given {
    /// single
    #[parameter]
    float32: [f32; 2],
    /// double
    #[parameter]
    float64: [f64; 2],
    /// integer
    #[parameter]
    int8: [i8; 2],
    /// integer
    #[parameter]
    uint8: [u8; 2],
    /// integer
    #[parameter]
    int16: [i16; 2],
    /// integer
    #[parameter]
    uint16: [u16; 2],
    /// integer
    #[parameter]
    int32: [i32; 2],
    /// integer
    #[parameter]
    uint32: [u32; 2],
    /// integer
    #[parameter]
    int64: [i64; 2],
    /// integer
    #[parameter]
    uint64: [u64; 2],
    /// bytes
    #[parameter(max_size = 20, mime_type = "image/png")]
    binary: [Vec<u8>; 2],
}

thread_local! {
    static SAID: RefCell<Option<Given>> = const { RefCell::new(None) };
}

/// [`Given`], whose default is what the test has said.
#[derive(Clone, Debug, Rows)]
struct Model {
    #[part]
    given: Given,
}

impl Default for Model {
    fn default() -> Self {
        let given = SAID.with_borrow(Clone::clone).unwrap_or_default();
        Self { given }
    }
}

const DESCRIPTION: Description<Model> = Description {
    name: "Model",
    about: "every type",
    stepping: Stepping::Exact,
    experiment: Experiment {
        start: 0.0,
        stop: 1.0,
        tolerance: 1e-6,
        step: 0.1,
    },
    variables: Model::ROWS,
};

impl Declare for Model {
    const DESCRIPTION: Description<Self> = DESCRIPTION;
}

fn written(given: &Given) -> Vec<Element> {
    SAID.set(Some(given.clone()));
    let interface = Interface::of::<Model>().expect("a legal declaration");
    elements(&Standard::Fmi3.description(&interface, PACKAGE))
}

/// The start values of one variable, each read from its text by `read`.
fn starts<T: Copy + Default>(all: &[Element], kind: &str, read: fn(&str) -> T) -> [T; 2] {
    let path = format!("fmiModelDescription/ModelVariables/{kind}");
    let mut found = all.iter().filter(|one| one.path == path);
    let text = found.next_back().expect(kind).get("start").expect(kind);
    let values: Vec<_> = text.split(' ').map(read).collect();
    values.try_into().ok().expect("two")
}

fn binaries(all: &[Element]) -> [Vec<u8>; 2] {
    let path = "fmiModelDescription/ModelVariables/Binary/Start";
    let elements = all.iter().filter(|one| one.path == path);
    let bytes = elements.map(|one| {
        let digits = one.get("value").expect("a value").as_bytes();
        let byte = |pair: &[u8]| {
            u8::from_str_radix(std::str::from_utf8(pair).expect("ASCII"), 16).expect("hex")
        };
        digits.chunks(2).map(byte).collect()
    });
    bytes.collect::<Vec<_>>().try_into().expect("two")
}

/// The ends of a type, what lies beside them, and anything.
macro_rules! ends {
    ($t:ty) => {
        prop_oneof![
            Just([<$t>::MIN, <$t>::MAX]),
            Just([<$t>::MIN + 1, <$t>::MAX - 1]),
            any::<[$t; 2]>()
        ]
    };
}

fn reals<T: Copy + std::fmt::Debug + 'static>(
    any: impl Strategy<Value = T> + Clone + 'static,
    ends: [T; 4],
) -> impl Strategy<Value = [T; 2]> {
    let one = prop_oneof![proptest::sample::select(ends.to_vec()), any];
    [one.clone().boxed(), one.boxed()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn a_start_value_of_any_type_reads_back_to_the_same_bits(
        float32 in reals(any::<f32>().prop_filter("finite", |x| x.is_finite()), [f32::MIN, f32::MAX, f32::MIN_POSITIVE, -0.0]),
        float64 in reals(any::<f64>().prop_filter("finite", |x| x.is_finite()), [f64::MIN, f64::MAX, f64::MIN_POSITIVE, -0.0]),
        (int8, uint8, int16, uint16) in (ends!(i8), ends!(u8), ends!(i16), ends!(u16)),
        (int32, uint32, int64, uint64) in (ends!(i32), ends!(u32), ends!(i64), ends!(u64)),
        binary in any::<[[u8; 20]; 2]>(), sizes in [0..=20_usize, 0..=20_usize],
    ) {
        let cut = |i: usize| binary[i][..sizes[i]].to_vec();
        let given = Given {
            float32, float64, int8, uint8, int16, uint16, int32, uint32, int64, uint64, binary: [cut(0), cut(1)],
        };
        let all = written(&given);
        prop_assert_eq!(starts(&all, "Float32", |t| t.parse::<f32>().unwrap().to_bits()), float32.map(f32::to_bits));
        prop_assert_eq!(starts(&all, "Float64", |t| t.parse::<f64>().unwrap().to_bits()), float64.map(f64::to_bits));
        prop_assert_eq!(starts(&all, "Int8", |t| t.parse::<i8>().unwrap()), int8);
        prop_assert_eq!(starts(&all, "UInt8", |t| t.parse::<u8>().unwrap()), uint8);
        prop_assert_eq!(starts(&all, "Int16", |t| t.parse::<i16>().unwrap()), int16);
        prop_assert_eq!(starts(&all, "UInt16", |t| t.parse::<u16>().unwrap()), uint16);
        prop_assert_eq!(starts(&all, "Int32", |t| t.parse::<i32>().unwrap()), int32);
        prop_assert_eq!(starts(&all, "UInt32", |t| t.parse::<u32>().unwrap()), uint32);
        prop_assert_eq!(starts(&all, "Int64", |t| t.parse::<i64>().unwrap()), int64);
        prop_assert_eq!(starts(&all, "UInt64", |t| t.parse::<u64>().unwrap()), uint64);
        prop_assert_eq!(binaries(&all), given.binary);
    }
}

/// What an integer or a number in single precision has as bounds.
#[derive(Clone, Debug, Default, Rows)]
struct Bounded {
    /// without bounds
    #[parameter]
    free: i8,
    /// with one
    #[parameter(integers = ..=200)]
    byte: u8,
    /// without bounds
    #[parameter]
    port: u16,
    /// without bounds, as ever
    #[parameter]
    whole: i32,
    /// with the ends of its type as bounds
    #[parameter(integers = i16::MIN..=i16::MAX)]
    short: i16,
    /// with bounds
    #[parameter(unit = METRE, range = -0.1..=1e30)]
    single: f32,
}

impl Declare for Bounded {
    const DESCRIPTION: Description<Self> = Description {
        name: "Bounded",
        about: "bounds",
        stepping: Stepping::Exact,
        experiment: DESCRIPTION.experiment,
        variables: Self::ROWS,
    };
}

#[test]
fn bounds_are_those_of_the_row_and_in_fmi_2_else_those_of_a_small_type() {
    let interface = Interface::of::<Bounded>().expect("a legal declaration");
    let bounds = |standard: Standard, inside: &str| {
        let all = elements(&standard.description(&interface, PACKAGE));
        let path = "fmiModelDescription/ModelVariables/";
        let of = |one: &Element| {
            let kind = one.path.strip_prefix(path)?.strip_prefix(inside)?;
            let told = |key| one.get(key).unwrap_or("").to_owned();
            let known = !kind.contains('/') && kind != "String" && told("name") != "time";
            known.then(|| format!("{kind} {}..{}", told("min"), told("max")))
        };
        all.iter().filter_map(of).collect::<Vec<_>>()
    };
    assert_eq!(
        bounds(Standard::Fmi3, ""),
        [
            "Int8 ..",
            "UInt8 ..200",
            "UInt16 ..",
            "Int32 ..",
            "Int16 ..",
            "Float32 -0.1..1e30"
        ]
    );
    assert_eq!(
        bounds(Standard::Fmi2, "ScalarVariable/"),
        [
            "Integer -128..127",
            "Integer 0..200",
            "Integer 0..65535",
            "Integer ..",
            "Integer -32768..32767",
            "Real -0.1..1e30"
        ]
    );
}

#[test]
fn a_model_has_an_archive_of_fmi_2_where_each_variable_has_a_type_there() {
    let standards = |interface: &Interface| Standard::of(interface).collect::<Vec<_>>();
    let small = Interface::of::<Bounded>().expect("a legal declaration");
    assert!(small.beyond_fmi2().is_none());
    assert_eq!(standards(&small), [Standard::Fmi2, Standard::Fmi3]);
    let every = Interface::of::<Model>().expect("a legal declaration");
    assert_eq!(every.beyond_fmi2().expect("one").name, "uint32[1]");
    assert_eq!(standards(&every), [Standard::Fmi3]);
}

#[test]
fn a_start_value_beyond_the_size_of_a_binary_is_refused() {
    SAID.set(Some(Given {
        binary: [vec![0; 21], Vec::new()],
        ..Given::default()
    }));
    let refusal = Interface::of::<Model>().expect_err("too long").to_string();
    assert!(refusal.starts_with("binary[1]: expected a start value within its bounds"));
}

#[test]
fn a_type_is_a_part_of_what_the_guid_identifies() {
    #[derive(Clone, Default, Rows)]
    struct Small {
        /// a number
        #[parameter]
        x: f32,
    }
    #[derive(Clone, Default, Rows)]
    struct Large {
        /// a number
        #[parameter]
        x: f64,
    }
    macro_rules! declare {
        ($model:ident) => {
            impl Declare for $model {
                const DESCRIPTION: Description<Self> = Description {
                    name: "Same",
                    about: "same",
                    stepping: Stepping::Exact,
                    experiment: DESCRIPTION.experiment,
                    variables: Self::ROWS,
                };
            }
        };
    }
    declare!(Small);
    declare!(Large);
    assert_eq!((Small::default().x, Large::default().x), (0.0, 0.0));
    assert_ne!(Small::DESCRIPTION.guid(), Large::DESCRIPTION.guid());
}
