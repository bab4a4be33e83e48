//! 1e8 ticks in single precision, 55 hours at 500 Hz: nothing adds up.
use admittance_f32::Real;
use admittance_f32::one_axis::{AxisInputs, AxisOutputs, AxisParameters, OneAxis};

include!("../../tests/long/body.rs");
