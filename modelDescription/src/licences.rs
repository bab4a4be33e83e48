//! The own licence of what is delivered, and the texts of all that is linked in; in an FMU `documentation/licenses/` (section
//! 2.3).

use crate::{Component, Product, xml};
use std::fmt::Write as _;

const MIT: &str = include_str!("../../LICENSE-MIT");
const APACHE: &str = include_str!("../../LICENSE-APACHE");

/// Paths, in an FMU below `documentation/licenses/`, with contents. `license.txt` is the entry point.
pub fn files(product: &Product<'_>, linked: &[Component]) -> Vec<(String, Vec<u8>)> {
    let mut files = vec![
        (
            "license.txt".to_owned(),
            overview(product, linked).into_bytes(),
        ),
        ("LICENSE-MIT.txt".to_owned(), MIT.into()),
        ("LICENSE-APACHE.txt".to_owned(), APACHE.into()),
    ];
    for component in linked {
        for (name, text) in &component.texts {
            files.push((format!("{}/{name}", component.id()), text.clone()));
        }
    }
    files
}

fn overview(product: &Product<'_>, linked: &[Component]) -> String {
    let mut text = format!(
        "{} {}\n{}\n\nLicensed under {}, at your option:\nLICENSE-MIT.txt or LICENSE-APACHE.txt in this folder.\n",
        product.name,
        crate::VERSION,
        xml::COPYRIGHT,
        crate::LICENSE
    );
    let foreign = || {
        linked
            .iter()
            .filter(|component| !component.texts.is_empty())
    };
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
