//! What is linked into an FMU's library, with licence texts: from cargo's own files, without a network.
//!
//! Macros and build scripts run on the building machine and are not linked; dependencies of other platforms are taken
//! in, so that the archive says the same wherever it is built.

use crate::Workspace;
use crate::process::{Failure, Outcome, answer, at, output, program, rustc};
use cargo_metadata::{DependencyKind, Metadata};
use fmu_archive::Component;
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

/// Everything that is linked into the libraries of `package`, by name. Components without licence texts are of the package's
/// own workspace and licence, or their authors have published none.
///
/// # Errors
/// When cargo or the compiler fails.
pub fn components(workspace: &Workspace, package: &str) -> Outcome<Vec<Component>> {
    let ids = tree(workspace, package)?;
    let packages = packages(&workspace.metadata()?);
    let sums = checksums(&workspace.root)?;
    let mut components = vec![standard_library()?];
    let own = packages
        .iter()
        .find(|(id, known)| id.0 == package && known.member)
        .map(|(_, known)| known.license.clone());
    for id in ids.iter().filter(|id| id.0 != package) {
        let known = packages.get(id).ok_or_else(|| {
            Failure::Found(format!("{} {} is not in cargo's metadata", id.0, id.1))
        })?;
        components.push(component(id, known, sums.get(id), own.as_deref())?);
    }
    let names: Vec<_> = components.iter().map(Component::id).collect();
    for component in &mut components {
        component.uses.retain(|id| names.contains(id));
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
    member: bool,
    published: bool,
    uses: Vec<String>,
}

/// What is linked, itself included: with the features of this package alone, as it is built.
fn tree(workspace: &Workspace, package: &str) -> Outcome<Vec<Id>> {
    let mut tree = workspace.cargo("tree");
    tree.args(["--package", package, "--edges", "normal,no-proc-macro"])
        .args(["--target", "all", "--prefix", "none", "--format", "{p}"]);
    let text = output(&mut tree)?;
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

fn packages(metadata: &Metadata) -> BTreeMap<Id, Package> {
    let id =
        |package: &cargo_metadata::Package| (package.name.to_string(), package.version.to_string());
    let ids: BTreeMap<_, _> = metadata
        .packages
        .iter()
        .map(|package| (&package.id, id(package)))
        .collect();
    let nodes = metadata.resolve.iter().flat_map(|resolve| &resolve.nodes);
    let uses: BTreeMap<_, Vec<String>> = nodes
        .map(|node| {
            let linked = node.deps.iter().filter(|dependency| {
                // Neither for tests nor for builds.
                let mut kinds = dependency.dep_kinds.iter();
                kinds.any(|kind| kind.kind == DependencyKind::Normal)
            });
            let names = linked.filter_map(|dependency| ids.get(&dependency.pkg));
            let mut names: Vec<_> = names
                .map(|(name, version)| format!("{name}-{version}"))
                .collect();
            names.sort();
            (&node.id, names)
        })
        .collect();
    let known = |package: &cargo_metadata::Package| Package {
        folder: package
            .manifest_path
            .parent()
            .map(Into::into)
            .unwrap_or_default(),
        license: package.license.clone().unwrap_or_default(),
        member: metadata.workspace_members.contains(&package.id),
        published: package
            .source
            .as_ref()
            .is_some_and(|source| source.repr.starts_with("registry+")),
        uses: uses.get(&package.id).cloned().unwrap_or_default(),
    };
    let packages = metadata.packages.iter();
    packages
        .map(|package| (id(package), known(package)))
        .collect()
}

/// SHA-256 of the published archives: `Cargo.lock` has one block per package, one `key = "value"` a line.
fn checksums(root: &Path) -> Outcome<BTreeMap<Id, String>> {
    let path = root.join("Cargo.lock");
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

/// `own` is the licence of the whole: what is of the same workspace and licence needs no text of its own.
fn component(
    id: &Id,
    package: &Package,
    sum: Option<&String>,
    own: Option<&str>,
) -> Outcome<Component> {
    let (name, version) = id.clone();
    let texts = if package.member && own == Some(package.license.as_str()) {
        Vec::new()
    } else {
        texts(&package.folder)?
    };
    Ok(Component {
        purl: package
            .published
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
///
/// # Errors
/// When the folder cannot be read.
pub fn texts(folder: &Path) -> Outcome<Vec<(String, Vec<u8>)>> {
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
    let asked = |arguments: &[&str]| answer(&mut program(rustc(), arguments));
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
The Rust standard library, Copyright The Rust Project Developers, licensed under MIT OR Apache-2.0
(https://www.rust-lang.org/policies/licenses). The compiler that built this library came without the notices
of the packages that its standard library contains; they are in COPYRIGHT-library.html of the Rust distribution.
";
