//! The cargo workspace whose models are built: this project's, or a stranger's.

use crate::process::{Failure, Outcome, cargo, program};
use cargo_metadata::{Metadata, MetadataCommand};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A workspace.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Where cargo is called, so that the configuration there applies.
    pub folder: PathBuf,
    /// Its own folder, with `Cargo.lock`.
    pub root: PathBuf,
    /// cargo's target folder.
    pub target: PathBuf,
    /// Folders of packages outside of it that are named by their path.
    pub beside: Vec<PathBuf>,
    /// What every call of cargo gets: `--locked`, `--offline`.
    pub flags: Vec<String>,
}

impl Workspace {
    /// The workspace of the package whose manifest this is.
    ///
    /// # Errors
    /// When cargo cannot read it.
    pub fn open(manifest: &Path, flags: &[String]) -> Outcome<(Self, Metadata)> {
        let metadata = metadata(manifest, flags)?;
        let root = metadata.workspace_root.clone().into_std_path_buf();
        let folder = manifest.parent().unwrap_or(&root).to_owned();
        let beside = metadata
            .packages
            .iter()
            .filter(|package| package.source.is_none())
            .filter_map(|package| package.manifest_path.parent())
            .map(|folder| folder.as_std_path().to_owned())
            .filter(|folder| !folder.starts_with(&root))
            .collect();
        let workspace = Self {
            folder,
            root,
            target: metadata.target_directory.clone().into_std_path_buf(),
            beside,
            flags: flags.to_vec(),
        };
        Ok((workspace, metadata))
    }

    /// A command of cargo that resolves dependencies.
    pub fn cargo(&self, command: &str) -> Command {
        let mut cargo = self.program(cargo());
        cargo.arg(command).args(&self.flags);
        cargo
    }

    /// A program that runs where cargo is called.
    pub fn program(&self, name: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = program::<&str>(name, []);
        command.current_dir(&self.folder);
        command
    }

    /// What cargo knows of it.
    ///
    /// # Errors
    /// When cargo cannot read it.
    pub fn metadata(&self) -> Outcome<Metadata> {
        metadata(&self.folder.join("Cargo.toml"), &self.flags)
    }
}

fn metadata(manifest: &Path, flags: &[String]) -> Outcome<Metadata> {
    let mut command = MetadataCommand::new();
    command
        .cargo_path(cargo())
        .manifest_path(manifest)
        .other_options(flags.to_vec());
    if let Some(folder) = manifest.parent() {
        command.current_dir(folder);
    }
    command.exec().map_err(|error| match error {
        cargo_metadata::Error::CargoMetadata { stderr } => Failure::Found(format!(
            "cargo cannot read {}:\n{}",
            manifest.display(),
            stderr.trim()
        )),
        other => Failure::Found(format!("{}: {other}", manifest.display())),
    })
}
