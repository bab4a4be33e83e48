//! Ticks that come late, early, twice at once or not at all, as real-time systems have them, with the time measured.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::timing::{EARLY, IN_TIME, LATE};
use arm_law::{ArmInputs, ArmOutputs, ArmParameters};
use exo_law::arm::{ArmState, exo_arm_init, exo_arm_tick, exo_arm_tick_after};
use exo_law::refusal::{Refusal, Status};
use std::mem::MaybeUninit;
use std::ptr::null_mut;

/// Sample period, s.
const T: f64 = 0.001;

/// Times between ticks as a desktop system without priorities has had them, in T: one tick late by 5.1 ms and two that were
/// due meanwhile; one left out; two at once.
const RECORDED: [f64; 8] = [6.1, 0.09, 0.03, 1.0, 1.96, 1.0, 1.98, 0.02];

fn memory<X>() -> Box<X> {
    // SAFETY: the types of the interface are numbers, for which zeros are a value.
    Box::new(unsafe { MaybeUninit::<X>::zeroed().assume_init() })
}

/// Three joints of 2 kg·m², moved by the torque that is held, from the arm's start pose.
struct Robot {
    q: [f64; 3],
    dq: [f64; 3],
}

impl Robot {
    fn moved(&mut self, tau: [f64; 3], dt: f64) {
        for (tau, (q, dq)) in tau.into_iter().zip(self.q.iter_mut().zip(&mut self.dq)) {
            let a = tau / 2.0;
            *q += *dq * dt + 0.5 * a * dt * dt;
            *dq += a * dt;
        }
    }
}

/// What 2 s under a push and back showed.
#[derive(Debug)]
struct Run {
    /// largest change of a torque from one tick to the next, N·m
    step: f64,
    /// largest speed of a joint, rad/s
    speed: f64,
    /// angles at the end, rad
    end: [f64; 3],
    late: u32,
    early: u32,
    least_tank: f64,
}

/// Ticks in time, but for [`RECORDED`] in every 100 of them if `unsteady`; the law is told of it if `told`.
fn run(unsteady: bool, told: bool) -> Run {
    let mut state = memory::<ArmState>();
    let status = exo_arm_init(&mut *state, &ArmParameters::default(), null_mut());
    assert_eq!(status, Status::Ok);
    let mut outputs = memory::<ArmOutputs>();
    let mut inputs = ArmInputs::default();
    let mut robot = Robot {
        q: inputs.q,
        dq: [0.0; 3],
    };
    let mut run = Run {
        step: 0.0,
        speed: 0.0,
        end: robot.q,
        late: 0,
        early: 0,
        least_tank: f64::INFINITY,
    };
    let (mut t, mut dt) = (0.0_f64, T);
    let mut before = [0.0; 3];
    for k in 0.. {
        inputs.q = robot.q;
        inputs.f_h = [6.0 * (3.0 * t).sin(), 4.0 * (2.0 * t).sin(), 0.0];
        let (law, outputs) = (&mut *state, &mut *outputs);
        let status = if told {
            exo_arm_tick_after(law, dt, &inputs, outputs, null_mut())
        } else {
            exo_arm_tick(law, &inputs, outputs, null_mut())
        };
        assert_eq!(status, Status::Ok);
        for (tau, before) in outputs.tau_a.iter().zip(before) {
            run.step = run.step.max((tau - before).abs());
        }
        run.speed = robot
            .dq
            .iter()
            .fold(run.speed, |most, dq| most.max(dq.abs()));
        before = outputs.tau_a;
        run.late += u32::from(outputs.timing == LATE);
        run.early += u32::from(outputs.timing == EARLY);
        run.least_tank = run.least_tank.min(outputs.tank);
        if told {
            assert_eq!((outputs.encoder_fault, outputs.debt), (0, 0), "t = {t}");
        }
        if t >= 2.0 {
            break;
        }
        let place: usize = k % 100;
        dt = T * if unsteady && place >= 50 {
            RECORDED.get(place - 50).copied().unwrap_or(1.0)
        } else {
            1.0
        };
        robot.moved(outputs.tau_a, dt);
        t += dt;
    }
    run.end = robot.q;
    run
}

#[test]
fn ticks_that_are_late_or_early_leave_the_torque_smooth_where_the_law_is_told() {
    let (steady, told, untold) = (run(false, true), run(true, true), run(true, false));
    println!("steady {steady:?}\ntold {told:?}\nuntold {untold:?}");
    assert_eq!((steady.late, steady.early), (0, 0));
    assert!(told.late > 40 && told.early > 40, "{told:?}");
    assert!(untold.step > 20.0, "{untold:?}");
    assert!(told.step < 2.0 && steady.step < 0.1, "{told:?} {steady:?}");
    assert!(
        (0..3).all(|i| (told.end[i] - steady.end[i]).abs() < 0.02),
        "{told:?} {steady:?}"
    );
    assert!(told.least_tank > 9.0);
}

#[test]
fn a_tick_in_time_is_the_same_bit_for_bit_with_and_without_a_clock() {
    let (with, without) = (run(false, true), run(false, false));
    assert_eq!(with.end, without.end);
}

#[test]
fn a_time_that_no_clock_can_have_measured_is_refused_and_changes_nothing() {
    let mut state = memory::<ArmState>();
    exo_arm_init(&mut *state, &ArmParameters::default(), null_mut());
    let mut outputs = memory::<ArmOutputs>();
    let inputs = ArmInputs::default();
    for dt in [-1e-9, f64::NAN, f64::INFINITY] {
        let mut refusal = memory::<Refusal>();
        let before = bytes(&state);
        let status = exo_arm_tick_after(&mut *state, dt, &inputs, &mut *outputs, &mut *refusal);
        assert_eq!(status, Status::Refused, "{dt}");
        assert_eq!(refusal.name[..2], [b'd' as _, b't' as _]);
        assert!(before == bytes(&state));
    }
    let status = exo_arm_tick_after(&mut *state, 0.0, &inputs, &mut *outputs, null_mut());
    assert_eq!((status, outputs.timing), (Status::Ok, EARLY));
    let status = exo_arm_tick_after(&mut *state, T, &inputs, &mut *outputs, null_mut());
    assert_eq!((status, outputs.timing), (Status::Ok, IN_TIME));
}

fn bytes(state: &ArmState) -> Vec<u8> {
    // SAFETY: the state is words.
    unsafe {
        std::slice::from_raw_parts(
            std::ptr::from_ref(state).cast::<u8>(),
            size_of::<ArmState>(),
        )
    }
    .to_vec()
}
