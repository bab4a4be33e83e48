//! Choices, states and faults: the items of the variables that hold one of a list.

use crate::supervision::{Diagnostic, State};
use declaration::{Enumeration, Item};

pub use admittance::encoder::FAULT as ENCODER_FAULT;

/// `space`: the nominal is a mass at the handle.
pub const TASK: i32 = 1;
/// `space`: the nominal is an arm.
pub const JOINT: i32 = 2;
/// `ft.frame`: link 3's.
pub const LINK_3: i32 = 2;
/// `ft.source`: the wrench ft.force, ft.torque, in the frame of a sensor that ft.mount turns.
pub const WRENCH: i32 = 2;

const fn item(value: i32, name: &'static str, about: &'static str) -> Item {
    Item { value, name, about }
}

/// The type of `torque_limiting`.
pub const TORQUE_LIMITING: Enumeration = Enumeration {
    name: "TorqueLimiting",
    about: "How joint torques beyond tau_max are brought within",
    items: &[
        item(
            1,
            "scale",
            "all joints by one factor; the force at the handle keeps its direction",
        ),
        item(
            2,
            "clip",
            "each joint by itself; the force at the handle turns. Under the laws standard and passive only",
        ),
    ],
};

/// The type of `ft.frame`.
pub const FRAME: Enumeration = Enumeration {
    name: "Frame",
    about: "Frame in which the force sensor's components are given",
    items: &[
        item(1, "base", "base frame: x forward, y to the left, z up"),
        item(
            2,
            "sensor",
            "link 3's frame: x along the link, z up when the link is level; it turns with the link",
        ),
    ],
};

/// The type of `ft.source`.
pub const SOURCE: Enumeration = Enumeration {
    name: "Source",
    about: "Where the force of the human is read",
    items: &[
        item(1, "f_h", "the input f_h, a force in the frame ft.frame"),
        item(
            2,
            "wrench",
            "the inputs ft.force and ft.torque, in the frame of a six-axis sensor that ft.mount turns",
        ),
    ],
};

/// The type of `ft.fault`.
pub const FAULT: Enumeration = Enumeration {
    name: "SensorFault",
    about: "What is wrong with the force sensor; the law then sees no force",
    items: &[
        item(0, "none", "nothing"),
        item(1, "not_finite", "a component is NaN or infinite"),
        item(
            2,
            "over_range",
            "a component has reached the end of its range",
        ),
        item(
            3,
            "rate",
            "a component has changed faster than a hand can push",
        ),
        item(4, "stuck", "the reading no longer changes"),
        item(
            5,
            "dropout",
            "the reading is exactly 0, or the sensor says that it is invalid",
        ),
    ],
};

/// The type of `ft.tare_state`.
pub const TARE_STATE: Enumeration = Enumeration {
    name: "TareState",
    about: "How far the last tare has come",
    items: &[
        item(0, "off", "none was asked for"),
        item(
            1,
            "running",
            "samples are being taken; the law sees no force",
        ),
        item(2, "done", "ft.bias is that of the last tare"),
        item(
            3,
            "failed",
            "ft.bias is what it was before; ft.tare_failure says why",
        ),
    ],
};

/// The type of `ft.tare_failure`.
pub const TARE_FAILURE: Enumeration = Enumeration {
    name: "TareFailure",
    about: "Why the last tare failed",
    items: &[
        item(0, "none", "it did not"),
        item(1, "fault", "the sensor had a fault"),
        item(2, "moved", "a joint moved by more than ft.tare_motion"),
        item(
            3,
            "unsteady",
            "the reading scattered by more than ft.tare_spread_force or ft.tare_spread_torque",
        ),
        item(
            4,
            "too_large",
            "the bias would exceed ft.tare_max_force or ft.tare_max_torque: somebody leans on the handle",
        ),
    ],
};

/// `state`: shown in place of engaged and hold while the tank is below 0. The law deals with it, supervision does not.
pub const DEBT: i32 = 7;

/// The type of `state`: [`State`] by number, and [`DEBT`].
pub const STATE: Enumeration = Enumeration {
    name: "State",
    about: "What the controller is doing",
    items: &[
        item(
            State::Off.number(),
            State::Off.name(),
            "not enabled, no torque",
        ),
        item(
            State::Init.number(),
            State::Init.name(),
            "waits for good sensors and a heartbeat, no torque",
        ),
        item(
            State::Ready.number(),
            State::Ready.name(),
            "waits for a rising edge of engage, no torque",
        ),
        item(
            State::Engaged.number(),
            State::Engaged.name(),
            "the law runs",
        ),
        item(
            State::Hold.number(),
            State::Hold.name(),
            "the law runs with its nominal standing still",
        ),
        item(
            State::SoftStop.number(),
            State::SoftStop.name(),
            "the nominal stands still and the authority falls to 0",
        ),
        item(
            State::Fault.number(),
            State::Fault.name(),
            "waits for an acknowledgement, no torque",
        ),
        item(
            DEBT,
            "debt",
            "engaged or hold, but the tank is below 0: no torque until it is repaid",
        ),
    ],
};

/// The type of `diagnostic` and `first_fault`: [`Diagnostic`] by number.
pub const DIAGNOSTIC: Enumeration = Enumeration {
    name: "Diagnostic",
    about: "Why the law does not simply run; of several reasons the one with the smallest number",
    items: &[
        reason(Diagnostic::None, "the law runs or holds"),
        reason(Diagnostic::EmergencyStop, "fault: pressed"),
        reason(
            Diagnostic::EncoderInvalid,
            "fault: the joint angles have one, encoder.fault",
        ),
        reason(Diagnostic::NotFinite, "fault: the law's result is not"),
        reason(
            Diagnostic::HeartbeatLost,
            "fault: unchanged for heartbeat_timeout, or never changed",
        ),
        reason(
            Diagnostic::FtInvalid,
            "fault: the force sensor has one, ft.fault",
        ),
        reason(
            Diagnostic::EnergyDebt,
            "warning: no torque until the tank is repaid",
        ),
        reason(
            Diagnostic::OutsideBounds,
            "warning: motion beyond dq_max or ddq_max, or q is doubted, encoder.fault",
        ),
        reason(
            Diagnostic::Saturated,
            "warning: limits have acted for saturation_time",
        ),
        reason(
            Diagnostic::NotAcknowledged,
            "the fault's cause is gone; waits for a rising edge of acknowledge",
        ),
        reason(Diagnostic::NotEnabled, "enable is false"),
        reason(
            Diagnostic::Preparing,
            "sensors and heartbeat not yet good for init_time",
        ),
        reason(Diagnostic::NotEngaged, "engage is false"),
        reason(
            Diagnostic::EngageStuck,
            "engage has not risen since the controller was ready",
        ),
    ],
};

const fn reason(diagnostic: Diagnostic, about: &'static str) -> Item {
    item(diagnostic.number(), diagnostic.name(), about)
}

/// The type of `space`.
pub const SPACE: Enumeration = Enumeration {
    name: "Space",
    about: "Coordinates in which the nominal lives",
    items: &[
        item(
            1,
            "task",
            "the handle's: a mass Lambda_n at the handle, with D_n, K, K_P, f_max (eq:obs_dyn_cart)",
        ),
        item(
            2,
            "joint",
            "the joints': an arm of rigid links, nominal.*, with joint.D_n, joint.K, joint.K_P, tau_max (eq:obs_dyn)",
        ),
    ],
};
