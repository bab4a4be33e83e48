//! What else goes into an archive: the files below `modelDescription/references/<Name>/`, each at its path there.
//!
//! They are the FMU's references as the layered standard FMI-LS-REF has them. `exo record --bless` writes them, from runs of the
//! built FMUs; docs/references.md tells of them.

use crate::root;
use std::path::Path;

/// What tells a reader of them, in the archive.
const DOCUMENT: &str = "documentation/fmi-ls-ref.html";

/// Paths and contents; none where the FMU has no such folder.
///
/// # Errors
/// Names the file that cannot be read.
pub fn of(name: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut files = Vec::new();
    below(
        &root().join("modelDescription/references").join(name),
        "",
        &mut files,
    )?;
    Ok(files)
}

/// A paragraph of the interface document, with a link to what tells of the files.
pub fn told(files: &[(String, Vec<u8>)]) -> &'static str {
    if files.iter().any(|(path, _)| path == DOCUMENT) {
        "<p>The archive carries <a href=\"fmi-ls-ref.html\">references</a>: experiments with inputs and results, to try an importer \
         with, parameter sets, and requirements (layered standard FMI-LS-REF).</p>\n"
    } else {
        ""
    }
}

fn below(folder: &Path, prefix: &str, files: &mut Vec<(String, Vec<u8>)>) -> Result<(), String> {
    if !folder.is_dir() {
        return Ok(());
    }
    let at = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in std::fs::read_dir(folder).map_err(at)? {
        let entry = entry.map_err(at)?;
        let path = entry.path();
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if path.is_dir() {
            below(&path, &format!("{name}/"), files)?;
        } else {
            let bytes =
                std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            files.push((name, bytes));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FMUS;
    use fmu_archive::archive::{self, Contents};

    #[test]
    fn each_archive_carries_its_references_at_their_paths_and_tells_of_them() {
        for fmu in FMUS {
            let extra = of(fmu.name).expect("readable");
            let manifest = "extra/org.fmi-standard.fmi-ls-ref/fmi-ls-manifest.xml";
            assert!(
                extra.iter().any(|(path, _)| path == manifest),
                "{} has none",
                fmu.name
            );
            assert!(!told(&extra).is_empty());
            let interface = fmu.interface().expect("legal");
            let packed = archive::files(&Contents {
                extra: &extra,
                ..Contents::of(&interface)
            });
            assert!(extra.iter().all(|file| packed.contains(file)));
        }
    }

    #[test]
    fn an_fmu_without_references_has_nothing_else_in_its_archive() {
        let extra = of("integrator").expect("no folder is no error");
        assert!(extra.is_empty());
        assert_eq!(told(&extra), "");
    }
}
