//! Who decides whether the law runs at a tick: `engage` and `hold`, or supervision.

use super::{ArmLaw, NotFinite, Ran};
use crate::signals::ArmInputs;
use crate::supervision::{self, Demand, Felt, Report, Status};
use crate::wrench::TareState;
use crate::wrench::conditioner::Made;
use admittance::{Real, encoder};
use nalgebra::Vector3;

impl ArmLaw {
    /// One tick in which `engage` and `hold` decide. Without joint angles the law rests, and engages anew with them.
    pub(super) fn unsupervised(
        &mut self,
        inputs: &ArmInputs,
        q: Option<&Vector3<Real>>,
        doubted: bool,
        ran: &mut Ran,
    ) -> Result<(), NotFinite> {
        let Some(q) = q else {
            return self.blind(inputs, ran);
        };
        let demand = match (inputs.engage != 0, inputs.hold != 0) {
            (false, _) => Demand::Rest,
            (true, hold) => Demand::Run {
                authority: 1.0,
                freedom: if hold { 0.0 } else { 1.0 },
            },
        };
        self.turn(&mut ran.pose, q);
        let mut made = Made::default();
        self.sensed(q, inputs, ran, &mut made);
        self.run(q, demand, ran)?;
        self.conditioner.keep(&made);
        ran.outcome.outside_bounds |= doubted;
        ran.status = Status::of(demand);
        Ok(())
    }

    /// The same without joint angles: it rests where it last knew the arm to be.
    #[cold]
    fn blind(&mut self, inputs: &ArmInputs, ran: &mut Ran) -> Result<(), NotFinite> {
        if ran.encoder == Some(encoder::Fault::NotFinite) {
            return Err(NotFinite);
        }
        let last = self.q;
        self.turn(&mut ran.pose, &last);
        let mut made = Made::default();
        self.sensed(&last, inputs, ran, &mut made);
        self.abandon(ran);
        self.conditioner.keep(&made);
        Ok(())
    }

    /// One tick in which supervision decides. What cannot be trusted does not reach the law: without joint angles it rests
    /// where it last knew the arm to be, without a force it feels none.
    pub(super) fn supervised(
        &mut self,
        inputs: &ArmInputs,
        q: Option<&Vector3<Real>>,
        doubted: bool,
        ran: &mut Ran,
    ) {
        let is_seen = q.is_some() && (doubted || ran.encoder.is_none());
        let q = q.map_or(self.q, |q| *q);
        self.turn(&mut ran.pose, &q);
        let mut made = Made::default();
        self.sensed(&q, inputs, ran, &mut made);
        let felt = if self.watches_drift() {
            self.felt(inputs, ran)
        } else {
            Felt::default()
        };
        let demand = self.decided(&supervision::Inputs {
            enable: inputs.enable != 0,
            engage: inputs.engage != 0,
            acknowledge: inputs.acknowledge != 0,
            emergency_stop: inputs.emergency_stop != 0,
            hold: inputs.hold != 0,
            heartbeat: inputs.heartbeat,
            ft_valid: ran.ft.fault.is_none(),
            encoder_valid: is_seen,
            force: ran.ft.hand.force.norm(),
            felt,
        });

        let outcome = if demand == Demand::Rest && !is_seen {
            self.abandon(ran);
            Ok(())
        } else {
            self.run(&q, demand, ran)
        };
        let report = match outcome {
            Ok(()) => {
                self.conditioner.keep(&made);
                ran.outcome.outside_bounds |= doubted;
                Report {
                    finite: true,
                    debt: self.ledger().is_in_debt(),
                    outside_bounds: ran.outcome.outside_bounds,
                    saturated: ran.outcome.saturated,
                    speed: ran.outcome.dp_n.norm(),
                }
            }
            Err(NotFinite) => {
                self.abandon(ran);
                Report::NOT_FINITE
            }
        };
        if let Some(supervisor) = &mut self.supervisor {
            ran.status = supervisor.judge(&report);
        }
    }

    /// Whether supervision watches the force for a drift.
    fn watches_drift(&self) -> bool {
        let supervisor = self.supervisor.as_ref();
        supervisor.is_some_and(|supervisor| supervisor.drift().is_some())
    }

    /// What is felt of the hand in the sensor's frame, with the pose and the conditioned force in `ran`.
    #[cold]
    fn felt(&self, inputs: &ArmInputs, ran: &Ran) -> Felt {
        let R = self.frame.at(&ran.pose).R();
        let known = ran.ft.fault.is_none() && ran.ft.tare != TareState::Running;
        let force = if known {
            self.conditioner.unladen(&self.wrench(inputs).force, &R)
        } else {
            Vector3::zeros()
        };
        Felt {
            force,
            bias: self.conditioner.bias().force,
            gravity: self.conditioner.gravity(&R),
            known,
        }
    }

    /// What supervision demands; without it, rest.
    fn decided(&mut self, inputs: &supervision::Inputs) -> Demand {
        match &mut self.supervisor {
            Some(supervisor) => supervisor.step(inputs),
            None => Demand::Rest,
        }
    }

    /// No torque, the nominal where the arm was last known to be.
    #[cold]
    fn abandon(&mut self, ran: &mut Ran) {
        let Ran {
            pose,
            outcome,
            nominal,
            ..
        } = ran;
        self.turn(pose, &self.q);
        self.stiff_hand.rest();
        self.law.abandon(pose, &self.q, outcome, nominal);
        ran.slowed = false;
        ran.stiff_hand = self.stiff_hand.known();
    }
}
