//! Who decides whether the law runs at a tick: `engage` and `hold`, or supervision.

use super::{ArmLaw, NotFinite, Shown};
use crate::kinematics::Pose;
use crate::signals::{ArmInputs, ArmOutputs};
use crate::supervision::{self, Demand, Felt, Report, Status};
use crate::wrench::conditioner::Made;
use crate::wrench::{Conditioned, TareState};
use admittance::Real;
use admittance::encoder::{self, Believed};
use nalgebra::Vector3;

impl ArmLaw {
    /// One tick in which `engage` and `hold` decide. Without joint angles the law rests, and engages anew with them.
    #[inline(always)]
    pub(super) fn unsupervised(
        &mut self,
        inputs: &ArmInputs,
        q: Option<&Vector3<Real>>,
        believed: &Believed<3>,
        after: Real,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        let Some(q) = q else {
            return self.blind(inputs, believed, outputs);
        };
        let demand = match (inputs.engage != 0, inputs.hold != 0) {
            (false, _) => Demand::Rest,
            (true, hold) => Demand::Run {
                authority: 1.0,
                freedom: if hold { 0.0 } else { 1.0 },
            },
        };
        let pose = self.pose(q);
        let mut made = Made::default();
        let ft = self.sensed(q, &pose, inputs, &mut made);
        self.run(q, &pose, &ft.hand.force, demand, after, outputs)?;
        self.conditioner.keep(&made);
        outputs.outside_bounds |= i32::from(believed.doubted);
        self.show(&pose, &ft, &Status::of(demand), outputs);
        Ok(())
    }

    /// The same without joint angles: it rests where it last knew the arm to be.
    #[cold]
    fn blind(
        &mut self,
        inputs: &ArmInputs,
        believed: &Believed<3>,
        outputs: &mut ArmOutputs,
    ) -> Result<(), NotFinite> {
        if believed.fault == Some(encoder::Fault::NotFinite) {
            return Err(NotFinite);
        }
        let last = self.q;
        let pose = self.pose(&last);
        let mut made = Made::default();
        let ft = self.sensed(&last, &pose, inputs, &mut made);
        self.abandon(outputs);
        self.conditioner.keep(&made);
        self.show(&pose, &ft, &Status::of(Demand::Rest), outputs);
        Ok(())
    }

    /// One tick in which supervision decides. What cannot be trusted does not reach the law: without joint angles it rests
    /// where it last knew the arm to be, without a force it feels none.
    pub(super) fn supervised(
        &mut self,
        inputs: &ArmInputs,
        q: Option<&Vector3<Real>>,
        believed: &Believed<3>,
        after: Real,
        outputs: &mut ArmOutputs,
    ) {
        let is_seen = q.is_some() && (believed.doubted || believed.fault.is_none());
        let q = q.map_or(self.q, |q| *q);
        let mut pose = self.pose(&q);
        let mut made = Made::default();
        let ft = self.sensed(&q, &pose, inputs, &mut made);
        let felt = if self.watches_drift() {
            self.felt(inputs, &pose, &ft)
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
            ft_valid: ft.fault.is_none(),
            encoder_valid: is_seen,
            force: ft.hand.force.norm(),
            felt,
        });

        let outcome = if demand == Demand::Rest && !is_seen {
            pose = self.abandon(outputs);
            Ok(())
        } else {
            self.run(&q, &pose, &ft.hand.force, demand, after, outputs)
        };
        let report = match outcome {
            Ok(()) => {
                self.conditioner.keep(&made);
                outputs.outside_bounds |= i32::from(believed.doubted);
                Report {
                    finite: true,
                    debt: self.ledger().is_in_debt(),
                    outside_bounds: outputs.outside_bounds != 0,
                    saturated: outputs.saturated != 0,
                    speed: Vector3::from(outputs.dp_n).norm(),
                }
            }
            Err(NotFinite) => {
                pose = self.abandon(outputs);
                Report::NOT_FINITE
            }
        };
        if let Some(supervisor) = &mut self.supervisor {
            let status = supervisor.judge(&report);
            self.show(&pose, &ft, &status, outputs);
        }
    }

    /// Whether supervision watches the force for a drift.
    fn watches_drift(&self) -> bool {
        let supervisor = self.supervisor.as_ref();
        supervisor.is_some_and(|supervisor| supervisor.drift().is_some())
    }

    /// What is felt of the hand in the sensor's frame, with the handle at `pose` and the conditioned force.
    #[cold]
    fn felt(&self, inputs: &ArmInputs, pose: &Pose, ft: &Conditioned) -> Felt {
        let R = self.frame.at(pose).R();
        let known = ft.fault.is_none() && ft.tare != TareState::Running;
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

    /// No torque, the nominal where the arm was last known to be: its pose there.
    #[cold]
    fn abandon(&mut self, outputs: &mut ArmOutputs) -> Pose {
        let pose = self.pose(&self.q);
        self.stiff_hand.rest();
        let shown = Shown {
            outputs,
            origin: self.origin.as_ref(),
        };
        self.law.abandon(&pose, &self.q, shown);
        outputs.slowed = 0;
        pose
    }
}
