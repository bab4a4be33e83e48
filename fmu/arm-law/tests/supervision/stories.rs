//! What an operator meets, told tick by tick.

use arm_law::supervision::watch::Edge;
use arm_law::supervision::{
    Demand, Diagnostic, Inputs, Parameters, Report, State, Status, Supervisor,
};

/// 10 ticks of checks, 20 to engage, 8 to stop, 5 for a heartbeat, 6 for a hand at rest, 4 to brake.
const PARAMETERS: Parameters = Parameters {
    init_time: 0.010,
    engage_time: 0.020,
    soft_stop_time: 0.008,
    heartbeat_timeout: 0.005,
    hold_enter: 2.0,
    hold_leave: 3.0,
    hold_time: 0.006,
    hold_brake: 0.004,
    saturation_time: 0.003,
    drift_distance: 0.0,
    drift_band: 0.3,
    drift_time: 1.0,
    drift_stop_time: 0.0,
    drift_mass: 0.0,
};

/// A supervisor, its inputs, and a partner whose heart beats.
struct Story {
    supervisor: Supervisor,
    inputs: Inputs,
    beats: bool,
    report: Report,
}

impl Story {
    fn new(parameters: Parameters) -> Self {
        Self {
            supervisor: Supervisor::new(&parameters, 0.001).unwrap(),
            inputs: Inputs {
                force: 10.0,
                ..Inputs::default()
            },
            beats: true,
            report: Report::default(),
        }
    }

    /// Ready for an edge of engage.
    fn ready() -> Self {
        let mut story = Self::new(PARAMETERS);
        story.inputs.enable = true;
        let (_, status) = story.ticks(12);
        assert_eq!(status.state, State::Ready);
        story
    }

    /// Engaged with full authority.
    fn engaged() -> Self {
        let mut story = Self::ready();
        story.inputs.engage = true;
        let (demand, status) = story.ticks(21);
        assert_eq!((status.state, demand), (State::Engaged, run(1.0, 1.0)));
        story
    }

    /// In `state`, without a fault.
    fn into(state: State) -> Self {
        match state {
            State::Off => Self::new(PARAMETERS),
            State::Init => {
                let mut story = Self::new(PARAMETERS);
                story.inputs.enable = true;
                story.ticks(2);
                story
            }
            State::Ready => Self::ready(),
            State::Engaged => Self::engaged(),
            State::Hold => {
                let mut story = Self::engaged();
                story.inputs.hold = true;
                story.tick();
                story
            }
            State::SoftStop => {
                let mut story = Self::engaged();
                story.inputs.engage = false;
                story.tick();
                story
            }
            State::Fault => {
                let mut story = Self::engaged();
                story.inputs.emergency_stop = true;
                story.tick();
                story.inputs.emergency_stop = false;
                story
            }
        }
    }

    fn tick(&mut self) -> (Demand, Status) {
        if self.beats {
            self.inputs.heartbeat = self.inputs.heartbeat.wrapping_add(1);
        }
        let demand = self.supervisor.step(&self.inputs);
        (demand, self.supervisor.judge(&self.report))
    }

    fn ticks(&mut self, n: usize) -> (Demand, Status) {
        (0..n).map(|_| self.tick()).last().unwrap()
    }

    fn state(&mut self) -> State {
        self.tick().1.state
    }
}

const fn run(authority: f64, freedom: f64) -> Demand {
    Demand::Run { authority, freedom }
}

#[test]
fn it_is_prepared_after_ten_periods_of_good_sensors_and_not_before() {
    let mut story = Story::new(PARAMETERS);
    assert_eq!(story.tick().1.diagnostic, Diagnostic::HeartbeatLost); // the first value is no change
    assert_eq!(story.tick().1.diagnostic, Diagnostic::NotEnabled);
    story.inputs.enable = true;
    assert_eq!(story.state(), State::Init);
    for _ in 0..10 {
        let (demand, status) = story.tick();
        assert_eq!((demand, status.state), (Demand::Rest, State::Init));
        assert_eq!(status.diagnostic, Diagnostic::Preparing);
    }
    let (demand, status) = story.tick();
    assert_eq!((demand, status.state), (Demand::Rest, State::Ready));
    assert_eq!(status.diagnostic, Diagnostic::NotEngaged);
}

#[test]
fn one_bad_sample_during_init_starts_its_ten_periods_again() {
    let mut story = Story::into(State::Init);
    story.ticks(7);
    story.inputs.ft_valid = false;
    assert_eq!(story.tick().1.diagnostic, Diagnostic::FtInvalid);
    story.inputs.ft_valid = true;
    assert_eq!(story.ticks(10).1.state, State::Init);
    assert_eq!(story.state(), State::Ready);
}

#[test]
fn engaging_begins_with_no_authority_and_rises_in_equal_steps_to_exactly_one() {
    let mut story = Story::ready();
    story.inputs.engage = true;
    for k in 0..=20 {
        assert_eq!(story.tick().0, run(f64::from(k) / 20.0, 1.0));
    }
    assert_eq!(story.ticks(100).0, run(1.0, 1.0));
}

#[test]
fn an_engage_that_is_stuck_at_true_never_engages() {
    let mut story = Story::new(PARAMETERS);
    (story.inputs.enable, story.inputs.engage) = (true, true);
    let (demand, status) = story.ticks(1000);
    assert_eq!((demand, status.state), (Demand::Rest, State::Ready));
    assert_eq!(status.diagnostic, Diagnostic::EngageStuck);
    story.inputs.engage = false;
    assert_eq!(story.tick().1.diagnostic, Diagnostic::NotEngaged);
    story.inputs.engage = true;
    assert_eq!(story.state(), State::Engaged);
}

#[test]
fn what_is_true_from_the_beginning_does_not_rise() {
    let mut edge = Edge::new();
    assert!(!edge.rises(true));
    assert!(!edge.rises(false));
    assert!(edge.rises(true));
    assert!(!edge.rises(true));
}

#[test]
fn an_edge_of_engage_that_comes_too_early_is_not_remembered() {
    let mut story = Story::into(State::Init);
    story.inputs.engage = true;
    assert_eq!(story.ticks(100).1.diagnostic, Diagnostic::EngageStuck);
}

#[test]
fn withdrawing_engage_brings_the_nominal_to_rest_and_the_authority_down_and_ends_in_off() {
    for withdraw in [
        |inputs: &mut Inputs| inputs.engage = false,
        |inputs: &mut Inputs| inputs.enable = false,
    ] {
        let mut story = Story::engaged();
        withdraw(&mut story.inputs);
        for j in 0..=8 {
            let (demand, status) = story.tick();
            let freedom = 1.0 - f64::from(4.min(j + 1)) / 4.0;
            assert_eq!(status.state, State::SoftStop);
            assert_eq!(demand, run(1.0 - f64::from(j) / 8.0, freedom));
            assert_eq!(status.first_fault, Diagnostic::None);
        }
        let (demand, status) = story.tick();
        assert_eq!((demand, status.state), (Demand::Rest, State::Off));
    }
}

#[test]
fn a_stop_while_engaging_starts_from_the_authority_of_the_moment() {
    let mut story = Story::ready();
    story.inputs.engage = true;
    assert_eq!(story.ticks(11).0, run(0.5, 1.0));
    story.inputs.engage = false;
    assert_eq!(story.tick().0, run(0.5, 0.75)); // no step of the authority
    assert_eq!(story.tick().0, run(0.5 * (1.0 - 1.0 / 8.0), 0.5));
    assert_eq!(story.ticks(7).0, run(0.0, 0.0));
    assert_eq!(story.state(), State::Off);
}

#[test]
fn an_engage_that_returns_during_a_soft_stop_does_not_take_it_back() {
    let mut story = Story::into(State::SoftStop);
    story.inputs.engage = true;
    for _ in 0..8 {
        let (_, status) = story.tick();
        assert_eq!(
            (status.state, status.diagnostic),
            (State::SoftStop, Diagnostic::EngageStuck)
        );
    }
    assert_eq!(story.state(), State::Off);
    assert_eq!(story.ticks(200).1.diagnostic, Diagnostic::EngageStuck);
}

#[test]
fn a_lost_heartbeat_stops_softly_and_ends_in_a_fault() {
    let mut story = Story::engaged();
    story.beats = false;
    assert_eq!(story.ticks(4).1.state, State::Engaged);
    let (demand, status) = story.tick(); // five ticks without a change
    assert_eq!((demand, status.state), (run(1.0, 0.75), State::SoftStop));
    assert_eq!(status.diagnostic, Diagnostic::HeartbeatLost);
    assert_eq!(status.first_fault, Diagnostic::HeartbeatLost);
    assert_eq!(story.ticks(8).0, run(0.0, 0.0));
    let (demand, status) = story.tick();
    assert_eq!((demand, status.state), (Demand::Rest, State::Fault));
    story.beats = true;
    let (_, status) = story.tick();
    assert_eq!(status.diagnostic, Diagnostic::NotAcknowledged);
    assert_eq!(status.first_fault, Diagnostic::HeartbeatLost);
}

#[test]
fn a_heartbeat_may_count_in_any_way_that_changes() {
    for beat in [
        |i: i32| i.wrapping_mul(3),
        |i: i32| i & 1,
        |i: i32| i32::MAX.wrapping_add(i),
        |i: i32| -i,
        |i: i32| i / 5, // changes every fifth tick: four without
    ] {
        let mut story = Story::engaged();
        story.beats = false;
        for i in 0..200 {
            story.inputs.heartbeat = beat(i);
            assert_eq!(story.state(), State::Engaged, "at {i}");
        }
    }
}

#[test]
fn with_a_timeout_of_zero_no_heartbeat_is_needed() {
    let mut story = Story::new(Parameters {
        heartbeat_timeout: 0.0,
        ..PARAMETERS
    });
    story.beats = false;
    story.inputs.enable = true;
    assert_eq!(story.ticks(12).1.state, State::Ready);
}

#[test]
fn an_invalid_force_stops_softly_in_engaged_and_in_hold() {
    for state in [State::Engaged, State::Hold] {
        let mut story = Story::into(state);
        story.inputs.ft_valid = false;
        let (demand, status) = story.tick();
        assert_eq!(status.state, State::SoftStop);
        assert!(matches!(demand, Demand::Run { authority: 1.0, freedom } if freedom < 1.0));
        assert_eq!(status.first_fault, Diagnostic::FtInvalid);
        story.inputs.ft_valid = true; // too late
        assert_eq!(story.ticks(9).1.state, State::Fault);
    }
}

#[test]
fn emergency_stop_and_invalid_encoders_take_the_torque_in_the_same_tick() {
    for state in [State::Engaged, State::Hold, State::SoftStop] {
        let mut story = Story::into(state);
        story.inputs.emergency_stop = true;
        let (demand, status) = story.tick();
        assert_eq!((demand, status.state), (Demand::Rest, State::Fault));
        assert_eq!(status.first_fault, Diagnostic::EmergencyStop);

        let mut story = Story::into(state);
        story.inputs.encoder_valid = false;
        let (demand, status) = story.tick();
        assert_eq!((demand, status.state), (Demand::Rest, State::Fault));
        assert_eq!(status.first_fault, Diagnostic::EncoderInvalid);
    }
}

#[test]
fn a_result_that_is_not_finite_becomes_a_fault_in_its_own_tick_in_every_state() {
    for state in State::ALL {
        let mut story = Story::into(state);
        story.report.finite = false;
        let (_, status) = story.tick();
        assert_eq!(status.state, State::Fault, "from {state:?}");
        assert_eq!(status.authority, 0.0);
        assert_eq!(status.diagnostic, Diagnostic::NotFinite);
        let first = match state {
            State::Fault => Diagnostic::EmergencyStop, // the one that had led there
            _ => Diagnostic::NotFinite,
        };
        assert_eq!(status.first_fault, first, "from {state:?}");
        story.report.finite = true;
        assert_eq!(story.tick().0, Demand::Rest);
    }
}

#[test]
fn the_first_fault_stays_named_while_others_come_and_go() {
    let mut story = Story::engaged();
    story.inputs.ft_valid = false;
    story.tick();
    story.inputs.emergency_stop = true;
    let (_, status) = story.tick();
    assert_eq!(status.diagnostic, Diagnostic::EmergencyStop);
    assert_eq!(status.first_fault, Diagnostic::FtInvalid);
    story.inputs.emergency_stop = false;
    assert_eq!(story.tick().1.diagnostic, Diagnostic::FtInvalid);
    story.inputs.ft_valid = true;
    let (_, status) = story.tick();
    assert_eq!(status.diagnostic, Diagnostic::NotAcknowledged);
    assert_eq!(status.first_fault, Diagnostic::FtInvalid);
}

#[test]
fn a_fault_during_a_requested_stop_turns_its_end_into_a_fault() {
    let mut story = Story::into(State::SoftStop);
    story.inputs.ft_valid = false;
    let (_, status) = story.tick();
    assert_eq!(
        (status.state, status.first_fault),
        (State::SoftStop, Diagnostic::FtInvalid)
    );
    assert_eq!(story.ticks(8).1.state, State::Fault);
}

#[test]
fn an_acknowledgement_counts_as_an_edge_after_the_cause_is_gone() {
    let mut story = Story::into(State::Fault);
    story.inputs.emergency_stop = true;
    story.inputs.acknowledge = true;
    assert_eq!(story.ticks(5).1.state, State::Fault); // the cause is there
    story.inputs.emergency_stop = false;
    let (_, status) = story.ticks(5); // held down: no edge
    assert_eq!(
        (status.state, status.diagnostic),
        (State::Fault, Diagnostic::NotAcknowledged)
    );
    story.inputs.acknowledge = false;
    assert_eq!(story.state(), State::Fault);
    story.inputs.acknowledge = true;
    let (_, status) = story.tick();
    assert_eq!(
        (status.state, status.first_fault),
        (State::Off, Diagnostic::None)
    );
    // enable and engage are still true: it gets ready again, and waits for an edge.
    assert_eq!(story.ticks(200).1.diagnostic, Diagnostic::EngageStuck);
}

#[test]
fn withdrawing_enable_does_not_clear_a_fault() {
    let mut story = Story::into(State::Fault);
    story.inputs.enable = false;
    assert_eq!(story.ticks(100).1.state, State::Fault);
}

#[test]
fn what_goes_wrong_before_anything_moves_sends_back_and_is_not_latched() {
    for spoil in [
        |inputs: &mut Inputs| inputs.ft_valid = false,
        |inputs: &mut Inputs| inputs.encoder_valid = false,
    ] {
        let mut story = Story::ready();
        let good = story.inputs;
        spoil(&mut story.inputs);
        let (_, status) = story.tick();
        assert_eq!(
            (status.state, status.first_fault),
            (State::Init, Diagnostic::None)
        );
        story.inputs = Inputs {
            heartbeat: story.inputs.heartbeat,
            ..good
        };
        assert_eq!(story.ticks(11).1.state, State::Ready);
    }
    let mut story = Story::ready();
    story.beats = false;
    assert_eq!(story.ticks(5).1.state, State::Init);
}

#[test]
fn an_emergency_stop_is_latched_wherever_the_controller_is_enabled() {
    for state in [State::Init, State::Ready] {
        let mut story = Story::into(state);
        story.inputs.emergency_stop = true;
        assert_eq!(story.state(), State::Fault);
    }
    let mut story = Story::into(State::Off);
    story.inputs.emergency_stop = true;
    let (_, status) = story.tick();
    assert_eq!(
        (status.state, status.diagnostic),
        (State::Off, Diagnostic::EmergencyStop)
    );
}

#[test]
fn a_requested_hold_brakes_the_nominal_in_equal_steps_and_keeps_the_authority() {
    let mut story = Story::engaged();
    story.inputs.hold = true;
    for freedom in [0.75, 0.5, 0.25, 0.0, 0.0] {
        let (demand, status) = story.tick();
        assert_eq!((status.state, demand), (State::Hold, run(1.0, freedom)));
        assert_eq!(status.diagnostic, Diagnostic::None);
    }
    story.inputs.hold = false;
    let (demand, status) = story.tick();
    assert_eq!((status.state, demand), (State::Engaged, run(1.0, 1.0)));
    story.inputs.hold = true;
    assert_eq!(story.tick().0, run(1.0, 0.75)); // it brakes anew
}

#[test]
fn a_hold_while_engaging_does_not_stop_the_authority_from_rising() {
    let mut story = Story::ready();
    story.inputs.engage = true;
    story.ticks(6);
    story.inputs.hold = true;
    assert!(matches!(story.tick().0, Demand::Run { authority: 0.3, .. }));
    assert_eq!(story.ticks(14).0, run(1.0, 0.0));
}

#[test]
fn a_hand_at_rest_for_six_periods_holds_and_a_firm_one_releases() {
    let mut story = Story::engaged();
    story.inputs.force = 1.9;
    assert_eq!(story.ticks(6).1.state, State::Engaged);
    assert_eq!(story.state(), State::Hold);
    story.inputs.force = 2.9; // within the hysteresis
    assert_eq!(story.ticks(100).1.state, State::Hold);
    story.inputs.force = 3.1;
    assert_eq!(story.state(), State::Engaged);
    story.inputs.force = 2.5; // again within
    assert_eq!(story.ticks(100).1.state, State::Engaged);
}

#[test]
fn a_short_pause_of_the_hand_is_no_rest() {
    let mut story = Story::engaged();
    for _ in 0..50 {
        story.inputs.force = 1.0;
        assert_eq!(story.ticks(6).1.state, State::Engaged);
        story.inputs.force = 2.1;
        assert_eq!(story.state(), State::Engaged);
    }
}

#[test]
fn with_a_threshold_of_zero_it_never_holds_by_itself() {
    let mut story = Story::engaged();
    story.supervisor = Supervisor::new(
        &Parameters {
            hold_enter: 0.0,
            hold_leave: 0.0,
            ..PARAMETERS
        },
        0.001,
    )
    .unwrap();
    (story.inputs.force, story.inputs.engage) = (0.0, false);
    story.ticks(20);
    story.inputs.engage = true;
    assert_eq!(story.ticks(1000).1.state, State::Engaged);
}

#[test]
fn warnings_are_named_while_the_law_runs_and_change_no_state() {
    let mut story = Story::engaged();
    let none = Report::default();
    for (report, diagnostic) in [
        (Report { debt: true, ..none }, Diagnostic::EnergyDebt),
        (
            Report {
                outside_bounds: true,
                ..none
            },
            Diagnostic::OutsideBounds,
        ),
        (
            Report {
                debt: true,
                outside_bounds: true,
                ..none
            },
            Diagnostic::EnergyDebt,
        ),
    ] {
        story.report = report;
        let (_, status) = story.tick();
        assert_eq!(
            (status.state, status.diagnostic),
            (State::Engaged, diagnostic)
        );
        assert_eq!(status.first_fault, Diagnostic::None);
    }
}

#[test]
fn saturation_is_named_when_it_lasts() {
    let mut story = Story::engaged();
    story.report.saturated = true;
    assert_eq!(story.ticks(2).1.diagnostic, Diagnostic::None);
    assert_eq!(story.tick().1.diagnostic, Diagnostic::Saturated);
    story.report.saturated = false;
    assert_eq!(story.tick().1.diagnostic, Diagnostic::None);
    story.report.saturated = true;
    assert_eq!(story.ticks(2).1.diagnostic, Diagnostic::None);
}
