//! The part of the interface document that the rows cannot tell: a picture of signs and frames, and which variables of
//! which FMUs belong together. No model is known here, so it is given.

use crate::html::{escape, table};
use std::fmt::Write as _;

/// What the document shows besides the rows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Guide<'a> {
    /// An `<svg>` element with signs and frames, shown inline; empty: none.
    pub picture: &'a str,
    /// Connections from and to this FMU.
    pub wiring: &'a [Connection<'a>],
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

/// Appends the picture, if there is one.
pub(crate) fn picture(page: &mut String, guide: Guide<'_>) {
    if !guide.picture.is_empty() {
        let _ = writeln!(
            page,
            "<h2 id=\"signs\">Signs and frames</h2>\n<figure>\n{}\n</figure>",
            guide.picture.trim_end()
        );
    }
}

/// Appends the table of connections, if there are some.
pub(crate) fn wiring(page: &mut String, name: &str, guide: Guide<'_>) {
    if guide.wiring.is_empty() {
        return;
    }
    page.push_str(
        "<h2 id=\"wiring\">How to wire</h2>\n<p>All elements of a vector <code>[i]</code> are connected. An input that is left open \
         keeps its start value.</p>\n",
    );
    table(page, &["Here", "", "There", "When"]);
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
            page,
            "<tr><td>{}</td><td>{arrow}</td><td>{}.{}</td><td>{}</td></tr>",
            escape(here),
            escape(there.0),
            escape(there.1),
            escape(when)
        );
    }
    page.push_str("</table>\n");
}
