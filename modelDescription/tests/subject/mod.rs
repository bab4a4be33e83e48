//! A model with a row of each kind, and a reader for what is written from it.
#![allow(dead_code, reason = "each test file uses its part")]

use declaration::unit::{self, Base, Display};
use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, Unit, Variability::*, Variable,
    boolean, enumeration, integer, real, string,
};
use std::collections::BTreeMap;

pub const RADIAN: Unit = Unit {
    name: "rad",
    base: Base {
        kg: 0,
        m: 0,
        s: 0,
        rad: 1,
    },
    display: Some(Display {
        name: "deg",
        factor: 57.295_779_513_082_32,
    }),
};

pub static MODE: Enumeration = Enumeration {
    name: "Mode",
    about: "what \"it\" does",
    items: &[
        Item {
            value: 1,
            name: "idle",
            about: "nothing",
        },
        Item {
            value: 4,
            name: "busy",
            about: "x < y & z",
        },
    ],
};

#[derive(Clone, Debug)]
pub struct Energy {
    pub total: f64,
}

#[derive(Clone, Debug)]
pub struct Subject {
    pub u: [f64; 3],
    pub on: bool,
    pub angle: [f64; 3],
    pub energy: Energy,
    pub tick: i32,
    pub scale: f64,
    pub gain: f64,
    pub tiny: f64,
    pub huge: f64,
    pub delay: i32,
    pub mode: i32,
    pub label: String,
    pub inner: f64,
    pub choice: i32,
}

impl Default for Subject {
    fn default() -> Self {
        Self {
            u: [0.25, -0.5, 1.0 / 3.0],
            on: true,
            angle: [0.0; 3],
            energy: Energy { total: f64::NAN }, // calculated: its start value is nobody's business
            tick: -1,
            scale: 0.0,
            gain: 30.0,
            tiny: 8e-5,
            huge: 1e300,
            delay: 0,
            mode: 4,
            label: "a <b> & \"c\"".into(),
            inner: 0.0,
            choice: 1,
        }
    }
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
        variables: &[
            real!(u[3], unit::NEWTON)
                .input(Discrete)
                .within(-1e4, 1e4)
                .about("force & \"sign\""),
            boolean!(on).input(Discrete).about("switch"),
            real!(angle[3], RADIAN)
                .output(Discrete)
                .initially_from(&["u[i]", "gain"])
                .about("joint angle"),
            real!(energy.total, unit::JOULE)
                .output(Discrete)
                .about("energy"),
            integer!(tick)
                .output(Discrete)
                .about("tick, −1 before the first"),
            real!(scale, unit::NONE)
                .calculated_parameter(Tunable)
                .initially_from(&["gain", "delay"])
                .about("scale"),
            real!(gain, unit::NEWTON_SECOND_PER_METRE)
                .parameter(Tunable)
                .at_least(0.0)
                .about("gain"),
            real!(tiny, unit::SECOND).parameter(Fixed).about("small"),
            real!(huge, unit::NONE).parameter(Fixed).about("large"),
            integer!(delay)
                .parameter(Fixed)
                .within_integers(0, 1)
                .about("delay"),
            enumeration!(mode, &MODE)
                .typed()
                .parameter(Fixed)
                .about("mode"),
            string!(label).parameter(Fixed).about("label"),
            real!(inner, unit::METRE).local(Discrete).about("inner"),
            enumeration!(choice, &MODE).parameter(Fixed).about("choice"),
        ],
    };
}

impl Subject {
    /// The row `mode`, of another enumeration type.
    pub fn in_mode(of: &'static Enumeration) -> Variable<Self> {
        enumeration!(mode, of).typed().parameter(Fixed)
    }

    /// The row `inner`, in another unit.
    pub fn in_unit(unit: Unit) -> Variable<Self> {
        real!(inner, unit).local(Discrete)
    }
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
