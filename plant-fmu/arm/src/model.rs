//! Initialize and step.

use crate::{ExoskeletonArm, RigidBody};
use export::access::check_parameters;
use export::{Log, Model, Refusal, Step};
use mechanics::arm::{Arm, Inputs};
use nalgebra::{Matrix3, Vector3};

impl Model for ExoskeletonArm {
    fn initialize(&mut self, start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        check_parameters(self)?;
        let (parameters, start) = self.parameters.plant();
        if start.attached && parameters.payload_m == 0.0 {
            return Err(Refusal::new(
                "payload.m = 0 kg, expected a mass greater than 0, since payload.attached = true",
            ));
        }
        self.plant = Arm::new(parameters, &start).map_err(Refusal::new)?;
        self.sample(0, start_time);
        self.show();
        Ok(())
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("substep", self.substep)
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        let (n, dt) = step.substeps(self.substep);
        let inputs = Inputs {
            tau_a: self.tau_a,
            f_h: self.f_h,
            f_d: self.f_d,
            vacuum: self.vacuum,
        };
        // The sensor samples after the first substep that does not end before its instant, in the pose of then.
        if let Some((k, after)) = self.ft.due(&step, self.reading.k) {
            let before = ((after / dt - 1e-6).ceil() as u32).clamp(1, n);
            self.plant.advance(&inputs, before, dt);
            self.sample(k, step.start_time);
            self.plant.advance(&inputs, n - before, dt);
        } else {
            self.plant.advance(&inputs, n, dt);
        }
        let was_attached = self.attached;
        self.show();
        if was_attached != self.attached {
            let what = match (self.attached, self.vacuum) {
                (true, _) => "payload gripped",
                (false, false) => "payload released",
                (false, true) => "payload lost: the bond broke",
            };
            log.event(format_args!("{what} before t = {} s", step.t + step.h));
        }
        if !(self.energy.residual.is_finite() && self.p.iter().all(|p| p.is_finite())) {
            return Err(Refusal(format!(
                "motion left the range of numbers: q_joint = {:?} rad, dq = {:?} rad/s, \
                 after tau_a = {:?} N.m, f_h = {:?} N, f_d = {:?} N",
                self.q_joint, self.dq, self.tau_a, self.f_h, self.f_d
            )));
        }
        Ok(())
    }
}

impl ExoskeletonArm {
    /// The force sensor takes sample `k`, of the force that is held and in the pose of the plant.
    fn sample(&mut self, k: u64, start_time: f64) {
        let (f_h, pose) = (Vector3::from(self.f_h), &self.plant.place().pose);
        self.reading = self.ft.sample(k, start_time, &f_h, pose, self.reading);
    }

    /// Outputs from the plant's state and the sensors.
    fn show(&mut self) {
        let (plant, place) = (&self.plant, self.plant.place());
        let (q, dq, shown) = (plant.q(), plant.dq(), plant.shown());
        self.q = core::array::from_fn(|i| self.encoder.read(q[i], self.parameters.gear[i]));
        self.q_joint = q.into();
        self.dq = dq.into();
        self.p = place.handle.p.into();
        self.dp = (place.handle.J * dq).into();
        self.p_pad = place.pad.p.into();
        self.f_h_measured = self.reading.f;
        self.f_e = shown.f_e.into();
        self.tau_applied = plant.tau_applied().into();
        self.tau_f = shown.tau_f.into();
        self.attached = plant.attached();
        self.contact = plant.contact();
        self.tension = plant.tension();
        self.energy = plant.energy();
        let body = plant.body();
        self.rigid_body = RigidBody {
            M: rows(&body.M),
            C_dq: (body.C(&dq) * dq).into(),
            g: body.g.into(),
        };
    }
}

/// The elements row by row.
fn rows(M: &Matrix3<f64>) -> [f64; 9] {
    core::array::from_fn(|i| M[(i / 3, i % 3)])
}
