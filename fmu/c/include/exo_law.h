/*
 * The admittance laws as a C library: one axis, and the arm.
 *
 * Define EXO_LAW_F32 before including this header to use the library built in single precision.
 * docs/real-time.md says how to link, in which order to call, and what is promised.
 */

#ifndef EXO_LAW_H
#define EXO_LAW_H

/* Generated from fmu/c/src by `cargo xtask law --bless`: do not edit. */

#include <stddef.h>
#include <stdint.h>

// What a call returns; everything but `Ok` changed nothing.
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
};
#ifndef __cplusplus
typedef int32_t exo_status;
#endif // __cplusplus

#if !defined(EXO_LAW_F32)
// The law's number: double precision, or single precision in the library `exo_law_f32`.
typedef double exo_real;
#endif

#if defined(EXO_LAW_F32)
// The law's number: double precision, or single precision in the library `exo_law_f32`.
typedef float exo_real;
#endif

// Gains of the arm along x, y, z of the base frame.
typedef struct exo_arm_gains {
  // Nominal mass, kg, > 0.
  exo_real Lambda_n[3];
  // Nominal damping, N·s/m, ≥ 0.
  exo_real D_n[3];
  // Control gain, N·s/m, > 0.
  exo_real K[3];
  // Ratio of the coupling's spring to its damper, 1/s, > 0.
  exo_real K_P[3];
  // Largest force on the robot under `passive_bounded`, N, > 0; the other laws live on the torque limits alone.
  exo_real f_max[3];
} exo_arm_gains;

// The lengths that place the handle, m.
typedef struct exo_arm_kinematics {
  // From the yaw axis forward to the shoulder's pitch axis.
  exo_real A1;
  // From the shoulder's pitch axis to the elbow's.
  exo_real L1;
  // Handle in link 3's frame: from the elbow's axis along the link.
  exo_real handle_x;
  // Handle in link 3's frame: across the link, upwards when it is level.
  exo_real handle_z;
} exo_arm_kinematics;

// Slowing before a singularity.
typedef struct exo_arm_singularity {
  // sigma_min below which the nominal is damped more, m/rad; 0 = off.
  exo_real sigma_slow;
  // What scales the damping, N·s/m.
  exo_real D;
} exo_arm_singularity;

// Damping for a hand too stiff for the gains.
typedef struct exo_arm_stiff_hand {
  // Whether anybody watches.
  int32_t active;
  // Damping that comes on top of D_n, N·s/m.
  exo_real D_max;
  // Lower edge of the band, Hz.
  exo_real f_low;
  // Upper edge of the band, Hz.
  exo_real f_high;
  // Amplitude of f_h in the band from which on a swing counts, N.
  exo_real f_min;
  // Factor by which a half swing has to be stronger than the one a period before, > 1.
  exo_real growth;
  // Time in which D goes from 0 to D_max, s.
  exo_real attack;
  // Time without a swing after which the damping is given back, s.
  exo_real quiet;
  // Time in which D goes from D_max to 0, s.
  exo_real release;
} exo_arm_stiff_hand;

// The hand's force sensor: what it is like and what is made of it.
typedef struct exo_arm_force_sensor {
  // What is read: 1 the force f_h, 2 the wrench of a six-axis sensor.
  int32_t source;
  // Frame of f_h: 1 base, 2 sensor (link 3's).
  int32_t frame;
  // Samples without a change that are a fault; 0 = off.
  int32_t stuck_samples;
  // Samples of nothing but zeros that are a fault; 0 = off.
  int32_t dropout_samples;
  // Mounting of a six-axis sensor on link 3: roll, pitch, yaw, rad.
  exo_real mount[3];
  // The handle from the sensor's origin, sensor frame, m.
  exo_real handle[3];
  // Mass of the tool behind the sensor, kg.
  exo_real mass;
  // Its centre of gravity, sensor frame, m.
  exo_real cog[3];
  // Gravity, base frame, m/s².
  exo_real gravity[3];
  // Width of the deadband, N; 0 = off.
  exo_real deadband;
  // Corner frequency of the low pass, Hz; 0 = off.
  exo_real cutoff;
  // Largest force that the sensor can read, N; 0 = not checked.
  exo_real range_force;
  // Largest moment that it can read, N·m; 0 = not checked.
  exo_real range_torque;
  // Largest rate of change of a force, N/s; 0 = not checked.
  exo_real rate_force;
  // Largest rate of change of a moment, N·m/s; 0 = not checked.
  exo_real rate_torque;
  // Time without a fault after which it is trusted again, s.
  exo_real recovery_time;
  // Time that a tare takes, s.
  exo_real tare_time;
  // Largest motion of a joint during a tare, rad.
  exo_real tare_motion;
  // Largest spread of a force during a tare, N.
  exo_real tare_spread_force;
  // Largest spread of a moment during a tare, N·m.
  exo_real tare_spread_torque;
  // Largest force that a tare takes for a bias, N.
  exo_real tare_max_force;
  // Largest moment that a tare takes for a bias, N·m.
  exo_real tare_max_torque;
} exo_arm_force_sensor;

// Times and thresholds of the supervision.
typedef struct exo_arm_supervision {
  // Whether there is any; without it `engage` and `hold` alone decide.
  int32_t supervision;
  // For how long sensors and heartbeat must have been good before the controller is ready, s.
  exo_real init_time;
  // Duration over which the authority rises from 0 to 1, s.
  exo_real engage_time;
  // Duration over which it falls to 0, s.
  exo_real soft_stop_time;
  // Time within which the heartbeat must change, s; 0 = it is not watched.
  exo_real heartbeat_timeout;
  // Magnitude of f_h below which the hand is at rest, N; 0 = the controller never holds by itself.
  exo_real hold_enter;
  // Magnitude of f_h above which it no longer is, N.
  exo_real hold_leave;
  // For how long f_h must have been below hold_enter, s.
  exo_real hold_time;
  // Duration over which a moving nominal is brought to rest, s.
  exo_real hold_brake;
  // For how long limits may act before they are reported, s; 0 = they are not.
  exo_real saturation_time;
} exo_arm_supervision;

// Gains of the joints, used in joint space.
typedef struct exo_arm_joint_gains {
  // Nominal damping of each joint, N·m·s/rad, ≥ 0.
  exo_real D_n[3];
  // Control gain, N·m·s/rad, > 0.
  exo_real K;
  // Ratio of each joint's coupling spring to its damper, 1/s, > 0.
  exo_real K_P[3];
} exo_arm_joint_gains;

// Limits of the nominal in joint space.
typedef struct exo_arm_joint {
  // Largest speed of each nominal joint, rad/s; 0 = no limit.
  exo_real dq_n_max[3];
  // Whether the nominal keeps to q_n_min … q_n_max.
  int32_t q_n_box;
  // Least angle of each nominal joint, rad.
  exo_real q_n_min[3];
  // Largest angle of each nominal joint, rad.
  exo_real q_n_max[3];
} exo_arm_joint;

// The nominal arm of the joint-space form, by link; moments of inertia about the centre of gravity.
typedef struct exo_arm_nominal {
  // Mass, kg.
  exo_real m[3];
  // Centre of gravity along the link, m.
  exo_real x[3];
  // Centre of gravity across the link, m.
  exo_real z[3];
  // kg·m².
  exo_real I_xx[3];
  // kg·m².
  exo_real I_yy[3];
  // kg·m².
  exo_real I_zz[3];
  // kg·m².
  exo_real I_xz[3];
  // Inertia of each joint about its own axis, kg·m², > 0.
  exo_real rotor[3];
} exo_arm_nominal;

// Parameters of the arm's law. Vectors are along x, y, z of the base frame, or by joint.
typedef struct exo_arm_parameters {
  // 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded.
  int32_t law;
  // 0 or 1: samples after which the torques reach the robot.
  int32_t delay;
  // Torques beyond tau_max: 1 scale all by one factor, 2 clip each; clip under `standard` and `passive` only.
  int32_t torque_limiting;
  // Whether the nominal keeps to p_n_min … p_n_max.
  int32_t p_n_box;
  // The gains to begin with.
  struct exo_arm_gains gains;
  // Damper of the reaction on the nominal, N·s/m, ≥ 0; 1 is the paper.
  exo_real alpha;
  // Sample period, s.
  exo_real T;
  // Largest torque of each joint, N·m, > 0.
  exo_real tau_max[3];
  // Largest rate of change of each joint's torque, N·m/s; 0 = no limit.
  exo_real tau_rate_max[3];
  // Largest speed of each joint for which passivity is promised, rad/s.
  exo_real dq_max[3];
  // Largest acceleration of each joint for which passivity is promised, rad/s².
  exo_real ddq_max[3];
  // Corner frequency of a low pass on the velocity, Hz; 0 = off.
  exo_real dp_cutoff;
  // Energy with which the tank starts and above which it does not fill, J.
  exo_real E_0;
  // Time that changed gains take to come into force, s.
  exo_real tuning_time;
  // Largest speed of the nominal along each axis, m/s; 0 = no limit.
  exo_real dp_n_max[3];
  // Least position of the nominal, base frame, m.
  exo_real p_n_min[3];
  // Largest position of the nominal, base frame, m.
  exo_real p_n_max[3];
  // Where the handle is.
  struct exo_arm_kinematics kinematics;
  // Slowing before a singularity.
  struct exo_arm_singularity singularity;
  // Damping for a hand too stiff for the gains.
  struct exo_arm_stiff_hand stiff_hand;
  // The hand's force sensor.
  struct exo_arm_force_sensor ft;
  // When the law may act.
  struct exo_arm_supervision supervision;
  // The nominal: 1 task (a mass at the handle), 2 joint (a light arm).
  int32_t space;
  // Gains of the joint-space form to begin with.
  struct exo_arm_joint_gains joint_gains;
  // Its limits.
  struct exo_arm_joint joint;
  // Its nominal arm.
  struct exo_arm_nominal nominal;
} exo_arm_parameters;

// Memory of an arm's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
typedef struct exo_arm_state {
  uint64_t words[512];
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

// What supervision is told at a tick; without it nobody listens.
typedef struct exo_arm_signals {
  // Whether the controller may run at all.
  int32_t enable;
  // Its rising edge acknowledges a fault.
  int32_t acknowledge;
  // Whether the emergency stop is pressed.
  int32_t emergency_stop;
  // A counter that changes as long as its sender lives.
  int32_t heartbeat;
  // Whether the joint angles can be trusted.
  int32_t encoder_valid;
} exo_arm_signals;

// What is sensed and asked for at a tick.
typedef struct exo_arm_inputs {
  // Joint angles, rad: yaw about z, shoulder pitch and elbow pitch about −y, so that positive pitch lifts.
  double q[3];
  // Force of the human on the handle, N, in the frame that ft.frame says; with ft.source = 1.
  exo_real f_h[3];
  // Force that a six-axis sensor reads, N, in its frame; with ft.source = 2.
  exo_real ft_force[3];
  // Moment that it reads about its origin, N·m.
  exo_real ft_torque[3];
  // The sensor's own word: 0 = its reading is not to be used.
  int32_t ft_valid;
  // Whether a tare of the sensor is requested; its change to true starts one.
  int32_t ft_tare;
  // Whether the law is to be in the loop.
  int32_t engage;
  // Whether the nominal is to stay where it is.
  int32_t hold;
  // What supervision is told.
  struct exo_arm_signals signals;
} exo_arm_inputs;

// What came of a tick; every value is the one at t_k, vectors at the handle in the base frame.
typedef struct exo_arm_outputs {
  // Torques on the joints, N·m, positive like q, to be held until the next tick.
  exo_real tau_a[3];
  // Torques before any limit, N·m.
  exo_real tau_demand[3];
  // Force on the robot at the handle that tau_a amounts to, N.
  exo_real f_a[3];
  // Position of the handle, m.
  exo_real p[3];
  // Velocity of the handle as the law used it, m/s.
  exo_real dp[3];
  // Nominal position, m.
  exo_real p_n[3];
  // Nominal velocity, m/s.
  exo_real dp_n[3];
  // p_n − p, m; in single precision more exact than their difference.
  exo_real e_nr[3];
  // The hand's force on the handle as the law uses it, N.
  exo_real ft_f_h[3];
  // The hand's moment about the handle, N·m.
  exo_real ft_moment[3];
  // Damping that the stiff-hand detector adds, N·s/m.
  exo_real stiff_hand_D[3];
  // Nominal angles, rad; in task space the sensed ones.
  exo_real q_n[3];
  // Nominal joint velocities, rad/s; in task space 0.
  exo_real dq_n[3];
  // q_n − q, rad; in task space 0.
  exo_real e_q[3];
  // Share of the law's torques that supervision allows, in [0, 1].
  exo_real authority;
  // Smallest singular value of the Jacobian, m/rad.
  exo_real sigma_min;
  // Energy stored, J.
  exo_real H;
  // Energy created since the start, J; negative: dissipated.
  exo_real G;
  // What the energy tank holds, J.
  exo_real tank;
  // Share of the torques that the energy budget left, in [0, 1].
  exo_real share;
  // Whether a limit leaves less than tau_demand.
  int32_t saturated;
  // Whether a limit of the nominal, or hold, kept it back.
  int32_t held;
  // Whether the joints moved faster than dq_max and ddq_max allow.
  int32_t outside_bounds;
  // Whether the law is in the loop.
  int32_t engaged;
  // Whether the nominal is slowed before a singularity.
  int32_t slowed;
  // Whether a stiff hand has been seen and has not been quiet since.
  int32_t stiff_hand_detected;
  // What is wrong with the force sensor, 0 nothing: the numbers of the FMU's ft.fault.
  int32_t ft_fault;
  // How far a tare has come: the numbers of the FMU's ft.tare_state.
  int32_t ft_tare_state;
  // Why a tare failed, 0 if it did not: the numbers of the FMU's ft.tare_failure.
  int32_t ft_tare_failure;
  // State of the supervision: the numbers of the FMU.
  int32_t state;
  // What it reports, 0 nothing: the numbers of the FMU.
  int32_t diagnostic;
  // The first fault since the last acknowledgement, 0 none.
  int32_t first_fault;
  // Whether the tank is below zero after a motion outside the bounds.
  int32_t debt;
} exo_arm_outputs;

// Gains of one axis.
typedef struct exo_axis_gains {
  // Nominal mass, kg, > 0.
  exo_real M_n;
  // Nominal damping, N·s/m, ≥ 0.
  exo_real D_n;
  // Control gain, N·s/m, > 0.
  exo_real K;
  // Ratio of the coupling's spring to its damper, 1/s, > 0.
  exo_real K_P;
  // Largest force on the robot, N, > 0.
  exo_real tau_max;
} exo_axis_gains;

// Parameters of one axis.
typedef struct exo_axis_parameters {
  // 1 standard, 2 passive, 3 passive_applied, 4 passive_bounded.
  int32_t law;
  // 0 or 1: samples after which the force reaches the robot.
  int32_t delay;
  // Whether the nominal keeps to q_n_min … q_n_max.
  int32_t q_n_box;
  // The gains to begin with.
  struct exo_axis_gains gains;
  // Damper of the reaction on the nominal, N·s/m, ≥ 0; 1 is the paper.
  exo_real alpha;
  // Sample period, s.
  exo_real T;
  // Largest speed of the robot for which passivity is promised, m/s.
  exo_real v_max;
  // Largest acceleration of the robot for which passivity is promised, m/s².
  exo_real a_max;
  // Corner frequency of a low pass on the velocity, Hz; 0 = off.
  exo_real dq_cutoff;
  // Energy with which the tank starts and above which it does not fill, J.
  exo_real E_0;
  // Time that changed gains take to come into force, s.
  exo_real tuning_time;
  // Largest speed of the nominal, m/s; 0 = no limit.
  exo_real dq_n_max;
  // Least position of the nominal, m.
  exo_real q_n_min;
  // Largest position of the nominal, m.
  exo_real q_n_max;
  // Largest rate of change of the force, N/s; 0 = no limit.
  exo_real tau_rate_max;
} exo_axis_parameters;

// Memory of one axis's law. Its content is the library's; it may be copied as bytes, to keep and restore a state.
typedef struct exo_axis_state {
  uint64_t words[128];
} exo_axis_state;

// What is sensed and asked for at a tick.
typedef struct exo_axis_inputs {
  // Position, m.
  double q;
  // Force of the human on the robot, N.
  exo_real tau_h;
  // Whether the law is to be in the loop.
  int32_t engage;
  // Whether the nominal is to stay where it is.
  int32_t hold;
} exo_axis_inputs;

// What came of a tick; every value is the one at t_k.
typedef struct exo_axis_outputs {
  // Force on the robot, N, to be held until the next tick.
  exo_real tau_a;
  // The force before any limit, N.
  exo_real tau_demand;
  // Nominal position, m.
  exo_real q_n;
  // Nominal velocity, m/s.
  exo_real dq_n;
  // q_n − q, m.
  exo_real e_nr;
  // The robot's velocity as the law used it, m/s.
  exo_real dq;
  // Energy stored, J.
  exo_real H;
  // Energy created since the start, J; negative: dissipated.
  exo_real G;
  // What the energy tank holds, J.
  exo_real tank;
  // Share of the force that the energy budget left, in [0, 1].
  exo_real share;
  // Whether a limit leaves less than tau_demand.
  int32_t saturated;
  // Whether a limit of the nominal, or hold, kept it back.
  int32_t held;
  // Whether the robot moved faster than v_max and a_max allow.
  int32_t outside_bounds;
  // Whether the law is in the loop.
  int32_t engaged;
  // Whether the tank is below zero after a motion outside the bounds.
  int32_t debt;
} exo_axis_outputs;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Size of the number that the library was built with, in bytes: must equal `sizeof(exo_real)`. Where it does not, the
// header was read with the other setting of `EXO_LAW_F32`.
size_t exo_law_real_size(void);

// Writes the start values into `parameters`.
exo_status exo_arm_defaults(struct exo_arm_parameters *parameters);

// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
// which, and `state` stays as it was.
exo_status exo_arm_init(struct exo_arm_state *state,
                        const struct exo_arm_parameters *parameters,
                        struct exo_refusal *refusal);

// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Where one is refused, the
// gains stay as they were.
exo_status exo_arm_tune(struct exo_arm_state *state, const struct exo_arm_gains *gains, struct exo_refusal *refusal);

// Other gains of the joint-space form, likewise.
exo_status exo_arm_tune_joints(struct exo_arm_state *state,
                               const struct exo_arm_joint_gains *gains,
                               struct exo_refusal *refusal);

// One tick, every T. Where the status is not 0, `outputs` and `state` stay as they were; `refusal`, which may be null, says
// which input was refused.
exo_status exo_arm_tick(struct exo_arm_state *state,
                        const struct exo_arm_inputs *inputs,
                        struct exo_arm_outputs *outputs,
                        struct exo_refusal *refusal);

// Writes the start values into `parameters`.
exo_status exo_axis_defaults(struct exo_axis_parameters *parameters);

// A law out of the loop in `state`, which may hold anything. Where a value is refused, `refusal`, which may be null, says
// which, and `state` stays as it was.
exo_status exo_axis_init(struct exo_axis_state *state,
                         const struct exo_axis_parameters *parameters,
                         struct exo_refusal *refusal);

// Other gains: on a straight line over tuning_time, so that the stored energy does not rise. Where one is refused, the
// gains stay as they were.
exo_status exo_axis_tune(struct exo_axis_state *state, const struct exo_axis_gains *gains, struct exo_refusal *refusal);

// One tick, every T. Where the status is not 0, `outputs` and `state` stay as they were; `refusal`, which may be null, says
// which input was refused.
exo_status exo_axis_tick(struct exo_axis_state *state,
                         const struct exo_axis_inputs *inputs,
                         struct exo_axis_outputs *outputs,
                         struct exo_refusal *refusal);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* EXO_LAW_H */
