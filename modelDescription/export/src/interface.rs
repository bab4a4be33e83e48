//! The library hands its interface over to `cargo fmu`: in a build with the feature `interface` alone, which is for no
//! archive. There it has one function more, [`SYMBOL`](fmu_archive::hand_over::SYMBOL).

use crate::guard::{install_panic_hook, last_panic};
use fmu_archive::{Interface, hand_over};
use fmu_declaration::Declare;
use std::panic::catch_unwind;

/// The bytes of [`hand_over::bytes`]; they live as long as the library. The start values are the model's code, which may panic.
#[doc(hidden)]
pub fn bytes<M: Declare>() -> &'static [u8] {
    install_panic_hook();
    let bytes = catch_unwind(|| hand_over::bytes(Interface::of::<M>().as_ref()));
    let panicked = |_| hand_over::refusal(format!("panic in the start values: {}", last_panic()));
    bytes.unwrap_or_else(panicked).leak()
}

/// The function that `cargo fmu` calls.
#[doc(hidden)]
#[macro_export]
macro_rules! hand_over {
    ($model:ty) => {
        /// Where the bytes of the interface begin; `length` becomes their number.
        ///
        /// # Safety
        /// `length` is valid for writing.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn fmu_interface(length: *mut usize) -> *const u8 {
            let bytes = $crate::interface::bytes::<$model>();
            // SAFETY: the caller's contract.
            unsafe { *length = bytes.len() };
            bytes.as_ptr()
        }
    };
}
