//! Whether numbers are finite, many at once.

use super::{Place, Point, Stored};
use core::marker::PhantomData;

/// The numbers of a struct `M` that are to be finite: those that lie side by side in fours, the others one by one.
///
/// All outputs are looked at after every step, so it is done without a branch for each, and in integers, which raise no
/// exception: an exponent of ones, and 1 added to it, reaches the sign, which was taken off.
pub struct Finite<M> {
    fours: Vec<Four<M>>,
    others: Vec<Point<M, f64>>,
}

/// The place of four numbers side by side.
struct Four<M> {
    offset: u32,
    holder: PhantomData<fn(&M)>,
}

const SIGN: u64 = 1 << 63;
const EXPONENT_1: u64 = 1 << (f64::MANTISSA_DIGITS - 1);

/// Has the sign if `value` is not finite.
#[inline(always)]
fn look(value: f64) -> u64 {
    (value.to_bits() & !SIGN) + EXPONENT_1
}

impl<M> Finite<M> {
    /// Those of `places`.
    pub fn new(places: impl IntoIterator<Item = Place<M, f64>>) -> Self {
        let mut places: Vec<_> = places.into_iter().collect();
        places.sort_by_key(|place| place.offset);
        let mut runs: Vec<Place<M, f64>> = Vec::new();
        for place in places {
            let both = runs.last().and_then(|run| run.followed_by(&place));
            match (runs.last_mut(), both) {
                (Some(run), Some(both)) => *run = both,
                _ => runs.push(place),
            }
        }
        let mut found = Self {
            fours: Vec::new(),
            others: Vec::new(),
        };
        for run in &runs {
            if run.lies_side_by_side() && run.len >= 4 {
                // The last one overlaps the one before where it must.
                found.fours.extend((0..run.len).step_by(4).map(|i| Four {
                    offset: run.offset + run.stride * i.min(run.len - 4),
                    holder: PhantomData,
                }));
            } else {
                found.others.extend((0..run.len()).map(|i| run.point(i)));
            }
        }
        found
    }

    /// Whether all are.
    #[inline]
    pub fn is_met(&self, model: &M) -> bool {
        let mut seen = [0; 4];
        for four in &self.fours {
            for (seen, value) in seen.iter_mut().zip(four.get(model)) {
                *seen |= look(value);
            }
        }
        let [a, b, c, d] = seen;
        let mut seen = a | b | c | d;
        for other in &self.others {
            seen |= look(other.get(model));
        }
        seen & SIGN == 0
    }
}

impl<M> Four<M> {
    #[inline(always)]
    fn get(&self, model: &M) -> [f64; 4] {
        let begin = core::ptr::from_ref(model).cast::<u8>();
        // SAFETY: four values of a run of places, which are fields of `M`, of type f64, 8 bytes apart; `model` is borrowed
        // as a whole.
        unsafe { *begin.add(self.offset as usize).cast() }
    }
}

impl<M> Place<M, f64> {
    fn lies_side_by_side(&self) -> bool {
        self.stride as usize == size_of::<f64>() && self.stored == Stored::AsIs
    }

    /// This place and `next` as one, if `next` begins where this one ends and both are stored alike.
    fn followed_by(&self, next: &Self) -> Option<Self> {
        let adjoins = next.offset == self.offset + self.len * self.stride;
        let alike = next.stride == self.stride && next.stored == self.stored;
        (adjoins && alike).then_some(Self {
            len: self.len + next.len,
            ..*self
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Finite;
    use crate::place::of_field;
    use core::mem::offset_of;

    /// Runs of all lengths up to nine, single precision, and one that nobody looks at.
    #[derive(Clone, Copy)]
    struct Numbers {
        one: f64,
        unseen: f64,
        two: [f64; 2],
        gap: i32,
        nine: [f64; 9],
        other_gap: i32,
        single: [f32; 3],
        last: [f64; 5],
    }

    const FINITE: [f64; 9] = [
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

    #[test]
    fn one_number_that_is_not_finite_is_found_among_many() {
        let finite = Finite::new([
            of_field(offset_of!(Numbers, last), |m: &Numbers| &m.last),
            of_field(offset_of!(Numbers, one), |m: &Numbers| &m.one),
            of_field(offset_of!(Numbers, two), |m: &Numbers| &m.two),
            of_field(offset_of!(Numbers, nine), |m: &Numbers| &m.nine),
            of_field(offset_of!(Numbers, single), |m: &Numbers| &m.single),
        ]);
        let numbers = Numbers {
            one: -1e308,
            unseen: f64::NAN,
            two: [f64::MIN, f64::MAX],
            gap: -1,
            nine: FINITE,
            other_gap: i32::MIN,
            single: [f32::MAX, f32::MIN, -0.0],
            last: [f64::MIN; 5],
        };
        assert!(finite.is_met(&numbers));
        for wrong in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let found = |change: &dyn Fn(&mut Numbers)| {
                let mut numbers = numbers;
                change(&mut numbers);
                !finite.is_met(&numbers)
            };
            assert!(found(&|numbers| numbers.one = wrong), "{wrong}");
            for i in 0..2 {
                assert!(found(&|numbers| numbers.two[i] = wrong), "{wrong} at {i}");
            }
            for i in 0..9 {
                assert!(found(&|numbers| numbers.nine[i] = wrong), "{wrong} at {i}");
            }
            for i in 0..3 {
                assert!(
                    found(&|numbers| numbers.single[i] = wrong as f32),
                    "{wrong} at {i}"
                );
            }
            for i in 0..5 {
                assert!(found(&|numbers| numbers.last[i] = wrong), "{wrong} at {i}");
            }
        }
        assert!(numbers.unseen.is_nan() && numbers.gap == -1 && numbers.other_gap == i32::MIN);
    }
}
