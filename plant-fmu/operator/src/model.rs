//! Initialize and step.

use crate::HumanOperator;
use crate::hand::Hand;
use crate::history::Sample;
use export::access::check_parameters;
use export::{Log, Model, Refusal, Step};

impl Model for HumanOperator {
    fn initialize(&mut self, start_time: f64, _log: &mut Log<'_>) -> Result<(), Refusal> {
        check_parameters(self)?;
        if let Some(i) = self.segment.backward() {
            let (t_on, t_off) = (self.segment.t_on[i], self.segment.t_off[i]);
            let i = i + 1;
            return Err(Refusal(format!(
                "segment[{i}].t_off = {t_off} s, expected at least segment[{i}].t_on = {t_on} s"
            )));
        }
        let p_intended = if self.intended_from_start {
            self.p
        } else {
            self.p_intended
        };
        let first = self.felt(start_time);
        self.hand = Hand::new(self.k_h, self.b_h, self.delay, p_intended, first);
        self.show(start_time);
        Ok(())
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let t = step.t + step.h;
        self.hand.feel(self.felt(t));
        self.show(t);
        Ok(())
    }
}

impl HumanOperator {
    /// The inputs, as those at `t`.
    fn felt(&self, t: f64) -> Sample {
        Sample {
            t,
            p: self.p,
            dp: self.dp,
        }
    }

    /// Outputs at `t`.
    fn show(&mut self, t: f64) {
        self.f_profile = self.segment.force(t);
        self.f_hand = if t < self.let_go {
            self.hand.force()
        } else {
            [0.0; 3]
        };
        self.f_h = core::array::from_fn(|i| self.f_profile[i] + self.f_hand[i]);
    }
}
