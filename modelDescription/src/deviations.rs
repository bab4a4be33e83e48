//! The interface document's section on where the C interface deviates from the standard: more lenient than its table of legal
//! calls, because importers make these calls, or with an answer that the standard leaves open.

use crate::html::Section;
use crate::standard::Standard;

/// From FMI 2.0.5, section 4.2.4.
const FMI2: [&str; 6] = [
    "Variables can be read right after instantiation: they show the start values.",
    "Inputs can be set before Initialization Mode.",
    "<code>fmi2EnterInitializationMode</code> is accepted without <code>fmi2SetupExperiment</code>: the start time is then 0, \
     without a stop time.",
    "A refused call (wrong argument, order, value or state bytes) returns <code>fmi2Error</code>, changes nothing and does not end \
     the run. Only a failed step or a caught panic does: then <code>fmi2Reset</code>, <code>fmi2SetFMUstate</code> or \
     <code>fmi2FreeInstance</code> must follow.",
    "<code>fmi2Warning</code>, <code>fmi2Discard</code>, <code>fmi2Pending</code> and <code>fmi2Fatal</code> are never returned. \
     What is unsupported (input derivatives, output derivatives, directional derivatives, asynchronous steps) returns \
     <code>fmi2Error</code>.",
    "<code>fmi2GetRealStatus(fmi2LastSuccessfulTime)</code> and <code>fmi2GetBooleanStatus(fmi2Terminated)</code> are answered at any \
     time after initialization.",
];

/// From FMI 3.0, sections 2.3, 4.2 and 5.2.
const FMI3: [&str; 3] = [
    "A refused call (wrong argument, order, value or state bytes) returns <code>fmi3Error</code>, changes nothing and does not end \
     the run. Only a failed step or a caught panic does: then <code>fmi3Reset</code>, <code>fmi3SetFMUState</code> or \
     <code>fmi3FreeInstance</code> must follow.",
    "<code>fmi3Warning</code>, <code>fmi3Discard</code> and <code>fmi3Fatal</code> are never returned. What is unsupported returns \
     <code>fmi3Error</code> and says so.",
    "Variables can be read after they were set, without a step or an activation between: they show what was set.",
];

/// The section.
pub(crate) fn section(standard: Standard) -> Section {
    let (version, all): (_, &[&str]) = if standard.is_fmi3() {
        ("3.0", &FMI3)
    } else {
        ("2.0.5", &FMI2)
    };
    let list: String = all.iter().map(|one| format!("<li>{one}</li>\n")).collect();
    let title = format!("Deviations from FMI {version}");
    Section::new("deviations", &title, format!("<ul>\n{list}</ul>\n"))
}
