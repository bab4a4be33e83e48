//! The table as a picture: states on a circle, an arrow for each pair of states, labelled with the numbers of its rows.

use arm_law::supervision::State;
use arm_law::supervision::table::RULES;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write as _;

const SIZE: f64 = 640.0;
const CIRCLE: f64 = 250.0;
/// Radius of a state.
const NODE: f64 = 46.0;
/// Distance of an arrow from the line between its states, so that two opposite ones stand apart.
const APART: f64 = 9.0;

/// Clockwise from the top.
fn centre(state: State) -> (f64, f64) {
    let angle = TAU * f64::from(state.number()) / State::ALL.len() as f64 - FRAC_PI_2;
    (
        SIZE / 2.0 + CIRCLE * angle.cos(),
        SIZE / 2.0 + CIRCLE * angle.sin(),
    )
}

const fn colour(state: State) -> &'static str {
    match state {
        State::Engaged | State::Hold => "#cfe8cf",
        State::SoftStop => "#fbe7b2",
        State::Fault => "#f6c9c4",
        State::Off | State::Init | State::Ready => "#e4e8ee",
    }
}

fn arrow(from: State, to: State, label: &str) -> String {
    let ((x, y), (to_x, to_y)) = (centre(from), centre(to));
    let (dx, dy) = (to_x - x, to_y - y);
    let length = dx.hypot(dy);
    let (ux, uy) = (dx / length, dy / length);
    let at = |along: f64, aside: f64| (x + ux * along - uy * aside, y + uy * along + ux * aside);
    let (start, end) = (at(NODE, APART), at(length - NODE - 4.0, APART));
    let text = at(NODE + 0.28 * (length - 2.0 * NODE), APART);
    format!(
        "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#555\" stroke-width=\"1.2\" \
         marker-end=\"url(#head)\"/>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\">{label}</text>\n",
        start.0,
        start.1,
        end.0,
        end.1,
        text.0,
        text.1 + 4.0,
    )
}

/// The picture.
pub fn picture() -> String {
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\" width=\"{SIZE}\" height=\"{SIZE}\" \
         font-family=\"sans-serif\" text-anchor=\"middle\" fill=\"#222\">\n\
         <defs><marker id=\"head\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto\">\
         <path d=\"M0 0 8 4 0 8z\" fill=\"#555\"/></marker></defs>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for from in State::ALL {
        for to in State::ALL {
            let rows = (1..)
                .zip(RULES)
                .filter(|(_, rule)| rule.to == to && rule.from.contains(&from));
            let rows: Vec<String> = rows.map(|(row, _)| i32::to_string(&row)).collect();
            if !rows.is_empty() {
                text += &arrow(from, to, &rows.join(" "));
            }
        }
    }
    for state in State::ALL {
        let (x, y) = centre(state);
        let name = state.name().replace('_', " ");
        writeln!(
            text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{NODE}\" fill=\"{}\" stroke=\"#333\"/>\n\
             <text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"15\">{name}</text>",
            colour(state),
            y + 5.0
        )
        .unwrap();
    }
    text + "</svg>\n"
}
