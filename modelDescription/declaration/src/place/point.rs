//! One value of a row.

use super::{Place, Stored, Value};
use core::marker::PhantomData;

/// The place of one value in the struct `M`: one element of a [`Place`].
pub struct Point<M, V> {
    offset: u32,
    stored: Stored,
    holder: PhantomData<fn(&M) -> V>,
}

impl<M, V> Clone for Point<M, V> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M, V> Copy for Point<M, V> {}

impl<M, V> Place<M, V> {
    /// Element `i`, from 0. The last one where there are fewer.
    pub const fn point(&self, i: usize) -> Point<M, V> {
        Point {
            offset: self.offset_of(i) as u32, // within `M`, which is smaller than 4 GB
            stored: self.stored,
            holder: PhantomData,
        }
    }
}

impl<M, V: Value> Point<M, V> {
    /// The value.
    #[inline]
    pub fn get(&self, model: &M) -> V {
        let begin = core::ptr::from_ref(model).cast::<u8>();
        // SAFETY: as for `Place::get`, of whose elements this is one.
        unsafe { V::read(begin.add(self.offset as usize), self.stored) }
    }

    /// Gives it another value.
    #[inline]
    pub fn set(&self, model: &mut M, value: V) {
        let begin = core::ptr::from_mut(model).cast::<u8>();
        // SAFETY: as for `Place::set`, of whose elements this is one.
        unsafe { value.write(begin.add(self.offset as usize), self.stored) }
    }
}
