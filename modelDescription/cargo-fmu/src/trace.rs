//! What of the building machine must not be in a library or an archive: a path in a binary is a leak, and makes it differ from
//! the same source built elsewhere.

use crate::Workspace;
use crate::process::{Failure, Outcome, answer, program, run, rustc};
use std::ffi::OsString;
use std::path::PathBuf;

/// Refuses bytes that tell of this machine.
///
/// # Errors
/// Names the file and the path that is in it.
pub fn forbid_private_paths(workspace: &Workspace, file: &str, bytes: &[u8]) -> Outcome {
    let below = |path: &OsString| [path.as_encoded_bytes(), b"/"].concat();
    let named = |path: &OsString| path.as_encoded_bytes().to_vec();
    // A folder of the sources may stand there by itself, from `env!("CARGO_MANIFEST_DIR")`. One of the root's own folders is no
    // such text: others have it, too.
    let sources = [&workspace.root, &workspace.folder];
    let sources = sources.into_iter().chain(&workspace.beside);
    let sources = sources.filter(|path| path.components().count() > 2);
    let whole = sources.map(|path| path.clone().into_os_string());
    let whole = whole.map(|path| (named(&path), path));
    let parts = private_paths(workspace).into_iter();
    let mut parts = whole.chain(parts.map(|path| (below(&path), path)));
    match parts.find(|(part, _)| contains(bytes, part)) {
        Some((_, private)) => Err(Failure::Found(format!(
            "{file} carries the path {}",
            private.to_string_lossy()
        ))),
        None => Ok(()),
    }
}

/// The commit that is built: its hash, with `-dirty` when files that git knows differ from it; `unknown` where git does not know
/// the package. A source without its history can be told by `FMU_GIT_HASH` in the environment.
pub fn git_hash(workspace: &Workspace) -> String {
    if let Ok(told) = std::env::var("FMU_GIT_HASH") {
        return told;
    }
    let git = |arguments: &[&str]| answer(workspace.program("git").args(arguments));
    // A folder may lie in the repository of something else.
    let known = git(&["ls-files", "--error-unmatch", "Cargo.toml"]);
    let hash = known.and_then(|_| git(&["rev-parse", "HEAD"]));
    let status = git(&["status", "--porcelain", "--untracked-files=no"]);
    match (hash, status.as_deref()) {
        (Some(hash), Some("")) => hash,
        (Some(hash), Some(_)) => hash + "-dirty",
        _ => "unknown".to_owned(),
    }
}

/// Compiler flags that replace this machine's paths, and `others`. Where several prefixes match, the last one wins.
///
/// # Errors
/// When the dependencies cannot be fetched.
pub fn remapping(workspace: &Workspace, others: &[(PathBuf, String)]) -> Outcome<OsString> {
    let mut replaced = vec![(cargo_home(), "/cargo".to_owned())];
    // The sources' folder is named after the registry that the machine uses. They must be there to be listed.
    run(workspace.cargo("fetch").arg("--quiet"))?;
    let sources = cargo_home().join("registry/src");
    for entry in std::fs::read_dir(&sources).into_iter().flatten().flatten() {
        replaced.push((entry.path(), "/cargo/registry".to_owned()));
    }
    replaced.extend(sysroot().map(|path| (path, "/rust".to_owned())));
    for folder in &workspace.beside {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        replaced.push((folder.clone(), format!("/beside/{name}")));
    }
    replaced.push((workspace.root.clone(), "/source".to_owned()));
    // The last of those that match counts: a target folder may lie within the source.
    if !workspace.target.starts_with(&workspace.root) {
        replaced.push((workspace.target.clone(), "/target".to_owned()));
    }
    replaced.extend_from_slice(others);

    let mut flags = OsString::new();
    for (path, name) in replaced {
        if !flags.is_empty() {
            flags.push("\x1f");
        }
        flags.push("--remap-path-prefix=");
        flags.push(path);
        flags.push("=");
        flags.push(name);
    }
    Ok(flags)
}

/// Paths that must not be in a library or an archive.
pub fn private_paths(workspace: &Workspace) -> Vec<OsString> {
    let home = std::env::var_os("HOME").map(PathBuf::from);
    let own = [&workspace.root, &workspace.target];
    let own = own.into_iter().chain(&workspace.beside).cloned();
    let others = [Some(cargo_home()), sysroot(), home];
    // A home of `/` is in every path.
    own.chain(others.into_iter().flatten())
        .filter(|path| path.components().count() > 1)
        .map(PathBuf::into_os_string)
        .collect()
}

fn cargo_home() -> PathBuf {
    match std::env::var_os("CARGO_HOME") {
        Some(path) => path.into(),
        None => PathBuf::from(std::env::var_os("HOME").unwrap_or_default()).join(".cargo"),
    }
}

/// Where the compiler of this machine and its library lie.
pub fn sysroot() -> Option<PathBuf> {
    answer(&mut program(rustc(), ["--print", "sysroot"])).map(PathBuf::from)
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    !part.is_empty() && bytes.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn workspace() -> Workspace {
        Workspace {
            folder: "/home/me/own models/plant".into(),
            root: "/home/me/own models".into(),
            target: "/scratch/target".into(),
            beside: vec!["/opt/sdk/export".into()],
            flags: Vec::new(),
        }
    }

    #[test]
    fn a_path_in_a_library_is_found() {
        assert!(contains(
            b"\x7fELF\0/home/me/project/src/lib.rs\0",
            b"/home/me"
        ));
        assert!(!contains(b"\x7fELF\0/source/src/lib.rs\0", b"/home/me"));
        assert!(!contains(b"x", b""));
    }

    #[test]
    fn a_file_with_a_path_of_this_machine_is_refused_and_named() {
        for folder in ["/home/me/own models", "/scratch/target", "/opt/sdk/export"] {
            let text = format!("see {folder}/src/lib.rs");
            let message = forbid_private_paths(&workspace(), "index.html", text.as_bytes())
                .unwrap_err()
                .to_string();
            assert!(
                message.contains("index.html") && message.contains(folder),
                "{message}"
            );
        }
        let alone = b"\0/home/me/own models/plant\0";
        assert!(forbid_private_paths(&workspace(), "x.so", alone).is_err());
        assert!(
            forbid_private_paths(&workspace(), "index.html", b"see /source/src/lib.rs").is_ok()
        );
    }

    #[test]
    fn the_commit_is_told_of_a_package_that_git_knows_and_of_no_other() {
        let folder = std::env::temp_dir().join(format!("cargo-fmu-git-{}", std::process::id()));
        let package = folder.join("a plant");
        std::fs::create_dir_all(&package).expect("writable");
        std::fs::write(package.join("Cargo.toml"), "one").expect("writable");
        let there = Workspace {
            folder: package.clone(),
            ..workspace()
        };
        let git = |arguments: &[&str]| {
            let who = ["-c", "user.name=me", "-c", "user.email=me@example.org"];
            let output = program("git", who)
                .args(arguments)
                .current_dir(&folder)
                .output();
            assert!(output.expect("git").status.success(), "{arguments:?}");
        };
        git(&["init", "--quiet"]);
        git(&["commit", "--quiet", "--allow-empty", "--message", "first"]);
        assert_eq!(
            git_hash(&there),
            "unknown",
            "in a repository of something else"
        );
        git(&["add", "."]);
        git(&["commit", "--quiet", "--message", "second"]);
        let hash = git_hash(&there);
        assert!(
            hash.len() == 40 && hash.chars().all(|c| c.is_ascii_hexdigit()),
            "{hash}"
        );
        std::fs::write(package.join("Cargo.toml"), "two").expect("writable");
        assert_eq!(git_hash(&there), format!("{hash}-dirty"));
        std::fs::remove_dir_all(folder).expect("was there");
    }
}
