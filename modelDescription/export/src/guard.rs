//! The one guard around every call: null, phase, panic, log, status.

use crate::failure::{Failure, Outcome};
use crate::ffi::{Component, Status};
use crate::instance::Instance;
use crate::legality::{Call, Interface};
use crate::log::Log;
use crate::model::Model;
use std::cell::RefCell;
use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::Once;

/// Runs `call` on the instance behind `component`, if that is legal now, with everything that can go wrong turned into
/// a logged error.
///
/// # Safety
/// `component` is null or was returned by one of the functions that instantiate the same model, was not freed, and is
/// used by no other thread during the call (the importer's contract).
pub unsafe fn guard<M: Model, F: Call>(
    component: Component,
    function: F,
    call: impl FnOnce(&mut Instance<M>) -> Outcome,
) -> Status {
    // SAFETY: this function's contract.
    let Some(instance) = (unsafe { component.cast::<Instance<M>>().as_mut() }) else {
        return Status::Error; // no instance, hence no logger to tell
    };
    // `#[repr(C)]` in Instance keeps nothing of it half-changed: refused calls change nothing, broken ones are marked.
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let state = F::state(instance.phase(), instance.interface());
        // A function that is legal in no state says itself what is missing.
        if !function.legal_in().contains(&state) && !function.legal_in().is_empty() {
            return Err(Failure::Refused(not_legal(
                function,
                state,
                instance.interface(),
            )));
        }
        call(instance)
    }))
    .unwrap_or_else(|_| {
        Err(Failure::Broken(format!(
            "panic in the model: {}",
            last_panic()
        )))
    });

    match outcome {
        Ok(()) => Status::Ok,
        Err(failure) => failed(instance, function, failure),
    }
}

/// What `make` makes of a model before there is an instance to mark; none where it fails or panics, and the log says why, under
/// the name of the `function`.
pub(crate) fn made<T>(
    function: &str,
    log: &mut Log<'_>,
    make: impl FnOnce() -> Result<T, String>,
) -> Option<T> {
    catch_unwind(AssertUnwindSafe(make))
        .unwrap_or_else(|_| Err(format!("panic in the model: {}", last_panic())))
        .inspect_err(|reason| log.error(format_args!("{function}: {reason}")))
        .ok()
}

/// Logs why a call failed, and marks an instance whose model broke.
#[cold]
fn failed<M: Model, F: Call>(instance: &mut Instance<M>, function: F, failure: Failure) -> Status {
    let (name, ways_out) = (
        function.name(instance.interface()),
        instance.interface().ways_out(),
    );
    // Logging calls the importer and allocates; neither may let a panic out.
    let _ = catch_unwind(AssertUnwindSafe(|| match failure {
        Failure::Refused(reason) => instance.log().error(format_args!("{name}: {reason}")),
        Failure::Broken(reason) => {
            instance.enter_error();
            instance.log().error(format_args!(
                "{name}: {reason}; the instance needs {ways_out}"
            ));
        }
    }));
    Status::Error
}

#[cold]
fn not_legal<F: Call>(function: F, state: F::State, interface: Interface) -> String {
    let mut text = format!(
        "not legal in the phase '{}', expected ",
        F::state_name(state, interface)
    );
    for (i, &legal) in function.legal_in().iter().enumerate() {
        let _ = write!(
            text,
            "{}'{}'",
            if i == 0 { "" } else { " or " },
            F::state_name(legal, interface)
        );
    }
    text
}

thread_local! {
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Message and place of this thread's last panic.
pub(crate) fn last_panic() -> String {
    LAST_PANIC
        .try_with(|message| std::mem::take(&mut *message.borrow_mut()))
        .unwrap_or_default()
}

/// Keeps panics off stderr and their messages for the log. The library links its own standard library, so the hook is
/// not the importer's.
pub(crate) fn install_panic_hook() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        std::panic::set_hook(Box::new(|info: &PanicHookInfo<'_>| {
            let what = info
                .payload()
                .downcast_ref::<&str>()
                .copied()
                .or_else(|| info.payload().downcast_ref::<String>().map(String::as_str))
                .unwrap_or("unknown cause");
            let place = info
                .location()
                .map(|l| format!(" at {}:{}", l.file(), l.line()))
                .unwrap_or_default();
            let _ = LAST_PANIC.try_with(|message| *message.borrow_mut() = format!("{what}{place}"));
        }));
    });
}
