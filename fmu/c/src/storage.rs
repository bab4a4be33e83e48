//! Memory that the caller provides for a law.
//!
//! Its size is the same on every target and has room to spare, so that a law that grows does not change the interface.

use core::mem::MaybeUninit;

/// A law's memory: a mark that says what lies in it, and the law.
#[derive(Clone, Copy)]
#[repr(C)]
pub(crate) struct Cell<T: Copy> {
    mark: u64,
    law: MaybeUninit<T>,
}

/// A type of the interface whose memory holds a `Law`.
///
/// # Safety
/// The type consists of plain bytes, of which there are enough for a `Cell<Law>`, and is aligned for it: [`fits`] in a
/// constant.
pub(crate) unsafe trait Storage {
    /// What lies in it.
    type Law: Copy;
    /// The mark of an initialized one.
    const MARK: u64;
}

/// Whether a `Cell` of the law fits into the memory.
pub(crate) const fn fits<S: Storage>() -> bool {
    size_of::<Cell<S::Law>>() <= size_of::<S>() && align_of::<Cell<S::Law>>() <= align_of::<S>()
}

impl<T: Copy> Cell<T> {
    /// An initialized one.
    pub(crate) fn new(mark: u64, law: T) -> Self {
        Self {
            mark,
            law: MaybeUninit::new(law),
        }
    }

    /// The law, if it carries the mark.
    pub(crate) fn law_mut(&mut self, mark: u64) -> Option<&mut T> {
        // SAFETY: the mark is written together with the law, by `new` only.
        (self.mark == mark).then(|| unsafe { self.law.assume_init_mut() })
    }
}
