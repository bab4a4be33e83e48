//! Which models are meant: the package, and those of its targets that are shared libraries.

use crate::Workspace;
use crate::cdylib::Cdylib;
use crate::process::{Failure, Outcome, answer, cargo, program};
use cargo_metadata::{DependencyKind, Metadata, Package};
use std::path::PathBuf;

/// The crate whose macro makes an FMU of a model.
const EXPORTER: &str = "fmu-export";

/// What a user says of it.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Choice {
    /// The package, by its name; without it that of the current folder, or the only one of the workspace with a model
    #[arg(long, short, value_name = "NAME")]
    pub package: Option<String>,
    /// The Cargo.toml of the package or of its workspace
    #[arg(long, value_name = "PATH")]
    pub manifest_path: Option<PathBuf>,
    /// The package's library alone
    #[arg(long)]
    pub lib: bool,
    /// One of the package's examples alone
    #[arg(long, value_name = "NAME", conflicts_with = "lib")]
    pub example: Option<String>,
    /// Cargo.lock must be there and stay as it is
    #[arg(long)]
    pub locked: bool,
    /// Without a network
    #[arg(long)]
    pub offline: bool,
}

/// A package with models.
#[derive(Debug)]
pub struct Subject {
    /// Its workspace.
    pub workspace: Workspace,
    /// What cargo knows of it.
    pub package: Package,
    /// Its models' libraries.
    pub cdylibs: Vec<Cdylib>,
    /// What turns on that a library hands its interface over.
    pub feature: String,
}

impl Choice {
    /// Finds it.
    ///
    /// # Errors
    /// Names what was looked for and what is there.
    pub fn subject(&self) -> Outcome<Subject> {
        let manifest = self.manifest()?;
        let (_, metadata) = Workspace::open(&manifest, &self.flags())?;
        let package = self.package(&metadata)?.clone();
        // Once more, because the configuration in the package's own folder is what applies.
        let (workspace, _) = Workspace::open(package.manifest_path.as_std_path(), &self.flags())?;
        let feature = feature(&package)?;
        Ok(Subject {
            workspace,
            cdylibs: self.cdylibs(&package)?,
            feature,
            package,
        })
    }

    fn flags(&self) -> Vec<String> {
        let flags = [("--locked", self.locked), ("--offline", self.offline)];
        let given = flags.into_iter().filter(|(_, given)| *given);
        given.map(|(flag, _)| flag.to_owned()).collect()
    }

    /// The path of a manifest, absolute.
    fn manifest(&self) -> Outcome<PathBuf> {
        if let Some(path) = &self.manifest_path {
            return std::path::absolute(path)
                .ok()
                .filter(|path| path.is_file() && path.ends_with("Cargo.toml"))
                .ok_or_else(|| {
                    let path = path.display();
                    Failure::Found(format!(
                        "--manifest-path {path}: expected the path of a Cargo.toml"
                    ))
                });
        }
        let asked = ["locate-project", "--message-format", "plain"];
        answer(&mut program(cargo(), asked))
            .map(PathBuf::from)
            .ok_or_else(|| {
                let folder = std::env::current_dir().unwrap_or_default();
                Failure::Found(format!(
                    "no Cargo.toml in {} nor above it: expected the folder of a package (`cargo fmu new NAME` makes one)",
                    folder.display()
                ))
            })
    }

    fn package<'a>(&self, metadata: &'a Metadata) -> Outcome<&'a Package> {
        let members = metadata.workspace_packages();
        if let Some(name) = &self.package {
            let found = members.iter().find(|package| *package.name == **name);
            return found.copied().ok_or_else(|| {
                let names: Vec<_> = members.iter().map(|package| package.name.as_str()).collect();
                let root = &metadata.workspace_root;
                let names = names.join(", ");
                Failure::Found(format!(
                    "--package {name}: expected a package of the workspace {root}, which has {names}"
                ))
            });
        }
        if let Some(package) = metadata.root_package() {
            return Ok(package);
        }
        let with_models: Vec<_> = members
            .into_iter()
            .filter(|package| feature(package).is_ok() && !all_cdylibs(package).is_empty())
            .collect();
        match with_models.as_slice() {
            [one] => Ok(one),
            [] => Err(Failure::Found(format!(
                "no package of the workspace {} has a model: expected a dependency on {EXPORTER} and a target with \
                 crate-type = [\"cdylib\"]",
                metadata.workspace_root
            ))),
            several => {
                let names: Vec<_> = several
                    .iter()
                    .map(|package| package.name.as_str())
                    .collect();
                let names = names.join(", ");
                Err(Failure::Found(format!(
                    "several packages of the workspace have a model: expected --package with one of {names}"
                )))
            }
        }
    }

    fn cdylibs(&self, package: &Package) -> Outcome<Vec<Cdylib>> {
        let mut cdylibs = all_cdylibs(package);
        if cdylibs.is_empty() {
            return Err(Failure::Found(format!(
                "{} builds no shared library: expected in {}\n\n    [lib]\n    crate-type = [\"cdylib\"]\n",
                package.name, package.manifest_path
            )));
        }
        let all: Vec<_> = cdylibs.iter().map(ToString::to_string).collect();
        if self.lib {
            cdylibs.retain(|cdylib| !cdylib.example);
        }
        if let Some(name) = &self.example {
            cdylibs.retain(|cdylib| cdylib.example && cdylib.name == *name);
        }
        if cdylibs.is_empty() {
            let asked = self
                .example
                .as_ref()
                .map(|name| format!("--example {name}"));
            return Err(Failure::Found(format!(
                "{}: expected one of {}",
                asked.as_deref().unwrap_or("--lib"),
                all.join(", ")
            )));
        }
        Ok(cdylibs)
    }
}

fn all_cdylibs(package: &Package) -> Vec<Cdylib> {
    let targets = package.targets.iter();
    targets
        .filter_map(|target| Cdylib::of(&package.name, target))
        .collect()
}

/// What cargo calls the exporter's feature, seen from the package.
fn feature(package: &Package) -> Outcome<String> {
    if *package.name == *EXPORTER {
        return Ok("interface".to_owned());
    }
    let mut dependencies = package.dependencies.iter();
    let exporter = dependencies
        .find(|one| one.name == EXPORTER && one.kind == DependencyKind::Normal)
        .ok_or_else(|| {
            Failure::Found(format!(
                "{} does not depend on {EXPORTER}: expected it among the dependencies in {}",
                package.name, package.manifest_path
            ))
        })?;
    let name = exporter.rename.as_ref().unwrap_or(&exporter.name);
    Ok(format!("{name}/interface"))
}
