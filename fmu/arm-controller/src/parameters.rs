//! The law's parameters from the variables, and the law's refusals under the variables' names.

use crate::ArmController;
use crate::variables::{JOINT, TASK};
use admittance::{Bounds, Gains, Law, ParameterError, Reach, Settings};
use arm_law::arm_law::{Parameters, Space};
use arm_law::joint_space::JointParameters;
use arm_law::limits::{Limits, TorqueLimiting};
use arm_law::supervision;
use export::Refusal;

impl ArmController {
    pub(crate) fn parameters(&self) -> Result<Parameters, Refusal> {
        let settings = self.settings()?;
        Ok(Parameters {
            settings,
            gains: self.gains(settings.law)?,
            bounds: std::array::from_fn(|i| self.bounds(i)),
            reach: Reach {
                v_max: self.dq_max.into(),
                a_max: self.ddq_max.into(),
            },
            kinematics: self.kinematics,
            limits: self.limits()?,
            singularity: self.singularity,
            stiff_hand: self.stiff_hand,
            frame: self.ft.sensed_in()?,
            sensor: self.ft.sensor()?,
            supervision: self.supervision.then_some(supervision::Parameters {
                init_time: self.init_time,
                engage_time: self.engage_time,
                soft_stop_time: self.soft_stop_time,
                heartbeat_timeout: self.heartbeat_timeout,
                hold_enter: self.hold_enter,
                hold_leave: self.hold_leave,
                hold_time: self.hold_time,
                hold_brake: self.hold_brake,
                saturation_time: self.saturation_time,
            }),
            space: match self.space {
                TASK => Space::Task,
                JOINT => Space::Joint,
                other => {
                    return Err(Refusal(format!(
                        "space = {other}: expected 1 (task), 2 (joint)"
                    )));
                }
            },
            joint: self.joint()?,
        })
    }

    fn joint(&self) -> Result<JointParameters, Refusal> {
        let joint = self.joint.parameters(&self.nominal, self.tau_max);
        for (i, bounds) in (1..).zip(&joint.bounds) {
            bounds.check(Some(i)).map_err(|error| {
                refusal(renamed(error, |name| match name {
                    "speed_max" => "joint.dq_n_max",
                    "q_min" => "joint.q_n_min",
                    "q_max" => "joint.q_n_max",
                    other => other,
                }))
            })?;
        }
        Ok(joint)
    }

    fn bounds(&self, i: usize) -> Bounds {
        let speed = or_none(self.dp_n_max[i]);
        if self.p_n_box {
            Bounds {
                speed,
                q_min: self.p_n_min[i],
                q_max: self.p_n_max[i],
            }
        } else {
            Bounds {
                speed,
                ..Bounds::default()
            }
        }
    }

    pub(crate) fn settings(&self) -> Result<Settings, Refusal> {
        let settings = Settings {
            law: Law::try_from(self.law).map_err(refusal)?,
            alpha: self.alpha,
            T: self.T,
            delayed: match self.delay {
                0 => false,
                1 => true,
                other => return Err(Refusal(format!("delay = {other}: expected 0 or 1"))),
            },
            dq_cutoff: self.dp_cutoff,
            E_0: self.energy.E_0,
            tuning_time: self.tuning_time,
        };
        settings.check().map_err(refusal)?;
        Ok(settings)
    }

    fn limits(&self) -> Result<Limits, Refusal> {
        let number = self.torque_limiting;
        let limiting = TorqueLimiting::from_number(number).ok_or_else(|| {
            Refusal(format!(
                "torque_limiting = {number}: expected 1 (scale), 2 (clip)"
            ))
        })?;
        Ok(Limits {
            tau_max: self.tau_max.into(),
            tau_rate: self.tau_rate_max.map(or_none).into(),
            limiting,
        })
    }

    /// f_max belongs to a spring that slips: the other laws ask for what they ask for and live on the joints' limits.
    pub(crate) fn gains(&self, law: Law) -> Result<[Gains; 3], Refusal> {
        let gains = std::array::from_fn(|i| Gains {
            M_n: self.Lambda_n[i],
            D_n: self.D_n[i],
            K: self.K[i],
            K_P: self.K_P[i],
            f_max: self.f_max[i],
        });
        for (i, gains) in (1..).zip(&gains) {
            gains.check(Some(i)).map_err(refusal)?;
        }
        Ok(if law.row().slips() {
            gains
        } else {
            gains.map(|gains| Gains {
                f_max: f64::INFINITY,
                ..gains
            })
        })
    }
}

/// A limit of the interface, where 0 stands for none.
fn or_none(limit: f64) -> f64 {
    if limit == 0.0 { f64::INFINITY } else { limit }
}

/// A parameter error under the names of this interface.
pub(crate) fn refusal(error: ParameterError) -> Refusal {
    Refusal::new(renamed(error, |name| match name {
        "v_max" => "dq_max",
        "a_max" => "ddq_max",
        "speed_max" => "dp_n_max",
        "q_min" => "p_n_min",
        "q_max" => "p_n_max",
        "M_n" => "Lambda_n",
        "E_0" => "energy.E_0",
        "dq_cutoff" => "dp_cutoff",
        other => other,
    }))
}

fn renamed(error: ParameterError, name_here: fn(&'static str) -> &'static str) -> ParameterError {
    match error {
        ParameterError::OutOfRange {
            name,
            axis,
            value,
            expected,
        } => ParameterError::OutOfRange {
            name: name_here(name),
            axis,
            value,
            expected,
        },
        other => other,
    }
}
