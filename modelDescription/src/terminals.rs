//! `terminalsAndIcons/terminalsAndIcons.xml`: which variables belong to one connector, so that an importer connects two models
//! by one line instead of one a variable (FMI 3.0, section 2.4.9). FMI 2.0 has none. No model is known here, so the terminals
//! are given.

use crate::schema::element;
use crate::xml::{self, double};
use serde::Serialize;

/// Version of the schema, which must be that of the description.
const VERSION: &str = "3.0";
/// Half the side of the coordinate system, and of the icon in it; the default of the standard.
const HALF: f64 = 100.0;
/// Half the side of a terminal's picture.
const HALF_TERMINAL: f64 = 12.0;

/// How the members of two terminals find each other: by name in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matching {
    /// Each member must have its counterpart.
    Plug,
    /// Members without a counterpart are left alone.
    Bus,
}

/// One terminal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Terminal {
    /// Its name.
    pub name: String,
    /// What it is connected to.
    pub about: String,
    /// How its members find theirs.
    pub matching: Matching,
    /// Its members.
    pub members: Vec<Member>,
    /// Its picture: the name of the file without `.png`, and its bytes.
    pub icon: (&'static str, &'static [u8]),
}

/// One variable of a terminal.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Member {
    /// What it is in the connection: the name that the other terminal has for it, too.
    pub name: String,
    /// The variable as FMI 3.0 names it.
    pub variable: String,
}

/// Paths below `terminalsAndIcons/`, with contents: the description, the icon of the model, the pictures of the terminals.
pub fn files(terminals: &[Terminal], icon: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut files = vec![
        (
            "terminalsAndIcons.xml".to_owned(),
            write(terminals).into_bytes(),
        ),
        ("icon.png".to_owned(), icon.to_vec()),
    ];
    for Terminal {
        icon: (name, bytes),
        ..
    } in terminals
    {
        let path = format!("{name}.png");
        if !files.iter().any(|(known, _)| *known == path) {
            files.push((path, bytes.to_vec()));
        }
    }
    files
}

/// Writes the description.
///
/// # Panics
/// When quick-xml cannot write our own elements: a programming error that the first test shows.
pub fn write(terminals: &[Terminal]) -> String {
    let square = Square::around(0.0, 0.0, HALF);
    xml::text(&Root {
        fmi_version: VERSION.into(),
        graphics: Graphics {
            coordinates: Coordinates {
                square: square.clone(),
                scale: double(0.1),
            },
            icon: Icon { square },
        },
        terminals: (!terminals.is_empty()).then(|| Terminals {
            list: (0..).zip(terminals).map(terminal).collect(),
        }),
    })
}

fn terminal((place, terminal): (u32, &Terminal)) -> Element {
    // On the right edge, downwards.
    let y = HALF - HALF_TERMINAL - f64::from(place) * 2.5 * HALF_TERMINAL;
    Element {
        name: terminal.name.clone(),
        matching: match terminal.matching {
            Matching::Plug => "plug",
            Matching::Bus => "bus",
        }
        .into(),
        description: terminal.about.clone(),
        members: terminal
            .members
            .iter()
            .map(|member| MemberElement {
                variable: member.variable.clone(),
                member: member.name.clone(),
                kind: "signal".into(),
            })
            .collect(),
        graphics: TerminalGraphics {
            square: Square::around(HALF, y, HALF_TERMINAL),
            icon: terminal.icon.0.into(),
        },
    }
}

type Text = String;

element! {
    /// The root.
    #[serde(rename = "fmiTerminalsAndIcons")]
    Root {
        #[serde(rename = "@fmiVersion")] fmi_version: Text,
        #[serde(rename = "GraphicalRepresentation")] graphics: Graphics,
        #[serde(rename = "Terminals", skip_serializing_if = "Option::is_none")] terminals: Option<Terminals>,
    }
}
element! {
    /// Where the icon is.
    Graphics {
        #[serde(rename = "CoordinateSystem")] coordinates: Coordinates,
        #[serde(rename = "Icon")] icon: Icon,
    }
}
element! {
    /// Two corners.
    Square {
        #[serde(rename = "@x1")] x1: Text,
        #[serde(rename = "@y1")] y1: Text,
        #[serde(rename = "@x2")] x2: Text,
        #[serde(rename = "@y2")] y2: Text,
    }
}
element! {
    /// The coordinate system.
    Coordinates {
        #[serde(flatten)] square: Square,
        #[serde(rename = "@suggestedScalingFactorTo_mm")] scale: Text,
    }
}
element! {
    /// The model's icon.
    Icon { #[serde(flatten)] square: Square }
}
element! {
    /// The terminals.
    Terminals { #[serde(rename = "Terminal")] list: Vec<Element> }
}
element! {
    /// One terminal.
    Element {
        #[serde(rename = "@name")] name: Text,
        #[serde(rename = "@matchingRule")] matching: Text,
        #[serde(rename = "@description")] description: Text,
        #[serde(rename = "TerminalMemberVariable")] members: Vec<MemberElement>,
        #[serde(rename = "TerminalGraphicalRepresentation")] graphics: TerminalGraphics,
    }
}
element! {
    /// One member.
    MemberElement {
        #[serde(rename = "@variableName")] variable: Text,
        #[serde(rename = "@memberName")] member: Text,
        #[serde(rename = "@variableKind")] kind: Text,
    }
}
element! {
    /// A terminal's picture.
    TerminalGraphics {
        #[serde(flatten)] square: Square,
        #[serde(rename = "@iconBaseName")] icon: Text,
    }
}

impl Square {
    fn around(x: f64, y: f64, half: f64) -> Self {
        Self {
            x1: double(x - half),
            y1: double(y - half),
            x2: double(x + half),
            y2: double(y + half),
        }
    }
}
