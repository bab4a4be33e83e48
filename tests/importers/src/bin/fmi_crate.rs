//! One FMU, run by the `fmi` crate with the inputs of a file.
//!
//! ```text
//! fmi_crate X.fmu STEP IN.csv OUT.csv [NAME=NUMBER …]
//! ```
//!
//! The settings and the first row of `IN.csv` are set before initialization; then each row is set, and a step of STEP (s)
//! goes from its time on. `OUT.csv` has every Real, Integer and Boolean output after the step from each time. Exit code 0,
//! or 1 with a sentence on stderr.

use fmi::schema::fmi2::Causality;
use importers::record::Record;
use importers::{Imported, Type};
use std::path::Path;
use std::process::ExitCode;

fn run(words: &[String]) -> Result<(), String> {
    let [fmu, step, input, output, settings @ ..] = words else {
        return Err("usage: fmi_crate X.fmu STEP IN.csv OUT.csv [NAME=NUMBER …]".into());
    };
    let h: f64 = step
        .parse()
        .map_err(|_| format!("{step}: expected a step size"))?;
    let text = std::fs::read_to_string(input).map_err(|error| format!("{input}: {error}"))?;
    let inputs = Record::parse(&text).map_err(|error| format!("{input}: {error}"))?;
    let mut instance = Imported::open(Path::new(fmu))?;
    for setting in settings {
        let (name, value) = setting
            .split_once('=')
            .and_then(|(name, value)| Some((name, value.parse().ok()?)))
            .ok_or_else(|| format!("{setting}: expected NAME=NUMBER"))?;
        instance.set(name, value)?;
    }
    let set = |instance: &mut Imported, row: &[f64]| {
        let mut pairs = inputs.names.iter().zip(row);
        pairs.try_for_each(|(name, &value)| instance.set(name, value))
    };
    if let Some((_, row)) = inputs.rows.first() {
        set(&mut instance, row)?;
    }
    instance.initialize()?;

    let mut outputs = Record {
        names: instance
            .variables
            .iter()
            .filter(|v| v.causality == Causality::Output && v.kind != Type::Other)
            .map(|v| v.name.clone())
            .collect(),
        rows: Vec::new(),
    };
    for (t, row) in &inputs.rows {
        set(&mut instance, row)?;
        instance.step(*t, h)?;
        let values: Result<_, String> = outputs.names.iter().map(|n| instance.get(n)).collect();
        outputs.rows.push((*t, values?));
    }
    std::fs::write(output, outputs.text()).map_err(|error| format!("{output}: {error}"))
}

fn main() -> ExitCode {
    let words: Vec<_> = std::env::args().skip(1).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}
