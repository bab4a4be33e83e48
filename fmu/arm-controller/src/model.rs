//! What a step does.

use crate::ArmController;
use admittance::ParameterError;
use admittance::notices::{Notices, Of};
use arm_law::arm_law::NotFinite;
use arm_law::choices::TORQUE;
use arm_law::{ArmInputs, ArmLaw, ArmOutputs, ArmParameters};
use fmu_export::{Clock, Log, Model, Refusal, Sample, Sampler, Step};

impl Model for ArmController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let arm_law = ArmLaw::new(&self.parameters).map_err(Refusal::new)?;
        self.gain_warning = 0;
        self.advise(log)?;
        // What is shown is a law at rest; what begins to run knows no motion yet.
        arm_law
            .at_rest(&self.inputs, &mut self.outputs)
            .map_err(|NotFinite| self.overflow("the start"))?;
        self.arm_law = Some(arm_law);
        self.sampler = None;
        self.sample_period = self.parameters.T;
        self.told = false;
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        if let Some(arm_law) = &mut self.arm_law {
            arm_law.tune(&self.parameters).map_err(Refusal::new)?;
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
        let Some(arm_law) = &mut self.arm_law else {
            return Err(Refusal::new("a step before initialization"));
        };
        let Some(Sample { number, after }) = sample else {
            // The outputs of the tick have reached the arm by now, where all exchange at once.
            arm_law.acts(&self.inputs);
            return Ok(());
        };
        let before = notices(&self.outputs);
        if let Err(NotFinite) = arm_law.tick_after(after, &self.inputs, &mut self.outputs) {
            return Err(self.overflow(&format!("tick {number}")));
        }
        let now = notices(&self.outputs);
        if now != before {
            let of = Of {
                number,
                after,
                q: &self.inputs.q,
                unit: "rad",
            };
            now.tell(before, &of, &mut self.told, &mut |line| log.warning(line));
        }
        self.tick = i32::try_from(number).unwrap_or(i32::MAX);
        Ok(())
    }
}

impl ArmController {
    /// The samples of an experiment that begins with `step`, and a law with their period.
    #[cold]
    fn first(&mut self, step: &Step, log: &mut Log<'_>) -> Result<Sampler, Refusal> {
        let sampler = Sampler::first(step, self.parameters.T, log, |T| {
            let parameters = ArmParameters {
                T,
                ..self.parameters
            };
            self.arm_law = Some(ArmLaw::new(&parameters)?);
            Ok::<_, ParameterError>(())
        })?;
        if let Some(arm_law) = &mut self.arm_law {
            arm_law.lag(sampler.exchange());
        }
        self.sample_period = sampler.period();
        Ok(sampler)
    }

    /// Sets `gain_warning` to what any axis is advised against, and says why when it becomes another one than 0.
    fn advise(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let advice = self.parameters.advice().map_err(Refusal::new)?;
        let before = std::mem::replace(&mut self.gain_warning, advice.number());
        if ![0, before].contains(&self.gain_warning) {
            log.warning(format_args!("gain_warning: {}", advice.message()));
        }
        Ok(())
    }

    #[cold]
    fn overflow(&self, when: &str) -> Refusal {
        let ArmInputs {
            q,
            f_h,
            tau_a_measured,
            ..
        } = self.inputs;
        let mut message = format!(
            "{when}: the law's result is not finite with q = {q:?} rad and f_h = {f_h:?} N"
        );
        if self.parameters.form != TORQUE {
            message += &format!(" and tau_a_measured = {tau_a_measured:?} N·m");
        }
        Refusal(message)
    }
}

fn notices(outputs: &ArmOutputs) -> Notices {
    Notices {
        encoder: outputs.encoder_fault,
        drive: outputs.drive_fault,
        timing: outputs.timing,
    }
}
