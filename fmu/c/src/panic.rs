//! What would happen on a panic, if there were one: the library does not link.
//!
//! A static library without `std` must bring a panic handler. This one calls a function that nobody defines. The linker
//! drops it because nothing reaches it; if any path of the law could panic, the program could not be linked.

#[cfg(feature = "freestanding")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn exo_law_has_a_path_that_panics() -> !;
    }
    // SAFETY: never called; the function does not exist.
    unsafe { exo_law_has_a_path_that_panics() }
}
