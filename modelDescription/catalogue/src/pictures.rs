//! The pictures say what the models compute: names, and the places of the arm's points.

use crate::FMUS;
use fmu_export::{Log, Model as _};
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
fn a_picture_names_only_what_its_fmu_has_if_it_is_the_only_one_that_shows_it() {
    for (name, others) in [
        ("HumanOperator", ["payload.m", "tau_a[1]", "q[2]"]),
        ("ExoskeletonArms", ["q[2]", "f_h", "f_a"]),
    ] {
        let fmu = crate::Fmu::named(name).expect("is listed");
        let shown = FMUS.iter().filter(|other| other.picture == fmu.picture);
        assert_eq!(shown.count(), 1, "{name} has a picture of its own");
        let names = names(fmu.picture);
        assert!(others.iter().all(|other| !names.contains(other)), "{name}");
    }
}

#[test]
fn handles_and_pad_stand_where_the_arms_have_them_at_their_start() {
    let mut arm = exoskeleton_arm::ExoskeletonArm::default();
    arm.initialize(0.0, &mut Log::silent()).expect("legal");
    let mut arms = exoskeleton_arms::ExoskeletonArms::default();
    arms.initialize(0.0, &mut Log::silent()).expect("legal");
    let picture = |name| crate::Fmu::named(name).expect("is listed").picture;
    let (one, two) = (picture("ExoskeletonArm"), picture("ExoskeletonArms"));
    // The side views: 760 to the metre, the base frame's origin at (110, 140); half of the last digit written is 0.005.
    let beside = |x: f64, z: f64| ((x - 110.0) / 760.0, (140.0 - z) / 760.0);
    let handle = |picture| {
        beside(
            number(picture, "handle", "cx"),
            number(picture, "handle", "cy"),
        )
    };
    let pad = |picture| {
        beside(
            number(picture, "pad", "x") + number(picture, "pad", "width") / 2.0,
            number(picture, "pad", "y"),
        )
    };
    // The top view of both: 400 to the metre, origin at (690, 250).
    let above = |id| {
        let (x, y) = (number(two, id, "cx"), number(two, id, "cy"));
        ((x - 690.0) / 400.0, (250.0 - y) / 400.0)
    };
    let [left, right] = [arms.outputs.left.p, arms.outputs.right.p];
    for (drawn, x, y) in [
        (handle(one), arm.outputs.p[0], arm.outputs.p[2]),
        (pad(one), arm.outputs.p_pad[0], arm.outputs.p_pad[2]),
        (handle(two), left[0], left[2]),
        (
            pad(two),
            arms.outputs.left.p_pad[0],
            arms.outputs.left.p_pad[2],
        ),
        (above("left-handle"), left[0], left[1]),
        (above("right-handle"), right[0], right[1]),
        (above("left-shoulder"), 0.0, arms.base.y),
        (above("right-shoulder"), 0.0, -arms.base.y),
    ] {
        assert!((drawn.0 - x).abs() < 2e-5, "{drawn:?} {x}");
        assert!((drawn.1 - y).abs() < 2e-5, "{drawn:?} {y}");
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
