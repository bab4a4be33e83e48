//! Initialize and step.

use crate::ExoskeletonArms;
use crate::rows::{Inputs, Outputs, Side};
use exoskeleton_arm::model::{check_payload, tell};
use fmu_declaration::Brief;
use fmu_export::access::check_parameters;
use fmu_export::{Log, Model, Refusal, Step};
use mechanics::arm::Arm;
use mechanics::pair::Pair;
use nalgebra::Vector3;

impl Model for ExoskeletonArms {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        check_parameters(self)?;
        check_payload(&self.parameters.arm, &self.start)?;
        self.plant = Pair::new(self.parameters, &self.start).map_err(Refusal::new)?;
        tell(&self.plant.arms()[0], self.substep, log);
        self.show(&[Vector3::zeros(); 2]);
        Ok(())
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("substep", self.substep)
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        let (n, dt) = step.substeps(self.substep);
        let Inputs { left, right } = self.inputs;
        let suck = [0, 1].map(|i| [left, right][i].vacuum || self.plant.arms()[i].kept());
        let [of_left, of_right] = self.plant.arms();
        let drives = [
            of_left.drives(&self.left_command),
            of_right.drives(&self.right_command),
        ];
        let drives = [drives[0].as_ref(), drives[1].as_ref()];
        let torques = self.plant.advance_driven(drives, &[left, right], n, dt);
        let was_attached = self.outputs.attached;
        self.show(&torques.map(|sum| sum / f64::from(n)));
        let shown = &self.outputs;
        if was_attached != shown.attached {
            let what = match (shown.attached, suck[0] && suck[1]) {
                (true, _) => "payload gripped by both cups",
                (false, false) => "payload released by both cups",
                (false, true) => "payload lost: the bond of one cup broke, both are free",
            };
            log.event(format_args!(
                "{what} before t = {} s",
                Brief(step.t + step.h)
            ));
        }
        let positions = [&shown.left, &shown.right]
            .into_iter()
            .flat_map(|side| side.p);
        if !(shown.energy.arms.residual.is_finite()
            && positions.fold(0.0, |s, p| s + p).is_finite())
        {
            return Err(Refusal(format!(
                "motion left the range of numbers: left.q = {:?} rad, right.q = {:?} rad, \
                 after left.tau_a = {:?} N.m, right.tau_a = {:?} N.m",
                shown.left.q, shown.right.q, left.tau_a, right.tau_a
            )));
        }
        Ok(())
    }
}

impl ExoskeletonArms {
    /// Outputs from the plant's state; `tau_drive` (N·m) are the means of the drives' torques.
    fn show(&mut self, tau_drive: &[Vector3<f64>; 2]) {
        let [left, right] = self.plant.arms();
        self.outputs = Outputs {
            left: Side::of(left, self.base.y, &tau_drive[0]),
            right: Side::of(right, -self.base.y, &tau_drive[1]),
            gap: self.plant.gap(),
            lambda: self.plant.lambda().into(),
            wrist: self
                .plant
                .wrist(&Vector3::new(0.0, 2.0 * self.base.y, 0.0))
                .into(),
            energy: self.plant.energy(),
            attached: self.plant.attached(),
        };
    }
}

impl Side {
    /// The arm whose shoulder is at `y` (m) and whose drives gave `tau_drive` (N·m).
    fn of(arm: &Arm, y: f64, tau_drive: &Vector3<f64>) -> Self {
        let (place, state, shown) = (arm.place(), arm.state(), arm.shown());
        let base = Vector3::new(0.0, y, 0.0);
        Self {
            q: state.q.into(),
            dq: state.dq.into(),
            p: (base + place.handle.p).into(),
            dp: (place.handle.J * state.dq).into(),
            p_pad: (base + place.pad.p).into(),
            f_e: shown.f_e.into(),
            tau_drive: (*tau_drive).into(),
            tau_applied: state.tau.into(),
            tau_f: shown.tau_f.into(),
            tension: arm.tension(),
            shear: arm.shear(),
            contact: shown.contact,
        }
    }
}
