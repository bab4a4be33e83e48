//! 1e8 ticks, 55 hours at 500 Hz: nothing adds up.
use admittance::Real;
use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters, OneAxis};

include!("long/body.rs");
