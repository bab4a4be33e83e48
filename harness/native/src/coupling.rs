//! The loop: for each step and each component in order copy the wired inputs, set, step, get.
//!
//! All is given as addresses that Python's buffers and the FMUs' libraries have. A row per communication point: a call on
//! row k is one on `row + k · size`.

use std::ffi::{c_double, c_int, c_uint, c_void};
use std::time::{Duration, Instant};

/// `fmi2OK`
const OK: c_int = 0;
/// Steps between two looks at the clock.
const STEPS: usize = 64;
/// How long before its time a paced step is waited for without sleep: what a sleep may be late by.
const SPIN: Duration = Duration::from_micros(150);

type Transfer = unsafe extern "C" fn(*mut c_void, *const c_uint, usize, *mut c_void) -> c_int;
type DoStep = unsafe extern "C" fn(*mut c_void, c_double, c_double, c_int) -> c_int;

/// A value that goes from a component's output to another one's input, each step.
#[derive(Clone, Copy, Debug)]
pub struct Copy {
    /// Address of the input in row 0.
    pub target: usize,
    /// Bytes of a row of the target.
    pub target_size: usize,
    /// Address of the output in the first row that is read.
    pub source: usize,
    /// Bytes of a row of the source.
    pub source_size: usize,
    /// Bytes of the value, 4 or 8.
    pub bytes: usize,
    /// Whether the negative of a Real goes there.
    pub negative: bool,
}

/// A Set or Get of one row.
#[derive(Clone, Copy, Debug)]
pub struct Call {
    /// Address of the C function.
    pub function: usize,
    /// Address of the value references.
    pub references: usize,
    /// How many there are.
    pub count: usize,
    /// Address of the first row.
    pub row: usize,
    /// Bytes of a row.
    pub size: usize,
}

/// One FMU's instance and what is done with it in a step.
#[derive(Clone, Debug)]
pub struct Component {
    /// Address of the instance, the standard's `fmi2Component`.
    pub instance: usize,
    /// Address of `fmi2DoStep`.
    pub do_step: usize,
    /// Its wired inputs.
    pub copies: Vec<Copy>,
    /// Its Sets.
    pub writes: Vec<Call>,
    /// Its Gets.
    pub reads: Vec<Call>,
}

/// Which call of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// The n-th Set.
    Write(usize),
    /// `fmi2DoStep`
    Step,
    /// The n-th Get.
    Read(usize),
}

impl Which {
    /// For Python: what it is, and its number.
    pub const fn named(self) -> (&'static str, usize) {
        match self {
            Self::Write(number) => ("write", number),
            Self::Step => ("step", 0),
            Self::Read(number) => ("read", number),
        }
    }
}

/// A call that returned another status than `fmi2OK`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Number of the component.
    pub component: usize,
    /// Which call.
    pub call: Which,
    /// What it returned.
    pub status: c_int,
    /// Number of the step.
    pub step: usize,
}

/// Why [`Loop::advance`] came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// All steps are made.
    Done,
    /// The time is over; call again.
    Interrupted,
    /// A call failed.
    Failed(Failure),
}

/// Addresses of two columns with a number for each step, s: how late it began, and how long it took.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// Of the lateness.
    pub late: usize,
    /// Of the time that the step's calls took.
    pub busy: usize,
}

/// A run in progress.
pub struct Loop {
    components: Vec<Component>,
    steps: usize,
    step: f64,
    next: usize,
    pace: Option<Pace>,
    /// When step 0 would have begun, of a paced run that has begun.
    origin: Option<Instant>,
}

impl Loop {
    /// A run of the steps from number `first` to before number `steps`, each of `step` seconds; step 0 begins at t = 0.
    ///
    /// # Safety
    /// As long as it lives: each address is of what its name says, and of no other thread's at the same time; each buffer has
    /// a row for each step.
    pub unsafe fn new(
        components: Vec<Component>,
        first: usize,
        steps: usize,
        step: f64,
        pace: Option<Pace>,
    ) -> Self {
        Self {
            components,
            steps,
            step,
            next: first,
            pace,
            origin: None,
        }
    }

    /// Makes steps until all are made, one fails or about `patience` is over.
    pub fn advance(&mut self, patience: Duration) -> Ended {
        if let Some(pace) = self.pace {
            return self.keep_pace(pace, patience);
        }
        let began = Instant::now();
        while self.next < self.steps {
            let until = self.steps.min(self.next + STEPS);
            for k in self.next..until {
                if let Err(failure) = self.make(k) {
                    return Ended::Failed(failure);
                }
            }
            self.next = until;
            if began.elapsed() >= patience && self.next < self.steps {
                return Ended::Interrupted;
            }
        }
        Ended::Done
    }

    /// The same by the clock: step k begins k steps after step 0, or as soon as it can.
    fn keep_pace(&mut self, pace: Pace, patience: Duration) -> Ended {
        let began = Instant::now();
        let after = |k: usize| Duration::from_secs_f64(k as f64 * self.step);
        let origin = *self
            .origin
            .get_or_insert_with(|| began.checked_sub(after(self.next)).unwrap_or(began));
        while self.next < self.steps {
            let k = self.next;
            let due = origin + after(k);
            loop {
                let left = due.saturating_duration_since(Instant::now());
                if left.is_zero() {
                    break;
                }
                if began.elapsed() >= patience {
                    return Ended::Interrupted;
                }
                if left > SPIN {
                    std::thread::sleep((left - SPIN).min(patience));
                } else {
                    std::hint::spin_loop();
                }
            }
            let begins = Instant::now();
            let made = self.make(k);
            // SAFETY: the contract of `new`: both columns have a number for each step.
            unsafe {
                *(pace.late as *mut f64).add(k) =
                    begins.saturating_duration_since(due).as_secs_f64();
                *(pace.busy as *mut f64).add(k) = begins.elapsed().as_secs_f64();
            }
            if let Err(failure) = made {
                return Ended::Failed(failure);
            }
            self.next = k + 1;
            if began.elapsed() >= patience && self.next < self.steps {
                return Ended::Interrupted;
            }
        }
        Ended::Done
    }

    #[inline]
    fn make(&self, k: usize) -> Result<(), Failure> {
        let t = k as f64 * self.step;
        for (component, part) in self.components.iter().enumerate() {
            let failed = |call, status| Failure {
                component,
                call,
                status,
                step: k,
            };
            let instance = part.instance as *mut c_void;
            for copy in &part.copies {
                // SAFETY: the contract of `new`: both rows are there, and hold values of this size.
                unsafe { copied(copy, k) };
            }
            for (number, call) in part.writes.iter().enumerate() {
                // SAFETY: the contract of `new`.
                let status = unsafe { transferred(call, instance, k) };
                if status != OK {
                    return Err(failed(Which::Write(number), status));
                }
            }
            // SAFETY: the contract of `new`: the address is that of fmi2DoStep.
            let status = unsafe {
                let do_step = std::mem::transmute::<usize, DoStep>(part.do_step);
                do_step(instance, t, self.step, 1)
            };
            if status != OK {
                return Err(failed(Which::Step, status));
            }
            for (number, call) in part.reads.iter().enumerate() {
                // SAFETY: the contract of `new`.
                let status = unsafe { transferred(call, instance, k) };
                if status != OK {
                    return Err(failed(Which::Read(number), status));
                }
            }
        }
        Ok(())
    }
}

/// # Safety
/// Both addresses are of values of `copy.bytes` bytes in row k.
#[inline]
unsafe fn copied(copy: &Copy, k: usize) {
    let target = copy.target + k * copy.target_size;
    let source = copy.source + k * copy.source_size;
    // SAFETY: the caller's contract. Rows of NumPy are aligned to their values.
    unsafe {
        if copy.negative {
            *(target as *mut f64) = -*(source as *const f64);
        } else if copy.bytes == 8 {
            *(target as *mut u64) = *(source as *const u64);
        } else {
            *(target as *mut u32) = *(source as *const u32);
        }
    }
}

/// # Safety
/// The addresses are of a Set or Get of `instance`, of its value references, and of row k.
#[inline]
unsafe fn transferred(call: &Call, instance: *mut c_void, k: usize) -> c_int {
    // SAFETY: the caller's contract.
    unsafe {
        let function = std::mem::transmute::<usize, Transfer>(call.function);
        function(
            instance,
            call.references as *const c_uint,
            call.count,
            (call.row + k * call.size) as *mut c_void,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A component that adds 1 to its input: input and output are the two numbers.
    struct Adder {
        input: f64,
        output: f64,
        fails_at: f64,
    }

    unsafe extern "C" fn set(
        adder: *mut c_void,
        _: *const c_uint,
        _: usize,
        from: *mut c_void,
    ) -> c_int {
        // SAFETY: the tests give an `Adder` and a row of one number.
        unsafe { (*adder.cast::<Adder>()).input = *from.cast() };
        OK
    }

    unsafe extern "C" fn get(
        adder: *mut c_void,
        _: *const c_uint,
        _: usize,
        to: *mut c_void,
    ) -> c_int {
        // SAFETY: as above.
        unsafe { *to.cast() = (*adder.cast::<Adder>()).output };
        OK
    }

    unsafe extern "C" fn add(adder: *mut c_void, t: f64, _: f64, _: c_int) -> c_int {
        // SAFETY: as above.
        let adder = unsafe { &mut *adder.cast::<Adder>() };
        adder.output = adder.input + 1.0;
        if t >= adder.fails_at { 3 } else { OK }
    }

    /// A ring of two: each gets what the other put out; the first reads the row before.
    fn ring(fails_at: f64, steps: usize) -> (Vec<f64>, Ended) {
        paced_ring(fails_at, steps, 0.5, None)
    }

    fn paced_ring(fails_at: f64, steps: usize, step: f64, pace: Option<Pace>) -> (Vec<f64>, Ended) {
        let mut adders = [f64::INFINITY, fails_at].map(|fails_at| Adder {
            input: 0.0,
            output: 0.0,
            fails_at,
        });
        let mut inputs = [vec![0.0; steps], vec![0.0; steps]];
        let mut outputs = [vec![0.0; steps + 1], vec![0.0; steps + 1]];
        let references = [0_u32];
        let mut components = Vec::new();
        for i in 0..2 {
            let ahead = i; // the second sees what the first has just put out
            let call = |function: usize, row: *mut f64, ahead: usize| Call {
                function,
                references: references.as_ptr() as usize,
                count: 1,
                row: row as usize + 8 * ahead,
                size: 8,
            };
            components.push(Component {
                instance: (&raw mut adders[i]) as usize,
                do_step: add as *const () as usize,
                copies: vec![Copy {
                    target: inputs[i].as_mut_ptr() as usize,
                    target_size: 8,
                    source: outputs[1 - i].as_mut_ptr() as usize + 8 * ahead,
                    source_size: 8,
                    bytes: 8,
                    negative: false,
                }],
                writes: vec![call(set as *const () as usize, inputs[i].as_mut_ptr(), 0)],
                reads: vec![call(get as *const () as usize, outputs[i].as_mut_ptr(), 1)],
            });
        }
        // SAFETY: all lives until the loop has ended, and there is a row for each step.
        let mut coupled = unsafe { Loop::new(components, 0, steps, step, pace) };
        let ended = loop {
            match coupled.advance(Duration::ZERO) {
                Ended::Interrupted => {}
                ended => break ended,
            }
        };
        let [_, second] = outputs;
        (second, ended)
    }

    #[test]
    fn each_component_sees_the_row_that_its_wire_says() {
        let (second, ended) = ring(f64::INFINITY, 1000);
        assert_eq!(ended, Ended::Done);
        let expected: Vec<_> = (0..=1000).map(|k| 2.0 * f64::from(k)).collect();
        assert_eq!(second, expected);
    }

    #[test]
    fn a_status_that_is_not_ok_ends_the_run_and_is_located() {
        let (second, ended) = ring(50.0, 1000);
        let failure = Failure {
            component: 1,
            call: Which::Step,
            status: 3,
            step: 100,
        };
        assert_eq!(ended, Ended::Failed(failure));
        assert_eq!((second[100], second[101]), (200.0, 0.0));
    }

    #[test]
    fn a_paced_run_takes_its_time_and_says_how_late_each_step_was() {
        let (mut late, mut busy) = (vec![-1.0; 40], vec![-1.0; 40]);
        let pace = Pace {
            late: late.as_mut_ptr() as usize,
            busy: busy.as_mut_ptr() as usize,
        };
        let began = Instant::now();
        let (second, ended) = paced_ring(f64::INFINITY, 40, 2e-3, Some(pace));
        assert_eq!((ended, second[40]), (Ended::Done, 80.0));
        // The last step begins 39 periods after the first one; nothing here says how much later.
        assert!(began.elapsed() >= Duration::from_millis(78));
        assert!(late.iter().chain(&busy).all(|time| *time >= 0.0));
    }
}
