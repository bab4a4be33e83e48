//! Shows at link time that no path of a tick panics: `cargo build --release -p arm-law --example no_panic`.
//!
//! Where the compiler cannot rule a panic out, `#[no_panic]` leaves a call of a function that does not exist, and the
//! linker says so. Without optimization it rules out little; the attribute is then left away. `cargo xtask law` builds
//! this in both precisions.
//!
//! What is called besides the tick checks parameters through pointers to functions, of which the compiler assumes the worst
//! where panics unwind. That no path panics there either is shown by the C library, in which they do not: it links
//! although the function that its panic handler calls does not exist.

#[cfg(not(feature = "f32"))]
use arm_law as law;
#[cfg(feature = "f32")]
use arm_law_f32 as law;

use admittance::hand::StiffHand;
use admittance::{Admittance, Bounds, Gains, ParameterError, Reach, Real, Request, Settings, Tick};
use law::ArmLaw;
use law::arm_law::{Inputs, NotFinite, Outputs, Parameters, Signals, Space};
use law::joint_space::{JointGains, JointParameters};
use law::kinematics::Kinematics;
use law::limits::{Limits, TorqueLimiting};
use law::nominal::NominalArm;
use law::singularity::Singularity;
use law::supervision;
use law::wrench::{Frame, Sensor, Wrench};
use nalgebra::{SVector, Vector3};
use std::hint::black_box;

#[cfg_attr(not(debug_assertions), no_panic::no_panic)]
#[inline(never)]
fn tick(arm: &mut ArmLaw, inputs: &Inputs, outputs: &mut Outputs) -> Result<(), NotFinite> {
    arm.tick(inputs, outputs)
}

#[cfg_attr(not(debug_assertions), no_panic::no_panic)]
#[inline(never)]
fn tick_axis(
    law: &mut Admittance<1>,
    q: &SVector<Real, 1>,
    f_h: &SVector<Real, 1>,
    request: &Request<1>,
) -> Tick<1> {
    law.tick(q, f_h, request)
}

fn main() -> Result<(), ParameterError> {
    let gains = Gains {
        M_n: 5.0,
        D_n: 20.0,
        K: 1000.0,
        K_P: 20.0,
        f_max: 400.0,
    };
    // What a program reads from outside, so that nothing is known when this is compiled.
    let parameters = black_box(Parameters {
        settings: Settings {
            T: 0.001,
            ..Settings::default()
        },
        gains: [gains; 3],
        bounds: [Bounds::default(); 3],
        reach: Reach {
            v_max: Vector3::repeat(6.0),
            a_max: Vector3::repeat(3e3),
        },
        kinematics: Kinematics::default(),
        limits: Limits {
            tau_max: Vector3::new(153.0, 259.0, 153.0),
            tau_rate: Vector3::repeat(Real::INFINITY),
            limiting: TorqueLimiting::Scale,
        },
        singularity: Singularity::default(),
        stiff_hand: StiffHand::default(),
        frame: Frame::Base,
        sensor: Sensor::default(),
        supervision: Some(supervision::Parameters::default()),
        space: Space::Task,
        joint: JointParameters {
            arm: NominalArm::default(),
            gains: JointGains::default(),
            bounds: [Bounds::default(); 3],
        },
    });
    let inputs = black_box(Inputs {
        q: Vector3::new(0.0, -1.48096, 1.70138),
        hand: Wrench {
            force: Vector3::new(0.0, 0.0, -6.0),
            torque: Vector3::zeros(),
        },
        ft_valid: true,
        tare: false,
        engage: true,
        hold: false,
        signals: Signals::default(),
    });
    for space in [Space::Task, Space::Joint] {
        let mut arm = ArmLaw::new(&black_box(Parameters {
            space,
            ..parameters
        }))?;
        arm.count_from(&inputs.q)?;
        let mut outputs = Outputs::default();
        black_box(tick(&mut arm, &inputs, &mut outputs)).ok();
        black_box(&outputs);
        arm.tune(parameters.gains)?;
        arm.tune_joints(parameters.joint.gains)?;
    }

    let mut axis = Admittance::new(parameters.settings, [gains])?;
    let one = black_box(SVector::<Real, 1>::new(0.3));
    black_box(tick_axis(&mut axis, &one, &one, &Request::default()));
    axis.tune([gains])
}
