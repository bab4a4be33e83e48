//! The test model, `modelDescription/export/examples/lag.rs`: a bare library without XML.

use crate::fmu::{SUFFIX, directory, existing};
use crate::{Fmu, Instance, Kind, Library, Setup, Variable};
use std::sync::Arc;

/// Rows of `modelDescription/export/examples/lag.rs`, in their order. A row's value reference is 256 times its position.
const LAG: [(&str, Kind, &str, &str); 9] = [
    ("u", Kind::Real {}, "input", "continuous"),
    ("y", Kind::Real {}, "output", "continuous"),
    ("tau", Kind::Real {}, "parameter", "fixed"),
    ("gain", Kind::Real {}, "parameter", "tunable"),
    ("steps", Kind::Integer {}, "output", "discrete"),
    ("panic", Kind::Boolean {}, "input", "discrete"),
    ("method", Kind::Enumeration {}, "parameter", "fixed"),
    ("label", Kind::String {}, "parameter", "fixed"),
    ("resource_path", Kind::String {}, "output", "discrete"),
];

/// Bounds of the test model.
const LAG_BOUNDS: [(&str, f64, f64); 3] = [
    ("tau", 1e-6, 1e6),
    ("gain", -1e3, 1e3),
    ("method", 1.0, 2.0),
];

impl Fmu {
    /// Loads the test model, a bare library without XML: its variables are those of its source, its guid is the one
    /// that its refusal of a wrong guid names.
    ///
    /// # Panics
    /// When the library is missing or does not name its guid.
    pub fn lag() -> Self {
        let path = existing(directory().join(format!("test/liblag{SUFFIX}")));
        let library = Arc::new(Library::load(&path));
        let refusal = Instance::new(&library, &Setup::new("lag", "wrong"))
            .err()
            .expect("a wrong guid is refused");
        let guid = refusal
            .first()
            .and_then(|message| message.text.split_once("expected "))
            .map(|(_, guid)| guid.to_owned())
            .expect("the refusal names the expected guid");
        let variables = LAG
            .iter()
            .zip(0..)
            .map(|(&(name, kind, causality, variability), row)| Variable {
                name: name.into(),
                reference: 256 * row,
                kind,
                causality: causality.into(),
                variability: variability.into(),
                bounds: LAG_BOUNDS
                    .iter()
                    .find(|(bounded, ..)| *bounded == name)
                    .map(|&(_, min, max)| (min, max)),
                start: None,
            })
            .collect();
        Self {
            name: "Lag".into(),
            guid,
            variables,
            log_categories: ["logStatusError", "logStatusWarning", "logEvents"]
                .map(Into::into)
                .into(),
            step_size: 0.01,
            library,
            path,
            folder: None,
        }
    }
}
