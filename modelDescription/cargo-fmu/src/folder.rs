//! A folder whose files go into an archive. Links are followed, as long as they lead on.

use std::fs::Metadata;
use std::path::{Path, PathBuf};

/// Most files and folders, bytes of one file, and bytes of all: what `exo validate` believes of an archive.
const MOST_ENTRIES: usize = 50_000;
const MOST_BYTES: u64 = 1 << 30;
const MOST_IN_ALL: u64 = 2 << 30;

/// The files below `folder`, by their paths in the archive, which begin with `prefix`.
///
/// # Errors
/// A sentence with the path that cannot go into an archive, and what was expected.
pub(crate) fn files(folder: &Path, prefix: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut found = Found::default();
    found.enter(folder, prefix)?;
    found.one_spelling()?;
    let read = |(name, path): (String, PathBuf)| {
        let bytes = std::fs::read(&path).map_err(|error| unread(&path, &error))?;
        Ok((name, bytes))
    };
    found.files.into_iter().map(read).collect()
}

#[derive(Default)]
struct Found {
    files: Vec<(String, PathBuf)>,
    entries: usize,
    bytes: u64,
    /// The folders that lead to where the search is.
    above: Vec<PathBuf>,
}

impl Found {
    fn enter(&mut self, folder: &Path, prefix: &str) -> Result<(), String> {
        let real = folder
            .canonicalize()
            .map_err(|error| unread(folder, &error))?;
        if self.above.contains(&real) {
            return Err(format!(
                "{} leads back to {}: expected links that lead to no folder above them",
                folder.display(),
                real.display()
            ));
        }
        self.above.push(real);
        for entry in std::fs::read_dir(folder).map_err(|error| unread(folder, &error))? {
            let path = entry.map_err(|error| unread(folder, &error))?.path();
            let name = format!("{prefix}/{}", name(&path)?);
            // Of what a link leads to.
            let of = path.metadata().map_err(|error| unread(&path, &error))?;
            self.count(&path, &of)?;
            if of.is_dir() {
                self.enter(&path, &name)?;
            } else if of.is_file() {
                self.files.push((name, path));
            } else {
                let path = path.display();
                return Err(format!(
                    "{path} is neither a file nor a folder: expected files and folders"
                ));
            }
        }
        self.above.pop();
        Ok(())
    }

    fn count(&mut self, path: &Path, of: &Metadata) -> Result<(), String> {
        self.entries += 1;
        let size = if of.is_file() { of.len() } else { 0 };
        self.bytes += size;
        let path = path.display();
        if size > MOST_BYTES {
            return Err(format!(
                "{path} has {size} bytes: expected at most {MOST_BYTES}"
            ));
        }
        if self.entries > MOST_ENTRIES || self.bytes > MOST_IN_ALL {
            return Err(format!(
                "too much up to {path}: expected at most {MOST_ENTRIES} files and folders, and {MOST_IN_ALL} bytes"
            ));
        }
        Ok(())
    }

    /// Refuses two names that are one where case does not count.
    fn one_spelling(&mut self) -> Result<(), String> {
        self.files.sort();
        let mut spelt = std::collections::BTreeMap::new();
        for (name, _) in &self.files {
            if let Some(other) = spelt.insert(name.to_lowercase(), name) {
                return Err(format!(
                    "{name} beside {other}: expected names that differ by more than case"
                ));
            }
        }
        Ok(())
    }
}

/// The last part of a path, which every system can write.
fn name(path: &Path) -> Result<&str, String> {
    let plain = |name: &&str| name.chars().all(|c| matches!(c, ' '..='~') && c != '\\');
    let name = path.file_name().and_then(std::ffi::OsStr::to_str);
    name.filter(plain).ok_or_else(|| {
        format!("{path:?}: expected a name of printable ASCII without a backslash, as every system can extract it")
    })
}

fn unread(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_the_order_is_that_of_the_names() {
        let here = std::env::temp_dir().join(format!("cargo-fmu-folder-{}", std::process::id()));
        let data = here.join("data");
        std::fs::create_dir_all(here.join("elsewhere/deep")).unwrap();
        std::fs::create_dir_all(&data).unwrap();
        std::fs::write(here.join("elsewhere/deep/map.csv"), "1").unwrap();
        std::fs::write(data.join("z.csv"), "2").unwrap();
        for (link, target) in [("b", "elsewhere"), ("a", "elsewhere/deep/map.csv")] {
            std::os::unix::fs::symlink(here.join(target), data.join(link)).unwrap();
        }
        let found = files(&data, "resources");
        std::fs::remove_dir_all(&here).unwrap();
        let expected = [("a", "1"), ("b/deep/map.csv", "1"), ("z.csv", "2")];
        let expected = expected.map(|(name, bytes)| (format!("resources/{name}"), bytes.into()));
        assert_eq!(found, Ok(expected.to_vec()));
    }
}
