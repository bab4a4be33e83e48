//! A counter with the small types of numbers, which both versions of FMI have: in FMI 2.0 as Real and Integer.
//!
//! It is the subject of tests (`tests/abi/tests/types.rs`, `tests/system/test_types.py`).

use fmu_export::{Log, Model, Refusal, Step, choices, interface};

choices! { EDGE "Edge" "What is counted":
    1 "rising" "from false to true";
    2 "both" "every change";
}

/// Counter of edges in small types
#[interface(step = 0.01)]
pub struct Narrow {
    /// what is counted, by channel
    #[input]
    signal: [bool; 2],
    /// gain of the mean
    #[input(range = -2.0..=2.0, start = 0.1)]
    gain: f32,
    /// counted from there, modulo 256
    #[parameter(start = [0, 250])]
    first: [u8; 2],
    /// added at each edge
    #[parameter(tunable, integers = -8..=8, start = 1)]
    increment: i8,
    /// edges, by channel, modulo 256
    #[output(from = ["first[i]"])]
    count: [u8; 2],
    /// steps until it starts anew
    #[parameter(integers = 1.., start = 1000)]
    wrap: u16,
    /// steps since then, from -wrap
    #[output(from = ["wrap"])]
    steps: i32,
    /// difference of the channels
    #[output]
    difference: i16,
    /// gain times the mean of the channels
    #[output(from = ["gain"])]
    mean: f32,
    /// added to the mean
    #[parameter]
    offset: f32,
    /// which edges count
    #[parameter(items = EDGE, typed, start = 1)]
    edge: i32,
    /// any text
    #[parameter(start = "narrow".into())]
    label: String,
    /// the next step panics
    #[input]
    panic: bool,
    before: [bool; 2],
}

impl Narrow {
    fn show(&mut self) {
        let [a, b] = self.count;
        self.difference = i16::from(a) - i16::from(b);
        self.mean = self.gain * (f32::from(a) + f32::from(b)) / 2.0 + self.offset;
    }
}

impl Model for Narrow {
    fn initialize(&mut self, _start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        self.count = self.first;
        self.before = self.signal;
        self.steps = -i32::from(self.wrap);
        self.show();
        Ok(())
    }

    fn step(&mut self, _step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        assert!(!self.panic, "told to");
        for i in 0..2 {
            let (now, before) = (self.signal[i], self.before[i]);
            if now != before && (now || self.edge == 2) {
                self.count[i] = self.count[i].wrapping_add_signed(self.increment);
            }
        }
        self.before = self.signal;
        self.steps += 1;
        if self.steps >= 0 {
            self.steps = -i32::from(self.wrap);
        }
        self.show();
        Ok(())
    }
}
