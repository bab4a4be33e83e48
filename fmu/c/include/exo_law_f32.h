/*
 * The admittance laws as a C library in single precision: what exo_law.h declares, with names that begin with exo_f32_.
 *
 * A program that uses no other precision defines EXO_LAW_F32, includes exo_law.h and writes the names of that header.
 */

#ifndef EXO_LAW_F32_H
#define EXO_LAW_F32_H

/* Generated from fmu/c/src by `cargo xtask law --bless`: do not edit. */

#include "exo_law.h"

// The law's number: double precision, or single precision in the packages and libraries named f32.
typedef float exo_f32_real;
// The lengths that place the handle. The start values are the exoskeleton arm's.
typedef struct exo_f32_arm_kinematics {
  // Length from the yaw axis forward to the shoulder's pitch axis.
  exo_f32_real A1; // m
  // Length from the shoulder's pitch axis to the elbow's.
  exo_f32_real L1; // m
  // Handle in link 3's frame: from the elbow's axis along the link, L2 of the arm.
  exo_f32_real handle_x; // m
  // Handle in link 3's frame: across the link, upwards when it is level.
  exo_f32_real handle_z; // m
} exo_f32_arm_kinematics;

// What the joints' positions must keep to. The arm's joints turn less than once.
typedef struct exo_f32_arm_encoder {
  // Largest absolute joint angle: a reading beyond it cannot be.
  exo_f32_real range[3]; // rad
  // Change of a joint's torque in which its angle must change, too, in its last bit at least; 0 = off. Above what
  // friction holds.
  exo_f32_real stuck_torque[3]; // N.m
  // Readings in a row after which a jump beyond dq_max or encoder.range is a fault, and after which a fault is over; 0 =
  // jumps are believed.
  int32_t samples;
} exo_f32_arm_encoder;

// Everything beyond the sensor that the hand does not carry: handle, adapter, half of the sensor. At the start there is none,
// on an arm that stands upright.
typedef struct exo_f32_arm_tool {
  // Mass of the tool behind the sensor, whose weight is taken off; 0 = none.
  exo_f32_real mass; // kg
  // Centre of gravity of the tool from the sensor's origin; sensor frame.
  exo_f32_real cog[3]; // m
  // Acceleration of gravity; base frame.
  exo_f32_real gravity[3]; // m/s2
} exo_f32_arm_tool;

// The checks. At the start all are off but for NaN and infinity.
typedef struct exo_f32_arm_sensor_checks {
  // Absolute value at which a force component is over range; 0 = off.
  exo_f32_real range_force; // N
  // Absolute value at which a moment component is over range; 0 = off.
  exo_f32_real range_torque; // N.m
  // Rate at which a force component is a fault; 0 = off.
  exo_f32_real rate_force; // N/s
  // Rate at which a moment component is a fault; 0 = off.
  exo_f32_real rate_torque; // N.m/s
  // Repetitions of a reading, bit for bit, after which the sensor is stuck; 0 = off. For sensors with noise that are
  // read at every tick.
  int32_t stuck_samples;
  // Readings of exactly 0 on all axes after which the sensor has dropped out; 0 = off. For sensors with noise.
  int32_t dropout_samples;
  // Time for which the signal must be sound before a fault is over.
  exo_f32_real recovery_time; // s
} exo_f32_arm_sensor_checks;

// What a tare asks for. The start values: half a second; the least count of a 14-bit encoder three times over; a hand's tremor
// does not pass.
typedef struct exo_f32_arm_tare {
  // Time for which a tare takes samples.
  exo_f32_real time; // s
  // Motion of a joint beyond which a tare fails.
  exo_f32_real motion; // rad
  // Standard deviation of a force component beyond which a tare fails; 0 = any.
  exo_f32_real spread_force; // N
  // Standard deviation of a moment component beyond which a tare fails; 0 = any.
  exo_f32_real spread_torque; // N.m
  // Force component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any.
  exo_f32_real max_force; // N
  // Moment component of the bias beyond which a tare fails: somebody leans on the handle; 0 = any.
  exo_f32_real max_torque; // N.m
} exo_f32_arm_tare;

// What the sensor is like and what is made of its reading: the parameters `ft.*`. At the start a force in the base frame, as
// it is.
typedef struct exo_f32_arm_force_sensor {
  // Where the force of the human is read.
  int32_t source; // 1 f_h, 2 wrench
  // Frame in which f_h is given.
  int32_t frame; // 1 base, 2 sensor
  // Orientation of the sensor in link 3's frame under ft.source 2: roll, pitch, yaw, turns about link 3's fixed axes
  // x, then y, then z.
  exo_f32_real mount[3]; // rad
  // Lever arm: the handle from the sensor's origin; sensor frame.
  exo_f32_real handle[3]; // m
  // What hangs on it.
  struct exo_f32_arm_tool tool;
  // Length by which every force is shortened, and below which it is 0; 0 = off.
  exo_f32_real deadband; // N
  // Corner frequency of a first-order low pass on the force; it costs phase; 0 = off.
  exo_f32_real cutoff; // Hz
  // How it may fail.
  struct exo_f32_arm_sensor_checks checks;
  // How its bias is found.
  struct exo_f32_arm_tare tare;
} exo_f32_arm_force_sensor;

// Where the nominal may go. The start values leave 0.1 rad before the stops of the exoskeleton arm; and 0.4 rad where the
// elbow would become straight, so that f_max still bends it with twice its stiction.
typedef struct exo_f32_arm_workspace {
  // 1: the nominal keeps within the workspace, which is the exoskeleton arm's: workspace.q_min to workspace.q_max, and
  // in task space workspace.radius_min; an arm that engages beyond may only come back. 0: it may go anywhere. An
  // Integer, because fmpy takes a false in a parameter set for true.
  int32_t limited;
  // Least angle of each joint of the nominal, with room before the arm's stop or before a straight elbow.
  exo_f32_real q_min[3]; // rad
  // Largest angle of each joint of the nominal, with room before the arm's stop.
  exo_f32_real q_max[3]; // rad
  // Least distance of the nominal handle from the yaw axis, in task space, where the axis is a singularity.
  exo_f32_real radius_min; // m
  // Slowing: a limit is approached no faster than the distance that is left over this time, at least T.
  exo_f32_real slowing_time; // s
} exo_f32_arm_workspace;

// When and how much the nominal is slowed. The start values: two thirds of the least sigma_min that the paper's experiments
// come to (0.18 m/rad), and a damping that takes the speed from the nominal within the few centimetres that are left.
typedef struct exo_f32_arm_singularity {
  // sigma_min below which the nominal is damped more; 0 = off.
  exo_f32_real sigma_slow; // m/rad
  // Slowing: below sigma_slow D_n is raised by singularity.D*((sigma_slow/sigma_min)^2 - 1), at most by 15
  // singularity.D.
  exo_f32_real D; // N.s/m
} exo_f32_arm_singularity;

// The parameters `stiff_hand.*`, the same on all axes. At the start nobody watches. The band holds the unstable swings of the
// arm from 300 to 10000 N/m (1.1 to 7 Hz) and none of the paper's motions (0.25 to 0.8 Hz); D_max holds a hand of 2762 N/m
// on the arm's x axis with the paper's gains.
typedef struct exo_f32_arm_stiff_hand {
  // Whether a hand too stiff for the gains is looked for and answered with damping.
  int32_t active; // 0 or 1
  // Largest damping on top of D_n, for a stiff hand that is detected.
  exo_f32_real D_max; // N.s/m
  // Lower edge of the band in which a stiff hand is looked for, above the motions that the operator means.
  exo_f32_real f_low; // Hz
  // Upper edge of that band, above stiff_hand.f_low and at most 1/(8*T).
  exo_f32_real f_high; // Hz
  // Amplitude of f_h in the band from which on a swing counts.
  exo_f32_real f_min; // N
  // Factor, greater than 1, by which f_h has to grow from one period of a swing to the next to be probed before it has
  // lasted.
  exo_f32_real growth;
  // Time in which the damping rises to stiff_hand.D_max.
  exo_f32_real attack; // s
  // Time without a swing of that hand after which the damping is given back.
  exo_f32_real quiet; // s
  // Time in which it is given back.
  exo_f32_real release; // s
  // Number of periods that a swing which does not grow has to last, with one and the same hand, before it is probed.
  int32_t periods;
  // Damping that probes whether a swing is meant, over the magnitude of the hand's impedance f_h/dp in it. The
  // stiffness of a hand stays under the probe; what a meant force seems to have of it changes by about this share.
  exo_f32_real probe;
  // Time after a swing that was found to be meant in which no other one is probed, unless it ends before.
  exo_f32_real pause; // s
} exo_f32_arm_stiff_hand;

// What can be set. Times are rounded to whole ticks. The start values: half a second to engage and to stop, a heartbeat of
// 10 Hz or more, no hold but by request.
typedef struct exo_f32_arm_supervision {
  // For how long sensors and heartbeat must have been good before the controller is ready.
  exo_f32_real init_time; // s
  // Time in which the authority rises from 0 to 1; one tick at least.
  exo_f32_real engage_time; // s
  // Time in which the authority falls to 0 in a soft stop; one tick at least.
  exo_f32_real soft_stop_time; // s
  // Time within which heartbeat must change; 0 = it is not watched.
  exo_f32_real heartbeat_timeout; // s
  // Magnitude of f_h below which the hand is at rest and the controller holds by itself; 0 = it never does.
  exo_f32_real hold_enter; // N
  // Magnitude of f_h above which the hand is no longer at rest; not below hold_enter.
  exo_f32_real hold_leave; // N
  // For how long f_h must have been below hold_enter before the hand is at rest.
  exo_f32_real hold_time; // s
  // Time in which supervision brings a moving nominal to rest; one tick at least.
  exo_f32_real hold_brake; // s
  // For how long limits may act before diagnostic reports it; 0 = it does not.
  exo_f32_real saturation_time; // s
  // Farthest that the nominal's handle moves while nobody varies the force of the hand; then it holds. 0 = any distance.
  exo_f32_real drift_distance; // m
  // Change of the hand's force that shows a hand, if it comes within drift_time.
  exo_f32_real drift_band; // N
  // Time within which a hand varies its force by drift_band; what takes longer is a drift.
  exo_f32_real drift_time; // s
  // For how long a force that nobody varies may press on a nominal that is held for it, before a soft stop; 0 = for ever.
  exo_f32_real drift_stop_time; // s
  // Largest error of ft.mass that is reckoned with: a change of force that it explains, as the tool turns, shows no hand.
  exo_f32_real drift_mass; // kg
} exo_f32_arm_supervision;

// The parameters `joint.*`: what the form in joint space has of its own. The start values are about the task-space gains
// (1000 N·s/m, 20 N·s/m) at the start pose: seen from the handle, D_n/(JJᵀ)_zz is 15 N·s/m and K/(JJᵀ)_zz 1500 N·s/m. The
// unit damper alpha is then 3.7 N·s/m, so a load sinks faster than at the handle.
typedef struct exo_f32_arm_joint {
  // Nominal damping of each joint in joint space (eq:nom_dyn).
  exo_f32_real D_n[3]; // N.m.s/rad
  // Control gain in joint space, 1/epsilon of the paper (eq:dob_input); one number for all joints, because with
  // different ones a free robot can be unstable.
  exo_f32_real K; // N.m.s/rad
  // Ratio of each joint's coupling spring to its damper in joint space (eq:dob_input).
  exo_f32_real K_P[3]; // 1/s
  // Largest speed of the nominal's joints in joint space; 0 = no limit.
  exo_f32_real dq_n_max[3]; // rad/s
  // Whether the nominal keeps within joint.q_n_min and joint.q_n_max in joint space.
  int32_t q_n_box; // 0 or 1
  // Least angles of the nominal's joints.
  exo_f32_real q_n_min[3]; // rad
  // Largest angles of the nominal's joints.
  exo_f32_real q_n_max[3]; // rad
} exo_f32_arm_joint;

// A link of the nominal arm, in the link's frame: origin on its joint's axis, x along it, z up when it is level.
typedef struct exo_f32_arm_link {
  // Mass of each link of the nominal arm, which has the lengths kinematics.* and no weight.
  exo_f32_real m; // kg
  // Centre of mass of each nominal link along it, from its joint's axis.
  exo_f32_real x; // m
  // Centre of mass of each nominal link across it, upwards when it is level.
  exo_f32_real z; // m
  // Moment of inertia of each nominal link about x through its centre of mass.
  exo_f32_real I_xx; // kg.m2
  // Moment of inertia of each nominal link about y through its centre of mass.
  exo_f32_real I_yy; // kg.m2
  // Moment of inertia of each nominal link about z through its centre of mass.
  exo_f32_real I_zz; // kg.m2
  // Element xz of each nominal link's inertia matrix, the negative product of inertia.
  exo_f32_real I_xz; // kg.m2
} exo_f32_arm_link;

// What the nominal arm is made of. Its lengths are those of the kinematics. The start values: half the mass of the
// exoskeleton arm's links and 0.4 kg·m² at each joint. At the start pose M_n is 0.53 and [0.68 0.06; 0.06 0.46] kg·m²; the
// robot's, with its reflected rotors, is 3 to 8 kg·m².
typedef struct exo_f32_arm_nominal {
  // The three links.
  struct exo_f32_arm_link links[3];
  // Inertia of each nominal joint about its own axis, as the joint feels it.
  exo_f32_real rotor[3]; // kg.m2
} exo_f32_arm_nominal;

// Parameters of the arm's law. Vectors are along x, y, z of the base frame, or by joint. Any bits may come
// from C: what cannot be used is refused by name.
typedef struct exo_f32_arm_parameters {
  // Admittance law.
  int32_t law; // 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded
  // Nominal mass along x, y, z (eq:nom_dyn in task space).
  exo_f32_real Lambda_n[3]; // kg
  // Nominal damping along x, y, z (eq:nom_dyn in task space).
  exo_f32_real D_n[3]; // N.s/m
  // Control gain along x, y, z, 1/epsilon of the paper (eq:dob_input).
  exo_f32_real K[3]; // N.s/m
  // Ratio of the coupling's spring to its damper along x, y, z (eq:dob_input).
  exo_f32_real K_P[3]; // 1/s
  // Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn.
  exo_f32_real alpha; // N.s/m
  // Largest force of the controller along x, y, z and bound of the coupling spring's force, under passive_bounded;
  // the other laws have no limit but tau_max.
  exo_f32_real f_max[3]; // N
  // Largest absolute value of tau_a.
  exo_f32_real tau_max[3]; // N.m
  // How joint torques beyond tau_max are brought within; clip under the laws standard and passive only.
  int32_t torque_limiting; // 1 scale, 2 clip
  // Sample period.
  exo_f32_real T; // s
  // Communication steps by which the importer's wiring delays tau_a, its first value being 0; in the C library samples.
  // It changes no torque, only from when on the ledger counts a torque's work.
  int32_t delay;
  // Energy with which the tank starts and above which it does not fill.
  exo_f32_real E_0; // J
  // Largest speed of the joints: the energy budget covers every motion within it.
  exo_f32_real dq_max[3]; // rad/s
  // Largest acceleration of the joints: the energy budget covers every motion within it.
  exo_f32_real ddq_max[3]; // rad/s2
  // Corner frequency of a first-order low pass on dp; 0 = off.
  exo_f32_real dp_cutoff; // Hz
  // Lightest effective mass that the robot shows along an axis, for gain_warning only.
  exo_f32_real M_min; // kg
  // Time in which changed gains come into force, on a straight line; 0 = at once.
  exo_f32_real tuning_time; // s
  // Largest speed of the nominal along x, y, z; 0 = no limit.
  exo_f32_real dp_n_max[3]; // m/s
  // Whether the nominal keeps within p_n_min and p_n_max.
  int32_t p_n_box; // 0 or 1
  // Least position of the nominal handle along x, y, z; base frame.
  exo_f32_real p_n_min[3]; // m
  // Largest position of the nominal handle along x, y, z; base frame.
  exo_f32_real p_n_max[3]; // m
  // Largest rate of change of tau_a while the controller is in the loop; 0 = no limit.
  exo_f32_real tau_rate_max[3]; // N.m/s
  // Where the handle is.
  struct exo_f32_arm_kinematics kinematics;
  // The joints' encoders.
  struct exo_f32_arm_encoder encoder;
  // The hand's force sensor.
  struct exo_f32_arm_force_sensor ft;
  // Where the nominal may go.
  struct exo_f32_arm_workspace workspace;
  // Slowing before a singularity.
  struct exo_f32_arm_singularity singularity;
  // Damping for a hand too stiff for the gains.
  struct exo_f32_arm_stiff_hand stiff_hand;
  // Whether supervision decides when the law may act; if not, engage alone does.
  int32_t supervision; // 0 or 1
  // Its times and thresholds.
  struct exo_f32_arm_supervision supervisor;
  // Coordinates in which the nominal lives.
  int32_t space; // 1 task, 2 joint
  // The form in joint space.
  struct exo_f32_arm_joint joint;
  // Its nominal arm.
  struct exo_f32_arm_nominal nominal;
  // What the robot gets from the controller.
  int32_t form; // 1 torque, 2 position_servo
} exo_f32_arm_parameters;

// What is sensed and asked for at a tick.
typedef struct exo_f32_arm_inputs {
  // Sensed joint angles: yaw about z, shoulder pitch and elbow pitch about -y, so that positive pitch lifts.
  double q[3]; // rad
  // Sensed force of the human on the handle, in the frame that ft.frame says, under ft.source 1. It may be NaN,
  // which ft.fault names.
  exo_f32_real f_h[3]; // N
  // Whether the controller is in the loop. It engages at the first tick at which this is true, with p_n = p and dp_n
  // = 0; while it is false tau_a is 0.
  int32_t engage; // 0 or 1
  // Whether the nominal stays where it is: the coupling then carries any load within f_max without drift.
  int32_t hold; // 0 or 1
  // Raw force that acts on the sensor's tool, in the sensor's frame, under ft.source 2. It may be NaN, which
  // ft.fault names.
  exo_f32_real ft_force[3]; // N
  // Raw moment that acts on the sensor's tool about the sensor's origin, in the sensor's frame, under ft.source 2.
  // It may be NaN, which ft.fault names.
  exo_f32_real ft_torque[3]; // N.m
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
  exo_f32_real tau_a_measured[3]; // N.m
} exo_f32_arm_inputs;

// Memory of an arm's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
typedef struct exo_f32_arm_state {
  uint64_t words[640];
} exo_f32_arm_state;

// Which value was refused. All texts end with a zero byte.
typedef struct exo_f32_refusal {
  // The variable, by its name in the FMU; empty if none was refused.
  char name[40];
  // What it should have been.
  char expected[120];
  // Its axis or joint, from 1; 0 if it has none.
  int32_t axis;
  // Its value.
  exo_f32_real value;
} exo_f32_refusal;

// What came of a tick; every value is the one at t_k, vectors at the handle in the base frame.
typedef struct exo_f32_arm_outputs {
  // Control torques on the joints, positive like q, held until the next tick (J' f_a, limited).
  exo_f32_real tau_a[3]; // N.m
  // Position of the handle by the controller's kinematics; base frame.
  exo_f32_real p[3]; // m
  // Nominal position of the handle (eq:obs_dyn); base frame.
  exo_f32_real p_n[3]; // m
  // Nominal velocity of the handle (eq:obs_dyn); base frame.
  exo_f32_real dp_n[3]; // m/s
  // Position error p_n - p, after the slip of passive_bounded; base frame.
  exo_f32_real e_nr[3]; // m
  // Force on the robot at the handle that tau_a amounts to (eq:dob_input, limited); base frame.
  exo_f32_real f_a[3]; // N
  // Whether f_max (under passive_bounded) or tau_max leaves less than tau_demand.
  int32_t saturated; // 0 or 1
  // Smallest singular value of the handle's Jacobian; 0 at a singularity.
  exo_f32_real sigma_min; // m/rad
  // Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined.
  exo_f32_real H; // J
  // Energy that the sampled law has created so far, counted with the work of tau_a at the joints; negative:
  // dissipated; 0 if alpha = 0.
  exo_f32_real G; // J
  // Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0.
  exo_f32_real tank; // J
  // Velocity of the handle as the law uses it: backward difference of p, 0 at the first tick; base frame.
  exo_f32_real dp[3]; // m/s
  // Joint torques J' K y before any limit (eq:dob_input).
  exo_f32_real tau_demand[3]; // N.m
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
  exo_f32_real share;
  // Whether the tank is below 0: a motion beyond dq_max and ddq_max cost more than it held; no torque until it is
  // repaid.
  int32_t debt; // 0 or 1
  // Whether on any axis a stiff hand has been found to swing, or makes a swing grow so fast that it is damped before, and
  // has not been quiet since.
  int32_t stiff_hand_detected; // 0 or 1
  // Damping on top of D_n for a stiff hand, and to probe whether a swing is meant; base frame.
  exo_f32_real stiff_hand_D[3]; // N.s/m
  // Stiffness of the hand in the last swing that counted, meant or not, 0 before the first; base frame.
  exo_f32_real stiff_hand_k_h[3]; // N/m
  // Force of the human on the handle as the law uses it, 0 during a fault or a tare; base frame.
  exo_f32_real ft_f_h[3]; // N
  // Moment of the human about the handle under ft.source 2, for information: the law moves a point; base frame.
  exo_f32_real ft_moment[3]; // N.m
  // What is wrong with the force sensor.
  int32_t ft_fault; // 0 none, 1 not_finite, 2 over_range, 3 rate, 4 stuck, 5 dropout
  // How far the last tare has come.
  int32_t ft_tare_state; // 0 off, 1 running, 2 done, 3 failed
  // Why the last tare failed.
  int32_t ft_tare_failure; // 0 none, 1 fault, 2 moved, 3 unsteady, 4 too_large
  // Force that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame.
  exo_f32_real ft_bias_force[3]; // N
  // Moment that the sensor shows when nothing acts on it, from the last tare that was done; sensor frame.
  exo_f32_real ft_bias_torque[3]; // N.m
  // State of the supervision; without it off, engaged, hold or debt, as engage and hold say and the tank allows.
  int32_t state; // 0 off, 1 init, 2 ready, 3 engaged, 4 hold, 5 soft_stop, 6 fault, 7 debt
  // Why the law does not simply run at this tick; always 0 without supervision.
  int32_t diagnostic; // 0 none, 1 emergency_stop, 2 encoder_invalid, 3 not_finite, 4 heartbeat_lost, 5 ft_invalid, 6 energy_debt, 7 outside_bounds, 8 saturated, 9 not_acknowledged, 10 not_enabled, 11 preparing, 12 not_engaged, 13 engage_stuck, 14 force_steady, 15 tool_weight
  // The first fault, kept until it is acknowledged; 0 if there is none.
  int32_t first_fault; // 0 none, 1 emergency_stop, 2 encoder_invalid, 3 not_finite, 4 heartbeat_lost, 5 ft_invalid, 6 energy_debt, 7 outside_bounds, 8 saturated, 9 not_acknowledged, 10 not_enabled, 11 preparing, 12 not_engaged, 13 engage_stuck, 14 force_steady, 15 tool_weight
  // Share of its force that the law exerts; it rises from 0 when the controller engages and falls in a soft stop.
  exo_f32_real authority;
  // Nominal mass matrix M_n(q), row by row; 0 in task space.
  exo_f32_real M_n[9]; // kg.m2
  // Nominal joint angles (eq:obs_dyn); q in task space.
  exo_f32_real q_n[3]; // rad
  // Nominal joint velocities (eq:obs_dyn); 0 in task space.
  exo_f32_real dq_n[3]; // rad/s
  // Position error q_n - q of the joints, after the slip of passive_bounded; 0 in task space.
  exo_f32_real e_q[3]; // rad
  // What is wrong with the joint angles of this tick. A jump, or an angle over range, is doubted for encoder.samples
  // readings: the law goes on at its last velocity. Then there is no torque.
  int32_t encoder_fault; // 0 none, 1 not_finite, 2 over_range, 3 jump, 4 stuck, 5 invalid
  // Whether the tick came in time after the one before.
  int32_t timing; // 0 in_time, 1 late, 2 early
  // Way of the nominal's handle since somebody last varied the force of the hand; 0 unless drift_distance is set, under
  // supervision.
  exo_f32_real unattended; // m
  // By how much the tool is heavier than ft.mass, as far as the last warning tool_weight could tell; 0 before the first.
  exo_f32_real ft_mass_error; // kg
  // What is wrong with tau_a_measured, beside the torques that drives with the law's gains would have given: judged where
  // one has been above a tenth of tau_max over .2 s; 0 in the torque form.
  int32_t drive_fault; // 0 none, 1 missing, 2 wrong_sign
  // Angles for the joints' drives in the sample that begins, held: the nominal's in the middle of that sample; 0 in the
  // torque form.
  double q_d[3]; // rad
  // Velocities for the joints' drives in the sample that begins: the nominal's means in that sample; 0 in the torque form.
  exo_f32_real dq_d[3]; // rad/s
} exo_f32_arm_outputs;

// Parameters of the law of one axis. Any bits may come from C: what cannot be used is refused by name.
typedef struct exo_f32_axis_parameters {
  // Admittance law.
  int32_t law; // 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded
  // Nominal mass (eq:nom_dyn).
  exo_f32_real M_n; // kg
  // Nominal damping (eq:nom_dyn).
  exo_f32_real D_n; // N.s/m
  // Control gain, 1/epsilon of the paper (eq:dob_input).
  exo_f32_real K; // N.s/m
  // Ratio of the coupling's spring to its damper (eq:dob_input).
  exo_f32_real K_P; // 1/s
  // Damper between y and the reaction on the nominal; 1 is the unit damper that the paper hides in eq:obs_dyn.
  exo_f32_real alpha; // N.s/m
  // Largest absolute value of tau_a; also the bound of the coupling spring's force under passive_bounded.
  exo_f32_real tau_max; // N
  // Sample period.
  exo_f32_real T; // s
  // Communication steps by which the importer's wiring delays tau_a, its first value being 0; in the C library samples.
  // It changes no force, only from when on the ledger counts a force's work.
  int32_t delay;
  // Energy with which the tank starts and above which it does not fill.
  exo_f32_real E_0; // J
  // Largest speed of the robot: the energy budget covers every motion within it.
  exo_f32_real v_max; // m/s
  // Largest acceleration of the robot: the energy budget covers every motion within it.
  exo_f32_real a_max; // m/s2
  // Corner frequency of a first-order low pass on dq; 0 = off.
  exo_f32_real dq_cutoff; // Hz
  // Lightest effective mass that the robot shows, for gain_warning only.
  exo_f32_real M_min; // kg
  // Time in which changed gains come into force, on a straight line; 0 = at once.
  exo_f32_real tuning_time; // s
  // Largest speed of the nominal; 0 = no limit.
  exo_f32_real dq_n_max; // m/s
  // Whether the nominal keeps within q_n_min and q_n_max.
  int32_t q_n_box; // 0 or 1
  // Least position of the nominal.
  exo_f32_real q_n_min; // m
  // Largest position of the nominal.
  exo_f32_real q_n_max; // m
  // Largest rate of change of tau_a while the controller is in the loop; 0 = no limit.
  exo_f32_real tau_rate_max; // N/s
  // Largest absolute position: a reading beyond it cannot be.
  exo_f32_real encoder_range; // m
  // Change of tau_a in which q must change, too, in its last bit at least; 0 = off. Above what friction holds.
  exo_f32_real encoder_stuck_force; // N
  // Readings in a row after which a jump beyond v_max or encoder.range is a fault, and after which a fault is over; 0 =
  // jumps are believed.
  int32_t encoder_samples;
  // What the robot gets from the controller.
  int32_t form; // 1 torque, 2 position_servo
} exo_f32_axis_parameters;

// What is sensed and asked for at a tick.
typedef struct exo_f32_axis_inputs {
  // Sensed position of the robot; the wall lies on the positive side.
  double q; // m
  // Sensed force of the human on the robot, positive along q.
  exo_f32_real tau_h; // N
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
  exo_f32_real tau_a_measured; // N
} exo_f32_axis_inputs;

// Memory of one axis's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
typedef struct exo_f32_axis_state {
  uint64_t words[128];
} exo_f32_axis_state;

// What came of a tick; every value is the one at t_k.
typedef struct exo_f32_axis_outputs {
  // Control force on the robot, positive along q, held until the next tick (eq:dob_input, limited).
  exo_f32_real tau_a; // N
  // K*y before any limit (eq:dob_input).
  exo_f32_real tau_demand; // N
  // Nominal position (eq:obs_dyn).
  exo_f32_real q_n; // m
  // Nominal velocity (eq:obs_dyn).
  exo_f32_real dq_n; // m/s
  // Position error q_n - q, after the slip of passive_bounded.
  exo_f32_real e_nr; // m
  // Velocity of the robot as the law uses it: backward difference of q, 0 at the first tick.
  exo_f32_real dq; // m/s
  // Energy stored in nominal mass and coupling spring; 0 if alpha = 0, for which it is not defined.
  exo_f32_real H; // J
  // Energy that the sampled law has created so far, negative: dissipated; 0 if alpha = 0.
  exo_f32_real G; // J
  // Energy tank: energy.E_0 less what was created, refilled by dissipation up to energy.E_0; 0 if alpha = 0 and
  // under the laws natural and sliding_mode, for which no energy is defined.
  exo_f32_real tank; // J
  // Share of the force that the energy budget left at this tick; 1 unless something is wrong.
  exo_f32_real share;
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
  exo_f32_real dq_d; // m/s
  // What is wrong with tau_a_measured, beside the force that a drive with the law's gains would have given: judged where
  // that has been above a tenth of tau_max over .2 s; 0 in the torque form.
  int32_t drive_fault; // 0 none, 1 missing, 2 wrong_sign
} exo_f32_axis_outputs;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Version of the library, as text: `EXO_LAW_VERSION` of the header that belongs to it.
const char *exo_f32_law_version(void);

// Size of the number that the library was built with, in bytes: `sizeof(exo_f32_real)`.
size_t exo_f32_law_real_size(void);

// Writes the start values into `parameters`.
exo_status exo_f32_arm_defaults(struct exo_f32_arm_parameters *parameters);

// Writes the start values into `inputs`: engaged, with good sensors, not enabled.
exo_status exo_f32_arm_inputs_defaults(struct exo_f32_arm_inputs *inputs);

// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
// which, and `state` stays as it was.
exo_status exo_f32_arm_init(struct exo_f32_arm_state *state,
                        const struct exo_f32_arm_parameters *parameters,
                        struct exo_f32_refusal *refusal);

// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Of the parameters those count
// that the FMU calls tunable; the others are as they were. Where a gain is refused, all stay as they were.
exo_status exo_f32_arm_tune(struct exo_f32_arm_state *state,
                        const struct exo_f32_arm_parameters *parameters,
                        struct exo_f32_refusal *refusal);

// One tick, every T. Where the status is not 0, `state` stays as it was and `outputs` hold no torque: tau_a, f_a, tau_demand
// and dq_d are 0, the others as they were; drives so stand still at the last q_d. The robot is then the caller's: brakes, or whatever needs no law. `refusal`, which may
// be null, says which input was refused.
exo_status exo_f32_arm_tick(struct exo_f32_arm_state *state,
                        const struct exo_f32_arm_inputs *inputs,
                        struct exo_f32_arm_outputs *outputs,
                        struct exo_f32_refusal *refusal);

// The same where the caller measures time: `dt` (s) is the time from the reading of the positions at the last tick to their
// reading at this one. A tick that is late or early then sees the velocity that there was, and `timing` says so. What else
// becomes of it: docs/real-time.md. A `dt` that is negative or not finite is refused.
exo_status exo_f32_arm_tick_after(struct exo_f32_arm_state *state,
                              double dt,
                              const struct exo_f32_arm_inputs *inputs,
                              struct exo_f32_arm_outputs *outputs,
                              struct exo_f32_refusal *refusal);

// Describes the variable number `i` of the structs of the arm, from 0: parameters, then inputs, then outputs.
exo_status exo_f32_arm_variable(size_t i, struct exo_variable *variable);

// Writes the start values into `parameters`.
exo_status exo_f32_axis_defaults(struct exo_f32_axis_parameters *parameters);

// Writes the start values into `inputs`: engaged, at zero.
exo_status exo_f32_axis_inputs_defaults(struct exo_f32_axis_inputs *inputs);

// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
// which, and `state` stays as it was.
exo_status exo_f32_axis_init(struct exo_f32_axis_state *state,
                         const struct exo_f32_axis_parameters *parameters,
                         struct exo_f32_refusal *refusal);

// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Of the parameters those count
// that the FMU calls tunable; the others are as they were. Where a gain is refused, all stay as they were.
exo_status exo_f32_axis_tune(struct exo_f32_axis_state *state,
                         const struct exo_f32_axis_parameters *parameters,
                         struct exo_f32_refusal *refusal);

// One tick, every T. Where the status is not 0, `state` stays as it was and `outputs` hold no torque: tau_a, tau_demand and
// dq_d are 0, the others as they were; a drive so stands still at the last q_d. The robot is then the caller's: brakes, or whatever needs no law. `refusal`, which may
// be null, says which input was refused.
exo_status exo_f32_axis_tick(struct exo_f32_axis_state *state,
                         const struct exo_f32_axis_inputs *inputs,
                         struct exo_f32_axis_outputs *outputs,
                         struct exo_f32_refusal *refusal);

// The same where the caller measures time: `dt` (s) is the time from the reading of the positions at the last tick to their
// reading at this one. A tick that is late or early then sees the velocity that there was, and `timing` says so. What else
// becomes of it: docs/real-time.md. A `dt` that is negative or not finite is refused.
exo_status exo_f32_axis_tick_after(struct exo_f32_axis_state *state,
                               double dt,
                               const struct exo_f32_axis_inputs *inputs,
                               struct exo_f32_axis_outputs *outputs,
                               struct exo_f32_refusal *refusal);

// Describes the variable number `i` of the structs of one axis, from 0: parameters, then inputs, then outputs.
exo_status exo_f32_axis_variable(size_t i, struct exo_variable *variable);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* EXO_LAW_F32_H */
