//! An FMU on disk: the archive, or the test model's bare library.

use crate::Variable;
use crate::description::Description;
use crate::instance::{Instance, Setup};
use crate::library::Library;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// A loaded FMU.
pub struct Fmu {
    /// Model name.
    pub name: String,
    /// Guid.
    pub guid: String,
    /// Variables.
    pub variables: Vec<Variable>,
    /// Declared log categories.
    pub log_categories: Vec<String>,
    /// Step size of the default experiment (s).
    pub step_size: f64,
    /// The shared library.
    pub library: Arc<Library>,
    /// Path of the shared library.
    pub path: PathBuf,
    /// Where the archive was unpacked; removed with this value. The test model has none.
    pub folder: Option<TempDir>,
}

/// The folder with the built FMUs: `EXO_FMU_DIR`, or `target/fmu` of the workspace.
pub fn directory() -> PathBuf {
    std::env::var_os("EXO_FMU_DIR").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/fmu"),
        PathBuf::from,
    )
}

/// The path, if it is there.
pub(crate) fn existing(path: PathBuf) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    assert!(
        path.is_file(),
        "target/fmu/{}{name} is missing: run `cargo xtask fmu` first",
        if name.ends_with(".fmu") { "" } else { "test/" }
    );
    path
}

impl Fmu {
    /// Unpacks and loads `<name>.fmu` from the [`directory`].
    ///
    /// # Panics
    /// When the archive is missing or no FMU; the message names the file.
    pub fn open(name: &str) -> Self {
        Self::open_in(&directory(), name)
    }

    /// Unpacks and loads `<name>.fmu` from a folder.
    ///
    /// # Panics
    /// Like [`Fmu::open`].
    pub fn open_in(directory: &Path, name: &str) -> Self {
        let archive = existing(directory.join(format!("{name}.fmu")));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = File::open(&archive).unwrap_or_else(|e| panic!("{}: {e}", archive.display()));
        zip::ZipArchive::new(file)
            .and_then(|mut zip| zip.extract(folder.path()))
            .unwrap_or_else(|e| panic!("{}: {e}", archive.display()));
        let text = std::fs::read_to_string(folder.path().join("modelDescription.xml"))
            .unwrap_or_else(|e| panic!("{}: modelDescription.xml: {e}", archive.display()));
        let description = Description::parse(&text)
            .unwrap_or_else(|e| panic!("{}: modelDescription.xml: {e}", archive.display()));
        let path = folder
            .path()
            .join("binaries")
            .join(PLATFORM)
            .join(format!("{}{SUFFIX}", description.model_identifier()));
        Self {
            name: description.name.clone(),
            guid: description.guid.clone(),
            variables: description.variables(),
            log_categories: description.log_categories(),
            step_size: description
                .step_size()
                .unwrap_or_else(|| panic!("{}: no stepSize", archive.display())),
            library: Arc::new(Library::load(&path)),
            path,
            folder: Some(folder),
        }
    }

    /// The test model by its name, `Lag`, or one of the project's FMUs.
    ///
    /// # Panics
    /// Like [`Fmu::open`].
    pub fn named(name: &str) -> Self {
        match name {
            "Lag" => Self::lag(),
            _ => Self::open(name),
        }
    }

    /// The variables of the committed `modelDescription/<name>.xml`; the test model's are those of its source.
    ///
    /// # Panics
    /// When the file cannot be read, or is not the description of this library.
    pub fn committed_variables(&self) -> Vec<Variable> {
        if self.folder.is_none() {
            return self.variables.clone();
        }
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../modelDescription")
            .join(format!("{}.xml", self.name));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        let description =
            Description::parse(&text).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        assert_eq!(
            description.guid, self.guid,
            "{} was built from another",
            self.name
        );
        description.variables()
    }

    /// Whether NaN may be set, as a broken sensor gives it: the model then names the sensor.
    pub fn takes_nan(&self, variable: &Variable) -> bool {
        let sensed = ["f_h[", "ft.force[", "ft.torque["];
        self.name == "ArmController" && sensed.iter().any(|name| variable.name.starts_with(name))
    }

    /// The test model and the project's FMUs.
    pub fn all() -> Vec<Self> {
        let mut all = Self::products();
        all.insert(0, Self::lag());
        all
    }

    /// The project's FMUs.
    pub fn products() -> Vec<Self> {
        fmus::NAMES.iter().map(|name| Self::open(name)).collect()
    }

    /// A variable by its name.
    ///
    /// # Panics
    /// When there is none; the message names both.
    pub fn variable(&self, name: &str) -> &Variable {
        self.variables
            .iter()
            .find(|v| v.name == name)
            .unwrap_or_else(|| panic!("{} has no variable {name}", self.name))
    }

    /// Value reference of a variable.
    ///
    /// # Panics
    /// Like [`Fmu::variable`].
    pub fn reference(&self, name: &str) -> u32 {
        self.variable(name).reference
    }

    /// Value references of several variables.
    ///
    /// # Panics
    /// Like [`Fmu::variable`].
    pub fn references<const N: usize>(&self, names: [&str; N]) -> [u32; N] {
        names.map(|name| self.reference(name))
    }

    /// What an ordinary importer passes to fmi2Instantiate: all logging on, no resources.
    pub fn setup(&self) -> Setup {
        Setup::new(&self.name, &self.guid)
    }

    /// An instance with all logging on.
    ///
    /// # Panics
    /// When it is refused; the message has the log.
    pub fn instantiate(&self) -> Instance {
        self.instantiate_as(&self.setup())
    }

    /// An instance.
    ///
    /// # Panics
    /// When it is refused; the message has the log.
    pub fn instantiate_as(&self, setup: &Setup) -> Instance {
        Instance::new(&self.library, setup)
            .unwrap_or_else(|log| panic!("{} refuses to be instantiated: {log:?}", self.name))
    }
}

/// Name of this platform in an FMU and suffix of its shared libraries.
const PLATFORM: &str = if cfg!(windows) {
    "win64"
} else if cfg!(target_os = "macos") {
    "darwin64"
} else {
    "linux64"
};
pub(crate) const SUFFIX: &str = if cfg!(windows) {
    ".dll"
} else if cfg!(target_os = "macos") {
    ".dylib"
} else {
    ".so"
};
