//! The library against the FMU's model in one process, through commands that no scenario has: gains changed on the way,
//! engaging and letting go, hold, supervision, faults. Every output, bit for bit.

#![allow(non_snake_case, reason = "the paper's symbols")]

use arm_controller::ArmController;
use counting::Counting;
use exo_law::arm::parameters::ArmParameters;
use exo_law::arm::signals::{ArmInputs, ArmOutputs};
use exo_law::arm::supervision::ArmSignals;
use exo_law::arm::{ArmState, exo_arm_init, exo_arm_tick, exo_arm_tune};
use exo_law::gains::ArmGains;
use exo_law::refusal::Status;
use export::{Log, Model, Step};
use std::mem::MaybeUninit;
use std::ptr::null_mut;

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
    fn new(mut fmu: ArmController, parameters: &ArmParameters) -> Self {
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
        let inputs = ArmInputs {
            q: fmu.q,
            f_h: fmu.f_h,
            ft_force: fmu.ft.force,
            ft_torque: fmu.ft.torque,
            ft_valid: fmu.ft_valid.into(),
            ft_tare: fmu.ft.tare.into(),
            engage: fmu.engage.into(),
            hold: fmu.hold.into(),
            signals: ArmSignals {
                enable: fmu.enable.into(),
                acknowledge: fmu.acknowledge.into(),
                emergency_stop: fmu.emergency_stop.into(),
                heartbeat: fmu.heartbeat,
                encoder_valid: fmu.encoder_valid.into(),
            },
        };
        let step = Step {
            start_time: 0.0,
            t,
            h: T,
        };
        assert!(fmu.step(step, &mut Log::silent()).is_ok());
        let (n, status) = counting::allocations(|| {
            exo_arm_tick(&mut *self.state, &inputs, &mut *self.outputs, null_mut())
        });
        self.allocations += n;
        assert_eq!(status, Status::Ok);
        assert_eq!(
            shown_by_the_library(&self.outputs),
            shown_by(&self.fmu),
            "tick {}",
            self.k
        );
    }

    fn tune(&mut self, gains: ArmGains) {
        let fmu = &mut self.fmu;
        (fmu.Lambda_n, fmu.D_n) = (gains.Lambda_n, gains.D_n);
        (fmu.K, fmu.K_P, fmu.f_max) = (gains.K, gains.K_P, gains.f_max);
        fmu.tune(&mut Log::silent()).expect("accepted");
        let (n, status) =
            counting::allocations(|| exo_arm_tune(&mut *self.state, &gains, null_mut()));
        self.allocations += n;
        assert_eq!(status, Status::Ok);
    }
}

/// Everything that both show, as bits.
fn shown_by_the_library(o: &ArmOutputs) -> Vec<u64> {
    let vectors = [
        o.tau_a,
        o.tau_demand,
        o.f_a,
        o.p,
        o.dp,
        o.p_n,
        o.dp_n,
        o.e_nr,
        o.ft_f_h,
        o.ft_moment,
        o.stiff_hand_D,
        o.q_n,
        o.dq_n,
        o.e_q,
    ];
    let numbers = [o.authority, o.sigma_min, o.H, o.G, o.tank, o.share];
    let choices = [
        o.saturated,
        o.held,
        o.outside_bounds,
        o.engaged,
        o.slowed,
        o.stiff_hand_detected,
        o.ft_fault,
        o.ft_tare_state,
        o.ft_tare_failure,
        o.state,
        o.diagnostic,
        o.first_fault,
        o.debt,
    ];
    bits(&vectors, &numbers, &choices)
}

fn shown_by(f: &ArmController) -> Vec<u64> {
    let vectors = [
        f.tau_a,
        f.tau_demand,
        f.f_a,
        f.p,
        f.dp,
        f.p_n,
        f.dp_n,
        f.e_nr,
        f.ft.f_h,
        f.ft.moment,
        f.stiff_hand_seen.D,
        f.q_n,
        f.dq_n,
        f.e_q,
    ];
    let energy = &f.energy;
    let numbers = [
        f.authority,
        f.sigma_min,
        energy.H,
        energy.G,
        energy.tank,
        energy.share,
    ];
    let choices = [
        f.saturated.into(),
        f.held.into(),
        f.outside_bounds.into(),
        f.engaged.into(),
        f.slowed.into(),
        f.stiff_hand_seen.detected.into(),
        f.ft.fault,
        f.ft.tare_state,
        f.ft.tare_failure,
        f.state,
        f.diagnostic,
        f.first_fault,
        energy.debt.into(),
    ];
    bits(&vectors, &numbers, &choices)
}

fn bits(vectors: &[[f64; 3]], numbers: &[f64], choices: &[i32]) -> Vec<u64> {
    let vectors = vectors.iter().flatten().chain(numbers);
    let choices = choices.iter().map(|choice| *choice as u64);
    vectors
        .map(|number| number.to_bits())
        .chain(choices)
        .collect()
}

/// A motion with contact-like jerks, and a force that saturates.
fn moved(fmu: &mut ArmController, k: u32) {
    let t = f64::from(k) * T;
    let jerk = if k % 700 < 350 { 1e-3 } else { 0.0 };
    fmu.q = [
        0.03 * wave(1.1 * t),
        -1.48096 + 0.02 * wave(0.7 * t) + jerk,
        1.70138 - 0.03 * wave(0.9 * t),
    ];
    fmu.f_h = [
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
    let mut pair = Pair::new(ArmController::default(), &ArmParameters::default());
    let mut saturated = 0;
    for k in 0..10_000 {
        moved(&mut pair.fmu, k);
        pair.fmu.engage = !(3_000..3_050).contains(&k) && k != 5_000;
        pair.fmu.hold = (6_000..6_400).contains(&k);
        if k % 1_500 == 1_000 {
            let gains = ArmGains::default();
            let softer = k % 3_000 == 1_000;
            pair.tune(ArmGains {
                K: if softer { [600.0; 3] } else { gains.K },
                f_max: if softer {
                    [100.0, 400.0, 250.0]
                } else {
                    gains.f_max
                },
                ..gains
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
    let mut fmu = ArmController::default();
    (fmu.supervision, fmu.heartbeat_timeout) = (true, 0.05);
    let mut parameters = ArmParameters::default();
    parameters.supervision.supervision = 1;
    parameters.supervision.heartbeat_timeout = 0.05;
    let mut pair = Pair::new(fmu, &parameters);
    let mut states = std::collections::BTreeSet::new();
    for k in 0..8_000 {
        moved(&mut pair.fmu, k);
        let fmu = &mut pair.fmu;
        fmu.enable = k > 10;
        fmu.engage = k > 300 && !(4_500..4_600).contains(&k);
        fmu.heartbeat = if (2_000..2_100).contains(&k) {
            0
        } else {
            (k / 10) as i32
        };
        fmu.acknowledge = k % 1_000 == 500;
        fmu.emergency_stop = (6_000..6_010).contains(&k);
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
    let mut fmu = ArmController::default();
    fmu.space = 2;
    let parameters = ArmParameters {
        space: 2,
        ..ArmParameters::default()
    };
    let mut pair = Pair::new(fmu, &parameters);
    for k in 0..5_000 {
        moved(&mut pair.fmu, k);
        pair.tick();
    }
    assert!(pair.outputs.dq_n != [0.0; 3]);
    assert_eq!(pair.allocations, 0);
}
