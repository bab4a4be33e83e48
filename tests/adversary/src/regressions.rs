//! Attacks that once broke a law: one a line, and comments.

use crate::attack::Attack;
use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::PathBuf;

/// The stored attacks, with their lines' numbers.
///
/// # Errors
/// The first line that is no attack.
pub fn stored() -> Result<Vec<(usize, Attack)>, String> {
    (1..)
        .zip(include_str!("../regressions.txt").lines())
        .filter(|(_, line)| !line.starts_with('#') && !line.is_empty())
        .map(|(number, line)| {
            let attack = line
                .parse()
                .map_err(|cause| format!("line {number}: {cause}"))?;
            Ok((number, attack))
        })
        .collect()
}

/// Adds an attack.
///
/// # Errors
/// When the file cannot be written.
pub fn store(attack: &Attack) -> io::Result<PathBuf> {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/regressions.txt"));
    let mut file = OpenOptions::new().append(true).create(true).open(&path)?;
    writeln!(file, "{attack}")?;
    Ok(path)
}
