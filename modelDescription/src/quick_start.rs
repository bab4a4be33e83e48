//! The document's first steps in a few tools. They need the archive and nothing else.

use crate::html::escape;
use crate::xml::double;
use crate::{Connection, Interface};
use std::fmt::Write as _;

/// Appends the section.
pub fn append(page: &mut String, interface: &Interface, wiring: &[Connection<'_>]) {
    let (name, step) = (interface.name, double(interface.experiment.step));
    page.push_str("<h2 id=\"quick-start\">Quick start</h2>\n");
    listing(
        page,
        "<b>fmpy</b> (Python), one second alone, all outputs:",
        "python",
        &format!(
            "from fmpy import simulate_fmu\n\n\
             result = simulate_fmu(\"{name}.fmu\", stop_time=1.0, output_interval={step})\n\
             print(result.dtype.names)\n\
             print(result[-1])"
        ),
    );
    listing(
        page,
        "<b>OMSimulator</b> (Lua), with what it is connected to:",
        "lua",
        &lua(interface, wiring),
    );
    let _ = writeln!(
        page,
        "<p><b>Simulink</b>: add an FMU block (Simulink Extras, FMU Import), choose <code>{name}.fmu</code>, simulation mode \
         co-simulation, communication step size {step} s. Parameters are in the block's dialog, by group of their names; the elements of a \
         vector are separate ports. <b>Dymola, VEOS and others</b>: import as a co-simulation FMU with the same step size.</p>"
    );
}

/// A script that loads this FMU and those at the other end of its connections, and makes the connections between them.
fn lua(interface: &Interface, wiring: &[Connection<'_>]) -> String {
    let mut models = vec![interface.name];
    let always = || {
        wiring
            .iter()
            .filter(|connection| connection.when.is_empty())
    };
    for name in always().flat_map(|connection| [connection.from.0, connection.to.0]) {
        if !models.contains(&name) {
            models.push(name);
        }
    }
    let mut text = String::from("oms_newModel(\"m\")\noms_addSystem(\"m.s\", oms_system_wc)\n");
    for model in &models {
        let _ = writeln!(text, "oms_addSubModel(\"m.s.{model}\", \"{model}.fmu\")");
    }
    for Connection { from, to, .. } in always() {
        let vector = from.1.ends_with("[i]");
        for i in 1..=if vector { 3 } else { 1 } {
            let element = |name: &str| name.replace("[i]", &format!("[{i}]"));
            let _ = writeln!(
                text,
                "oms_addConnection(\"m.s.{}.{}\", \"m.s.{}.{}\")",
                from.0,
                element(from.1),
                to.0,
                element(to.1)
            );
        }
    }
    let _ = write!(
        text,
        "oms_setFixedStepSize(\"m.s\", {})\noms_setStopTime(\"m\", {})\noms_setResultFile(\"m\", \"result.csv\")\n\
         oms_instantiate(\"m\")\noms_initialize(\"m\")\noms_simulate(\"m\")\noms_terminate(\"m\")\noms_delete(\"m\")",
        double(interface.experiment.step),
        double(interface.experiment.stop)
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
