//! The part of the interface document that the rows cannot tell: what the model does, a picture of signs and frames, and
//! which variables of which FMUs belong together. No model is known here, so it is given.

use crate::html::{Section, escape, table};
use crate::standard::Standard;
use std::fmt::Write as _;

/// What the document shows besides the rows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Guide<'a> {
    /// What the model does, as paragraphs of HTML; empty: none.
    pub what: &'a str,
    /// An `<svg>` element with signs and frames, shown inline; empty: none.
    pub picture: &'a str,
    /// Connections from and to this FMU.
    pub wiring: &'a [Connection<'a>],
    /// The system that this FMU is part of.
    pub system: System<'a>,
}

/// A connection from an output to an input. A vector's name ends in `[i]`, all elements are connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Connection<'a> {
    /// FMU and output.
    pub from: (&'a str, &'a str),
    /// FMU and input.
    pub to: (&'a str, &'a str),
    /// When it is not always made: the case; otherwise empty.
    pub when: &'a str,
}

/// A component and one of its variables.
pub type End<'a> = (&'a str, &'a str);

/// FMUs that run together, for the quick start.
#[derive(Clone, Copy, Debug, Default)]
pub struct System<'a> {
    /// Name of each component and its FMU, in the order in which they step.
    pub parts: &'a [(&'a str, &'a str)],
    /// Connections, component and variable, written as in [`Connection`].
    pub wires: &'a [(End<'a>, End<'a>)],
    /// Start values that make something happen: component, variable, value.
    pub start: &'a [(&'a str, &'a str, &'a str)],
}

/// What the model does, if that is told.
pub(crate) fn what(guide: Guide<'_>) -> Option<Section> {
    let body = format!("{}\n", guide.what.trim_end());
    (!guide.what.is_empty()).then(|| Section::new("what", "What it does", body))
}

/// The picture, if there is one.
pub(crate) fn picture(guide: Guide<'_>) -> Option<Section> {
    let body = format!(
        "<figure tabindex=\"0\">\n{}\n</figure>\n",
        guide.picture.trim_end()
    );
    (!guide.picture.is_empty()).then(|| Section::new("signs", "Signs and frames", body))
}

/// The table of connections, if there are some.
pub(crate) fn wiring(name: &str, guide: Guide<'_>, standard: Standard) -> Option<Section> {
    if guide.wiring.is_empty() {
        return None;
    }
    let how = if standard.is_fmi3() {
        "Arrays are connected whole, but where one element is named, from 1."
    } else {
        "All elements of a vector <code>[i]</code> are connected."
    };
    let mut body = format!("<p>{how} An input that is left open keeps its start value.</p>\n");
    table(&mut body, "wiring", &["Here", "", "There", "When"]);
    for connection in guide.wiring {
        let (here, arrow, there) = if connection.to.0 == name {
            (connection.to.1, "←", connection.from)
        } else {
            (connection.from.1, "→", connection.to)
        };
        let when = if connection.when.is_empty() {
            "always"
        } else {
            connection.when
        };
        let _ = writeln!(
            body,
            "<tr><td>{}</td><td>{arrow}</td><td>{}.{}</td><td>{}</td></tr>",
            escape(&standard.name(here)),
            escape(there.0),
            escape(&standard.name(there.1)),
            escape(when)
        );
    }
    body.push_str("</table>\n");
    Some(Section::new("wiring", "How to wire", body))
}
