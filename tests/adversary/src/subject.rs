//! The laws under attack, as the adversary sees them: public inputs and outputs only.

use crate::audit::Supply;
use admittance::{Admittance, Bounds, Gains, ParameterError, Reach, Request, Settings};
use arm_law::handle::HandleTick;
use arm_law::joint_space::{JointGains, JointParameters, JointSpace, Nominal};
use arm_law::kinematics::Kinematics;
use arm_law::limits::{Limits, TorqueLimiting};
use arm_law::nominal::NominalArm;
use arm_law::task_space::TaskSpace;
use arm_law::workspace::Workspace;
use nalgebra::{Matrix3, SVector, Vector3};

/// What an attack is made of.
const FINITE: &str =
    "forces and motions that are finite, and not so large that the law's numbers overflow";

/// What is wanted of the law at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order<const N: usize> {
    /// Out of the loop.
    Rest,
    /// In the loop.
    Run(Request<N>),
}

/// What the law shows at a tick.
#[derive(Clone, Copy, Debug)]
pub struct Seen<const N: usize> {
    /// Force on the robot, in the coordinates of q, N (N·m).
    pub tau: SVector<f64, N>,
    /// Force that the nominal felt, along the law's axes, N.
    pub felt: SVector<f64, N>,
    /// Nominal position along the law's axes, m.
    pub q_n: SVector<f64, N>,
    /// Nominal velocity along the law's axes, m/s.
    pub dq_n: SVector<f64, N>,
    /// Position error along the law's axes, m.
    pub e_nr: SVector<f64, N>,
    /// Energy in the tank, J.
    pub tank: f64,
    /// Energy created, J.
    pub G: f64,
    /// Energy stored, J.
    pub H: f64,
    /// Share of the force that the budget left.
    pub share: f64,
    /// Whether the tank is in debt.
    pub debt: bool,
    /// Whether the last motion left the reach.
    pub outside: bool,
}

/// What a subject is built of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup<const N: usize> {
    /// What all axes share.
    pub settings: Settings,
    /// Each axis's own.
    pub gains: [Gains; N],
    /// Limits of the nominal.
    pub bounds: [Bounds; N],
    /// How far the robot moves in a sample.
    pub reach: Reach<N>,
    /// Largest rate of the force, N/s (N·m/s).
    pub rate: f64,
    /// Largest torque of each joint, N·m; the arm only.
    pub tau_max: f64,
    /// Whether each joint is clipped by itself; the arm only.
    pub clip: bool,
    /// The part of a sample by which a delayed force is late, in (0, 1].
    pub lag: f64,
}

/// A law of N coordinates.
pub trait Subject<const N: usize>: Clone {
    /// Out of the loop.
    ///
    /// # Errors
    /// The first parameter out of its range.
    fn build(setup: &Setup<N>) -> Result<Self, ParameterError>;
    /// Where the attack starts.
    fn home() -> SVector<f64, N>;
    /// One tick.
    fn tick(&mut self, q: &SVector<f64, N>, f_h: &SVector<f64, N>, order: &Order<N>) -> Seen<N>;
    /// The force of the last tick begins to act at `q`, within the sample.
    fn acts(&mut self, q: &SVector<f64, N>);
    /// Other gains.
    ///
    /// # Errors
    /// The first gain out of its range.
    fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError>;
    /// Whether the outputs say what the nominal felt.
    fn shows_what_is_felt(setup: &Setup<N>) -> bool {
        let _ = setup;
        true
    }
}

impl Arm {
    /// A tick at which the arm's position is not known: no torque.
    pub fn blind(&mut self) {
        let pose = self.kinematics.at(&Self::home());
        let mut done = HandleTick::at_rest(&pose.p, false);
        self.law.abandon(&pose, &mut done);
    }
}

impl<const N: usize> Subject<N> for Admittance<N> {
    fn build(setup: &Setup<N>) -> Result<Self, ParameterError> {
        let mut law = Admittance::new(setup.settings, setup.gains)?
            .reaching(setup.reach)?
            .rated(SVector::repeat(setup.rate))?;
        law.bound(setup.bounds)?;
        law.lag(setup.lag);
        Ok(law)
    }

    fn home() -> SVector<f64, N> {
        SVector::zeros()
    }

    fn tick(&mut self, q: &SVector<f64, N>, f_h: &SVector<f64, N>, order: &Order<N>) -> Seen<N> {
        let tick = match order {
            Order::Rest => self.rest(q),
            Order::Run(request) => Admittance::tick(self, q, f_h, request),
        };
        let ledger = self.ledger();
        Seen {
            tau: tick.f,
            felt: tick.f,
            q_n: tick.q_n,
            dq_n: tick.dq_n,
            e_nr: tick.e_nr,
            tank: ledger.tank(),
            G: ledger.G(),
            H: ledger.H(),
            share: tick.share,
            debt: ledger.is_in_debt(),
            outside: tick.outside_bounds,
        }
    }

    fn acts(&mut self, q: &SVector<f64, N>) {
        Admittance::acts(self, Some(q));
    }

    fn tune(&mut self, gains: [Gains; N]) -> Result<(), ParameterError> {
        Admittance::tune(self, gains)
    }
}

/// The law at the arm's handle, with its ledger at the joints.
#[derive(Clone, Copy, Debug)]
pub struct Arm {
    kinematics: Kinematics,
    law: TaskSpace,
}

fn limits(setup: &Setup<3>) -> Limits {
    Limits {
        tau_max: Vector3::repeat(setup.tau_max),
        tau_rate: Vector3::repeat(setup.rate),
        limiting: if setup.clip {
            TorqueLimiting::Clip
        } else {
            TorqueLimiting::Scale
        },
    }
}

impl Subject<3> for Arm {
    fn build(setup: &Setup<3>) -> Result<Self, ParameterError> {
        let limits = limits(setup);
        limits.check()?;
        let mut law = TaskSpace::new(
            setup.settings,
            setup.gains,
            setup.bounds,
            setup.reach,
            limits,
        )?;
        law.lag(setup.lag);
        Ok(Self {
            kinematics: Kinematics::default(),
            law,
        })
    }

    /// docs/specification.md section 4: the arm's start pose.
    fn home() -> Vector3<f64> {
        Vector3::new(0.0, -1.480_96, 1.701_38)
    }

    fn tick(&mut self, q: &Vector3<f64>, f_h: &Vector3<f64>, order: &Order<3>) -> Seen<3> {
        let pose = self.kinematics.at(q);
        let mut done = HandleTick::at_rest(&pose.p, false);
        match order {
            Order::Rest => self.law.rest(&pose, q, &mut done),
            Order::Run(request) => self.law.step(&pose, q, f_h, request, |tick| done = *tick),
        }
        .expect(FINITE);
        let ledger = self.law.ledger();
        Seen {
            tau: done.tau,
            felt: done.f_a,
            q_n: done.p_n,
            dq_n: done.dp_n,
            e_nr: done.e_nr,
            tank: ledger.tank(),
            G: ledger.G(),
            H: ledger.H(),
            share: done.share,
            debt: ledger.is_in_debt(),
            outside: done.outside_bounds,
        }
    }

    fn acts(&mut self, q: &Vector3<f64>) {
        self.law.acts(Some(q));
    }

    fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.law.tune(gains)
    }

    /// Joints that are clipped one by one turn the force: no output says what the nominal felt.
    fn shows_what_is_felt(setup: &Setup<3>) -> bool {
        !setup.clip
    }
}

/// The same with a nominal that keeps within a workspace about where the attack starts: its limits lie across the axes.
#[derive(Clone, Copy, Debug)]
pub struct ArmInWorkspace(Arm);

/// Half of a joint's range where the case has no box, rad.
const NARROW: f64 = 0.05;

impl Subject<3> for ArmInWorkspace {
    /// Joint limits as wide as the case's box, approached in its tuning time; the yaw axis is kept away from as well.
    fn build(setup: &Setup<3>) -> Result<Self, ParameterError> {
        let home = Self::home();
        let half = setup.bounds.map(|bounds| bounds.q_max.min(NARROW));
        let free = [0, 1, 2].map(|i| Bounds {
            speed: setup.bounds[i].speed,
            ..Bounds::default()
        });
        let arm = Arm::build(&Setup {
            bounds: free,
            ..*setup
        })?;
        let workspace = Workspace {
            limited: 1,
            q_min: core::array::from_fn(|i| home[i] - half[i]),
            q_max: core::array::from_fn(|i| home[i] + half[i]),
            radius_min: 0.44 - half[0],
            slowing_time: setup.settings.tuning_time.max(setup.settings.T),
        };
        Ok(Self(Arm {
            law: arm
                .law
                .within(workspace.checked(setup.settings.T)?, arm.kinematics),
            ..arm
        }))
    }

    fn home() -> Vector3<f64> {
        Arm::home()
    }

    fn tick(&mut self, q: &Vector3<f64>, f_h: &Vector3<f64>, order: &Order<3>) -> Seen<3> {
        self.0.tick(q, f_h, order)
    }

    fn acts(&mut self, q: &Vector3<f64>) {
        self.0.acts(q);
    }

    fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.0.tune(gains)
    }

    /// The audit finds v_m axis by axis, and here the edges couple them.
    fn shows_what_is_felt(_setup: &Setup<3>) -> bool {
        false
    }
}

/// The law in joint space, whose gains are those of the three axes, the first one's K for all joints.
#[derive(Clone, Copy, Debug)]
pub struct JointArm {
    kinematics: Kinematics,
    law: JointSpace,
}

pub(crate) fn of_joints(gains: &[Gains; 3]) -> JointGains {
    JointGains {
        D_n: Vector3::from(gains.map(|gains| gains.D_n)),
        K: gains[0].K,
        K_P: Vector3::from(gains.map(|gains| gains.K_P)),
        tau_max: Vector3::repeat(f64::INFINITY), // the limits' stands in for it
    }
}

/// The nominal arm with all its masses and inertias times M_n/1 kg, a kilogram being about what its links have.
pub(crate) fn scaled(M_n: f64) -> NominalArm {
    let mut arm = NominalArm::default();
    arm.rotor = arm.rotor.map(|inertia| inertia * M_n);
    for link in &mut arm.links {
        for x in [
            &mut link.m,
            &mut link.I_xx,
            &mut link.I_yy,
            &mut link.I_zz,
            &mut link.I_xz,
        ] {
            *x *= M_n;
        }
    }
    arm
}

impl Subject<3> for JointArm {
    fn build(setup: &Setup<3>) -> Result<Self, ParameterError> {
        let limits = limits(setup);
        limits.check()?;
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
        let law = JointSpace::new(setup.settings, &parameters, kinematics, setup.reach, limits)?;
        Ok(Self { kinematics, law })
    }

    fn home() -> Vector3<f64> {
        Arm::home()
    }

    fn tick(&mut self, q: &Vector3<f64>, f_h: &Vector3<f64>, order: &Order<3>) -> Seen<3> {
        let pose = self.kinematics.at(q);
        let mut done = HandleTick::at_rest(&pose.p, false);
        let mut nominal = Nominal::at(q, Matrix3::zeros());
        match order {
            Order::Rest => self.law.rest(&pose, q, &mut done, &mut nominal),
            Order::Run(request) => self
                .law
                .step(&pose, q, f_h, request, &mut done, &mut nominal),
        }
        .expect(FINITE);
        let ledger = self.law.ledger();
        Seen {
            tau: done.tau,
            felt: done.tau,
            q_n: nominal.q_n,
            dq_n: nominal.dq_n,
            e_nr: nominal.e_nr,
            tank: ledger.tank(),
            G: ledger.G(),
            H: ledger.H(),
            share: done.share,
            debt: ledger.is_in_debt(),
            outside: done.outside_bounds,
        }
    }

    fn acts(&mut self, q: &Vector3<f64>) {
        self.law.acts(Some(q));
    }

    fn tune(&mut self, gains: [Gains; 3]) -> Result<(), ParameterError> {
        self.law.tune(of_joints(&gains))
    }

    /// The audit finds v_m axis by axis, and here the joints meet in M_n(q).
    fn shows_what_is_felt(_setup: &Setup<3>) -> bool {
        false
    }
}

/// What the human's port brought in a sample, from what was seen at its beginning.
pub fn supply<const N: usize>(
    setup: &Setup<N>,
    gains: &[Gains; N],
    f_h: &SVector<f64, N>,
    order: &Order<N>,
    seen: &Seen<N>,
) -> Supply {
    let Order::Run(request) = order else {
        return Supply::default();
    };
    (0..N).fold(Supply::default(), |sum, i| {
        sum.and(Supply::of_axis(
            &setup.settings,
            &gains[i],
            &setup.bounds[i],
            [request.hold.into(), request.damping[i]],
            [f_h[i], seen.felt[i], seen.q_n[i], seen.dq_n[i]],
        ))
    })
}
