//! What is delivered: an FMU, or the C library.

use crate::Interface;

/// What licences and a bill of materials say of the whole.
#[derive(Clone, Copy, Debug)]
pub struct Product<'a> {
    /// Its name.
    pub name: &'a str,
    /// What it is.
    pub about: &'a str,
    /// The guid of an FMU.
    pub guid: Option<&'a str>,
}

impl<'a> From<&'a Interface> for Product<'a> {
    fn from(interface: &'a Interface) -> Self {
        Self {
            name: interface.name,
            about: interface.about,
            guid: Some(&interface.guid),
        }
    }
}
