//! From a Rust model to an FMU. The program `cargo-fmu` and this project's own `cargo xtask` call the same functions.
//!
//! | module | what |
//! |---|---|
//! | [`mod@new`] | a package with a model, to begin with |
//! | [`subject`] | which models are meant |
//! | [`facts`] | what their package says of them |
//! | [`mod@interface`] | a model's interface, from its library |
//! | [`mod@archive`] | a stranger's archives |
//! | [`describe`] | an archive's variables as a table |
//! | [`check`] | the validator |
//! | [`workspace`] | the cargo workspace whose models are built |
//! | [`mod@cdylib`] | a target of cargo that becomes a shared library with one model |
//! | [`compile`], [`plan`] | libraries for this machine, or for one platform with its tools |
//! | [`trace`] | what of this machine must not be in them |
//! | [`mod@platform`] | the table of the platforms |
//! | [`debian`], [`toolchain`] | compilers, linkers, emulators, fetched into a folder of their own |
//! | [`runtime`] | what the tools link in, with its licences |
//! | [`mod@inspect`], [`functions`] | exports, needed libraries, floor of the C library |
//! | [`linked`] | what is linked into a library, with its licence texts |
//! | [`pack`] | archives from libraries |
//! | [`process`] | other programs, and what went wrong with them |

pub mod archive;
pub mod cdylib;
pub mod check;
pub mod compile;
pub mod debian;
pub mod describe;
pub mod facts;
mod folder;
pub mod functions;
pub mod inspect;
pub mod interface;
pub mod linked;
pub mod new;
pub mod pack;
pub mod plan;
pub mod platform;
pub mod process;
pub mod runtime;
pub mod subject;
mod table;
pub mod toolchain;
pub mod trace;
pub mod workspace;

pub use workspace::Workspace;
