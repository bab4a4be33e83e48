//! What a step does.

use crate::TestbedController;
use crate::controller::Controller;
use admittance::notices::{Notices, Of};
use admittance::one_axis::form::TORQUE;
use admittance::one_axis::{AxisInputs, AxisOutputs, AxisParameters, NotFinite};
use admittance::parameters::in_range;
use admittance::{Law, ParameterError};
use fmu_declaration::Brief;
use fmu_export::{Clock, Log, Model, Refusal, Sample, Sampler, Step};

impl Model for TestbedController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        in_range(self).map_err(Refusal::new)?;
        let controller =
            Controller::new(&self.parameters, &self.comparator).map_err(Refusal::new)?;
        self.gain_warning = 0;
        self.advise(log)?;
        // What is shown is a controller at rest; what begins to run knows no motion yet.
        let engage = std::mem::replace(&mut self.inputs.engage, 0);
        self.controller = Some(controller);
        let shown = self.tick(1.0);
        self.inputs.engage = engage;
        shown.map_err(|NotFinite| self.overflow("the start"))?;
        self.controller = Some(controller);
        self.sampler = None;
        self.sample_period = self.parameters.T;
        self.told = false;
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        if let Some(controller) = &mut self.controller {
            controller.tune(&self.parameters).map_err(Refusal::new)?;
        }
        self.advise(log)
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("T", self.parameters.T)
    }

    fn sample_period(&self) -> Option<(&'static str, f64)> {
        Some(("T", self.parameters.T))
    }

    fn fits(&self, clock: &Clock) -> Result<(), Refusal> {
        self.sampler.map_or(Ok(()), |sampler| sampler.check(clock))
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        if self.sampler.is_none() {
            self.sampler = Some(self.first(&step, log)?);
        }
        let sample = self
            .sampler
            .as_mut()
            .and_then(|sampler| sampler.sample(&step));
        let Some(controller) = &mut self.controller else {
            return Err(Refusal::new("a step before initialization"));
        };
        let Some(Sample { number, after }) = sample else {
            // The outputs of the tick have reached the robot by now, where all exchange at once.
            controller.acts(&self.inputs);
            return Ok(());
        };
        let before = notices(&self.outputs);
        self.tick(after)
            .map_err(|NotFinite| self.overflow(&format!("tick {number}")))?;
        let now = notices(&self.outputs);
        if now != before {
            let of = Of {
                number,
                after,
                q: &self.inputs.q,
                unit: "m",
            };
            now.tell(before, &of, &mut self.told, &mut |line| log.warning(line));
        }
        self.tick = i32::try_from(number).unwrap_or(i32::MAX);
        Ok(())
    }
}

impl TestbedController {
    /// The samples of an experiment that begins with `step`, and a law with their period.
    #[cold]
    fn first(&mut self, step: &Step, log: &mut Log<'_>) -> Result<Sampler, Refusal> {
        let sampler = Sampler::first(step, self.parameters.T, log, |T| {
            let parameters = AxisParameters {
                T,
                ..self.parameters
            };
            self.controller = Some(Controller::new(&parameters, &self.comparator)?);
            Ok::<_, ParameterError>(())
        })?;
        if let Some(controller) = &mut self.controller {
            controller.lag(sampler.exchange());
        }
        self.sample_period = sampler.period();
        Ok(sampler)
    }

    fn tick(&mut self, after: f64) -> Result<(), NotFinite> {
        if let Some(controller) = &mut self.controller {
            controller.tick(&self.inputs, after, &mut self.outputs)?;
        }
        Ok(())
    }

    /// Sets `gain_warning` and says why when it becomes another one than 0.
    fn advise(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let law = Law::try_from(self.parameters.law).map_err(Refusal::new)?;
        let mut advice = self.parameters.advice().map_err(Refusal::new)?;
        advice.stiff_coupling &= self.parameters.form == TORQUE; // else the coupling is the drive's
        advice.light_nominal &= law.row().nominal_mass;
        let before = std::mem::replace(&mut self.gain_warning, advice.number());
        if ![0, before].contains(&self.gain_warning) {
            log.warning(format_args!("gain_warning: {}", advice.message()));
        }
        Ok(())
    }

    #[cold]
    fn overflow(&self, when: &str) -> Refusal {
        let AxisInputs {
            q,
            tau_h,
            tau_a_measured,
            ..
        } = self.inputs;
        let (q, tau_h) = (Brief(q), Brief(tau_h));
        let mut message =
            format!("{when}: the law's result is not finite with q = {q} m and tau_h = {tau_h} N");
        if self.parameters.form != TORQUE {
            message += &format!(" and tau_a_measured = {} N", Brief(tau_a_measured));
        }
        Refusal(message)
    }
}

fn notices(outputs: &AxisOutputs) -> Notices {
    Notices {
        encoder: outputs.encoder_fault,
        drive: outputs.drive_fault,
        timing: outputs.timing,
    }
}
