//! The interface document `documentation/index.html`: one page that needs nothing but itself.

use crate::arrays::{CLOCK, CLOCK_REFERENCE};
use crate::guide::{self, Guide};
use crate::html::{Section, escape, table};
use crate::interface::Interface;
use crate::standard::Standard;
use crate::xml::{LOG_CATEGORIES, double};
use crate::{Package, deviations, licences, quick_start, variables};
use fmu_declaration::Stepping;
use std::fmt::Write as _;

const STYLE: &str = include_str!("document.css");

/// Writes the document.
///
/// # Panics
/// Never: text is written to memory.
pub fn write(
    interface: &Interface,
    package: Package<'_>,
    guide: Guide<'_>,
    standard: Standard,
) -> String {
    let name = escape(interface.name);
    let sections = sections(interface, package, guide, standard);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{name}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<h1>{name}</h1>\n<p>{} <small>{}</small></p>\n",
        escape(interface.about),
        standard.title()
    );
    page.push_str("<nav aria-label=\"Contents\">\n<ul>\n");
    for Section {
        id, title, note, ..
    } in &sections
    {
        let note = if note.is_empty() {
            String::new()
        } else {
            format!(" <small>({note})</small>")
        };
        let _ = writeln!(page, "<li><a href=\"#{id}\">{title}</a>{note}</li>");
    }
    page.push_str("</ul>\n</nav>\n");
    for Section {
        id, title, body, ..
    } in &sections
    {
        let _ = writeln!(
            page,
            "<section id=\"{id}\">\n<h2>{title}</h2>\n{body}</section>"
        );
    }
    page.push_str("</body>\n</html>\n");
    page
}

/// What the document has, in this order.
fn sections(
    interface: &Interface,
    package: Package<'_>,
    guide: Guide<'_>,
    standard: Standard,
) -> Vec<Section> {
    let mut sections = Vec::new();
    sections.extend(guide::what(guide));
    sections.extend(guide::picture(guide));
    sections.push(quick_start::section(interface, guide.system, standard));
    sections.extend(guide::wiring(interface.name, guide, standard));
    sections.push(stepping(interface, standard));
    sections.extend(variables::sections(interface, standard));
    sections.extend(enumerations(interface));
    sections.push(facts(interface, package, standard));
    sections.push(log());
    sections.push(deviations::section(standard));
    let licence = licence(package);
    sections.push(Section::new("licence", "Licence", licence));
    sections
}

fn licence(package: Package<'_>) -> String {
    let texts = package.texts.iter().map(|(name, _)| {
        let file = escape(&licences::file_name(name));
        format!("<a href=\"licenses/{file}\">{file}</a>")
    });
    let texts = texts.collect::<Vec<_>>().join(", ");
    let copyright = match package.copyright {
        "" => String::new(),
        holder => format!("{}. ", escape(holder)),
    };
    let terms = escape(&licences::terms(package.license));
    let terms = if texts.is_empty() {
        format!("{terms}.")
    } else {
        format!("{terms}: {texts}.")
    };
    format!(
        "<p>{copyright}{terms} What is linked into the libraries: <a href=\"licenses/license.txt\">licences</a>, \
         <a href=\"sbom.cdx.json\">bill of materials</a> (CycloneDX 1.5).</p>\n"
    )
}

fn facts(interface: &Interface, package: Package<'_>, standard: Standard) -> Section {
    let mut page = String::new();
    let experiment = interface.experiment;
    let seconds = |time: f64| format!("{} s", double(time));
    table(&mut page, "facts", &["", ""]);
    for (what, value) in [
        ("Standard", standard.title().to_owned()),
        ("Version", escape(package.version)),
        (
            standard.token(),
            format!("<code>{}</code>", escape(&interface.guid)),
        ),
        (
            "Default experiment",
            format!(
                "{} to {}",
                seconds(experiment.start),
                seconds(experiment.stop)
            ),
        ),
        ("Communication step size", seconds(experiment.step)),
        (
            "FMU state",
            "can be saved, restored and serialized, also into another process".to_owned(),
        ),
        (
            "Instances",
            "any number in a process, each used by one thread at a time".to_owned(),
        ),
        (
            "Value references",
            format!("<a href=\"{0}.h\">{0}.h</a>", escape(interface.name)),
        ),
    ] {
        let _ = writeln!(page, "<tr><td>{what}</td><td>{value}</td></tr>");
    }
    page.push_str("</table>\n");
    let title = format!("Standard, version, {}", standard.token());
    Section::new("facts", &title, page)
}

fn stepping(interface: &Interface, standard: Standard) -> Section {
    if standard == Standard::Fmi3Scheduled {
        return scheduled(interface);
    }
    let how = match interface.stepping {
        Stepping::Sampled => {
            "The model is sampled: ticks are counted from the start time, one sample period apart. A step from t to t + h runs the \
             ticks in [t, t + h): the first step runs the tick at the start time. At a tick the inputs are latched and that tick's \
             outputs appear, readable when the step returns; between ticks they hold. Any h &gt; 0 is accepted; many small steps and \
             one large step run the same ticks. The communication step size above is the sample period: with it, each step runs one tick, \
             whatever the time rounds: from start times up to 2e9 s, for 1e8 steps. Time is what the step sizes add up to."
        }
        Stepping::Exact => {
            "A step from t to t + h holds the inputs, divides h into equal substeps no longer than the largest substep, and ends exactly \
             at t + h. Any h &gt; 0 is accepted."
        }
    };
    let declared = match (standard, interface.stepping) {
        (Standard::Fmi3, Stepping::Sampled) => {
            " <code>fixedInternalStepSize</code> in the description is the sample period of the start values: a parameter that sets \
             another one changes the ticks, not the description."
        }
        _ => "",
    };
    let body = format!(
        "<p>{how}{declared}</p>\n<p>No output depends on an input at the same communication point. {QUANTITIES}</p>\n"
    );
    Section::new("stepping", "How it steps", body)
}

const QUANTITIES: &str = "Quantities are in SI units. Bounds are included; a value outside of them, NaN or infinite is refused when \
    it is set, but for inputs whose description says that they may be NaN.";

/// The importer's scheduler calls the ticks.
fn scheduled(interface: &Interface) -> Section {
    let body = format!(
        "<p>The model has one partition, that of the periodic clock <code>{CLOCK}</code> (value reference {CLOCK_REFERENCE}, period {} s, \
         first at the start time). <code>fmi3ActivateModelPartition</code> runs one tick: set the inputs before it, read the outputs \
         after it. The outputs are those that the co-simulation FMU shows at the end of the step that begins at the activation \
         time, bit for bit. The period is constant: a parameter that is the sample period keeps its start value, and another one is \
         refused when initialization ends, by its name.</p>\n<p>Outputs depend on inputs at the same activation. {QUANTITIES}</p>\n",
        double(interface.experiment.step)
    );
    Section::new("stepping", "How it steps", body)
}

fn enumerations(interface: &Interface) -> impl Iterator<Item = Section> {
    interface.enumerations().into_iter().map(|of| {
        let mut body = format!("<p>{}</p>\n", escape(of.about));
        table(&mut body, "items", &["Value", "Name", "Description"]);
        for item in of.items {
            let (name, about) = (escape(item.name), escape(item.about));
            let _ = writeln!(
                body,
                "<tr><td class=\"n\">{}</td><td><code>{name}</code></td><td>{about}</td></tr>",
                item.value
            );
        }
        body.push_str("</table>\n");
        Section::new(&escape(of.name), &escape(of.name), body)
    })
}

fn log() -> Section {
    let mut page = String::new();
    table(&mut page, "log", &["Category", "What"]);
    for (category, about) in LOG_CATEGORIES {
        let _ = writeln!(
            page,
            "<tr><td><code>{category}</code></td><td>{about}</td></tr>"
        );
    }
    page.push_str("</table>\n");
    Section::new("log", "Log categories", page)
}
