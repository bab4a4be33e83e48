//! What a refused call is, by either version: an error, one message, nothing changed.

use crate::Status;
use crate::both::Hosted;

/// Asserts that a call is refused with a message that begins with the function's name and has all `parts`, and that
/// the instance is as before, bit for bit.
///
/// # Panics
/// When one of these does not hold.
#[track_caller]
pub fn refused<I: Hosted>(
    instance: &I,
    function: &str,
    parts: &[&str],
    call: impl FnOnce(&I) -> Status,
) {
    let before = instance.bytes();
    instance.messages();
    assert_eq!(call(instance), Status::ERROR, "{function} {parts:?}");
    let log = instance.messages();
    let [message] = &log[..] else {
        panic!("{function} {parts:?}: expected one message, got {log:?}")
    };
    assert_eq!(message.category, "logStatusError", "{message:?}");
    assert!(
        message.text.starts_with(&format!("{function}: ")),
        "{message:?}"
    );
    for part in parts {
        assert!(message.text.contains(part), "{part} is not in {message:?}");
    }
    assert_eq!(
        instance.bytes(),
        before,
        "{function} {parts:?} changed something"
    );
}
