//! The interface document `documentation/index.html`: one page that needs nothing but itself.

use crate::entry::{Entry, Kind};
use crate::guide::{self, Guide};
use crate::html::{escape, table};
use crate::interface::Interface;
use crate::quick_start;
use crate::xml::{self, LOG_CATEGORIES, double, variability};
use declaration::{Causality, Stepping};
use std::fmt::Write as _;

/// Where the C interface deviates from FMI 2.0.5: more lenient than its table of legal calls (section 4.2.4), because
/// importers make these calls, or with an answer that the standard leaves open.
const DEVIATIONS: [&str; 7] = [
    "Variables can be read right after instantiation: they show the start values.",
    "Inputs can be set before Initialization Mode.",
    "<code>fmi2EnterInitializationMode</code> is accepted without <code>fmi2SetupExperiment</code>: the start time is then 0, \
     without a stop time.",
    "A refused call (wrong argument, order, value or state bytes) returns <code>fmi2Error</code>, changes nothing and does not end \
     the run. Only a failed step or a caught panic does: then <code>fmi2Reset</code>, <code>fmi2SetFMUstate</code> or \
     <code>fmi2FreeInstance</code> must follow.",
    "<code>fmi2Warning</code>, <code>fmi2Discard</code>, <code>fmi2Pending</code> and <code>fmi2Fatal</code> are never returned. \
     What is unsupported (input derivatives, output derivatives, directional derivatives, asynchronous steps) returns \
     <code>fmi2Error</code>.",
    "<code>fmi2GetRealStatus(fmi2LastSuccessfulTime)</code> and <code>fmi2GetBooleanStatus(fmi2Terminated)</code> are answered at any \
     time after initialization.",
    "A step may go past the stop time: importers end a run by a rounding past it.",
];

const STYLE: &str = "\
body{font:16px/1.5 system-ui,sans-serif;color:#1b1f24;max-width:64rem;margin:2rem auto;padding:0 1rem}
h1{margin-bottom:0}h1+p{margin-top:.2rem;color:#57606a;font-size:1.15rem}h2{margin-top:2.2rem;border-bottom:1px solid #d0d7de}
table{border-collapse:collapse;width:100%;font-size:.92rem}th{text-align:left;background:#eef3f8}
th,td{padding:.3rem .6rem;border-bottom:1px solid #d8dee4;vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
figure{margin:1rem 0}figure svg{width:100%;height:auto;background:#fff;border-radius:6px}
pre{background:#f3f6fa;padding:.7rem 1rem;overflow-x:auto;font-size:.88rem}
code{font-family:ui-monospace,monospace;font-size:.92em}td code{white-space:nowrap}
@media (prefers-color-scheme:dark){body{background:#0d1117;color:#e6edf3}h1+p{color:#9aa4af}th,pre{background:#161d27}th,td,h2{border-color:#30363d}a{color:#6cb6ff}}";

/// Writes the document.
///
/// # Panics
/// Never: text is written to memory.
pub fn write(interface: &Interface, guide: Guide<'_>) -> String {
    let name = escape(interface.name);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{name}</title>\n<style>\n{STYLE}\n</style>\n</head>\n<body>\n\
         <h1>{name}</h1>\n<p>{}</p>\n",
        escape(interface.about)
    );
    facts(&mut page, interface);
    guide::picture(&mut page, guide);
    quick_start::append(&mut page, interface, guide.wiring);
    guide::wiring(&mut page, interface.name, guide);
    stepping(&mut page, interface);
    for (title, causality) in [
        ("Inputs", Causality::Input),
        ("Outputs", Causality::Output),
        ("Parameters", Causality::Parameter),
        ("Calculated parameters", Causality::CalculatedParameter),
        ("Internal variables", Causality::Local),
    ] {
        variables(
            &mut page,
            title,
            interface
                .scalars
                .iter()
                .filter(|entry| entry.causality == causality),
        );
    }
    enumerations(&mut page, interface);
    log(&mut page);
    let _ = writeln!(page, "<h2>Deviations from FMI 2.0.5</h2>\n<ul>");
    for deviation in DEVIATIONS {
        let _ = writeln!(page, "<li>{deviation}</li>");
    }
    let _ = writeln!(
        page,
        "</ul>\n<h2>Licence</h2>\n<p>{}. {}, at your option: <a href=\"licenses/LICENSE-MIT.txt\">MIT</a>, \
         <a href=\"licenses/LICENSE-APACHE.txt\">Apache 2.0</a>. What is linked into the libraries: \
         <a href=\"licenses/license.txt\">licences</a>, <a href=\"sbom.cdx.json\">bill of materials</a> (CycloneDX 1.5).</p>\n</body>\n</html>",
        escape(xml::COPYRIGHT),
        escape(crate::LICENSE)
    );
    page
}

fn facts(page: &mut String, interface: &Interface) {
    let experiment = interface.experiment;
    let seconds = |time: f64| format!("{} s", double(time));
    table(page, &["", ""]);
    for (what, value) in [
        ("Standard", "FMI 2.0, co-simulation".to_owned()),
        ("Version", crate::VERSION.to_owned()),
        ("guid", format!("<code>{}</code>", escape(&interface.guid))),
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
}

fn stepping(page: &mut String, interface: &Interface) {
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
    let _ = writeln!(
        page,
        "<h2>How it steps</h2>\n<p>{how}</p>\n<p>No output depends on an input at the same communication point. Quantities are in SI \
         units. Bounds are included; a value outside of them, NaN or infinite is refused when it is set, but for inputs whose \
         description says that they may be NaN.</p>"
    );
}

fn variables<'a>(page: &mut String, title: &str, entries: impl Iterator<Item = &'a Entry>) {
    let mut entries = entries.peekable();
    let Some(first) = entries.peek() else { return };
    let start = !first.is_calculated();
    let _ = writeln!(page, "<h2>{title}</h2>");
    let all = [
        "Name",
        "Type",
        "Unit",
        "Start",
        "Range",
        "Changes",
        "Value reference",
        "Description",
    ];
    let columns: Vec<&str> = all
        .into_iter()
        .filter(|&column| start || column != "Start")
        .collect();
    table(page, &columns);
    for entry in entries {
        let (kind, unit, value, range) = describe(&entry.kind);
        let _ = write!(
            page,
            "<tr><td><code>{}</code></td><td>{kind}</td><td>{}</td>",
            escape(&entry.name),
            escape(unit)
        );
        if start {
            let _ = write!(page, "<td class=\"n\">{}</td>", escape(&value));
        }
        let _ = writeln!(
            page,
            "<td class=\"n\">{range}</td><td>{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
            variability(entry.variability),
            entry.reference,
            escape(entry.about)
        );
    }
    page.push_str("</table>\n");
}

/// Type, unit, start value and range, for humans.
fn describe(kind: &Kind) -> (String, &'static str, String, String) {
    match kind {
        Kind::Real {
            unit,
            start,
            min,
            max,
        } => {
            let (min, max) = (min.map(double), max.map(double));
            (
                "Real".into(),
                unit.name,
                double(*start),
                range(min.as_deref(), max.as_deref()),
            )
        }
        Kind::Integer { start, min, max } => {
            let (min, max) = (
                min.map(|value| value.to_string()),
                max.map(|value| value.to_string()),
            );
            (
                "Integer".into(),
                "",
                start.to_string(),
                range(min.as_deref(), max.as_deref()),
            )
        }
        Kind::Boolean { start } => ("Boolean".into(), "", start.to_string(), String::new()),
        Kind::String { start } => ("String".into(), "", start.clone(), String::new()),
        Kind::Enumeration { of, start, .. } => {
            let item = of
                .items
                .iter()
                .find(|item| item.value == *start)
                .map_or("", |item| item.name);
            (
                format!("<a href=\"#{0}\">{0}</a>", escape(of.name)),
                "",
                format!("{start} {item}"),
                String::new(),
            )
        }
    }
}

fn range(min: Option<&str>, max: Option<&str>) -> String {
    match (min, max) {
        (Some(min), Some(max)) => format!("{min} … {max}"),
        (Some(min), None) => format!("≥ {min}"),
        (None, Some(max)) => format!("≤ {max}"),
        (None, None) => String::new(),
    }
}

fn enumerations(page: &mut String, interface: &Interface) {
    for of in interface.enumerations() {
        let _ = writeln!(
            page,
            "<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>",
            escape(of.name),
            escape(of.about)
        );
        table(page, &["Value", "Name", "Description"]);
        for item in of.items {
            let (name, about) = (escape(item.name), escape(item.about));
            let _ = writeln!(
                page,
                "<tr><td class=\"n\">{}</td><td><code>{name}</code></td><td>{about}</td></tr>",
                item.value
            );
        }
        page.push_str("</table>\n");
    }
}

fn log(page: &mut String) {
    page.push_str("<h2>Log categories</h2>\n");
    table(page, &["Category", "What"]);
    for (category, about) in LOG_CATEGORIES {
        let _ = writeln!(
            page,
            "<tr><td><code>{category}</code></td><td>{about}</td></tr>"
        );
    }
    page.push_str("</table>\n");
}
