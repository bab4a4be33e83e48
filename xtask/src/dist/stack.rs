//! How much stack the C library takes on the microcontroller's processor: measured emulated, and no more than
//! docs/real-time.md says.

use crate::law::{PRECISIONS, Precision};
use crate::process::{Failure, Outcome, at, root};

/// What `tests/host/law.c` paints: far more than is taken.
pub const PAINTED: &str = "-DMEASURE_STACK=32768";

/// Head of the table in docs/real-time.md: the first two columns are x86-64's.
const HEAD: &str = "| stack, bytes | f64 | f32 | f64 on the Cortex-M4F | f32 on the Cortex-M4F |\n";

/// Bytes by function, in the lines that the program prints: `exo_arm_tick 5568`.
fn measured(text: &str) -> Vec<(&str, u64)> {
    text.lines()
        .filter(|line| line.starts_with("exo_"))
        .filter_map(|line| line.split_once(' '))
        .filter_map(|(name, bytes)| Some((name, bytes.parse().ok()?)))
        .collect()
}

/// What docs/real-time.md says of a function in a column, from 0.
fn documented(docs: &str, function: &str, column: usize) -> Option<u64> {
    let (_, table) = docs.split_once(HEAD)?;
    let row = table
        .lines()
        .take_while(|line| line.starts_with('|'))
        .find(|line| line.starts_with(&format!("| `{function}` ")))?;
    row.split('|')
        .nth(2 + column)?
        .replace(' ', "")
        .parse()
        .ok()
}

/// Says what the program has measured.
///
/// # Errors
/// Names the function that takes more than a tenth beyond what is documented.
pub fn check(precision: &Precision, printed: &str) -> Outcome<String> {
    let path = root().join("docs/real-time.md");
    let docs = std::fs::read_to_string(&path).map_err(at(&path))?;
    within(&docs, precision, printed)
}

fn within(docs: &str, precision: &Precision, printed: &str) -> Outcome<String> {
    let position = PRECISIONS
        .iter()
        .position(|one| one.folder == precision.folder);
    let column = 2 + position.unwrap_or_default();
    let (mut said, mut beyond) = (Vec::new(), Vec::new());
    for (function, bytes) in measured(printed) {
        let allowed = documented(docs, function, column).map(|bytes| bytes + bytes / 10);
        if allowed.is_none_or(|allowed| bytes > allowed) {
            let allowed =
                allowed.map_or_else(|| "what the table says".to_owned(), |a| a.to_string());
            beyond.push(format!("{function} {bytes}, expected at most {allowed}"));
        }
        said.push(format!("{function} {bytes}"));
    }
    if !beyond.is_empty() {
        return Err(Failure::Found(format!(
            "bytes of stack on the Cortex-M4F in {}: {} (docs/real-time.md and a tenth)",
            precision.folder,
            beyond.join("; ")
        )));
    }
    if said.is_empty() {
        return Err(Failure::Found(
            "tests/host/law.c has measured no stack".to_owned(),
        ));
    }
    Ok(format!(
        "stack in {}: {}",
        precision.folder,
        said.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_that_takes_more_than_is_documented_is_named() {
        let docs = format!(
            "{HEAD}|---|---:|---:|---:|---:|\n| `exo_arm_tick` | 5 | 5 | 4 000 | 2 000 |\n\n"
        );
        let [double, single] = &PRECISIONS;
        assert!(within(&docs, double, "arm\nexo_arm_tick 4400\nend\n").is_ok());
        let message = within(&docs, single, "exo_arm_tick 2201\n").unwrap_err();
        assert!(
            message
                .to_string()
                .contains("exo_arm_tick 2201, expected at most 2200")
        );
        assert!(
            within(&docs, single, "exo_axis_tick 1\n").is_err(),
            "not in the table"
        );
        assert!(within(&docs, single, "end\n").is_err(), "nothing measured");
    }

    #[test]
    fn the_table_is_in_the_documentation() {
        let docs = std::fs::read_to_string(root().join("docs/real-time.md")).expect("is there");
        for column in 0..4 {
            assert!(documented(&docs, "exo_arm_tick", column).is_some_and(|bytes| bytes > 500));
        }
    }
}
