//! The loop as the Python module `exo_native`.

use crate::coupling::{Call, Component, Copy, Ended, Loop, Pace};
use pyo3::prelude::*;
use std::time::Duration;

/// How long the loop runs before Python may see a signal, for instance Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);

/// What `run` takes and returns: a new number for each change, here and in `exo.loop`, so that no harness calls another one's wheel.
const INTERFACE: u32 = 1;

/// Address, value references, their number, first row, size of a row in bytes.
type CallAddresses = (usize, usize, usize, usize, usize);
/// Target's column in row 0, size of its rows; source's column in its first row, size of its rows; bytes of the value; whether
/// its negative goes there, which only a Real has.
type CopyAddresses = (usize, usize, usize, usize, usize, bool);
/// Instance, `fmi2DoStep`, copies, writes, reads.
type ComponentAddresses = (
    usize,
    usize,
    Vec<CopyAddresses>,
    Vec<CallAddresses>,
    Vec<CallAddresses>,
);

/// Makes the steps from number `first` to before number `steps`, each of `step` seconds, step 0 at t = 0. Releases the interpreter meanwhile.
///
/// `pace` are the addresses of two columns with a number for each step, s: then the clock says when a step begins, and the
/// columns get how late it was and how long it took.
///
/// Returns None, or what returned another status than fmi2OK: the component's number, "write", "step" or "read", the number
/// of the call among those, the status, the number of the step.
///
/// # Errors
/// What a signal handler raises, as KeyboardInterrupt.
///
/// # Safety for the caller in Python
/// The addresses must be what their names say and live until this returns; a row must be there for each step.
#[pyfunction]
#[pyo3(signature = (components, *, first, steps, step, pace=None))]
fn run(
    py: Python<'_>,
    components: Vec<ComponentAddresses>,
    first: usize,
    steps: usize,
    step: f64,
    pace: Option<(usize, usize)>,
) -> PyResult<Option<(usize, &'static str, usize, i32, usize)>> {
    let components = components.into_iter().map(component).collect();
    let pace = pace.map(|(late, busy)| Pace { late, busy });
    // SAFETY: the caller's contract, above.
    let mut coupled = unsafe { Loop::new(components, first, steps, step, pace) };
    loop {
        match py.detach(|| coupled.advance(PATIENCE)) {
            Ended::Interrupted => py.check_signals()?,
            Ended::Done => return Ok(None),
            Ended::Failed(failure) => {
                let (what, number) = failure.call.named();
                return Ok(Some((
                    failure.component,
                    what,
                    number,
                    failure.status,
                    failure.step,
                )));
            }
        }
    }
}

fn component((instance, do_step, copies, writes, reads): ComponentAddresses) -> Component {
    let call = |(function, references, count, row, size)| Call {
        function,
        references,
        count,
        row,
        size,
    };
    let copy = |(target, target_size, source, source_size, bytes, negative)| Copy {
        target,
        target_size,
        source,
        source_size,
        bytes,
        negative,
    };
    Component {
        instance,
        do_step,
        copies: copies.into_iter().map(copy).collect(),
        writes: writes.into_iter().map(call).collect(),
        reads: reads.into_iter().map(call).collect(),
    }
}

/// The loop of exo over coupled FMUs in machine code.
#[pymodule]
fn exo_native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("INTERFACE", INTERFACE)?;
    module.add_function(wrap_pyfunction!(run, module)?)
}
