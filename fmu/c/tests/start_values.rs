//! The start values are those of the FMUs, and each variable lies where the library says: read there by name, it is the
//! FMU's of that name.

#![allow(non_snake_case, reason = "FMU in names of tests")]

use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters};
use arm_controller::ArmController;
use arm_law::{ArmInputs, ArmOutputs, ArmParameters};
use exo_law::arm::{exo_arm_defaults, exo_arm_inputs_defaults, exo_arm_variable};
use exo_law::axis::{exo_axis_defaults, exo_axis_inputs_defaults, exo_axis_variable};
use exo_law::refusal::Status;
use exo_law::variable::{Kind, Role, Variable};
use fmu_declaration::{Access, Causality, Declare};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::CStr;
use std::mem::{MaybeUninit, size_of};
use testbed_controller::TestbedController;

/// Values by the FMU's names, an integer or a Boolean as a number.
type Values = BTreeMap<String, f64>;

/// What the library wrote, as a program finds it that knows the descriptions only.
fn found(
    describe: extern "C" fn(usize, *mut Variable) -> Status,
    structs: &[(Role, &[u8])],
) -> Values {
    let mut values = Values::new();
    for i in 0.. {
        let mut variable = MaybeUninit::uninit();
        match describe(i, variable.as_mut_ptr()) {
            Status::Ok => {}
            status => {
                assert_eq!(status, Status::NoSuchVariable);
                break;
            }
        }
        // SAFETY: it has been written.
        let variable: Variable = unsafe { variable.assume_init() };
        // SAFETY: the library ends its texts with a zero.
        let name = unsafe { CStr::from_ptr(variable.name.as_ptr()) };
        let name = name.to_str().expect("UTF-8");
        let Some((_, bytes)) = structs.iter().find(|(role, _)| *role == variable.role) else {
            continue;
        };
        for element in 0..variable.count as usize {
            let at = &bytes[variable.offset + element * variable.stride..];
            let value = match variable.kind {
                Kind::Real | Kind::Double => f64::from_ne_bytes(at[..8].try_into().expect("8")),
                Kind::Integer => i32::from_ne_bytes(at[..4].try_into().expect("4")).into(),
            };
            let name = match variable.count {
                1 => name.to_owned(),
                _ => format!("{name}[{}]", element + 1),
            };
            assert!(values.insert(name.clone(), value).is_none(), "{name} twice");
        }
    }
    values
}

/// The FMU's inputs and parameters.
fn of_the_fmu<M: Declare + Default>() -> Values {
    let start = M::default();
    let scalars = M::DESCRIPTION.scalars().filter(|scalar| {
        matches!(
            scalar.variable.causality,
            Causality::Input | Causality::Parameter
        )
    });
    scalars
        .map(|scalar| {
            let value = match scalar.variable.access {
                Access::Real { at, .. } => at.get(&start, scalar.element),
                Access::Integer { at, .. } | Access::Enumeration { at, .. } => {
                    at.get(&start, scalar.element).into()
                }
                Access::Boolean { at } => u8::from(at.get(&start, scalar.element)).into(),
                Access::Wide { .. } | Access::String { .. } | Access::Binary { .. } => {
                    panic!("no such value here")
                }
            };
            (scalar.name(), value)
        })
        .collect()
}

/// A struct as `write` leaves it, which begins as bytes that are no start value.
fn written<T>(write: extern "C" fn(*mut T) -> Status) -> Vec<u8> {
    let mut of = Box::<T>::new_uninit();
    // SAFETY: as many bytes as it has.
    unsafe { of.as_mut_ptr().write_bytes(0xA5, 1) };
    assert_eq!(write(of.as_mut_ptr()), Status::Ok);
    // SAFETY: every byte has been written, padding by the line before.
    unsafe { std::slice::from_raw_parts(of.as_ptr().cast::<u8>(), size_of::<T>()) }.to_vec()
}

/// Asserts that the library's values are the FMU's, but for those `without`, which the law of the library has not.
fn equal(library: &Values, fmu: &Values, without: &[&str]) {
    for (name, value) in library {
        assert_eq!(fmu.get(name), Some(value), "{name}");
    }
    let missing: BTreeSet<_> = fmu
        .keys()
        .filter(|name| !library.contains_key(*name))
        .collect();
    let without: BTreeSet<_> = without.iter().map(ToString::to_string).collect();
    assert_eq!(missing, without.iter().collect());
}

#[test]
fn the_arm_starts_with_the_values_of_its_FMU() {
    let library = found(
        exo_arm_variable,
        &[
            (Role::Parameter, &written::<ArmParameters>(exo_arm_defaults)),
            (Role::Input, &written::<ArmInputs>(exo_arm_inputs_defaults)),
        ],
    );
    equal(&library, &of_the_fmu::<ArmController>(), &[]);
}

#[test]
fn one_axis_starts_with_the_values_of_its_FMU() {
    let library = found(
        exo_axis_variable,
        &[
            (
                Role::Parameter,
                &written::<AxisParameters>(exo_axis_defaults),
            ),
            (
                Role::Input,
                &written::<AxisInputs>(exo_axis_inputs_defaults),
            ),
        ],
    );
    // The comparators are the FMU's alone.
    let without = ["comparator.M", "comparator.H"];
    equal(&library, &of_the_fmu::<TestbedController>(), &without);
}

/// Every byte of a struct belongs to one variable at most, and those of the outputs are found, too.
#[test]
fn variables_do_not_overlap_and_lie_within_their_structs() {
    let sizes = |role, sizes: [usize; 3]| match role {
        Role::Parameter => sizes[0],
        Role::Input => sizes[1],
        Role::Output => sizes[2],
    };
    let arm = [
        size_of::<ArmParameters>(),
        size_of::<ArmInputs>(),
        size_of::<ArmOutputs>(),
    ];
    let axis = [
        size_of::<AxisParameters>(),
        size_of::<AxisInputs>(),
        size_of::<AxisOutputs>(),
    ];
    for (describe, of) in [
        (
            exo_arm_variable as extern "C" fn(usize, *mut Variable) -> Status,
            arm,
        ),
        (exo_axis_variable, axis),
    ] {
        let mut taken = BTreeSet::new();
        let mut bytes = [0; 3];
        for i in 0.. {
            let mut variable = MaybeUninit::uninit();
            if describe(i, variable.as_mut_ptr()) != Status::Ok {
                break;
            }
            // SAFETY: it has been written.
            let variable: Variable = unsafe { variable.assume_init() };
            let size = if variable.kind == Kind::Integer { 4 } else { 8 };
            for element in 0..variable.count as usize {
                let from = variable.offset + element * variable.stride;
                assert!(from + size <= sizes(variable.role, of), "variable {i}");
                for byte in from..from + size {
                    assert!(taken.insert((variable.role as i32, byte)), "variable {i}");
                }
                bytes[variable.role as usize] += size;
            }
        }
        // All but padding, of which a struct has 4 bytes at each change from integers to numbers at most.
        for (named, size) in bytes.into_iter().zip(of) {
            assert!(
                named <= size && (named > size * 9 / 10 || size - named <= 4),
                "{named} of {size} bytes"
            );
        }
    }
}
