//! What is delivered: an FMU, or the C library.

use crate::{Interface, Package};

/// What licences and a bill of materials say of the whole.
#[derive(Clone, Copy, Debug)]
pub struct Product<'a> {
    /// Its name.
    pub name: &'a str,
    /// What it is.
    pub about: &'a str,
    /// The guid of an FMU.
    pub guid: Option<&'a str>,
    /// Whose it is.
    pub package: Package<'a>,
}

impl<'a> Product<'a> {
    /// An FMU.
    pub fn of(interface: &'a Interface, package: Package<'a>) -> Self {
        Self {
            name: interface.name,
            about: interface.about,
            guid: Some(&interface.guid),
            package,
        }
    }
}
