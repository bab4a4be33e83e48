//! The shape of a state: names and types of its fields, in their order, as one number. Two states whose bytes are alike differ in it
//! when their fields have changed places.

use serde::ser::{
    self, Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant,
    SerializeTuple, SerializeTupleStruct, SerializeTupleVariant,
};
use std::fmt;

/// CRC-32 of the shape of `value`. Values do not matter, lengths of lists do not either: only the first element counts.
pub(crate) fn of(value: &impl Serialize) -> u32 {
    let mut shape = Shape(crc32fast::Hasher::new());
    match value.serialize(&mut shape) {
        Ok(()) => shape.0.finalize(),
        // Some type refuses to be serialized; the bytes say so in words.
        Err(Refused) => 0,
    }
}

struct Shape(crc32fast::Hasher);

impl Shape {
    fn mark(&mut self, word: &str) -> Result<(), Refused> {
        self.0.update(word.as_bytes());
        self.0.update(b"\0");
        Ok(())
    }
}

/// A type that says that it cannot be serialized.
#[derive(Debug)]
struct Refused;

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not serializable")
    }
}

impl std::error::Error for Refused {}

impl ser::Error for Refused {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

/// Of a list, whose first element stands for all.
struct Elements<'a> {
    shape: &'a mut Shape,
    seen: bool,
}

macro_rules! plain {
    ($($method:ident($of:ty);)*) => {$(
        fn $method(self, _: $of) -> Result<(), Refused> {
            self.mark(stringify!($of))
        }
    )*};
}

impl<'a> ser::Serializer for &'a mut Shape {
    type Ok = ();
    type Error = Refused;
    type SerializeSeq = Elements<'a>;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Elements<'a>;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    plain! {
        serialize_bool(bool);
        serialize_i8(i8);
        serialize_i16(i16);
        serialize_i32(i32);
        serialize_i64(i64);
        serialize_i128(i128);
        serialize_u8(u8);
        serialize_u16(u16);
        serialize_u32(u32);
        serialize_u64(u64);
        serialize_u128(u128);
        serialize_f32(f32);
        serialize_f64(f64);
        serialize_char(char);
        serialize_str(&str);
        serialize_bytes(&[u8]);
    }

    fn serialize_none(self) -> Result<(), Refused> {
        self.mark("Option")
    }

    // As none: whether there is one is a value.
    fn serialize_some<T: Serialize + ?Sized>(self, _: &T) -> Result<(), Refused> {
        self.mark("Option")
    }

    fn serialize_unit(self) -> Result<(), Refused> {
        self.mark("()")
    }

    fn serialize_unit_struct(self, name: &'static str) -> Result<(), Refused> {
        self.mark(name)
    }

    fn serialize_unit_variant(
        self,
        name: &'static str,
        _: u32,
        _: &'static str,
    ) -> Result<(), Refused> {
        self.mark(name)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        value: &T,
    ) -> Result<(), Refused> {
        self.mark(name)?;
        value.serialize(self)
    }

    // Which variant it is is a value.
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Result<(), Refused> {
        self.mark(name)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Elements<'a>, Refused> {
        self.mark("list")?;
        Ok(Elements {
            shape: self,
            seen: false,
        })
    }

    fn serialize_tuple(self, len: usize) -> Result<Self, Refused> {
        self.0.update(&(len as u64).to_le_bytes());
        Ok(self)
    }

    fn serialize_tuple_struct(self, name: &'static str, _: usize) -> Result<Self, Refused> {
        self.mark(name)?;
        Ok(self)
    }

    fn serialize_tuple_variant(
        self,
        name: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Refused> {
        self.mark(name)?;
        Ok(self)
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Elements<'a>, Refused> {
        self.mark("map")?;
        Ok(Elements {
            shape: self,
            seen: false,
        })
    }

    fn serialize_struct(self, name: &'static str, _: usize) -> Result<Self, Refused> {
        self.mark(name)?;
        Ok(self)
    }

    fn serialize_struct_variant(
        self,
        name: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Refused> {
        self.mark(name)?;
        Ok(self)
    }

    fn is_human_readable(&self) -> bool {
        false
    }
}

impl SerializeSeq for Elements<'_> {
    type Ok = ();
    type Error = Refused;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Refused> {
        if std::mem::replace(&mut self.seen, true) {
            return Ok(());
        }
        value.serialize(&mut *self.shape)
    }

    fn end(self) -> Result<(), Refused> {
        Ok(())
    }
}

impl SerializeMap for Elements<'_> {
    type Ok = ();
    type Error = Refused;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Refused> {
        if self.seen {
            return Ok(());
        }
        key.serialize(&mut *self.shape)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Refused> {
        SerializeSeq::serialize_element(self, value)
    }

    fn end(self) -> Result<(), Refused> {
        Ok(())
    }
}

/// Fields without names, and with them.
macro_rules! fields {
    ($($of:ident: $method:ident;)*) => {$(
        impl $of for &mut Shape {
            type Ok = ();
            type Error = Refused;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Refused> {
                value.serialize(&mut **self)
            }

            fn end(self) -> Result<(), Refused> {
                Ok(())
            }
        }
    )*};
    (named $($of:ident)*) => {$(
        impl $of for &mut Shape {
            type Ok = ();
            type Error = Refused;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Result<(), Refused> {
                self.mark(name)?;
                value.serialize(&mut **self)
            }

            fn end(self) -> Result<(), Refused> {
                self.mark("end")
            }
        }
    )*};
}

fields! {
    SerializeTuple: serialize_element;
    SerializeTupleStruct: serialize_field;
    SerializeTupleVariant: serialize_field;
}
fields! { named SerializeStruct SerializeStructVariant }

#[cfg(test)]
mod tests {
    use super::*;

    macro_rules! state {
        ($($field:ident: $of:ty = $value:expr),*) => {{
            #[derive(serde::Serialize)]
            struct State { $($field: $of),* }
            of(&State { $($field: $value),* })
        }};
    }

    #[test]
    fn fields_that_changed_places_names_or_types_are_another_shape_and_values_are_not() {
        let shape = state!(a: f64 = 0.0, b: f64 = 0.0, list: Vec<u8> = vec![1]);
        for same in [
            state!(a: f64 = 1.0, b: f64 = -2.0, list: Vec<u8> = vec![1]),
            state!(a: f64 = 0.0, b: f64 = 0.0, list: Vec<u8> = vec![3, 4, 5]),
        ] {
            assert_eq!(same, shape);
        }
        let others = [
            state!(b: f64 = 0.0, a: f64 = 0.0, list: Vec<u8> = vec![1]),
            state!(a: f64 = 0.0, c: f64 = 0.0, list: Vec<u8> = vec![1]),
            state!(a: f64 = 0.0, b: u64 = 0, list: Vec<u8> = vec![1]),
            state!(a: f64 = 0.0, b: f64 = 0.0, list: Vec<i8> = vec![1]),
            state!(a: f64 = 0.0, b: f64 = 0.0, list: [u8; 1] = [1]),
            state!(a: f64 = 0.0, b: (f64, f64) = (0.0, 0.0)),
            state!(a: (f64, f64) = (0.0, 0.0), b: f64 = 0.0),
            state!(a: Option<f64> = None, b: f64 = 0.0),
        ];
        for (i, other) in others.iter().enumerate() {
            assert_ne!(*other, shape, "{i}");
            assert!(!others[..i].contains(other), "{i}");
        }
        assert_eq!(
            state!(a: Option<f64> = None),
            state!(a: Option<f64> = Some(1.0))
        );
    }
}
