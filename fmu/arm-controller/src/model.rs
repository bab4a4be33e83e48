//! What a step does.

use crate::ArmController;
use admittance::encoder::{self, Age};
use admittance::servo;
use arm_law::arm_law::NotFinite;
use arm_law::choices::TORQUE;
use arm_law::{ArmInputs, ArmLaw};
use export::{Clock, Log, Model, Refusal, Step, Ticks};

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
        self.ticks = Ticks::default();
        self.age = Age::default();
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

    fn fits(&self, clock: &Clock) -> Result<(), Refusal> {
        self.ticks.check(clock, self.parameters.T)
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        let Some(arm_law) = &mut self.arm_law else {
            return Err(Refusal::new("a step before initialization"));
        };
        let ticks = self.ticks.within(&step, self.parameters.T);
        let first = ticks.start;
        for k in ticks {
            // The angles were read for the first tick of the step; the others see the same ones.
            let after = self.age.at(k == first);
            let before = self.outputs.encoder_fault;
            let drive = self.outputs.drive_fault;
            if let Err(NotFinite) = arm_law.tick_after(after, &self.inputs, &mut self.outputs) {
                return Err(self.overflow(&format!("tick {k}")));
            }
            let fault = self.outputs.encoder_fault;
            if ![0, before].contains(&fault) {
                let q = self.inputs.q;
                log.warning(format_args!("{}; q = {q:?} rad", encoder::message(fault)));
            }
            let fault = self.outputs.drive_fault;
            if ![0, drive].contains(&fault) {
                log.warning(format_args!("{}", servo::message(fault)));
            }
            self.tick = i32::try_from(k).unwrap_or(i32::MAX);
        }
        Ok(())
    }
}

impl ArmController {
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
