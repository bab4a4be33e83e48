//! Importers that exchange everything at once with steps shorter than T: the force is late by a step, not by a sample.
//! Who moves the robot knows the controller and looks ahead.

use crate::initialized;
use fmu_export::{Log, Model, Step};
use testbed_controller::TestbedController;

/// Energy with which the tank starts, J.
const E_0: f64 = 0.1;

/// Half steps that whoever moves the robot looks ahead.
const AHEAD: u32 = 4;

/// A controller and a robot that are coupled so; the human does nothing.
#[derive(Clone)]
struct Coupled {
    controller: TestbedController,
    /// step size and time, s
    h: f64,
    k: u32,
    q: f64,
    /// force that acts: what the controller showed before its last step, N
    acting: f64,
    /// energy that the force has given out, J
    given: f64,
}

impl Coupled {
    fn new(delay: i32, parts: u32) -> Self {
        Self {
            controller: initialized(|c| {
                (c.parameters.E_0, c.parameters.delay) = (E_0, delay);
            }),
            h: 0.002 / f64::from(parts),
            k: 0,
            q: 0.0,
            acting: 0.0,
            given: 0.0,
        }
    }

    /// One communication step in which the robot moves by `way` (m).
    fn step(&mut self, way: f64) {
        self.controller.inputs.q = self.q;
        let shown = self.controller.outputs.tau_a;
        let step = Step::at(f64::from(self.k) * self.h, self.h);
        self.controller
            .step(step, &mut Log::silent())
            .expect("a step");
        self.k += 1;
        self.acting = shown;
        self.given += self.acting * way;
        self.q += way;
    }

    /// The most that can be got in `steps` more.
    fn most(&self, ways: &[f64], steps: u32) -> f64 {
        if steps == 0 {
            return self.given;
        }
        let best = |way: &f64| {
            let mut next = self.clone();
            next.step(*way);
            next.most(ways, steps - 1)
        };
        ways.iter().map(best).fold(f64::NEG_INFINITY, f64::max)
    }

    /// `steps` steps of the way that pays best; what was given out at most, J.
    fn attacked(&mut self, steps: u32) -> f64 {
        // Within v_max and a_max of the start values, 10 m/s and 1e4 m/s².
        let ways = [-1.5, 0.0, 1.5].map(|v| v * self.h);
        let mut most = 0.0_f64;
        for _ in 0..steps {
            let pays = |way: f64| {
                let mut next = self.clone();
                next.step(way);
                next.most(&ways, AHEAD - 1)
            };
            let best = ways
                .into_iter()
                .max_by(|a, b| pays(*a).total_cmp(&pays(*b)))
                .unwrap_or(0.0);
            self.step(best);
            most = most.max(self.given);
            assert_eq!(self.controller.outputs.outside_bounds, 0);
        }
        most
    }
}

#[test]
fn no_more_than_the_tank_held_is_given_out_whatever_part_of_a_sample_the_delay_is() {
    for parts in [1, 2, 3, 5] {
        let mut coupled = Coupled::new(1, parts);
        let given = coupled.attacked(1500);
        println!("T/{parts}: {given} J");
        assert!(given <= E_0 * (1.0 + 1e-9), "T/{parts}: {given} J");
        assert!(coupled.controller.outputs.tank >= -1e-12);
    }
}

/// Negative control: who does not say that all is exchanged at once is not covered.
#[test]
fn a_controller_that_is_not_told_gives_out_more() {
    let given = Coupled::new(0, 2).attacked(1500);
    println!("not told: {given} J");
    assert!(given > 2.0 * E_0, "{given} J");
}
