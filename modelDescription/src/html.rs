//! Pieces of the interface document.

use std::fmt::Write as _;

/// Opens a table; without titles it has no head.
pub(crate) fn table(page: &mut String, columns: &[&str]) {
    page.push_str("<table>\n");
    if columns.iter().any(|column| !column.is_empty()) {
        let head: String = columns
            .iter()
            .map(|column| format!("<th>{column}</th>"))
            .collect();
        let _ = writeln!(page, "<tr>{head}</tr>");
    }
}

/// The text with the characters replaced that HTML reads as its own.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
