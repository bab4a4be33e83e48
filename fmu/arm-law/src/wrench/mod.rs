//! The hand's force from a six-axis force/torque sensor: what the sensor adds is taken off, what it gets wrong is named.
//!
//! A sample is a raw [`Wrench`] in the sensor's frame and the sensor's orientation. One tick of a [`Conditioner`], in this
//! order:
//!
//! | step | what | module |
//! |---|---|---|
//! | 1 | not finite, over range, jump, stuck, dropout: named, and the force is 0 until the signal has recovered | [`validity`] |
//! | 2 | less the weight of the tool behind the sensor, in any orientation | [`tool`] |
//! | 3 | less the bias, which a tare finds: requested, running, done or failed with its reason | [`tare`] |
//! | 4 | moved by its lever arm to the handle | [`transport`] |
//! | 5 | first-order low pass | [`filter`] |
//! | 6 | deadband without a jump | [`deadband`] |
//!
//! The result is in the sensor's frame; [`frame`] and [`mount`] say how that turns with the arm.
//!
//! ```
//! use arm_law::wrench::{Conditioner, Sample, Sensor, Tool, Wrench};
//! use nalgebra::{Matrix3, Vector3};
//!
//! // A handle of 0.4 kg, 5 cm beyond the sensor, which hangs down.
//! let tool = Tool { mass: 0.4, cog: [0.0, 0.0, 0.05], ..Tool::default() };
//! let mut conditioner = Conditioner::new(Sensor { tool, ..Sensor::default() }, 0.001)?;
//! let sample = |force: Vector3<f64>| Sample {
//!     wrench: Wrench { force, torque: Vector3::zeros() },
//!     R: Matrix3::identity(), // the sensor's axes are the base frame's
//!     ..Sample::default()
//! };
//! let tick = conditioner.step(&sample(Vector3::new(5.0, 0.0, -0.4 * 9.81)));
//! assert_eq!(tick.hand.force, Vector3::new(5.0, 0.0, 0.0));
//!
//! let tick = conditioner.step(&sample(Vector3::new(f64::NAN, 0.0, 0.0)));
//! assert_eq!(tick.fault.map(|fault| fault.name()), Some("not_finite"));
//! assert_eq!(tick.hand.force, Vector3::zeros());
//! # Ok::<(), arm_law::ParameterError>(())
//! ```
//!
//! With everything off, the start values, a finite force passes bit for bit.
//!
//! **While there is a fault or a tare runs the law sees no force.** The last sound force would let the arm run on; zero is
//! a hand that lets go, for which the nominal comes to rest by its own damping (time constant M_n/D_n) and the coupling
//! holds the load. The nominal integrates the force, so neither the step to zero nor the way back is a step in torque.
//! To stop at once is the supervisor's decision.
//!
//! **Passivity.** The law is passive for any signal at its port (f_h ; K v_n/alpha); whatever stands before that port
//! changes what the hand feels and not the argument. Deadband and faults only ever scale the force towards zero and keep
//! its direction. The low pass turns and delays it: that is a stiff hand's loss of margin, see [`filter`].
//!
//! **Not compensated:** the tool's inertia (mass times acceleration of the sensor, 0.4 N for 0.4 kg at 1 m/s²), drift of
//! the bias with temperature after the tare, cross talk and scale errors of the sensor. What a drift may do is bounded by
//! supervision, `supervision/drift.rs`.

pub mod conditioner;
pub mod deadband;
pub mod filter;
pub mod frame;
pub mod mount;
pub mod tare;
pub mod tool;
pub mod transport;
pub mod validity;

pub use conditioner::{Conditioned, Conditioner, Sample, Sensor};
pub use frame::Frame;
pub use mount::Mount;
pub use tare::{TareFailure, TareState};
pub use tool::Tool;
pub use transport::Wrench;
pub use validity::Fault;
