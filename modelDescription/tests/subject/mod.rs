//! A model with a row of each kind, and a reader for what is written from it.
#![allow(dead_code, reason = "each test file uses its part")]

use fmu_declaration::unit::Base;
use fmu_declaration::{
    Access, Declare, Description, Enumeration, Experiment, Range, Rows, Start, Stepping, Unit,
    Variable, choices,
};
use std::collections::BTreeMap;

/// Whose the subject is.
pub const PACKAGE: fmu_archive::Package<'static> = fmu_archive::Package {
    version: "3.1.4",
    author: "Ada & Grace",
    copyright: "Copyright Ada <ada@example.org>",
    license: "MIT OR Zlib",
    texts: &[("LICENSE-MIT", b"as you like"), ("ZLIB.md", b"# as is")],
};

pub const RADIAN: Unit = Unit::new(
    "rad",
    Base {
        rad: 1,
        ..Base::NONE
    },
)
.shown_in("deg", 57.295_779_513_082_32, 0.0);

choices! { MODE "Mode" "what \"it\" does":
    1 "idle" "nothing";
    4 "busy" "x < y & z";
}

#[derive(Clone, Debug, Rows, Start)]
pub struct Energy {
    /// energy
    // Calculated: its start value is nobody's business.
    #[output(3, name = "energy.total", unit = JOULE, discrete, start = f64::NAN)]
    pub total: f64,
}

#[derive(Clone, Debug, Rows, Start)]
#[rows(discrete)]
pub struct Subject {
    /// force & "sign"
    #[input(0, unit = NEWTON, range = -1e4..=1e4, start = [0.25, -0.5, 1.0 / 3.0])]
    pub u: [f64; 3],
    /// switch
    #[input(1, start = true)]
    pub on: bool,
    /// joint angle
    #[output(2, unit = self::RADIAN, from = ["u[i]", "gain"])]
    pub angle: [f64; 3],
    #[part]
    pub energy: Energy,
    /// tick, −1 before the first
    #[output(4, start = -1)]
    pub tick: i32,
    /// scale
    #[calculated(5, tunable, from = ["gain", "delay"])]
    pub scale: f64,
    /// gain
    #[parameter(6, unit = NEWTON_SECOND_PER_METRE, range = 0.0.., tunable, start = 30.0)]
    pub gain: f64,
    /// small
    #[parameter(7, unit = SECOND, start = 8e-5)]
    pub tiny: f64,
    /// large
    #[parameter(8, start = 1e300)]
    pub huge: f64,
    /// delay
    #[parameter(9, integers = 0..=1)]
    pub delay: i32,
    /// mode
    #[parameter(10, items = MODE, typed, start = 4)]
    pub mode: i32,
    /// label
    #[parameter(11, start = "a <b> & \"c\"".into())]
    pub label: String,
    /// inner
    #[local(12, unit = METRE)]
    pub inner: f64,
    /// choice
    #[parameter(13, items = MODE, start = 1)]
    pub choice: i32,
}

impl Declare for Subject {
    const DESCRIPTION: Description<Self> = Description {
        name: "Subject",
        about: "A row of each kind, with ττ & <angles>",
        stepping: Stepping::Sampled,
        experiment: Experiment {
            start: 0.0,
            stop: 60.0,
            tolerance: 1e-6,
            step: 0.002,
        },
        variables: Self::ROWS,
    };
}

impl Subject {
    /// The row `mode`, of another enumeration type.
    pub fn in_mode(of: &'static Enumeration) -> Variable<Self> {
        let row = Self::DESCRIPTION.variables[10];
        let Access::Enumeration { declared, at, .. } = row.access else {
            panic!("{} is no choice", row.name);
        };
        let access = Access::Enumeration { of, declared, at };
        Variable { access, ..row }
    }

    /// The row `inner`, in another unit.
    pub fn in_unit(unit: Unit) -> Variable<Self> {
        let row = Self::DESCRIPTION.variables[12];
        let Access::Real { range, at, .. } = row.access else {
            panic!("{} is no Real", row.name);
        };
        let access = Access::Real { unit, range, at };
        Variable { access, ..row }
    }
}

/// A row of a Real with other bounds.
pub fn within(row: Variable<Subject>, low: f64, high: f64) -> Variable<Subject> {
    let Access::Real { unit, at, .. } = row.access else {
        panic!("{} is no Real", row.name);
    };
    let range = Range::new(low, high, "a finite value within its bounds");
    let access = Access::Real { unit, range, at };
    Variable { access, ..row }
}

/// The subject's description with one row replaced.
pub fn with_row(
    position: usize,
    change: impl FnOnce(Variable<Subject>) -> Variable<Subject>,
) -> Description<Subject> {
    let mut rows = Subject::DESCRIPTION.variables.to_vec();
    rows[position] = change(rows[position]);
    Description {
        variables: rows.leak(),
        ..Subject::DESCRIPTION
    }
}

/// One element of an XML text: path of names, attributes.
#[derive(Debug)]
pub struct Element {
    pub path: String,
    pub attributes: BTreeMap<String, String>,
}

impl Element {
    pub fn get(&self, attribute: &str) -> Option<&str> {
        self.attributes.get(attribute).map(String::as_str)
    }
}

/// All elements, in order of their opening tags.
pub fn elements(xml: &str) -> Vec<Element> {
    use quick_xml::events::{BytesStart, Event};
    let mut reader = quick_xml::Reader::from_str(xml);
    let (mut path, mut found) = (Vec::<String>::new(), Vec::new());
    let element = |path: &[String], tag: &BytesStart<'_>| Element {
        path: path.join("/"),
        attributes: tag
            .attributes()
            .map(|attribute| {
                let attribute = attribute.expect("well-formed attribute");
                let key = String::from_utf8(attribute.key.as_ref().to_vec()).expect("UTF-8");
                (
                    key,
                    attribute
                        .unescape_value()
                        .expect("known entities")
                        .into_owned(),
                )
            })
            .collect(),
    };
    let name =
        |tag: &BytesStart<'_>| String::from_utf8(tag.name().as_ref().to_vec()).expect("UTF-8");
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Start(tag) => {
                path.push(name(&tag));
                found.push(element(&path, &tag));
            }
            Event::Empty(tag) => {
                path.push(name(&tag));
                found.push(element(&path, &tag));
                path.pop();
            }
            Event::End(_) => {
                path.pop();
            }
            Event::Eof => return found,
            _ => {}
        }
    }
}

/// The elements of the XML of FMI 2.0.
pub fn written() -> Vec<Element> {
    elements(&fmu_archive::xml(
        &fmu_archive::Interface::of::<Subject>().expect("a legal declaration"),
        PACKAGE,
    ))
}

/// Where those of one path stand.
pub fn under(all: &[Element], path: &str) -> Vec<usize> {
    (0..all.len())
        .filter(|&i| all[i].path == format!("fmiModelDescription/{path}"))
        .collect()
}

/// Variables in order, with the element that says their type.
pub fn variables(all: &[Element]) -> Vec<(&Element, &Element)> {
    under(all, "ModelVariables/ScalarVariable")
        .into_iter()
        .map(|i| (&all[i], &all[i + 1]))
        .collect()
}

/// The one of this name.
pub fn variable<'a>(all: &'a [Element], name: &str) -> (&'a Element, &'a Element) {
    variables(all)
        .into_iter()
        .find(|(v, _)| v.get("name") == Some(name))
        .unwrap_or_else(|| panic!("no {name}"))
}

/// Numbers in a list.
pub fn indices(text: &str) -> Vec<usize> {
    text.split_whitespace()
        .map(|word| word.parse().expect("an index"))
        .collect()
}
