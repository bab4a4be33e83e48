//! One row per variable.

use crate::ArmController;
use crate::enumerations::{
    DIAGNOSTIC, FAULT, FRAME, LAW, SOURCE, SPACE, STATE, TARE_FAILURE, TARE_STATE, TORQUE_LIMITING,
};
use declaration::Variability::{Discrete, Fixed, Tunable};
use declaration::{
    Declare, Description, Experiment, Stepping, boolean, enumeration, integer, real, unit,
};

/// Smallest accepted sample period, gain, mass or limit, in SI units: what lies below is a mistake in a unit. The law
/// itself asks for values greater than 0.
const SMALLEST: f64 = 1e-6;

impl Declare for ArmController {
    const DESCRIPTION: Description<Self> = Description {
        name: "ArmController",
        about: "Passivity-based admittance control at the handle of the exoskeleton arm",
        stepping: Stepping::Sampled,
        experiment: Experiment { start: 0.0, stop: 60.0, tolerance: 1e-6, step: 0.001 },
        variables: &[
            real!(q[3], unit::RADIAN).input(Discrete).about(
                "Sensed joint angles: yaw about z, shoulder pitch and elbow pitch about -y, so that positive pitch lifts",
            ),
            real!(f_h[3], unit::NEWTON).input(Discrete).may_be_nan().about(
                "Sensed force of the human on the handle, in the frame that ft.frame says, under ft.source 1. It may be NaN, \
                 which ft.fault names",
            ),
            boolean!(engage).input(Discrete).about(
                "Whether the controller is in the loop. It engages at the first tick at which this is true, with p_n = p and \
                 dp_n = 0; while it is false tau_a is 0",
            ),
            real!(tau_a[3], unit::NEWTON_METRE)
                .output(Discrete)
                .about("Control torques on the joints, positive like q, held until the next tick (J' f_a, limited)"),
            real!(p[3], unit::METRE)
                .output(Discrete)
                .initially_from(WHERE)
                .about("Position of the handle by the controller's kinematics; base frame"),
            real!(p_n[3], unit::METRE)
                .output(Discrete)
                .initially_from(WHERE)
                .about("Nominal position of the handle (eq:obs_dyn); base frame"),
            real!(dp_n[3], unit::METRE_PER_SECOND)
                .output(Discrete)
                .about("Nominal velocity of the handle (eq:obs_dyn); base frame"),
            real!(e_nr[3], unit::METRE)
                .output(Discrete)
                .about("Position error p_n - p, after the slip of passive_bounded; base frame"),
            real!(f_a[3], unit::NEWTON).output(Discrete).about(
                "Force on the robot at the handle that tau_a amounts to (eq:dob_input, limited); base frame",
            ),
            boolean!(saturated)
                .output(Discrete)
                .about("Whether f_max (under passive_bounded) or tau_max leaves less than tau_demand"),
            real!(sigma_min, unit::METRE_PER_RADIAN)
                .output(Discrete)
                .initially_from(WHERE)
                .about("Smallest singular value of the handle's Jacobian; 0 at a singularity"),
            integer!(tick)
                .output(Discrete)
                .about("Number of the tick that the outputs belong to, at startTime + tick*T; -1 before the first one"),
            real!(energy.H, unit::JOULE)
                .output(Discrete)
                .about("Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined"),
            real!(energy.G, unit::JOULE).output(Discrete).about(
                "Energy that the sampled law has created so far, counted with the work of tau_a at the joints; negative: \
                 dissipated; 0 if alpha = 0",
            ),
            real!(energy.tank, unit::JOULE)
                .output(Discrete)
                .initially_from(&["energy.E_0", "alpha"])
                .about("Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0"),
            real!(dp[3], unit::METRE_PER_SECOND).output(Discrete).about(
                "Velocity of the handle as the law uses it: backward difference of p, 0 at the first tick; base frame",
            ),
            real!(tau_demand[3], unit::NEWTON_METRE)
                .output(Discrete)
                .about("Joint torques J' K y before any limit (eq:dob_input)"),
            boolean!(engaged).output(Discrete).about("Whether the controller was in the loop at this tick"),
            boolean!(outside_bounds).output(Discrete).about(
                "Whether the joints' motion since the last tick exceeded dq_max or ddq_max, to which the passivity argument is \
                 restricted",
            ),
            boolean!(slowed)
                .output(Discrete)
                .about("Whether sigma_min lies below singularity.sigma_slow, so that the nominal is damped more"),
            enumeration!(law, &LAW).parameter(Fixed).about("Admittance law"),
            real!(Lambda_n[3], unit::KILOGRAM)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Nominal mass along x, y, z (eq:nom_dyn in task space)"),
            real!(D_n[3], unit::NEWTON_SECOND_PER_METRE)
                .parameter(Tunable)
                .at_least(0.0)
                .about("Nominal damping along x, y, z (eq:nom_dyn in task space)"),
            real!(K[3], unit::NEWTON_SECOND_PER_METRE)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Control gain along x, y, z, 1/epsilon of the paper (eq:dob_input)"),
            real!(K_P[3], unit::PER_SECOND)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Ratio of the coupling's spring to its damper along x, y, z (eq:dob_input)"),
            real!(alpha, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed).at_least(0.0).about(
                "Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn",
            ),
            real!(f_max[3], unit::NEWTON).parameter(Tunable).at_least(SMALLEST).about(
                "Largest force of the controller along x, y, z and bound of the coupling spring's force, under passive_bounded; \
                 the other laws have no limit but tau_max",
            ),
            real!(tau_max[3], unit::NEWTON_METRE)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Largest absolute value of tau_a"),
            enumeration!(torque_limiting, &TORQUE_LIMITING)
                .parameter(Fixed)
                .about("How joint torques beyond tau_max are brought within; clip under the laws standard and passive only"),
            real!(T, unit::SECOND).parameter(Fixed).at_least(SMALLEST).about("Sample period"),
            integer!(delay).parameter(Fixed).within_integers(0, 1).about(
                "Samples by which the importer's wiring delays tau_a, its first value being 0; it changes no torque, only in which \
                 sample the ledger counts a torque's work",
            ),
            real!(energy.E_0, unit::JOULE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Energy with which the tank starts and above which it does not fill"),
            real!(dq_max[3], unit::RADIAN_PER_SECOND).parameter(Fixed).at_least(SMALLEST).about(
                "Largest speed of the joints: the energy budget covers every motion within it",
            ),
            real!(ddq_max[3], unit::RADIAN_PER_SECOND_SQUARED).parameter(Fixed).at_least(SMALLEST).about(
                "Largest acceleration of the joints: the energy budget covers every motion within it",
            ),
            real!(dp_cutoff, unit::HERTZ)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Corner frequency of a first-order low pass on dp; 0 = off"),
            real!(kinematics.A1, unit::METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Length from the yaw axis forward to the shoulder's pitch axis"),
            real!(kinematics.L1, unit::METRE)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Length from the shoulder's pitch axis to the elbow's"),
            real!(kinematics.handle_x, unit::METRE)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Handle in link 3's frame: from the elbow's axis along the link, L2 of the arm"),
            real!(kinematics.handle_z, unit::METRE)
                .parameter(Fixed)
                .about("Handle in link 3's frame: across the link, upwards when it is level"),
            enumeration!(ft.frame, &FRAME).parameter(Fixed).about("Frame in which f_h is given"),
            real!(singularity.sigma_slow, unit::METRE_PER_RADIAN)
                .parameter(Fixed)
                .at_least(0.0)
                .about("sigma_min below which the nominal is damped more; 0 = off"),
            real!(singularity.D, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed).at_least(0.0).about(
                "Slowing: below sigma_slow D_n is raised by singularity.D*((sigma_slow/sigma_min)^2 - 1), at most by 15 singularity.D",
            ),
            real!(M_min, unit::KILOGRAM).parameter(Fixed).at_least(SMALLEST).about(
                "Lightest effective mass that the robot shows along an axis, for gain_warning only",
            ),
            integer!(gain_warning).output(Discrete).initially_from(&["M_min", "Lambda_n[i]", "K[i]", "T"]).about(
                "Gains in task space that are accepted but probably not meant: 0 none, 1 K*T/M_min above 0.25, 2 a Lambda_n below M_min/10, 3 both",
            ),
            boolean!(hold).input(Discrete).about(
                "Whether the nominal stays where it is: the coupling then carries any load within f_max without drift",
            ),
            boolean!(held)
                .output(Discrete)
                .about("Whether hold, dp_n_max or the position box kept the nominal back at this tick"),
            real!(energy.share, unit::NONE).output(Discrete).about(
                "Share of the torques that the energy budget left at this tick; 1 unless something is wrong",
            ),
            boolean!(energy.debt).output(Discrete).about(
                "Whether the tank is below 0: a motion beyond dq_max and ddq_max cost more than it held; no torque until it is \
                 repaid",
            ),
            real!(tuning_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time in which changed gains come into force, on a straight line; 0 = at once"),
            real!(dp_n_max[3], unit::METRE_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Largest speed of the nominal along x, y, z; 0 = no limit"),
            boolean!(p_n_box)
                .parameter(Fixed)
                .about("Whether the nominal keeps within p_n_min and p_n_max"),
            real!(p_n_min[3], unit::METRE)
                .parameter(Fixed)
                .about("Least position of the nominal handle along x, y, z; base frame"),
            real!(p_n_max[3], unit::METRE)
                .parameter(Fixed)
                .about("Largest position of the nominal handle along x, y, z; base frame"),
            real!(tau_rate_max[3], unit::NEWTON_METRE_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Largest rate of change of tau_a while the controller is in the loop; 0 = no limit"),
            boolean!(stiff_hand.active).parameter(Fixed).about(
                "Whether a hand too stiff for the gains is looked for and answered with damping",
            ),
            real!(stiff_hand.D_max, unit::NEWTON_SECOND_PER_METRE).parameter(Fixed).at_least(SMALLEST).about(
                "Damping on top of D_n while a stiff hand is detected",
            ),
            real!(stiff_hand.f_low, unit::HERTZ).parameter(Fixed).at_least(SMALLEST).about(
                "Lower edge of the band in which a stiff hand is looked for, above the motions that the operator means",
            ),
            real!(stiff_hand.f_high, unit::HERTZ).parameter(Fixed).at_least(SMALLEST).about(
                "Upper edge of that band, above stiff_hand.f_low and at most 1/(8*T)",
            ),
            real!(stiff_hand.f_min, unit::NEWTON).parameter(Fixed).at_least(SMALLEST).about(
                "Amplitude of f_h in the band from which on a swing counts",
            ),
            real!(stiff_hand.growth, unit::NONE).parameter(Fixed).at_least(1.0).about(
                "Factor, greater than 1, by which f_h has to grow from one period of a swing to the next",
            ),
            real!(stiff_hand.attack, unit::SECOND).parameter(Fixed).at_least(SMALLEST).about(
                "Time in which the damping rises to stiff_hand.D_max",
            ),
            real!(stiff_hand.quiet, unit::SECOND).parameter(Fixed).at_least(SMALLEST).about(
                "Time without a swing after which the damping is given back",
            ),
            real!(stiff_hand.release, unit::SECOND).parameter(Fixed).at_least(SMALLEST).about(
                "Time in which it is given back",
            ),
            boolean!("stiff_hand.detected" => stiff_hand_seen.detected).output(Discrete).about(
                "Whether on any axis a stiff hand has made a swing grow and has not been quiet since",
            ),
            real!("stiff_hand.D[i]" => stiff_hand_seen.D[3], unit::NEWTON_SECOND_PER_METRE)
                .output(Discrete)
                .about("Damping on top of D_n for a stiff hand; base frame"),
            real!("stiff_hand.k_h[i]" => stiff_hand_seen.k_h[3], unit::NEWTON_PER_METRE).output(Discrete).about(
                "Stiffness of the hand in the last swing that counted, 0 before the first; base frame",
            ),
            real!("ft.force[i]" => ft.force[3], unit::NEWTON).input(Discrete).may_be_nan().about(
                "Raw force that acts on the sensor's tool, in the sensor's frame, under ft.source 2. It may be NaN, which \
                 ft.fault names",
            ),
            real!("ft.torque[i]" => ft.torque[3], unit::NEWTON_METRE).input(Discrete).may_be_nan().about(
                "Raw moment that acts on the sensor's tool about the sensor's origin, in the sensor's frame, under ft.source 2. \
                 It may be NaN, which ft.fault names",
            ),
            boolean!(ft.tare).input(Discrete).about(
                "Request for a tare: its change to true starts one, with nobody touching the handle and the arm at rest",
            ),
            real!("ft.f_h[i]" => ft.f_h[3], unit::NEWTON).output(Discrete).about(
                "Force of the human on the handle as the law uses it, 0 during a fault or a tare; base frame",
            ),
            real!("ft.moment[i]" => ft.moment[3], unit::NEWTON_METRE).output(Discrete).about(
                "Moment of the human about the handle under ft.source 2, for information: the law moves a point; base frame",
            ),
            enumeration!(ft.fault, &FAULT).output(Discrete).about("What is wrong with the force sensor"),
            enumeration!(ft.tare_state, &TARE_STATE).output(Discrete).about("How far the last tare has come"),
            enumeration!(ft.tare_failure, &TARE_FAILURE).output(Discrete).about("Why the last tare failed"),
            real!("ft.bias_force[i]" => ft.bias_force[3], unit::NEWTON)
                .output(Discrete)
                .about("Force that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame"),
            real!("ft.bias_torque[i]" => ft.bias_torque[3], unit::NEWTON_METRE)
                .output(Discrete)
                .about("Moment that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame"),
            enumeration!(ft.source, &SOURCE).parameter(Fixed).about("Where the force of the human is read"),
            real!("ft.mount[i]" => ft.mount[3], unit::RADIAN).parameter(Fixed).about(
                "Orientation of the sensor in link 3's frame under ft.source 2: roll, pitch, yaw, turns about link 3's fixed axes \
                 x, then y, then z",
            ),
            real!("ft.handle[i]" => ft.handle[3], unit::METRE)
                .parameter(Fixed)
                .about("Lever arm: the handle from the sensor's origin; sensor frame"),
            real!(ft.mass, unit::KILOGRAM)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Mass of the tool behind the sensor, whose weight is taken off; 0 = none"),
            real!("ft.cog[i]" => ft.cog[3], unit::METRE)
                .parameter(Fixed)
                .about("Centre of gravity of the tool from the sensor's origin; sensor frame"),
            real!("ft.gravity[i]" => ft.gravity[3], unit::METRE_PER_SECOND_SQUARED)
                .parameter(Fixed)
                .about("Acceleration of gravity; base frame"),
            real!(ft.deadband, unit::NEWTON)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Length by which every force is shortened, and below which it is 0; 0 = off"),
            real!(ft.cutoff, unit::HERTZ)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Corner frequency of a first-order low pass on the force; it costs phase; 0 = off"),
            real!(ft.range_force, unit::NEWTON)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Absolute value at which a force component is over range; 0 = off"),
            real!(ft.range_torque, unit::NEWTON_METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Absolute value at which a moment component is over range; 0 = off"),
            real!(ft.rate_force, unit::NEWTON_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Rate at which a force component is a fault; 0 = off"),
            real!(ft.rate_torque, unit::NEWTON_METRE_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Rate at which a moment component is a fault; 0 = off"),
            integer!(ft.stuck_samples).parameter(Fixed).within_integers(0, i32::MAX).about(
                "Repetitions of a reading, bit for bit, after which the sensor is stuck; 0 = off. For sensors with noise that \
                 are read at every tick",
            ),
            integer!(ft.dropout_samples).parameter(Fixed).within_integers(0, i32::MAX).about(
                "Readings of exactly 0 on all axes after which the sensor has dropped out; 0 = off. For sensors with noise",
            ),
            real!(ft.recovery_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time for which the signal must be sound before a fault is over"),
            real!(ft.tare_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Time for which a tare takes samples"),
            real!(ft.tare_motion, unit::RADIAN)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Motion of a joint beyond which a tare fails"),
            real!(ft.tare_spread_force, unit::NEWTON)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Standard deviation of a force component beyond which a tare fails; 0 = any"),
            real!(ft.tare_spread_torque, unit::NEWTON_METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Standard deviation of a moment component beyond which a tare fails; 0 = any"),
            real!(ft.tare_max_force, unit::NEWTON)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Force component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any"),
            real!(ft.tare_max_torque, unit::NEWTON_METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Moment component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any"),
            boolean!(enable)
                .input(Discrete)
                .about("Whether the controller may run at all; only with supervision"),
            boolean!(acknowledge)
                .input(Discrete)
                .about("Its rising edge acknowledges a fault whose cause is gone; only with supervision"),
            boolean!(emergency_stop).input(Discrete).about(
                "Whether the emergency stop is pressed: no torque, at once; only with supervision",
            ),
            integer!(heartbeat).input(Discrete).about(
                "A counter that must change within heartbeat_timeout, by whatever step; only with supervision",
            ),
            boolean!(ft_valid).input(Discrete).about(
                "The sensor's own word on the force; if false the law sees no force (ft.fault) and, with supervision, stops softly",
            ),
            boolean!(encoder_valid).input(Discrete).about(
                "Whether q can be trusted; if not there is no torque, at once; only with supervision",
            ),
            enumeration!(state, &STATE).output(Discrete).about(
                "State of the supervision; without it off, engaged or hold, as engage and hold say",
            ),
            enumeration!(diagnostic, &DIAGNOSTIC)
                .output(Discrete)
                .about("Why the law does not simply run at this tick; always 0 without supervision"),
            enumeration!(first_fault, &DIAGNOSTIC)
                .output(Discrete)
                .about("The first fault, kept until it is acknowledged; 0 if there is none"),
            real!(authority, unit::NONE).output(Discrete).about(
                "Share of its force that the law exerts; it rises from 0 when the controller engages and falls in a soft stop",
            ),
            boolean!(supervision).parameter(Fixed).about(
                "Whether supervision decides when the law may act; if not, engage alone does",
            ),
            real!(init_time, unit::SECOND).parameter(Fixed).at_least(0.0).about(
                "For how long sensors and heartbeat must have been good before the controller is ready",
            ),
            real!(engage_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time in which the authority rises from 0 to 1; one tick at least"),
            real!(soft_stop_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time in which the authority falls to 0 in a soft stop; one tick at least"),
            real!(heartbeat_timeout, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time within which heartbeat must change; 0 = it is not watched"),
            real!(hold_enter, unit::NEWTON).parameter(Fixed).at_least(0.0).about(
                "Magnitude of f_h below which the hand is at rest and the controller holds by itself; 0 = it never does",
            ),
            real!(hold_leave, unit::NEWTON)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Magnitude of f_h above which the hand is no longer at rest; not below hold_enter"),
            real!(hold_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("For how long f_h must have been below hold_enter before the hand is at rest"),
            real!(hold_brake, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Time in which supervision brings a moving nominal to rest; one tick at least"),
            real!(saturation_time, unit::SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("For how long limits may act before diagnostic reports it; 0 = it does not"),
            enumeration!(space, &SPACE).parameter(Fixed).about("Coordinates in which the nominal lives"),
            real!(joint.D_n[3], unit::NEWTON_METRE_SECOND_PER_RADIAN)
                .parameter(Tunable)
                .at_least(0.0)
                .about("Nominal damping of each joint in joint space (eq:nom_dyn)"),
            real!(joint.K, unit::NEWTON_METRE_SECOND_PER_RADIAN).parameter(Tunable).at_least(SMALLEST).about(
                "Control gain in joint space, 1/epsilon of the paper (eq:dob_input); one number for all joints, because with \
                 different ones a free robot can be unstable",
            ),
            real!(joint.K_P[3], unit::PER_SECOND)
                .parameter(Tunable)
                .at_least(SMALLEST)
                .about("Ratio of each joint's coupling spring to its damper in joint space (eq:dob_input)"),
            real!(joint.dq_n_max[3], unit::RADIAN_PER_SECOND)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Largest speed of the nominal's joints in joint space; 0 = no limit"),
            boolean!(joint.q_n_box)
                .parameter(Fixed)
                .about("Whether the nominal keeps within joint.q_n_min and joint.q_n_max in joint space"),
            real!(joint.q_n_min[3], unit::RADIAN).parameter(Fixed).about("Least angles of the nominal's joints"),
            real!(joint.q_n_max[3], unit::RADIAN).parameter(Fixed).about("Largest angles of the nominal's joints"),
            real!(nominal.m[3], unit::KILOGRAM)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Mass of each link of the nominal arm, which has the lengths kinematics.* and no weight"),
            real!(nominal.x[3], unit::METRE)
                .parameter(Fixed)
                .about("Centre of mass of each nominal link along it, from its joint's axis"),
            real!(nominal.z[3], unit::METRE)
                .parameter(Fixed)
                .about("Centre of mass of each nominal link across it, upwards when it is level"),
            real!(nominal.I_xx[3], unit::KILOGRAM_SQUARE_METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Moment of inertia of each nominal link about x through its centre of mass"),
            real!(nominal.I_yy[3], unit::KILOGRAM_SQUARE_METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Moment of inertia of each nominal link about y through its centre of mass"),
            real!(nominal.I_zz[3], unit::KILOGRAM_SQUARE_METRE)
                .parameter(Fixed)
                .at_least(0.0)
                .about("Moment of inertia of each nominal link about z through its centre of mass"),
            real!(nominal.I_xz[3], unit::KILOGRAM_SQUARE_METRE)
                .parameter(Fixed)
                .about("Element xz of each nominal link's inertia matrix, the negative product of inertia"),
            real!(nominal.rotor[3], unit::KILOGRAM_SQUARE_METRE)
                .parameter(Fixed)
                .at_least(SMALLEST)
                .about("Inertia of each nominal joint about its own axis, as the joint feels it"),
            real!(M_n[9], unit::KILOGRAM_SQUARE_METRE)
                .output(Discrete)
                .initially_from(NOMINAL)
                .about("Nominal mass matrix M_n(q), row by row; 0 in task space"),
            real!(q_n[3], unit::RADIAN)
                .output(Discrete)
                .initially_from(&["q[i]"])
                .about("Nominal joint angles (eq:obs_dyn); q in task space"),
            real!(dq_n[3], unit::RADIAN_PER_SECOND)
                .output(Discrete)
                .about("Nominal joint velocities (eq:obs_dyn); 0 in task space"),
            real!(e_q[3], unit::RADIAN)
                .output(Discrete)
                .about("Position error q_n - q of the joints, after the slip of passive_bounded; 0 in task space"),
        ],
    };
}

/// What the outputs that show the handle depend on after initialization.
const WHERE: &[&str] = &[
    "q[i]",
    "kinematics.A1",
    "kinematics.L1",
    "kinematics.handle_x",
    "kinematics.handle_z",
];

/// What M_n depends on after initialization.
const NOMINAL: &[&str] = &[
    "q[i]",
    "space",
    "kinematics.A1",
    "kinematics.L1",
    "nominal.m[i]",
    "nominal.x[i]",
    "nominal.z[i]",
    "nominal.I_xx[i]",
    "nominal.I_yy[i]",
    "nominal.I_zz[i]",
    "nominal.I_xz[i]",
    "nominal.rotor[i]",
];
