/*
 * The admittance laws as a C library: one axis, and the arm.
 *
 * Define EXO_LAW_F32 before including this header to use the library built in single precision. A program that uses both
 * includes exo_law_f32.h as well, whose names begin with exo_f32_, and defines nothing.
 * docs/real-time.md says how to link, in which order to call, and what is promised.
 */

#ifndef EXO_LAW_H
#define EXO_LAW_H

/* Generated from fmu/c/src by `cargo xtask law --bless`: do not edit. */

#include <stddef.h>
#include <stdint.h>

// What a variable is in its struct.
enum exo_kind
#ifdef __cplusplus
  : int32_t
#endif // __cplusplus
 {
  // An `exo_real`.
  EXO_KIND_REAL = 0,
  // A `double` in both precisions.
  EXO_KIND_DOUBLE = 1,
  // An `int32_t`: a count, a choice or a Boolean.
  EXO_KIND_INTEGER = 2,
};
#ifndef __cplusplus
typedef int32_t exo_kind;
#endif // __cplusplus

// In which struct a variable lies.
enum exo_role
#ifdef __cplusplus
  : int32_t
#endif // __cplusplus
 {
  // In the parameters.
  EXO_ROLE_PARAMETER = 0,
  // In the inputs.
  EXO_ROLE_INPUT = 1,
  // In the outputs.
  EXO_ROLE_OUTPUT = 2,
};
#ifndef __cplusplus
typedef int32_t exo_role;
#endif // __cplusplus

// What a call returns. Everything but `Ok` changed nothing, but that a tick left its outputs without torque.
enum exo_status
#ifdef __cplusplus
  : int32_t
#endif // __cplusplus
 {
  // Done.
  EXO_STATUS_OK = 0,
  // A pointer is null.
  EXO_STATUS_NULL = 1,
  // A pointer is not aligned as its type asks.
  EXO_STATUS_MISALIGNED = 2,
  // The state has not been initialized by the function that belongs to it.
  EXO_STATUS_NOT_INITIALIZED = 3,
  // A value is out of its range, or an input not finite: the refusal says which.
  EXO_STATUS_REFUSED = 4,
  // The tick's result is not finite: numbers overflow.
  EXO_STATUS_NOT_FINITE = 5,
  // There is no variable of this number: it is beyond the last.
  EXO_STATUS_NO_SUCH_VARIABLE = 6,
};
#ifndef __cplusplus
typedef int32_t exo_status;
#endif // __cplusplus

// Version of this header; exo_law_version() is that of the library.
#define EXO_LAW_VERSION "0.1.0"
#define EXO_LAW_VERSION_MAJOR 0
#define EXO_LAW_VERSION_MINOR 1
#define EXO_LAW_VERSION_PATCH 0

// Admittance law: which reaction the nominal feels once the force is limited: law.
enum {
  // admittance filter alone, no reaction on the nominal; sticks to walls
  EXO_LAW_STANDARD = 1,
  // the paper's law: the nominal feels the unlimited coupling; creates energy once saturated
  EXO_LAW_PASSIVE = 2,
  // the nominal feels what the limits leave of the force; the spring winds up and sticks to walls
  EXO_LAW_PASSIVE_APPLIED = 3,
  // the nominal feels the limited force and the spring slips at the limit; passive and bounded
  EXO_LAW_PASSIVE_BOUNDED = 4,
};

// How joint torques beyond tau_max are brought within: torque_limiting.
enum {
  // all joints by one factor; the force at the handle keeps its direction
  EXO_TORQUE_LIMITING_SCALE = 1,
  // each joint by itself; the force at the handle turns. Under the laws standard and passive only
  EXO_TORQUE_LIMITING_CLIP = 2,
};

// Frame in which the force sensor's components are given: ft.frame.
enum {
  // base frame: x forward, y to the left, z up
  EXO_FRAME_BASE = 1,
  // link 3's frame: x along the link, z up when the link is level; it turns with the link
  EXO_FRAME_SENSOR = 2,
};

// Where the force of the human is read: ft.source.
enum {
  // the input f_h, a force in the frame ft.frame
  EXO_SOURCE_F_H = 1,
  // the inputs ft.force and ft.torque, in the frame of a six-axis sensor that ft.mount turns
  EXO_SOURCE_WRENCH = 2,
};

// Coordinates in which the nominal lives: space.
enum {
  // the handle's: a mass Lambda_n at the handle, with D_n, K, K_P, f_max (eq:obs_dyn_cart)
  EXO_SPACE_TASK = 1,
  // the joints': an arm of rigid links, nominal.*, with joint.D_n, joint.K, joint.K_P, tau_max (eq:obs_dyn)
  EXO_SPACE_JOINT = 2,
};

// What the robot gets from the controller: form.
enum {
  // the force, or torques, tau_a
  EXO_FORM_TORQUE = 1,
  // q_d and dq_d, for drives that close the loop with K and K_P themselves; needs tau_a_measured; an arm in joint space only
  EXO_FORM_POSITION_SERVO = 2,
};

// What is wrong with the force sensor; the law then sees no force: ft.fault.
enum {
  // nothing
  EXO_SENSOR_FAULT_NONE = 0,
  // a component is NaN or infinite
  EXO_SENSOR_FAULT_NOT_FINITE = 1,
  // a component has reached the end of its range
  EXO_SENSOR_FAULT_OVER_RANGE = 2,
  // a component has changed faster than a hand can push
  EXO_SENSOR_FAULT_RATE = 3,
  // the reading no longer changes
  EXO_SENSOR_FAULT_STUCK = 4,
  // the reading is exactly 0, or the sensor says that it is invalid
  EXO_SENSOR_FAULT_DROPOUT = 5,
};

// How far the last tare has come: ft.tare_state.
enum {
  // none was asked for
  EXO_TARE_STATE_OFF = 0,
  // samples are being taken; the law sees no force
  EXO_TARE_STATE_RUNNING = 1,
  // ft.bias is that of the last tare
  EXO_TARE_STATE_DONE = 2,
  // ft.bias is what it was before; ft.tare_failure says why
  EXO_TARE_STATE_FAILED = 3,
};

// Why the last tare failed: ft.tare_failure.
enum {
  // it did not
  EXO_TARE_FAILURE_NONE = 0,
  // the sensor had a fault
  EXO_TARE_FAILURE_FAULT = 1,
  // a joint moved by more than ft.tare_motion
  EXO_TARE_FAILURE_MOVED = 2,
  // the reading scattered by more than ft.tare_spread_force or ft.tare_spread_torque
  EXO_TARE_FAILURE_UNSTEADY = 3,
  // the bias would exceed ft.tare_max_force or ft.tare_max_torque: somebody leans on the handle
  EXO_TARE_FAILURE_TOO_LARGE = 4,
};

// What the controller is doing: state.
enum {
  // not enabled, no torque
  EXO_STATE_OFF = 0,
  // waits for good sensors and a heartbeat, no torque
  EXO_STATE_INIT = 1,
  // waits for a rising edge of engage, no torque
  EXO_STATE_READY = 2,
  // the law runs
  EXO_STATE_ENGAGED = 3,
  // the law runs with its nominal standing still
  EXO_STATE_HOLD = 4,
  // the nominal stands still and the authority falls to 0
  EXO_STATE_SOFT_STOP = 5,
  // waits for an acknowledgement, no torque
  EXO_STATE_FAULT = 6,
  // engaged or hold, but the tank is below 0: no torque, or drives that stand still, until it is repaid
  EXO_STATE_DEBT = 7,
};

// Why the law does not simply run; of several reasons a fault, else the one with the smallest number: diagnostic, first_fault.
enum {
  // the law runs or holds
  EXO_DIAGNOSTIC_NONE = 0,
  // fault: pressed
  EXO_DIAGNOSTIC_EMERGENCY_STOP = 1,
  // fault: the joint angles have one, encoder.fault
  EXO_DIAGNOSTIC_ENCODER_INVALID = 2,
  // fault: the law's result is not
  EXO_DIAGNOSTIC_NOT_FINITE = 3,
  // fault: unchanged for heartbeat_timeout, or never changed
  EXO_DIAGNOSTIC_HEARTBEAT_LOST = 4,
  // fault: the force sensor has one, ft.fault
  EXO_DIAGNOSTIC_FT_INVALID = 5,
  // warning: no torque until the tank is repaid
  EXO_DIAGNOSTIC_ENERGY_DEBT = 6,
  // warning: motion beyond dq_max or ddq_max, or q is doubted, encoder.fault
  EXO_DIAGNOSTIC_OUTSIDE_BOUNDS = 7,
  // warning: limits have acted for saturation_time
  EXO_DIAGNOSTIC_SATURATED = 8,
  // the fault's cause is gone; waits for a rising edge of acknowledge
  EXO_DIAGNOSTIC_NOT_ACKNOWLEDGED = 9,
  // enable is false
  EXO_DIAGNOSTIC_NOT_ENABLED = 10,
  // sensors and heartbeat not yet good for init_time
  EXO_DIAGNOSTIC_PREPARING = 11,
  // engage is false
  EXO_DIAGNOSTIC_NOT_ENGAGED = 12,
  // engage has not risen since the controller was ready
  EXO_DIAGNOSTIC_ENGAGE_STUCK = 13,
  // warning, or fault after drift_stop_time: nobody varies the force of the hand, drift_distance
  EXO_DIAGNOSTIC_FORCE_STEADY = 14,
  // the same, and the force is what a wrong ft.mass leaves, ft.mass_error
  EXO_DIAGNOSTIC_TOOL_WEIGHT = 15,
};

// What is wrong with the sensed positions: encoder.fault.
enum {
  // nothing
  EXO_ENCODER_FAULT_NONE = 0,
  // one is NaN or infinite
  EXO_ENCODER_FAULT_NOT_FINITE = 1,
  // one lies beyond encoder.range
  EXO_ENCODER_FAULT_OVER_RANGE = 2,
  // one has moved faster than the robot can since the last reading, and not as it moved before
  EXO_ENCODER_FAULT_JUMP = 3,
  // one has stayed the same while its force changed by as much as should move it
  EXO_ENCODER_FAULT_STUCK = 4,
  // encoder_valid is false
  EXO_ENCODER_FAULT_INVALID = 5,
};

// Whether a tick came in time: timing.
enum {
  // within a quarter of T
  EXO_TIMING_IN_TIME = 0,
  // by more than a quarter of T: velocities are those over the time that has passed
  EXO_TIMING_LATE = 1,
  // by more than a quarter of T: the motion counts for its part of a T in the velocity
  EXO_TIMING_EARLY = 2,
};

// What is wrong with the measured force of the drive, in the servo form: drive.fault.
enum {
  // nothing
  EXO_DRIVE_FAULT_NONE = 0,
  // tau_a_measured is not the drive's: not wired, or the drive is off or has other gains than the law
  EXO_DRIVE_FAULT_MISSING = 1,
  // tau_a_measured has the sign of the force on the drive, not of that on the robot
  EXO_DRIVE_FAULT_WRONG_SIGN = 2,
};

// The law's number: double precision, or single precision in the packages and libraries named f32.
typedef double exo_real;

// The lengths that place the handle. The start values are the exoskeleton arm's.
typedef struct exo_arm_kinematics {
  // Length from the yaw axis forward to the shoulder's pitch axis.
  exo_real A1; // m
  // Length from the shoulder's pitch axis to the elbow's.
  exo_real L1; // m
  // Handle in link 3's frame: from the elbow's axis along the link, L2 of the arm.
  exo_real handle_x; // m
  // Handle in link 3's frame: across the link, upwards when it is level.
  exo_real handle_z; // m
} exo_arm_kinematics;

// What the joints' positions must keep to. The arm's joints turn less than once.
typedef struct exo_arm_encoder {
  // Largest absolute joint angle: a reading beyond it cannot be.
  exo_real range[3]; // rad
  // Change of a joint's torque in which its angle must change, too, in its last bit at least; 0 = off. Above what
  // friction holds.
  exo_real stuck_torque[3]; // N.m
  // Readings in a row after which a jump beyond dq_max or encoder.range is a fault, and after which a fault is over; 0 =
  // jumps are believed.
  int32_t samples;
} exo_arm_encoder;

// Everything beyond the sensor that the hand does not carry: handle, adapter, half of the sensor. At the start there is none,
// on an arm that stands upright.
typedef struct exo_arm_tool {
  // Mass of the tool behind the sensor, whose weight is taken off; 0 = none.
  exo_real mass; // kg
  // Centre of gravity of the tool from the sensor's origin; sensor frame.
  exo_real cog[3]; // m
  // Acceleration of gravity; base frame.
  exo_real gravity[3]; // m/s2
} exo_arm_tool;

// The checks. At the start all are off but for NaN and infinity.
typedef struct exo_arm_sensor_checks {
  // Absolute value at which a force component is over range; 0 = off.
  exo_real range_force; // N
  // Absolute value at which a moment component is over range; 0 = off.
  exo_real range_torque; // N.m
  // Rate at which a force component is a fault; 0 = off.
  exo_real rate_force; // N/s
  // Rate at which a moment component is a fault; 0 = off.
  exo_real rate_torque; // N.m/s
  // Repetitions of a reading, bit for bit, after which the sensor is stuck; 0 = off. For sensors with noise that are
  // read at every tick.
  int32_t stuck_samples;
  // Readings of exactly 0 on all axes after which the sensor has dropped out; 0 = off. For sensors with noise.
  int32_t dropout_samples;
  // Time for which the signal must be sound before a fault is over.
  exo_real recovery_time; // s
} exo_arm_sensor_checks;

// What a tare asks for. The start values: half a second; the least count of a 14-bit encoder three times over; a hand's tremor
// does not pass.
typedef struct exo_arm_tare {
  // Time for which a tare takes samples.
  exo_real time; // s
  // Motion of a joint beyond which a tare fails.
  exo_real motion; // rad
  // Standard deviation of a force component beyond which a tare fails; 0 = any.
  exo_real spread_force; // N
  // Standard deviation of a moment component beyond which a tare fails; 0 = any.
  exo_real spread_torque; // N.m
  // Force component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any.
  exo_real max_force; // N
  // Moment component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any.
  exo_real max_torque; // N.m
} exo_arm_tare;

// What the sensor is like and what is made of its reading: the parameters `ft.*`. At the start a force in the base frame, as
// it is.
typedef struct exo_arm_force_sensor {
  // Where the force of the human is read.
  int32_t source; // 1 f_h, 2 wrench
  // Frame in which f_h is given.
  int32_t frame; // 1 base, 2 sensor
  // Orientation of the sensor in link 3's frame under ft.source 2: roll, pitch, yaw, turns about link 3's fixed axes
  // x, then y, then z.
  exo_real mount[3]; // rad
  // Lever arm: the handle from the sensor's origin; sensor frame.
  exo_real handle[3]; // m
  // What hangs on it.
  struct exo_arm_tool tool;
  // Length by which every force is shortened, and below which it is 0; 0 = off.
  exo_real deadband; // N
  // Corner frequency of a first-order low pass on the force; it costs phase; 0 = off.
  exo_real cutoff; // Hz
  // How it may fail.
  struct exo_arm_sensor_checks checks;
  // How its bias is found.
  struct exo_arm_tare tare;
} exo_arm_force_sensor;

// Where the nominal may go. The start values leave 0.1 rad before the stops of the exoskeleton arm; and 0.4 rad where the
// elbow would become straight, so that f_max still bends it with twice its stiction.
typedef struct exo_arm_workspace {
  // 1: the nominal keeps within the workspace, which is the exoskeleton arm's: workspace.q_min to workspace.q_max, and
  // in task space workspace.radius_min; an arm that engages beyond may only come back. 0: it may go anywhere. An
  // Integer, because fmpy takes a false in a parameter set for true.
  int32_t limited;
  // Least angle of each joint of the nominal, with room before the arm's stop or before a straight elbow.
  exo_real q_min[3]; // rad
  // Largest angle of each joint of the nominal, with room before the arm's stop.
  exo_real q_max[3]; // rad
  // Least distance of the nominal handle from the yaw axis, in task space, where the axis is a singularity.
  exo_real radius_min; // m
  // Slowing: a limit is approached no faster than the distance that is left over this time, at least T.
  exo_real slowing_time; // s
} exo_arm_workspace;

// When and how much the nominal is slowed. The start values: two thirds of the least sigma_min that the paper's experiments
// come to (0.18 m/rad), and a damping that takes the speed from the nominal within the few centimetres that are left.
typedef struct exo_arm_singularity {
  // sigma_min below which the nominal is damped more; 0 = off.
  exo_real sigma_slow; // m/rad
  // Slowing: below sigma_slow D_n is raised by singularity.D*((sigma_slow/sigma_min)^2 - 1), at most by 15
  // singularity.D.
  exo_real D; // N.s/m
} exo_arm_singularity;

// The parameters `stiff_hand.*`, the same on all axes. At the start nobody watches. The band holds the unstable swings of the
// arm from 300 to 10000 N/m (1.1 to 7 Hz) and none of the paper's motions (0.25 to 0.8 Hz); D_max holds a hand of 2762 N/m
// on the arm's x axis with the paper's gains.
typedef struct exo_arm_stiff_hand {
  // Whether a hand too stiff for the gains is looked for and answered with damping.
  int32_t active; // 0 or 1
  // Largest damping on top of D_n, for a stiff hand that is detected.
  exo_real D_max; // N.s/m
  // Lower edge of the band in which a stiff hand is looked for, above the motions that the operator means.
  exo_real f_low; // Hz
  // Upper edge of that band, above stiff_hand.f_low and at most 1/(8*T).
  exo_real f_high; // Hz
  // Amplitude of f_h in the band from which on a swing counts.
  exo_real f_min; // N
  // Factor, greater than 1, by which f_h has to grow from one period of a swing to the next to be probed before it has
  // lasted.
  exo_real growth;
  // Time in which the damping rises to stiff_hand.D_max.
  exo_real attack; // s
  // Time without a swing of that hand after which the damping is given back.
  exo_real quiet; // s
  // Time in which it is given back.
  exo_real release; // s
  // Number of periods that a swing which does not grow has to last, with one and the same hand, before it is probed.
  int32_t periods;
  // Damping that probes whether a swing is meant, over the magnitude of the hand's impedance f_h/dp in it. The
  // stiffness of a hand stays under the probe; what a meant force seems to have of it changes by about this share.
  exo_real probe;
  // Time after a swing that was found to be meant in which no other one is probed, unless it ends before.
  exo_real pause; // s
} exo_arm_stiff_hand;

// What can be set. Times are rounded to whole ticks. The start values: half a second to engage and to stop, a heartbeat of
// 10 Hz or more, no hold but by request.
typedef struct exo_arm_supervision {
  // For how long sensors and heartbeat must have been good before the controller is ready.
  exo_real init_time; // s
  // Time in which the authority rises from 0 to 1; one tick at least.
  exo_real engage_time; // s
  // Time in which the authority falls to 0 in a soft stop; one tick at least.
  exo_real soft_stop_time; // s
  // Time within which heartbeat must change; 0 = it is not watched.
  exo_real heartbeat_timeout; // s
  // Magnitude of f_h below which the hand is at rest and the controller holds by itself; 0 = it never does.
  exo_real hold_enter; // N
  // Magnitude of f_h above which the hand is no longer at rest; not below hold_enter.
  exo_real hold_leave; // N
  // For how long f_h must have been below hold_enter before the hand is at rest.
  exo_real hold_time; // s
  // Time in which supervision brings a moving nominal to rest; one tick at least.
  exo_real hold_brake; // s
  // For how long limits may act before diagnostic reports it; 0 = it does not.
  exo_real saturation_time; // s
  // Farthest that the nominal's handle moves while nobody varies the force of the hand; then it holds. 0 = any distance.
  exo_real drift_distance; // m
  // Change of the hand's force that shows a hand, if it comes within drift_time.
  exo_real drift_band; // N
  // Time within which a hand varies its force by drift_band; what takes longer is a drift.
  exo_real drift_time; // s
  // For how long a force that nobody varies may press on a nominal that is held for it, before a soft stop; 0 = for ever.
  exo_real drift_stop_time; // s
  // Largest error of ft.mass that is reckoned with: a change of force that it explains, as the tool turns, shows no hand.
  exo_real drift_mass; // kg
} exo_arm_supervision;

// The parameters `joint.*`: what the form in joint space has of its own. The start values are about the task-space gains
// (1000 N·s/m, 20 N·s/m) at the start pose: seen from the handle, D_n/(JJᵀ)_zz is 15 N·s/m and K/(JJᵀ)_zz 1500 N·s/m. The
// unit damper alpha is then 3.7 N·s/m, so a load sinks faster than at the handle.
typedef struct exo_arm_joint {
  // Nominal damping of each joint in joint space (eq:nom_dyn).
  exo_real D_n[3]; // N.m.s/rad
  // Control gain in joint space, 1/epsilon of the paper (eq:dob_input); one number for all joints, because with
  // different ones a free robot can be unstable.
  exo_real K; // N.m.s/rad
  // Ratio of each joint's coupling spring to its damper in joint space (eq:dob_input).
  exo_real K_P[3]; // 1/s
  // Largest speed of the nominal's joints in joint space; 0 = no limit.
  exo_real dq_n_max[3]; // rad/s
  // Whether the nominal keeps within joint.q_n_min and joint.q_n_max in joint space.
  int32_t q_n_box; // 0 or 1
  // Least angles of the nominal's joints.
  exo_real q_n_min[3]; // rad
  // Largest angles of the nominal's joints.
  exo_real q_n_max[3]; // rad
} exo_arm_joint;

// A link of the nominal arm, in the link's frame: origin on its joint's axis, x along it, z up when it is level.
typedef struct exo_arm_link {
  // Mass of each link of the nominal arm, which has the lengths kinematics.* and no weight.
  exo_real m; // kg
  // Centre of mass of each nominal link along it, from its joint's axis.
  exo_real x; // m
  // Centre of mass of each nominal link across it, upwards when it is level.
  exo_real z; // m
  // Moment of inertia of each nominal link about x through its centre of mass.
  exo_real I_xx; // kg.m2
  // Moment of inertia of each nominal link about y through its centre of mass.
  exo_real I_yy; // kg.m2
  // Moment of inertia of each nominal link about z through its centre of mass.
  exo_real I_zz; // kg.m2
  // Element xz of each nominal link's inertia matrix, the negative product of inertia.
  exo_real I_xz; // kg.m2
} exo_arm_link;

// What the nominal arm is made of. Its lengths are those of the kinematics. The start values: half the mass of the
// exoskeleton arm's links and 0.4 kg·m² at each joint. At the start pose M_n is 0.53 and [0.68 0.06; 0.06 0.46] kg·m²; the
// robot's, with its reflected rotors, is 3 to 8 kg·m².
typedef struct exo_arm_nominal {
  // The three links.
  struct exo_arm_link links[3];
  // Inertia of each nominal joint about its own axis, as the joint feels it.
  exo_real rotor[3]; // kg.m2
} exo_arm_nominal;

// Parameters of the arm's law. Vectors are along x, y, z of the base frame, or by joint. Any bits may come
// from C: what cannot be used is refused by name.
typedef struct exo_arm_parameters {
  // Admittance law.
  int32_t law; // 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded
  // Nominal mass along x, y, z (eq:nom_dyn in task space).
  exo_real Lambda_n[3]; // kg
  // Nominal damping along x, y, z (eq:nom_dyn in task space).
  exo_real D_n[3]; // N.s/m
  // Control gain along x, y, z, 1/epsilon of the paper (eq:dob_input).
  exo_real K[3]; // N.s/m
  // Ratio of the coupling's spring to its damper along x, y, z (eq:dob_input).
  exo_real K_P[3]; // 1/s
  // Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn.
  exo_real alpha; // N.s/m
  // Largest force of the controller along x, y, z and bound of the coupling spring's force, under passive_bounded;
  // the other laws have no limit but tau_max.
  exo_real f_max[3]; // N
  // Largest absolute value of tau_a.
  exo_real tau_max[3]; // N.m
  // How joint torques beyond tau_max are brought within; clip under the laws standard and passive only.
  int32_t torque_limiting; // 1 scale, 2 clip
  // Sample period.
  exo_real T; // s
  // Communication steps by which the importer's wiring delays tau_a, its first value being 0; in the C library samples.
  // It changes no torque, only from when on the ledger counts a torque's work.
  int32_t delay;
  // Energy with which the tank starts and above which it does not fill.
  exo_real E_0; // J
  // Largest speed of the joints: the energy budget covers every motion within it.
  exo_real dq_max[3]; // rad/s
  // Largest acceleration of the joints: the energy budget covers every motion within it.
  exo_real ddq_max[3]; // rad/s2
  // Corner frequency of a first-order low pass on dp; 0 = off.
  exo_real dp_cutoff; // Hz
  // Lightest effective mass that the robot shows along an axis, for gain_warning only.
  exo_real M_min; // kg
  // Time in which changed gains come into force, on a straight line; 0 = at once.
  exo_real tuning_time; // s
  // Largest speed of the nominal along x, y, z; 0 = no limit.
  exo_real dp_n_max[3]; // m/s
  // Whether the nominal keeps within p_n_min and p_n_max.
  int32_t p_n_box; // 0 or 1
  // Least position of the nominal handle along x, y, z; base frame.
  exo_real p_n_min[3]; // m
  // Largest position of the nominal handle along x, y, z; base frame.
  exo_real p_n_max[3]; // m
  // Largest rate of change of tau_a while the controller is in the loop; 0 = no limit.
  exo_real tau_rate_max[3]; // N.m/s
  // Where the handle is.
  struct exo_arm_kinematics kinematics;
  // The joints' encoders.
  struct exo_arm_encoder encoder;
  // The hand's force sensor.
  struct exo_arm_force_sensor ft;
  // Where the nominal may go.
  struct exo_arm_workspace workspace;
  // Slowing before a singularity.
  struct exo_arm_singularity singularity;
  // Damping for a hand too stiff for the gains.
  struct exo_arm_stiff_hand stiff_hand;
  // Whether supervision decides when the law may act; if not, engage alone does.
  int32_t supervision; // 0 or 1
  // Its times and thresholds.
  struct exo_arm_supervision supervisor;
  // Coordinates in which the nominal lives.
  int32_t space; // 1 task, 2 joint
  // The form in joint space.
  struct exo_arm_joint joint;
  // Its nominal arm.
  struct exo_arm_nominal nominal;
  // What the robot gets from the controller.
  int32_t form; // 1 torque, 2 position_servo
} exo_arm_parameters;

// What is sensed and asked for at a tick.
typedef struct exo_arm_inputs {
  // Sensed joint angles: yaw about z, shoulder pitch and elbow pitch about -y, so that positive pitch lifts.
  double q[3]; // rad
  // Sensed force of the human on the handle, in the frame that ft.frame says, under ft.source 1. It may be NaN,
  // which ft.fault names.
  exo_real f_h[3]; // N
  // Whether the controller is in the loop. It engages at the first tick at which this is true, with p_n = p and dp_n
  // = 0; while it is false tau_a is 0.
  int32_t engage; // 0 or 1
  // Whether the nominal stays where it is: the coupling then carries any load within f_max without drift.
  int32_t hold; // 0 or 1
  // Raw force that acts on the sensor's tool, in the sensor's frame, under ft.source 2. It may be NaN, which
  // ft.fault names.
  exo_real ft_force[3]; // N
  // Raw moment that acts on the sensor's tool about the sensor's origin, in the sensor's frame, under ft.source 2.
  // It may be NaN, which ft.fault names.
  exo_real ft_torque[3]; // N.m
  // Request for a tare: its change to true starts one, with nobody touching the handle and the arm at rest.
  int32_t ft_tare; // 0 or 1
  // Whether the controller may run at all; only with supervision.
  int32_t enable; // 0 or 1
  // Its rising edge acknowledges a fault whose cause is gone; only with supervision.
  int32_t acknowledge; // 0 or 1
  // Whether the emergency stop is pressed: no torque, at once; only with supervision.
  int32_t emergency_stop; // 0 or 1
  // A counter that must change within heartbeat_timeout, by whatever step; only with supervision.
  int32_t heartbeat;
  // The sensor's own word on the force; if false the law sees no force (ft.fault) and, with supervision, stops
  // softly.
  int32_t ft_valid; // 0 or 1
  // The encoders' own word on q; if false there is no torque, at once: with supervision until the fault is
  // acknowledged, without it until q is valid again, where the law engages anew.
  int32_t encoder_valid; // 0 or 1
  // Measured torques of the drives on the joints, means over the sample that ended; the nominal feels them in the servo form,
  // they are not used in the torque form.
  exo_real tau_a_measured[3]; // N.m
} exo_arm_inputs;

// Memory of an arm's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
typedef struct exo_arm_state {
  uint64_t words[640];
} exo_arm_state;

// Which value was refused. All texts end with a zero byte.
typedef struct exo_refusal {
  // The variable, by its name in the FMU; empty if none was refused.
  char name[40];
  // What it should have been.
  char expected[120];
  // Its axis or joint, from 1; 0 if it has none.
  int32_t axis;
  // Its value.
  exo_real value;
} exo_refusal;

// What came of a tick; every value is the one at t_k, vectors at the handle in the base frame.
typedef struct exo_arm_outputs {
  // Control torques on the joints, positive like q, held until the next tick (J' f_a, limited).
  exo_real tau_a[3]; // N.m
  // Position of the handle by the controller's kinematics; base frame.
  exo_real p[3]; // m
  // Nominal position of the handle (eq:obs_dyn); base frame.
  exo_real p_n[3]; // m
  // Nominal velocity of the handle (eq:obs_dyn); base frame.
  exo_real dp_n[3]; // m/s
  // Position error p_n - p, after the slip of passive_bounded; base frame.
  exo_real e_nr[3]; // m
  // Force on the robot at the handle that tau_a amounts to (eq:dob_input, limited); base frame.
  exo_real f_a[3]; // N
  // Whether f_max (under passive_bounded) or tau_max leaves less than tau_demand.
  int32_t saturated; // 0 or 1
  // Smallest singular value of the handle's Jacobian; 0 at a singularity.
  exo_real sigma_min; // m/rad
  // Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined.
  exo_real H; // J
  // Energy that the sampled law has created so far, counted with the work of tau_a at the joints; negative:
  // dissipated; 0 if alpha = 0.
  exo_real G; // J
  // Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0.
  exo_real tank; // J
  // Velocity of the handle as the law uses it: backward difference of p, 0 at the first tick; base frame.
  exo_real dp[3]; // m/s
  // Joint torques J' K y before any limit (eq:dob_input).
  exo_real tau_demand[3]; // N.m
  // Whether the controller was in the loop at this tick.
  int32_t engaged; // 0 or 1
  // Whether the joints' motion since the last tick exceeded dq_max or ddq_max, to which the passivity argument is
  // restricted, or is not known because q is doubted.
  int32_t outside_bounds; // 0 or 1
  // Whether sigma_min lies below singularity.sigma_slow, so that the nominal is damped more.
  int32_t slowed; // 0 or 1
  // Whether hold, dp_n_max, the position box or the workspace kept the nominal back at this tick.
  int32_t held; // 0 or 1
  // Share of the torques that the energy budget left at this tick; 1 unless something is wrong.
  exo_real share;
  // Whether the tank is below 0: a motion beyond dq_max and ddq_max cost more than it held; no torque until it is
  // repaid.
  int32_t debt; // 0 or 1
  // Whether on any axis a stiff hand has been found to swing, or makes a swing grow so fast that it is damped before, and
  // has not been quiet since.
  int32_t stiff_hand_detected; // 0 or 1
  // Damping on top of D_n for a stiff hand, and to probe whether a swing is meant; base frame.
  exo_real stiff_hand_D[3]; // N.s/m
  // Stiffness of the hand in the last swing that counted, meant or not, 0 before the first; base frame.
  exo_real stiff_hand_k_h[3]; // N/m
  // Force of the human on the handle as the law uses it, 0 during a fault or a tare; base frame.
  exo_real ft_f_h[3]; // N
  // Moment of the human about the handle under ft.source 2, for information: the law moves a point; base frame.
  exo_real ft_moment[3]; // N.m
  // What is wrong with the force sensor.
  int32_t ft_fault; // 0 none, 1 not_finite, 2 over_range, 3 rate, 4 stuck, 5 dropout
  // How far the last tare has come.
  int32_t ft_tare_state; // 0 off, 1 running, 2 done, 3 failed
  // Why the last tare failed.
  int32_t ft_tare_failure; // 0 none, 1 fault, 2 moved, 3 unsteady, 4 too_large
  // Force that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame.
  exo_real ft_bias_force[3]; // N
  // Moment that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame.
  exo_real ft_bias_torque[3]; // N.m
  // State of the supervision; without it off, engaged, hold or debt, as engage and hold say and the tank allows.
  int32_t state; // 0 off, 1 init, 2 ready, 3 engaged, 4 hold, 5 soft_stop, 6 fault, 7 debt
  // Why the law does not simply run at this tick; always 0 without supervision.
  int32_t diagnostic; // 0 none, 1 emergency_stop, 2 encoder_invalid, 3 not_finite, 4 heartbeat_lost, 5 ft_invalid, 6 energy_debt, 7 outside_bounds, 8 saturated, 9 not_acknowledged, 10 not_enabled, 11 preparing, 12 not_engaged, 13 engage_stuck, 14 force_steady, 15 tool_weight
  // The first fault, kept until it is acknowledged; 0 if there is none.
  int32_t first_fault; // 0 none, 1 emergency_stop, 2 encoder_invalid, 3 not_finite, 4 heartbeat_lost, 5 ft_invalid, 6 energy_debt, 7 outside_bounds, 8 saturated, 9 not_acknowledged, 10 not_enabled, 11 preparing, 12 not_engaged, 13 engage_stuck, 14 force_steady, 15 tool_weight
  // Share of its force that the law exerts; it rises from 0 when the controller engages and falls in a soft stop.
  exo_real authority;
  // Nominal mass matrix M_n(q), row by row; 0 in task space.
  exo_real M_n[9]; // kg.m2
  // Nominal joint angles (eq:obs_dyn); q in task space.
  exo_real q_n[3]; // rad
  // Nominal joint velocities (eq:obs_dyn); 0 in task space.
  exo_real dq_n[3]; // rad/s
  // Position error q_n - q of the joints, after the slip of passive_bounded; 0 in task space.
  exo_real e_q[3]; // rad
  // What is wrong with the joint angles of this tick. A jump, or an angle over range, is doubted for encoder.samples
  // readings: the law goes on at its last velocity. Then there is no torque.
  int32_t encoder_fault; // 0 none, 1 not_finite, 2 over_range, 3 jump, 4 stuck, 5 invalid
  // Whether the tick came in time after the one before.
  int32_t timing; // 0 in_time, 1 late, 2 early
  // Way of the nominal's handle since somebody last varied the force of the hand; 0 unless drift_distance is set, under
  // supervision.
  exo_real unattended; // m
  // By how much the tool is heavier than ft.mass, as far as the last warning tool_weight could tell; 0 before the first.
  exo_real ft_mass_error; // kg
  // What is wrong with tau_a_measured, beside the torques that drives with the law's gains would have given: judged where
  // one has been above a tenth of tau_max over .2 s; 0 in the torque form.
  int32_t drive_fault; // 0 none, 1 missing, 2 wrong_sign
  // Angles for the joints' drives in the sample that begins, held: the nominal's in the middle of that sample; 0 in the
  // torque form.
  double q_d[3]; // rad
  // Velocities for the joints' drives in the sample that begins: the nominal's means in that sample; 0 in the torque form.
  exo_real dq_d[3]; // rad/s
} exo_arm_outputs;

// One variable of a struct.
typedef struct exo_variable {
  // Its name in the FMU, without an index.
  char name[40];
  // In which struct it lies.
  exo_role role;
  // What it is there.
  exo_kind kind;
  // How many elements it has.
  int32_t count;
  // The first element, bytes from the begin of the struct.
  size_t offset;
  // From one element to the next, bytes.
  size_t stride;
} exo_variable;

// Parameters of the law of one axis. Any bits may come from C: what cannot be used is refused by name.
typedef struct exo_axis_parameters {
  // Admittance law.
  int32_t law; // 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded
  // Nominal mass (eq:nom_dyn).
  exo_real M_n; // kg
  // Nominal damping (eq:nom_dyn).
  exo_real D_n; // N.s/m
  // Control gain, 1/epsilon of the paper (eq:dob_input).
  exo_real K; // N.s/m
  // Ratio of the coupling's spring to its damper (eq:dob_input).
  exo_real K_P; // 1/s
  // Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn.
  exo_real alpha; // N.s/m
  // Largest absolute value of tau_a; also the bound of the coupling spring's force under passive_bounded.
  exo_real tau_max; // N
  // Sample period.
  exo_real T; // s
  // Communication steps by which the importer's wiring delays tau_a, its first value being 0; in the C library samples.
  // It changes no force, only from when on the ledger counts a force's work.
  int32_t delay;
  // Energy with which the tank starts and above which it does not fill.
  exo_real E_0; // J
  // Largest speed of the robot: the energy budget covers every motion within it.
  exo_real v_max; // m/s
  // Largest acceleration of the robot: the energy budget covers every motion within it.
  exo_real a_max; // m/s2
  // Corner frequency of a first-order low pass on dq; 0 = off.
  exo_real dq_cutoff; // Hz
  // Lightest effective mass that the robot shows, for gain_warning only.
  exo_real M_min; // kg
  // Time in which changed gains come into force, on a straight line; 0 = at once.
  exo_real tuning_time; // s
  // Largest speed of the nominal; 0 = no limit.
  exo_real dq_n_max; // m/s
  // Whether the nominal keeps within q_n_min and q_n_max.
  int32_t q_n_box; // 0 or 1
  // Least position of the nominal.
  exo_real q_n_min; // m
  // Largest position of the nominal.
  exo_real q_n_max; // m
  // Largest rate of change of tau_a while the controller is in the loop; 0 = no limit.
  exo_real tau_rate_max; // N/s
  // Largest absolute position: a reading beyond it cannot be.
  exo_real encoder_range; // m
  // Change of tau_a in which q must change, too, in its last bit at least; 0 = off. Above what friction holds.
  exo_real encoder_stuck_force; // N
  // Readings in a row after which a jump beyond v_max or encoder.range is a fault, and after which a fault is over; 0 =
  // jumps are believed.
  int32_t encoder_samples;
  // What the robot gets from the controller.
  int32_t form; // 1 torque, 2 position_servo
} exo_axis_parameters;

// What is sensed and asked for at a tick.
typedef struct exo_axis_inputs {
  // Sensed position of the robot; the wall lies on the positive side.
  double q; // m
  // Sensed force of the human on the robot, positive along q.
  exo_real tau_h; // N
  // Whether the controller is in the loop. It engages at the first tick at which this is true, with q_n = q and dq_n
  // = 0; while it is false tau_a is 0.
  int32_t engage; // 0 or 1
  // Whether the nominal stays where it is: the coupling then carries any load within tau_max without drift; the laws
  // 1 to 4 only.
  int32_t hold; // 0 or 1
  // The encoder's own word on q; if false there is no force, at once, until q is valid again, where the law engages
  // anew; the laws 1 to 4 only.
  int32_t encoder_valid; // 0 or 1
  // Measured force of the drive on the robot, mean over the sample that ended, positive along q; the nominal feels it in
  // the servo form, it is not used in the torque form.
  exo_real tau_a_measured; // N
} exo_axis_inputs;

// Memory of one axis's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
typedef struct exo_axis_state {
  uint64_t words[128];
} exo_axis_state;

// What came of a tick; every value is the one at t_k.
typedef struct exo_axis_outputs {
  // Control force on the robot, positive along q, held until the next tick (eq:dob_input, limited).
  exo_real tau_a; // N
  // K*y before any limit (eq:dob_input).
  exo_real tau_demand; // N
  // Nominal position (eq:obs_dyn).
  exo_real q_n; // m
  // Nominal velocity (eq:obs_dyn).
  exo_real dq_n; // m/s
  // Position error q_n - q, after the slip of passive_bounded.
  exo_real e_nr; // m
  // Velocity of the robot as the law uses it: backward difference of q, 0 at the first tick.
  exo_real dq; // m/s
  // Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined.
  exo_real H; // J
  // Energy that the sampled law has created so far, negative: dissipated; 0 if alpha = 0.
  exo_real G; // J
  // Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0 and
  // under the laws natural and sliding_mode, for which no energy is defined.
  exo_real tank; // J
  // Share of the force that the energy budget left at this tick; 1 unless something is wrong.
  exo_real share;
  // Whether tau_max leaves less than tau_demand; in the servo form, whether tau_a_measured has reached tau_max or the
  // spring the bound at which it slips.
  int32_t saturated; // 0 or 1
  // Whether hold, dq_n_max or the position box kept the nominal back at this tick.
  int32_t held; // 0 or 1
  // Whether the motion since the last tick exceeded v_max or a_max, to which the passivity argument is restricted, or is
  // not known because q is doubted.
  int32_t outside_bounds; // 0 or 1
  // Whether the controller was in the loop at this tick.
  int32_t engaged; // 0 or 1
  // Whether the tank is below 0: a motion beyond v_max and a_max cost more than it held; no force until it is
  // repaid. In the servo form, where the tank follows what is measured, the drive is told to stand still until then.
  int32_t debt; // 0 or 1
  // What is wrong with q at this tick. A jump, or a position over range, is doubted for encoder.samples readings: the
  // law goes on at its last velocity. Then there is no force. 0 but for the laws 1 to 4.
  int32_t encoder_fault; // 0 none, 1 not_finite, 2 over_range, 3 jump, 4 stuck, 5 invalid
  // Whether the tick came in time after the one before.
  int32_t timing; // 0 in_time, 1 late, 2 early
  // Position command for the sample that begins, held: the nominal's in the middle of that sample; q_n in the torque form.
  double q_d; // m
  // Velocity command for the sample that begins: the nominal's mean in that sample; dq_n in the torque form.
  exo_real dq_d; // m/s
  // What is wrong with tau_a_measured, beside the force that a drive with the law's gains would have given: judged where
  // that has been above a tenth of tau_max over .2 s; 0 in the torque form.
  int32_t drive_fault; // 0 none, 1 missing, 2 wrong_sign
} exo_axis_outputs;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Version of the library, as text: `EXO_LAW_VERSION` of the header that belongs to it.
const char *exo_law_version(void);

// Size of the number that the library was built with, in bytes: `sizeof(exo_real)`.
size_t exo_law_real_size(void);

// Writes the start values into `parameters`.
exo_status exo_arm_defaults(struct exo_arm_parameters *parameters);

// Writes the start values into `inputs`: engaged, with good sensors, not enabled.
exo_status exo_arm_inputs_defaults(struct exo_arm_inputs *inputs);

// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
// which, and `state` stays as it was.
exo_status exo_arm_init(struct exo_arm_state *state,
                        const struct exo_arm_parameters *parameters,
                        struct exo_refusal *refusal);

// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Of the parameters those count
// that the FMU calls tunable; the others are as they were. Where a gain is refused, all stay as they were.
exo_status exo_arm_tune(struct exo_arm_state *state,
                        const struct exo_arm_parameters *parameters,
                        struct exo_refusal *refusal);

// One tick, every T. Where the status is not 0, `state` stays as it was and `outputs` hold no torque: tau_a, f_a, tau_demand
// and dq_d are 0, the others as they were; drives so stand still at the last q_d. The robot is then the caller's: brakes, or whatever needs no law. `refusal`, which may
// be null, says which input was refused.
exo_status exo_arm_tick(struct exo_arm_state *state,
                        const struct exo_arm_inputs *inputs,
                        struct exo_arm_outputs *outputs,
                        struct exo_refusal *refusal);

// The same where the caller measures time: `dt` (s) is the time from the reading of the positions at the last tick to their
// reading at this one. A tick that is late or early then sees the velocity that there was, and `timing` says so. What else
// becomes of it: docs/real-time.md. A `dt` that is negative or not finite is refused.
exo_status exo_arm_tick_after(struct exo_arm_state *state,
                              double dt,
                              const struct exo_arm_inputs *inputs,
                              struct exo_arm_outputs *outputs,
                              struct exo_refusal *refusal);

// Describes the variable number `i` of the structs of the arm, from 0: parameters, then inputs, then outputs.
exo_status exo_arm_variable(size_t i, struct exo_variable *variable);

// Writes the start values into `parameters`.
exo_status exo_axis_defaults(struct exo_axis_parameters *parameters);

// Writes the start values into `inputs`: engaged, at zero.
exo_status exo_axis_inputs_defaults(struct exo_axis_inputs *inputs);

// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
// which, and `state` stays as it was.
exo_status exo_axis_init(struct exo_axis_state *state,
                         const struct exo_axis_parameters *parameters,
                         struct exo_refusal *refusal);

// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Of the parameters those count
// that the FMU calls tunable; the others are as they were. Where a gain is refused, all stay as they were.
exo_status exo_axis_tune(struct exo_axis_state *state,
                         const struct exo_axis_parameters *parameters,
                         struct exo_refusal *refusal);

// One tick, every T. Where the status is not 0, `state` stays as it was and `outputs` hold no torque: tau_a, tau_demand and
// dq_d are 0, the others as they were; a drive so stands still at the last q_d. The robot is then the caller's: brakes, or whatever needs no law. `refusal`, which may
// be null, says which input was refused.
exo_status exo_axis_tick(struct exo_axis_state *state,
                         const struct exo_axis_inputs *inputs,
                         struct exo_axis_outputs *outputs,
                         struct exo_refusal *refusal);

// The same where the caller measures time: `dt` (s) is the time from the reading of the positions at the last tick to their
// reading at this one. A tick that is late or early then sees the velocity that there was, and `timing` says so. What else
// becomes of it: docs/real-time.md. A `dt` that is negative or not finite is refused.
exo_status exo_axis_tick_after(struct exo_axis_state *state,
                               double dt,
                               const struct exo_axis_inputs *inputs,
                               struct exo_axis_outputs *outputs,
                               struct exo_refusal *refusal);

// Describes the variable number `i` of the structs of one axis, from 0: parameters, then inputs, then outputs.
exo_status exo_axis_variable(size_t i, struct exo_variable *variable);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#ifdef EXO_LAW_F32
// The plain names stand for those of single precision.
#include "exo_law_f32.h"
#define exo_arm_defaults exo_f32_arm_defaults
#define exo_arm_encoder exo_f32_arm_encoder
#define exo_arm_force_sensor exo_f32_arm_force_sensor
#define exo_arm_init exo_f32_arm_init
#define exo_arm_inputs exo_f32_arm_inputs
#define exo_arm_inputs_defaults exo_f32_arm_inputs_defaults
#define exo_arm_joint exo_f32_arm_joint
#define exo_arm_kinematics exo_f32_arm_kinematics
#define exo_arm_link exo_f32_arm_link
#define exo_arm_nominal exo_f32_arm_nominal
#define exo_arm_outputs exo_f32_arm_outputs
#define exo_arm_parameters exo_f32_arm_parameters
#define exo_arm_sensor_checks exo_f32_arm_sensor_checks
#define exo_arm_singularity exo_f32_arm_singularity
#define exo_arm_state exo_f32_arm_state
#define exo_arm_stiff_hand exo_f32_arm_stiff_hand
#define exo_arm_supervision exo_f32_arm_supervision
#define exo_arm_tare exo_f32_arm_tare
#define exo_arm_tick exo_f32_arm_tick
#define exo_arm_tick_after exo_f32_arm_tick_after
#define exo_arm_tool exo_f32_arm_tool
#define exo_arm_tune exo_f32_arm_tune
#define exo_arm_variable exo_f32_arm_variable
#define exo_arm_workspace exo_f32_arm_workspace
#define exo_axis_defaults exo_f32_axis_defaults
#define exo_axis_init exo_f32_axis_init
#define exo_axis_inputs exo_f32_axis_inputs
#define exo_axis_inputs_defaults exo_f32_axis_inputs_defaults
#define exo_axis_outputs exo_f32_axis_outputs
#define exo_axis_parameters exo_f32_axis_parameters
#define exo_axis_state exo_f32_axis_state
#define exo_axis_tick exo_f32_axis_tick
#define exo_axis_tick_after exo_f32_axis_tick_after
#define exo_axis_tune exo_f32_axis_tune
#define exo_axis_variable exo_f32_axis_variable
#define exo_law_real_size exo_f32_law_real_size
#define exo_law_version exo_f32_law_version
#define exo_real exo_f32_real
#define exo_refusal exo_f32_refusal
#endif

#endif  /* EXO_LAW_H */
