//! Steps do not allocate. The models are linked into this process, because an allocator counts its own process's
//! library only; the functions called are the generic ones behind the C symbols.

use arm_controller::ArmController;
use counting::{Counting, allocations};
use exoskeleton_arm::ExoskeletonArm;
use exoskeleton_arms::ExoskeletonArms;
use export::ffi::{CO_SIMULATION, Callbacks, Component, Status};
use export::functions as f;
use export::legality::Function;
use export::model::Model;
use human_operator::HumanOperator;
use std::ffi::CString;
use testbed::Testbed;
use testbed_controller::TestbedController;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A silent instance, initialized.
fn initialized<M: Model>() -> Component {
    let guid = CString::new(M::DESCRIPTION.guid()).expect("no null byte");
    let callbacks = Callbacks {
        logger: None,
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: std::ptr::null_mut(),
    };
    let (n, g, location) = (c"name".as_ptr(), guid.as_ptr(), std::ptr::null());
    // SAFETY: all pointers outlive the call; the component is used by this thread only.
    unsafe {
        let c = f::instantiate::<M>(n, CO_SIMULATION, g, location, &raw const callbacks, 0, 0);
        assert!(!c.is_null());
        assert_eq!(f::enter_initialization_mode::<M>(c), Status::Ok);
        assert_eq!(f::exit_initialization_mode::<M>(c), Status::Ok);
        c
    }
}

/// Value reference of a variable.
fn reference<M: Model>(name: &str) -> u32 {
    let scalar = M::DESCRIPTION.scalars().find(|s| s.name() == name);
    scalar
        .unwrap_or_else(|| panic!("no variable {name}"))
        .reference()
}

/// Allocations of 1000 times set, step, get.
fn of_a_run<M: Model>(inputs: [&str; 2], outputs: [&str; 2]) -> u64 {
    let c = initialized::<M>();
    let (inputs, outputs) = (inputs.map(reference::<M>), outputs.map(reference::<M>));
    let (set, get) = (Function::fmi2SetReal, Function::fmi2GetReal);
    let (n, ()) = allocations(|| {
        for k in 0..1000 {
            let t = f64::from(k) * 0.002;
            // From rest into saturation and, for the plant, to the wall and back.
            let values = [0.1 * (3.0 * t).sin(), 40.0 * (2.0 * t).sin()];
            let mut got = [0.0; 2];
            // SAFETY: arrays of two; the component is live and used by this thread only.
            unsafe {
                let (i, o) = (inputs.as_ptr(), outputs.as_ptr());
                assert_eq!(f::set::<M, f64>(c, set, i, 2, values.as_ptr()), Status::Ok);
                assert_eq!(f::do_step::<M>(c, t, 0.002, 1), Status::Ok);
                assert_eq!(f::get::<M, f64>(c, get, o, 2, got.as_mut_ptr()), Status::Ok);
            }
            assert!(got.iter().all(|value| value.is_finite()));
        }
    });
    // SAFETY: the component is live and not used again.
    unsafe { f::free_instance::<M>(c) };
    n
}

#[test]
fn set_step_and_get_of_the_controller_allocate_nothing() {
    let n = of_a_run::<TestbedController>(["q", "tau_h"], ["tau_a", "energy.G"]);
    assert_eq!(n, 0);
}

#[test]
fn set_step_and_get_of_the_testbed_allocate_nothing() {
    let n = of_a_run::<Testbed>(["tau_a", "tau_h"], ["q", "energy.residual"]);
    assert_eq!(n, 0);
}

#[test]
fn set_step_and_get_of_the_arms_fmus_allocate_nothing() {
    assert_eq!(
        of_a_run::<ArmController>(["q[1]", "f_h[3]"], ["tau_a[2]", "energy.G"]),
        0
    );
    assert_eq!(
        of_a_run::<ExoskeletonArm>(["tau_a[2]", "f_h[1]"], ["p[3]", "energy.residual"]),
        0
    );
    assert_eq!(
        of_a_run::<ExoskeletonArms>(
            ["left.tau_a[2]", "right.f_h[1]"],
            ["gap", "energy.residual"]
        ),
        0
    );
    assert_eq!(
        of_a_run::<HumanOperator>(["p[1]", "dp[1]"], ["f_h[1]", "f_h[3]"]),
        0
    );
}

#[test]
fn the_counter_sees_an_instance_and_a_single_box() {
    assert!(allocations(initialized::<TestbedController>).0 > 0);
    assert_eq!(
        allocations(|| drop(std::hint::black_box(Box::new(1_u8)))).0,
        2
    );
}
