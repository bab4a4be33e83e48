//! Initialize and step.

use crate::Testbed;
use crate::variables::SUBSTEP;
use export::{Log, Model, Refusal, Step};
use mechanics::drive::{Command, Drive};
use mechanics::testbed::{self as plant, Forces, Parameters};

impl Model for Testbed {
    fn initialize(&mut self, _start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        SUBSTEP.check(self.substep).map_err(Refusal::new)?;
        Drive::GAIN
            .check(self.drive.servo.K)
            .map_err(Refusal::new)?;
        Drive::RATIO
            .check(self.drive.servo.K_P)
            .map_err(Refusal::new)?;
        Drive::FORCE
            .check(self.drive.servo.tau_max)
            .map_err(Refusal::new)?;
        if !matches!(self.drive.mode, 1 | 2) {
            return Err(Refusal(format!(
                "drive.mode = {}: expected 1 (torque) or 2 (position_servo)",
                self.drive.mode
            )));
        }
        let parameters = Parameters {
            M: self.M,
            friction: self.friction,
            wall: self.wall,
        };
        self.plant =
            plant::Testbed::new(parameters, self.q_start, self.dq_start).map_err(Refusal::new)?;
        self.tau_drive = 0.0;
        self.show();
        Ok(())
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("substep", self.substep)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let (n, dt) = step.substeps(self.substep);
        let (tau_a, tau_h, tau_d) = (self.tau_a, self.tau_h, self.tau_d);
        let forces = Forces {
            tau_a,
            tau_h,
            tau_d,
        };
        self.tau_drive = if self.drive.mode == 2 {
            let command = Command {
                q_d: self.q_d,
                dq_d: self.dq_d,
            };
            self.plant
                .advance_driven(&self.drive.servo, &command, &forces, n, dt)
        } else {
            self.plant.advance(&forces, n, dt);
            tau_a
        };
        self.show();
        if !(self.q.is_finite() && self.dq.is_finite() && self.energy.residual.is_finite()) {
            return Err(Refusal(format!(
                "motion left the range of numbers: q = {:?} m, dq = {:?} m/s, \
                 after tau_a = {tau_a:?} N, tau_h = {tau_h:?} N, tau_d = {tau_d:?} N",
                self.q, self.dq
            )));
        }
        Ok(())
    }
}

impl Testbed {
    /// Outputs from the plant's state. The load cell sees the human's force alone, as it was held.
    fn show(&mut self) {
        self.q = self.plant.q();
        self.dq = self.plant.dq();
        self.tau_h_measured = self.tau_h;
        self.tau_e = self.plant.tau_e();
        self.tau_f = self.plant.tau_f();
        self.energy = self.plant.energy();
    }
}
