//! What identifies an interface.

use crate::{Access, Declare, Description, IntegerType, Unit, provenance};
use core::fmt::Write as _;

impl<M: Declare> Description<M> {
    /// The guid: a hash (UUID version 5) over everything an importer can rely on: names, value references, types,
    /// units, bounds, start values, causality, variability, and their order, by which some number the ports of a block.
    /// Descriptions are left out.
    pub fn guid(&self) -> String {
        let start = M::default();
        let mut text = format!("{} {:?} {:?}\n", self.name, self.stepping, self.experiment);
        for scalar in self.in_order() {
            let (v, i) = (scalar.variable, scalar.element);
            let kind = match &v.access {
                Access::Real { unit, range, at } => {
                    let (min, max) = (range.low, range.high);
                    let single = if at.is_single() { " single" } else { "" };
                    let unit = of_unit(unit);
                    format!("{unit} {min} {max} {:?}{single}", at.get(&start, i))
                }
                Access::Integer { min, max, at } => {
                    let of = match at.integer_type() {
                        IntegerType::Int32 => "Integer", // as it was before there were others
                        of => of.name(),
                    };
                    format!("{of} {min} {max} {}", at.get(&start, i))
                }
                Access::Wide { min, max, at } => {
                    let of = at.integer_type().name();
                    let (min, max) = (min.get(), max.get());
                    format!("{of} {min} {max} {}", at.get(&start, i))
                }
                Access::Boolean { at } => format!("Boolean {}", at.get(&start, i)),
                Access::String { at } => format!("String {:?}", at.get(&start, i)),
                Access::Binary {
                    mime_type,
                    max_size,
                    at,
                } => format!("Binary {mime_type} {max_size:?} {:?}", at.get(&start, i)),
                Access::Enumeration { of, declared, at } => {
                    let items: Vec<_> = of
                        .items
                        .iter()
                        .map(|item| (item.value, item.name))
                        .collect();
                    format!("{declared:?} {} {items:?} {}", of.name, at.get(&start, i))
                }
            };
            let nan = if v.may_be_nan { " or NaN" } else { "" };
            let _ = writeln!(
                text,
                "{} {} {:?} {:?} {:?} {kind}{nan}",
                scalar.reference(),
                scalar.name(),
                v.causality,
                v.variability,
                v.initially_from
            );
        }
        for one in provenance::ALL {
            let _ = writeln!(
                text,
                "{} {} fixed local String",
                one.reference(),
                one.name()
            );
        }
        uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_OID, text.as_bytes())
            .braced()
            .to_string()
    }
}

/// A unit as text. What came after the first guids stands in it only where it says something, so that they stay.
fn of_unit(unit: &Unit) -> String {
    let base = unit.base.exponents();
    let early = |name: &str| ["kg", "m", "s", "rad"].contains(&name);
    let first = base.iter().filter(|(name, _)| early(name));
    let first: Vec<_> = first.map(|(name, n)| format!("{name}: {n}")).collect();
    let display = unit.display.map_or("None".to_owned(), |display| {
        format!(
            "Some(Display {{ name: {:?}, factor: {:?} }})",
            display.name, display.factor
        )
    });
    let mut text = format!(
        "Unit {{ name: {:?}, base: Base {{ {} }}, display: {display} }}",
        unit.name,
        first.join(", ")
    );
    for (name, n) in base {
        if !early(name) && n != 0 {
            let _ = write!(text, " {name}: {n}");
        }
    }
    if let Some(display) = unit.display.filter(|display| display.offset != 0.0) {
        let _ = write!(text, " offset: {:?}", display.offset);
    }
    text
}
