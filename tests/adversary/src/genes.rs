//! A case as numbers in [0, 1), which an optimiser can change one by one, and as a line of text.

use crate::random::Random;
use std::fmt;
use std::str::FromStr;

/// Numbers of a case.
pub const LENGTH: usize = 68;

/// The numbers, and the seed of whatever the case leaves to chance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Genes {
    seed: u64,
    /// in units of 2⁻¹⁶
    values: [u16; LENGTH],
}

impl Genes {
    /// Drawn with this seed.
    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        Self {
            seed,
            values: core::array::from_fn(|_| number(&mut random)),
        }
    }

    /// The seed of the case's random choices.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The same with a few numbers drawn anew or moved a little, and now and then another seed.
    #[must_use]
    pub fn mutated(&self, random: &mut Random) -> Self {
        let mut genes = self.clone();
        for _ in 0..=random.index(4) {
            let value = &mut genes.values[random.index(LENGTH)];
            *value = if random.chance(0.5) {
                number(random)
            } else {
                let step = random.within(-0.05, 0.05) * 65_536.0;
                (f64::from(*value) + step).clamp(0.0, 65_535.0) as u16
            };
        }
        if random.chance(0.2) {
            genes.seed = random.bits();
        }
        genes
    }
}

fn number(random: &mut Random) -> u16 {
    (random.bits() >> 48) as u16
}

impl fmt::Display for Genes {
    /// The seed and the numbers, hexadecimal.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x} ", self.seed)?;
        self.values
            .iter()
            .try_for_each(|value| write!(f, "{value:04x}"))
    }
}

impl FromStr for Genes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bad = || format!("expected a seed and {LENGTH} numbers, got `{text}`");
        let (seed, digits) = text.split_once(' ').ok_or_else(bad)?;
        let mut values = [0; LENGTH];
        if digits.len() != 4 * LENGTH || !digits.is_ascii() {
            return Err(bad());
        }
        for (i, value) in values.iter_mut().enumerate() {
            *value = u16::from_str_radix(&digits[4 * i..4 * i + 4], 16).map_err(|_| bad())?;
        }
        let seed = u64::from_str_radix(seed, 16).map_err(|_| bad())?;
        Ok(Self { seed, values })
    }
}

/// Reads the numbers of a case one after the other.
#[derive(Debug)]
pub struct Reader<'a> {
    values: &'a [u16; LENGTH],
    next: usize,
}

impl<'a> Reader<'a> {
    /// From the first one.
    pub fn new(genes: &'a Genes) -> Self {
        Self {
            values: &genes.values,
            next: 0,
        }
    }

    /// The next number, in [0, 1).
    ///
    /// # Panics
    /// When a case reads more numbers than there are.
    pub fn unit(&mut self) -> f64 {
        let value = self.values[self.next];
        self.next += 1;
        f64::from(value) / 65_536.0
    }

    /// Evenly spread over the decades from `low` to `high`.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    /// `special` in this share of all cases, else over the decades.
    pub fn or_decades(&mut self, share: f64, special: f64, low: f64, high: f64) -> f64 {
        let (choice, x) = (self.unit(), self.unit());
        if choice < share {
            special
        } else {
            low * (high / low).powf(x)
        }
    }

    /// Whether, in this share of all cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}
