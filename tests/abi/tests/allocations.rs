//! Steps do not allocate. The models are linked into this process, because an allocator counts its own process's
//! library only; the functions called are the generic ones behind the C symbols.

use catalogue::models::*;
use catalogue::table::SETTINGS;
use counting::{Counting, allocations};
use fmu_archive::Interface;
use fmu_archive::entry::Kind;
use fmu_declaration::{Causality, Stepping};
use fmu_export::ffi::fmi2::{CO_SIMULATION, Callbacks, Component, Status};
use fmu_export::functions as f;
use fmu_export::functions::fmi2::{self, kind};
use fmu_export::functions::fmi3;
use fmu_export::legality::fmi2::Function;
use fmu_export::model::Model;
use std::ffi::CString;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A silent instance, set up so that something happens ([`SETTINGS`]), and initialized.
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
        let c = fmi2::instantiate::<M>(n, CO_SIMULATION, g, location, &raw const callbacks, 0, 0);
        assert!(!c.is_null());
        for (reference, value) in settings::<M>() {
            let status = fmi2::set::<M, kind::Real>(
                c,
                Function::fmi2SetReal,
                &raw const reference,
                1,
                &raw const value,
            );
            assert_eq!(status, Status::Ok);
        }
        assert_eq!(
            f::enter_initialization_mode::<M>(c, Function::fmi2EnterInitializationMode),
            Status::Ok
        );
        assert_eq!(
            f::exit_initialization_mode::<M>(c, Function::fmi2ExitInitializationMode),
            Status::Ok
        );
        c
    }
}

/// The Reals among the settings.
fn settings<M: Model>() -> Vec<(u32, f64)> {
    let interface = Interface::of::<M>().expect("a legal declaration");
    let of_this_fmu = SETTINGS.iter().filter(|(fmu, ..)| *fmu == interface.name);
    let real = |name: &str| {
        let mut scalars = interface.scalars.iter();
        scalars.find(|s| s.name == name && matches!(s.kind, Kind::Real { .. }))
    };
    of_this_fmu
        .filter_map(|(_, name, value)| Some((real(name)?.reference, *value)))
        .collect()
}

/// Reals of a causality: value reference, start value, and how far an input moves about it, by its unit.
fn reals<M: Model>(causality: Causality) -> Vec<(u32, f64, f64)> {
    let interface = Interface::of::<M>().expect("a legal declaration");
    let wanted = interface.scalars.into_iter();
    wanted
        .filter(|entry| entry.causality == causality)
        .filter_map(|entry| match entry.kind {
            Kind::Real { unit, start, .. } => {
                let force = ["N", "N.m"].contains(&unit.name);
                Some((entry.reference, start, if force { 40.0 } else { 0.1 }))
            }
            _ => None,
        })
        .collect()
}

/// Allocations of 1000 times set, step, get of all Real inputs and outputs.
fn of_a_run<M: Model>() -> u64 {
    let c = initialized::<M>();
    let (inputs, outputs) = (reals::<M>(Causality::Input), reals::<M>(Causality::Output));
    let references = |block: &[(u32, f64, f64)]| -> Vec<u32> {
        block.iter().map(|(reference, ..)| *reference).collect()
    };
    let (set, get) = (Function::fmi2SetReal, Function::fmi2GetReal);
    let (i, o) = (references(&inputs), references(&outputs));
    let (mut values, mut got) = (vec![0.0; i.len()], vec![0.0; o.len()]);
    assert!(!i.is_empty() && !o.is_empty());
    let mut moved = false;
    let (n, ()) = allocations(|| {
        for k in 0..1000 {
            let t = f64::from(k) * 0.002;
            // From rest into saturation and, for the plants, to the wall or the stops and back.
            for (value, (_, start, swing)) in values.iter_mut().zip(&inputs) {
                let frequency = if *swing > 1.0 { 2.0 } else { 3.0 };
                *value = start + swing * (frequency * t).sin();
            }
            let before: f64 = got.iter().sum();
            // SAFETY: arrays of the lengths that are passed; the component is live and used by this thread only.
            unsafe {
                let status =
                    fmi2::set::<M, kind::Real>(c, set, i.as_ptr(), i.len(), values.as_ptr());
                assert_eq!(status, Status::Ok);
                assert_eq!(f::step::<M>(c, t, 0.002), Status::Ok);
                let status =
                    fmi2::get::<M, kind::Real>(c, get, o.as_ptr(), o.len(), got.as_mut_ptr());
                assert_eq!(status, Status::Ok);
            }
            assert!(got.iter().all(|value| value.is_finite()));
            moved |= k > 0 && before != got.iter().sum::<f64>();
        }
    });
    assert!(moved, "{}", M::DESCRIPTION.name);
    // SAFETY: the component is live and not used again.
    unsafe { f::free_instance::<M>(c) };
    n
}

macro_rules! of_each_run {
    ($($crate_name:ident::$Type:ident, picture $picture:literal;)*) => {
        [$((stringify!($Type), of_a_run::<$crate_name::$Type>())),*]
    };
}

#[test]
fn set_step_and_get_of_any_fmu_allocate_nothing() {
    for (name, allocations) in fmus::each!(of_each_run) {
        assert_eq!(allocations, 0, "{name}");
    }
}

#[test]
fn the_counter_sees_an_instance_and_a_single_box() {
    assert!(allocations(initialized::<testbed::Testbed>).0 > 0);
    assert_eq!(
        allocations(|| drop(std::hint::black_box(Box::new(1_u8)))).0,
        2
    );
}

/// Allocations of 1000 times set, step, get of all Real inputs and outputs by FMI 3.0; an activation is a step where the
/// model has a sample period.
fn of_a_run_by_fmi_3<M: Model>(scheduled: bool) -> u64 {
    use fmu_export::ffi::fmi3::Logger;
    use fmu_export::legality::fmi3::Function as F;
    let token = CString::new(M::DESCRIPTION.guid()).expect("no null byte");
    let common = fmi3::Common {
        name: c"name".as_ptr(),
        token: token.as_ptr(),
        resources: std::ptr::null(),
        logging: 0,
        logger: Logger {
            log_message: None,
            environment: std::ptr::null_mut(),
        },
    };
    // SAFETY: all pointers outlive the call; the component is used by this thread only.
    let c = unsafe {
        let c = match scheduled {
            true => fmi3::instantiate_scheduled_execution::<M>(common),
            false => fmi3::instantiate_co_simulation::<M>(common, 0, 0),
        };
        assert!(!c.is_null());
        let entered = fmi3::enter_initialization_mode::<M>(c, 0, 0.0, 0.0, 0, 0.0);
        assert_eq!(entered, Status::Ok);
        let left = f::exit_initialization_mode::<M>(c, F::fmi3ExitInitializationMode);
        assert_eq!(left, Status::Ok);
        c
    };
    let rows = |causality| -> (Vec<u32>, usize) {
        let scalars = reals::<M>(causality);
        let first = scalars
            .iter()
            .filter(|(reference, ..)| reference % 256 == 0);
        (
            first.map(|(reference, ..)| *reference).collect(),
            scalars.len(),
        )
    };
    let ((i, inputs), (o, outputs)) = (rows(Causality::Input), rows(Causality::Output));
    let (mut values, mut got) = (vec![0.0; inputs], vec![0.0; outputs]);
    let period = M::DESCRIPTION.experiment.step;
    let (mut event, mut terminate, mut early, mut last) = (7, 7, 7, 0.0);
    let (n, ()) = allocations(|| {
        for k in 0..1000 {
            let t = last;
            values.fill(0.01 * (f64::from(k) * period).sin());
            // SAFETY: arrays of the lengths that are passed; the component is live and used by this thread only.
            unsafe {
                let (set, get) = (F::fmi3SetFloat64, F::fmi3GetFloat64);
                let (vr, v) = (i.as_ptr(), values.as_ptr());
                let status = fmi3::set::<M, fmi3::kind::Float64>(c, set, vr, i.len(), v, inputs);
                assert_eq!(status, Status::Ok);
                let status = if scheduled {
                    last = f64::from(k + 1) * period;
                    fmi3::activate_model_partition::<M>(c, 0xFFFF_FFFE, t)
                } else {
                    let (e, t1, r, l) = (
                        &raw mut event,
                        &raw mut terminate,
                        &raw mut early,
                        &raw mut last,
                    );
                    fmi3::do_step::<M>(c, t, period, 1, e, t1, r, l)
                };
                assert_eq!(status, Status::Ok);
                let (vr, v) = (o.as_ptr(), got.as_mut_ptr());
                let status = fmi3::get::<M, fmi3::kind::Float64>(c, get, vr, o.len(), v, outputs);
                assert_eq!(status, Status::Ok);
            }
        }
    });
    // What the models do in a step is that of the test above; here it is enough that the steps were made.
    let (time, mut reached) = (0xFFFF_FFFF, 0.0);
    // SAFETY: pointers to locals; the component is live.
    let status = unsafe {
        let get = F::fmi3GetFloat64;
        fmi3::get::<M, fmi3::kind::Float64>(c, get, &raw const time, 1, &raw mut reached, 1)
    };
    assert_eq!(status, Status::Ok);
    let begin = if scheduled { period } else { 0.0 };
    let expected = 1000.0 * period - begin;
    assert!((reached - expected).abs() < 1e-9, "{reached} {expected}");
    // SAFETY: the component is live and not used again.
    unsafe { f::free_instance::<M>(c) };
    n
}

macro_rules! of_each_run_by_fmi_3 {
    ($($crate_name:ident::$Type:ident, picture $picture:literal;)*) => {
        [$({
            use fmu_declaration::Declare;
            let sampled = $crate_name::$Type::DESCRIPTION.stepping == Stepping::Sampled;
            let steps = of_a_run_by_fmi_3::<$crate_name::$Type>(false);
            let activations = if sampled { of_a_run_by_fmi_3::<$crate_name::$Type>(true) } else { 0 };
            (stringify!($Type), steps, activations)
        }),*]
    };
}

#[test]
fn steps_and_activations_by_fmi_3_allocate_nothing() {
    for (name, steps, activations) in fmus::each!(of_each_run_by_fmi_3) {
        assert_eq!((steps, activations), (0, 0), "{name}");
    }
}
