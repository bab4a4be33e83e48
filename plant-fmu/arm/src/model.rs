//! Initialize and step.

use crate::ExoskeletonArm;
use crate::force_sensor::Reading;
use crate::rows::{Outputs, RigidBody};
use fmu_declaration::Brief;
use fmu_export::access::check_parameters;
use fmu_export::{Clock, Log, Model, Refusal, Step};
use mechanics::arm::surface::TooStiff;
use mechanics::arm::{Arm, Inputs, Parameters, Start};
use nalgebra::{Matrix3, Vector3};

impl Model for ExoskeletonArm {
    fn initialize(&mut self, start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        check_parameters(self)?;
        check_payload(&self.parameters, &self.start)?;
        self.plant = Arm::new(self.parameters, &self.start).map_err(Refusal::new)?;
        self.reading = Reading::default();
        tell(&self.plant, self.substep, log);
        self.sample(0, start_time);
        self.show(&Vector3::zeros());
        Ok(())
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("substep", self.substep)
    }

    fn fits(&self, clock: &Clock) -> Result<(), Refusal> {
        clock.counted("number of force samples", self.reading.k, self.ft.T)
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        let (n, dt) = step.substeps(self.substep);
        let sucked = self.inputs.vacuum || self.plant.kept();
        let drives = self.plant.drives(&self.command);
        let advance = |plant: &mut Arm, inputs: &Inputs, n| match &drives {
            Some(drives) => plant.advance_driven(drives, inputs, n, dt),
            None => plant.advance(inputs, n, dt),
        };
        let mut torques;
        // The sensor samples after the first substep that does not end before its instant, in the pose of then.
        if let Some((k, after)) = self.ft.due(&step, self.reading.k) {
            let before = ((after / dt - 1e-6).ceil() as u32).clamp(1, n);
            torques = advance(&mut self.plant, &self.inputs, before);
            self.sample(k, step.start_time);
            torques += advance(&mut self.plant, &self.inputs, n - before);
        } else {
            torques = advance(&mut self.plant, &self.inputs, n);
        }
        let was_attached = self.outputs.attached;
        self.show(&(torques / f64::from(n)));
        let Outputs {
            q_joint,
            dq,
            p,
            energy,
            attached,
            ..
        } = &self.outputs;
        let Inputs {
            tau_a, f_h, f_d, ..
        } = self.inputs;
        if was_attached != *attached {
            let what = match (attached, sucked) {
                (true, _) => "payload gripped",
                (false, false) => "payload released",
                (false, true) => "payload lost: the bond broke",
            };
            log.event(format_args!(
                "{what} before t = {} s",
                Brief(step.t + step.h)
            ));
        }
        if !(energy.residual.is_finite() && p.iter().all(|p| p.is_finite())) {
            return Err(Refusal(format!(
                "motion left the range of numbers: q_joint = {q_joint:?} rad, dq = {dq:?} rad/s, \
                 after tau_a = {tau_a:?} N.m, f_h = {f_h:?} N, f_d = {f_d:?} N",
            )));
        }
        Ok(())
    }
}

impl ExoskeletonArm {
    /// The force sensor takes sample `k`, of the force that is held and in the pose of the plant.
    fn sample(&mut self, k: u64, start_time: f64) {
        let gravity = Vector3::from(self.parameters.masses.gravity);
        let load = self.ft.load(&Vector3::from(self.inputs.f_h), &gravity);
        let pose = &self.plant.place().pose;
        self.reading = self.ft.sample(k, start_time, &load, pose, self.reading);
    }

    /// Outputs from the plant's state and the sensors; `tau_drive` (N·m) is the mean of the drives' torques.
    fn show(&mut self, tau_drive: &Vector3<f64>) {
        let (plant, place) = (&self.plant, self.plant.place());
        let (q, dq, shown) = (plant.q(), plant.dq(), plant.shown());
        let body = plant.body();
        let gear = &self.parameters.masses.gear;
        self.outputs = Outputs {
            q: core::array::from_fn(|i| self.encoder.read(q[i], gear[i])),
            dq: dq.into(),
            p: place.handle.p.into(),
            dp: (place.handle.J * dq).into(),
            f_e: shown.f_e.into(),
            tau_drive: (*tau_drive).into(),
            tau_applied: plant.tau_applied().into(),
            tau_f: shown.tau_f.into(),
            q_joint: q.into(),
            p_pad: place.pad.p.into(),
            tension: plant.tension(),
            shear: plant.shear(),
            energy: plant.energy(),
            rigid_body: RigidBody {
                M: rows(&body.M),
                C_dq: (body.C(&dq) * dq).into(),
                g: body.g.into(),
            },
            f_h_measured: self.reading.f,
            attached: plant.attached(),
            contact: plant.contact(),
        };
    }
}

/// A rebound may miss this share of its speed before the substep is said to be too long.
pub const REBOUND_LOST: f64 = 0.02;

/// What the user of an arm should know of its parameters: a contact too stiff for the `substep` (s), a payload that waits for
/// its vacuum.
pub fn tell(arm: &Arm, substep: f64, log: &mut Log<'_>) {
    if let Some(TooStiff {
        name,
        k,
        lost,
        longest,
    }) = arm.too_stiff(substep, REBOUND_LOST)
    {
        log.warning(format_args!(
            "substep = {substep:?} s is too long for {name} = {k:?} N/m: the pad rebounds {:.1} percent too slowly, expected at most \
             {longest:.2e} s for {:.0} percent",
            100.0 * lost,
            100.0 * REBOUND_LOST
        ));
    }
    if arm.kept() {
        log.event(format_args!(
            "payload.attached = true: the payload hangs until vacuum has been true and is false again"
        ));
    }
}

/// A payload that hangs at the pad from the start on has a mass.
///
/// # Errors
/// It has none.
pub fn check_payload(parameters: &Parameters, start: &Start) -> Result<(), Refusal> {
    if start.attached && parameters.payload_m == 0.0 {
        return Err(Refusal::new(
            "payload.m = 0 kg, expected a mass greater than 0, since payload.attached = true",
        ));
    }
    Ok(())
}

/// The elements row by row.
fn rows(M: &Matrix3<f64>) -> [f64; 9] {
    core::array::from_fn(|i| M[(i / 3, i % 3)])
}
