//! What `cargo xtask` asks of the models.
//!
//! ```text
//! catalogue descriptions           says which committed descriptions are not what the declarations give
//! catalogue bless                  writes them
//! catalogue archives REQUESTS      packs; a file of JSON, a list of requests
//! catalogue tables FOLDER          writes <Name>.txt for the C host
//! catalogue law-headers FOLDER     writes the C headers of the law's library
//! catalogue law-documents REQUEST  writes its licences and its bill of materials; a file of JSON
//! catalogue laws                   prints the table of the laws in docs/controllers.md
//! ```

use cargo_fmu::pack::replace;
use catalogue::request::{LawDocuments, Request};
use catalogue::{FMUS, Fmu, header, laws, table};
use fmu_archive::Standard;
use std::path::Path;
use std::process::ExitCode;

/// The smallest example: packed for the tests, no FMU of the project. So are the next two, with every type of variable.
#[path = "../../export/examples/integrator.rs"]
mod integrator;

#[path = "../../export/examples/feedthrough/model.rs"]
mod feedthrough;

#[path = "../../export/examples/narrow/model.rs"]
mod narrow;

const USAGE: &str = "usage: catalogue descriptions | bless | archives REQUESTS | tables FOLDER | law-headers FOLDER | law-documents REQUEST | laws";

fn main() -> ExitCode {
    let words: Vec<_> = std::env::args().skip(1).collect();
    let words: Vec<_> = words.iter().map(String::as_str).collect();
    let outcome = match *words {
        ["descriptions"] => descriptions(false),
        ["bless"] => descriptions(true),
        ["archives", requests] => archives(Path::new(requests)),
        ["tables", folder] => tables(Path::new(folder)),
        ["laws"] => {
            println!("{}", laws::table());
            Ok(())
        }
        ["law-headers", folder] => law_headers(Path::new(folder)),
        ["law-documents", request] => law_documents(Path::new(request)),
        _ => Err(USAGE.to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn descriptions(bless: bool) -> Result<(), String> {
    for fmu in FMUS {
        let interface = fmu
            .interface()
            .map_err(|error| format!("declaration of {}: {error}", fmu.name))?;
        for standard in Standard::of(&interface) {
            let path = fmu.committed(standard);
            if bless {
                fmu.bless(&interface, standard).map_err(at(&path))?;
            } else if !fmu.is_committed(&interface, standard) {
                println!(
                    "note: {} is out of date: `cargo xtask fmu --bless`, then read the diff",
                    path.display()
                );
            }
        }
    }
    Ok(())
}

fn archives(requests: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(requests).map_err(at(requests))?;
    let requests: Vec<Request> =
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", requests.display()))?;
    let examples = [
        Fmu::example::<integrator::Integrator>("integrator"),
        Fmu::example::<feedthrough::Feedthrough>("feedthrough"),
        Fmu::example::<narrow::Narrow>("narrow"),
    ];
    for request in requests {
        let mut all = FMUS.iter().chain(&examples);
        let fmu = all
            .find(|fmu| fmu.name == request.name)
            .ok_or_else(|| format!("no FMU is named {}", request.name))?;
        for (path, bytes) in request.archives(fmu)? {
            replace(&path, &bytes).map_err(said)?;
        }
    }
    Ok(())
}

fn law_headers(folder: &Path) -> Result<(), String> {
    for (name, text) in header::NAMES.iter().zip(header::headers()?) {
        let path = folder.join(name);
        replace(&path, text.as_bytes()).map_err(said)?;
    }
    Ok(())
}

fn law_documents(request: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(request).map_err(at(request))?;
    let documents: LawDocuments =
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", request.display()))?;
    for (path, bytes) in documents.files()? {
        replace(&path, &bytes).map_err(said)?;
    }
    Ok(())
}

fn tables(folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(at(folder))?;
    for fmu in FMUS {
        let interface = fmu
            .interface()
            .map_err(|error| format!("declaration of {}: {error}", fmu.name))?;
        let path = folder.join(fmu.name).with_extension("txt");
        std::fs::write(&path, table::of(&interface)).map_err(at(&path))?;
    }
    Ok(())
}

fn at(path: &Path) -> impl FnOnce(std::io::Error) -> String {
    move |error| format!("{}: {error}", path.display())
}

fn said(failure: cargo_fmu::process::Failure) -> String {
    failure.to_string()
}
