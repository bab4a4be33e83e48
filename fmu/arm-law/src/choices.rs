//! Choices, states and faults: the items of the variables that hold one of a list.

use crate::supervision::{Diagnostic, State};
use fmu_declaration::{Enumeration, Item, choices};

pub use admittance::encoder::FAULT as ENCODER_FAULT;
pub use admittance::one_axis::form::{FORM, POSITION_SERVO, TORQUE};
pub use admittance::servo::FAULT as DRIVE_FAULT;

choices! { TORQUE_LIMITING "TorqueLimiting" "How joint torques beyond tau_max are brought within":
    1 "scale" "all joints by one factor; the force at the handle keeps its direction";
    2 "clip" "each joint by itself; the force at the handle turns. Under the laws standard and passive only";
}

choices! { FRAME "Frame" "Frame in which the force sensor's components are given":
    1 "base" "base frame: x forward, y to the left, z up";
    LINK_3 = 2 "sensor" "link 3's frame: x along the link, z up when the link is level; it turns with the link";
}

choices! { SOURCE "Source" "Where the force of the human is read":
    1 "f_h" "the input f_h, a force in the frame ft.frame";
    WRENCH = 2 "wrench" "the inputs ft.force and ft.torque, in the frame of a six-axis sensor that ft.mount turns";
}

choices! { FAULT "SensorFault" "What is wrong with the force sensor; the law then sees no force":
    0 "none" "nothing";
    1 "not_finite" "a component is NaN or infinite";
    2 "over_range" "a component has reached the end of its range";
    3 "rate" "a component has changed faster than a hand can push";
    4 "stuck" "the reading no longer changes";
    5 "dropout" "the reading is exactly 0, or the sensor says that it is invalid";
}

choices! { TARE_STATE "TareState" "How far the last tare has come":
    0 "off" "none was asked for";
    1 "running" "samples are being taken; the law sees no force";
    2 "done" "ft.bias is that of the last tare";
    3 "failed" "ft.bias is what it was before; ft.tare_failure says why";
}

choices! { TARE_FAILURE "TareFailure" "Why the last tare failed":
    0 "none" "it did not";
    1 "fault" "the sensor had a fault";
    2 "moved" "a joint moved by more than ft.tare_motion";
    3 "unsteady" "the reading scattered by more than ft.tare_spread_force or ft.tare_spread_torque";
    4 "too_large" "the bias would exceed ft.tare_max_force or ft.tare_max_torque: somebody leans on the handle";
}

/// `state`: shown in place of engaged and hold while the tank is below 0. The law deals with it, supervision does not.
pub const DEBT: i32 = 7;

/// The type of `state`: [`State`] by number, and [`DEBT`].
#[rustfmt::skip] // a table
pub const STATE: Enumeration = Enumeration {
    name: "State",
    about: "What the controller is doing",
    items: &[
        state(State::Off, "not enabled, no torque"),
        state(State::Init, "waits for good sensors and a heartbeat, no torque"),
        state(State::Ready, "waits for a rising edge of engage, no torque"),
        state(State::Engaged, "the law runs"),
        state(State::Hold, "the law runs with its nominal standing still"),
        state(State::SoftStop, "the nominal stands still and the authority falls to 0"),
        state(State::Fault, "waits for an acknowledgement, no torque"),
        Item::new(DEBT, "debt", "engaged or hold, but the tank is below 0: no torque, or drives that stand still, until it is repaid"),
    ],
};

/// The type of `diagnostic` and `first_fault`: [`Diagnostic`] by number.
#[rustfmt::skip] // a table
pub const DIAGNOSTIC: Enumeration = Enumeration {
    name: "Diagnostic",
    about: "Why the law does not simply run; of several reasons a fault, else the one with the smallest number",
    items: &[
        reason(Diagnostic::None, "the law runs or holds"),
        reason(Diagnostic::EmergencyStop, "fault: pressed"),
        reason(Diagnostic::EncoderInvalid, "fault: the joint angles have one, encoder.fault"),
        reason(Diagnostic::NotFinite, "fault: the law's result is not"),
        reason(Diagnostic::HeartbeatLost, "fault: unchanged for heartbeat_timeout, or never changed"),
        reason(Diagnostic::FtInvalid, "fault: the force sensor has one, ft.fault"),
        reason(Diagnostic::EnergyDebt, "warning: no torque until the tank is repaid"),
        reason(Diagnostic::OutsideBounds, "warning: motion beyond dq_max or ddq_max, or q is doubted, encoder.fault"),
        reason(Diagnostic::Saturated, "warning: limits have acted for saturation_time"),
        reason(Diagnostic::NotAcknowledged, "the fault's cause is gone; waits for a rising edge of acknowledge"),
        reason(Diagnostic::NotEnabled, "enable is false"),
        reason(Diagnostic::Preparing, "sensors and heartbeat not yet good for init_time"),
        reason(Diagnostic::NotEngaged, "engage is false"),
        reason(Diagnostic::EngageStuck, "engage has not risen since the controller was ready"),
        reason(Diagnostic::ForceSteady, "warning, or fault after drift_stop_time: nobody varies the force of the hand, drift_distance"),
        reason(Diagnostic::ToolWeight, "the same, and the force is what a wrong ft.mass leaves, ft.mass_error"),
    ],
};

choices! { SPACE "Space" "Coordinates in which the nominal lives":
    TASK = 1 "task" "the handle's: a mass Lambda_n at the handle, with D_n, K, K_P, f_max (eq:obs_dyn_cart)";
    JOINT = 2 "joint" "the joints': an arm of rigid links, nominal.*, with joint.D_n, joint.K, joint.K_P, tau_max (eq:obs_dyn)";
}

const fn state(state: State, about: &'static str) -> Item {
    Item::new(state.number(), state.name(), about)
}

const fn reason(diagnostic: Diagnostic, about: &'static str) -> Item {
    Item::new(diagnostic.number(), diagnostic.name(), about)
}
