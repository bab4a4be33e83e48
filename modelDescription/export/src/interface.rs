//! The library hands its interface over to `cargo fmu`: in a build with the feature `interface` alone, which is for no
//! archive. There it has one function more, [`SYMBOL`](fmu_archive::hand_over::SYMBOL).

use fmu_archive::{Interface, hand_over};
use fmu_declaration::Declare;

/// The bytes of [`hand_over::bytes`]; they live as long as the library.
#[doc(hidden)]
pub fn bytes<M: Declare>() -> &'static [u8] {
    let interface = Interface::of::<M>();
    hand_over::bytes(interface.as_ref()).leak()
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
