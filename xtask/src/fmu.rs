//! Archives from libraries.

use crate::build::{LAG, PACKED, libraries, library_name};
use crate::catalogue::{Request, descriptions, pack};
use crate::linked;
use crate::process::{Outcome, at, root};
use cargo_fmu::{pack::replace, platform};
use std::path::Path;

/// Builds `target/fmu/<Name>.fmu` of every FMU, and `target/fmu/test/` for the tests of the C interface.
pub fn build_all(bless: bool) -> Outcome {
    let platform = platform::here()?.folder;
    // Before anything is built: a diff can be read while the libraries are made.
    descriptions(bless)?;
    let built = libraries()?;
    let folder = root().join("target/fmu");
    let request = |name, package: &str, folder: &Path| -> Outcome<Request> {
        let mut request = Request::new(name, folder, linked::components(package)?);
        request.add(platform, std::env::consts::DLL_SUFFIX, &built[name]);
        Ok(request)
    };
    let mut requests = Vec::new();
    for fmu in fmus::ALL {
        requests.push(request(fmu.name, &fmu.package(), &folder)?);
    }
    for example in PACKED {
        requests.push(request(example, "fmu-export", &folder.join("test"))?);
    }
    pack(&requests)?;
    for fmu in fmus::ALL {
        let size = |path: &Path| std::fs::metadata(path).map_or(0, |file| file.len()) / 1000;
        println!(
            "target/fmu/{}.fmu  {} kB, library {} kB, {platform}",
            fmu.name,
            size(&folder.join(fmu.name).with_extension("fmu")),
            size(&built[fmu.name])
        );
    }
    let lag = std::fs::read(&built[LAG]).map_err(at(&built[LAG]))?;
    replace(&folder.join("test").join(library_name(LAG)), &lag)
}
