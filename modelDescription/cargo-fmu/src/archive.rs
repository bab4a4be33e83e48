//! A stranger's archives: for this machine, or for many platforms.

use crate::facts::{Facts, Version};
use crate::functions;
use crate::inspect::inspect;
use crate::pack::{Library, Parts, replace};
use crate::plan::{Inspected, Plan};
use crate::platform::Platform;
use crate::process::{Failure, Outcome, at};
use crate::subject::Subject;
use crate::toolchain::Toolchains;
use crate::{compile, describe, interface, linked, platform, trace};
use fmu_archive::archive::Contents;
use fmu_archive::{Component, Guide, Interface, Package, Standard};
use std::path::{Path, PathBuf};

/// What became of the archives that were asked for.
#[derive(Debug, Default)]
pub struct Archives {
    /// Where those lie that there are.
    pub written: Vec<PathBuf>,
    /// Why others cannot be: the variable, and what can be done.
    pub refused: Vec<String>,
}

impl Archives {
    fn add(&mut self, others: Self) {
        self.written.extend(others.written);
        self.refused.extend(others.refused);
    }

    /// Nothing, where all there can be is there.
    ///
    /// # Errors
    /// What was refused.
    pub fn complete(&self) -> Outcome {
        if self.refused.is_empty() {
            Ok(())
        } else {
            Err(Failure::Found(self.refused.join("\n")))
        }
    }
}

/// Why there is no archive of FMI 2.0, if there is none although it was asked for.
fn refused(interface: &Interface, facts: &Facts) -> Option<String> {
    let entry = interface.beyond_fmi2()?;
    if !facts.fmi.contains(&Version::Fmi2) {
        return None;
    }
    let (model, manifest) = (interface.name, &facts.manifest);
    Some(format!(
        "{model} has no archive of FMI 2.0: {} is of type {}, which FMI 2.0 does not have. The archives of FMI 3.0 are built. \
         Where they are enough, say so in {manifest}:\n\n    [package.metadata.fmu]\n    fmi = [\"3.0\"]\n\nor give the \
         field a type that FMI 2.0 has: f64, f32, i8, u8, i16, u16, i32, bool or String",
        entry.name,
        Standard::Fmi3.type_name(&entry.kind),
    ))
}

/// Writes the archives of a model of the subject's package, of FMI 2.0 to `archive` and of FMI 3.0 beside it.
pub(crate) fn pack(
    subject: &Subject,
    facts: &Facts,
    interface: &Interface,
    binaries: Vec<Library>,
    linked: Vec<Component>,
    archive: PathBuf,
) -> Outcome<Archives> {
    let texts: Vec<_> = facts
        .texts
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_slice()))
        .collect();
    let plain = Contents::of(interface);
    let contents = Contents {
        package: Package {
            version: &facts.version,
            author: &facts.author,
            copyright: &facts.copyright,
            license: &facts.license,
            texts: &texts,
        },
        guide: Guide {
            what: &facts.guide,
            picture: &facts.picture,
            ..Guide::default()
        },
        icon: facts.icon.as_deref().unwrap_or(plain.icon),
        extra: &facts.extra,
        ..plain
    };
    let folder = |path: std::ffi::OsString| format!("{}/", path.to_string_lossy());
    let parts = Parts {
        archive,
        binaries,
        linked,
        forbidden: trace::private_paths(&subject.workspace)
            .into_iter()
            .map(folder)
            .collect(),
    };
    let wanted = |one: &Standard| facts.fmi.contains(&Version::of(*one));
    let written = parts.archives(&contents, wanted).map_err(Failure::Found)?;
    for (path, bytes) in &written {
        replace(path, bytes)?;
    }
    Ok(Archives {
        written: written.into_iter().map(|(path, _)| path).collect(),
        refused: refused(interface, facts).into_iter().collect(),
    })
}

/// Builds the archives of all models of the subject for this machine, into the folder `out`; without it into `fmu` in cargo's
/// target folder.
///
/// # Errors
/// When something does not compile, a declaration breaks a rule, or a file tells of this machine.
pub fn build(subject: &Subject, profile: &str, out: Option<&Path>) -> Outcome<Archives> {
    let facts = Facts::of(&subject.package, &subject.workspace.root)?;
    let here = platform::here()?;
    let out = out.map_or_else(|| subject.workspace.target.join("fmu"), Path::to_owned);
    let target = subject.workspace.target.join("fmu-build");
    let linked = linked::components(&subject.workspace, &subject.package.name)?;
    let mut archives = Archives::default();
    for cdylib in &subject.cdylibs {
        let interface = interface::read(subject, cdylib, &target)?;
        let one = std::slice::from_ref(cdylib);
        let library = compile::here(&subject.workspace, one, &target, profile)?;
        let path = library[&cdylib.name].clone();
        inspected(here, &path)?;
        let library = Library {
            platform: here.folder.to_owned(),
            extension: here.suffix.to_owned(),
            path,
        };
        let archive = out.join(interface.name).with_extension("fmu");
        archives.add(pack(
            subject,
            &facts,
            &interface,
            vec![library],
            linked.clone(),
            archive,
        )?);
    }
    Ok(archives)
}

/// The variables of all models of the subject as tables, for the oldest version of the standard that a model has: no archive is built
/// for that.
///
/// # Errors
/// When something does not compile, or a declaration breaks a rule.
pub fn describe(subject: &Subject) -> Outcome<Vec<String>> {
    let facts = Facts::of(&subject.package, &subject.workspace.root)?;
    let target = subject.workspace.target.join("fmu-build");
    let table = |cdylib| {
        let interface = interface::read(subject, cdylib, &target)?;
        let standard = Standard::of(&interface).find(|one| facts.fmi.contains(&Version::of(*one)));
        let standard = standard.unwrap_or(Standard::Fmi3);
        let xml = standard.description(&interface, Package::default());
        describe::table(&xml).map_err(Failure::Found)
    };
    subject.cdylibs.iter().map(table).collect()
}

/// Whether it offers the standard's functions and no others. Says what it calls that rounds differently elsewhere.
fn inspected(platform: &Platform, library: &Path) -> Outcome {
    let bytes = std::fs::read(library).map_err(at(library))?;
    let name = library.file_name().unwrap_or_default().to_string_lossy();
    let report = inspect(&bytes, platform, &functions::exported(), false)
        .map_err(|what| Failure::Found(format!("{name}: {what}")))?;
    for function in &report.rounded {
        note_rounded(&name, function);
    }
    Ok(())
}

fn note_rounded(library: &str, function: &str) {
    println!(
        "note: {library} calls {function} of the C library, which each platform rounds in its own way: the libm crate gives the \
         same bits everywhere"
    );
}

/// One platform of [`dist`]: what its libraries need, or why there are none.
pub struct Row {
    /// The platform.
    pub platform: &'static Platform,
    /// Whether its libraries are in the archives.
    pub built: bool,
    /// In words.
    pub said: String,
}

/// Builds the archives of all models of the subject for many platforms, into the folder `out`; without it into `dist` in cargo's
/// target folder. A platform whose tools cannot be had is left out.
///
/// # Errors
/// When what has its tools here does not compile, or something is wrong with it; when no platform has its tools.
pub fn dist(
    subject: &Subject,
    platforms: &[&'static Platform],
    tools: &Toolchains,
    out: Option<&Path>,
) -> Outcome<(Archives, Vec<Row>)> {
    let facts = Facts::of(&subject.package, &subject.workspace.root)?;
    let workspace = &subject.workspace;
    let target = workspace.target.join("fmu-build");
    let mut interfaces = Vec::new();
    for cdylib in &subject.cdylibs {
        interfaces.push(interface::read(subject, cdylib, &target)?);
    }
    let mut linked = linked::components(workspace, &subject.package.name)?;
    let mut binaries = vec![Vec::new(); subject.cdylibs.len()];
    let mut rows = Vec::new();
    for platform in platforms.iter().copied() {
        let plan = match Plan::of(platform, tools) {
            Ok(plan) => plan,
            Err(said) => {
                rows.push(Row {
                    platform,
                    built: false,
                    said,
                });
                continue;
            }
        };
        println!("   Building for {}", platform.folder);
        let built = plan.build(workspace, platform, &target, &subject.cdylibs)?;
        for (cdylib, binaries) in subject.cdylibs.iter().zip(&mut binaries) {
            binaries.push(Library {
                platform: platform.folder.to_owned(),
                extension: platform.suffix.to_owned(),
                path: built.libraries[&cdylib.name].path.clone(),
            });
        }
        let Inspected { said, rounded } = built.inspected(workspace, platform)?;
        for (library, function) in rounded {
            note_rounded(&library, &function);
        }
        linked.extend(built.runtimes);
        rows.push(Row {
            platform,
            built: true,
            said,
        });
    }
    linked.sort_by_key(Component::id);
    // The two compilers can be of one version.
    linked.dedup_by_key(|component| component.id());
    if rows.iter().all(|row| !row.built) {
        let reasons: Vec<_> = rows
            .iter()
            .map(|row| format!("\n  {}: {}", row.platform.folder, row.said))
            .collect();
        return Err(Failure::Found(format!(
            "built for no platform:{}",
            reasons.concat()
        )));
    }
    let folder = out.map_or_else(|| workspace.target.join("dist"), Path::to_owned);
    let archive = |(interface, binaries): (&Interface, Vec<Library>)| {
        let archive = folder.join(interface.name).with_extension("fmu");
        pack(
            subject,
            &facts,
            interface,
            binaries,
            linked.clone(),
            archive,
        )
    };
    let mut archives = Archives::default();
    for one in interfaces.iter().zip(binaries).map(archive) {
        archives.add(one?);
    }
    Ok((archives, rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fmu_export::declaration::{Declare, Description, Experiment, Stepping};

    /// A model with one variable that FMI 2.0 has no type for.
    #[derive(Default, fmu_export::Rows)]
    struct Counter {
        /// what is counted
        #[input]
        counted: [bool; 2],
        /// how often
        #[output]
        count: [u32; 2],
    }

    impl Declare for Counter {
        const DESCRIPTION: Description<Self> = Description {
            name: "Counter",
            about: "counts",
            stepping: Stepping::Exact,
            experiment: Experiment {
                start: 0.0,
                stop: 1.0,
                tolerance: 1e-6,
                step: 0.1,
            },
            variables: <Self as fmu_export::declaration::Rows>::ROWS,
        };
    }

    #[test]
    fn a_variable_without_a_type_in_fmi_2_is_named_unless_fmi_3_alone_is_asked_for() {
        let interface = Interface::of::<Counter>().unwrap();
        let asking = |fmi: &[Version]| Facts {
            fmi: fmi.to_vec(),
            ..Facts::default()
        };
        let said = refused(&interface, &asking(&[Version::Fmi2, Version::Fmi3])).unwrap();
        assert!(said.contains("count[1] is of type UInt32"), "{said}");
        assert!(said.contains("fmi = [\"3.0\"]"), "{said}");
        assert_eq!(refused(&interface, &asking(&[Version::Fmi3])), None);
    }
}
