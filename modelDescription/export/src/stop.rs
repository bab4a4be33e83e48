//! The stop time of an experiment, and which step leads past it.

use crate::legality::Interface;
use crate::time::Step;

/// A step may end past the stop time by this share of its size: stop times come with the digits that somebody wrote, or
/// in single precision. What is off by a thousandth of a step is another time.
const SAME_END: f64 = 5e-4;

/// And by as many times 2⁻⁵² of the stop time: 3 · 0.1 s is one of them past 0.3 s.
const ROUNDINGS: f64 = 4.0;

/// The stop time (s), infinite while none is defined.
///
/// It is no part of an FMU state: who goes on from a state says for himself how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopTime(f64);

impl Default for StopTime {
    fn default() -> Self {
        Self(f64::INFINITY)
    }
}

impl StopTime {
    /// That of an experiment, if it defines one.
    pub fn new(stop: Option<f64>) -> Self {
        stop.map_or_else(Self::default, Self)
    }

    /// Why `step` leads past it, if it does.
    #[inline]
    pub fn objection(self, step: &Step, interface: Interface) -> Option<String> {
        if step.t + step.h <= self.0 {
            return None;
        }
        self.sentence(step, interface)
    }

    /// Two times tell where a step ends: the importer's, and the start time with the sum of the step sizes. An importer
    /// that sums its time is off by a tenth of a step after 1e8 of them, to either side; the sum here is not. So a step
    /// is past the stop time if it is so in both.
    ///
    /// An activation is an instant: what it computes is for its period, but its time is where that begins.
    #[cold]
    fn sentence(self, step: &Step, interface: Interface) -> Option<String> {
        let Self(stop) = self;
        let Step {
            start_time,
            t,
            h,
            elapsed,
        } = *step;
        let length = match interface {
            Interface::Fmi2 | Interface::CoSimulation => h,
            Interface::ScheduledExecution => 0.0,
        };
        let slack = SAME_END * h + ROUNDINGS * f64::EPSILON * stop.abs().max(start_time.abs());
        let (told, summed) = (t + length - stop, start_time - stop + elapsed + length);
        if told <= slack || summed <= slack {
            return None;
        }
        Some(match interface {
            Interface::Fmi2 | Interface::CoSimulation => format!(
                "currentCommunicationPoint = {t:?} s and communicationStepSize = {h:?} s, expected an end not past stopTime = {stop:?} s"
            ),
            Interface::ScheduledExecution => {
                format!("activationTime = {t:?} s, expected a time not past stopTime = {stop:?} s")
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Clock;

    const CO_SIMULATION: Interface = Interface::CoSimulation;

    /// Makes `steps` steps of `h` (s) from `start`, with the times that `next` gives from number and time, then wants one
    /// more refused. The largest distance past the stop time in the importer's time comes back, in steps.
    fn run(start: f64, h: f64, steps: u64, next: impl Fn(u64, f64) -> f64) -> f64 {
        let stop = start + steps as f64 * h;
        let (stop_time, mut clock) = (StopTime::new(Some(stop)), Clock::at_start(start));
        let (mut t, mut past) = (start, f64::NEG_INFINITY);
        for i in 0..steps {
            let step = clock.step(t, h).expect("a step that follows");
            assert_eq!(
                stop_time.objection(&step, CO_SIMULATION),
                None,
                "step {i} from {start} s"
            );
            past = past.max((t + h - stop) / h);
            clock.advance(&step);
            t = next(i + 1, t);
        }
        let step = clock.step(t, h).expect("a step that follows");
        assert!(
            stop_time.objection(&step, CO_SIMULATION).is_some()
                || t + h <= stop + SAME_END * h + ROUNDINGS * f64::EPSILON * stop.abs(),
            "one step more from {t} s, of {stop} s"
        );
        past
    }

    #[test]
    fn the_last_of_a_hundred_million_summed_steps_is_made_though_its_time_is_past_the_stop_time() {
        // The plain sum of 1e8 steps of 0.7 s is a fifth of a step late, which the sum of the sizes is not.
        let past = run(0.0, 0.7, 100_000_000, |_, t| t + 0.7);
        assert!(past > 10.0 * SAME_END, "{past} steps");
    }

    #[test]
    fn each_step_of_an_experiment_is_made_whatever_the_importer_does_with_its_time() {
        for start in [-2e9, -1.0, 0.0, 0.3, 1e5, 1.7e9] {
            for h in [1e-4, 1e-3, 2e-3, 0.1, 1.0 / 3.0] {
                for steps in [1, 3, 10, 1000, 12_345] {
                    run(start, h, steps, |_, t| t + h);
                    run(start, h, steps, |i, _| start + i as f64 * h);
                }
            }
        }
    }

    #[test]
    fn a_thousandth_of_a_step_past_the_stop_time_is_refused_and_half_of_one_is_not() {
        for (start, h) in [(0.0, 1e-3), (-5.0, 0.1), (1e3, 2e-3)] {
            for steps in [1_u32, 7, 500] {
                let end = start + f64::from(steps) * h;
                let mut clock = Clock::at_start(start);
                for i in 0..steps - 1 {
                    let step = clock.step(start + f64::from(i) * h, h).expect("a step");
                    clock.advance(&step);
                }
                let last = clock.step(end - h, h).expect("a step");
                let past = |share: f64| {
                    StopTime::new(Some(end - share * h)).objection(&last, CO_SIMULATION)
                };
                assert_eq!(past(4e-4), None, "{start} s, {h} s");
                assert!(past(1e-3).is_some(), "{start} s, {h} s");
                assert!(past(0.5).is_some(), "{start} s, {h} s");
            }
        }
    }

    #[test]
    fn an_activation_at_the_stop_time_is_made_and_the_one_after_it_is_not() {
        let stop = StopTime::new(Some(0.002));
        let at = |t| stop.objection(&Step::at(t, 0.001), Interface::ScheduledExecution);
        assert_eq!((at(0.001), at(0.002)), (None, None));
        assert_eq!(
            at(0.003).as_deref(),
            Some("activationTime = 0.003 s, expected a time not past stopTime = 0.002 s")
        );
        assert_eq!(
            StopTime::default().objection(&Step::at(1e300, 1.0), CO_SIMULATION),
            None
        );
    }
}
