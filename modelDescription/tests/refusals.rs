//! Each rule that a declaration can break, broken once.

mod subject;

use declaration::{
    Declare as _, Description, Enumeration, Experiment, Item, Unit, Variability, Variable, unit,
};
use model_description::Interface;
use subject::{Subject, with_row};

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
    static INNER_TYPE: Enumeration = Enumeration {
        name: "inner",
        about: "",
        items: &[Item {
            value: 4,
            name: "only",
            about: "",
        }],
    };
    refused(
        &with_row(MODE, |_| Subject::in_mode(&INNER_TYPE)),
        &["inner", "type"],
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
        &with_row(GAIN, |row| row.within(0.0, 29.0)),
        &["gain", "30"],
    );
    refused(&with_row(GAIN, |row| row.at_least(30.5)), &["gain", "30"]);
    refused(
        &with_row(DELAY, |row| row.within_integers(1, 2)),
        &["delay"],
    );
    refused(&with_row(GAIN, |row| row.within(f64::NAN, 40.0)), &["gain"]);
    refused(
        &with_row(ENERGY, |row| row.parameter(Variability::Fixed)),
        &["energy.total", "NaN"],
    );
    static OTHER: Enumeration = Enumeration {
        name: "Other",
        about: "",
        items: &[Item {
            value: 1,
            name: "only",
            about: "",
        }],
    };
    refused(
        &with_row(MODE, |_| Subject::in_mode(&OTHER)),
        &["mode", "4"],
    );
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
    static DOWN: Enumeration = Enumeration {
        name: "Down",
        about: "",
        items: &[
            Item {
                value: 4,
                name: "a",
                about: "",
            },
            Item {
                value: 1,
                name: "b",
                about: "",
            },
        ],
    };
    static TWICE: Enumeration = Enumeration {
        name: "Twice",
        about: "",
        items: &[
            Item {
                value: 1,
                name: "a",
                about: "",
            },
            Item {
                value: 4,
                name: "A",
                about: "",
            },
        ],
    };
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
    static SECOND_MODE: Enumeration = Enumeration {
        name: "Mode",
        about: "",
        items: &[Item {
            value: 4,
            name: "another",
            about: "",
        }],
    };
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
