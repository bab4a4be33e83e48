//! Initialize and step.

use crate::Testbed;
use crate::rows::Outputs;
use fmu_export::{Log, Model, Refusal, Step};
use mechanics::drive::{POSITION_SERVO, TORQUE, VELOCITY_SERVO};
use mechanics::parameter::in_range;
use mechanics::testbed::{self as plant, Forces};
use mechanics::wall::Wall;

/// A rebound may miss this share of its speed before the substep is said to be too long.
pub const REBOUND_LOST: f64 = 0.02;

impl Model for Testbed {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        if ![TORQUE, POSITION_SERVO, VELOCITY_SERVO].contains(&self.mode) {
            return Err(Refusal(format!(
                "drive.mode = {}: expected {TORQUE} (torque), {POSITION_SERVO} (position_servo) or {VELOCITY_SERVO} (velocity_servo)",
                self.mode
            )));
        }
        in_range(self).map_err(Refusal::new)?;
        self.plant = plant::Testbed::new(self.parameters, self.start.q, self.start.dq)
            .map_err(Refusal::new)?;
        let (wall, M) = (&self.parameters.wall, self.parameters.M);
        let longest = wall.longest_substep(M, REBOUND_LOST);
        if wall.q < Wall::NONE && self.substep > longest {
            log.warning(format_args!(
                "substep = {:?} s is too long for wall.k = {:?} N/m: the mass rebounds {:.1} percent too slowly, expected at most \
                 {longest:.2e} s for {:.0} percent",
                self.substep,
                wall.k,
                100.0 * wall.rebound_lost(M, self.substep),
                100.0 * REBOUND_LOST
            ));
        }
        self.show(0.0);
        Ok(())
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("substep", self.substep)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let (n, dt) = step.substeps(self.substep);
        let told = self.drive.told(self.mode, &self.command, self.plant.q());
        let tau_drive = if let Some(told) = told {
            self.plant.advance_driven(&told, &self.forces, n, dt)
        } else {
            self.plant.advance(&self.forces, n, dt);
            self.forces.tau_a
        };
        self.show(tau_drive);
        let Outputs { q, dq, energy, .. } = &self.outputs;
        if !(q.is_finite() && dq.is_finite() && energy.residual.is_finite()) {
            let Forces {
                tau_a,
                tau_h,
                tau_d,
            } = self.forces;
            return Err(Refusal(format!(
                "motion left the range of numbers: q = {q:?} m, dq = {dq:?} m/s, \
                 after tau_a = {tau_a:?} N, tau_h = {tau_h:?} N, tau_d = {tau_d:?} N",
            )));
        }
        Ok(())
    }
}

impl Testbed {
    /// Outputs from the plant's state. The load cell sees the human's force alone, as it was held; `tau_drive` (N) is the
    /// mean of the actuator's.
    fn show(&mut self, tau_drive: f64) {
        self.outputs = Outputs {
            q: self.plant.q(),
            dq: self.plant.dq(),
            tau_h_measured: self.forces.tau_h,
            tau_e: self.plant.tau_e(),
            tau_f: self.plant.tau_f(),
            energy: self.plant.energy(),
            tau_drive,
        };
    }
}
