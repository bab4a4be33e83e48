//! What a C program can get wrong is refused by a code, and changes nothing.

use admittance::one_axis::AxisParameters;
use arm_law::{ArmInputs, ArmOutputs, ArmParameters};
use exo_law::arm::{ArmState, exo_arm_defaults, exo_arm_init, exo_arm_tick, exo_arm_tune};
use exo_law::axis::{AxisState, exo_axis_init};
use exo_law::refusal::{Refusal, Status};
use std::ffi::{CStr, c_char};
use std::mem::{MaybeUninit, size_of};
use std::ptr::{null, null_mut};

/// Memory of a C program: zeros.
fn memory<T>() -> Box<T> {
    // SAFETY: the types of the interface are numbers, for which zeros are a value.
    Box::new(unsafe { MaybeUninit::<T>::zeroed().assume_init() })
}

fn bytes<T>(of: &T) -> Vec<u8> {
    // SAFETY: the types of the interface are numbers, initialized as zeros, so that padding is, too.
    unsafe { std::slice::from_raw_parts(std::ptr::from_ref(of).cast::<u8>(), size_of::<T>()) }
        .to_vec()
}

fn text(bytes: &[c_char]) -> &str {
    // SAFETY: the library ends its texts with a zero.
    unsafe { CStr::from_ptr(bytes.as_ptr()) }
        .to_str()
        .expect("UTF-8")
}

fn inputs() -> ArmInputs {
    ArmInputs {
        f_h: [5.0, 0.0, -3.0],
        ..ArmInputs::default()
    }
}

/// An arm's law that has run for some ticks.
fn running() -> Box<ArmState> {
    let mut state = memory();
    let status = exo_arm_init(&mut *state, &ArmParameters::default(), null_mut());
    assert_eq!(status, Status::Ok);
    let mut outputs = memory();
    for _ in 0..100 {
        let status = exo_arm_tick(&mut *state, &inputs(), &mut *outputs, null_mut());
        assert_eq!(status, Status::Ok);
    }
    state
}

#[test]
fn a_null_pointer_is_refused() {
    let (mut state, mut outputs) = (running(), memory::<ArmOutputs>());
    assert_eq!(exo_arm_defaults(null_mut()), Status::Null);
    let parameters = ArmParameters::default();
    assert_eq!(
        exo_arm_init(null_mut(), &parameters, null_mut()),
        Status::Null
    );
    assert_eq!(exo_arm_init(&mut *state, null(), null_mut()), Status::Null);
    assert_eq!(exo_arm_tune(&mut *state, null(), null_mut()), Status::Null);
    let given = inputs();
    for (state, inputs, outputs) in [
        (null_mut(), &raw const given, &raw mut *outputs),
        (&raw mut *state, null(), &raw mut *outputs),
        (&raw mut *state, &raw const given, null_mut()),
    ] {
        assert_eq!(
            exo_arm_tick(state, inputs, outputs, null_mut()),
            Status::Null
        );
    }
}

#[test]
fn a_misaligned_pointer_is_refused_before_anything_happens() {
    let mut state = running();
    let (before, given) = (bytes(&*state), inputs());
    let mut outputs = memory::<ArmOutputs>();
    let askew = (&raw mut *outputs).wrapping_byte_add(1);
    let status = exo_arm_tick(&mut *state, &given, askew, null_mut());
    assert_eq!(status, Status::Misaligned);
    let mut refusal = Refusal::default();
    let askew = (&raw mut refusal).wrapping_byte_add(1);
    let status = exo_arm_tick(&mut *state, &given, &mut *outputs, askew);
    assert_eq!(status, Status::Misaligned);
    assert!(bytes(&*state) == before);
}

#[test]
fn a_state_that_was_not_initialized_is_refused_also_when_it_belongs_to_another_law() {
    let (mut state, mut outputs) = (memory::<ArmState>(), memory::<ArmOutputs>());
    let tick = |state: *mut ArmState, outputs: *mut ArmOutputs| {
        exo_arm_tick(state, &inputs(), outputs, null_mut())
    };
    assert_eq!(tick(&mut *state, &mut *outputs), Status::NotInitialized);
    let axis = (&raw mut *state).cast::<AxisState>();
    let status = exo_axis_init(axis, &AxisParameters::default(), null_mut());
    assert_eq!(status, Status::Ok);
    assert_eq!(tick(&mut *state, &mut *outputs), Status::NotInitialized);
}

/// What is done wrong, and how that is refused.
type Case<T> = (fn(&mut T), &'static str);

/// What was refused, as a program would print it.
fn message(refusal: &Refusal) -> String {
    let Refusal {
        name,
        expected,
        axis,
        value,
    } = refusal;
    format!(
        "{}[{axis}] = {value}: expected {}",
        text(name),
        text(expected)
    )
}

#[test]
fn a_bad_parameter_is_refused_by_name_value_and_range_and_the_state_is_kept() {
    let cases: [Case<ArmParameters>; 8] = [
        (
            |p| p.K[1] = -1.0,
            "K[2] = -1: expected a finite value, at least 1e-6",
        ),
        (
            |p| p.Lambda_n[2] = f64::NAN,
            "Lambda_n[3] = NaN: expected a finite value, at least 1e-6",
        ),
        (
            |p| p.E_0 = -2.0,
            "energy.E_0[0] = -2: expected a finite value not less than 0",
        ),
        (
            |p| p.law = 7,
            "law[0] = 7: expected 1 (standard), 2 (passive), 3 (passive_applied), 4 (passive_bounded)",
        ),
        (
            |p| p.law = 5,
            "law[0] = 5: expected 1 (standard), 2 (passive), 3 (passive_applied), 4 (passive_bounded)",
        ),
        (
            |p| p.torque_limiting = 2,
            "torque_limiting[0] = 2: expected 1 (scale) under the laws passive_applied and passive_bounded: their nominal feels one share of the force",
        ),
        (|p| p.delay = 2, "delay[0] = 2: expected 0 to 1"),
        (
            |p| (p.p_n_box, p.p_n_min[0]) = (1, 3.0),
            "p_n_max[1] = 1: expected a value greater than the least one",
        ),
    ];
    for (spoil, expected) in cases {
        let mut state = running();
        let before = bytes(&*state);
        let mut parameters = ArmParameters::default();
        spoil(&mut parameters);
        let mut refusal = Refusal::default();
        let status = exo_arm_init(&mut *state, &parameters, &mut refusal);
        assert_eq!(
            (status, message(&refusal).as_str()),
            (Status::Refused, expected)
        );
        assert!(bytes(&*state) == before, "{expected}");
    }
}

#[test]
fn a_bad_gain_is_refused_and_the_gains_stay() {
    let mut state = running();
    let before = bytes(&*state);
    let mut refusal = Refusal::default();
    let gains = ArmParameters {
        K_P: [20.0, 0.0, 20.0],
        ..ArmParameters::default()
    };
    assert_eq!(
        exo_arm_tune(&mut *state, &gains, &mut refusal),
        Status::Refused
    );
    assert_eq!(
        message(&refusal),
        "K_P[2] = 0: expected a finite value, at least 1e-6"
    );
    assert!(bytes(&*state) == before);
    let gains = ArmParameters {
        K_P: [30.0; 3],
        ..ArmParameters::default()
    };
    assert_eq!(exo_arm_tune(&mut *state, &gains, &mut refusal), Status::Ok);
    assert_eq!(text(&refusal.name), ""); // nothing was refused
    assert!(bytes(&*state) != before);
}

#[test]
fn a_bad_input_is_refused_by_name_and_the_state_is_kept() {
    let cases: [Case<ArmInputs>; 3] = [
        (|i| i.q[1] = f64::NAN, "q[2] = NaN: expected a finite value"),
        (
            |i| i.engage = 2,
            "engage[0] = 2: expected 0 (false) or 1 (true)",
        ),
        (
            |i| i.hold = -1,
            "hold[0] = -1: expected 0 (false) or 1 (true)",
        ),
    ];
    for (spoil, expected) in cases {
        let (mut state, mut outputs) = (running(), memory::<ArmOutputs>());
        let before = bytes(&*state);
        let mut bad = inputs();
        spoil(&mut bad);
        let mut refusal = Refusal::default();
        let status = exo_arm_tick(&mut *state, &bad, &mut *outputs, &mut refusal);
        assert_eq!(
            (status, message(&refusal).as_str()),
            (Status::Refused, expected)
        );
        assert!(bytes(&*state) == before, "{expected}");
    }
}

#[test]
fn a_state_copied_as_bytes_goes_on_as_the_original() {
    let mut state = running();
    let mut copy = memory::<ArmState>();
    // SAFETY: both are memory of one type, one beside the other.
    unsafe { std::ptr::copy_nonoverlapping(&raw const *state, &raw mut *copy, 1) };
    let (mut one, mut other) = (memory::<ArmOutputs>(), memory::<ArmOutputs>());
    for _ in 0..100 {
        exo_arm_tick(&mut *state, &inputs(), &mut *one, null_mut());
        exo_arm_tick(&mut *copy, &inputs(), &mut *other, null_mut());
        assert!(bytes(&*one) == bytes(&*other));
    }
    assert!(one.e_nr[0] > 1e-6); // it does move
}
