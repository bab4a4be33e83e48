//! The drawings in the documentation are those that the table gives.

use crate::svg;
use arm_law::supervision::table::{FAULTS, RULES, Rule};
use arm_law::supervision::{Diagnostic, State};
use std::fmt::Write as _;
use std::path::Path;

const BEGIN: &str = "<!-- from the table: begin -->\n";
const END: &str = "<!-- from the table: end -->\n";

const HOW: &str = "run `BLESS=1 cargo test -p arm-law --test supervision` and read the diff";

/// What a row asks for, in words.
fn conditions(rule: &Rule) -> String {
    let when = rule.when.iter().map(|c| c.name().to_owned());
    let unless: Vec<String> = if rule.unless == FAULTS {
        vec!["no fault".to_owned()]
    } else {
        rule.unless
            .iter()
            .map(|c| format!("not {}", c.name()))
            .collect()
    };
    when.chain(unless).collect::<Vec<_>>().join(", ")
}

fn names(states: &[State]) -> String {
    states
        .iter()
        .map(|s| s.name())
        .collect::<Vec<_>>()
        .join(", ")
}

/// The diagram: one arrow for each pair of states, its rows in order of priority.
fn diagram() -> String {
    let mut text = String::from("```mermaid\nstateDiagram-v2\n    direction LR\n    [*] --> off\n");
    for from in State::ALL {
        for to in State::ALL {
            let rows = RULES
                .iter()
                .filter(|rule| rule.to == to && rule.from.contains(&from));
            let labels: Vec<_> = rows.map(conditions).collect();
            if !labels.is_empty() {
                let (from, to) = (from.name(), to.name());
                writeln!(text, "    {from} --> {to} : {}", labels.join("<br/>")).unwrap();
            }
        }
    }
    text + "```\n"
}

fn table() -> String {
    let mut text = String::from("| | in | when | to | why |\n|---|---|---|---|---|\n");
    for (i, rule) in RULES.iter().enumerate() {
        let (from, to) = (names(rule.from), rule.to.name());
        writeln!(
            text,
            "| {} | {from} | {} | {to} | {} |",
            i + 1,
            conditions(rule),
            rule.why
        )
        .unwrap();
    }
    text
}

fn codes() -> String {
    let mut text =
        String::from("| number | state | | number | diagnostic |\n|---|---|---|---|---|\n");
    for (i, diagnostic) in Diagnostic::ALL.into_iter().enumerate() {
        let state = State::ALL
            .get(i)
            .map_or(("", String::new()), |s| (s.name(), s.number().to_string()));
        let (number, name) = (diagnostic.number(), diagnostic.name());
        writeln!(
            text,
            "| {} | {} | | {number} | `{name}` |",
            state.1, state.0
        )
        .unwrap();
    }
    text
}

#[test]
fn the_picture_shows_the_table_that_the_law_uses() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/supervision.svg");
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, svg::picture()).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    assert!(committed == svg::picture(), "{HOW}");
}

#[test]
fn the_documentation_shows_the_table_that_the_law_uses() {
    let generated = format!("{BEGIN}\n{}\n{}\n{}\n{END}", diagram(), table(), codes());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/supervision.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = text
        .split_once(BEGIN)
        .expect("docs/supervision.md has a place for it");
    let (committed, after) = rest
        .split_once(END)
        .expect("docs/supervision.md has an end of it");
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, format!("{before}{generated}{after}")).unwrap();
        return;
    }
    assert_eq!(format!("{BEGIN}{committed}{END}"), generated, "{HOW}");
}
