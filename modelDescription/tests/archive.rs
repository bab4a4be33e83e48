//! The archive and the two documents in it.

mod subject;

use fmu_archive::archive::{self, Contents};
use fmu_archive::{Component, Connection, Guide, Interface, Standard, System, document, header};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Read as _};
use subject::{PACKAGE, Subject};

const LIBRARY: &[u8] = b"\x7fELF, not really";

fn interface() -> Interface {
    Interface::of::<Subject>().expect("a legal declaration")
}

const GUIDE: Guide<'static> = Guide {
    what: "<p>It does <code>what</code> it does.</p>",
    picture: "<svg viewBox=\"0 0 1 1\"><path d=\"M0 0h1\"/></svg>",
    wiring: &[
        Connection {
            from: ("Other", "y[i]"),
            to: ("Subject", "u[i]"),
            when: "",
        },
        Connection {
            from: ("Subject", "angle[i]"),
            to: ("Third", "angle[i]"),
            when: "it is < there",
        },
    ],
    system: System {
        parts: &[("one", "Subject"), ("other", "Other")],
        wires: &[(("other", "y[i]"), ("one", "u[i]"))],
        start: &[("one", "gain", "2.5")],
    },
};

/// A component with texts that uses one of this project.
fn linked() -> Vec<Component> {
    let own = Component {
        name: "part".into(),
        version: "1.0.0".into(),
        license: "MIT OR Apache-2.0".into(),
        purl: None,
        sha256: None,
        texts: Vec::new(),
        uses: Vec::new(),
    };
    let foreign = Component {
        name: "libx".into(),
        version: "0.2.16".into(),
        license: "MIT".into(),
        purl: Some("pkg:cargo/libx@0.2.16".into()),
        sha256: Some("ab".repeat(32)),
        texts: vec![("LICENSE.txt".into(), b"libx: as you like".to_vec())],
        uses: vec!["part-1.0.0".into()],
    };
    vec![foreign, own]
}

fn page() -> String {
    document(&interface(), PACKAGE, GUIDE, Standard::Fmi2)
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
    archive::write(&Contents {
        binaries: &[windows, linux],
        package: PACKAGE,
        linked: &linked(),
        guide: GUIDE,
        ..Contents::of(&interface())
    })
    .expect("written to memory")
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
            "documentation/licenses/LICENSE-MIT.txt",
            "documentation/licenses/ZLIB.md",
            "documentation/licenses/libx-0.2.16/LICENSE.txt",
            "documentation/licenses/license.txt",
            "documentation/sbom.cdx.json",
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
        fmu_archive::xml(&interface(), PACKAGE).into_bytes()
    );
    assert!(files["model.png"].1.starts_with(b"\x89PNG\r\n\x1a\n"));
    let text = |path: &str| String::from_utf8(files[path].1.clone()).expect("UTF-8");
    assert_eq!(
        text("documentation/licenses/LICENSE-MIT.txt"),
        "as you like"
    );
    let overview = text("documentation/licenses/license.txt");
    assert!(
        overview.starts_with(
            "Subject 3.1.4\nCopyright Ada <ada@example.org>\n\nLicensed under MIT OR Zlib, at your option:\n\
             LICENSE-MIT.txt or ZLIB.md in this folder.\n"
        ),
        "{overview}"
    );
}

#[test]
fn whose_the_model_is_stands_in_document_and_bill_and_nothing_of_this_project_does() {
    let (_, files) = read(written());
    let text = |path: &str| String::from_utf8(files[path].1.clone()).expect("UTF-8");
    let page = text("documentation/index.html");
    for told in [
        "<td>3.1.4</td>",
        "Copyright Ada &lt;ada@example.org&gt;. Licensed under MIT OR Zlib, at your option: \
         <a href=\"licenses/LICENSE-MIT.txt\">LICENSE-MIT.txt</a>, <a href=\"licenses/ZLIB.md\">ZLIB.md</a>.",
    ] {
        assert!(page.contains(told), "{told}");
    }
    let bill: serde_json::Value =
        serde_json::from_str(&text("documentation/sbom.cdx.json")).unwrap();
    let whole = &bill["metadata"]["component"];
    assert_eq!(whole["version"], "3.1.4");
    assert_eq!(whole["licenses"][0]["expression"], "MIT OR Zlib");
    for (path, (_, bytes)) in &files {
        let told = String::from_utf8_lossy(bytes);
        assert!(!told.contains("authors of this project"), "{path}");
    }
}

#[test]
fn a_package_that_says_nothing_of_itself_claims_nothing() {
    let (_, files) = read(archive::write(&Contents::of(&interface())).expect("written to memory"));
    let text = |path: &str| String::from_utf8(files[path].1.clone()).expect("UTF-8");
    let overview = text("documentation/licenses/license.txt");
    assert_eq!(overview, "Subject\n\nThe package names no licence.\n");
    let bill: serde_json::Value =
        serde_json::from_str(&text("documentation/sbom.cdx.json")).unwrap();
    assert!(bill["metadata"]["component"]["licenses"].is_null());
    let xml = text("modelDescription.xml");
    for attribute in ["author", "version", "copyright", "license"] {
        assert!(!xml.contains(&format!(" {attribute}=\"\"")), "{attribute}");
    }
}

#[test]
fn each_linked_component_is_named_with_its_licence_and_only_foreign_ones_have_a_folder() {
    let (_, files) = read(written());
    let overview =
        String::from_utf8(files["documentation/licenses/license.txt"].1.clone()).unwrap();
    assert!(overview.ends_with("\n\nlibx-0.2.16  MIT\n"), "{overview}");
    assert_eq!(
        files["documentation/licenses/libx-0.2.16/LICENSE.txt"].1,
        b"libx: as you like"
    );
}

#[test]
fn the_bill_of_materials_lists_parts_hashes_licences_and_who_uses_whom() {
    let (_, files) = read(written());
    let bill: serde_json::Value =
        serde_json::from_slice(&files["documentation/sbom.cdx.json"].1).expect("JSON");
    assert_eq!(
        (&bill["bomFormat"], &bill["specVersion"]),
        (&"CycloneDX".into(), &"1.5".into())
    );
    // Neither of them belongs into something that is the same for the same parts.
    assert!(bill["serialNumber"].is_null() && bill["metadata"]["timestamp"].is_null());
    assert_eq!(bill["metadata"]["component"]["name"], "Subject");
    assert_eq!(
        bill["metadata"]["component"]["properties"][0]["value"],
        interface().guid
    );
    let [foreign, own] = bill["components"].as_array().unwrap().as_slice() else {
        panic!("two components");
    };
    assert_eq!(foreign["purl"], "pkg:cargo/libx@0.2.16");
    assert_eq!(foreign["hashes"][0]["content"], "ab".repeat(32));
    assert_eq!(foreign["licenses"][0]["expression"], "MIT");
    assert!(own["purl"].is_null() && own["hashes"].is_null());
    assert_eq!(
        bill["dependencies"],
        serde_json::json!([
            { "ref": "Subject", "dependsOn": ["libx-0.2.16"] },
            { "ref": "libx-0.2.16", "dependsOn": ["part-1.0.0"] },
            { "ref": "part-1.0.0", "dependsOn": [] },
        ])
    );
}

#[test]
fn picture_and_wiring_are_in_the_document() {
    let page = page();
    assert!(page.contains(GUIDE.picture));
    for row in [
        "<tr><td>u[i]</td><td>←</td><td>Other.y[i]</td><td>always</td></tr>",
        "<tr><td>angle[i]</td><td>→</td><td>Third.angle[i]</td><td>it is &lt; there</td></tr>",
        "    &quot;one&quot;: &quot;Subject.fmu&quot;,\n    &quot;other&quot;: &quot;Other.fmu&quot;,\n",
        "    (&quot;other&quot;, &quot;y[i]&quot;, &quot;one&quot;, &quot;u[i]&quot;),\n",
        "model.setValue(CRef(&quot;default&quot;, &quot;one&quot;, &quot;gain&quot;), 2.5)\n",
        "<h2>What it does</h2>\n<p>It does <code>what</code> it does.</p>",
    ] {
        assert!(page.contains(row), "{row}");
    }
    let bare = document(&interface(), PACKAGE, Guide::default(), Standard::Fmi2);
    for part in ["<figure", "How to wire", "What it does", "OMSimulator"] {
        assert!(page.contains(part) && !bare.contains(part), "{part}");
    }
}

#[test]
fn no_link_of_the_document_is_dead() {
    let (_, files) = read(written());
    let page = page();
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
fn the_table_of_contents_names_every_section_in_its_order() {
    let page = page();
    let (contents, rest) = page.split_once("</nav>").expect("has contents");
    let named: Vec<_> = contents
        .split("<li><a href=\"#")
        .skip(1)
        .map(|item| {
            item.split("</a>")
                .next()
                .unwrap()
                .split_once("\">")
                .unwrap()
        })
        .collect();
    let sections: Vec<_> = rest
        .split("<section id=\"")
        .skip(1)
        .map(|section| {
            let (id, heading) = section.split_once("\">\n<h2>").expect("a heading");
            (id, heading.split("</h2>").next().unwrap())
        })
        .collect();
    assert_eq!(named, sections);
    assert_eq!(rest.matches("<h2").count(), sections.len());
    assert!(sections.len() >= 12, "{sections:?}");
    assert!(contents.contains("<a href=\"#inputs\">Inputs</a> <small>(4)</small>"));
    let ids: BTreeSet<_> = sections.iter().map(|(id, _)| id).collect();
    assert_eq!(ids.len(), sections.len());
}

#[test]
fn the_document_shows_every_row_once_with_type_start_range_and_description() {
    let page = page();
    for row in [
        "<td><code>u[i]</code><small>i = 1 … 3</small></td><td data-of=\"Type\">Real, N</td>\
         <td class=\"n\" data-of=\"Start\">0.25, -0.5, 0.3333333333333333</td><td class=\"n\" data-of=\"Range\">-10000.0 … 10000.0</td>\
         <td>force &amp; &quot;sign&quot;<small>discrete, value references 0 … 2</small></td>",
        "<td><code>gain</code></td><td data-of=\"Type\">Real, N.s/m</td><td class=\"n\" data-of=\"Start\">30.0</td>\
         <td class=\"n\" data-of=\"Range\">≥ 0.0</td><td>gain<small>tunable, value reference 1536</small></td>",
        "<tr class=\"group\"><th colspan=\"4\">energy</th></tr>\n<tr><td><code>energy.total</code></td><td data-of=\"Type\">Real, J</td>\
         <td class=\"n\"></td><td>energy<small>discrete, value reference 768</small></td>",
        "<td data-of=\"Type\"><a href=\"#Mode\">Mode</a></td><td class=\"n\" data-of=\"Start\">4 busy</td>",
        "<td class=\"n\">4</td><td><code>busy</code></td><td>x &lt; y &amp; z</td>",
    ] {
        assert!(page.contains(row), "{row}");
    }
    let rows: BTreeSet<_> = interface()
        .scalars
        .into_iter()
        .map(|entry| entry.row)
        .collect();
    for row in rows {
        assert_eq!(
            page.matches(&format!("<tr><td><code>{row}</code>")).count(),
            1,
            "{row}"
        );
    }
    for (category, _) in fmu_archive::xml::LOG_CATEGORIES {
        assert!(page.contains(category));
    }
}

#[test]
fn the_tags_of_the_document_are_balanced() {
    let page = page();
    for tag in [
        "html", "head", "body", "nav", "section", "small", "table", "tr", "td", "th", "ul", "li",
        "p", "a", "code", "h2", "style", "pre", "figure", "svg", "b",
    ] {
        let open =
            page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
        assert_eq!(open, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
}

#[test]
fn the_header_defines_each_value_reference_once() {
    let text = header(&interface(), Standard::Fmi2);
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
            .all(|name| fmu_archive::name::is_identifier(name))
    );
    assert_eq!(text.matches("/*").count(), text.matches("*/").count());
}
