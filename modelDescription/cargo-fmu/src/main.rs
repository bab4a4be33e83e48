//! `cargo fmu`.

use cargo_fmu::new::Sdk;
use cargo_fmu::platform::{PLATFORMS, Platform};
use cargo_fmu::process::{Failure, Outcome};
use cargo_fmu::subject::Choice;
use cargo_fmu::toolchain::Toolchains;
use cargo_fmu::{archive, check, describe, interface, new};
use clap::{Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "cargo", bin_name = "cargo")]
enum Arguments {
    /// FMUs from Rust models
    #[command(subcommand, version)]
    Fmu(Command),
}

#[derive(Subcommand)]
enum Command {
    /// Make a package with a model, a mass on a spring with a damper, and a test that steps it
    New {
        /// The folder, which must not be there yet; the package is named like it
        folder: PathBuf,
        /// The folder of the SDK's sources, needed while the SDK is not on the registry; without it the SDK comes from there
        #[arg(long, value_name = "PATH")]
        sdk: Option<PathBuf>,
    },
    /// Build the FMUs of a package for this machine, into target/fmu
    #[command(after_long_help = FACTS)]
    Build {
        #[command(flatten)]
        choice: Choice,
        /// The profile of cargo; panics are always caught, symbols never kept
        #[arg(long, value_name = "NAME", default_value = "release")]
        profile: String,
        /// The profile release, which is taken anyhow
        #[arg(long, short, conflicts_with = "profile")]
        release: bool,
        /// Where the archives go; without it fmu in cargo's target folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Build the FMUs of a package for every platform that this machine has tools for, into target/dist
    #[command(after_long_help = FACTS)]
    Dist {
        #[command(flatten)]
        choice: Choice,
        /// One platform, by its folder in an archive; may be given several times; without it all
        #[arg(long, value_name = "FOLDER")]
        platform: Vec<String>,
        /// Where tools are kept, once fetched; without it toolchains in cargo's target folder
        #[arg(long, value_name = "DIR")]
        toolchains: Option<PathBuf>,
        /// Where the archives go; without it dist in cargo's target folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Judge FMUs with `exo validate`: those given, or those of a package, which are built first
    Check {
        #[command(flatten)]
        choice: Choice,
        /// Archives
        fmu: Vec<PathBuf>,
        /// The program `exo`; without it that on the PATH, or beside the SDK's sources
        #[arg(long, value_name = "PROGRAM")]
        validator: Option<PathBuf>,
    },
    /// Show the variables of FMUs as a table: of those given, or of the models of a package
    Describe {
        #[command(flatten)]
        choice: Choice,
        /// Archives
        fmu: Vec<PathBuf>,
    },
}

const FACTS: &str = "\
What the FMU says of its author comes from Cargo.toml: version, authors, license and license-file of [package], and

    [package.metadata.fmu]
    author = \"Jane Doe\"                      # without it the authors
    copyright = \"Copyright 2026 Jane Doe\"
    licenses = [\"LICENSE\"]                   # without it files of such names beside Cargo.toml, or in the workspace's folder
    icon = \"icon.png\"                        # shown on the block
    guide = \"guide.html\"                     # what the model does: paragraphs for the interface document
    picture = \"signs.svg\"                    # signs and frames, in the interface document
    resources = \"resources\"                  # a folder, which the model finds again at run time
    extra = \"extra\"                          # a folder, for layered standards
    fmi = [\"3.0\"]                            # the versions of the standard; without it \"2.0\" and \"3.0\"

RUSTFLAGS and the flags in cargo's configuration do not apply: the same source gives the same library everywhere.";

fn main() -> ExitCode {
    let words: Vec<_> = std::env::args_os().collect();
    let outcome = match words.as_slice() {
        [_, word, library, written] if word == interface::LOAD => {
            interface::load(library.as_ref(), written.as_ref())
        }
        // Started by its own name, without cargo, it wants no second name.
        [own, first, ..] if first != "fmu" => {
            let rest = words.iter().skip(1).cloned();
            let words = [own.clone(), "fmu".into()].into_iter().chain(rest);
            let Arguments::Fmu(command) = Arguments::parse_from(words);
            run(command)
        }
        _ => {
            let Arguments::Fmu(command) = Arguments::parse();
            run(command)
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: Command) -> Outcome {
    match command {
        Command::New { folder, sdk } => {
            let sdk = sdk.map_or(Sdk::Registry, Sdk::Sources);
            let files = new::package(&folder, &sdk)?;
            for file in &files {
                println!("{}", file.display());
            }
            println!(
                "\nnext: cd {:?} && cargo fmu build",
                folder.display().to_string()
            );
            Ok(())
        }
        Command::Build {
            choice,
            profile,
            release: _,
            out,
        } => {
            let archives = archive::build(&choice.subject()?, &profile, out.as_deref())?;
            for archive in &archives.written {
                println!("{}", archive.display());
            }
            archives.complete()
        }
        Command::Dist {
            choice,
            platform,
            toolchains,
            out,
        } => dist(&choice, &platform, toolchains, out.as_deref()),
        Command::Check {
            choice,
            fmu,
            validator,
        } => {
            if fmu.is_empty() {
                let subject = choice.subject()?;
                let validator = check::validator(validator.as_deref(), Some(&subject))?;
                let archives = archive::build(&subject, "release", None)?;
                check::archives(&archives.written, &validator)?;
                archives.complete()
            } else {
                // The SDK's validator serves archives of others, too.
                let subject = choice.subject().ok();
                let validator = check::validator(validator.as_deref(), subject.as_ref())?;
                check::archives(&fmu, &validator)
            }
        }
        Command::Describe { choice, fmu } => {
            if fmu.is_empty() {
                for table in archive::describe(&choice.subject()?)? {
                    print!("{table}");
                }
            }
            for path in fmu {
                print!("{}", describe::archive(&path)?);
            }
            Ok(())
        }
    }
}

fn dist(
    choice: &Choice,
    wanted: &[String],
    toolchains: Option<PathBuf>,
    out: Option<&Path>,
) -> Outcome {
    let platforms: Vec<&'static Platform> = if wanted.is_empty() {
        PLATFORMS.iter().collect()
    } else {
        wanted
            .iter()
            .map(|name| Platform::named(name))
            .collect::<Outcome<_>>()?
    };
    let subject = choice.subject()?;
    let folder = toolchains.unwrap_or_else(|| subject.workspace.target.join("toolchains"));
    let (archives, rows) = archive::dist(&subject, &platforms, &Toolchains::at(folder), out)?;
    for row in &rows {
        let state = if row.built { "built   " } else { "LEFT OUT" };
        println!("{state} {:<15} {}", row.platform.folder, row.said);
    }
    for archive in &archives.written {
        println!("{}", archive.display());
    }
    archives.complete()?;
    match rows.iter().find(|row| !row.built && !wanted.is_empty()) {
        None => Ok(()),
        Some(row) => Err(Failure::Found(format!(
            "--platform {} cannot be built here: {}",
            row.platform.folder, row.said
        ))),
    }
}
