//! The own licence of what is delivered, and the texts of all that is linked in; in an FMU `documentation/licenses/` (section
//! 2.3).

use crate::{Component, Product};
use std::fmt::Write as _;

/// Paths, in an FMU below `documentation/licenses/`, with contents. `license.txt` is the entry point.
pub fn files(product: &Product<'_>, linked: &[Component]) -> Vec<(String, Vec<u8>)> {
    let mut files = vec![(
        "license.txt".to_owned(),
        overview(product, linked).into_bytes(),
    )];
    for (name, text) in product.package.texts {
        files.push((file_name(name), text.to_vec()));
    }
    for component in linked {
        for (name, text) in &component.texts {
            files.push((format!("{}/{name}", component.id()), text.clone()));
        }
    }
    files
}

/// Name of a licence text in the archive: what has no extension is given one, so that it opens everywhere; and what would
/// take the entry point's name, another one.
pub fn file_name(name: &str) -> String {
    let named = if name.contains('.') {
        name.to_owned()
    } else {
        format!("{name}.txt")
    };
    if named.eq_ignore_ascii_case("license.txt") {
        "LICENSE-text.txt".to_owned()
    } else {
        named
    }
}

/// What the package may be used under, as part of a sentence.
pub(crate) fn terms(license: &str) -> String {
    match license {
        "" => "The package names no licence".to_owned(),
        choice if choice.contains(" OR ") => format!("Licensed under {choice}, at your option"),
        one => format!("Licensed under {one}"),
    }
}

fn overview(product: &Product<'_>, linked: &[Component]) -> String {
    let package = product.package;
    let mut text = format!("{} {}", product.name, package.version);
    text.truncate(text.trim_end().len());
    text.push('\n');
    if !package.copyright.is_empty() {
        let _ = writeln!(text, "{}", package.copyright);
    }
    let _ = write!(text, "\n{}", terms(package.license));
    let names: Vec<_> = package
        .texts
        .iter()
        .map(|(name, _)| file_name(name))
        .collect();
    if names.is_empty() {
        text.push_str(".\n");
    } else {
        let joint = if package.license.contains(" OR ") {
            " or "
        } else {
            ", "
        };
        let _ = writeln!(text, ":\n{} in this folder.", names.join(joint));
    }
    let foreign = || linked.iter().filter(|component| component.is_foreign());
    let width = foreign().map(|component| component.id().len()).max();
    if let Some(width) = width {
        text.push_str(
            "\nLinked into the libraries, each with its texts in the folder of its name:\n\n",
        );
        for component in foreign() {
            let _ = writeln!(text, "{:width$}  {}", component.id(), component.license);
        }
    }
    text
}
