//! Where lists of value references lead. A loop over FMUs asks for the same list at every step; it is looked up once, and
//! then compared only.
//!
//! A list that leads nowhere, or to a value that is refused, goes the long way by slots and rows, which say why.

use crate::access::find;
use crate::failure::Outcome;
use crate::instance::Instance;
use crate::kind::Kind;
use crate::legality::Phase;
use crate::model::Model;
use crate::slots::interval;
use crate::value::{NoValue, Value as _};
use fmu_declaration::place::Point;
use fmu_declaration::{Access, Variable};

/// Lists of each type and direction that are known at a time: an importer has one for each connection, or one for all.
const LISTS: usize = 4;

/// Values from which on a list is worth it: fewer are found as fast one by one.
const LEAST: usize = 3;

/// Unknown lists that are let pass, after one that leads nowhere, and before known ones make room for others.
const PATIENCE: u32 = 64;

/// All that are known.
pub struct Routes<M> {
    /// Of fmi2Real, fmi3Float64.
    pub reals: Both<M, f64>,
    /// Of fmi2Integer.
    pub wholes: Both<M, i32>,
    /// Of fmi2Boolean, fmi3Boolean.
    pub flags: Both<M, bool>,
}

/// Those of one type.
pub struct Both<M, V> {
    gets: Known<Point<M, V>>,
    sets: Known<Settable<M, V>>,
}

/// An input, and what it may be set to (a number of its type).
pub struct Settable<M, V> {
    at: Point<M, V>,
    low: f64,
    high: f64,
}

/// The lists that are known, with what they lead to. They lie in a room that is made before the first step: nothing is
/// allocated while it runs.
struct Known<P> {
    references: Vec<u32>,
    points: Vec<P>,
    lists: [List; LISTS],
    count: usize,
    /// unknown ones to be let pass
    patience: u32,
    /// whether that was for want of room
    has_waited: bool,
}

/// Where the references and the points of a list lie.
#[derive(Clone, Copy, Default)]
struct List {
    references: (usize, usize),
    points: (usize, usize),
}

impl<P> Default for Known<P> {
    fn default() -> Self {
        Self {
            references: Vec::new(),
            points: Vec::new(),
            lists: [List::default(); LISTS],
            count: 0,
            patience: 0,
            has_waited: false,
        }
    }
}

impl<M, V> Default for Both<M, V> {
    fn default() -> Self {
        Self {
            gets: Known::default(),
            sets: Known::default(),
        }
    }
}

impl<M> Default for Routes<M> {
    fn default() -> Self {
        Self {
            reals: Both::default(),
            wholes: Both::default(),
            flags: Both::default(),
        }
    }
}

impl<M: Model> Routes<M> {
    /// Makes room for each list with all there is, and for others as long.
    pub(crate) fn make_room(&mut self) {
        let (mut reals, mut wholes, mut flags) = ([0; 2], [0; 2], [0; 2]);
        for row in M::DESCRIPTION.variables {
            let [gets, sets] = match row.access {
                Access::Real { .. } => &mut reals,
                Access::Integer { .. } | Access::Enumeration { .. } => &mut wholes,
                Access::Boolean { .. } => &mut flags,
                Access::String { .. } | Access::Wide { .. } | Access::Binary { .. } => continue,
            };
            *gets += row.len;
            *sets += if interval(row).is_some() { row.len } else { 0 };
        }
        self.reals.make_room(reals);
        self.wholes.make_room(wholes);
        self.flags.make_room(flags);
    }
}

impl<M, V> Both<M, V> {
    fn make_room(&mut self, [gets, sets]: [usize; 2]) {
        self.gets.make_room(gets);
        self.sets.make_room(sets);
    }
}

impl<P> Known<P> {
    fn make_room(&mut self, all: usize) {
        if self.points.capacity() == 0 && all >= LEAST {
            self.references.reserve_exact(2 * all);
            self.points.reserve_exact(2 * all);
        }
    }

    /// What a list of `n` values leads to.
    #[inline]
    fn find(&self, references: &[u32], n: usize) -> Option<&[P]> {
        for list in self.lists.get(..self.count)? {
            let (first, end) = list.points;
            if end - first != n {
                continue;
            }
            let known = self.references.get(list.references.0..list.references.1);
            if known == Some(references) {
                return self.points.get(first..end);
            }
        }
        None
    }

    /// Remembers a list of `n` values, if it leads anywhere: `lead` says where, one by one.
    #[cold]
    fn learn(
        &mut self,
        references: &[u32],
        n: usize,
        lead: impl FnOnce(&mut dyn FnMut(P)) -> Option<()>,
    ) {
        if self.patience > 0 {
            self.patience -= 1;
            return;
        }
        let room = self.points.capacity();
        let is_full = self.count == LISTS
            || self.points.len() + n > room
            || self.references.len() + references.len() > self.references.capacity();
        if is_full && !self.has_waited {
            (self.has_waited, self.patience) = (true, PATIENCE);
            return;
        }
        if is_full {
            // What no longer comes makes room; what still does is soon known again.
            self.references.clear();
            self.points.clear();
            (self.count, self.has_waited) = (0, false);
        }
        let (used, before) = (self.points.len(), self.references.len());
        let fits = n <= room && references.len() <= self.references.capacity();
        let points = &mut self.points;
        let mut push = |point| {
            if points.len() < room {
                points.push(point);
            }
        };
        let is_led = fits && lead(&mut push).is_some();
        if !is_led || self.points.len() != used + n {
            self.points.truncate(used);
            self.patience = PATIENCE;
            return;
        }
        self.references.extend_from_slice(references);
        self.lists[self.count] = List {
            references: (before, self.references.len()),
            points: (used, self.points.len()),
        };
        self.count += 1;
    }
}

/// Hands on what `of` makes of each value of a list, as long as it makes something of all.
fn lead<K: Kind, M: Model, P>(
    references: &[u32],
    of: impl Fn(&'static Variable<M>, Point<M, K::Value>) -> Option<P>,
    push: &mut dyn FnMut(P),
) -> Option<()> {
    for &reference in references {
        let (row, element) = find::<K, M>(reference)?;
        let at = K::at(&row.access)?;
        let missing = K::visit(row, element, 0, |element, _| {
            match of(row, at.point(element)) {
                Some(point) => {
                    push(point);
                    None
                }
                None => Some(()),
            }
        });
        if missing.is_some() {
            return None;
        }
    }
    Some(())
}

impl<M: Model> Instance<M> {
    /// The functions that get numbers and Booleans: gives each of the `values`, in the order of the references.
    pub(crate) fn get_all<K: Kind, C>(
        &mut self,
        references: &[u32],
        values: &mut [C],
        give: impl Fn(K::Value) -> C + Copy,
    ) -> Outcome {
        if self.get_by_route::<K, C>(references, values, give) {
            return Ok(());
        }
        self.get_unknown::<K, C>(references, values, give)
    }

    /// Apart, so that the frame of a known list is small.
    #[inline(never)]
    fn get_unknown<K: Kind, C>(
        &mut self,
        references: &[u32],
        values: &mut [C],
        give: impl Fn(K::Value) -> C,
    ) -> Outcome {
        self.get::<K>(references, |i, value| values[i] = give(value))?;
        self.learn_get::<K>(references, values.len());
        Ok(())
    }

    /// The functions that set numbers and Booleans; `take` says what one of the `values` is, or why it is none.
    pub(crate) fn set_all<K: Kind, C: Copy, E: NoValue>(
        &mut self,
        references: &[u32],
        values: &[C],
        take: impl Fn(C) -> Result<K::Value, E> + Copy,
    ) -> Outcome {
        if self.set_by_route::<K, C, E>(references, values, take) {
            return Ok(());
        }
        self.set_unknown::<K, C, E>(references, values, take)
    }

    /// Apart, as for Get.
    #[inline(never)]
    fn set_unknown<K: Kind, C: Copy, E: NoValue>(
        &mut self,
        references: &[u32],
        values: &[C],
        take: impl Fn(C) -> Result<K::Value, E>,
    ) -> Outcome {
        self.set::<K, E>(references, |i| take(values[i]))?;
        self.learn_set::<K>(references, values.len());
        Ok(())
    }

    /// Whether a list is known, with so many values.
    #[inline]
    pub(crate) fn is_known<K: Kind>(&self, references: &[u32], n: usize) -> bool {
        K::routes(&self.routes).is_some_and(|Both { gets, sets }| {
            gets.find(references, n).is_some() || sets.find(references, n).is_some()
        })
    }

    /// Gives all `values` by a known list; whether there is one.
    #[inline]
    fn get_by_route<K: Kind, C>(
        &self,
        references: &[u32],
        values: &mut [C],
        give: impl Fn(K::Value) -> C,
    ) -> bool {
        // In Initialization Mode the model is computed first.
        let is_shown = self.now.phase != Phase::InitializationMode;
        let Some(both) = K::routes(&self.routes).filter(|_| is_shown) else {
            return false;
        };
        let Some(points) = both.gets.find(references, values.len()) else {
            return false;
        };
        for (value, point) in values.iter_mut().zip(points) {
            *value = give(point.get(&self.now.model));
        }
        true
    }

    /// Sets inputs by a known list, if there is one and all `values` will do; else nothing.
    #[inline]
    fn set_by_route<K: Kind, C: Copy, E>(
        &mut self,
        references: &[u32],
        values: &[C],
        take: impl Fn(C) -> Result<K::Value, E>,
    ) -> bool {
        let Some(both) = K::routes(&self.routes) else {
            return false;
        };
        let Some(points) = both.sets.find(references, values.len()) else {
            return false;
        };
        let takes = |(point, &value): (&Settable<M, K::Value>, &C)| {
            let number = take(value).ok().and_then(|value| value.number());
            number.is_some_and(|number| point.low <= number && number <= point.high)
        };
        if !points.iter().zip(values).all(takes) {
            return false;
        }
        for (point, &value) in points.iter().zip(values) {
            if let Ok(value) = take(value) {
                point.at.set(&mut self.now.model, value);
            }
        }
        self.stale |= self.now.phase == Phase::InitializationMode;
        true
    }

    /// Remembers a list of which all was got. While it runs only: what is asked for before is asked for once.
    #[inline]
    fn learn_get<K: Kind>(&mut self, references: &[u32], n: usize) {
        if n < LEAST || self.now.phase != Phase::StepComplete {
            return;
        }
        if let Some(both) = K::routes_mut(&mut self.routes) {
            both.gets.learn(references, n, |push| {
                lead::<K, M, _>(references, |_, point| Some(point), push)
            });
        }
    }

    /// Remembers a list of which all was set, if it has inputs only.
    #[inline]
    fn learn_set<K: Kind>(&mut self, references: &[u32], n: usize) {
        if n < LEAST || self.now.phase != Phase::StepComplete {
            return;
        }
        if let Some(both) = K::routes_mut(&mut self.routes) {
            let settable = |row, at| {
                let (low, high) = interval(row)?;
                Some(Settable { at, low, high })
            };
            both.sets.learn(references, n, |push| {
                lead::<K, M, _>(references, settable, push)
            });
        }
    }
}

#[cfg(test)]
#[path = "routes/tests.rs"]
mod tests;
