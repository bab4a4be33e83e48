//! Rows and start values from attributes: what they become, alone, as a part and in an array.
#![allow(non_snake_case, reason = "symbols as in the paper: H")]

use fmu_declaration::check::{self, Expected};
use fmu_declaration::{Access, Causality, Rows, Start, Variability, choices, unit};

choices! { MODE "Mode" "what it does":
    1 "idle" "nothing";
    4 "busy" "something";
}

#[derive(Rows, Start)]
struct Link {
    /// Mass.
    #[parameter(0, name = "link.m[i]", unit = KILOGRAM, range = POSITIVE, start = 2.0)]
    m: f64,
    /// Place.
    #[parameter(1, name = "link.x[i]", unit = METRE, range = -1.0..=1.0)]
    x: f64,
}

#[derive(Rows, Start)]
struct Side {
    /// Torque.
    #[input(0, unit = NEWTON_METRE)]
    tau: [f64; 2],
    /// Contact.
    #[output(1)]
    contact: bool,
}

#[derive(Rows, Start)]
struct Whole {
    /// Energy,
    /// in two lines.
    #[output(9, name = "energy.H", unit = JOULE, from = ["gain"], discrete)]
    H: f64,
    #[part(prefix = "left.")]
    left: Side,
    #[part(prefix = "right.", from = 2, about = [("contact", "Contact of the right.")])]
    right: Side,
    #[part(each, from = 4)]
    links: [Link; 3],
    /// Gain.
    #[parameter(6, tunable, range = 0.5.., start = 0.75)]
    gain: f64,
    /// Kept in single precision.
    #[parameter(7, start = 0.1)]
    single: f32,
    /// Mode.
    #[parameter(8, items = MODE, start = 4)]
    mode: i32,
    /// Choice.
    #[parameter(10, boolean, start = 1)]
    on: i32,
    /// Samples.
    #[parameter(11, integers = 0..)]
    samples: i32,
    /// Of every size.
    #[input(12, integers = -5..)]
    small: [i8; 2],
    /// Of every size.
    #[input(13, integers = ..=200)]
    byte: u8,
    /// Of every size.
    #[input(14)]
    short: i16,
    /// Of every size.
    #[input(15)]
    port: u16,
    /// Of every size.
    #[input(16)]
    count: u32,
    /// Of every size.
    #[input(17, integers = -9_000_000_000..=9_000_000_000)]
    long: i64,
    /// Of every size.
    #[input(18)]
    mask: [u64; 2],
    /// Bytes.
    #[parameter(19, max_size = 3, mime_type = "image/png", start = vec![1, 2])]
    picture: Vec<u8>,
    #[start(7)]
    hidden: u64,
}

fn whole() -> &'static [fmu_declaration::Variable<Whole>] {
    Whole::ROWS
}

#[test]
fn rows_stand_in_the_order_of_their_numbers_with_the_names_of_their_parts() {
    let names: Vec<_> = whole()
        .iter()
        .map(|row| (row.number, row.full_name()))
        .collect();
    let expected = [
        "left.tau[i]",
        "left.contact",
        "right.tau[i]",
        "right.contact",
        "link.m[i]",
        "link.x[i]",
        "gain",
        "single",
        "mode",
        "energy.H",
        "on",
        "samples",
        "small[i]",
        "byte",
        "short",
        "port",
        "count",
        "long",
        "mask[i]",
        "picture",
    ];
    assert_eq!(
        names,
        (0..).zip(expected.map(str::to_owned)).collect::<Vec<_>>()
    );
}

#[test]
fn a_row_says_what_its_attribute_says() {
    let energy = &whole()[9];
    assert_eq!(energy.about, "Energy, in two lines");
    assert_eq!(
        (energy.causality, energy.variability),
        (Causality::Output, Variability::Discrete)
    );
    assert_eq!(energy.initially_from, ["gain"]);
    assert!(matches!(
        energy.access,
        Access::Real {
            unit: unit::JOULE,
            ..
        }
    ));
    assert!(whole()[6].is_tunable() && !whole()[7].is_tunable());
    assert_eq!(whole()[0].variability, Variability::Continuous);
    assert_eq!(whole()[1].variability, Variability::Discrete); // no Real
}

#[test]
fn a_part_may_describe_a_row_anew() {
    let about = [0, 1, 2, 3].map(|i: usize| whole()[i].about);
    assert_eq!(
        about,
        ["Torque", "Contact", "Torque", "Contact of the right."]
    );
}

#[test]
fn an_objection_has_the_units_and_bounds_of_its_row() {
    let refused = |change: fn(&mut Whole)| {
        let mut model = Whole::default();
        change(&mut model);
        let objection =
            check::first(&model, whole(), Causality::Parameter, false).expect_err("refused");
        (objection.unit, objection.low, objection.high)
    };
    assert_eq!(refused(|m| m.links[2].x = 1.5), ("m", -1.0, 1.0));
    assert_eq!(refused(|m| m.gain = 0.25), ("1", 0.5, f64::INFINITY));
    assert_eq!(refused(|m| m.samples = -1), ("1", 0.0, f64::from(i32::MAX)));
    assert_eq!(refused(|m| m.mode = 2), ("1", 1.0, 4.0));
    assert_eq!(refused(|m| m.on = 2), ("1", 0.0, 1.0));
}

#[test]
fn start_values_are_those_of_the_attributes() {
    let start = Whole::default();
    assert_eq!(
        (start.gain, start.single, start.mode, start.on, start.hidden),
        (0.75, 0.1, 4, 1, 7)
    );
    assert_eq!(start.links.map(|link| link.m), [2.0; 3]);
}

/// Each value is another one, so that a wrong place shows.
#[test]
fn every_value_is_read_and_written_where_it_lies() {
    let mut model = Whole::default();
    let mut n = 0.0;
    for row in whole() {
        for i in 0..row.len {
            n += 1.0;
            match &row.access {
                Access::Real { at, .. } => at.set(&mut model, i, n),
                Access::Integer { at, .. } | Access::Enumeration { at, .. } => {
                    at.set(&mut model, i, n as i32)
                }
                Access::Wide { at, .. } => at.set(&mut model, i, n as i128),
                Access::Boolean { at } => at.set(&mut model, i, true),
                Access::Binary { at, .. } => at.set(&mut model, i, vec![n as u8]),
                Access::String { .. } => {}
            }
        }
    }
    assert_eq!((model.left.tau, model.left.contact), ([1.0, 2.0], true));
    assert_eq!((model.right.tau, model.right.contact), ([4.0, 5.0], true));
    assert_eq!(
        model.links.each_ref().map(|link| (link.m, link.x)),
        [(7.0, 10.0), (8.0, 11.0), (9.0, 12.0)]
    );
    assert_eq!(
        (model.gain, model.single, model.mode, model.H),
        (13.0, 14.0, 15, 16.0)
    );
    assert_eq!((model.on, model.samples, model.hidden), (1, 18, 7));
    assert_eq!(
        (model.small, model.byte, model.short, model.port),
        ([19, 20], 21, 22, 23)
    );
    assert_eq!((model.count, model.long, model.mask), (24, 25, [26, 27]));
    assert_eq!(model.picture, [28]);
    assert_eq!(whole()[18].value(&model, 1), Some(27_i128));
    assert_eq!(whole()[4].value(&model, 1), Some(8.0));
    assert_eq!(whole()[4].value::<i32>(&model, 1), None);
}

#[test]
fn the_first_value_out_of_its_range_is_named() {
    let refused = |change: fn(&mut Whole)| {
        let mut model = Whole::default();
        change(&mut model);
        let objection =
            check::first(&model, whole(), Causality::Parameter, false).expect_err("refused");
        (
            objection.name,
            objection.element,
            objection.value,
            objection.expected,
        )
    };
    assert_eq!(
        check::first(&Whole::default(), whole(), Causality::Parameter, false),
        Ok(())
    );
    assert_eq!(
        refused(|m| m.links[1].m = 0.0),
        (
            "link.m",
            Some(2),
            0.0,
            Expected::Text("a finite value, at least 1e-6")
        )
    );
    assert_eq!(
        refused(|m| m.links[2].x = 1.5),
        ("link.x", Some(3), 1.5, Expected::Text("-1.0 to 1.0"))
    );
    assert_eq!(
        refused(|m| m.gain = 0.25),
        (
            "gain",
            None,
            0.25,
            Expected::Text("a finite value, at least 0.5")
        )
    );
    assert!(refused(|m| m.gain = f64::NAN).2.is_nan());
    assert_eq!(refused(|m| m.gain = f64::INFINITY).2, f64::INFINITY);
    assert_eq!(refused(|m| m.on = 2), ("on", None, 2.0, Expected::Truth));
    assert_eq!(
        refused(|m| m.samples = -1),
        ("samples", None, -1.0, Expected::Integers(0, i32::MAX))
    );
    let (name, _, value, expected) = refused(|m| m.mode = 2);
    assert_eq!(
        (name, value, expected.to_string().as_str()),
        ("mode", 2.0, "1 (idle), 4 (busy)")
    );
    assert_eq!(Expected::Integers(0, i32::MAX).to_string(), "0 or more");
    assert_eq!(Expected::Integers(0, 1).to_string(), "0 or 1");

    // What is tuned in a run is held against its own rows alone.
    let broken = Whole {
        mode: 2,
        ..Whole::default()
    };
    assert_eq!(
        check::first(&broken, whole(), Causality::Parameter, true),
        Ok(())
    );
    let broken = Whole {
        gain: 0.0,
        ..Whole::default()
    };
    assert!(check::first(&broken, whole(), Causality::Parameter, true).is_err());
}

#[test]
fn an_integer_without_bounds_has_those_of_its_type() {
    let integer = |i: usize| match whole()[i].access {
        Access::Integer { min, max, at } => (at.integer_type(), min.into(), max.into()),
        Access::Wide { min, max, at } => (at.integer_type(), min.get(), max.get()),
        _ => panic!("no integer"),
    };
    use fmu_declaration::IntegerType as I;
    let nine = 9_000_000_000;
    let expected = [
        (I::Int32, 0, i32::MAX.into()),
        (I::Int8, -5, 127),
        (I::UInt8, 0, 200),
        (I::Int16, -32_768, 32_767),
        (I::UInt16, 0, 65_535),
        (I::UInt32, 0, 4_294_967_295),
        (I::Int64, -nine, nine),
        (I::UInt64, 0, u64::MAX.into()),
    ];
    for (i, expected) in (11..).zip(expected) {
        assert_eq!(integer(i), expected, "{}", whole()[i].name);
    }
}

/// The smallest and the largest value of each type, and those between them, are read as they were written.
#[test]
fn no_bit_of_an_integer_is_lost() {
    let mut model = Whole::default();
    for row in whole() {
        let of = match &row.access {
            Access::Integer { at, .. } => at.integer_type(),
            Access::Wide { at, .. } => at.integer_type(),
            _ => continue,
        };
        let set = |model: &mut Whole, value: i128| match &row.access {
            Access::Integer { at, .. } => {
                at.set(model, 0, value as i32);
                assert_eq!(at.widened().get(model, 0), at.get(model, 0).into());
                at.get(model, 0).into()
            }
            Access::Wide { at, .. } => {
                at.set(model, 0, value);
                at.get(model, 0)
            }
            _ => panic!("no integer"),
        };
        let (low, high) = (of.low(), of.high());
        for value in [low, low + 1, low / 3, 0, 1, high / 3, high - 1, high] {
            assert_eq!(set(&mut model, value), value, "{}", row.name);
        }
    }
}

#[test]
fn a_value_beyond_its_bounds_is_named_whatever_its_type() {
    let refused = |causality, change: fn(&mut Whole)| {
        let mut model = Whole::default();
        change(&mut model);
        let objection = check::first(&model, whole(), causality, false).expect_err("refused");
        (
            objection.name,
            objection.element,
            objection.value,
            (objection.low, objection.high),
        )
    };
    let (input, parameter) = (Causality::Input, Causality::Parameter);
    assert_eq!(
        refused(input, |m| m.small[1] = -6),
        ("small", Some(2), -6.0, (-5.0, 127.0))
    );
    assert_eq!(
        refused(input, |m| m.byte = 201),
        ("byte", None, 201.0, (0.0, 200.0))
    );
    assert_eq!(
        refused(input, |m| m.long = -9_000_000_001),
        ("long", None, -9_000_000_001.0, (-9e9, 9e9))
    );
    assert_eq!(
        refused(parameter, |m| m.picture = vec![0; 4]),
        ("picture", None, 4.0, (0.0, 3.0))
    );
}

#[test]
fn the_end_of_a_range_is_in_it_in_single_precision_too() {
    #[derive(Rows, Start)]
    struct Single {
        /// Gain.
        #[parameter(0, range = POSITIVE, start = 1e-6)]
        K: f32,
    }
    let checked = |K| check::first(&Single { K }, Single::ROWS, Causality::Parameter, false);
    assert_eq!(checked(1e-6), Ok(()));
    assert!(checked(0.999e-6).is_err());
}
