//! ArmController: the admittance laws at the handle of the exoskeleton arm, as a model that FMI can export.
//!
//! Sampled at T: at each tick it latches the joint angles q and the human's force f_h, computes where the handle is and
//! how it moves by its own kinematics, runs one tick of the law on the three axes of the base frame and holds the joint
//! torques tau_a until the next. All outputs are those at the tick that `tick` names.
//!
//! ```
//! use arm_controller::ArmController;
//! use fmu_export::{Log, Model, Step};
//!
//! let mut controller = ArmController::default();
//! controller.inputs.f_h = [0.0, 0.0, 4.0]; // upwards
//! controller.initialize(0.0, &mut Log::silent())?;
//! controller.step(Step::at(0.0, 0.001), &mut Log::silent())?;
//! assert_eq!(controller.tick, 0);
//! assert!(controller.outputs.f_a[2] > 0.0 && controller.outputs.f_a[0] == 0.0);
//! assert!(controller.outputs.tau_a[1] > 0.0); // positive pitch lifts
//! # Ok::<(), fmu_export::Refusal>(())
//! ```
//!
//! A tick, with the equations of the paper's task space:
//! 1. p and J from q, f_h turned into the base frame if it is sensed in another one: [`arm_law::kinematics`].
//! 2. On each axis Lambda_n ddp_n + D_n dp_n = f_h − alpha y, y = de_nr + K_P e_nr, f_a = K y, near a singularity with
//!    more damping, within joint limits: [`admittance`], [`arm_law::singularity`], [`arm_law::workspace`].
//! 3. tau_a = Jᵀ f_a, within ±tau_max: [`arm_law::limits`]. What the limits leave is what the nominal of laws 3 and 4 feels.
//! 4. The ledger counts the work that tau_a does at the joints: [`arm_law::task_space`].
//!
//! With `space` = joint the nominal is an arm of rigid links instead, `nominal.*`, and 2. and 3. are M_n(q) ddq_n +
//! (C_n + D_n) dq_n = Jᵀ f_h − alpha y, tau_a = K y on the joints: [`arm_law::joint_space`].
//!
//! Whether the law runs at all, and with which authority, `engage` says, or [`arm_law::supervision`] if `supervision` is on.
//!
//! | variable | symbol | unit | what |
//! |---|---|---|---|
//! | `q` | q | rad | joint angles: yaw, shoulder pitch, elbow pitch; positive pitch lifts |
//! | `f_h` | f_h | N | force of the human on the handle |
//! | `p`, `dp` | p, dp | m, m/s | the handle; x forward, y to the left, z up from the shoulder |
//! | `p_n`, `dp_n`, `e_nr` | p_n, dp_n, p_n − p | m, m/s, m | the nominal |
//! | `f_a`, `tau_a` | f_a, tau_a = Jᵀ f_a | N, N·m | what the controller does to the robot |
//! | `energy.*` | H, G, E | J | what the sampled law stores and creates: [`admittance::ledger`] |
//!
//! | module | what |
//! |---|---|
//! | [`rows`] | the variables: inputs, outputs and parameters of [`arm_law`], which declares each in one row |
//! | [`model`] | what a step does |

#![forbid(unsafe_code)]
#![allow(
    non_snake_case,
    reason = "fields are spelt like the paper's symbols and the interface: Lambda_n, K_P, J, T"
)]

pub mod model;
pub mod rows;

pub use rows::ArmController;
