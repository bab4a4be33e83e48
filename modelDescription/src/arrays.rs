//! The variables of FMI 3.0: a row is one variable, and a vector an array.

use crate::Interface;
use crate::entry::Entry;

/// Name of the independent variable, which no row may have.
pub const TIME: &str = "time";
/// Its value reference.
pub const TIME_REFERENCE: u32 = u32::MAX;
/// Name of the clock of a sampled model, which no row of one may have.
pub const CLOCK: &str = "clock";
/// Its value reference.
pub const CLOCK_REFERENCE: u32 = u32::MAX - 1;

/// A row with all of its elements.
#[derive(Clone, Debug)]
pub struct Array<'a> {
    /// Name of the row without the `[i]` that stands for the element: `segment[i].t` is `segment.t`.
    pub name: String,
    /// Value reference: that of the first element in FMI 2.0.
    pub reference: u32,
    /// The elements in order; one for a scalar.
    pub elements: &'a [Entry],
}

impl Array<'_> {
    /// The element that stands for all in what they have in common: causality, variability, type, unit, bounds, description.
    pub fn first(&self) -> &Entry {
        &self.elements[0]
    }

    /// Whether it is an array.
    pub fn is_vector(&self) -> bool {
        self.first().row.contains("[i]")
    }
}

/// The name that a row has in FMI 3.0.
pub fn name(row: &str) -> String {
    row.replacen("[i]", "", 1)
}

/// All rows in the order of the XML.
pub fn of(interface: &Interface) -> Vec<Array<'_>> {
    interface
        .scalars
        .chunk_by(|one, next| one.row == next.row)
        .map(|elements| Array {
            name: name(&elements[0].row),
            reference: elements[0].reference,
            elements,
        })
        .collect()
}
