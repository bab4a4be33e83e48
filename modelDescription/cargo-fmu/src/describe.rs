//! The variables of an archive as a table, whoever has written it, for FMI 2.0 or 3.0.

use crate::process::{Failure, Outcome, at};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Read as _;
use std::path::Path;

/// What the table shows of a variable; the last one is as wide as it is.
const COLUMNS: [&str; 11] = [
    "name",
    "type",
    "causality",
    "variability",
    "unit",
    "start",
    "min",
    "max",
    "maxSize",
    "mimeType",
    "description",
];

/// Those that the table has only where a variable does: a Binary.
const RARE: [&str; 2] = ["maxSize", "mimeType"];

type Attributes = BTreeMap<String, String>;

/// Most bytes of a description that are read: that of 100 000 variables has 30 MB.
const MOST_BYTES: u64 = 128 << 20;

/// The only root that a description has.
const ROOT: &str = "fmiModelDescription";

/// The table of an archive.
///
/// # Errors
/// When it is no archive with a `modelDescription.xml`.
pub fn archive(path: &Path) -> Outcome<String> {
    let file = std::fs::File::open(path).map_err(at(path))?;
    let expected = |what: String| {
        let path = path.display();
        Failure::Found(format!(
            "{path}: expected an FMU, a zip archive with modelDescription.xml: {what}"
        ))
    };
    let mut zip = zip::ZipArchive::new(file).map_err(|error| expected(error.to_string()))?;
    let mut xml = String::new();
    let entry = zip
        .by_name("modelDescription.xml")
        .map_err(|error| expected(error.to_string()))?;
    let mut entry = entry.take(MOST_BYTES + 1);
    entry
        .read_to_string(&mut xml)
        .map_err(|error| expected(format!("it cannot be read as UTF-8: {error}")))?;
    if xml.len() as u64 > MOST_BYTES {
        return Err(expected(format!("it has more than {MOST_BYTES} bytes")));
    }
    table(&xml).map_err(expected)
}

/// The table of a description.
///
/// # Errors
/// When it is no XML, or not that of a description.
pub fn table(xml: &str) -> Result<String, String> {
    let (model, variables) = read(xml)?;
    let told = |key: &str| model.get(key).map(|text| shown(text)).unwrap_or_default();
    let mut text = format!("{} (FMI {})", told("modelName"), told("fmiVersion"));
    if !told("description").is_empty() {
        let _ = write!(text, ": {}", told("description"));
    }
    text.push_str("\n\n");
    let cell = |variable: &Attributes, column: &str| {
        variable
            .get(column)
            .map(|text| shown(text))
            .unwrap_or_default()
    };
    let has = |column: &str| variables.iter().any(|one| one.contains_key(column));
    let columns = COLUMNS
        .iter()
        .filter(|column| !RARE.contains(column) || has(column));
    let columns: Vec<_> = columns.copied().collect();
    let head = columns.iter().map(|column| (*column).to_owned()).collect();
    let rows = variables.iter().map(|variable| {
        columns
            .iter()
            .map(|column| cell(variable, column))
            .collect()
    });
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    let width = |i: usize| {
        rows.iter()
            .map(|row| row[i].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<_> = (0..columns.len()).map(width).collect();
    for row in &rows {
        let cells = row.iter().zip(&widths).filter(|(_, width)| **width > 0);
        let line: Vec<_> = cells
            .map(|(cell, width)| format!("{cell:width$}"))
            .collect();
        let _ = writeln!(text, "{}", line.join("  ").trim_end());
    }
    Ok(text)
}

/// A text on one line. What it has for a terminal is shown instead of done: an archive is anybody's.
fn shown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_control() {
            shown.extend(letter.escape_default());
        } else {
            shown.push(letter);
        }
    }
    shown
}

/// Attributes of the root, and of each variable; its type is among them.
fn read(xml: &str) -> Result<(Attributes, Vec<Attributes>), String> {
    let mut reader = Reader::from_str(xml);
    let (mut model, mut variables) = (Attributes::new(), Vec::<Attributes>::new());
    // The elements that are open.
    let mut path: Vec<String> = Vec::new();
    loop {
        let event = reader.read_event().map_err(|error| error.to_string())?;
        match &event {
            Event::Start(element) | Event::Empty(element) => {
                let name = String::from_utf8_lossy(element.name().as_ref()).into_owned();
                match path.as_slice() {
                    [] if name != ROOT => return Err(format!("its root is <{}>", shown(&name))),
                    [] => model = attributes(element)?,
                    [_, list] if list == "ModelVariables" => {
                        let mut variable = attributes(element)?;
                        // FMI 3.0 names the element by the type.
                        if name != "ScalarVariable" {
                            variable.insert("type".to_owned(), name.clone());
                        }
                        variables.push(variable);
                    }
                    [_, list, outer] if list == "ModelVariables" => {
                        if let Some(variable) = variables.last_mut() {
                            inner(variable, outer, &name, attributes(element)?);
                        }
                    }
                    _ => {}
                }
                if matches!(event, Event::Start(_)) {
                    path.push(name);
                }
            }
            Event::End(_) => {
                path.pop();
            }
            Event::Eof if model.is_empty() => return Err("it is empty".to_owned()),
            Event::Eof => match path.last() {
                Some(open) => return Err(format!("it ends within <{}>", shown(open))),
                None => return Ok((model, variables)),
            },
            _ => {}
        }
    }
}

/// What an element inside a variable says of it.
fn inner(variable: &mut Attributes, outer: &str, name: &str, told: Attributes) {
    match (outer, name) {
        ("ScalarVariable", "Annotations") => {}
        ("ScalarVariable", _) => {
            variable.insert("type".to_owned(), name.to_owned());
            for (key, value) in told {
                variable.entry(key).or_insert(value);
            }
        }
        (_, "Dimension") => {
            let length = told.get("start").or(told.get("valueReference"));
            let length = length.cloned().unwrap_or_default();
            if let Some(name) = variable.get_mut("name") {
                let _ = write!(name, "[{length}]");
            }
        }
        (_, "Start") => {
            // One element for each element of an array.
            let value = told.get("value").map_or("", String::as_str);
            let start = variable.get("start");
            let start = start.map_or(value.to_owned(), |before| format!("{before} {value}"));
            variable.insert("start".to_owned(), start);
        }
        _ => {}
    }
}

fn attributes(element: &BytesStart<'_>) -> Result<Attributes, String> {
    let mut attributes = Attributes::new();
    for attribute in element.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        let key = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
        let value = attribute
            .unescape_value()
            .map_err(|error| error.to_string())?;
        attributes.insert(key, value.into_owned());
    }
    Ok(attributes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_of_fmi_2_have_the_attributes_of_their_type() {
        let xml = r#"<fmiModelDescription fmiVersion="2.0" modelName="Plant" description="a &lt; b"><ModelVariables>
            <ScalarVariable name="F" valueReference="0" description="force" causality="input" variability="continuous">
            <Real unit="N" start="0.0" max="5"/></ScalarVariable>
            <ScalarVariable name="n" valueReference="1" causality="output"><Integer/></ScalarVariable>
            </ModelVariables><ModelStructure/></fmiModelDescription>"#;
        assert_eq!(
            table(xml).unwrap(),
            "Plant (FMI 2.0): a < b\n\n\
             name  type     causality  variability  unit  start  min  max  description\n\
             F     Real     input      continuous   N     0.0         5    force\n\
             n     Integer  output\n"
        );
    }

    #[test]
    fn what_is_no_description_is_named() {
        for (xml, expected) in [
            ("", "it is empty"),
            ("<a><b>", "its root is <a>"),
            (
                "<fmiModelDescription modelName=\"a\"><b>",
                "it ends within <b>",
            ),
        ] {
            assert_eq!(table(xml), Err(expected.to_owned()));
        }
        let deep = format!(
            "<fmiModelDescription modelName=\"a\">{}",
            "<a>".repeat(1_000_000)
        );
        assert_eq!(table(&deep), Err("it ends within <a>".to_owned()));
    }

    #[test]
    fn what_a_terminal_would_do_is_shown() {
        let xml = "<fmiModelDescription modelName=\"a\u{1b}[2J\" description=\"b&#27;]0;\"><ModelVariables>\
             <ScalarVariable name=\"x&#10;y\"/></ModelVariables></fmiModelDescription>";
        let table = table(xml).unwrap();
        assert!(
            table.starts_with("a\\u{1b}[2J (FMI ): b\\u{1b}]0;\n"),
            "{table}"
        );
        assert!(table.ends_with("\nx\\ny\n"), "{table}");
    }

    #[test]
    fn a_binary_shows_what_its_bytes_are_and_how_many_there_may_be() {
        let xml = r#"<fmiModelDescription fmiVersion="3.0" modelName="Eye"><ModelVariables>
            <Binary name="png" valueReference="0" causality="parameter" mimeType="image/png" maxSize="4"><Dimension start="2"/>
            <Start value="00FF"/><Start value="10"/></Binary>
            </ModelVariables></fmiModelDescription>"#;
        let table = table(xml).unwrap();
        let last: Vec<_> = table.lines().last().unwrap().split_whitespace().collect();
        let expected = [
            "png[2]",
            "Binary",
            "parameter",
            "00FF",
            "10",
            "4",
            "image/png",
        ];
        assert_eq!(last, expected, "{table}");
    }

    #[test]
    fn variables_of_fmi_3_have_their_dimension_in_the_name() {
        let xml = r#"<fmiModelDescription fmiVersion="3.0" modelName="Arm"><ModelVariables>
            <Float64 name="q" valueReference="0" causality="input" start="0 0 0"><Dimension start="3"/></Float64>
            <String name="s" valueReference="1" causality="parameter"><Start value="x"/></String>
            </ModelVariables></fmiModelDescription>"#;
        let table = table(xml).unwrap();
        assert!(table.contains("q[3]  Float64  input"), "{table}");
        let start = format!("parameter{:21}x", "");
        assert!(table.lines().last().unwrap().ends_with(&start), "{table}");
    }
}
