//! fmuResourceLocation in every spelling, and archives that lie in odd places.

use abi::{Fmu, Instance, Kind, Library, Setup, Status};
use std::path::Path;
use std::sync::Arc;

/// A folder that importers stumble over: spaces, what looks like an escape but is none, other letters, braces.
const ODD: &str = "a folder %20 für {1-2}/資源 +&#;'";

#[test]
fn a_resource_location_is_understood_in_every_spelling() {
    let fmu = Fmu::lag();
    let path = fmu.reference("resource_path");
    for (location, expected) in [
        (None, ""),
        (Some("file:/a/resources"), "/a/resources"),
        (Some("file:///a/resources"), "/a/resources"),
        (Some("file://localhost/a/resources"), "/a/resources"),
        (
            Some("file:///with space/resources"),
            "/with space/resources",
        ),
        (
            Some("file:///with%20space/resources"),
            "/with space/resources",
        ),
        (Some("file:///M%C3%BCnchen/%7B1-2%7D"), "/München/{1-2}"),
        (Some("file:///München/{1-2}"), "/München/{1-2}"),
        (Some("/plain/path"), "/plain/path"),
    ] {
        let setup = location.map_or(fmu.setup(), |l| fmu.setup().at(l));
        let instance = fmu.instantiate_as(&setup);
        assert_eq!(instance.string(path), expected, "{location:?}");
        assert_eq!(instance.messages(), [], "{location:?}");
        // Known again after a reset, and after a state came from elsewhere.
        let mut elsewhere = fmu.instantiate().state();
        assert_eq!(instance.reset(), Status::OK);
        assert_eq!(
            instance.string(path),
            expected,
            "{location:?} after fmi2Reset"
        );
        assert_eq!(instance.set_state(elsewhere), Status::OK);
        assert_eq!(
            instance.string(path),
            expected,
            "{location:?} after fmi2SetFMUstate"
        );
        assert_eq!(instance.free_state(&mut elsewhere), Status::OK);
    }
}

#[test]
fn a_resource_location_that_is_not_understood_is_a_warning_and_the_instance_works() {
    for fmu in Fmu::all() {
        for location in [
            "http://host/resources",
            "file://host/resources",
            "file:///%FF%FE",
        ] {
            let instance = fmu.instantiate_as(&fmu.setup().at(location));
            let log = instance.messages();
            let [message] = &log[..] else {
                panic!("expected one message, got {log:?}")
            };
            assert_eq!(
                (message.category.as_str(), message.status),
                ("logStatusWarning", Status::WARNING)
            );
            assert!(message.text.starts_with("fmi2Instantiate: "), "{message:?}");
            instance.initialize(0.0);
            assert_eq!(instance.step(0.0, 0.01), Status::OK);
        }
    }
}

/// Bits of the Real outputs after 50 steps with inputs near their start values.
fn run(fmu: &Fmu, setup: &Setup) -> Vec<u64> {
    let reals = |causality: &str| -> Vec<u32> {
        let reals = fmu
            .variables
            .iter()
            .filter(|v| v.causality == causality && v.kind == Kind::Real {});
        reals.map(|v| v.reference).collect()
    };
    let instance = fmu.instantiate_as(setup);
    assert_eq!(instance.messages(), [], "{:?}", setup.location);
    instance.initialize(0.0);
    let inputs = reals("input");
    let mut values = instance.get_real(&inputs).expect("inputs can be read");
    values.iter_mut().for_each(|value| *value += 0.1);
    assert_eq!(instance.set_real(&inputs, &values), Status::OK);
    for k in 0..50 {
        assert_eq!(instance.step(f64::from(k) * 0.002, 0.002), Status::OK);
    }
    let outputs = instance.get_real(&reals("output")).expect("outputs");
    outputs.into_iter().map(f64::to_bits).collect()
}

#[test]
fn where_the_resources_are_makes_no_difference_to_any_fmu() {
    for fmu in Fmu::products() {
        let expected = run(&fmu, &fmu.setup());
        let unpacked = fmu.folder.as_ref().expect("an archive").path();
        let odd = unpacked.join(ODD).join("resources");
        let (plain, escaped) = (odd.display(), Instance::uri(&odd));
        for location in [
            Instance::uri(&unpacked.join("resources")),
            format!("file:{plain}"),
            format!("file://{plain}"),
            format!("file://localhost{plain}"),
            escaped.replace("file://", "file:"),
            escaped,
            plain.to_string(),
            String::new(),
        ] {
            assert_eq!(
                run(&fmu, &fmu.setup().at(&location)),
                expected,
                "{location}"
            );
        }
    }
}

#[test]
fn a_library_in_a_folder_of_any_name_is_the_same() {
    for fmu in Fmu::products() {
        let expected = run(&fmu, &fmu.setup());
        let folder = fmu.folder.as_ref().expect("an archive").path().join(ODD);
        std::fs::create_dir_all(&folder).expect("made");
        let path = folder.join(fmu.path.file_name().expect("a file"));
        std::fs::copy(&fmu.path, &path).expect("copied");
        let there = Fmu {
            library: Arc::new(Library::load(Path::new(&path))),
            path,
            ..fmu
        };
        assert_eq!(run(&there, &there.setup()), expected, "{}", there.name);
    }
}
