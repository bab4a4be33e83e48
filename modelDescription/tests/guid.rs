//! The guid is a hash of what an importer relies on: it changes with that, and with nothing else.

use fmu_declaration::{Declare, Description, Experiment, Rows, Start, Stepping};
use serde::{Deserialize, Serialize};

/// The guid of a model with these rows.
macro_rules! guid {
    ($about:literal, $($rows:tt)*) => {{
        #[derive(Clone, Serialize, Deserialize, Rows, Start)]
        struct Model {
            $($rows)*
        }
        impl Declare for Model {
            const DESCRIPTION: Description<Self> = Description {
                name: "Model",
                about: $about,
                stepping: Stepping::Exact,
                experiment: Experiment { start: 0.0, stop: 1.0, tolerance: 1e-6, step: 0.1 },
                variables: Self::ROWS,
            };
        }
        Model::DESCRIPTION.guid()
    }};
}

#[test]
fn another_name_start_bound_unit_causality_or_order_is_another_guid_and_another_text_is_not() {
    let guids = [
        guid!("a", #[input(0)] u: f64, #[parameter(1, start = 1.0)] p: f64),
        guid!("a", #[input(0)] w: f64, #[parameter(1, start = 1.0)] p: f64),
        guid!("a", #[input(0)] u: f64, #[parameter(1, start = 2.0)] p: f64),
        guid!("a", #[input(0)] u: f64, #[parameter(1, range = 0.0..=9.0, start = 1.0)] p: f64),
        guid!("a", #[input(0, unit = NEWTON)] u: f64, #[parameter(1, start = 1.0)] p: f64),
        guid!("a", #[output(0)] u: f64, #[parameter(1, start = 1.0)] p: f64),
        guid!("a", #[parameter(0, start = 1.0)] p: f64, #[input(1)] u: f64),
        guid!("a", #[input(0)] u: f64),
    ];
    let different: std::collections::BTreeSet<_> = guids.iter().collect();
    assert_eq!(different.len(), guids.len(), "{guids:?}");
    let other_text =
        guid!("b", /** an input */ #[input(0)] u: f64, #[parameter(1, start = 1.0)] p: f64);
    assert_eq!(other_text, guids[0]);
}
