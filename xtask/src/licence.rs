//! Which licences may be linked into the libraries.

use crate::process::{Failure, Outcome};

/// SPDX identifiers of licences that allow a closed product to contain the FMU, as long as their texts go with it.
const ALLOWED: [&str; 11] = [
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    // What GCC puts into every program that it links: its exception lets a product of any licence contain it.
    "GPL-3.0-or-later WITH GCC-exception-3.1",
    "ISC",
    // The GNU C library's start files, with the same exception in older words.
    "LGPL-2.1-or-later WITH GCC-exception-2.0-note",
    "MIT",
    "Unicode-3.0",
    "ZPL-2.1",
    "Zlib",
];

/// Whether the expression leaves a choice that is allowed.
///
/// # Errors
/// Names the component, its licence and what is allowed.
pub fn check(component: &str, expression: &str) -> Outcome {
    if is_allowed(expression) {
        Ok(())
    } else {
        Err(Failure::Found(format!(
            "{component} is licensed under {expression:?}, expected a choice among {}",
            ALLOWED.join(", ")
        )))
    }
}

/// An SPDX expression: `OR` of `AND`s of licences and of expressions in parentheses. What cannot be read is not allowed.
fn is_allowed(expression: &str) -> bool {
    let spaced = expression
        .replace('(', " ( ")
        .replace(')', " ) ")
        .replace('/', " OR "); // as crates wrote it before SPDX
    let words: Vec<_> = spaced.split_whitespace().collect();
    let mut rest = &words[..];
    either(&mut rest) == Some(true) && rest.is_empty()
}

fn either(words: &mut &[&str]) -> Option<bool> {
    let mut allowed = both(words)?;
    while take(words, "OR") {
        allowed |= both(words)?;
    }
    Some(allowed)
}

fn both(words: &mut &[&str]) -> Option<bool> {
    let mut allowed = one(words)?;
    while take(words, "AND") {
        allowed &= one(words)?;
    }
    Some(allowed)
}

fn one(words: &mut &[&str]) -> Option<bool> {
    if take(words, "(") {
        let allowed = either(words)?;
        return take(words, ")").then_some(allowed);
    }
    let mut licence = next(words)?.to_owned();
    if take(words, "WITH") {
        licence = format!("{licence} WITH {}", next(words)?);
    }
    Some(ALLOWED.contains(&&*licence))
}

fn take(words: &mut &[&str], word: &str) -> bool {
    let found = words.first() == Some(&word);
    if found {
        *words = &words[1..];
    }
    found
}

fn next<'a>(words: &mut &[&'a str]) -> Option<&'a str> {
    let (first, rest) = words.split_first()?;
    *words = rest;
    Some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_allowed_choice_is_enough_and_all_joined_licences_are_needed() {
        for good in [
            "MIT",
            "MIT OR GPL-3.0-only",
            "GPL-3.0-only OR Apache-2.0",
            "MIT/Apache-2.0",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "MIT AND Apache-2.0 WITH LLVM-exception AND (MIT OR GPL-2.0-only)",
            "GPL-3.0-or-later WITH GCC-exception-3.1",
        ] {
            assert!(is_allowed(good), "{good}");
        }
        for bad in [
            "",
            "GPL-3.0-only",
            "MIT AND GPL-3.0-only",
            "MPL-2.0",
            "(MIT OR Apache-2.0) AND GPL-2.0-only",
            "MIT WITH LLVM-exception",
            "GPL-3.0-or-later",
            "LGPL-2.1-or-later",
            "(MIT",
            "MIT Apache-2.0",
            "MIT OR",
        ] {
            assert!(!is_allowed(bad), "{bad}");
        }
    }

    #[test]
    fn a_refusal_names_component_and_licence() {
        let message = check("thing-1.0.0", "GPL-3.0-only")
            .unwrap_err()
            .to_string();
        assert!(message.contains("thing-1.0.0") && message.contains("GPL-3.0-only"));
    }
}
