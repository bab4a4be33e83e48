//! One variable of each type of FMI 3.0, and arrays of them: what goes in comes out one step later.
//!
//! FMI 2.0 has no type for some of them, so that the model has an archive of FMI 3.0 alone. It is the subject of tests
//! (`tests/abi/tests/types.rs`, `tests/system/test_types.py`).

use fmu_export::{Log, Model, Refusal, Step, choices, group, interface};

choices! { OPTION "Option" "An option":
    1 "first" "the first option";
    2 "second" "the second option";
}

/// Feedthrough of every type
#[interface(step = 0.1, stop = 2.0)]
pub struct Feedthrough {
    /// single precision
    #[input(0, unit = METRE)]
    float32: f32,
    /// single precision
    #[output(1, unit = METRE, from = ["float32"])]
    float32_out: f32,
    /// double precision
    #[input(2)]
    float64: f64,
    /// double precision
    #[output(3, from = ["float64"])]
    float64_out: f64,
    /// 8 bits with a sign
    #[input(4)]
    int8: i8,
    /// 8 bits with a sign
    #[output(5, from = ["int8"])]
    int8_out: i8,
    /// 8 bits
    #[input(6)]
    uint8: u8,
    /// 8 bits
    #[output(7, from = ["uint8"])]
    uint8_out: u8,
    /// 16 bits with a sign
    #[input(8)]
    int16: i16,
    /// 16 bits with a sign
    #[output(9, from = ["int16"])]
    int16_out: i16,
    /// 16 bits
    #[input(10)]
    uint16: u16,
    /// 16 bits
    #[output(11, from = ["uint16"])]
    uint16_out: u16,
    /// 32 bits with a sign
    #[input(12)]
    int32: i32,
    /// 32 bits with a sign
    #[output(13, from = ["int32"])]
    int32_out: i32,
    /// 32 bits
    #[input(14)]
    uint32: u32,
    /// 32 bits
    #[output(15, from = ["uint32"])]
    uint32_out: u32,
    /// 64 bits with a sign
    #[input(16)]
    int64: i64,
    /// 64 bits with a sign
    #[output(17, from = ["int64"])]
    int64_out: i64,
    /// 64 bits
    #[input(18)]
    uint64: u64,
    /// 64 bits
    #[output(19, from = ["uint64"])]
    uint64_out: u64,
    /// true or false
    #[input(20)]
    boolean: bool,
    /// true or false
    #[output(21, from = ["boolean"])]
    boolean_out: bool,
    /// text
    #[input(22, start = "Set me!".into())]
    string: String,
    /// text
    #[output(23, from = ["string"])]
    string_out: String,
    /// bytes
    #[input(24, max_size = 16, start = b"foo".to_vec())]
    binary: Vec<u8>,
    /// bytes
    #[output(25, max_size = 16, from = ["binary"])]
    binary_out: Vec<u8>,
    /// one of two
    #[input(26, items = OPTION, typed, start = 1)]
    option: i32,
    /// one of two
    #[output(27, items = OPTION, typed, from = ["option"])]
    option_out: i32,
    #[part(from = 28, prefix = "parameter.")]
    parameter: Parameters,
    /// twice the bytes of `binary`, which are too many where there are more than 8
    #[local(48, max_size = 16)]
    twice: Vec<u8>,
    /// whether there is a `twice`
    #[parameter(49, tunable)]
    doubling: bool,
    /// a sensor that can fail
    #[input(50, unit = METRE, nan)]
    sensor: f32,
    /// as the sensor
    #[output(51, unit = METRE, nan)]
    sensor_out: f32,
    /// the next step panics
    #[input(52)]
    panic: bool,
}

/// Parameters with bounds, start values and several elements.
#[group]
pub struct Parameters {
    /// single precision
    #[parameter(0, unit = METRE, range = -0.1..=1e30, start = [0.1, 0.2])]
    float32: [f32; 2],
    /// 8 bits with a sign
    #[parameter(1, integers = -100.., start = [-100, 127])]
    int8: [i8; 2],
    /// 8 bits
    #[parameter(2, start = [0, 255])]
    uint8: [u8; 2],
    /// 16 bits with a sign
    #[parameter(3, start = [i16::MIN, i16::MAX])]
    int16: [i16; 2],
    /// 16 bits
    #[parameter(4, tunable, integers = ..=60_000, start = [0, 60_000])]
    uint16: [u16; 2],
    /// 32 bits
    #[parameter(5, start = [0, u32::MAX])]
    uint32: [u32; 2],
    /// 64 bits with a sign
    #[parameter(6, start = [i64::MIN, i64::MAX])]
    int64: [i64; 2],
    /// 64 bits
    #[parameter(7, tunable, integers = 1.., start = [1, u64::MAX])]
    uint64: [u64; 2],
    /// true or false
    #[parameter(8, start = [true, false])]
    boolean: [bool; 2],
    /// text
    #[parameter(9, start = ["a b".into(), "<&>".into()])]
    string: [String; 2],
    /// bytes
    #[parameter(10, max_size = 4, mime_type = "image/png", start = [vec![0, 255, 16], vec![]])]
    binary: [Vec<u8>; 2],
    /// single precision without bounds
    #[parameter(11, start = 2.5)]
    single: f32,
}

impl Feedthrough {
    fn feed(&mut self) {
        self.float32_out = self.float32;
        self.float64_out = self.float64;
        self.int8_out = self.int8;
        self.uint8_out = self.uint8;
        self.int16_out = self.int16;
        self.uint16_out = self.uint16;
        self.int32_out = self.int32;
        self.uint32_out = self.uint32;
        self.int64_out = self.int64;
        self.uint64_out = self.uint64;
        self.boolean_out = self.boolean;
        self.string_out.clone_from(&self.string);
        self.binary_out.clone_from(&self.binary);
        self.option_out = self.option;
        self.sensor_out = self.sensor;
        if self.doubling {
            self.twice = self.binary.repeat(2);
        }
    }
}

impl Model for Feedthrough {
    fn initialize(&mut self, _start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        self.feed();
        Ok(())
    }

    fn step(&mut self, _step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        assert!(!self.panic, "told to");
        self.feed();
        Ok(())
    }
}
