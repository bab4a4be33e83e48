//! The archives of FMI 3.0, and the documents in them.

mod subject;

use fmu_archive::archive::{self, Binary, Contents};
use fmu_archive::{
    Connection, Guide, Interface, Matching, Member, Standard, Terminal, document, header, terminals,
};
use std::collections::{BTreeMap, BTreeSet};
use subject::{PACKAGE, Subject, elements};

const PICTURE: &[u8] = b"\x89PNG, not really";

fn interface() -> Interface {
    Interface::of::<Subject>().expect("a legal declaration")
}

fn terminals() -> Vec<Terminal> {
    let terminal = |name: &str, matching, members: &[(&str, &str)]| Terminal {
        name: name.into(),
        about: "a <line>".into(),
        matching,
        members: members
            .iter()
            .map(|(name, variable)| Member {
                name: (*name).into(),
                variable: (*variable).into(),
            })
            .collect(),
        icon: ("joint", PICTURE),
    };
    vec![
        terminal(
            "left",
            Matching::Plug,
            &[("force", "u"), ("angle", "angle")],
        ),
        terminal("right", Matching::Bus, &[("on", "on")]),
    ]
}

fn files(standard: Standard) -> BTreeMap<String, Vec<u8>> {
    let binary = |platform, extension| Binary {
        platform,
        extension,
        bytes: b"library",
    };
    let (interface, terminals) = (interface(), terminals());
    let contents = Contents {
        standard,
        binaries: &[
            binary("linux64", ".so"),
            binary("win64", ".dll"),
            binary("darwin64", ".dylib"),
            binary("aarch64-linux", ".so"),
            binary("aarch64-darwin", ".dylib"),
        ],
        terminals: &terminals,
        package: PACKAGE,
        ..Contents::of(&interface)
    };
    archive::files(&contents).into_iter().collect()
}

#[test]
fn everything_lies_where_fmi_3_has_it() {
    let files = files(Standard::Fmi3);
    let paths: Vec<_> = files.keys().map(String::as_str).collect();
    assert_eq!(
        paths,
        [
            "binaries/aarch64-darwin/Subject.dylib",
            "binaries/aarch64-linux/Subject.so",
            "binaries/x86_64-darwin/Subject.dylib",
            "binaries/x86_64-linux/Subject.so",
            "binaries/x86_64-windows/Subject.dll",
            "documentation/Subject.h",
            "documentation/index.html",
            "documentation/licenses/LICENSE-MIT.txt",
            "documentation/licenses/ZLIB.md",
            "documentation/licenses/license.txt",
            "documentation/sbom.cdx.json",
            "modelDescription.xml",
            "resources/",
            "terminalsAndIcons/icon.png",
            "terminalsAndIcons/joint.png",
            "terminalsAndIcons/terminalsAndIcons.xml",
        ]
    );
    assert_eq!(files["terminalsAndIcons/joint.png"], PICTURE);
    assert!(files["terminalsAndIcons/icon.png"].starts_with(b"\x89PNG\r\n\x1a\n"));
    let description = Standard::Fmi3.description(&interface(), PACKAGE);
    assert_eq!(files["modelDescription.xml"], description.into_bytes());
}

#[test]
fn fmi_2_has_no_terminals_and_its_own_names_of_platforms() {
    let files = files(Standard::Fmi2);
    assert!(
        files
            .keys()
            .all(|path| !path.starts_with("terminalsAndIcons"))
    );
    assert!(files.contains_key("binaries/linux64/Subject.so") && files.contains_key("model.png"));
}

#[test]
fn the_library_and_its_token_are_the_same_in_all_archives() {
    let [two, three, scheduled] = Standard::ALL.map(files);
    let library = |files: &BTreeMap<_, Vec<u8>>, folder: &str| {
        files[&format!("binaries/{folder}/Subject.so")].clone()
    };
    assert_eq!(library(&two, "linux64"), library(&three, "x86_64-linux"));
    assert_eq!(
        library(&three, "x86_64-linux"),
        library(&scheduled, "x86_64-linux")
    );
    let token = interface().guid;
    for files in [two, three, scheduled] {
        let xml = String::from_utf8(files["modelDescription.xml"].clone()).expect("UTF-8");
        assert!(xml.contains(&token));
    }
}

#[test]
fn terminals_say_their_rule_their_members_and_where_their_picture_is() {
    let all = elements(&terminals::write(&terminals()));
    let of = |path: &str, keys: &[&str]| -> Vec<Vec<String>> {
        let found = all
            .iter()
            .filter(|one| one.path == format!("fmiTerminalsAndIcons/{path}"));
        found
            .map(|one| {
                keys.iter()
                    .map(|key| one.get(key).unwrap().to_owned())
                    .collect()
            })
            .collect()
    };
    assert_eq!(all[0].get("fmiVersion"), Some("3.0"));
    assert_eq!(
        of(
            "Terminals/Terminal",
            &["name", "matchingRule", "description"]
        ),
        [["left", "plug", "a <line>"], ["right", "bus", "a <line>"]]
    );
    let member = "Terminals/Terminal/TerminalMemberVariable";
    assert_eq!(
        of(member, &["memberName", "variableName", "variableKind"]),
        [
            ["force", "u", "signal"],
            ["angle", "angle", "signal"],
            ["on", "on", "signal"]
        ]
    );
    let pictures = of(
        "Terminals/Terminal/TerminalGraphicalRepresentation",
        &["iconBaseName", "x1", "y1", "x2", "y2"],
    );
    assert_eq!(pictures.len(), 2);
    assert!(pictures.iter().all(|one| one[0] == "joint"));
    // Beside each other, each its lower left corner first.
    let number = |text: &String| text.parse::<f64>().expect("a number");
    for one in &pictures {
        assert!(number(&one[1]) < number(&one[3]) && number(&one[2]) < number(&one[4]));
    }
    assert!(number(&pictures[1][4]) < number(&pictures[0][2]));
    assert_eq!(
        of("GraphicalRepresentation/Icon", &["x1", "y1", "x2", "y2"]),
        [["-100.0", "-100.0", "100.0", "100.0"]]
    );
}

#[test]
fn a_model_without_terminals_has_its_icon_all_the_same() {
    let text = terminals::write(&[]);
    assert!(
        text.contains("<Icon ") && !text.contains("Terminals>"),
        "{text}"
    );
    let files = terminals::files(&[], PICTURE);
    assert!(files.contains(&("icon.png".to_owned(), PICTURE.to_vec())));
}

#[test]
fn the_header_has_one_value_reference_for_an_array_and_the_clock_of_a_scheduler() {
    let defined = |standard| -> BTreeMap<String, String> {
        let text = header(&interface(), standard);
        let lines = text
            .lines()
            .filter_map(|line| line.strip_prefix("#define "));
        lines
            .filter_map(|line| line.split_once(' '))
            .map(|(name, rest)| (name.to_owned(), rest.to_owned()))
            .collect()
    };
    let three = defined(Standard::Fmi3);
    assert_eq!(
        three["SUBJECT_U"],
        "0u /* discrete input u[3]: Float64, N */"
    );
    assert_eq!(
        three["SUBJECT_MODE"],
        "2560u /* fixed parameter mode: Enumeration, item of Mode */"
    );
    assert_eq!(
        three["SUBJECT_TICK"],
        "1024u /* discrete output tick: Int32 */"
    );
    assert_eq!(
        three["SUBJECT_INSTANTIATION_TOKEN"],
        format!("\"{}\"", interface().guid)
    );
    assert!(!three.contains_key("SUBJECT_U_1") && !three.contains_key("SUBJECT_CLOCK"));
    let scheduled = defined(Standard::Fmi3Scheduled);
    assert!(scheduled["SUBJECT_CLOCK"].starts_with("4294967294u "));
    assert!(three.keys().all(|name| scheduled.contains_key(name)));
}

#[test]
fn the_document_says_its_version_and_names_variables_as_it_does() {
    let connection = Connection {
        from: ("Other", "y[i]"),
        to: ("Subject", "u[i]"),
        when: "",
    };
    let guide = Guide {
        wiring: &[connection],
        ..Guide::default()
    };
    let page = |standard| document(&interface(), PACKAGE, guide, standard);
    let [two, three, scheduled] = Standard::ALL.map(page);
    for (page, standard) in [
        (&two, Standard::Fmi2),
        (&three, Standard::Fmi3),
        (&scheduled, Standard::Fmi3Scheduled),
    ] {
        let shown: BTreeSet<_> = Standard::ALL
            .into_iter()
            .filter(|one| page.contains(one.title()))
            .map(Standard::title)
            .collect();
        assert_eq!(shown, BTreeSet::from([standard.title()]));
        let head = page.split_once("<nav").expect("contents").0;
        assert!(head.contains(standard.title()), "before anything else");
    }
    for part in [
        "<td><code>u</code><small>array of 3</small></td><td data-of=\"Type\">Float64, N</td>",
        "<small>discrete, value reference 0</small>",
        "<tr><td>u</td><td>←</td><td>Other.y</td>",
        "<td data-of=\"Type\">Int32</td>",
        "instantiationToken",
    ] {
        assert!(
            three.contains(part) && scheduled.contains(part) && !two.contains(part),
            "{part}"
        );
    }
    for (page, forbidden) in [(&two, "fmi3"), (&three, "fmi2"), (&scheduled, "fmi2")] {
        assert!(!page.contains(forbidden), "{forbidden}");
    }
    assert!(scheduled.contains("fmi3ActivateModelPartition(instance, SUBJECT_CLOCK"));
    assert!(!three.contains("fmi3ActivateModelPartition"));
    assert!(!three.contains("[i]") && !scheduled.contains("[i]"));
}
