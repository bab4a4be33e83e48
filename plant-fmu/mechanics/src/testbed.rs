//! The 1-DoF testbed: a mass with friction in front of a wall (`fig:1dof_testbed`).

use crate::Sum;
use crate::drive::Told;
use crate::energy::{Energy, Ledger};
use crate::friction::Friction;
use crate::parameter::{ParameterError, in_range};
use crate::substep::substep;
use crate::wall::Wall;
use fmu_declaration::{Rows, Start};

/// Forces on the mass, positive along +q (N), held over a run of substeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Forces {
    /// force of the actuator on the mass, positive along +q
    #[input(0, unit = NEWTON)]
    pub tau_a: f64,
    /// force of the human on the mass, at the handle, positive along +q
    #[input(1, unit = NEWTON)]
    pub tau_h: f64,
    /// disturbance force on the mass that no sensor sees, positive along +q
    #[input(2, unit = NEWTON)]
    pub tau_d: f64,
}

/// What the testbed is made of. The start values are the paper's: 1 kg of testbed and 5 kg of payload, 0.64 N,
/// 0.19 N·s/m, a wall at 0.3 m.
#[derive(Clone, Copy, Debug, PartialEq, Rows, Start)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parameters {
    /// moving mass
    #[parameter(0, unit = KILOGRAM, range = 1e-3..=1e6, start = 6.0)]
    pub M: f64,
    /// Friction of the guide.
    #[part]
    pub friction: Friction,
    /// The wall.
    #[part]
    pub wall: Wall,
}

/// Where the testbed starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Rows)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Start {
    /// start position, at most wall.q
    #[parameter(0, name = "q_start", unit = METRE, range = -1e6..=1e6)]
    pub q: f64,
    /// start velocity
    #[parameter(1, name = "dq_start", unit = METRE_PER_SECOND, range = -1e3..=1e3)]
    pub dq: f64,
}

/// Where the testbed is. Always s ≥ 0 and s ≥ q − q_wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State {
    /// Position q of the mass (m).
    pub q: Sum,
    /// Velocity dq of the mass (m/s).
    pub dq: Sum,
    /// Deflection s of the wall's surface (m).
    pub s: f64,
}

/// The plant: M ddq = τ_a + τ_h + τ_d + τ_f + τ_e, with its energy balance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Testbed {
    parameters: Parameters,
    state: State,
    tau_f: f64,
    tau_e: f64,
    ledger: Ledger,
}

impl Default for Testbed {
    /// The paper's testbed at rest at q = 0.
    fn default() -> Self {
        Self::start(Parameters::default(), 0.0, 0.0)
    }
}

impl Testbed {
    /// The mass at `q_start` (m), moving at `dq_start` (m/s), the wall undeflected.
    ///
    /// # Errors
    /// A parameter outside its range; a start beyond the wall (touching it is allowed).
    pub fn new(
        parameters: Parameters,
        q_start: f64,
        dq_start: f64,
    ) -> Result<Self, ParameterError> {
        in_range(&parameters)?;
        in_range(&Start {
            q: q_start,
            dq: dq_start,
        })?;
        if q_start > parameters.wall.q {
            return Err(ParameterError::StartBeyondWall {
                q_start,
                wall_q: parameters.wall.q,
            });
        }
        Ok(Self::start(parameters, q_start, dq_start))
    }

    fn start(parameters: Parameters, q: f64, dq: f64) -> Self {
        Self {
            parameters,
            state: State {
                q: q.into(),
                dq: dq.into(),
                s: 0.0,
            },
            tau_f: parameters.friction.at(dq),
            tau_e: 0.0,
            ledger: Ledger::open(0.5 * parameters.M * dq * dq),
        }
    }

    /// Runs `n` substeps of `dt` (s) with `forces` held.
    pub fn advance(&mut self, forces: &Forces, n: u32, dt: f64) {
        for _ in 0..n {
            self.substep(forces, dt);
        }
    }

    #[inline]
    fn substep(&mut self, forces: &Forces, dt: f64) {
        let done = substep(&self.parameters, &self.state, forces, dt);
        self.state = done.state;
        self.ledger.book(&done.flow);
        (self.tau_f, self.tau_e) = (done.tau_f, done.tau_e);
    }

    /// Runs `n` substeps of `dt` (s) with a drive that is `told` something as the actuator in place of `forces.tau_a`: its cycle is the
    /// substep. Returns the mean of its force (N), 0 for n = 0.
    pub fn advance_driven(&mut self, told: &Told, forces: &Forces, n: u32, dt: f64) -> f64 {
        let mut mean = 0.0;
        for _ in 0..n {
            let tau_a = told.force(self.q(), self.dq());
            self.substep(&Forces { tau_a, ..*forces }, dt);
            mean += tau_a / f64::from(n);
        }
        mean
    }

    /// Position q of the mass (m).
    pub fn q(&self) -> f64 {
        self.state.q.value()
    }

    /// Velocity dq of the mass (m/s).
    pub fn dq(&self) -> f64 {
        self.state.dq.value()
    }

    /// Force τ_f of friction on the mass (N), mean of the last substep. At the start that of `dq_start`: 0 at rest.
    pub fn tau_f(&self) -> f64 {
        self.tau_f
    }

    /// Force τ_e of the wall on the mass (N), mean of the last substep: never positive. At the start 0.
    pub fn tau_e(&self) -> f64 {
        self.tau_e
    }

    /// State, with the deflection of the wall's surface.
    pub fn state(&self) -> State {
        self.state
    }

    /// Energy balance since the start.
    pub fn energy(&self) -> Energy {
        let Parameters { M, wall, .. } = self.parameters;
        let dq = self.dq();
        self.ledger
            .balance(0.5 * M * dq * dq, wall.energy(self.state.s))
    }
}
