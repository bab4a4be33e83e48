//! Ticks and samples do not depend on how an importer cuts time into steps.
//!
//! A controller holds its inputs from tick to tick: inputs that change only every 42 periods, where the step sizes meet,
//! must give the same outputs at the same ticks for every step size that divides the period. A longer step is a sample of
//! its own. The arm's force sensor has a clock of its own, whose sample is seen in its noise. What must have run is counted
//! here in whole 300ths of the period.

use abi::{Fmu, Instance, Kind, Status};

/// Communication steps of every long run.
const STEPS: u64 = 200_000;

/// Parts of a period that times are counted in.
const PARTS: u64 = 300;

/// Parts for which inputs are held: 42 periods, a multiple of every constant step size.
const HELD: u64 = 42 * PARTS;

/// Step sizes in parts that divide the period: T/10, T/3, T.
const DIVISORS: [u64; 3] = [30, 100, 300];

/// Those that do not: 1.5 T, 7 T.
const LONGER: [u64; 2] = [450, 2100];

/// What is seen of an instance: a count, and a fingerprint of outputs in which every bit counts.
type Shown = (i32, u64);

/// An FMU with a clock in it.
struct Clocked {
    fmu: Fmu,
    /// Real inputs: reference and start value.
    inputs: Vec<(u32, f64)>,
    /// Real outputs that are looked at.
    outputs: Vec<u32>,
    /// An output that counts, of a controller.
    tick: Option<u32>,
    /// Period of the clock (s).
    period: f64,
    /// Parameters that are not those of the start.
    settings: Vec<(u32, f64)>,
}

impl Clocked {
    /// A sampled controller: all its outputs belong to the tick.
    fn controller(name: &str) -> Self {
        let fmu = Fmu::open(name);
        let new = fmu.instantiate();
        Self {
            inputs: reals(&fmu, "input")
                .map(|reference| (reference, new.real(reference)))
                .collect(),
            outputs: reals(&fmu, "output").collect(),
            tick: Some(fmu.reference("tick")),
            period: new.real(fmu.reference("T")),
            settings: Vec::new(),
            fmu,
        }
    }

    /// The arm's force sensor. Its reading is the force that is held, in the base frame, and the noise of the sample's
    /// number: the motion has no say, so that the plant may take long substeps.
    fn sensor() -> Self {
        let fmu = Fmu::open("ExoskeletonArm");
        Self {
            inputs: fmu
                .references(["f_h[1]", "f_h[2]", "f_h[3]"])
                .map(|reference| (reference, 0.0))
                .into(),
            outputs: fmu
                .references(["f_h_measured[1]", "f_h_measured[2]", "f_h_measured[3]"])
                .into(),
            tick: None,
            period: fmu.instantiate().real(fmu.reference("ft.T")),
            settings: vec![
                (fmu.reference("ft.noise"), 0.2),
                (fmu.reference("substep"), 0.01),
            ],
            fmu,
        }
    }

    /// With another period, which is the parameter `name`.
    fn with_period(mut self, name: &str, period: f64) -> Self {
        self.settings.push((self.fmu.reference(name), period));
        self.period = period;
        self
    }

    /// An initialized instance.
    fn begin(&self, start: f64) -> Instance {
        let instance = self.fmu.instantiate();
        for &(reference, value) in &self.settings {
            assert_eq!(instance.set_real(&[reference], &[value]), Status::OK);
        }
        if self.tick.is_some() {
            // Jumps are doubted by the number of readings, which is that of the steps: not what is tried here.
            let samples = [self.fmu.reference("encoder.samples")];
            assert_eq!(instance.set_integer(&samples, &[0]), Status::OK);
        }
        instance.initialize(start);
        instance
    }

    /// Sets the inputs that are held in a block of periods: each near its start value, from block to block another.
    fn set(&self, instance: &Instance, block: u64) {
        let (references, values): (Vec<_>, Vec<_>) = (1..)
            .zip(&self.inputs)
            .map(|(i, &(reference, start))| {
                (
                    reference,
                    start + 0.05 * (1.7 * (block * i) as f64 + i as f64).sin(),
                )
            })
            .unzip();
        assert_eq!(instance.set_real(&references, &values), Status::OK);
    }

    fn step(&self, instance: &Instance, t: f64, h: f64) {
        let status = instance.step(t, h);
        assert_eq!(status, Status::OK, "{:?}", instance.messages());
    }

    fn shown(&self, instance: &Instance) -> Shown {
        let values = instance
            .get_real(&self.outputs)
            .expect("outputs can be read");
        let mix = |hash: u64, value: f64| {
            (hash ^ value.to_bits())
                .wrapping_mul(0x9E37_79B9_7F4A_7C15)
                .rotate_left(29)
        };
        let count = self.tick.map_or(0, |tick| instance.integer(tick));
        (count, values.into_iter().fold(0, mix))
    }

    /// What is shown after each of the first steps of exactly one period from `start` on.
    fn by_the_period(&self, start: f64, steps: u64) -> Vec<Shown> {
        self.by_the_period_of(Importer::Multiplies, start, steps)
    }

    /// The same, of an importer that has its own way to the next time.
    fn by_the_period_of(&self, importer: Importer, start: f64, steps: u64) -> Vec<Shown> {
        let instance = self.begin(start);
        let mut t = start;
        let step = |k: u64| {
            if k * PARTS % HELD == 0 {
                self.set(&instance, k * PARTS / HELD);
            }
            let next = match importer {
                Importer::Sums => t + self.period,
                _ => start + (k + 1) as f64 * self.period,
            };
            let size = match importer {
                Importer::Subtracts => next - t,
                _ => self.period,
            };
            self.step(&instance, t, size);
            t = next;
            self.shown(&instance)
        };
        (0..steps).map(step).collect()
    }

    /// Index in [`Clocked::by_the_period`] of what must be seen at a time, in parts. A controller runs the ticks in
    /// [0, time), a step of one period the tick at its begin; the sensor takes the samples in (0, time], such a step the
    /// one at its end.
    fn newest(&self, time: u64) -> Option<usize> {
        let steps = match self.tick {
            Some(_) => time.div_ceil(PARTS),
            None => time / PARTS,
        };
        (steps as usize).checked_sub(1)
    }

    /// Steps of `sizes` (parts), their times summed or multiplied, show what steps of the period show.
    fn check(&self, reference: &[Shown], sizes: impl Iterator<Item = u64>, summed: bool) {
        let instance = self.begin(0.0);
        let (mut time, mut sum) = (0, 0.0);
        for size in sizes {
            if time % HELD == 0 {
                self.set(&instance, time / HELD);
            }
            let h = self.period * size as f64 / PARTS as f64;
            let multiplied = time as f64 / size as f64 * h;
            self.step(&instance, if summed { sum } else { multiplied }, h);
            time += size;
            sum += h;
            if let Some(newest) = self.newest(time) {
                assert_eq!(
                    self.shown(&instance),
                    reference[newest],
                    "{}, {time}/{PARTS} periods, step {size}/{PARTS}, summed: {summed}",
                    self.fmu.name
                );
            }
        }
        let exact = time as f64 / PARTS as f64 * self.period;
        assert!(sum != exact, "the sum has rounded, or nothing was tested");
    }

    /// Steps of all these sizes, 2e5 each.
    fn check_all(&self, sizes: &[u64]) {
        let longest = sizes.iter().max().copied().unwrap_or_default();
        let reference = self.by_the_period(0.0, STEPS * longest / PARTS);
        let still = reference.windows(2).filter(|pair| pair[0] == pair[1]);
        assert_eq!(still.count(), 0, "the outputs move with every tick");
        for summed in [false, true] {
            for size in sizes {
                let sizes = std::iter::repeat_n(*size, STEPS as usize);
                self.check(&reference, sizes, summed);
            }
            if self.tick.is_none() {
                self.check(&reference, random_sizes(), summed);
            }
        }
    }

    /// Steps longer than the period show what a controller shows that has them for its period.
    fn check_longer(mut self) {
        let asked = self.period;
        for size in LONGER {
            let period = asked * size as f64 / PARTS as f64;
            self.settings.clear();
            self.period = period;
            let shown = self.by_the_period(0.0, 20_000);
            let told = self.warnings(&[period; 20]);
            let named = format!("sample_period = {period:?} s");
            assert!(told.len() == 1 && told[0].contains(&named), "{told:?}");
            self.settings.push((self.fmu.reference("T"), period));
            assert!(shown == self.by_the_period(0.0, 20_000), "{size}/{PARTS}");
        }
    }

    /// What the log is warned of in steps of these sizes (s).
    fn warnings(&self, sizes: &[f64]) -> Vec<String> {
        let (instance, mut t) = (self.begin(0.0), 0.0);
        instance.messages();
        for h in sizes {
            self.step(&instance, t, *h);
            t += h;
        }
        let messages = instance.messages().into_iter();
        messages.map(|message| message.text).collect()
    }

    /// Whatever the step sizes, the ticks go on, at most one a step, and none that is not due.
    fn check_random(&self) {
        let (instance, tick) = (self.begin(0.0), self.tick.expect("a controller"));
        let period = |instance: &Instance| instance.real(self.fmu.reference("sample_period"));
        let (mut time, mut last) = (0, -1);
        for size in random_sizes() {
            self.set(&instance, time / HELD);
            let h = self.period * size as f64 / PARTS as f64;
            self.step(&instance, time as f64 / PARTS as f64 * self.period, h);
            let begun = time as f64 / PARTS as f64 * self.period / period(&instance);
            time += size;
            let ended = time as f64 / PARTS as f64 * self.period / period(&instance);
            let now = instance.integer(tick);
            // The newest one that was due when the step began, or the first one in it.
            let expected = f64::from(last + 1).max((begun + 1e-3).floor());
            let due = expected < ended - 1e-3;
            assert_eq!(now, if due { expected as i32 } else { last }, "{time}");
            last = now;
        }
    }
}

/// How an importer comes to the time of the next step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Importer {
    /// t + h
    Sums,
    /// startTime + k h
    Multiplies,
    /// startTime + k h, and as step size the difference of two of these, as fmpy does
    Subtracts,
}

/// References of the Real variables of a causality.
fn reals<'a>(fmu: &'a Fmu, causality: &'a str) -> impl Iterator<Item = u32> + 'a {
    let reals = fmu
        .variables
        .iter()
        .filter(move |v| v.causality == causality && v.kind == Kind::Real {});
    reals.map(|v| v.reference)
}

/// 2e5 steps of up to five periods in hundredths of the period (a thousandth is the instant itself for the exporter), cut
/// where inputs change.
fn random_sizes() -> impl Iterator<Item = u64> {
    let (mut time, mut seed) = (0, 7_u64);
    std::iter::repeat_with(move || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let wanted = PARTS / 100 * (1 + (seed >> 33) % 500);
        let size = wanted.min(HELD - time % HELD);
        time += size;
        size
    })
    .take(STEPS as usize)
}

#[test]
fn one_step_of_the_period_runs_one_tick_and_the_first_runs_tick_zero() {
    for name in ["TestbedController", "ArmController"] {
        let all = Clocked::controller(name).by_the_period(0.0, 200);
        for (k, (tick, _)) in all.iter().enumerate() {
            assert_eq!(*tick, k as i32);
        }
    }
}

#[test]
fn a_step_that_is_longer_than_the_period_is_a_sample_of_that_length() {
    for name in ["TestbedController", "ArmController"] {
        Clocked::controller(name).check_longer();
    }
}

#[test]
fn a_tick_that_does_not_come_in_time_is_told_once() {
    for name in ["TestbedController", "ArmController"] {
        let one = Clocked::controller(name);
        let period = one.period;
        assert!(one.warnings(&[period; 20]).is_empty());
        let sizes = [1.0, 1.0, 3.0, 1.0, 1.0, 0.5, 2.0, 1.0, 1.0].map(|share| share * period);
        let told = one.warnings(&sizes);
        assert_eq!(told.len(), 1, "{told:?}");
        let named = "timing = 1 (late): tick 5 came 3.000 sample periods after the one before";
        assert!(told[0].contains(named), "{told:?}");
    }
}

#[test]
fn steps_of_any_sizes_run_the_newest_tick_that_is_due_and_no_other() {
    for name in ["TestbedController", "ArmController"] {
        Clocked::controller(name).check_random();
    }
}

#[test]
fn any_part_of_the_period_runs_the_testbed_controller_s_ticks_that_lie_in_it() {
    Clocked::controller("TestbedController").check_all(&DIVISORS);
}

#[test]
fn any_part_of_the_period_runs_the_arm_controller_s_ticks_that_lie_in_it() {
    Clocked::controller("ArmController").check_all(&DIVISORS);
}

#[test]
fn any_step_size_shows_the_force_sensor_s_newest_sample() {
    Clocked::sensor().check_all(&[&DIVISORS[..], &LONGER].concat());
}

#[test]
fn ticks_and_samples_count_from_the_start_time() {
    for one in [
        Clocked::controller("TestbedController"),
        Clocked::controller("ArmController"),
        Clocked::sensor(),
    ] {
        let reference = one.by_the_period(0.0, 50);
        for start in [-1.0, 0.0013, 1e4] {
            assert_eq!(one.by_the_period(start, 50), reference, "start {start}");
        }
    }
}

#[test]
fn since_1970_too_a_step_of_the_period_runs_one_tick_and_shows_one_sample() {
    // The time has 2⁻²² s there, 0.0024 periods: a sum falls behind by 0.1 % of the steps.
    for one in [
        Clocked::controller("TestbedController").with_period("T", 1e-4),
        Clocked::controller("ArmController").with_period("T", 1e-4),
        Clocked::sensor().with_period("ft.T", 1e-4),
    ] {
        let reference = one.by_the_period(0.0, 20_000);
        for importer in [Importer::Sums, Importer::Multiplies, Importer::Subtracts] {
            for start in [1.7e9, 2e9] {
                let shown = one.by_the_period_of(importer, start, 20_000);
                let same = shown.iter().zip(&reference).position(|(a, b)| a != b);
                assert_eq!(same, None, "{}, {importer:?} from {start}", one.fmu.name);
            }
        }
    }
}

#[test]
fn summed_milliseconds_run_one_tick_a_step_after_two_hours() {
    let one = Clocked::controller("TestbedController").with_period("T", 1e-3);
    let (instance, tick) = (one.begin(0.0), one.fmu.reference("tick"));
    let mut t = 0.0;
    for k in 0..7_162_000 {
        one.step(&instance, t, 1e-3);
        t += 1e-3;
        // The sum has fallen behind by a thousandth of the period at step 7,160,328, which ran two ticks.
        if k > 7_158_000 {
            assert_eq!(instance.integer(tick), k, "step {k}");
        }
    }
}

/// A plant over one second in `steps` steps, with exact times and substeps: the bits of all its Real outputs, and the
/// value of one that must have moved.
fn second(fmu: &Fmu, settings: &[(&str, f64)], steps: u32, moved: &str) -> (Vec<u64>, f64) {
    let instance = fmu.instantiate();
    let set = |causality: &str| {
        for (name, value) in settings {
            let variable = fmu.variable(name);
            if variable.causality == causality {
                assert_eq!(
                    instance.set_real(&[variable.reference], &[*value]),
                    Status::OK
                );
            }
        }
    };
    set("parameter");
    instance.initialize(0.0);
    set("input");
    let h = f64::from(steps).recip();
    for k in 0..steps {
        assert_eq!(instance.step(f64::from(k) * h, h), Status::OK);
    }
    // A drive's torque is a mean over the last step, which is as long as the step.
    let of_a_step = |reference: &u32| {
        let variable = fmu.variables.iter().find(|v| v.reference == *reference);
        variable.is_some_and(|v| v.name.contains("tau_drive"))
    };
    let mut outputs: Vec<_> = reals(fmu, "output").collect();
    outputs.retain(|reference| !of_a_step(reference));
    let values = instance.get_real(&outputs).expect("outputs");
    let bits = values.into_iter().map(f64::to_bits).collect();
    (bits, instance.real(fmu.reference(moved)))
}

#[test]
fn a_plant_ends_where_one_large_step_ends_when_the_substeps_are_the_same() {
    // Powers of two: the lengths of substeps and all times are exact, so that equal means equal.
    let (substep, sample) = (2.0_f64.powi(-14), 2.0_f64.powi(-10));
    // Fast enough for 0.3 m in 1 s: friction, flight and the wall are all in it. The arms are pulled up against friction.
    for (name, settings, moved) in [
        ("Testbed", &[("tau_h", 8.0)][..], "energy.loss_wall"),
        (
            "ExoskeletonArm",
            &[
                ("ft.T", sample),
                ("ft.noise", 0.2),
                ("f_h[3]", 30.0),
                ("tau_a[1]", 30.0),
            ],
            "energy.loss_friction",
        ),
        (
            "ExoskeletonArms",
            &[("left.f_h[3]", 30.0), ("right.tau_a[1]", 30.0)],
            "energy.loss_friction",
        ),
    ] {
        let fmu = Fmu::open(name);
        let settings = [settings, &[("substep", substep)]].concat();
        let (reference, moved_by) = second(&fmu, &settings, 512, moved);
        assert!(moved_by > 0.0, "{name}: {moved} = {moved_by}");
        for steps in [1, 2, 4, 64] {
            let (outputs, _) = second(&fmu, &settings, steps, moved);
            assert_eq!(outputs, reference, "{name}: {steps} steps");
        }
    }
}
