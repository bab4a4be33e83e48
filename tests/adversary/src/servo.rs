//! The servo form under attack: a law that commands, and the drive that the law takes the drive to be.
//!
//! The drive is ideal: continuous, with the law's own gains and limit. The robot goes straight on within a sample, so the drive's
//! mean force times the motion is its work, exactly, however it saturates on the way.

use crate::audit::{Sum, Supply};
use crate::case::Case;
use crate::forces::Forces;
use crate::motions::Motions;
use crate::random::Random;
use crate::subject::{Arm, Order, Seen, Setup, Subject, of_joints, scaled, supply};
use admittance::servo::{Command, Inputs, Servo};
use admittance::tick::Coordinates as _;
use admittance::{Axes, Bounds, Gains, ParameterError, Request};
use arm_law::handle::HandleTick;
use arm_law::joint_space::{JointParameters, JointServo, Nominal};
use arm_law::kinematics::Kinematics;
use fmu_declaration::range::SMALLEST;
use nalgebra::{Matrix3, SVector, Vector3};

/// What drives are told.
pub type Told<const N: usize> = [SVector<f64, N>; 2];

/// A law of N coordinates in servo form.
pub trait Commands<const N: usize>: Clone {
    /// Out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range.
    fn build(setup: &Setup<N>) -> Result<Self, ParameterError>;
    /// Where the attack starts.
    fn home() -> SVector<f64, N> {
        SVector::zeros()
    }
    /// One tick with the drives' mean forces `tau_m` (N) over the sample that ended: q_d and dq_d, and what is seen. Its
    /// `tau` counts for nothing.
    fn tick(
        &mut self,
        q: &SVector<f64, N>,
        f_h: &SVector<f64, N>,
        tau_m: &SVector<f64, N>,
        order: &Order<N>,
    ) -> (Told<N>, Seen<N>);
    /// Another nominal mass and damping.
    ///
    /// # Errors
    /// The first gain that is refused.
    fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError>;
    /// Whether what is seen says what the human's port brought.
    fn is_audited() -> bool {
        true
    }
}

impl<const N: usize> Commands<N> for Servo<Axes<N>, N> {
    fn build(setup: &Setup<N>) -> Result<Self, ParameterError> {
        let mut law = Self::new(setup.settings, setup.gains, &setup.reach)?;
        law.bound(setup.bounds)?;
        Ok(law)
    }

    fn tick(
        &mut self,
        q: &SVector<f64, N>,
        f_h: &SVector<f64, N>,
        tau_m: &SVector<f64, N>,
        order: &Order<N>,
    ) -> (Told<N>, Seen<N>) {
        let engaged = self.law().is_engaged();
        let mut command = Command::at_rest(q);
        match order {
            Order::Rest => {
                let outside = self.rest(q, tau_m, |_| true);
                command.tick.outside_bounds = outside.unwrap_or(false);
            }
            Order::Run(request) => {
                let inputs = Inputs {
                    place: q,
                    q,
                    f_h,
                    tau_m,
                    request,
                    after: request.after,
                };
                let accept = |told: &Command<N>, _| {
                    command = *told;
                    true
                };
                self.tick(&inputs, accept).ok();
            }
        }
        let ledger = self.ledger();
        let felt = if engaged && !ledger.is_in_debt() {
            *tau_m
        } else {
            SVector::zeros()
        };
        let seen = Seen {
            tau: SVector::zeros(),
            felt,
            q_n: command.tick.q_n,
            dq_n: command.tick.dq_n,
            e_nr: command.tick.e_nr,
            tank: ledger.tank(),
            G: ledger.G(),
            H: ledger.H(),
            share: 1.0,
            debt: ledger.is_in_debt(),
            outside: command.tick.outside_bounds,
        };
        ([command.q_d, command.dq_d], seen)
    }

    fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        Self::tune(self, gains, ["K", "K_P", "f_max"])
    }
}

/// The arm's joints, with the first axis's K for all of them.
#[derive(Clone, Copy, Debug)]
pub struct JointDrives {
    kinematics: Kinematics,
    law: JointServo,
    engaged: bool,
}

impl Commands<3> for JointDrives {
    fn build(setup: &Setup<3>) -> Result<Self, ParameterError> {
        let home = Self::home();
        let bounds = [0, 1, 2].map(|i| Bounds {
            q_min: setup.bounds[i].q_min + home[i],
            q_max: setup.bounds[i].q_max + home[i],
            ..setup.bounds[i]
        });
        let parameters = JointParameters {
            arm: scaled(setup.gains[0].M_n),
            gains: of_joints(&setup.gains),
            bounds,
        };
        let kinematics = Kinematics::default();
        let tau_max = Vector3::from(setup.gains.map(|gains| gains.f_max));
        let (settings, reach) = (setup.settings, setup.reach);
        Ok(Self {
            kinematics,
            law: JointServo::new(settings, &parameters, kinematics, reach, tau_max)?,
            engaged: false,
        })
    }

    fn home() -> Vector3<f64> {
        Arm::home()
    }

    fn tick(
        &mut self,
        q: &Vector3<f64>,
        f_h: &Vector3<f64>,
        tau_m: &Vector3<f64>,
        order: &Order<3>,
    ) -> (Told<3>, Seen<3>) {
        let pose = self.kinematics.at(q);
        let mut done = HandleTick::at_rest(&pose.p, false);
        let mut nominal = Nominal::at(q, Matrix3::zeros());
        self.law.measure(*tau_m);
        let outcome = match order {
            Order::Rest => self.law.rest(&pose, q, &mut done, &mut nominal),
            Order::Run(request) => self
                .law
                .step(&pose, q, f_h, request, &mut done, &mut nominal),
        };
        outcome.expect("finite");
        let ledger = self.law.ledger();
        let feels = self.engaged && !ledger.is_in_debt();
        self.engaged = matches!(order, Order::Run(_));
        let seen = Seen {
            tau: Vector3::zeros(),
            felt: if feels { *tau_m } else { Vector3::zeros() },
            q_n: nominal.q_n,
            dq_n: nominal.dq_n,
            e_nr: nominal.e_nr,
            tank: ledger.tank(),
            G: ledger.G(),
            H: ledger.H(),
            share: 1.0,
            debt: ledger.is_in_debt(),
            outside: done.outside_bounds,
        };
        (self.law.told().map(|told| *told), seen)
    }

    fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.law.tune(of_joints(&gains))
    }

    /// The audit finds v_m axis by axis, and here the joints meet in M_n(q).
    fn is_audited() -> bool {
        false
    }
}

/// A law and its drives, as one law that gives a force.
#[derive(Clone, Debug)]
pub struct Driven<C, const N: usize> {
    /// The law.
    pub law: C,
    setup: Setup<N>,
    /// where the robot was, and what its drives were told there
    last: Option<(SVector<f64, N>, Told<N>)>,
    /// what they gave in the sample that ended, N
    pub tau_m: SVector<f64, N>,
}

impl<C, const N: usize> Driven<C, N> {
    /// The drives' mean forces (N) over a sample in which the robot goes straight on by `moved` (m) from `q` (m).
    fn given(
        &self,
        q: &SVector<f64, N>,
        told: &Told<N>,
        moved: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let T = self.setup.settings.T;
        SVector::from_fn(|i, _| {
            let Gains { K, K_P, f_max, .. } = self.setup.gains[i];
            let [q_d, dq_d] = [told[0][i], told[1][i]];
            let at =
                |share: f64| K * ((dq_d - moved[i] / T) + K_P * (q_d - q[i] - share * moved[i]));
            mean_within(at(0.0), at(1.0), f_max)
        })
    }
}

/// Mean over [0, 1] of a straight line from `a` to `b`, each value of it cut to ±`limit`.
fn mean_within(a: f64, b: f64, limit: f64) -> f64 {
    let (low, high) = (a.min(b), a.max(b));
    if high <= limit && low >= -limit {
        return f64::midpoint(a, b);
    }
    if low >= limit || high <= -limit {
        return limit.copysign(a);
    }
    let part = |from: f64, to: f64| {
        let (from, to) = (from.clamp(low, high), to.clamp(low, high));
        (to - from) / (high - low)
    };
    let (under, over) = (part(low, -limit), part(limit, high));
    let [from, to] = [low.max(-limit), high.min(limit)];
    -limit * under + limit * over + f64::midpoint(from, to) * part(from, to)
}

impl<C: Commands<N>, const N: usize> Subject<N> for Driven<C, N> {
    fn build(setup: &Setup<N>) -> Result<Self, ParameterError> {
        Ok(Self {
            law: C::build(setup)?,
            setup: *setup,
            last: None,
            tau_m: SVector::zeros(),
        })
    }

    fn home() -> SVector<f64, N> {
        C::home()
    }

    fn tick(&mut self, q: &SVector<f64, N>, f_h: &SVector<f64, N>, order: &Order<N>) -> Seen<N> {
        self.tau_m = self
            .last
            .as_ref()
            .map_or_else(SVector::zeros, |(last, told)| {
                self.given(last, told, &(q - last))
            });
        let (told, seen) = self.law.tick(q, f_h, &self.tau_m, order);
        self.last = Some((*q, told));
        Seen {
            tau: self.given(q, &told, &SVector::zeros()),
            ..seen
        }
    }

    /// What is measured has acted when it is known.
    fn acts(&mut self, _q: &SVector<f64, N>) {}

    fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        self.law.tune(gains)
    }
}

/// What a run showed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shown {
    /// max over the samples of how far the tank ended below what its sample may take it to, in units of rounding.
    pub tank_in_roundings: f64,
    /// The same as a multiple of the sample's worth f_max (v_max + |v_m|) T.
    pub tank_in_worths: f64,
    /// max over the samples of (energy out − energy in − E_0 − the largest sample's worth), by the ports, in units of rounding.
    pub energy_in_roundings: f64,
    /// The largest sample's worth, J.
    pub worth: f64,
    /// min E, J.
    pub least_tank: f64,
    /// Samples that began in debt.
    pub in_debt: u32,
    /// What is wrong, beside numbers.
    pub complaint: Option<&'static str>,
}

impl Shown {
    /// Whether any claim was broken.
    pub fn is_broken(&self) -> bool {
        self.complaint.is_some() || self.tank_in_roundings > 1.0 || self.energy_in_roundings > 1.0
    }
}

/// The case as the servo form can have it: a drive with a finite limit, gains that the drive keeps.
pub fn servo_case<const N: usize>(mut case: Case<N>) -> Case<N> {
    let setup = &mut case.setup;
    for (gains, v_max) in setup.gains.iter_mut().zip(&setup.reach.v_max) {
        gains.f_max = gains.f_max.min(10.0 * gains.K * v_max);
    }
    setup.settings.tuning_time = 0.0;
    setup.rate = f64::INFINITY;
    case.tuning = case.tuning.min(1.0);
    case
}

/// As for the torque form: the products and sums that ΔG is made of.
const A_SAMPLE: f64 = 64.0 * f64::EPSILON;

/// Runs `case` for `ticks` ticks.
///
/// # Panics
/// When the case has parameters that the law refuses: cases have none.
pub fn run<const N: usize, C: Commands<N>>(case: &Case<N>, ticks: u32) -> Shown {
    let setup = &case.setup;
    let mut law = Driven::<C, N>::build(setup).expect("a case has valid parameters");
    let mut random = Random::new(case.seed);
    let (mut motions, mut forces) = (Motions::<N>::new(case), Forces::<N>::new(case));
    let mut gains = setup.gains;
    let mut q = C::home();
    let mut request = Request::default();
    let mut engaged = true;
    let mut shown = Shown {
        least_tank: f64::INFINITY,
        ..Shown::default()
    };
    let (mut out, mut largest, mut worst) = (Sum::default(), setup.settings.E_0, 0.0_f64);
    let mut begun: Option<Begun<N>> = None;
    for k in 0..ticks {
        let [rest, hold, _, damping, tune] = case.events;
        engaged ^= random.chance(rest);
        request.hold ^= random.chance(hold);
        if random.chance(damping) {
            request.damping = SVector::from_fn(|_, _| case.damping * random.unit());
        }
        if random.chance(tune) {
            gains = gains.map(|gains| Gains {
                M_n: (gains.M_n * random.decades(0.5, 2.0)).max(SMALLEST),
                D_n: gains.D_n * random.decades(0.5, 2.0),
                ..gains
            });
            law.tune(gains).expect("positive gains");
        }
        let order = if engaged {
            Order::Run(request)
        } else {
            Order::Rest
        };
        let f_h = forces.next(&q, case, &mut random);
        let seen = law.tick(&q, &f_h, &order);
        let dq_d = law
            .last
            .as_ref()
            .map_or_else(SVector::zeros, |last| last.1[1]);

        // The sample that ended, by its ports.
        if let Some(Begun { step, supply, .. }) = &begun {
            let work = law.tau_m.dot(step);
            let size = law.tau_m.abs().dot(&step.abs()).max(supply.size);
            out.add(work - supply.energy, size);
            largest = largest.max(size);
        }
        let of_axis = |(gains, v): (&Gains, &f64)| {
            gains.K * setup.settings.T * v * v * (1.0 + gains.K_P * setup.settings.T / 2.0)
        };
        let exchanged: f64 = gains.iter().zip(&seen.dq_n).map(of_axis).sum();
        largest = largest.max(seen.H).max(exchanged);
        let rounding = A_SAMPLE * largest + f64::MIN_POSITIVE;
        shown.least_tank = shown.least_tank.min(seen.tank);
        if let Some(Begun { floor, .. }) = &begun {
            let below = floor - seen.tank;
            shown.tank_in_roundings = shown.tank_in_roundings.max(below / rounding);
            if worst > 0.0 {
                shown.tank_in_worths = shown.tank_in_worths.max(-seen.tank / worst);
            }
        }
        let rounding = A_SAMPLE * out.size() + rounding;
        let energy = (out.value() - setup.settings.E_0 - worst) / rounding;
        if C::is_audited() {
            shown.energy_in_roundings = shown.energy_in_roundings.max(energy);
        }
        if !(seen.tau.iter().all(|tau| tau.is_finite()) && seen.G.is_finite()) {
            shown.complaint.get_or_insert("not finite");
            break;
        }
        if seen.outside {
            let what = "a motion within the reach is called outside";
            shown.complaint.get_or_insert(what);
        }
        shown.in_debt += u32::from(seen.debt);

        // The sample that begins: standing still, the drives only take; else it has its worth.
        let step = motions.next(&law, &q, &seen.tau, &f_h, &order, case, &mut random, k == 0);
        let next = q + step;
        let worth: f64 = (0..N)
            .map(|i| {
                let f_max = gains[i].f_max;
                let T = setup.settings.T;
                f_max * setup.reach.v_max[i] * T + (seen.felt[i] * dq_d[i]).abs() * T
            })
            .sum();
        worst = worst.max(worth);
        shown.worth = worst;
        begun = Some(Begun {
            step: next - q,
            supply: supply(setup, &gains, &f_h, &order, &seen),
            floor: if engaged && !seen.debt {
                -worth
            } else {
                seen.tank
            },
        });
        q = next;
    }
    shown
}

/// A sample that has begun.
#[derive(Clone, Debug)]
struct Begun<const N: usize> {
    step: SVector<f64, N>,
    supply: Supply,
    /// what the tank ends with at least, J
    floor: f64,
}
