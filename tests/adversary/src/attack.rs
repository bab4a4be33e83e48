//! The attacks: a case on one of the laws, judged.

use crate::case::Case;
use crate::genes::Genes;
use crate::random::Random;
use crate::subject::{Arm, ArmInWorkspace, JointArm};
use crate::trial::{self, Outcome};
use admittance::Admittance;
use std::fmt;
use std::str::FromStr;

/// What is attacked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// One axis.
    Axis,
    /// Three axes under one tank.
    Axes,
    /// The arm in task space, with its tank at the joints.
    Arm,
    /// The arm in joint space.
    JointArm,
    /// The arm in task space, within joint limits.
    Workspace,
}

/// All targets.
pub const TARGETS: [Target; 5] = [
    Target::Axis,
    Target::Axes,
    Target::Arm,
    Target::JointArm,
    Target::Workspace,
];

/// A case on a target; as text, a line of the regressions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attack {
    /// What is attacked.
    pub target: Target,
    /// How.
    pub genes: Genes,
}

impl Attack {
    /// A random one.
    pub fn new(target: Target, seed: u64) -> Self {
        Self {
            target,
            genes: Genes::new(seed),
        }
    }

    /// Runs it; also says how near it came, which an optimiser makes greater.
    pub fn run(&self) -> (Outcome, f64) {
        match self.target {
            Target::Axis => {
                let case = Case::<1>::new(&self.genes);
                let outcome = trial::run::<1, Admittance<1>>(&case, 500);
                let score = outcome.score(case.setup.settings.E_0);
                (outcome, score)
            }
            Target::Axes => {
                let case = Case::<3>::new(&self.genes);
                let outcome = trial::run::<3, Admittance<3>>(&case, 200);
                let score = outcome.score(case.setup.settings.E_0);
                (outcome, score)
            }
            Target::Arm => {
                let case = Case::<3>::new(&self.genes);
                let outcome = trial::run::<3, Arm>(&case, 200);
                let score = outcome.score(case.setup.settings.E_0);
                (outcome, score)
            }
            Target::JointArm => {
                let case = Case::<3>::new(&self.genes);
                let outcome = trial::run::<3, JointArm>(&case, 200);
                let score = outcome.score(case.setup.settings.E_0);
                (outcome, score)
            }
            Target::Workspace => {
                let case = Case::<3>::new(&self.genes);
                let outcome = trial::run::<3, ArmInWorkspace>(&case, 200);
                let score = outcome.score(case.setup.settings.E_0);
                (outcome, score)
            }
        }
    }

    /// What it is made of, to read.
    pub fn describe(&self) -> String {
        match self.target {
            Target::Axis => format!("{:#?}", Case::<1>::new(&self.genes)),
            _ => format!("{:#?}", Case::<3>::new(&self.genes)),
        }
    }

    /// Climbs from this attack by `steps` mutations, keeping what scores higher; `seen` is shown every attack and says
    /// whether to go on.
    #[must_use]
    pub fn climbed(self, steps: u32, mut seen: impl FnMut(&Self, &Outcome) -> bool) -> Self {
        let mut random = Random::new(self.genes.seed() ^ 0xC11B);
        let (outcome, mut score) = self.run();
        let mut best = self;
        if !seen(&best, &outcome) {
            return best;
        }
        for _ in 0..steps {
            let attack = Self {
                target: best.target,
                genes: best.genes.mutated(&mut random),
            };
            let (outcome, reached) = attack.run();
            let go_on = seen(&attack, &outcome);
            if reached >= score {
                (best, score) = (attack, reached);
            }
            if !go_on {
                break;
            }
        }
        best
    }
}

impl Target {
    fn name(self) -> &'static str {
        match self {
            Self::Axis => "axis",
            Self::Axes => "axes",
            Self::Arm => "arm",
            Self::JointArm => "joint_arm",
            Self::Workspace => "workspace",
        }
    }
}

impl fmt::Display for Attack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.target.name(), self.genes)
    }
}

impl FromStr for Attack {
    type Err = String;

    fn from_str(line: &str) -> Result<Self, String> {
        let (name, genes) = line.split_once(' ').unwrap_or((line, ""));
        let target = TARGETS
            .into_iter()
            .find(|target| target.name() == name)
            .ok_or_else(|| {
                format!("expected axis, axes, arm, joint_arm or workspace, got `{name}`")
            })?;
        Ok(Self {
            target,
            genes: genes.parse()?,
        })
    }
}
