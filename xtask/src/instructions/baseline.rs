//! The committed counts: a rise is a diff that someone reads.

use crate::process::{Failure, Outcome, at, root};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where they are committed.
pub const PATH: &str = "tests/abi/instructions.json";

/// Instructions by what is called.
pub type Counts = BTreeMap<String, u64>;

/// The file.
#[derive(Debug)]
pub struct Baseline {
    /// What compiled the libraries that were counted.
    pub compiler: String,
    /// What was counted.
    pub counts: Counts,
}

impl Baseline {
    /// Reads the file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn committed() -> Outcome<Self> {
        let path = path();
        let text = std::fs::read_to_string(&path).map_err(at(&path))?;
        Self::parse(&text).ok_or_else(|| Failure::Found(format!("{PATH} is not a table of counts")))
    }

    fn parse(text: &str) -> Option<Self> {
        let all: Value = serde_json::from_str(text).ok()?;
        let counts = all["instructions"].as_object()?;
        Some(Self {
            compiler: all["compiler"].as_str()?.to_owned(),
            counts: counts
                .iter()
                .map(|(name, count)| Some((name.clone(), count.as_u64()?)))
                .collect::<Option<_>>()?,
        })
    }

    /// Writes the file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn commit(&self) -> Outcome {
        self.write(&path())
    }

    /// Writes the same table elsewhere.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, path: &Path) -> Outcome {
        let all = json!({"compiler": self.compiler, "instructions": self.counts});
        std::fs::write(path, format!("{all:#}\n")).map_err(at(path))
    }

    /// Whether these counts may be: each at most 5 % above the committed one.
    ///
    /// # Errors
    /// Names each that may not.
    pub fn allows(&self, counts: &Counts) -> Outcome {
        let mut wrong = Vec::new();
        for (name, &now) in counts {
            match self.counts.get(name) {
                None => wrong.push(format!("{name}: {now}, not in {PATH}")),
                Some(&was) if 100 * now > 105 * was => {
                    wrong.push(format!("{name}: {now}, expected at most 5 % above {was}"));
                }
                Some(&was) if 100 * now < 95 * was => {
                    println!("note: {name} takes {now} instructions, {PATH} says {was}");
                }
                Some(_) => {}
            }
        }
        let gone = self
            .counts
            .keys()
            .filter(|name| !counts.contains_key(*name));
        wrong.extend(gone.map(|name| format!("{name}: in {PATH}, but not counted")));
        if wrong.is_empty() {
            return Ok(());
        }
        Err(Failure::Found(format!(
            "instructions: {}; if it must be so: `cargo xtask bench --bless`, then read the diff",
            wrong.join("; ")
        )))
    }
}

fn path() -> PathBuf {
    root().join(PATH)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn baseline(count: u64) -> Baseline {
        Baseline {
            compiler: "rustc 1.0.0 here".into(),
            counts: [("Testbed step".to_owned(), count)].into(),
        }
    }

    fn counted(count: u64) -> Counts {
        baseline(count).counts
    }

    #[test]
    fn five_percent_more_is_allowed_and_no_more() {
        assert!(baseline(1000).allows(&counted(1050)).is_ok());
        assert!(baseline(1000).allows(&counted(200)).is_ok());
        let message = baseline(1000)
            .allows(&counted(1051))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("Testbed step") && message.contains("1051"),
            "{message}"
        );
    }

    #[test]
    fn what_is_counted_is_what_is_committed() {
        let other: Counts = [("Testbed get".to_owned(), 1000)].into();
        let message = baseline(1000).allows(&other).unwrap_err().to_string();
        assert!(message.contains("Testbed get: 1000, not in"), "{message}");
        assert!(message.contains("Testbed step: in"), "{message}");
    }

    #[test]
    fn the_file_can_be_read() {
        let committed = Baseline::committed().unwrap_or_else(|failure| panic!("{failure}"));
        assert!(committed.counts.len() > 2);
    }
}
