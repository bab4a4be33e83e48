//! Values as they are stored, and as the interface sees them.

use crate::integer::IntegerType;

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
