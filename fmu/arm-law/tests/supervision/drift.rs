//! A nominal that a force nobody varies would move: how far it comes, and what is named.
//!
//! The nominal here is M dv = (f − D v) dt in small steps of its own, braked as the demand says: the second derivation of what
//! the law does with it.

use arm_law::supervision::drift::SMOOTHING;
use arm_law::supervision::{
    Demand, Diagnostic, Felt, Inputs, Parameters, Report, State, Supervisor,
};
use nalgebra::{Rotation3, Vector3};

const T: f64 = 0.001;
/// The paper's nominal at the handle, kg and N·s/m: 50 mm/s a newton.
const M: f64 = 5.0;
const D: f64 = 20.0;
const G: f64 = 9.81;

const PARAMETERS: Parameters = Parameters {
    init_time: 0.01,
    engage_time: 0.02,
    soft_stop_time: 0.01,
    heartbeat_timeout: 0.0,
    hold_enter: 2.0,
    hold_leave: 3.0,
    hold_time: 0.5,
    hold_brake: 0.05,
    saturation_time: 0.0,
    drift_distance: 0.1,
    drift_band: 0.3,
    drift_time: 1.0,
    drift_stop_time: 0.0,
    drift_mass: 0.0,
};

/// A nominal on one axis under supervision.
struct Story {
    supervisor: Supervisor,
    inputs: Inputs,
    v: f64,
    /// velocity when it was last free
    free: f64,
    x: f64,
    state: State,
    /// ticks in hold
    held: u32,
    named: Vec<Diagnostic>,
    first_fault: Diagnostic,
}

impl Story {
    /// Engaged under the force `felt` for half a second.
    fn engaged(parameters: Parameters, felt: Felt) -> Self {
        let mut story = Self {
            supervisor: Supervisor::new(&parameters, T).unwrap(),
            inputs: Inputs {
                enable: true,
                ..Inputs::default()
            },
            v: 0.0,
            free: 0.0,
            x: 0.0,
            state: State::Off,
            held: 0,
            named: Vec::new(),
            first_fault: Diagnostic::None,
        };
        (0..20).for_each(|_| story.tick(felt));
        assert_eq!(story.state, State::Ready);
        story.inputs.engage = true;
        story.named.clear();
        story.held = 0;
        (0..500).for_each(|_| story.tick(felt));
        story
    }

    fn tick(&mut self, felt: Felt) {
        self.inputs.felt = felt;
        self.inputs.force = felt.force.norm();
        match self.supervisor.step(&self.inputs) {
            Demand::Rest => (self.v, self.free) = (0.0, 0.0),
            Demand::Run { freedom, .. } => {
                self.v += (self.inputs.force - D * self.v) / M * T;
                if freedom < 1.0 {
                    self.v = self.v.min(self.free * freedom);
                } else {
                    self.free = self.v;
                }
            }
        }
        self.x += self.v * T;
        let status = self.supervisor.judge(&Report {
            speed: self.v,
            ..Report::default()
        });
        self.state = status.state;
        self.held += u32::from(status.state == State::Hold);
        self.first_fault = status.first_fault;
        if self.named.last() != Some(&status.diagnostic) {
            self.named.push(status.diagnostic);
        }
    }

    /// The way under a force along x (N) that is `f` of the time (s), for `duration` (s).
    fn way(&mut self, duration: f64, f: impl Fn(f64) -> f64) -> f64 {
        let before = self.x;
        for k in 0..(duration / T) as u32 {
            self.tick(along_x(f(f64::from(k) * T)));
        }
        self.x - before
    }
}

fn along_x(f: f64) -> Felt {
    Felt {
        force: Vector3::new(f, 0.0, 0.0),
        ..Felt::default()
    }
}

/// Noise of a sensor, N: uniform numbers of Park and Miller with a deviation of 0.05 N.
fn noise(seed: &mut u64) -> f64 {
    *seed = *seed * 48_271 % 2_147_483_647;
    (*seed as f64 / 2_147_483_647.0 - 0.5) * 0.05 * 12.0_f64.sqrt()
}

#[test]
fn a_drift_moves_an_unattended_nominal_by_nothing_up_to_the_band_in_its_time() {
    for newtons_a_minute in [0.1_f64, 1.0, 6.0, 14.0] {
        let rate = newtons_a_minute / 60.0;
        let mut story = Story::engaged(PARAMETERS, along_x(0.0));
        let mut seed = 7;
        let before = story.x;
        // As far as 10 N, or for ten minutes.
        for k in 0..(10.0 / rate / T).min(6e5) as u32 {
            let f = rate * T * f64::from(k);
            let mut felt = along_x(f);
            felt.force += Vector3::new(noise(&mut seed), noise(&mut seed), noise(&mut seed));
            story.tick(felt);
        }
        assert!(
            story.x - before < 1e-4,
            "{newtons_a_minute} N/min: {}",
            story.x
        );
        let drifted = newtons_a_minute > 0.5;
        assert_eq!(
            story.named.last(),
            Some(if drifted {
                &Diagnostic::ForceSteady
            } else {
                &Diagnostic::None
            })
        );
        assert_eq!(story.state, State::Hold);
    }
}

#[test]
fn a_drift_that_comes_after_a_hand_has_worked_and_rested_moves_nothing() {
    let mut story = Story::engaged(PARAMETERS, along_x(0.0));
    story.way(0.5, |t| 8.0 * (core::f64::consts::TAU * t).sin().abs());
    story.way(0.7, |_| 0.0); // long enough for the hold, short of drift_time
    assert_eq!((story.state, story.v), (State::Hold, 0.0));
    assert!(story.supervisor.drift().unwrap().moved() < 0.09);
    let way = story.way(50.0, |t| 0.1 * t);
    assert!(way < 1e-4, "{way}");
    assert_eq!(story.state, State::Hold);
}

#[test]
fn what_a_push_leaves_moves_the_nominal_by_the_stated_distance_at_most() {
    for left in [0.5, 2.5, 5.0, 10.0, 20.0] {
        for distance in [0.05, 0.1, 0.3] {
            let parameters = Parameters {
                drift_distance: distance,
                hold_enter: 0.3,
                hold_leave: 0.4,
                ..PARAMETERS
            };
            let mut story = Story::engaged(parameters, along_x(0.0));
            // 80 N for a fifth of a second; down to what is left in a tenth.
            story.way(0.2, |t| 400.0 * t);
            story.way(0.1, |t| 80.0 + (left - 80.0) * 10.0 * t);
            story.named.clear();
            // It coasts from the push first, with signs of a hand until the smoothed force has settled.
            let settled = SMOOTHING * (80.0_f64 / PARAMETERS.drift_band).ln() + SMOOTHING;
            story.way(settled, |_| left);
            let braking = story.v * (PARAMETERS.hold_brake / 2.0 + T);
            let way = story.way(20.0, |_| left);
            assert!(
                way <= distance.max(braking),
                "{left} N: {way} m of {distance} m, {braking} m of braking"
            );
            assert_eq!((story.state, story.v), (State::Hold, 0.0));
            assert_eq!(story.named.last(), Some(&Diagnostic::ForceSteady));
        }
    }
}

#[test]
fn it_warns_at_half_the_distance_and_holds_at_the_whole() {
    let mut story = Story::engaged(PARAMETERS, along_x(0.0));
    story.way(0.2, |t| 20.0 * t);
    story.way(0.2, |_| 4.0);
    story.named.clear();
    let before = story.x;
    let (mut warned, mut held) = (f64::NAN, f64::NAN);
    for _ in 0..3000 {
        story.tick(along_x(4.0));
        let way = story.x - before;
        if warned.is_nan() && story.named.last() == Some(&Diagnostic::ForceSteady) {
            warned = way;
            assert_eq!(story.state, State::Engaged);
        }
        if held.is_nan() && story.state == State::Hold {
            held = way;
        }
    }
    // From the last sign on, which the rise of the force to its end gave somewhere before.
    assert!((0.03..0.055).contains(&warned), "{warned}");
    assert!((0.07..0.1).contains(&held) && held > warned, "{held}");
}

#[test]
fn a_hand_that_varies_its_force_is_served_as_far_as_it_wants() {
    let mut story = Story::engaged(PARAMETERS, along_x(0.0));
    // 6 N, 0.3 m/s, that vary by 7 % twice a second.
    story.way(0.3, |t| 20.0 * t);
    story.held = 0;
    let way = story.way(10.0, |t| {
        6.0 + 0.4 * (2.0 * core::f64::consts::TAU * t).sin()
    });
    assert!(way > 2.5, "{way}");
    assert_eq!(story.held, 0);
}

#[test]
fn a_hand_that_keeps_still_is_held_at_the_distance_and_goes_on_with_any_change() {
    let mut story = Story::engaged(PARAMETERS, along_x(0.0));
    let first = story.way(5.0, |t| (20.0 * t).min(6.0));
    assert!((0.1..0.2).contains(&first), "{first}"); // what it moved while the force rose, and 0.1 m
    assert_eq!(story.state, State::Hold);
    let second = story.way(5.0, |t| 6.0 + (5.0 * t).min(0.5));
    assert!((0.05..0.12).contains(&second), "{second}");
    assert_eq!(story.state, State::Hold);
}

#[test]
fn a_steady_force_that_is_there_when_it_engages_moves_nothing_until_a_hand_shows() {
    let mut story = Story::engaged(PARAMETERS, along_x(10.7));
    story.way(10.0, |_| 10.7);
    assert!(story.x < 1e-4, "{}", story.x);
    assert_eq!(story.named.last(), Some(&Diagnostic::ForceSteady));
    assert!(story.way(0.5, |t| 10.7 + 10.0 * t) > 0.05);
}

#[test]
fn a_load_that_sinks_with_nobody_at_the_handle_is_held_too() {
    let parameters = Parameters {
        hold_enter: 0.0,
        hold_leave: 0.0,
        ..PARAMETERS
    };
    let mut story = Story::engaged(parameters, along_x(0.0));
    story.tick(along_x(0.0));
    story.way(0.2, |t| 20.0 * t);
    story.way(0.2, |t| 4.0 - 20.0 * t);
    story.way(0.15, |_| 0.0); // the last sign is seen late by the smoothing
    let mut sunk = 0.0;
    for _ in 0..60_000 {
        story.inputs.felt = Felt::default();
        story.inputs.force = 0.0;
        let runs = story.supervisor.step(&story.inputs);
        let speed = if matches!(runs, Demand::Run { freedom, .. } if freedom >= 1.0) {
            0.0086 // f_a/(K D_n) of 17.5 kg
        } else {
            0.0
        };
        sunk += speed * T;
        story.state = story
            .supervisor
            .judge(&Report {
                speed,
                ..Report::default()
            })
            .state;
    }
    assert!((0.09..=0.1).contains(&sunk), "{sunk}");
    assert_eq!(story.state, State::Hold);
}

#[test]
fn after_its_time_a_steady_force_is_a_fault_by_the_same_name() {
    let parameters = Parameters {
        drift_stop_time: 2.0,
        ..PARAMETERS
    };
    let mut story = Story::engaged(parameters, along_x(10.0));
    story.way(1.4, |_| 10.0);
    assert_eq!(
        (story.state, story.first_fault),
        (State::Hold, Diagnostic::None)
    );
    story.way(0.2, |_| 10.0);
    assert_eq!(story.state, State::Fault);
    assert_eq!(story.first_fault, Diagnostic::ForceSteady);
    assert_eq!(story.named.last(), Some(&Diagnostic::NotAcknowledged));
    story.inputs.acknowledge = true;
    story.tick(along_x(10.0));
    assert_eq!(
        (story.state, story.first_fault),
        (State::Off, Diagnostic::None)
    );
}

/// What a tool that is `wrong` (kg) heavier than it was said to be leaves of its weight at a pitch, tared at pitch 0.
fn tool(wrong: f64, pitch: f64) -> Felt {
    let gravity = |pitch| {
        Rotation3::from_euler_angles(0.0, pitch, 0.0).inverse() * Vector3::new(0.0, 0.0, -G)
    };
    Felt {
        force: wrong * (gravity(pitch) - gravity(0.0)),
        gravity: gravity(pitch),
        bias: wrong * gravity(0.0) + Vector3::new(0.4, -0.2, 0.1),
        known: true,
    }
}

/// Engaged at `pitch` with such a tool after a tare at pitch 0, with a tool's error of `reckoned` kg reckoned with.
fn with_tool(wrong: f64, pitch: f64, reckoned: f64) -> Story {
    let parameters = Parameters {
        drift_mass: reckoned,
        ..PARAMETERS
    };
    let mut story = Story::engaged(parameters, tool(wrong, 0.0));
    assert!(story.x < 1e-4);
    for k in 0..=1000 {
        story.tick(tool(wrong, pitch * f64::from(k) / 1000.0)); // somebody else turns the arm
    }
    story
}

#[test]
fn a_wrong_tool_weight_is_named_with_its_error_and_a_drift_is_not_taken_for_one() {
    for (wrong, pitch) in [(1.09, 0.8), (-1.09, 0.8), (1.09, -1.2), (0.6, 1.0)] {
        let mut story = with_tool(wrong, pitch, 1.5);
        story.way_of(tool(wrong, pitch), 2.0);
        assert_eq!(
            story.named.last(),
            Some(&Diagnostic::ToolWeight),
            "{wrong} kg at {pitch}"
        );
        let found = story.supervisor.drift().unwrap().mass_error();
        assert!((found / wrong - 1.0).abs() < 0.01, "{found} of {wrong} kg");
    }
    // As strong, half of it across.
    let mut drifting = tool(1.09, 0.8);
    drifting.force += Vector3::new(0.0, drifting.force.norm(), 0.0);
    let mut story = with_tool(0.0, 0.8, 1.5);
    for k in 0..60_000 {
        let mut felt = drifting;
        felt.force *= f64::from(k) / 60_000.0;
        story.tick(Felt {
            bias: tool(0.0, 0.0).bias,
            ..felt
        });
    }
    assert_eq!(story.named.last(), Some(&Diagnostic::ForceSteady));
    assert_eq!(story.supervisor.drift().unwrap().mass_error(), 0.0);
}

#[test]
fn a_force_that_turns_with_the_pose_as_a_wrong_tool_does_shows_no_hand() {
    // One second of 0.8 rad turns 1.09 kg by 8 N: beyond the band by far.
    let reckoned = with_tool(1.09, 0.8, 1.5);
    assert!(reckoned.x < 1e-4, "{}", reckoned.x);
    assert_eq!(reckoned.state, State::Hold);
    let ignored = with_tool(1.09, 0.8, 0.0);
    assert!(ignored.x > 0.1, "{}", ignored.x);
}

#[test]
fn a_tare_ends_a_steady_force_and_shows_no_hand() {
    let mut story = Story::engaged(PARAMETERS, along_x(5.0));
    let before = story.x;
    for _ in 0..500 {
        story.tick(Felt {
            known: false,
            ..along_x(0.0)
        });
    }
    // At its last tick the bias is not yet taken off what is felt. Somebody had let go too late: 4 N are left.
    story.tick(along_x(5.0));
    let tared = Felt {
        bias: Vector3::new(1.0, 0.0, 0.0),
        ..along_x(4.0)
    };
    story.way_of(tared, 5.0);
    assert!(story.x - before < 1e-4);
    assert_eq!(
        (story.state, story.named.last()),
        (State::Hold, Some(&Diagnostic::ForceSteady))
    );
}

impl Story {
    fn way_of(&mut self, felt: Felt, duration: f64) {
        (0..(duration / T) as u32).for_each(|_| self.tick(felt));
    }
}
