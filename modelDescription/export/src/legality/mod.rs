//! Which function may be called in which phase, as data: one table for each version of the standard, [`fmi2`] and [`fmi3`].

pub mod fmi2;
pub mod fmi3;

/// A function that is called on an instance, of either version.
pub trait Call: Copy {
    /// The states that its version of the standard knows.
    type State: Copy + PartialEq + 'static;

    /// Its C name.
    fn name(self) -> &'static str;

    /// The states in which it is legal; none for a function that is legal only in states which no instance here enters.
    fn legal_in(self) -> &'static [Self::State];

    /// The state of an instance that is in `phase`, and `scheduled` if its importer activates its clock.
    fn state(phase: Phase, scheduled: bool) -> Self::State;

    /// The state's name as in the standard.
    fn state_name(self, state: Self::State) -> &'static str;

    /// What the version of the standard calls differently.
    fn words(self) -> Words;
}

/// What the versions of the standard call differently.
#[derive(Clone, Copy, Debug)]
pub struct Words {
    /// The argument that is an FMU state.
    pub fmu_state: &'static str,
    /// The functions that lead out of the error phase.
    pub ways_out: &'static str,
}

/// The functions that advance the time, which have one step behind them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(non_camel_case_types, reason = "the C names of the standards")]
pub enum Advance {
    /// `fmi2DoStep`
    fmi2DoStep,
    /// `fmi3DoStep`
    fmi3DoStep,
    /// `fmi3ActivateModelPartition`
    fmi3ActivateModelPartition,
}

impl Call for Advance {
    type State = (Phase, bool);

    fn name(self) -> &'static str {
        match self {
            Self::fmi2DoStep => fmi2::Function::fmi2DoStep.name(),
            Self::fmi3DoStep => fmi3::Function::fmi3DoStep.name(),
            Self::fmi3ActivateModelPartition => fmi3::Function::fmi3ActivateModelPartition.name(),
        }
    }

    #[inline]
    fn legal_in(self) -> &'static [(Phase, bool)] {
        match self {
            Self::fmi2DoStep | Self::fmi3DoStep => &[(Phase::StepComplete, false)],
            Self::fmi3ActivateModelPartition => &[(Phase::StepComplete, true)],
        }
    }

    #[inline]
    fn state(phase: Phase, scheduled: bool) -> (Phase, bool) {
        (phase, scheduled)
    }

    fn state_name(self, (phase, scheduled): (Phase, bool)) -> &'static str {
        match self {
            Self::fmi2DoStep => phase.name(),
            _ => fmi3::Function::state(phase, scheduled).name(),
        }
    }

    fn words(self) -> Words {
        match self {
            Self::fmi2DoStep => fmi2::WORDS,
            _ => fmi3::WORDS,
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

    #[test]
    fn what_advances_the_time_is_legal_where_the_tables_say() {
        for scheduled in [false, true] {
            for phase in [
                Phase::Instantiated,
                Phase::InitializationMode,
                Phase::StepComplete,
                Phase::Terminated,
                Phase::Error,
            ] {
                let step = fmi3::Function::state(phase, scheduled);
                let by_table = |function: fmi3::Function| function.legal_in().contains(&step);
                let here = |advance: Advance| advance.legal_in().contains(&(phase, scheduled));
                assert_eq!(
                    here(Advance::fmi3DoStep),
                    by_table(fmi3::Function::fmi3DoStep)
                );
                assert_eq!(
                    here(Advance::fmi3ActivateModelPartition),
                    by_table(fmi3::Function::fmi3ActivateModelPartition)
                );
                if !scheduled {
                    let by_table = fmi2::Function::fmi2DoStep.legal_in().contains(&phase);
                    assert_eq!(here(Advance::fmi2DoStep), by_table);
                }
            }
        }
    }
}
