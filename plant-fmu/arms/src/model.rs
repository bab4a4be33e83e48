//! Initialize and step.

use crate::{ExoskeletonArms, Side};
use export::access::check_parameters;
use export::{Log, Model, Refusal, Step};
use mechanics::arm::{Arm, Inputs};
use mechanics::pair::{Pair, Parameters};
use nalgebra::Vector3;

impl Model for ExoskeletonArms {
    fn initialize(&mut self, _start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        check_parameters(self)?;
        let (arm, start) = self.parameters.plant();
        if start.attached && arm.payload_m == 0.0 {
            return Err(Refusal::new(
                "payload.m = 0 kg, expected a mass greater than 0, since payload.attached = true",
            ));
        }
        let parameters = Parameters {
            arm,
            bond: self.bond,
        };
        self.plant = Pair::new(parameters, &start).map_err(Refusal::new)?;
        self.show();
        Ok(())
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        let (n, dt) = step.substeps(self.substep);
        if n == u32::MAX {
            return Err(Refusal(format!(
                "step size {:?} s: expected less than {n} substeps of {:?} s",
                step.h, self.substep
            )));
        }
        self.plant
            .advance(&[self.left.inputs(), self.right.inputs()], n, dt);
        let was_attached = self.attached;
        self.show();
        if was_attached != self.attached {
            let what = match (self.attached, self.left.vacuum && self.right.vacuum) {
                (true, _) => "payload gripped by both cups",
                (false, false) => "payload released by both cups",
                (false, true) => "payload lost: the bond of one cup broke, both are free",
            };
            log.event(format_args!("{what} before t = {} s", step.t + step.h));
        }
        let sides = [&self.left, &self.right];
        let positions = sides.iter().flat_map(|side| side.p);
        if !self.energy.residual.is_finite() || !positions.fold(0.0, |s, p| s + p).is_finite() {
            return Err(Refusal(format!(
                "motion left the range of numbers: left.q = {:?} rad, right.q = {:?} rad, \
                 after left.tau_a = {:?} N.m, right.tau_a = {:?} N.m",
                self.left.q, self.right.q, self.left.tau_a, self.right.tau_a
            )));
        }
        Ok(())
    }
}

impl ExoskeletonArms {
    /// Outputs from the plant's state.
    fn show(&mut self) {
        let [left, right] = self.plant.arms();
        self.left.show(left, self.base.y);
        self.right.show(right, -self.base.y);
        self.attached = self.plant.attached();
        self.gap = self.plant.gap();
        self.lambda = self.plant.lambda().into();
        let balance = self.plant.energy();
        self.energy = balance.arms;
        (self.bond_energy.stored, self.bond_energy.loss) = (balance.bond, balance.loss_bond);
    }
}

impl Side {
    fn inputs(&self) -> Inputs {
        Inputs {
            tau_a: self.tau_a,
            f_h: self.f_h,
            f_d: self.f_d,
            vacuum: self.vacuum,
        }
    }

    /// Outputs of the arm whose shoulder is at `y` (m).
    fn show(&mut self, arm: &Arm, y: f64) {
        let (place, state, shown) = (arm.place(), arm.state(), arm.shown());
        let base = Vector3::new(0.0, y, 0.0);
        self.q = state.q.into();
        self.dq = state.dq.into();
        self.p = (base + place.handle.p).into();
        self.dp = (place.handle.J * state.dq).into();
        self.p_pad = (base + place.pad.p).into();
        self.f_e = shown.f_e.into();
        self.tau_applied = state.tau.into();
        self.tau_f = shown.tau_f.into();
        self.contact = shown.contact;
        self.tension = shown.tension;
    }
}
