//! Which function may be called in which phase, as data: one table for each version of the standard, [`fmi2`] and [`fmi3`].

pub mod fmi2;
pub mod fmi3;

/// By what an instance was made, and so what is called on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// FMI 2.0, co-simulation: `fmi2Instantiate`.
    Fmi2,
    /// FMI 3.0, co-simulation: `fmi3InstantiateCoSimulation`.
    CoSimulation,
    /// FMI 3.0, scheduled execution: `fmi3InstantiateScheduledExecution`.
    ScheduledExecution,
}

impl Interface {
    /// What the standard calls the argument that is an FMU state.
    pub const fn fmu_state(self) -> &'static str {
        match self {
            Self::Fmi2 => "FMUstate",
            Self::CoSimulation | Self::ScheduledExecution => "FMUState",
        }
    }

    /// The functions that lead out of the error phase.
    pub const fn ways_out(self) -> &'static str {
        match self {
            Self::Fmi2 => "fmi2Reset, fmi2SetFMUstate or fmi2FreeInstance",
            Self::CoSimulation | Self::ScheduledExecution => {
                "fmi3Reset, fmi3SetFMUState or fmi3FreeInstance"
            }
        }
    }
}

/// A function that is called on an instance, of either version.
pub trait Call: Copy {
    /// The states that its version of the standard knows.
    type State: Copy + PartialEq + 'static;

    /// Its C name on an instance of `interface`.
    fn name(self, interface: Interface) -> &'static str;

    /// The states in which it is legal; none for a function that is legal only in states which no instance here enters.
    fn legal_in(self) -> &'static [Self::State];

    /// The state of an instance of `interface` that is in `phase`.
    fn state(phase: Phase, interface: Interface) -> Self::State;

    /// The state's name as in the standard.
    fn state_name(state: Self::State, interface: Interface) -> &'static str;
}

/// What advances the time of an instance: `fmi2DoStep`, `fmi3DoStep` or `fmi3ActivateModelPartition`, as its interface has it.
/// Each is legal in the one state after initialization.
#[derive(Clone, Copy, Debug)]
pub struct Advance;

impl Call for Advance {
    type State = Phase;

    fn name(self, interface: Interface) -> &'static str {
        match interface {
            Interface::Fmi2 => fmi2::Function::fmi2DoStep.name(),
            Interface::CoSimulation => fmi3::Function::fmi3DoStep.name(),
            Interface::ScheduledExecution => fmi3::Function::fmi3ActivateModelPartition.name(),
        }
    }

    #[inline]
    fn legal_in(self) -> &'static [Phase] {
        &[Phase::StepComplete]
    }

    #[inline]
    fn state(phase: Phase, _: Interface) -> Phase {
        phase
    }

    fn state_name(phase: Phase, interface: Interface) -> &'static str {
        match interface {
            Interface::Fmi2 => phase.name(),
            _ => fmi3::Function::state(phase, interface).name(),
        }
    }
}

/// Where an instance is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Phase {
    /// After `fmi2Instantiate` or `fmi2Reset`.
    Instantiated,
    /// After `fmi2EnterInitializationMode`.
    InitializationMode,
    /// After `fmi2ExitInitializationMode` and after each successful step (the standard's *step complete*).
    StepComplete,
    /// After `fmi2Terminate`.
    Terminated,
    /// After a caught panic or a failed step.
    Error,
}

impl Phase {
    /// Name as in the standard.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::InitializationMode => "Initialization Mode",
            Self::StepComplete => "step complete",
            Self::Terminated => "terminated",
            Self::Error => "error",
        }
    }
}

/// Writes an enumeration of functions with the states in which each is legal: a letter for a state.
macro_rules! table {
    ($State:ident: $($key:ident => $variant:ident),*; $($function:ident: $($letter:ident)*;)*) => {
        /// A function of the interface that is called on an instance.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(non_camel_case_types, reason = "the C names of the standard")]
        pub enum Function {
            $(#[doc = concat!("`", stringify!($function), "`")] $function,)*
        }

        impl Function {
            /// All of them.
            pub const LIST: &[Self] = &[$(Self::$function),*];

            /// Its C name.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$function => stringify!($function)),* }
            }

            /// The states in which it is legal.
            pub const fn legal_in(self) -> &'static [$State] {
                $(#[allow(non_upper_case_globals, dead_code, reason = "the letters of the table")] const $key: $State = $State::$variant;)*
                match self { $(Self::$function => &[$($letter),*]),* }
            }
        }
    };
}
pub(crate) use table;

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether one of `functions` is legal in `phase`.
    fn legal<F: Call>(function: F, phase: Phase, interface: Interface) -> bool {
        function.legal_in().contains(&F::state(phase, interface))
    }

    #[test]
    fn what_advances_the_time_is_legal_where_the_tables_say() {
        use fmi3::Function::{fmi3ActivateModelPartition, fmi3DoStep};
        for phase in [
            Phase::Instantiated,
            Phase::InitializationMode,
            Phase::StepComplete,
            Phase::Terminated,
            Phase::Error,
        ] {
            let advances = |interface| legal(Advance, phase, interface);
            let (fmi2, fmi3, scheduled) = (
                Interface::Fmi2,
                Interface::CoSimulation,
                Interface::ScheduledExecution,
            );
            let step = legal(fmi2::Function::fmi2DoStep, phase, fmi2);
            assert_eq!(advances(fmi2), step, "{phase:?}");
            assert_eq!(advances(fmi3), legal(fmi3DoStep, phase, fmi3), "{phase:?}");
            let activation = legal(fmi3ActivateModelPartition, phase, scheduled);
            assert_eq!(advances(scheduled), activation, "{phase:?}");
        }
    }
}
