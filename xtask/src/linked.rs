//! What is linked into an FMU's library, with licence texts: from cargo's own files, without a network.
//!
//! Macros and build scripts run on the building machine and are not linked; dependencies of other platforms are taken
//! in, so that the archive says the same wherever it is built.

use crate::component::Component;
use crate::licence;
use crate::process::{Failure, Outcome, answer, at, cargo, program, root};

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Names with which licence texts begin, in capitals.
const TEXTS: [&str; 6] = [
    "LICENSE",
    "LICENCE",
    "COPYING",
    "COPYRIGHT",
    "NOTICE",
    "UNLICENSE",
];

/// Everything that is linked into the libraries of `package`, by name.
///
/// # Errors
/// When cargo fails, when something foreign has no licence text or a licence that is not allowed.
pub fn components(package: &str) -> Outcome<Vec<Component>> {
    let ids = tree(package)?;
    let packages = metadata()?;
    let sums = checksums()?;
    let mut components = vec![standard_library()?];
    for id in ids.iter().filter(|id| id.0 != package) {
        let known = packages
            .get(id)
            .ok_or_else(|| unknown(format!("{} {} is not in cargo's metadata", id.0, id.1)))?;
        components.push(component(id, known, sums.get(id))?);
    }
    let names: Vec<_> = components.iter().map(Component::id).collect();
    for component in &mut components {
        component.uses.retain(|id| names.contains(id));
        licence::check(&component.id(), &component.license)?;
    }
    components.sort_by_key(Component::id);
    Ok(components)
}

/// Name and version.
type Id = (String, String);

/// What cargo knows of a package.
struct Package {
    folder: PathBuf,
    license: String,
    foreign: bool,
    uses: Vec<String>,
}

/// What is linked, itself included: with the features of this package alone, as it is built.
fn tree(package: &str) -> Outcome<Vec<Id>> {
    let text = output(&[
        "tree",
        "--locked",
        "--package",
        package,
        "--edges",
        "normal,no-proc-macro",
        "--target",
        "all",
        "--prefix",
        "none",
        "--format",
        "{p}",
    ])?;
    let mut ids: Vec<Id> = text
        .lines()
        .filter_map(|line| {
            let mut words = line.split_whitespace();
            let (name, version) = (words.next()?, words.next()?);
            Some((name.to_owned(), version.strip_prefix('v')?.to_owned()))
        })
        .collect();
    ids.sort();
    ids.dedup();
    Ok(ids)
}

fn metadata() -> Outcome<BTreeMap<Id, Package>> {
    let text = output(&["metadata", "--locked", "--format-version", "1"])?;
    let all: Value = serde_json::from_str(&text)
        .map_err(|cause| unknown(format!("cargo metadata cannot be read: {cause}")))?;
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut ids = BTreeMap::new();
    let mut packages = BTreeMap::new();
    for package in list(&all["packages"]) {
        let id = (word(&package["name"]), word(&package["version"]));
        ids.insert(word(&package["id"]), id.clone());
        let manifest = PathBuf::from(word(&package["manifest_path"]));
        packages.insert(
            id,
            Package {
                folder: manifest.parent().map(Path::to_owned).unwrap_or_default(),
                license: word(&package["license"]),
                foreign: !package["source"].is_null(),
                uses: Vec::new(),
            },
        );
    }
    for node in list(&all["resolve"]["nodes"]) {
        let uses = list(&node["deps"]).into_iter().filter_map(|dependency| {
            let linked = list(&dependency["dep_kinds"])
                .iter()
                .any(|kind| kind["kind"].is_null()); // neither for tests nor for builds
            let (name, version) = ids.get(dependency["pkg"].as_str()?)?;
            linked.then(|| format!("{name}-{version}"))
        });
        let uses: Vec<_> = uses.collect();
        if let Some(package) = ids
            .get(&word(&node["id"]))
            .and_then(|id| packages.get_mut(id))
        {
            package.uses = uses;
            package.uses.sort();
        }
    }
    Ok(packages)
}

/// SHA-256 of the published archives: `Cargo.lock` has one block per package, one `key = "value"` a line.
fn checksums() -> Outcome<BTreeMap<Id, String>> {
    let path = root().join("Cargo.lock");
    let text = std::fs::read_to_string(&path).map_err(at(&path))?;
    let blocks = text.split("[[package]]").skip(1);
    Ok(blocks
        .filter_map(|block| {
            let value = |key: &str| {
                let line = block.lines().find_map(|line| line.strip_prefix(key))?;
                Some(line.strip_prefix(" = \"")?.strip_suffix('"')?.to_owned())
            };
            Some(((value("name")?, value("version")?), value("checksum")?))
        })
        .collect())
}

fn component(id: &Id, package: &Package, sum: Option<&String>) -> Outcome<Component> {
    let (name, version) = id.clone();
    let texts = if package.foreign {
        texts(&package.folder)?
    } else {
        Vec::new()
    };
    if package.foreign && texts.is_empty() {
        return Err(unknown(format!(
            "{name} {version} ({}) comes without a licence text",
            package.license
        )));
    }
    Ok(Component {
        purl: package
            .foreign
            .then(|| format!("pkg:cargo/{name}@{version}")),
        sha256: sum.cloned(),
        license: package.license.clone(),
        texts,
        uses: package.uses.clone(),
        name,
        version,
    })
}

/// The licence texts in a package's folder, by name.
fn texts(folder: &Path) -> Outcome<Vec<(String, Vec<u8>)>> {
    let mut texts = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(at(folder))? {
        let path = entry.map_err(at(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let wanted = TEXTS
            .iter()
            .any(|start| name.to_uppercase().starts_with(start));
        if wanted && name.is_ascii() && path.is_file() {
            texts.push((name.into_owned(), std::fs::read(&path).map_err(at(&path))?));
        }
    }
    texts.sort();
    Ok(texts)
}

/// Rust's standard library, with the notices that the compiler brings for it and for what is in it.
fn standard_library() -> Outcome<Component> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let asked = |arguments: &[&str]| answer(&mut program(&rustc, arguments));
    let missing = Failure::Missing("rustc does not say its version and sysroot");
    let (Some(about), Some(sysroot)) = (asked(&["-vV"]), asked(&["--print", "sysroot"])) else {
        return Err(missing);
    };
    let version = about
        .lines()
        .find_map(|line| line.strip_prefix("release: "))
        .ok_or(missing)?;
    let notices = Path::new(&sysroot).join("share/doc/rust/COPYRIGHT-library.html");
    let text = match std::fs::read(&notices) {
        Ok(text) => ("COPYRIGHT-library.html".to_owned(), text),
        // Older compilers and distributions: the licence, without the notices of what is inside.
        Err(_) => ("COPYRIGHT.txt".to_owned(), STANDARD_LIBRARY.into()),
    };
    Ok(Component {
        name: "rust-std".to_owned(),
        version: version.to_owned(),
        license: "MIT OR Apache-2.0".to_owned(),
        purl: Some(format!("pkg:github/rust-lang/rust@{version}")),
        sha256: None,
        texts: vec![text],
        uses: Vec::new(),
    })
}

const STANDARD_LIBRARY: &str = "\
The Rust standard library, Copyright The Rust Project Developers, licensed under MIT OR Apache-2.0: the texts are
LICENSE-MIT.txt and LICENSE-APACHE.txt in the folder above. The compiler that built this library came without the notices
of the packages that its standard library contains; they are in COPYRIGHT-library.html of the Rust distribution.
";

fn output(arguments: &[&str]) -> Outcome<String> {
    answer(&mut cargo(arguments))
        .ok_or_else(|| unknown(format!("`cargo {}` failed", arguments.join(" "))))
}

fn unknown(what: String) -> Failure {
    Failure::Found(what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_fmu_lists_what_it_links_with_texts_sums_and_allowed_licences() {
        for fmu in fmus::ALL {
            let components = components(&fmu.package())
                .unwrap_or_else(|failure| panic!("{}: {failure}", fmu.name));
            let find = |name: &str| components.iter().find(|component| component.name == name);
            for name in ["rust-std", "serde", "postcard", "libm", "uuid"] {
                let component = find(name).unwrap_or_else(|| panic!("{} links {name}", fmu.name));
                assert!(!component.texts.is_empty() && component.purl.is_some());
                assert_eq!(
                    component.sha256.as_ref().map(String::len),
                    (name != "rust-std").then_some(64),
                    "{name}"
                );
            }
            // They run in the compiler, or in tests alone.
            for name in ["serde_derive", "syn", "paste", "proptest", "autocfg"] {
                assert!(find(name).is_none(), "{} links {name}", fmu.name);
            }
            let export = find("fmu-export").expect("it makes the C interface");
            assert!(export.texts.is_empty() && export.purl.is_none(), "our own");
            assert!(export.uses.iter().any(|id| id.starts_with("postcard-")));
            assert!(
                find(&fmu.package()).is_none(),
                "the FMU itself is no part of it"
            );
        }
    }

    #[test]
    fn only_licence_texts_are_taken_from_a_folder() {
        let names: Vec<_> = texts(&root())
            .expect("readable")
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        assert_eq!(names, ["LICENSE-APACHE", "LICENSE-MIT"]);
    }
}
