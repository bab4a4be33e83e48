//! Initialize and step.

use crate::HumanOperator;
use crate::hand::Hand;
use crate::history::Sample;
use crate::profile::{self, Segment};
use crate::rows::{Inputs, Outputs};
use fmu_declaration::Brief;
use fmu_export::access::check_parameters;
use fmu_export::{Clock, Log, Model, Refusal, Step};

impl Model for HumanOperator {
    fn initialize(&mut self, start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        check_parameters(self)?;
        if let Some(i) = profile::backward(&self.segments) {
            let Segment { t_on, t_off, .. } = self.segments[i];
            let (i, t_on, t_off) = (i + 1, Brief(t_on), Brief(t_off));
            return Err(Refusal(format!(
                "segment[{i}].t_off = {t_off} s, expected at least segment[{i}].t_on = {t_on} s"
            )));
        }
        if let Some(refused) = self.target.refused() {
            return Err(Refusal(refused));
        }
        let (p_intended, first) = (self.intended(), self.felt(start_time));
        let k_h = self.k_h_factor.map(|factor| factor * self.k_h);
        let b_h = self.b_h_factor.map(|factor| factor * self.b_h);
        self.hand = Hand::new(k_h, b_h, self.delay, p_intended, first);
        // An importer that exchanges nothing during initialization leaves p at its start value, in the shoulder.
        self.has_felt = self.inputs.p != [0.0; 3];
        self.show(start_time);
        Ok(())
    }

    fn fits(&self, _clock: &Clock) -> Result<(), Refusal> {
        self.hand.check(self.delay)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let t = step.t + step.h;
        if !self.has_felt {
            self.hand.take_hold(self.intended(), self.felt(step.t));
            self.has_felt = true;
        }
        self.hand.feel(self.felt(t));
        self.show(t);
        Ok(())
    }
}

impl HumanOperator {
    /// The inputs, as those at `t`.
    fn felt(&self, t: f64) -> Sample {
        let Inputs { p, dp } = self.inputs;
        Sample { t, p, dp }
    }

    /// Where a hand that takes hold now wants to be.
    fn intended(&self) -> [f64; 3] {
        if self.intended_from_start {
            self.inputs.p
        } else {
            self.p_intended
        }
    }

    /// Outputs at `t`.
    fn show(&mut self, t: f64) {
        let f_profile = profile::force(&self.segments, t);
        let target = self.target.at(t);
        let f_hand = if t < self.let_go {
            self.hand.force(&target)
        } else {
            [0.0; 3]
        };
        self.outputs = Outputs {
            f_h: core::array::from_fn(|i| f_profile[i] + f_hand[i]),
            f_profile,
            f_hand,
            p_target: self.hand.target(&target),
        };
    }
}
