//! Where a row's values lie in the struct that holds them.

#[cfg(feature = "std")]
mod finite;
mod leaf;
mod point;
mod value;

#[cfg(feature = "std")]
pub use finite::Finite;
pub use leaf::Leaf;
pub use point::Point;
pub use value::{Stored, Value};

use crate::integer::IntegerType;
use core::marker::PhantomData;

/// The place of a row's values in the struct `M`: an offset, and a stride where there are several. The interface sees
/// values of type `V`; what is stored may be another one (see [`Leaf`]).
///
/// A place is made by the macros and the derive of this crate alone, from the path of a field that the compiler has found to
/// be of the right type. All reading and writing by offset is in this module.
pub struct Place<M, V> {
    // 32 bits each: a Get of all outputs walks over many of them.
    offset: u32,
    stride: u32,
    len: u32,
    stored: Stored,
    holder: PhantomData<fn(&M) -> V>,
}

impl<M, V> Clone for Place<M, V> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M, V> Copy for Place<M, V> {}

/// A size in a struct that is itself smaller than 4 GB.
const fn narrow(size: usize) -> u32 {
    assert!(size <= u32::MAX as usize, "a struct is smaller than 4 GB");
    size as u32
}

/// The place of the field that `field` borrows, `offset` bytes from the begin of `M`. For the macros and the derive, which
/// make both from one path.
#[doc(hidden)]
pub const fn of_field<M, L: Leaf>(offset: usize, field: fn(&M) -> &L) -> Place<M, L::Value> {
    let _ = field;
    assert!(L::LEN > 0, "a row has a value");
    Place {
        offset: narrow(offset),
        stride: narrow(L::STRIDE),
        len: narrow(L::LEN),
        stored: L::STORED,
        holder: PhantomData,
    }
}

/// The same for a Boolean, or an array of them, that is stored as `i32`.
#[doc(hidden)]
pub const fn of_word<M, L: Leaf<Value = i32>>(
    offset: usize,
    field: fn(&M) -> &L,
) -> Place<M, bool> {
    let _ = field;
    assert!(L::LEN > 0, "a row has a value");
    assert!(matches!(L::STORED, Stored::AsIs), "boolean is for an i32");
    Place {
        offset: narrow(offset),
        stride: narrow(L::STRIDE),
        len: narrow(L::LEN),
        stored: Stored::Word,
        holder: PhantomData,
    }
}

impl<S, V> Place<S, V> {
    /// The place in `M`, of which the struct `S` is a part that `part` borrows, at `offset`.
    pub(crate) const fn within<M>(self, offset: usize) -> Place<M, V> {
        Place {
            offset: narrow(offset + self.offset as usize),
            stride: self.stride,
            len: self.len,
            stored: self.stored,
            holder: PhantomData,
        }
    }

    /// The places of this one value in each of `n` structs `S` that lie in an array.
    pub(crate) const fn each(self, n: usize) -> Self {
        assert!(
            self.len == 1,
            "each element of an array shows single values"
        );
        Self {
            stride: narrow(size_of::<S>()),
            len: narrow(n),
            ..self
        }
    }
}

impl<M, V> Place<M, V> {
    /// No place, see [`Variable::NOTHING`](crate::Variable::NOTHING).
    pub(crate) const NOTHING: Self = Self {
        offset: 0,
        stride: 0,
        len: 0,
        stored: Stored::AsIs,
        holder: PhantomData,
    };

    /// How many values there are.
    pub const fn len(&self) -> usize {
        self.len as usize
    }

    /// Never: a row has a value.
    pub const fn is_empty(&self) -> bool {
        false
    }

    /// Distance of element `i` from the begin of `M`, bytes; in range for every `i`.
    const fn offset_of(&self, i: usize) -> usize {
        let last = self.len as usize - 1;
        self.offset as usize + self.stride as usize * if i < last { i } else { last }
    }

    /// Bytes from the begin of `M` to the first value, from one value to the next, and in what type they are stored: for
    /// programs in C.
    pub const fn layout(&self) -> (usize, usize, Stored) {
        (self.offset as usize, self.stride as usize, self.stored)
    }
}

impl<M, V: Value> Place<M, V> {
    /// The value of element `i`, from 0. The last one where there are fewer.
    #[inline]
    pub fn get(&self, model: &M, i: usize) -> V {
        let begin = core::ptr::from_ref(model).cast::<u8>();
        // SAFETY: `of_field` got the offset of a field of `M` of type `L`, whose elements are `L::STRIDE` apart and of the
        // stored type; `within` and `each` keep that true. `model` is borrowed as a whole.
        unsafe { V::read(begin.add(self.offset_of(i)), self.stored) }
    }

    /// The value of element `i`, from 0; none where there are fewer.
    #[inline]
    pub fn find(&self, model: &M, i: u32) -> Option<V> {
        let begin = core::ptr::from_ref(model).cast::<u8>();
        let at = self.offset as usize + self.stride as usize * i as usize;
        // SAFETY: as in `get`: there is an element `i`.
        (i < self.len).then(|| unsafe { V::read(begin.add(at), self.stored) })
    }

    /// Gives element `i`, from 0, another value. The last one where there are fewer.
    #[inline]
    pub fn set(&self, model: &mut M, i: usize, value: V) {
        let begin = core::ptr::from_mut(model).cast::<u8>();
        // SAFETY: as in `get`; `model` is borrowed for writing.
        unsafe { value.write(begin.add(self.offset_of(i)), self.stored) }
    }

    /// All values, in order.
    pub fn values<'a>(&'a self, model: &'a M) -> impl Iterator<Item = V> + use<'a, M, V> {
        (0..self.len()).map(move |i| self.get(model, i))
    }
}

impl<M> Place<M, i32> {
    /// In which type the values are stored.
    pub const fn integer_type(&self) -> IntegerType {
        IntegerType::of(self.stored)
    }

    /// The same values in the type that holds all integers.
    pub const fn widened(self) -> Place<M, i128> {
        Place {
            offset: self.offset,
            stride: self.stride,
            len: self.len,
            stored: self.stored,
            holder: PhantomData,
        }
    }
}

impl<M> Place<M, i128> {
    /// In which type the values are stored.
    pub const fn integer_type(&self) -> IntegerType {
        IntegerType::of(self.stored)
    }
}

impl<M> Place<M, f64> {
    /// Whether the values are stored in single precision.
    pub const fn is_single(&self) -> bool {
        matches!(self.stored, Stored::Single)
    }
}

impl<M> Place<M, bool> {
    /// What is stored, as a number: 0 and 1 are Booleans, another number is none.
    pub fn word(&self, model: &M, i: usize) -> i32 {
        match self.stored {
            Stored::Word => Place::<M, i32> {
                offset: self.offset,
                stride: self.stride,
                len: self.len,
                stored: Stored::AsIs,
                holder: PhantomData,
            }
            .get(model, i),
            _ => i32::from(self.get(model, i)),
        }
    }
}
