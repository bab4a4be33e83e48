//! Shows at link time that no path of a tick panics: `cargo build --release -p arm-law --example no_panic`.
//!
//! Where the compiler cannot rule a panic out, `#[no_panic]` leaves a call of a function that does not exist, and the
//! linker says so. Without optimization it rules out little; the attribute is then left away. `cargo xtask law` builds
//! this in both precisions.
//!
//! What is called besides the tick checks parameters through pointers to functions, of which the compiler assumes the worst
//! where panics unwind. That no path panics there either is shown by the C library, in which they do not: it links
//! although the function that its panic handler calls does not exist.

#[cfg(not(feature = "f32"))]
use arm_law as law;
#[cfg(feature = "f32")]
use arm_law_f32 as law;

use admittance::ParameterError;
use admittance::one_axis::{self, AxisInputs, AxisOutputs, AxisParameters, OneAxis};
use law::arm_law::NotFinite;
use law::choices::{JOINT, TASK};
use law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use nalgebra::Vector3;
use std::hint::black_box;

#[cfg_attr(not(debug_assertions), no_panic::no_panic)]
#[inline(never)]
fn tick(arm: &mut ArmLaw, inputs: &ArmInputs, outputs: &mut ArmOutputs) -> Result<(), NotFinite> {
    arm.tick(inputs, outputs)
}

#[cfg_attr(not(debug_assertions), no_panic::no_panic)]
#[inline(never)]
fn tick_axis(
    axis: &mut OneAxis,
    inputs: &AxisInputs,
    outputs: &mut AxisOutputs,
) -> Result<(), one_axis::NotFinite> {
    axis.tick(inputs, outputs)
}

fn main() -> Result<(), ParameterError> {
    // What a program reads from outside, so that nothing is known when this is compiled.
    let parameters = black_box(ArmParameters {
        supervision: 1,
        ..ArmParameters::default()
    });
    let inputs = black_box(ArmInputs {
        f_h: [0.0, 0.0, -6.0],
        ..ArmInputs::default()
    });
    let mut outputs = ArmOutputs::default();
    for space in [TASK, JOINT] {
        let mut arm = ArmLaw::new(&black_box(ArmParameters {
            space,
            ..parameters
        }))?;
        arm.count_from(&Vector3::from(inputs.q).cast())?;
        tick(&mut arm, &inputs, &mut outputs).ok();
        black_box(&outputs);
        arm.tune(&parameters)?;
    }

    let parameters = black_box(AxisParameters::default());
    let inputs = black_box(AxisInputs {
        q: 0.3,
        tau_h: 0.3,
        ..AxisInputs::default()
    });
    let mut outputs = AxisOutputs::default();
    let mut axis = OneAxis::new(&parameters)?;
    tick_axis(&mut axis, &inputs, &mut outputs).ok();
    black_box(&outputs);
    axis.tune(&parameters)
}
