//! The calls that both versions have, under names of their own: one instance is used in the same way by either.

use crate::Message;
use crate::types::{FmuState, Status};

/// An instance by one of the versions, for what holds by both.
pub trait Hosted {
    /// The function that reads a state's bytes.
    const DESERIALIZE: &'static str;

    /// Everything logged since the last call of this.
    fn messages(&self) -> Vec<Message>;

    /// fmi2DoStep, fmi3DoStep
    fn step(&self, t: f64, h: f64) -> Status;

    /// fmi2GetFMUstate, fmi3GetFMUState into a new state.
    fn state(&self) -> FmuState;

    /// fmi2SetFMUstate, fmi3SetFMUState
    fn set_state(&self, state: FmuState) -> Status;

    /// fmi2FreeFMUstate, fmi3FreeFMUState
    fn free_state(&self, state: &mut FmuState) -> Status;

    /// fmi2DeSerializeFMUstate, fmi3DeserializeFMUState into a slot that keeps the state that it has.
    fn deserialize_into(&self, bytes: &[u8], state: &mut FmuState) -> Status;

    /// The whole state as bytes: what two runs must share bit for bit.
    fn bytes(&self) -> Vec<u8>;
}

/// Makes one call of the C function of this name.
///
/// SAFETY: the component is live, belongs to `library`, and is used by one thread (see `Send`); array arguments are slices
/// of the length that is passed, or pointers that the caller of the method answers for.
macro_rules! call {
    ($self:ident.$function:ident($($argument:expr),*)) => {{
        // SAFETY: see above.
        unsafe { ($self.library.$function)($self.component, $($argument),*) }
    }};
}
pub(crate) use call;

/// The methods of an `Instance` with a `library`, a `component` and its `messages`, by the names of the C functions.
macro_rules! calls_of_both {
    (
        free $free:ident; debug $debug:ident; leave $leave:ident; end $terminate:ident; reset $reset:ident;
        state $get:ident $set:ident $drop:ident; bytes $size:ident $serialize:ident $deserialize:ident;
    ) => {
        // SAFETY: the standard asks that calls on one instance do not overlap; an `Instance` is not `Sync` (it holds a raw
        // pointer), so moving it to another thread moves all its calls.
        unsafe impl Send for Instance {}

        impl Drop for Instance {
            fn drop(&mut self) {
                // SAFETY: the component came from a function that instantiates and is freed here only.
                unsafe { (self.library.$free)(self.component) }
            }
        }

        #[allow(
            clippy::not_unsafe_ptr_arg_deref,
            reason = "a state is passed on as it is; the libraries under test follow only those they handed out"
        )]
        impl Instance {
            /// The library, for calls with arguments that no safe method offers.
            pub fn library(&self) -> &Library {
                &self.library
            }

            /// The component, for calls with arguments that no safe method offers.
            pub fn component(&self) -> Component {
                self.component
            }

            /// Everything logged since the last call of this.
            pub fn messages(&self) -> Vec<Message> {
                self.messages.take()
            }

            /// The text of the one message logged since the last call.
            ///
            /// # Panics
            /// When there was none or several.
            pub fn message(&self) -> String {
                let mut all = self.messages();
                assert_eq!(all.len(), 1, "expected one message, got {all:?}");
                all.remove(0).text
            }

            #[doc = concat!("`", stringify!($debug), "`")]
            pub fn set_debug_logging(&self, on: bool, categories: &[&str]) -> Status {
                let owned: Vec<_> = categories.iter().map(|text| c(text)).collect();
                let pointers: Vec<_> = owned.iter().map(|text| text.as_ptr()).collect();
                call!(self.$debug(on.into(), pointers.len(), pointers.as_ptr()))
            }

            #[doc = concat!("`", stringify!($leave), "`")]
            pub fn exit_initialization_mode(&self) -> Status {
                call!(self.$leave())
            }

            #[doc = concat!("`", stringify!($terminate), "`")]
            pub fn terminate(&self) -> Status {
                call!(self.$terminate())
            }

            #[doc = concat!("`", stringify!($reset), "`")]
            pub fn reset(&self) -> Status {
                call!(self.$reset())
            }

            #[doc = concat!("`", stringify!($get), "` into a new state.\n\n# Panics\nWhen it is refused.")]
            pub fn state(&self) -> FmuState {
                let mut state = std::ptr::null_mut();
                let status = call!(self.$get(&raw mut state));
                assert_eq!(status, Status::OK, "{:?}", self.messages());
                state
            }

            #[doc = concat!("`", stringify!($set), "`")]
            pub fn set_state(&self, state: FmuState) -> Status {
                call!(self.$set(state))
            }

            #[doc = concat!("`", stringify!($drop), "`")]
            pub fn free_state(&self, state: &mut FmuState) -> Status {
                call!(self.$drop(&raw mut *state))
            }

            #[doc = concat!(
                "`", stringify!($size), "` and `", stringify!($serialize), "`.\n\n# Panics\nWhen one is refused."
            )]
            pub fn serialize(&self, state: FmuState) -> Vec<u8> {
                let mut size = 0;
                let status = call!(self.$size(state, &raw mut size));
                assert_eq!(status, Status::OK, "{:?}", self.messages());
                let mut bytes = vec![0_u8; size];
                let status = call!(self.$serialize(state, bytes.as_mut_ptr().cast(), size));
                assert_eq!(status, Status::OK, "{:?}", self.messages());
                bytes
            }

            #[doc = concat!(
                "`", stringify!($deserialize), "` into a new state.\n\n# Errors\nThe status that is not OK."
            )]
            pub fn deserialize(&self, bytes: &[u8]) -> Result<FmuState, Status> {
                let mut state = std::ptr::null_mut();
                match self.deserialize_into(bytes, &mut state) {
                    Status::OK => Ok(state),
                    status => Err(status),
                }
            }

            /// The same into a slot that keeps the state that it has.
            pub fn deserialize_into(&self, bytes: &[u8], state: &mut FmuState) -> Status {
                call!(self.$deserialize(bytes.as_ptr().cast(), bytes.len(), &raw mut *state))
            }

            /// The whole state as bytes: what two runs must share bit for bit.
            ///
            /// # Panics
            /// When a call is refused.
            pub fn bytes(&self) -> Vec<u8> {
                let mut state = self.state();
                let bytes = self.serialize(state);
                assert_eq!(self.free_state(&mut state), Status::OK);
                bytes
            }

            /// Goes on from bytes of [`bytes`](Self::bytes), of either version of the standard.
            ///
            /// # Panics
            /// When the state that was made cannot be freed.
            pub fn restore(&self, bytes: &[u8]) -> Status {
                let mut state = match self.deserialize(bytes) {
                    Ok(state) => state,
                    Err(status) => return status,
                };
                let status = self.set_state(state);
                assert_eq!(self.free_state(&mut state), Status::OK);
                status
            }
        }

        impl $crate::both::Hosted for Instance {
            const DESERIALIZE: &'static str = stringify!($deserialize);

            fn messages(&self) -> Vec<Message> {
                self.messages()
            }

            fn step(&self, t: f64, h: f64) -> Status {
                self.step(t, h)
            }

            fn state(&self) -> FmuState {
                self.state()
            }

            fn set_state(&self, state: FmuState) -> Status {
                self.set_state(state)
            }

            fn free_state(&self, state: &mut FmuState) -> Status {
                self.free_state(state)
            }

            fn deserialize_into(&self, bytes: &[u8], state: &mut FmuState) -> Status {
                self.deserialize_into(bytes, state)
            }

            fn bytes(&self) -> Vec<u8> {
                self.bytes()
            }
        }
    };
}
pub(crate) use calls_of_both;
