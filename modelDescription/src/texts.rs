//! Texts that stand in the XML as they are: XML must carry them, and a reader must get what was written.

use crate::entry::{Entry, Kind};
use crate::error::Error;
use crate::name::is_line;
use fmu_declaration::unit::Display;

/// Checks names and texts of a variable.
pub(crate) fn check_texts(entry: &Entry) -> Result<(), Error> {
    let row = entry.name.as_str();
    line(row, "description", entry.about)?;
    match &entry.kind {
        Kind::Real { unit, .. } => {
            name(row, "unit", unit.name)?;
            if let Some(display) = unit.display {
                name(row, "display unit", display.name)?;
                let Display {
                    name: display,
                    factor,
                    offset,
                } = display;
                if !(factor.is_finite() && factor != 0.0 && offset.is_finite()) {
                    let row = row.to_owned();
                    return Err(Error::Display {
                        row,
                        display,
                        factor,
                        offset,
                    });
                }
            }
        }
        Kind::Enumeration { of, .. } => {
            name(row, "enumeration", of.name)?;
            line(row, "description of the enumeration", of.about)?;
            for item in of.items {
                name(row, "item", item.name)?;
                line(row, "description of the item", item.about)?;
            }
        }
        Kind::Binary { mime_type, .. } => name(row, "mime_type", mime_type)?,
        Kind::Integer { .. } | Kind::Boolean { .. } | Kind::String { .. } => {}
    }
    Ok(())
}

/// Checks a text of `row`, which may be empty.
pub(crate) fn line(row: &str, what: &'static str, text: &str) -> Result<(), Error> {
    if is_line(text) {
        return Ok(());
    }
    Err(Error::Text {
        row: row.to_owned(),
        what,
        text: text.to_owned(),
    })
}

/// A name is not empty.
fn name(row: &str, what: &'static str, text: &str) -> Result<(), Error> {
    if !text.trim().is_empty() {
        return line(row, what, text);
    }
    Err(Error::Text {
        row: row.to_owned(),
        what,
        text: String::new(),
    })
}
