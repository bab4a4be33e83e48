//! Laws as messages list them: texts that are put together from the table when this is compiled.

use crate::Law;

/// A text that grows while the crate is compiled. Too long a one does not compile.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    bytes: [u8; 160],
    length: usize,
}

/// One flag a law, in the order of [`Law::ALL`]: for which `condition` on its [`Row`](crate::law::Row) holds.
#[macro_export]
#[doc(hidden)]
macro_rules! laws_where {
    ($row:pat_param if $condition:expr) => {{
        let mut holds = [false; $crate::Law::ALL.len()];
        let mut i = 0;
        while i < holds.len() {
            let $row = $crate::Law::ALL[i].row();
            holds[i] = $condition;
            i += 1;
        }
        holds
    }};
}
pub use laws_where as laws;

impl Text {
    /// The text `of`.
    pub const fn new(of: &str) -> Self {
        let empty = Self {
            bytes: [0; 160],
            length: 0,
        };
        empty.and(of)
    }

    /// This text and then `more`.
    #[must_use]
    pub const fn and(mut self, more: &str) -> Self {
        let more = more.as_bytes();
        let mut i = 0;
        while i < more.len() {
            self.bytes[self.length] = more[i];
            self.length += 1;
            i += 1;
        }
        self
    }

    /// `1 (standard), 2 (passive), …`: the laws with a flag.
    pub const fn numbered(laws: &[bool; Law::ALL.len()]) -> Self {
        let mut text = Self::new("");
        let mut i = 0;
        while i < laws.len() {
            if laws[i] {
                if text.length > 0 {
                    text = text.and(", ");
                }
                text = text
                    .and(digit(Law::ALL[i].number()))
                    .and(" (")
                    .and(Law::ALL[i].name())
                    .and(")");
            }
            i += 1;
        }
        text
    }

    /// This text and then `passive_applied and passive_bounded`: the names of the laws with a flag.
    #[must_use]
    pub const fn and_names(mut self, laws: &[bool; Law::ALL.len()]) -> Self {
        let (mut i, mut first) = (0, true);
        while i < laws.len() {
            if laws[i] {
                if !first {
                    self = self.and(" and ");
                }
                self = self.and(Law::ALL[i].name());
                first = false;
            }
            i += 1;
        }
        self
    }

    /// The text.
    pub const fn as_str(&self) -> &str {
        match core::str::from_utf8(self.bytes.split_at(self.length).0) {
            Ok(text) => text,
            Err(_) => panic!("texts are whole"),
        }
    }
}

/// A law's number as it is written.
const fn digit(number: i32) -> &'static str {
    const DIGITS: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
    DIGITS[number as usize]
}
