//! The guid is a hash of what an importer relies on: it changes with that, and with nothing else.

use declaration::Variability::{Continuous, Fixed};
use declaration::{Declare, Description, Experiment, Stepping, real, unit};
use serde::{Deserialize, Serialize};

/// A model of two numbers with one thing exchanged: its rows and its start value.
macro_rules! guid {
    ($start:expr, $about:literal, [$($row:expr),*]) => {{
        #[derive(Clone, Serialize, Deserialize)]
        struct Model {
            u: f64,
            p: f64,
        }
        impl Default for Model {
            fn default() -> Self {
                Self { u: 0.0, p: $start }
            }
        }
        impl Declare for Model {
            const DESCRIPTION: Description<Self> = Description {
                name: "Model",
                about: $about,
                stepping: Stepping::Exact,
                experiment: Experiment { start: 0.0, stop: 1.0, tolerance: 1e-6, step: 0.1 },
                variables: &[$($row),*],
            };
        }
        Model::DESCRIPTION.guid()
    }};
}

#[test]
fn another_name_start_bound_unit_causality_or_order_is_another_guid_and_another_text_is_not() {
    let guids = [
        guid!(
            1.0,
            "a",
            [
                real!(u, unit::NONE).input(Continuous),
                real!(p, unit::NONE).parameter(Fixed)
            ]
        ),
        guid!(
            2.0,
            "a",
            [
                real!(u, unit::NONE).input(Continuous),
                real!(p, unit::NONE).parameter(Fixed)
            ]
        ),
        guid!(
            1.0,
            "a",
            [
                real!(u, unit::NONE).input(Continuous),
                real!(p, unit::NONE).parameter(Fixed).within(0.0, 9.0)
            ]
        ),
        guid!(
            1.0,
            "a",
            [
                real!(u, unit::NEWTON).input(Continuous),
                real!(p, unit::NONE).parameter(Fixed)
            ]
        ),
        guid!(
            1.0,
            "a",
            [
                real!(u, unit::NONE).output(Continuous),
                real!(p, unit::NONE).parameter(Fixed)
            ]
        ),
        guid!(
            1.0,
            "a",
            [
                real!(p, unit::NONE).parameter(Fixed),
                real!(u, unit::NONE).input(Continuous)
            ]
        ),
        guid!(1.0, "a", [real!(u, unit::NONE).input(Continuous)]),
    ];
    let different: std::collections::BTreeSet<_> = guids.iter().collect();
    assert_eq!(different.len(), guids.len(), "{guids:?}");
    let other_text = guid!(
        1.0,
        "b",
        [
            real!(u, unit::NONE).input(Continuous).about("an input"),
            real!(p, unit::NONE).parameter(Fixed)
        ]
    );
    assert_eq!(other_text, guids[0]);
}
