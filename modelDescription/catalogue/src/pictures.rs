//! The pictures say what the models compute: names, and the places of the arm's points.

use crate::FMUS;
use export::{Log, Model as _};
use std::collections::BTreeSet;

/// Contents of the labels that are variables' names.
fn names(picture: &str) -> Vec<&str> {
    let labels = picture.split("<tspan class=\"variable\"").skip(1);
    labels
        .map(|label| {
            let text = label.split_once('>').expect("an open tag").1;
            text.split('<').next().expect("text")
        })
        .collect()
}

/// A number in the element with this id.
fn number(picture: &str, id: &str, attribute: &str) -> f64 {
    let element = picture
        .split_once(&format!("id=\"{id}\""))
        .unwrap_or_else(|| panic!("no {id}"))
        .1;
    let value = element
        .split_once(&format!("{attribute}=\""))
        .expect("the attribute")
        .1;
    value.split('"').next().unwrap().parse().expect("a number")
}

#[test]
fn each_name_in_a_picture_is_a_variable_of_an_fmu_that_shows_it() {
    for fmu in FMUS {
        let mut known = BTreeSet::new();
        for other in FMUS.iter().filter(|other| other.picture == fmu.picture) {
            for entry in other.interface().expect("legal").scalars {
                known.insert(entry.name.split('[').next().unwrap().to_owned());
                known.insert(entry.name);
            }
        }
        let names = names(fmu.picture);
        assert!(names.len() >= 10, "{}: {names:?}", fmu.name);
        for name in names {
            assert!(known.contains(name), "{}: {name}", fmu.name);
        }
    }
}

#[test]
fn handle_and_pad_stand_where_the_arm_has_them_at_its_start() {
    let mut arm = exoskeleton_arm::ExoskeletonArm::default();
    arm.initialize(0.0, &mut Log::silent()).expect("legal");
    let picture = FMUS
        .iter()
        .find(|fmu| fmu.name == "ExoskeletonArm")
        .expect("is listed")
        .picture;
    // The side view: 760 to the metre, the base frame's origin at (110, 140); half of the last digit written is 0.005.
    let drawn = |x: f64, y: f64| ((x - 110.0) / 760.0, (140.0 - y) / 760.0);
    let handle = drawn(
        number(picture, "handle", "cx"),
        number(picture, "handle", "cy"),
    );
    let pad = drawn(
        number(picture, "pad", "x") + number(picture, "pad", "width") / 2.0,
        number(picture, "pad", "y"),
    );
    for (drawn, point) in [(handle, arm.outputs.p), (pad, arm.outputs.p_pad)] {
        assert!((drawn.0 - point[0]).abs() < 1e-5, "{drawn:?} {point:?}");
        assert!((drawn.1 - point[2]).abs() < 1e-5, "{drawn:?} {point:?}");
    }
}

#[test]
fn icons_are_small_pngs_and_differ() {
    let icons: BTreeSet<_> = FMUS.iter().map(|fmu| fmu.icon).collect();
    assert_eq!(icons.len(), FMUS.len());
    for fmu in FMUS {
        assert!(fmu.icon.starts_with(b"\x89PNG\r\n\x1a\n"), "{}", fmu.name);
        let side = |at: usize| u32::from_be_bytes(fmu.icon[at..at + 4].try_into().unwrap());
        assert_eq!((side(16), side(20)), (128, 128), "{}", fmu.name);
        assert!(fmu.icon.len() < 30_000, "{}", fmu.name);
    }
}
