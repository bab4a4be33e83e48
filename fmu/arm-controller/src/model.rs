//! What a step does, and what it shows.

use crate::ArmController;
use crate::parameters::refusal;
use crate::variables::{Energy, StiffHandSeen, TASK};
use admittance::Law;
use admittance::advice::{Advice, advise};
use arm_law::ArmLaw;
use arm_law::arm_law::{Inputs, Outputs, Signals};
use arm_law::supervision::{Demand, Status};
use export::{Log, Model, Refusal, Step, Ticks};

impl Model for ArmController {
    fn initialize(&mut self, _start_time: f64, log: &mut Log<'_>) -> Result<(), Refusal> {
        let arm_law = ArmLaw::new(&self.parameters()?).map_err(refusal)?;
        self.gain_warning = 0;
        self.advise(log)?;
        // What is shown is a law at rest; what begins to run knows no motion yet.
        let mut at_rest = arm_law;
        let mut shown = Outputs::default();
        let out_of_the_loop = Inputs {
            engage: false,
            ..self.inputs()
        };
        at_rest
            .tick(&out_of_the_loop, &mut shown)
            .map_err(|_| self.overflow("the start"))?;
        self.show(&shown, &at_rest);
        self.ft.clear();
        self.show_status(&Status::of(Demand::Rest));
        self.arm_law = Some(arm_law);
        self.ticks = Ticks::default();
        self.tick = -1;
        Ok(())
    }

    fn tune(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        let gains = self.gains(Law::try_from(self.law).map_err(refusal)?)?;
        self.arm_law
            .as_mut()
            .map_or(Ok(()), |arm_law| {
                arm_law.tune_joints(self.joint.gains(self.tau_max))?;
                arm_law.tune(gains)
            })
            .map_err(refusal)?;
        self.advise(log)
    }

    fn accepts(&self, step: &Step) -> Result<(), Refusal> {
        step.at_most("T", self.T)
    }

    fn step(&mut self, step: Step, _log: &mut Log<'_>) -> Result<(), Refusal> {
        let mut arm_law = self
            .arm_law
            .ok_or_else(|| Refusal::new("a step before initialization"))?;
        let inputs = self.inputs();
        let mut outputs = Outputs::default();
        for k in self.ticks.within(&step, self.T) {
            arm_law
                .tick(&inputs, &mut outputs)
                .map_err(|_| self.overflow(&format!("tick {k}")))?;
            self.show(&outputs, &arm_law);
            self.tick = i32::try_from(k).unwrap_or(i32::MAX);
        }
        self.arm_law = Some(arm_law);
        Ok(())
    }
}

impl ArmController {
    fn inputs(&self) -> Inputs {
        Inputs {
            q: self.q.into(),
            hand: self.ft.reading(self.f_h),
            ft_valid: self.ft_valid,
            tare: self.ft.tare,
            engage: self.engage,
            hold: self.hold,
            signals: Signals {
                enable: self.enable,
                acknowledge: self.acknowledge,
                emergency_stop: self.emergency_stop,
                heartbeat: self.heartbeat,
                encoder_valid: self.encoder_valid,
            },
        }
    }

    /// Sets `gain_warning` to what any axis is advised against, and says why when it becomes another one than 0.
    fn advise(&mut self, log: &mut Log<'_>) -> Result<(), Refusal> {
        if self.space != TASK {
            self.gain_warning = 0;
            return Ok(());
        }
        let settings = self.settings()?;
        let advice = self
            .gains(settings.law)?
            .iter()
            .map(|gains| advise(&settings, gains, self.M_min))
            .fold(Advice::default(), Advice::or);
        let before = std::mem::replace(&mut self.gain_warning, advice.number());
        if ![0, before].contains(&self.gain_warning) {
            log.warning(format_args!("gain_warning: {}", advice.message()));
        }
        Ok(())
    }

    fn show(&mut self, outputs: &Outputs, arm_law: &ArmLaw) {
        let Outputs {
            pose,
            outcome,
            nominal,
            slowed,
            stiff_hand,
            ft,
            status,
        } = outputs;
        self.p = pose.p.into();
        self.sigma_min = pose.sigma_min;
        self.p_n = outcome.p_n.into();
        self.dp_n = outcome.dp_n.into();
        self.e_nr = outcome.e_nr.into();
        self.dp = outcome.dp.into();
        self.f_a = outcome.f_a.into();
        self.tau_a = outcome.tau.into();
        self.tau_demand = outcome.tau_demand.into();
        self.saturated = outcome.saturated;
        self.held = outcome.held;
        self.outside_bounds = outcome.outside_bounds;
        self.engaged = outcome.engaged;
        self.slowed = *slowed;
        self.stiff_hand_seen = StiffHandSeen {
            detected: stiff_hand.detected,
            D: stiff_hand.D.into(),
            k_h: stiff_hand.k_h.into(),
        };
        self.ft.show(ft, &arm_law.bias());
        self.show_status(status);
        self.q_n = nominal.q_n.into();
        self.dq_n = nominal.dq_n.into();
        self.e_q = nominal.e_nr.into();
        self.M_n = std::array::from_fn(|i| nominal.M_n[(i / 3, i % 3)]);
        let ledger = arm_law.ledger();
        self.energy = Energy {
            H: ledger.H(),
            G: ledger.G(),
            tank: ledger.tank(),
            share: outcome.share,
            debt: ledger.is_in_debt(),
            ..self.energy
        };
    }

    fn show_status(&mut self, status: &Status) {
        self.state = status.state.number();
        self.diagnostic = status.diagnostic.number();
        self.first_fault = status.first_fault.number();
        self.authority = status.authority;
    }

    #[cold]
    fn overflow(&self, when: &str) -> Refusal {
        let Self { q, f_h, .. } = self;
        Refusal(format!(
            "{when}: the law's result is not finite with q = {q:?} rad and f_h = {f_h:?} N"
        ))
    }
}
