//! Whether numbers are finite, many at once.

use super::{Place, Point, Stored};
use core::marker::PhantomData;

/// The numbers of a struct `M` that are to be finite: those that lie side by side in eights, fours and pairs, the others one by
/// one.
///
/// All outputs are looked at after every step, so it is done without a branch for each, and in integers, which raise no
/// exception: the exponent of what is not finite consists of ones, and no other number's leading bits are as large.
pub struct Finite<M> {
    eights: Vec<Side<M, [Two; 4]>>,
    fours: Vec<Side<M, [Two; 2]>>,
    pairs: Vec<Side<M, [Two; 1]>>,
    others: Vec<Point<M, f64>>,
}

/// The place of numbers side by side, which are read as `T`.
struct Side<M, T> {
    offset: u32,
    holder: PhantomData<fn(&M) -> T>,
}

/// Two numbers in quarters: a processor finds the larger ones of eight pairs of them at once.
type Two = [i16; 8];

/// Where the quarters with sign and exponent are.
const LEADING: [usize; 2] = if cfg!(target_endian = "little") {
    [3, 7]
} else {
    [0, 4]
};

/// The least leading quarter, but for its sign, of what is not finite.
const NOT_FINITE: i16 = 0x7FF0;

/// Raises the quarters of `most` to those of `numbers`, without their signs.
#[inline(always)]
fn look(most: &mut Two, numbers: &Two) {
    for (most, quarter) in most.iter_mut().zip(numbers) {
        *most = (*most).max(quarter & i16::MAX);
    }
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
            eights: Vec::new(),
            fours: Vec::new(),
            pairs: Vec::new(),
            others: Vec::new(),
        };
        for run in &runs {
            found.split(run);
        }
        found
    }

    /// Takes in the values of `run`: as many at once as go, where the last ones may overlap those before.
    fn split(&mut self, run: &Place<M, f64>) {
        let n = if run.lies_side_by_side() { run.len } else { 1 };
        let mut i = 0;
        while i < run.len {
            i += match run.len - i {
                5.. if n >= 8 => self.eights.add(run, i),
                3.. if n >= 4 => self.fours.add(run, i),
                _ if n >= 2 => self.pairs.add(run, i),
                _ => {
                    self.others.push(run.point(i as usize));
                    1
                }
            };
        }
    }

    /// Whether all are.
    #[inline]
    pub fn is_met(&self, model: &M) -> bool {
        let mut most = [0; 8];
        for eight in &self.eights {
            for two in eight.get(model) {
                look(&mut most, two);
            }
        }
        for four in &self.fours {
            for two in four.get(model) {
                look(&mut most, two);
            }
        }
        for pair in &self.pairs {
            let [two] = pair.get(model);
            look(&mut most, two);
        }
        // A compiler that knows which quarters are read finds each by itself.
        let most = core::hint::black_box(most);
        let others = self.others.iter().all(|other| other.get(model).is_finite());
        others && LEADING.iter().all(|i| most[*i] < NOT_FINITE)
    }
}

/// Sides that are looked at alike.
trait Sides<M> {
    /// Adds the values of `run` from `i` on, as many as a side has, or the last of them; how many.
    fn add(&mut self, run: &Place<M, f64>, i: u32) -> u32;
}

impl<M, T> Sides<M> for Vec<Side<M, T>> {
    fn add(&mut self, run: &Place<M, f64>, i: u32) -> u32 {
        let n = size_of::<T>() as u32 / run.stride;
        self.push(Side {
            offset: run.offset + run.stride * i.min(run.len - n),
            holder: PhantomData,
        });
        n
    }
}

impl<M, T> Side<M, T> {
    #[inline(always)]
    fn get<'a>(&self, model: &'a M) -> &'a T {
        let begin = core::ptr::from_ref(model).cast::<u8>();
        // SAFETY: the values of a run of places, which are fields of `M`, of type f64, 8 bytes apart; `model` is borrowed
        // as a whole. `T` is as long; any bits will do for its integers, which need no larger alignment.
        unsafe { &*begin.add(self.offset as usize).cast() }
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
