//! The harness' loop over coupled FMUs in machine code: `exo run --engine native`.
//!
//! Everything around the loop is Python (`exo.master`): archives, names, checks, wires, recordings. It hands over addresses:
//! of the FMUs' C functions, of their instances, of value references and of the buffers that hold one row for each
//! communication point. What is recorded is thus in NumPy's memory when the loop ends, and the numbers are those of the
//! Python loop bit for bit: both make the same calls with the same values in the same order.
//!
//! | module | what |
//! |---|---|
//! | [`coupling`] | the loop, without Python |
//! | `python` | the Python module, with the feature of this name |

pub mod coupling;
#[cfg(feature = "python")]
mod python;
