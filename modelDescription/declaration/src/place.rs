//! Where a row's values lie in the struct that holds them.

use crate::integer::IntegerType;
use core::marker::PhantomData;

/// The place of a row's values in the struct `M`: an offset, and a stride where there are several. The interface sees
/// values of type `V`; what is stored may be another one (see [`Leaf`]).
///
/// A place is made by the macros and the derive of this crate alone, from the path of a field that the compiler has found to
/// be of the right type. All reading and writing by offset is in this file.
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

/// In what type a value is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// In that of the interface.
    AsIs,
    /// A Real in single precision.
    Single,
    /// A Boolean as a 32-bit integer, 0 or 1: what C hands over may be any bits.
    Word,
    /// An integer of another type than `i32`.
    Integer(IntegerType),
}

mod sealed {
    pub trait Sealed {}
}

/// A type of the interface: `f64`, `i32`, `bool`, `i128` for integers beyond 32 bits, and, with the feature `std`, `String`
/// and `Vec<u8>`.
pub trait Value: sealed::Sealed + Clone + 'static {
    /// Reads the value at `place`.
    ///
    /// # Safety
    /// `place` points to a valid value of the stored type.
    #[doc(hidden)]
    unsafe fn read(place: *const u8, stored: Stored) -> Self;

    /// Writes the value to `place`. One that the stored type does not hold loses its leading bits, so it is held against
    /// its row before.
    ///
    /// # Safety
    /// `place` points to a valid value of the stored type, which may be written.
    #[doc(hidden)]
    unsafe fn write(self, place: *mut u8, stored: Stored);
}

impl sealed::Sealed for f64 {}
impl Value for f64 {
    #[inline]
    unsafe fn read(place: *const u8, stored: Stored) -> Self {
        // SAFETY: the caller's contract.
        unsafe {
            match stored {
                Stored::Single => f64::from(*place.cast::<f32>()),
                _ => *place.cast(),
            }
        }
    }

    #[inline]
    unsafe fn write(self, place: *mut u8, stored: Stored) {
        // SAFETY: the caller's contract.
        unsafe {
            match stored {
                Stored::Single => *place.cast() = self as f32,
                _ => *place.cast() = self,
            }
        }
    }
}

impl sealed::Sealed for i32 {}
impl Value for i32 {
    #[inline]
    unsafe fn read(place: *const u8, stored: Stored) -> Self {
        // SAFETY: the caller's contract.
        unsafe {
            match stored {
                Stored::Integer(of) => read_small(place, of),
                _ => *place.cast(),
            }
        }
    }

    #[inline]
    unsafe fn write(self, place: *mut u8, stored: Stored) {
        // SAFETY: the caller's contract.
        unsafe {
            match stored {
                Stored::Integer(of) => write_small(self, place, of),
                _ => *place.cast() = self,
            }
        }
    }
}

/// Apart, so that an `i32` costs nothing for the types that are smaller.
///
/// # Safety
/// As for [`Value::read`]. Larger types have `i128` as their value.
#[inline(never)]
unsafe fn read_small(place: *const u8, of: IntegerType) -> i32 {
    // SAFETY: this function's contract.
    unsafe {
        match of {
            IntegerType::Int8 => i32::from(*place.cast::<i8>()),
            IntegerType::UInt8 => i32::from(*place),
            IntegerType::Int16 => i32::from(*place.cast::<i16>()),
            IntegerType::UInt16 => i32::from(*place.cast::<u16>()),
            _ => *place.cast(),
        }
    }
}

/// # Safety
/// As for [`Value::write`], and as for [`read_small`].
#[inline(never)]
unsafe fn write_small(value: i32, place: *mut u8, of: IntegerType) {
    // SAFETY: this function's contract.
    unsafe {
        match of {
            IntegerType::Int8 => *place.cast() = value as i8,
            IntegerType::UInt8 => *place = value as u8,
            IntegerType::Int16 => *place.cast() = value as i16,
            IntegerType::UInt16 => *place.cast() = value as u16,
            _ => *place.cast() = value,
        }
    }
}

impl sealed::Sealed for i128 {}
impl Value for i128 {
    unsafe fn read(place: *const u8, stored: Stored) -> Self {
        // SAFETY: the caller's contract. No field of a row is an `i128` itself; an `i32` is one by `Place::widened`.
        unsafe {
            match stored {
                Stored::Integer(IntegerType::UInt32) => Self::from(*place.cast::<u32>()),
                Stored::Integer(IntegerType::Int64) => Self::from(*place.cast::<i64>()),
                Stored::Integer(IntegerType::UInt64) => Self::from(*place.cast::<u64>()),
                small => Self::from(i32::read(place, small)),
            }
        }
    }

    unsafe fn write(self, place: *mut u8, stored: Stored) {
        // SAFETY: the caller's contract, and as in `read`.
        unsafe {
            match stored {
                Stored::Integer(IntegerType::UInt32) => *place.cast() = self as u32,
                Stored::Integer(IntegerType::Int64) => *place.cast() = self as i64,
                Stored::Integer(IntegerType::UInt64) => *place.cast() = self as u64,
                small => (self as i32).write(place, small),
            }
        }
    }
}

impl sealed::Sealed for bool {}
impl Value for bool {
    unsafe fn read(place: *const u8, stored: Stored) -> Self {
        // SAFETY: the caller's contract.
        unsafe {
            match stored {
                Stored::Word => *place.cast::<i32>() != 0,
                _ => *place.cast(),
            }
        }
    }

    unsafe fn write(self, place: *mut u8, stored: Stored) {
        // SAFETY: the caller's contract.
        unsafe {
            match stored {
                Stored::Word => *place.cast() = i32::from(self),
                _ => *place.cast() = self,
            }
        }
    }
}

macro_rules! owned {
    ($value:ty) => {
        #[cfg(feature = "std")]
        impl sealed::Sealed for $value {}
        #[cfg(feature = "std")]
        impl Value for $value {
            unsafe fn read(place: *const u8, _: Stored) -> Self {
                // SAFETY: the caller's contract.
                unsafe { (*place.cast::<Self>()).clone() }
            }

            unsafe fn write(self, place: *mut u8, _: Stored) {
                // SAFETY: the caller's contract.
                unsafe { *place.cast::<Self>() = self }
            }
        }
    };
}

owned! { String }
owned! { Vec<u8> }

/// The type of a field that a row can show: a value, or an array of values.
#[diagnostic::on_unimplemented(
    message = "a row cannot show a field of type `{Self}`",
    label = "expected f64, f32, an integer of 8 to 64 bits, bool, String, Vec<u8> or an array of one of them",
    note = "a field without `#[input]`, `#[output]`, `#[parameter]`, `#[calculated]` or `#[local]` is a state and may have any type; a struct of rows is a `#[part]`"
)]
pub trait Leaf {
    /// Its type in the interface.
    type Value: Value;
    /// How many there are.
    const LEN: usize;
    /// From one to the next, bytes.
    const STRIDE: usize;
    /// In what type they are stored.
    const STORED: Stored;
}

macro_rules! leaf {
    ($($field:ty => $value:ty, $stored:expr;)+) => {$(
        impl Leaf for $field {
            type Value = $value;
            const LEN: usize = 1;
            const STRIDE: usize = size_of::<Self>();
            const STORED: Stored = $stored;
        }
    )+};
}

leaf! {
    f64 => f64, Stored::AsIs;
    f32 => f64, Stored::Single;
    i8 => i32, Stored::Integer(IntegerType::Int8);
    u8 => i32, Stored::Integer(IntegerType::UInt8);
    i16 => i32, Stored::Integer(IntegerType::Int16);
    u16 => i32, Stored::Integer(IntegerType::UInt16);
    i32 => i32, Stored::AsIs;
    u32 => i128, Stored::Integer(IntegerType::UInt32);
    i64 => i128, Stored::Integer(IntegerType::Int64);
    u64 => i128, Stored::Integer(IntegerType::UInt64);
    bool => bool, Stored::AsIs;
}

#[cfg(feature = "std")]
leaf! {
    String => String, Stored::AsIs;
    Vec<u8> => Vec<u8>, Stored::AsIs;
}

impl<L: Leaf, const N: usize> Leaf for [L; N] {
    type Value = L::Value;
    const LEN: usize = N * L::LEN;
    const STRIDE: usize = L::STRIDE;
    const STORED: Stored = L::STORED;
}

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

    /// Whether all values are finite.
    #[inline]
    pub fn are_finite(&self, model: &M) -> bool {
        // Without a branch for each value: this runs over all outputs at every step.
        match self.slice(model) {
            Some(values) => are_finite(values),
            None => self
                .values(model)
                .fold(true, |all, value| all & value.is_finite()),
        }
    }

    /// All values, where they lie side by side as they are.
    #[inline]
    fn slice<'a>(&self, model: &'a M) -> Option<&'a [f64]> {
        let adjoin = self.stride as usize == size_of::<f64>() && self.stored == Stored::AsIs;
        let begin = core::ptr::from_ref(model).cast::<u8>();
        // SAFETY: as in `get`: `len` values of type f64, 8 bytes apart, in `model`, which is borrowed as a whole.
        adjoin.then(|| unsafe {
            core::slice::from_raw_parts(begin.add(self.offset as usize).cast(), self.len())
        })
    }

    /// This place and `next` as one, if `next` begins where this one ends and both are stored alike.
    pub fn followed_by(&self, next: &Self) -> Option<Self> {
        let adjoins = next.offset == self.offset + self.len * self.stride;
        let alike = next.stride == self.stride && next.stored == self.stored;
        (adjoins && alike).then_some(Self {
            len: self.len + next.len,
            ..*self
        })
    }
}

/// Whether all `values` are finite: an exponent of ones, and 1 added to it, reaches the sign, which was taken off. In integers,
/// several at once.
#[inline]
fn are_finite(values: &[f64]) -> bool {
    const SIGN: u64 = 1 << 63;
    const EXPONENT_1: u64 = 1 << (f64::MANTISSA_DIGITS - 1);
    let seen = values.iter().fold(0, |seen, value| {
        seen | ((value.to_bits() & !SIGN) + EXPONENT_1)
    });
    seen & SIGN == 0
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

#[cfg(test)]
mod tests {
    use super::are_finite;

    #[test]
    fn one_number_that_is_not_finite_is_found_among_many() {
        let finite = [
            0.0,
            -0.0,
            f64::MAX,
            f64::MIN,
            f64::MIN_POSITIVE,
            -5e-324,
            1.0,
            -3.5,
            1e308,
        ];
        assert!(are_finite(&finite) && are_finite(&[]));
        for wrong in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for i in 0..finite.len() {
                let mut values = finite;
                values[i] = wrong;
                assert!(!are_finite(&values), "{wrong} at {i}");
            }
        }
    }
}
