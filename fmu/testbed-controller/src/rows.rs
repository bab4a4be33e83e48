//! One row per variable.

use crate::TestbedController;
use declaration::Variability::{Discrete, Fixed, Tunable};
use declaration::{
    Declare, Description, Enumeration, Experiment, Item, Stepping, boolean, enumeration, integer,
    real, unit,
};

/// The type of `law`.
pub const LAW: Enumeration = Enumeration {
    name: "Law",
    about: "Admittance law: which reaction the nominal feels once the force is limited",
    items: &[
        Item {
            value: 1,
            name: "standard",
            about: "admittance filter alone, no reaction on the nominal; sticks to walls",
        },
        Item {
            value: 2,
            name: "passive",
            about: "the paper's law: the nominal feels the unlimited coupling; creates energy once saturated",
        },
        Item {
            value: 3,
            name: "passive_applied",
            about: "the nominal feels the limited force; passive, but the spring winds up and sticks",
        },
        Item {
            value: 4,
            name: "passive_bounded",
            about: "the nominal feels the limited force and the spring slips at the limit; passive and bounded",
        },
        Item {
            value: 5,
            name: "natural",
            about: "natural admittance control (Dohring and Newman), to compare with: comparator.M in place of M_n; sticks to walls",
        },
        Item {
            value: 6,
            name: "sliding_mode",
            about: "sliding-mode position control under a standard proxy (Kikuuwe), to compare with; sticks to walls",
        },
    ],
};

/// The type of `form`.
pub const FORM: Enumeration = Enumeration {
    name: "Form",
    about: "What the robot gets from the controller",
    items: &[
        Item {
            value: 1,
            name: "torque",
            about: "the force tau_a",
        },
        Item {
            value: 2,
            name: "position_servo",
            about: "q_d and dq_d, for a drive that closes the loop with K and K_P itself; needs tau_a_measured",
        },
    ],
};

/// Smallest accepted sample period, gain or mass, in SI units: what lies below is a mistake in a unit. The law itself
/// asks for values greater than 0.
const SMALLEST: f64 = 1e-6;

impl Declare for TestbedController {
    const DESCRIPTION: Description<Self> = Description {
        name: "TestbedController",
        about: "Passivity-based admittance control of the one-axis testbed",
        stepping: Stepping::Sampled,
        experiment: Experiment { start: 0.0, stop: 60.0, tolerance: 1e-6, step: 0.002 },
        variables: &[
            real!(q, unit::METRE)
                .input(Discrete)
                .about("Sensed position of the robot; the wall lies on the positive side"),
            real!(tau_h, unit::NEWTON)
                .input(Discrete)
                .about("Sensed force of the human on the robot, positive along q"),
            boolean!(engage).input(Discrete).about(
                "Whether the controller is in the loop. It engages at the first tick at which this is true, with q_n = q and \
                 dq_n = 0; while it is false tau_a is 0",
            ),
            real!(tau_a, unit::NEWTON)
                .output(Discrete)
                .about("Control force on the robot, positive along q, held until the next tick (eq:dob_input, limited)"),
            real!(q_n, unit::METRE)
                .output(Discrete)
                .initially_from(&["q"])
                .about("Nominal position (eq:obs_dyn)"),
            real!(dq_n, unit::METRE_PER_SECOND).output(Discrete).about("Nominal velocity (eq:obs_dyn)"),
            real!(e_nr, unit::METRE).output(Discrete).about("Position error q_n - q, after the slip of passive_bounded"),
            boolean!(saturated).output(Discrete).about("Whether tau_max leaves less than tau_demand"),
            integer!(tick)
                .output(Discrete)
                .about("Number of the tick that the outputs belong to, at startTime + tick*T; -1 before the first one"),
            real!(energy.H, unit::JOULE)
                .output(Discrete)
                .about("Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined"),
            real!(energy.G, unit::JOULE)
                .output(Discrete)
                .about("Energy that the sampled law has created so far, negative: dissipated; 0 if alpha = 0"),
            real!(energy.tank, unit::JOULE)
                .output(Discrete)
                .initially_from(&["energy.E_0", "alpha", "law"])
                .about(
                    "Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0 and \
                     under the laws natural and sliding_mode, for which no energy is defined",
                ),
            real!(dq, unit::METRE_PER_SECOND)
                .output(Discrete)
                .about("Velocity of the robot as the law uses it: backward difference of q, 0 at the first tick"),
            real!(tau_demand, unit::NEWTON).output(Discrete).about("K*y before any limit (eq:dob_input)"),
            boolean!(engaged).output(Discrete).about("Whether the controller was in the loop at this tick"),
            boolean!(outside_bounds).output(Discrete).about(
                "Whether the motion since the last tick exceeded v_max or a_max, to which the passivity argument is restricted",
            ),
            enumeration!(law, &LAW).parameter(Fixed).about("Admittance law"),
            real!(M_n, unit::KILOGRAM)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Nominal mass (eq:nom_dyn)"),
            real!(D_n, unit::NEWTON_SECOND_PER_METRE)
                .parameter(Tunable)
                .at_least(0.0)
                .about("Nominal damping (eq:nom_dyn)"),
            real!(K, unit::NEWTON_SECOND_PER_METRE)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Control gain, 1/epsilon of the paper (eq:dob_input)"),
            real!(K_P, unit::PER_SECOND)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Ratio of the coupling's spring to its damper (eq:dob_input)"),
            real!(alpha, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed).at_least(0.0).about(
                "Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn",
            ),
            real!(tau_max, unit::NEWTON)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Largest absolute value of tau_a; also the bound of the coupling spring's force under passive_bounded"),
            real!(T, unit::SECOND).parameter(Fixed).at_least(SMALLEST).about("Sample period"),
            integer!(delay).parameter(Fixed).within_integers(0, 1).about(
                "Samples by which the importer's wiring delays tau_a, its first value being 0; it changes no force, only in which \
                 sample the ledger counts a force's work",
            ),
            real!(energy.E_0, unit::JOULE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Energy with which the tank starts and above which it does not fill"),
            real!(v_max, unit::METRE_PER_SECOND)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Largest speed of the robot: the energy budget covers every motion within it"),
            real!(a_max, unit::METRE_PER_SECOND_SQUARED)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Largest acceleration of the robot: the energy budget covers every motion within it"),
            real!(dq_cutoff, unit::HERTZ)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Corner frequency of a first-order low pass on dq; 0 = off"),
            real!(M_min, unit::KILOGRAM).parameter(Fixed).at_least(SMALLEST).about(
                "Lightest effective mass that the robot shows, for gain_warning only",
            ),
            integer!(gain_warning).output(Discrete).initially_from(&["M_min", "M_n", "K", "T"]).about(
                "Gains that are accepted but probably not meant: 0 none, 1 K*T/M_min above 0.25, 2 M_n below M_min/10, 3 both",
            ),
            real!(tau_a_measured, unit::NEWTON).input(Discrete).about(
                "Measured force of the drive on the robot, mean over the sample that ended, positive along q; the nominal feels \
                 it in the servo form, it is not used in the torque form",
            ),
            real!(q_d, unit::METRE).output(Discrete).initially_from(&["q"]).about(
                "Position command for the sample that begins, held: the nominal's in the middle of that sample; q_n in the torque \
                 form",
            ),
            real!(dq_d, unit::METRE_PER_SECOND)
                .output(Discrete)
                .about("Velocity command for the sample that begins: the nominal's mean in that sample; dq_n in the torque form"),
            enumeration!(form, &FORM).parameter(Fixed).about("What the robot gets from the controller"),
            real!(comparator.M, unit::KILOGRAM)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Mass of the robot, for the law natural only"),
            real!(comparator.H, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time constant of the sliding surface, for the law sliding_mode only"),
            boolean!(hold).input(Discrete).about(
                "Whether the nominal stays where it is: the coupling then carries any load within tau_max without drift; the laws 1 to \
                 4 in torque form only",
            ),
            boolean!(held)
                .output(Discrete)
                .about("Whether hold, dq_n_max or the position box kept the nominal back at this tick"),
            real!(energy.share, unit::NONE).output(Discrete).about(
                "Share of the force that the energy budget left at this tick; 1 unless something is wrong",
            ),
            boolean!(energy.debt).output(Discrete).about(
                "Whether the tank is below 0: a motion beyond v_max and a_max cost more than it held; no force until it is repaid",
            ),
            real!(tuning_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time in which changed gains come into force, on a straight line; 0 = at once"),
            real!(dq_n_max, unit::METRE_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Largest speed of the nominal; 0 = no limit"),
            boolean!(q_n_box)
                .parameter(Fixed)
                .about("Whether the nominal keeps within q_n_min and q_n_max"),
            real!(q_n_min, unit::METRE)
                .parameter(Fixed)
                .about("Least position of the nominal"),
            real!(q_n_max, unit::METRE)
                .parameter(Fixed)
                .about("Largest position of the nominal"),
            real!(tau_rate_max, unit::NEWTON_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Largest rate of change of tau_a while the controller is in the loop; 0 = no limit"),
        ],
    };
}
