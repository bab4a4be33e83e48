//! The archive and the two documents in it.

mod subject;

use model_description::{Interface, archive, document, header};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Read as _};
use subject::Subject;

const LIBRARY: &[u8] = b"\x7fELF, not really";

fn interface() -> Interface {
    Interface::of::<Subject>().expect("a legal declaration")
}

fn written() -> Vec<u8> {
    let windows = archive::Binary {
        platform: "win64",
        extension: ".dll",
        bytes: b"MZ",
    };
    let linux = archive::Binary {
        platform: "linux64",
        extension: ".so",
        bytes: LIBRARY,
    };
    archive::write(&interface(), &[windows, linux]).expect("written to memory")
}

/// Path → (permissions, contents).
type Files = BTreeMap<String, (u32, Vec<u8>)>;

/// The paths in the order of the archive, and the files.
fn read(bytes: Vec<u8>) -> (Vec<String>, Files) {
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).expect("a zip archive");
    let (mut order, mut files) = (Vec::new(), BTreeMap::new());
    for i in 0..zip.len() {
        let mut file = zip.by_index(i).expect("an entry");
        let mut contents = Vec::new();
        file.read_to_end(&mut contents)
            .expect("readable, checksum right");
        assert_eq!(
            file.last_modified().map(|date| date.to_string()),
            Some("1980-01-01 00:00:00".to_owned())
        );
        order.push(file.name().to_owned());
        files.insert(
            file.name().to_owned(),
            (file.unix_mode().expect("permissions") & 0o777, contents),
        );
    }
    (order, files)
}

#[test]
fn two_archives_are_the_same_bytes() {
    assert_eq!(written(), written());
}

#[test]
fn everything_has_its_place_in_sorted_order() {
    let (order, files) = read(written());
    assert_eq!(
        order,
        [
            "binaries/linux64/Subject.so",
            "binaries/win64/Subject.dll",
            "documentation/Subject.h",
            "documentation/index.html",
            "documentation/licenses/LICENSE-APACHE.txt",
            "documentation/licenses/LICENSE-MIT.txt",
            "documentation/licenses/license.txt",
            "model.png",
            "modelDescription.xml",
            "resources/",
        ]
    );
    assert_eq!(
        files["binaries/linux64/Subject.so"],
        (0o755, LIBRARY.to_vec())
    );
    assert_eq!(files["modelDescription.xml"].0, 0o644);
    assert_eq!(
        files["modelDescription.xml"].1,
        model_description::xml(&interface()).into_bytes()
    );
    assert!(files["model.png"].1.starts_with(b"\x89PNG\r\n\x1a\n"));
    let text = |path: &str| String::from_utf8(files[path].1.clone()).expect("UTF-8");
    assert!(
        text("documentation/licenses/LICENSE-MIT.txt").contains("Permission is hereby granted")
    );
    assert!(
        text("documentation/licenses/LICENSE-APACHE.txt").contains("END OF TERMS AND CONDITIONS")
    );
    assert!(text("documentation/licenses/license.txt").contains("MIT OR Apache-2.0"));
}

#[test]
fn no_link_of_the_document_is_dead() {
    let (_, files) = read(written());
    let page = document(&interface());
    let links: Vec<_> = page
        .split("href=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap())
        .collect();
    assert!(links.len() >= 4);
    for link in links {
        let alive = match link.strip_prefix('#') {
            Some(anchor) => page.contains(&format!("id=\"{anchor}\"")),
            None => files.contains_key(&format!("documentation/{link}")),
        };
        assert!(alive, "{link}");
    }
    assert!(
        !page.contains("src=") && !page.contains("http"),
        "needs nothing but itself"
    );
}

#[test]
fn the_document_shows_every_variable_with_unit_start_range_and_description() {
    let page = document(&interface());
    for row in [
        "<td><code>u[3]</code></td><td>Real</td><td>N</td><td class=\"n\">0.3333333333333333</td><td class=\"n\">-10000.0 … 10000.0</td>\
         <td>discrete</td><td class=\"n\">2</td><td>force &amp; &quot;sign&quot;</td>",
        "<td><code>gain</code></td><td>Real</td><td>N.s/m</td><td class=\"n\">30.0</td><td class=\"n\">≥ 0.0</td><td>tunable</td>",
        "<td><code>energy.total</code></td><td>Real</td><td>J</td><td class=\"n\"></td><td>discrete</td>",
        "<td><a href=\"#Mode\">Mode</a></td><td></td><td class=\"n\">4 busy</td>",
        "<td class=\"n\">4</td><td><code>busy</code></td><td>x &lt; y &amp; z</td>",
    ] {
        assert!(page.contains(row), "{row}");
    }
    for entry in interface().scalars {
        assert_eq!(
            page.matches(&format!("<code>{}</code>", entry.name))
                .count(),
            1,
            "{}",
            entry.name
        );
    }
    for (category, _) in model_description::xml::LOG_CATEGORIES {
        assert!(page.contains(category));
    }
}

#[test]
fn the_tags_of_the_document_are_balanced() {
    let page = document(&interface());
    for tag in [
        "html", "head", "body", "table", "tr", "td", "th", "ul", "li", "p", "a", "code", "h2",
        "style",
    ] {
        let open =
            page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
        assert_eq!(open, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
}

#[test]
fn the_header_defines_each_value_reference_once() {
    let text = header(&interface());
    let defined: Vec<(&str, &str)> = text
        .lines()
        .filter_map(|line| line.strip_prefix("#define "))
        .filter_map(|line| line.split_once(' '))
        .map(|(name, rest)| (name, rest.split(' ').next().unwrap()))
        .collect();
    for wanted in [
        ("SUBJECT_U_1", "0u"),
        ("SUBJECT_ENERGY_TOTAL", "768u"),
        ("SUBJECT_ANGLE_3", "514u"),
        ("SUBJECT_MODE", "2560u"),
        ("SUBJECT_MODE_BUSY", "4"),
    ] {
        assert!(defined.contains(&wanted), "{wanted:?} in {defined:?}");
    }
    let names: BTreeSet<_> = defined.iter().map(|(name, _)| name).collect();
    assert_eq!(names.len(), defined.len());
    assert!(
        names
            .iter()
            .all(|name| model_description::name::is_identifier(name))
    );
    assert_eq!(text.matches("/*").count(), text.matches("*/").count());
}
