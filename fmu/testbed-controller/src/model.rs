//! What a step does.

use crate::TestbedController;
use crate::controller::Controller;
use admittance::Law;
use admittance::encoder::{self, Age};
use admittance::one_axis::form::TORQUE;
use admittance::one_axis::{AxisInputs, NotFinite};
use admittance::parameters::in_range;
use admittance::servo;
use export::{Clock, Log, Model, Refusal, Step, Ticks};

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
        let shown = self.tick(1);
        self.inputs.engage = engage;
        shown.map_err(|NotFinite| self.overflow("the start"))?;
        self.controller = Some(controller);
        self.ticks = Ticks::default();
        self.age = Age::default();
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

    fn fits(&self, clock: &Clock) -> Result<(), Refusal> {
        self.ticks.check(clock, self.parameters.T)
    }

    fn step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Refusal> {
        if self.controller.is_none() {
            return Err(Refusal::new("a step before initialization"));
        }
        let ticks = self.ticks.within(&step, self.parameters.T);
        let first = ticks.start;
        for k in ticks {
            // The position was read for the first tick of the step; the others see the same one.
            let after = self.age.at(k == first);
            let before = self.outputs.encoder_fault;
            let drive = self.outputs.drive_fault;
            self.tick(after)
                .map_err(|NotFinite| self.overflow(&format!("tick {k}")))?;
            let fault = self.outputs.encoder_fault;
            if ![0, before].contains(&fault) {
                let q = self.inputs.q;
                log.warning(format_args!("{}; q = {q:?} m", encoder::message(fault)));
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

impl TestbedController {
    fn tick(&mut self, after: u32) -> Result<(), NotFinite> {
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
        let mut message =
            format!("{when}: the law's result is not finite with q = {q} m and tau_h = {tau_h} N");
        if self.parameters.form != TORQUE {
            message += &format!(" and tau_a_measured = {tau_a_measured} N");
        }
        Refusal(message)
    }
}
