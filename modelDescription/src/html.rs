//! Pieces of the interface document.

use std::fmt::Write as _;

/// A part of the document that the table of contents names.
pub(crate) struct Section {
    /// Where links go.
    pub id: String,
    /// Its heading.
    pub title: String,
    /// What the table of contents says beside it, if anything.
    pub note: String,
    /// What stands below the heading.
    pub body: String,
}

impl Section {
    /// A section of which the table of contents says nothing else.
    pub fn new(id: &str, title: &str, body: String) -> Self {
        Self {
            id: id.into(),
            title: title.into(),
            note: String::new(),
            body,
        }
    }
}

/// Opens a table of a class; without titles it has no head.
pub(crate) fn table(page: &mut String, class: &str, columns: &[&str]) {
    let _ = writeln!(page, "<table class=\"{class}\">");
    if columns.iter().any(|column| !column.is_empty()) {
        let head: String = columns
            .iter()
            .map(|column| format!("<th>{column}</th>"))
            .collect();
        let _ = writeln!(page, "<tr class=\"head\">{head}</tr>");
    }
}

/// The text with the characters replaced that HTML reads as its own.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
