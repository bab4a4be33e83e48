//! The document's first steps in a few tools. They need the archive, for a system those of its other parts, and nothing else.

use crate::Interface;
use crate::guide::System;
use crate::html::{Section, escape};
use crate::standard::Standard;
use crate::xml::double;
use std::fmt::Write as _;

/// The section.
pub(crate) fn section(interface: &Interface, system: System<'_>, standard: Standard) -> Section {
    match standard {
        Standard::Fmi2 => {}
        Standard::Fmi3 => return fmi3(interface),
        Standard::Fmi3Scheduled => return scheduled(interface),
    }
    let (name, step) = (interface.name, double(interface.experiment.step));
    let mut page = String::new();
    listing(
        &mut page,
        "<b>fmpy</b> (Python), one second alone, all outputs:",
        "python",
        &format!(
            "from fmpy import simulate_fmu\n\n\
             result = simulate_fmu(\"{name}.fmu\", stop_time=1.0, output_interval={step})\n\
             print(result.dtype.names)\n\
             print(result[-1])"
        ),
    );
    if !system.parts.is_empty() {
        listing(
            &mut page,
            "<b>OMSimulator</b> (Python, 3.0 or newer), with what it is connected to:",
            "python omsimulator",
            &ssp(interface, system),
        );
    }
    let _ = writeln!(
        page,
        "<p><b>Simulink</b>: add an FMU block (Simulink Extras, FMU Import), choose <code>{name}.fmu</code>, simulation mode \
         co-simulation, communication step size {step} s. Parameters are in the block's dialog, by group of their names; the elements of a \
         vector are separate ports. <b>Dymola, VEOS and others</b>: import as a co-simulation FMU with the same step size.</p>"
    );
    Section::new("quick-start", "Quick start", page)
}

/// An array is one column with several components in what fmpy returns.
fn fmi3(interface: &Interface) -> Section {
    let (name, step) = (interface.name, double(interface.experiment.step));
    let mut page = String::new();
    listing(
        &mut page,
        "<b>fmpy</b> (Python), one second alone, all outputs; an array has a column of its own shape:",
        "python",
        &format!(
            "from fmpy import simulate_fmu\n\n\
             result = simulate_fmu(\"{name}.fmu\", stop_time=1.0, output_interval={step})\n\
             print(result.dtype.names)\n\
             print(result[-1])"
        ),
    );
    let _ = writeln!(
        page,
        "<p><b>Other tools</b>: import as an FMI 3.0 co-simulation FMU with communication step size {step} s. Arrays are connected \
         whole; terminals (<code>terminalsAndIcons/terminalsAndIcons.xml</code>) say which variables go together. A tool that \
         knows no arrays takes the FMI 2.0 archive, where each element is a variable.</p>"
    );
    Section::new("quick-start", "Quick start", page)
}

/// The order of calls: few tools have a scheduler.
fn scheduled(interface: &Interface) -> Section {
    let mut page = String::new();
    let of_model = crate::header::macro_name(interface.name);
    listing(
        &mut page,
        "One tick, in C, of an instance made by <code>fmi3InstantiateScheduledExecution</code> and initialized:",
        "c",
        &format!(
            "/* set the inputs: fmi3SetFloat64, fmi3SetBoolean, … */\n\
             fmi3ActivateModelPartition(instance, {of_model}_CLOCK, start_time + k * {});\n\
             /* read the outputs: fmi3GetFloat64, … */",
            double(interface.experiment.step)
        ),
    );
    let _ = writeln!(
        page,
        "<p>A tool without a scheduler takes the co-simulation archive.</p>"
    );
    Section::new("quick-start", "Quick start", page)
}

/// A script that loads the system's FMUs, connects them and runs them.
fn ssp(interface: &Interface, system: System<'_>) -> String {
    let mut text = String::from("from OMSimulator import CRef, SSP\n\nparts = {\n");
    for (part, fmu) in system.parts {
        let _ = writeln!(text, "    \"{part}\": \"{fmu}.fmu\",");
    }
    text.push_str("}\nwires = [\n");
    for (from, to) in system.wires {
        let _ = writeln!(
            text,
            "    (\"{}\", \"{}\", \"{}\", \"{}\"),",
            from.0, from.1, to.0, to.1
        );
    }
    text.push_str(
        "]\nmodel = SSP()\n\
         for fmu in sorted(set(parts.values())):\n    \
             model.addResource(fmu, new_name=f\"resources/{fmu}\")\n\
         for part, fmu in parts.items():\n    \
             model.addComponent(CRef(\"default\", part), f\"resources/{fmu}\")\n\
         for source, output, target, input in wires:\n    \
             for i in (1, 2, 3) if \"[i]\" in output else (1,):\n        \
                 ends = (source, output.replace(\"[i]\", f\"[{i}]\")), (target, input.replace(\"[i]\", f\"[{i}]\"))\n        \
                 model.addConnection(*(CRef(\"default\", *end) for end in ends))\n",
    );
    for (part, variable, value) in system.start {
        let _ = writeln!(
            text,
            "model.setValue(CRef(\"default\", \"{part}\", \"{variable}\"), {value})"
        );
    }
    let _ = write!(
        text,
        "run = model.instantiate()\nrun.setResultFile(\"result.csv\")\nrun.setStopTime({})\nrun.setFixedStepSize({})\n\
         run.initialize()\nrun.simulate()\nrun.terminate()\nrun.delete()",
        double(interface.experiment.stop),
        double(interface.experiment.step)
    );
    text
}

fn listing(page: &mut String, title: &str, language: &str, text: &str) {
    let _ = writeln!(
        page,
        "<p>{title}</p>\n<pre class=\"{language}\">{}</pre>",
        escape(text)
    );
}
