//! What a log is told of a tick: faults that are new, and the first tick that did not come in time.

use crate::timing::{self, IN_TIME};
use crate::{Real, encoder, servo};
use core::fmt::{Arguments, Debug};

/// What the outputs of a controller say that a log may have to be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Notices {
    /// The output `encoder.fault`.
    pub encoder: i32,
    /// The output `drive.fault`.
    pub drive: i32,
    /// The output `timing`.
    pub timing: i32,
}

/// The tick that they are of.
#[derive(Clone, Copy, Debug)]
pub struct Of<'a> {
    /// Its number.
    pub number: u64,
    /// Sample periods since the one before.
    pub after: Real,
    /// The positions that were read for it.
    pub q: &'a dyn Debug,
    /// Their unit.
    pub unit: &'a str,
}

impl Notices {
    /// Tells `log` in a line each what is new since `before`. That ticks do not come in time is told once: `told`.
    #[cold]
    pub fn tell(
        self,
        before: Self,
        of: &Of<'_>,
        told: &mut bool,
        log: &mut dyn FnMut(Arguments<'_>),
    ) {
        let Of {
            number,
            after,
            q,
            unit,
        } = *of;
        if ![0, before.encoder].contains(&self.encoder) {
            let fault = encoder::message(self.encoder);
            log(format_args!("{fault}; q = {q:?} {unit}"));
        }
        if ![0, before.drive].contains(&self.drive) {
            log(format_args!("{}", servo::message(self.drive)));
        }
        if self.timing != IN_TIME && !*told {
            *told = true;
            log(format_args!(
                "{}",
                timing::message(self.timing, number, after)
            ));
        }
    }
}
