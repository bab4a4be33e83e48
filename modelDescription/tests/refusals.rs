//! Each rule that a declaration can break, broken once.

mod subject;

use fmu_archive::Interface;
use fmu_declaration::{
    Access, Declare as _, Description, Enumeration, Experiment, Stepping, Unit, Variability,
    Variable, choices, unit,
};
use subject::{Subject, with_row, within};

// Rows of the subject, by position.
const U: usize = 0;
const ON: usize = 1;
const ANGLE: usize = 2;
const ENERGY: usize = 3;
const SCALE: usize = 5;
const GAIN: usize = 6;
const TINY: usize = 7;
const DELAY: usize = 9;
const MODE: usize = 10;
const INNER: usize = 12;

/// The message contains all of `parts`, the row's name among them.
fn refused(description: &Description<Subject>, parts: &[&str]) {
    let message = Interface::read(description)
        .expect_err(parts[0])
        .to_string();
    for part in parts {
        assert!(message.contains(part), "'{part}' is not in '{message}'");
    }
}

fn named(position: usize, name: &'static str) -> Description<Subject> {
    with_row(position, |row| Variable { name, ..row })
}

#[test]
fn the_unbroken_declaration_is_accepted() {
    assert!(Interface::read(&with_row(U, |row| row)).is_ok());
}

#[test]
fn initially_from_must_name_inputs_or_parameters() {
    refused(
        &with_row(ANGLE, |row| row.initially_from(&["u[i]", "gian"])),
        &["angle[i]", "gian"],
    );
    refused(
        &with_row(ANGLE, |row| row.initially_from(&["u[1]"])),
        &["angle[i]", "u[1]"],
    );
    refused(
        &with_row(ANGLE, |row| row.initially_from(&["energy.total"])),
        &["angle[i]", "energy.total"],
    );
}

#[test]
fn initially_from_stands_at_outputs_and_calculated_parameters_only() {
    refused(
        &with_row(GAIN, |row| row.initially_from(&["delay"])),
        &["gain", "delay"],
    );
    refused(
        &with_row(INNER, |row| row.initially_from(&["gain"])),
        &["inner", "gain"],
    );
}

#[test]
fn dependencies_follow_the_rows_they_name() {
    let dependencies = |names: &'static [&'static str]| {
        let interface =
            Interface::read(&with_row(SCALE, |row| row.initially_from(names))).expect("legal");
        let scale = interface.scalars.iter().find(|entry| entry.name == "scale");
        let positions = &scale.expect("is there").initially_from;
        assert!(positions.is_sorted());
        positions
            .iter()
            .map(|&position| interface.scalars[position].name.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(dependencies(&["gain"]), ["gain"]);
    assert_eq!(
        dependencies(&["delay", "gain", "delay"]),
        ["gain", "delay"],
        "sorted, each once"
    );
    assert_eq!(dependencies(&["on"]), ["on"]);
}

#[test]
fn names_are_unique_under_case_folding_and_structured() {
    refused(&named(TINY, "GAIN"), &["GAIN", "gain"]);
    refused(&named(TINY, "gain"), &["gain"]);
    refused(&named(ENERGY, "energy total"), &["energy total"]);
    choices! { INNER_TYPE "inner" "":
        4 "only" "";
    }
    refused(
        &with_row(MODE, |_| Subject::in_mode(&INNER_TYPE)),
        &["inner", "type"],
    );
}

#[test]
fn names_are_unique_in_fmi_3_too_where_a_vector_is_one_variable() {
    refused(&named(TINY, "angle"), &["angle[i]", "angle"]);
    refused(&named(TINY, "Time"), &["Time", "time of FMI 3.0"]);
    refused(&named(TINY, "clock"), &["clock", "clock of FMI 3.0"]);
    // Only a sampled model has a clock.
    let exact = Description {
        stepping: Stepping::Exact,
        ..named(TINY, "clock")
    };
    assert!(Interface::read(&exact).is_ok());
    choices! { ANGLE_TYPE "angle" "":
        4 "only" "";
    }
    refused(
        &with_row(MODE, |_| Subject::in_mode(&ANGLE_TYPE)),
        &["angle[i]", "type"],
    );
}

#[test]
fn a_vector_has_i_in_its_name_and_a_scalar_has_not() {
    refused(&named(U, "u"), &["u", "[i]"]);
    refused(&named(ON, "on[i]"), &["on[i]"]);
    refused(
        &with_row(U, |row| Variable { len: 2, ..row }),
        &["u[i]", "2", "3"],
    );
    refused(
        &with_row(U, |row| Variable { len: 0, ..row }),
        &["u[i]", "0"],
    );
}

#[test]
fn start_values_lie_within_their_bounds() {
    refused(
        &with_row(GAIN, |row| within(row, 0.0, 29.0)),
        &["gain", "30"],
    );
    refused(
        &with_row(GAIN, |row| within(row, 30.5, f64::INFINITY)),
        &["gain", "30"],
    );
    refused(
        &with_row(DELAY, |row| match row.access {
            Access::Integer { at, .. } => {
                let (min, max) = (1, 2);
                let access = Access::Integer { min, max, at };
                Variable { access, ..row }
            }
            _ => row,
        }),
        &["delay"],
    );
    refused(
        &with_row(GAIN, |row| within(row, 0.0, 29.0)),
        &[
            "gain: expected a start value",
            "got 30 ",
            ", at least 0, at most 29",
        ],
    );
    refused(
        &with_row(ENERGY, |row| row.parameter(Variability::Fixed)),
        &["energy.total", "NaN"],
    );
    choices! { OTHER "Other" "":
        1 "only" "";
    }
    refused(
        &with_row(MODE, |_| Subject::in_mode(&OTHER)),
        &["mode", "4"],
    );
}

#[test]
fn bounds_are_finite_and_ascend_at_what_the_model_computes_too() {
    for (low, high, shown) in [
        (f64::NAN, 40.0, "NaN to 40"),
        (-40.0, f64::NAN, "-40 to NaN"),
        (40.0, 1.0, "40 to 1"),
        (f64::INFINITY, f64::INFINITY, "inf to inf"),
    ] {
        for (position, name) in [(GAIN, "gain"), (ENERGY, "energy.total")] {
            refused(
                &with_row(position, |row| within(row, low, high)),
                &[name, "expected finite bounds", shown],
            );
        }
    }
}

#[test]
fn texts_that_xml_cannot_carry_and_empty_names_are_refused_by_row() {
    let about = |position, about| with_row(position, |row| Variable { about, ..row });
    for text in ["a\0b", "a\nb", "\u{1b}[31m", "\u{ffff}"] {
        refused(
            &about(GAIN, text),
            &[
                "gain: description",
                &format!("{text:?}"),
                "expected one line",
            ],
        );
        let model = Description {
            about: text,
            ..with_row(U, |row| row)
        };
        refused(&model, &[model.name, "description", "expected one line"]);
    }
    for (name, expected) in [("", "not empty"), (" ", "not empty"), ("N\t", "one line")] {
        let unit = Unit {
            name,
            ..unit::METRE
        };
        refused(
            &with_row(INNER, |_| Subject::in_unit(unit)),
            &["inner: unit ", expected],
        );
        let shown = unit::METRE.shown_in(name, 1e3, 0.0);
        refused(
            &with_row(INNER, |_| Subject::in_unit(shown)),
            &["inner: display unit ", expected],
        );
    }
    choices! { NAMELESS "" "":
        4 "only" "";
    }
    choices! { WITHOUT_ITEM_NAME "Choice" "":
        4 "" "";
    }
    choices! { BELL "Choice" "":
        4 "only" "\u{7}";
    }
    for (of, words) in [
        (&NAMELESS, "enumeration"),
        (&WITHOUT_ITEM_NAME, "item"),
        (&BELL, "description of the item"),
    ] {
        refused(
            &with_row(MODE, |_| Subject::in_mode(of)),
            &["mode: ", words, "expected one line"],
        );
    }
}

#[test]
fn a_display_unit_has_a_factor_that_shows_values() {
    for (factor, offset) in [
        (0.0, 0.0),
        (f64::NAN, 0.0),
        (f64::INFINITY, 0.0),
        (1.0, f64::NAN),
    ] {
        let shown = unit::METRE.shown_in("mm", factor, offset);
        refused(
            &with_row(INNER, |_| Subject::in_unit(shown)),
            &["inner: display unit mm", "expected a finite factor"],
        );
    }
}

#[test]
fn causality_and_variability_must_go_together() {
    refused(
        &with_row(GAIN, |row| row.parameter(Variability::Discrete)),
        &["gain", "Parameter", "Discrete"],
    );
    refused(
        &with_row(U, |row| row.input(Variability::Fixed)),
        &["u[i]", "Input", "Fixed"],
    );
    refused(
        &with_row(U, |row| row.input(Variability::Continuous)),
        &["u[i]", "Continuous", "Sampled"],
    );
    refused(
        &with_row(ON, |row| row.local(Variability::Continuous)),
        &["on"],
    );
}

#[test]
fn enumerations_ascend_and_units_and_types_have_one_definition() {
    choices! { DOWN "Down" "":
        4 "a" "";
        1 "b" "";
    }
    choices! { TWICE "Twice" "":
        1 "a" "";
        4 "A" "";
    }
    static EMPTY: Enumeration = Enumeration {
        name: "Empty",
        about: "",
        items: &[],
    };
    for of in [&DOWN, &TWICE, &EMPTY] {
        refused(
            &with_row(MODE, |_| Subject::in_mode(of)),
            &["mode", of.name],
        );
    }
    choices! { SECOND_MODE "Mode" "":
        4 "another" "";
    }
    let mut rows = Subject::DESCRIPTION.variables.to_vec();
    rows[DELAY] = Variable {
        name: "delay",
        number: rows[DELAY].number,
        ..Subject::in_mode(&SECOND_MODE)
    };
    refused(
        &Description {
            variables: rows.leak(),
            ..with_row(U, |row| row)
        },
        &["mode", "Mode", "two"],
    );
    refused(
        &with_row(INNER, |_| {
            Subject::in_unit(Unit {
                name: "N",
                ..unit::METRE
            })
        }),
        &["inner", "N", "two"],
    );
}

#[test]
fn the_default_experiment_goes_forward() {
    let base = with_row(U, |row| row);
    let broken = [
        Experiment {
            stop: 0.0,
            ..base.experiment
        },
        Experiment {
            step: 0.0,
            ..base.experiment
        },
        Experiment {
            step: 1e-320,
            ..base.experiment
        },
        Experiment {
            start: f64::NAN,
            ..base.experiment
        },
        Experiment {
            tolerance: -1e-6,
            ..base.experiment
        },
    ];
    for experiment in broken {
        refused(
            &Description {
                experiment,
                ..with_row(U, |row| row)
            },
            &["default experiment"],
        );
    }
    refused(
        &Description {
            name: "my model",
            ..base
        },
        &["my model"],
    );
}
