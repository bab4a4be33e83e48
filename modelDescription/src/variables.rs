//! The interface document's tables of variables: one for each causality, with a row for each row of the declaration, so that a
//! vector's text stands there once.

use crate::entry::{Entry, Kind};
use crate::html::{Section, escape, table};
use crate::interface::Interface;
use crate::standard::Standard;
use crate::xml::{bounds, double, variability};
use crate::xml3::{float, hexadecimal};
use fmu_declaration::Causality;
use std::fmt::Write as _;

/// The sections that have variables.
pub(crate) fn sections(interface: &Interface, standard: Standard) -> impl Iterator<Item = Section> {
    let titled = [
        ("inputs", "Inputs", Causality::Input),
        ("outputs", "Outputs", Causality::Output),
        ("parameters", "Parameters", Causality::Parameter),
        (
            "calculated",
            "Calculated parameters",
            Causality::CalculatedParameter,
        ),
        ("internal", "Internal variables", Causality::Local),
    ];
    titled
        .into_iter()
        .filter_map(move |(id, title, causality)| {
            section(interface, standard, id, title, causality)
        })
}

fn section(
    interface: &Interface,
    standard: Standard,
    id: &'static str,
    title: &str,
    causality: Causality,
) -> Option<Section> {
    let entries: Vec<_> = interface
        .scalars
        .iter()
        .filter(|entry| entry.causality == causality)
        .collect();
    let first = entries.first()?;
    let start = !first.is_calculated();
    let mut body = String::new();
    let all = ["Name", "Type", "Start", "Range", "Description"];
    let columns: Vec<&str> = all
        .into_iter()
        .filter(|&column| start || column != "Start")
        .collect();
    let class = if start {
        "variables"
    } else {
        "variables calculated"
    };
    table(&mut body, class, &columns);
    let mut group = "";
    for elements in entries.chunk_by(|a, b| a.row == b.row) {
        let of = elements[0]
            .row
            .split_once('.')
            .map_or("", |(group, _)| group);
        if of != group {
            let _ = writeln!(
                body,
                "<tr class=\"group\"><th colspan=\"{}\">{}</th></tr>",
                columns.len(),
                escape(of)
            );
            group = of;
        }
        row(&mut body, standard, elements, start);
    }
    body.push_str("</table>\n");
    Some(Section {
        id: id.into(),
        title: title.into(),
        note: entries.len().to_string(),
        body,
    })
}

/// A scalar, or a vector by all of its elements.
fn row(body: &mut String, standard: Standard, elements: &[&Entry], start: bool) {
    let (first, last) = (elements[0], elements[elements.len() - 1]);
    let (kind, range) = describe(standard, &first.kind);
    let (vector, references) = if standard.is_fmi3() && first.row.contains("[i]") {
        (
            format!("<small>array of {}</small>", elements.len()),
            format!(" {}", first.reference),
        )
    } else if elements.len() > 1 {
        (
            format!("<small>i = 1 … {}</small>", elements.len()),
            format!("s {} … {}", first.reference, last.reference),
        )
    } else {
        (String::new(), format!(" {}", first.reference))
    };
    let _ = write!(
        body,
        "<tr><td><code>{}</code>{vector}</td><td data-of=\"Type\">{kind}</td>",
        escape(&standard.name(&first.row))
    );
    if start {
        let mut starts: Vec<_> = elements
            .iter()
            .map(|entry| escape(&shown(&entry.kind)))
            .collect();
        if starts.iter().all(|one| *one == starts[0]) {
            starts.truncate(1);
        }
        let _ = write!(
            body,
            "<td class=\"n\" data-of=\"Start\">{}</td>",
            starts.join(", ")
        );
    }
    let of = if range.is_empty() {
        ""
    } else {
        " data-of=\"Range\""
    };
    let _ = writeln!(
        body,
        "<td class=\"n\"{of}>{range}</td><td>{}<small>{}, value reference{references}</small></td></tr>",
        escape(first.about),
        variability(first.variability),
    );
}

/// Type with unit, and range, for humans.
fn describe(standard: Standard, kind: &Kind) -> (String, String) {
    let of_type = standard.type_name(kind);
    match kind {
        Kind::Real {
            single,
            unit,
            min,
            max,
            ..
        } => {
            let number = if *single { float } else { double };
            (
                format!("{of_type}, {}", escape(unit.name)),
                range(min.map(number), max.map(number)),
            )
        }
        Kind::Integer { of, min, max, .. } => {
            let (min, max) = if standard.is_fmi3() {
                (*min, *max)
            } else {
                bounds(*of, *min, *max)
            };
            let shown = |bound: Option<i128>| bound.map(|value| value.to_string());
            (of_type.into(), range(shown(min), shown(max)))
        }
        Kind::Boolean { .. } | Kind::String { .. } => (of_type.into(), String::new()),
        Kind::Binary {
            mime_type,
            max_size,
            ..
        } => (
            format!("{of_type}, {}", escape(mime_type)),
            max_size.map_or(String::new(), |most| format!("≤ {most} bytes")),
        ),
        Kind::Enumeration { of, .. } => (
            format!("<a href=\"#{0}\">{0}</a>", escape(of.name)),
            String::new(),
        ),
    }
}

/// The start value, for humans.
fn shown(kind: &Kind) -> String {
    match kind {
        Kind::Real {
            single: true,
            start,
            ..
        } => float(*start),
        Kind::Real { start, .. } => double(*start),
        Kind::Integer { start, .. } => start.to_string(),
        Kind::Boolean { start } => start.to_string(),
        Kind::String { start } => start.clone(),
        Kind::Binary { start, .. } => hexadecimal(start),
        Kind::Enumeration { of, start, .. } => {
            let item = of.items.iter().find(|item| item.value == *start);
            format!("{start} {}", item.map_or("", |item| item.name))
        }
    }
}

fn range(min: Option<String>, max: Option<String>) -> String {
    match (min, max) {
        (Some(min), Some(max)) => format!("{min} … {max}"),
        (Some(min), None) => format!("≥ {min}"),
        (None, Some(max)) => format!("≤ {max}"),
        (None, None) => String::new(),
    }
}
