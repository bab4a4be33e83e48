//! A crude arm for closed loops: diagonal inertia, dry and viscous friction, a floor under the handle. Not the plant;
//! enough to make motions that a robot makes, with sticking, impacts and saturated joints.

use crate::{ArmController, T, tick};
use arm_law::kinematics::Kinematics;
use nalgebra::Vector3;

const SUBSTEPS: u32 = 10;
const INERTIA: [f64; 3] = [3.5, 8.5, 3.0];
const COULOMB: [f64; 3] = [12.0, 14.0, 12.0];
const VISCOUS: [f64; 3] = [8.0, 15.0, 8.0];
const FLOOR: (f64, f64, f64) = (-0.30, 1e5, 300.0);

pub struct Robot {
    pub q: Vector3<f64>,
    pub dq: Vector3<f64>,
}

impl Robot {
    pub fn at_the_start() -> Self {
        Self {
            q: Vector3::new(0.0, -1.48096, 1.70138),
            dq: Vector3::zeros(),
        }
    }

    /// Over one sample with torques `tau` (N·m) and a force `f` (N) at the handle held.
    pub fn advance(&mut self, tau: &Vector3<f64>, f: &Vector3<f64>) {
        let dt = T / f64::from(SUBSTEPS);
        for _ in 0..SUBSTEPS {
            let pose = Kinematics::default().at(&self.q);
            let (height, k, c) = FLOOR;
            let (depth, sinking) = (height - pose.p.z, -(pose.J * self.dq).z);
            let push = if depth > 0.0 {
                (k * depth + c * sinking).max(0.0)
            } else {
                0.0
            };
            let torque = tau + pose.J.tr_mul(&(f + Vector3::z() * push));
            for i in 0..3 {
                let momentum = INERTIA[i] * self.dq[i] + dt * torque[i];
                let friction = momentum.clamp(-dt * COULOMB[i], dt * COULOMB[i]);
                self.dq[i] = (momentum - friction) / (INERTIA[i] + dt * VISCOUS[i]);
            }
            self.q += self.dq * dt;
        }
    }
}

/// One tick of the loop without delay: q, then the torque that answers it, then the robot's way under it.
pub fn close_the_loop(controller: &mut ArmController, robot: &mut Robot, k: u32, f_h: [f64; 3]) {
    (controller.inputs.q, controller.inputs.f_h) = (robot.q.into(), f_h);
    tick(controller, k);
    robot.advance(&controller.outputs.tau_a.into(), &f_h.into());
}
