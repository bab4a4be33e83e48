//! `cargo xtask dist`: one archive, many platforms.
//!
//! What cannot be built on this machine is left out and named; what can be built and then fails is an error. With
//! `--check` the libraries also run: a C host prints every number of every FMU, and the text must be that of linux64; and
//! `exo validate` judges the archives.
//!
//! | module | what |
//! |---|---|
//! | [`cargo_fmu`] | platforms, their tools (fetched into `target/toolchains`), libraries and what they need |
//! | [`mod@firmware`], [`processor`] | the C library for a microcontroller, and run emulated |
//! | [`mod@stack`] | the stack that it takes there |
//! | [`host`] | the C host, and what two platforms must agree on |

mod firmware;
mod host;
mod processor;
mod stack;

use crate::build;
use crate::catalogue::{Request, pack};
use crate::linked;
use crate::process::{Failure, Outcome, at, root, run, workspace};
use crate::schedule;
use crate::venv::{Packages, Venv};
use cargo_fmu::cdylib::Cdylib;
use cargo_fmu::plan::{Built, Inspected, Plan};
use cargo_fmu::platform::{GLIBC, PLATFORMS, Platform, Runner};
use cargo_fmu::toolchain::Toolchains;
pub use cargo_fmu::toolchain::with_libraries;
use fmu_archive::Component;
use host::{Host, Texts, compare, moves};
use std::time::Instant;

/// One platform's row in the summary.
struct Row {
    platform: &'static Platform,
    built: Option<Built>,
    /// What its libraries need, or why there are none.
    needs: String,
    /// What was run, or why not.
    ran: String,
}

/// The tools, between calls.
fn tools() -> Toolchains {
    Toolchains::at(root().join("target/toolchains"))
}

/// Where builds live between calls.
fn folder() -> std::path::PathBuf {
    root().join("target/dist-build")
}

/// All FMUs and the test model.
fn libraries() -> Vec<Cdylib> {
    let mut libraries = build::fmus();
    libraries.push(build::example(build::LAG));
    libraries
}

/// Names of the platforms.
#[cfg(test)]
pub fn platforms() -> Vec<&'static str> {
    PLATFORMS.iter().map(|platform| platform.folder).collect()
}

/// Fetches all tools that can be had; those that cannot are named by who needs them.
pub fn toolchains() -> Outcome {
    tools().fetch();
    Ok(())
}

/// Builds and inspects one platform's libraries, if the tools for it can be had.
pub fn platform(folder: &str) -> Outcome {
    let tools = tools();
    let platform = PLATFORMS.iter().find(|one| one.folder == folder);
    let platform = platform.ok_or(Failure::Missing("no such platform"))?;
    let row = row(platform, &tools)?;
    println!("   {}", row.needs);
    Ok(())
}

/// Builds the C library for a microcontroller, if the tools for it can be had.
pub fn firmware() -> Outcome {
    match firmware::build(&tools())? {
        Ok(said) => println!("   {said}"),
        Err(reason) => println!("   not built: {reason}"),
    }
    Ok(())
}

/// Builds the smallest FMU a second time in another folder: the same bytes.
pub fn twice() -> Outcome {
    let tools = tools();
    built_twice(&row(&PLATFORMS[0], &tools)?, &tools)
}

fn row(platform: &'static Platform, tools: &Toolchains) -> Outcome<Row> {
    let (built, needs) = match Plan::of(platform, tools) {
        Ok(plan) => {
            let built = plan.build(&workspace(), platform, &folder(), &libraries())?;
            let seen = built.inspected(&workspace(), platform)?;
            no_mathematics(platform, &seen)?;
            (Some(built), seen.said)
        }
        Err(reason) => (None, format!("not built: {reason}")),
    };
    Ok(Row {
        platform,
        built,
        needs,
        ran: String::new(),
    })
}

/// The same inputs give the same bits everywhere: nothing may be called that a platform rounds in its own way.
fn no_mathematics(platform: &Platform, seen: &Inspected) -> Outcome {
    match seen.rounded.first() {
        None => Ok(()),
        Some((library, function)) => Err(Failure::Found(format!(
            "{library} for {} calls {function} of the platform's C library, which each rounds in its own way: expected the libm \
             crate",
            platform.folder
        ))),
    }
}

/// Builds `target/dist/*.fmu`; with `check` also runs and compares what can be run here, and builds one library twice.
pub fn dist(check: bool) -> Outcome {
    let tools = tools();
    let mut rows = Vec::new();
    for platform in &PLATFORMS {
        println!("\n── {}", platform.folder);
        let began = Instant::now();
        let row = row(platform, &tools)?;
        println!("   {}: {:.1} s", row.needs, began.elapsed().as_secs_f64());
        rows.push(row);
    }
    println!("\n── {}", firmware::TARGET);
    let mut firmware = firmware::build(&tools)?;
    merge(&rows)?;
    systems()?;
    if check {
        println!("\n── run");
        run_all(&mut rows, &tools)?;
        if let Ok(said) = &mut firmware {
            let ran = processor::run(&tools)?.unwrap_or_else(|reason| format!("not run: {reason}"));
            println!("   {}: {ran}", firmware::TARGET);
            *said += &format!("; {ran}");
        }
        // As a part of `cargo xtask ci` this has a stage of its own.
        if !schedule::in_a_stage() {
            built_twice(&rows[0], &tools)?;
        }
        validated(&rows)?;
    }
    summary(&rows, &firmware)
}

/// Writes the archives.
fn merge(rows: &[Row]) -> Outcome {
    let built: Vec<_> = rows
        .iter()
        .filter_map(|row| Some((row.platform, row.built.as_ref()?)))
        .collect();
    if built.is_empty() {
        return Err(Failure::Found("built for no platform".to_owned()));
    }
    let runtimes = || built.iter().flat_map(|(_, built)| &built.runtimes);
    runtimes().try_for_each(linked::may_be_linked)?;
    let mut requests = Vec::new();
    for fmu in fmus::ALL {
        let mut components = linked::components(&fmu.package())?;
        components.extend(runtimes().cloned());
        components.sort_by_key(Component::id);
        // The two compilers can be of one version.
        components.dedup_by_key(|component| component.id());
        let mut request = Request::new(fmu.name, &root().join("target/dist"), components);
        for (platform, built) in &built {
            let library = &built.libraries[fmu.name];
            request.add(platform.folder, platform.suffix, &library.path);
        }
        requests.push(request);
    }
    pack(&requests)
}

/// The coupled systems, with these archives in them.
fn systems() -> Outcome {
    let folders = ["--fmu-dir", "target/dist", "--out", "target/dist/ssp"];
    run(Venv::ready(Packages::Run)?.exo(["ssp"]).args(folders))
}

/// Runs the host on every platform that can be run here; all must print what the first one prints.
fn run_all(rows: &mut [Row], tools: &Toolchains) -> Outcome {
    let mut reference: Option<Texts> = None;
    for row in rows {
        let Some(built) = &row.built else { continue };
        if row.platform.runner == Runner::Nothing {
            row.ran = "built only, never run".to_owned();
            continue;
        }
        let host = match Host::of(row.platform, tools) {
            Ok(host) => host,
            Err(reason) => {
                row.ran = format!("not run: {reason}");
                continue;
            }
        };
        let texts = host.run(built, tools)?;
        match &reference {
            None => {
                if let Some((name, _)) = texts.iter().find(|(_, text)| !moves(text)) {
                    return Err(Failure::Found(format!(
                        "{name}: nothing moves in the host's run"
                    )));
                }
                let lines: usize = texts.values().map(|text| text.lines().count()).sum();
                row.ran = format!("run, {lines} lines");
                reference = Some(texts);
            }
            Some(reference) => {
                let lines = compare(reference, &texts).map_err(|what| {
                    Failure::Found(format!(
                        "{} differs from {}: {what}",
                        row.platform.folder, PLATFORMS[0].folder
                    ))
                })?;
                row.ran = format!("run, {lines} lines equal bit for bit");
            }
        }
        println!("   {}: {}", row.platform.folder, row.ran);
    }
    Ok(())
}

/// Builds the smallest FMU again in another folder: the same bytes.
fn built_twice(row: &Row, tools: &Toolchains) -> Outcome {
    const SMALLEST: &str = "HumanOperator";
    let Some(first) = &row.built else {
        return Ok(());
    };
    let platform = row.platform;
    let plan = Plan::of(platform, tools).map_err(Failure::Found)?;
    let folder = root().join("target/dist-again");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(at(&folder))?;
    }
    let mut smallest = libraries();
    smallest.retain(|cdylib| cdylib.name == SMALLEST);
    let second = plan.build(&workspace(), platform, &folder, &smallest)?;
    let bytes = |built: &Built| {
        built
            .libraries
            .get(SMALLEST)
            .map(|library| library.bytes.clone())
    };
    if bytes(first).is_some() && bytes(first) == bytes(&second) {
        println!("   {SMALLEST} built again in another folder: the same bytes");
        Ok(())
    } else {
        Err(Failure::Found(format!(
            "{SMALLEST} built twice: the libraries differ"
        )))
    }
}

/// Judges the archives with `exo validate`, which also loads and runs the library of this machine.
fn validated(rows: &[Row]) -> Outcome {
    let venv = Venv::ready(Packages::Run)?;
    let mut validate = venv.exo(["validate", "--strict"]);
    for row in rows {
        if let Some(built) = &row.built {
            validate.args(["--platform", row.platform.folder]);
            if row.platform.folder == PLATFORMS[0].folder && built.strict {
                validate.args(["--max-glibc", &format!("{}.{}", GLIBC.0, GLIBC.1)]);
            }
        }
    }
    run(validate.args(
        fmus::NAMES
            .iter()
            .map(|name| format!("target/dist/{name}.fmu")),
    ))
}

/// Prints what was built, run and left out, and keeps it beside the archives.
fn summary(rows: &[Row], firmware: &Result<String, String>) -> Outcome {
    let mut text = String::new();
    for row in rows {
        let state = if row.built.is_some() {
            "built   "
        } else {
            "LEFT OUT"
        };
        text += &format!("{state} {:<15} {}\n", row.platform.folder, row.needs);
        if !row.ran.is_empty() {
            text += &format!("{:24} {}\n", "", row.ran);
        }
    }
    text += &match firmware {
        Ok(sizes) => format!(
            "built    {}, the C library alone: {sizes}\n",
            firmware::TARGET
        ),
        Err(reason) => format!("LEFT OUT {}: not built: {reason}\n", firmware::TARGET),
    };
    println!("\n{text}\ntarget/dist/*.fmu, fmi3/*, ssp/*, law/*");
    let path = root().join("target/dist/platforms.txt");
    std::fs::write(&path, text).map_err(at(&path))
}
