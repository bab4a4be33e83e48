//! Which function may be called in which phase, as data: one table for each version of the standard, [`fmi2`] and [`fmi3`].

pub mod fmi2;
pub mod fmi3;

/// A function that is called on an instance, of either version.
pub trait Call: Copy {
    /// The states that its version of the standard knows.
    type State: Copy + PartialEq + 'static;
    /// What the standard calls the argument that is an FMU state.
    const FMU_STATE: &'static str;
    /// The functions that lead out of the error phase, in words.
    const WAYS_OUT: &'static str;

    /// Its C name.
    fn name(self) -> &'static str;

    /// The states in which it is legal; none for a function that is legal only in states which no instance here enters.
    fn legal_in(self) -> &'static [Self::State];

    /// The state of an instance that is in `phase`, and `scheduled` if its importer activates its clock.
    fn state(phase: Phase, scheduled: bool) -> Self::State;

    /// The state's name as in the standard.
    fn state_name(state: Self::State) -> &'static str;
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
