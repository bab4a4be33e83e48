//! The library against the FMU's model in one process, through commands that no scenario has: gains changed on the way,
//! engaging and letting go, hold, supervision, faults. Every output, bit for bit.

#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::one_axis::{AxisOutputs, AxisParameters};
use arm_controller::ArmController;
use arm_law::{ArmOutputs, ArmParameters};
use counting::Counting;
use exo_law::arm::{ArmState, exo_arm_init, exo_arm_tick, exo_arm_tune};
use exo_law::axis::{AxisState, exo_axis_init, exo_axis_tick};
use exo_law::refusal::Status;
use fmu_declaration::{Access, Rows};
use fmu_export::{Log, Model, Step};
use std::mem::MaybeUninit;
use std::ptr::null_mut;
use testbed_controller::TestbedController;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Sample period, s.
const T: f64 = 0.001;

/// Both, side by side.
struct Pair {
    fmu: ArmController,
    state: Box<ArmState>,
    outputs: Box<ArmOutputs>,
    allocations: u64,
    k: u32,
}

fn memory<X>() -> Box<X> {
    // SAFETY: the types of the interface are numbers, for which zeros are a value.
    Box::new(unsafe { MaybeUninit::<X>::zeroed().assume_init() })
}

impl Pair {
    fn new(parameters: &ArmParameters) -> Self {
        let mut fmu = ArmController::default();
        fmu.parameters = *parameters;
        fmu.initialize(0.0, &mut Log::silent()).expect("accepted");
        let mut state = memory();
        let status = exo_arm_init(&mut *state, parameters, null_mut());
        assert_eq!(status, Status::Ok);
        Self {
            fmu,
            state,
            outputs: memory(),
            allocations: 0,
            k: 0,
        }
    }

    /// One tick of both, with the inputs that the FMU has.
    fn tick(&mut self) {
        let t = f64::from(self.k) * T;
        self.k += 1;
        let fmu = &mut self.fmu;
        let inputs = fmu.inputs;
        let step = Step::at(t, T);
        assert!(fmu.step(step, &mut Log::silent()).is_ok());
        let (n, status) = counting::allocations(|| {
            exo_arm_tick(&mut *self.state, &inputs, &mut *self.outputs, null_mut())
        });
        self.allocations += n;
        assert_eq!(status, Status::Ok);
        assert_eq!(
            bits(&*self.outputs),
            bits(&self.fmu.outputs),
            "tick {}",
            self.k
        );
    }

    fn tune(&mut self, change: impl FnOnce(&mut ArmParameters)) {
        let fmu = &mut self.fmu;
        change(&mut fmu.parameters);
        fmu.tune(&mut Log::silent()).expect("accepted");
        let parameters = fmu.parameters;
        let (n, status) =
            counting::allocations(|| exo_arm_tune(&mut *self.state, &parameters, null_mut()));
        self.allocations += n;
        assert_eq!(status, Status::Ok);
    }
}

/// Everything that a tick shows, as bits.
fn bits<O: Rows>(outputs: &O) -> Vec<u64> {
    let mut bits = Vec::new();
    for row in O::ROWS {
        match &row.access {
            Access::Real { at, .. } => bits.extend(at.values(outputs).map(f64::to_bits)),
            Access::Boolean { at } => bits.extend(at.values(outputs).map(u64::from)),
            Access::Integer { at, .. } | Access::Enumeration { at, .. } => {
                bits.extend(at.values(outputs).map(|value| value as u64));
            }
            Access::Wide { .. } | Access::String { .. } | Access::Binary { .. } => {
                panic!("no output is one")
            }
        }
    }
    bits
}

/// A motion with contact-like jerks, and a force that saturates.
fn moved(fmu: &mut ArmController, k: u32) {
    let t = f64::from(k) * T;
    let jerk = if k % 700 < 350 { 1e-3 } else { 0.0 };
    fmu.inputs.q = [
        0.03 * wave(1.1 * t),
        -1.48096 + 0.02 * wave(0.7 * t) + jerk,
        1.70138 - 0.03 * wave(0.9 * t),
    ];
    fmu.inputs.f_h = [
        0.8 * wave(0.8 * t),
        0.3 * wave(2.1 * t),
        -0.6 * wave(0.5 * t),
    ];
}

/// A smooth periodic course. Whose sine it is does not matter: both get the same.
fn wave(x: f64) -> f64 {
    x.sin()
}

#[test]
fn gains_engaging_and_hold_on_the_way_are_the_FMUs_bit_for_bit_without_an_allocation() {
    let mut pair = Pair::new(&ArmParameters::default());
    let mut saturated = 0;
    for k in 0..10_000 {
        moved(&mut pair.fmu, k);
        pair.fmu.inputs.engage = (!(3_000..3_050).contains(&k) && k != 5_000).into();
        pair.fmu.inputs.hold = (6_000..6_400).contains(&k).into();
        if k % 1_500 == 1_000 {
            let start = ArmParameters::default();
            let softer = k % 3_000 == 1_000;
            pair.tune(|p| {
                (p.K, p.f_max) = if softer {
                    ([600.0; 3], [100.0, 400.0, 250.0])
                } else {
                    (start.K, start.f_max)
                };
            });
        }
        pair.tick();
        saturated += pair.outputs.saturated;
    }
    assert!((1_000..9_000).contains(&saturated), "{saturated}");
    assert_eq!(pair.allocations, 0);
    assert_eq!(
        counting::allocations(|| std::hint::black_box(Box::new(0))).0,
        1
    ); // it does count
}

#[test]
fn supervision_with_its_faults_is_the_FMUs_bit_for_bit() {
    let mut parameters = ArmParameters {
        supervision: 1,
        ..ArmParameters::default()
    };
    parameters.supervisor.heartbeat_timeout = 0.05;
    let mut pair = Pair::new(&parameters);
    let mut states = std::collections::BTreeSet::new();
    for k in 0..8_000 {
        moved(&mut pair.fmu, k);
        let fmu = &mut pair.fmu.inputs;
        fmu.enable = i32::from(k > 10);
        fmu.engage = (k > 300 && !(4_500..4_600).contains(&k)).into();
        fmu.heartbeat = if (2_000..2_100).contains(&k) {
            0
        } else {
            (k / 10) as i32
        };
        fmu.acknowledge = i32::from(k % 1_000 == 500);
        fmu.emergency_stop = (6_000..6_010).contains(&k).into();
        if (3_500..3_510).contains(&k) {
            fmu.f_h[1] = f64::NAN;
        }
        if k == 7_200 {
            fmu.q[0] = f64::INFINITY;
        }
        pair.tick();
        states.insert(pair.outputs.state);
    }
    assert!(states.len() >= 5, "{states:?}");
    assert_eq!(pair.allocations, 0);
}

#[test]
fn the_joint_space_form_is_the_FMUs_bit_for_bit() {
    let parameters = ArmParameters {
        space: 2,
        ..ArmParameters::default()
    };
    let mut pair = Pair::new(&parameters);
    for k in 0..5_000 {
        moved(&mut pair.fmu, k);
        pair.tick();
    }
    assert!(pair.outputs.dq_n != [0.0; 3]);
    assert_eq!(pair.allocations, 0);
}

#[test]
fn the_arm_in_servo_form_is_the_FMUs_bit_for_bit() {
    let parameters = ArmParameters {
        space: 2,
        form: 2,
        ..ArmParameters::default()
    };
    let mut pair = Pair::new(&parameters);
    let mut faults = std::collections::BTreeSet::new();
    for k in 0..8_000 {
        moved(&mut pair.fmu, k);
        let t = f64::from(k) * T;
        let tau = [
            20.0 * wave(0.8 * t),
            170.0 * wave(0.5 * t),
            -9.0 * wave(2.0 * t),
        ];
        pair.fmu.inputs.tau_a_measured = if k < 6_000 { tau } else { [0.0; 3] };
        pair.fmu.inputs.engage = (!(3_000..3_050).contains(&k)).into();
        pair.fmu.inputs.hold = (4_000..4_400).contains(&k).into();
        if k == 5_000 {
            pair.tune(|p| p.joint.D_n = [8.0; 3]);
        }
        pair.tick();
        faults.insert(pair.outputs.drive_fault);
    }
    assert!(pair.outputs.q_d[1] != 0.0 && pair.outputs.dq_d[1] != 0.0);
    assert!(faults.len() > 1, "{faults:?}");
    assert_eq!(pair.allocations, 0);
}

#[test]
fn one_axis_is_the_FMUs_bit_for_bit_in_both_forms() {
    for form in [1, 2] {
        let parameters = AxisParameters {
            form,
            ..AxisParameters::default()
        };
        let mut fmu = TestbedController::default();
        fmu.parameters = parameters;
        fmu.initialize(0.0, &mut Log::silent()).expect("accepted");
        let mut state: Box<AxisState> = memory();
        assert_eq!(
            exo_axis_init(&mut *state, &parameters, null_mut()),
            Status::Ok
        );
        let mut outputs: Box<AxisOutputs> = memory();
        let mut saturated = 0;
        for k in 0..5_000_u32 {
            let t = f64::from(k) * 0.002;
            fmu.inputs.q = 0.2 * wave(0.9 * t);
            fmu.inputs.tau_h = 6.0 * wave(0.4 * t);
            fmu.inputs.tau_a_measured = 13.0 * wave(1.3 * t);
            fmu.inputs.engage = (!(3_000..3_050).contains(&k)).into();
            fmu.inputs.hold = (4_000..4_200).contains(&k).into();
            fmu.step(Step::at(t, 0.002), &mut Log::silent())
                .expect("a step");
            let (n, status) = counting::allocations(|| {
                exo_axis_tick(&mut *state, &fmu.inputs, &mut *outputs, null_mut())
            });
            assert_eq!((n, status), (0, Status::Ok));
            assert_eq!(bits(&*outputs), bits(&fmu.outputs), "form {form}, tick {k}");
            saturated += outputs.saturated;
        }
        assert!(saturated > 100, "{saturated}");
    }
}
