//! Random walks: whatever the inputs do, the demand changes as promised.

use arm_law::supervision::{
    Demand, Diagnostic, Felt, Inputs, Parameters, Report, State, Status, Supervisor,
};
use nalgebra::Vector3;
use proptest::prelude::*;

const T: f64 = 0.001;

fn parameters() -> impl Strategy<Value = Parameters> {
    let time = || 0.0..0.02;
    (
        time(),
        time(),
        time(),
        time(),
        0.0..4.0,
        0.0..2.0,
        time(),
        time(),
        time(),
        (prop_oneof![Just(0.0), 0.0..0.05], 0.1..1.0, 0.0..2.0),
    )
        .prop_map(
            |(
                init,
                engage,
                stop,
                heartbeat,
                enter,
                more,
                hold,
                brake,
                saturation,
                (distance, band, mass),
            )| Parameters {
                init_time: init,
                engage_time: engage,
                soft_stop_time: stop,
                heartbeat_timeout: heartbeat,
                hold_enter: enter,
                hold_leave: enter + more,
                hold_time: hold,
                hold_brake: brake,
                saturation_time: saturation,
                drift_distance: distance,
                drift_band: band,
                drift_time: 0.01,
                drift_stop_time: saturation,
                drift_mass: mass,
            },
        )
}

/// A stretch of ticks with the same inputs. Faults are rarer than good inputs, so that the walk gets somewhere.
#[derive(Clone, Debug)]
struct Stretch {
    ticks: usize,
    inputs: Inputs,
    beats: bool,
    report: Report,
}

prop_compose! {
    fn felt()(
        force in prop_oneof![4 => 0.0..8.0, 1 => Just(f64::INFINITY)],
        z in -9.81..9.81,
        tool in any::<bool>(),
        known in prop::bool::weighted(0.9),
    ) -> Felt {
        let gravity = Vector3::new(0.0, 9.81, z);
        Felt {
            force: if tool { 0.5 * gravity } else { Vector3::new(force, 0.0, 0.0) },
            gravity,
            bias: Vector3::zeros(),
            known,
        }
    }
}

prop_compose! {
    fn stretch()(
        ticks in 1_usize..40,
        enable in prop::bool::weighted(0.95),
        engage in prop::bool::weighted(0.7),
        acknowledge in prop::bool::weighted(0.5),
        emergency_stop in prop::bool::weighted(0.03),
        hold in prop::bool::weighted(0.2),
        ft_valid in prop::bool::weighted(0.95),
        encoder_valid in prop::bool::weighted(0.97),
        force in prop_oneof![0.0..8.0, Just(f64::NAN)],
        felt in felt(),
        speed in 0.0..1.0,
        beats in prop::bool::weighted(0.9),
        finite in prop::bool::weighted(0.98),
        debt in prop::bool::weighted(0.1),
        outside_bounds in prop::bool::weighted(0.1),
        saturated in prop::bool::weighted(0.3),
    ) -> Stretch {
        Stretch {
            ticks,
            inputs: Inputs {
                enable, engage, acknowledge, emergency_stop, hold, heartbeat: 0,
                ft_valid, encoder_valid, force, felt,
            },
            beats,
            report: Report { finite, debt, outside_bounds, saturated, speed },
        }
    }
}

/// What one tick may do after the one before.
fn check(inputs: &Inputs, report: &Report, demand: Demand, before: &Status, now: &Status, up: f64) {
    let acts = matches!(demand, Demand::Run { .. });
    assert_eq!(acts && report.finite, now.state.acts());
    if let Demand::Run { authority, freedom } = demand {
        assert!(inputs.encoder_valid && !inputs.emergency_stop);
        assert!((0.0..=1.0).contains(&authority) && (0.0..=1.0).contains(&freedom));
        // The rounding of one quotient.
        assert!(
            authority - before.authority <= up + 1e-15,
            "{before:?} {now:?}"
        );
        if !before.state.acts() {
            assert_eq!(
                (now.state == State::Engaged || !report.finite, authority),
                (true, 0.0)
            );
        }
        if now.state == State::SoftStop && before.state == State::SoftStop {
            assert!(authority <= before.authority);
        }
        if matches!(now.state, State::Engaged | State::Hold) {
            assert!(inputs.enable && inputs.engage && inputs.ft_valid);
            assert!(authority >= before.authority);
        }
        if report.finite {
            assert_eq!(freedom < 1.0, now.state.holds());
        }
    } else {
        assert_eq!(now.authority, 0.0);
    }
    if now.state == State::Fault {
        assert!(now.first_fault != Diagnostic::None && now.diagnostic != Diagnostic::None);
    }
    let stays = before.first_fault != Diagnostic::None && now.state != State::Off;
    if stays && before.state != State::Off && !(before.state == State::Fault && inputs.acknowledge)
    {
        assert_eq!(now.first_fault, before.first_fault);
    }
    if !matches!(now.state, State::Engaged | State::Hold) {
        assert!(
            now.diagnostic != Diagnostic::None,
            "{now:?} without a reason"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_demand_changes_as_promised_whatever_the_inputs_do(
        parameters in parameters(),
        stretches in prop::collection::vec(stretch(), 1..40),
    ) {
        let mut supervisor = Supervisor::new(&parameters, T).unwrap();
        let up = 1.0 / (parameters.engage_time / T).round().max(1.0);
        let mut before = Status {
            state: State::Off,
            diagnostic: Diagnostic::None,
            first_fault: Diagnostic::None,
            authority: 0.0,
        };
        let mut heartbeat = 0_i32;
        for Stretch { ticks, inputs, beats, report } in stretches {
            for _ in 0..ticks {
                heartbeat = heartbeat.wrapping_add(i32::from(beats));
                let inputs = Inputs { heartbeat, ..inputs };
                let demand = supervisor.step(&inputs);
                let now = supervisor.judge(&report);
                check(&inputs, &report, demand, &before, &now, up);
                before = now;
            }
        }
    }
}

#[test]
fn the_walk_gets_everywhere() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let mut seen = std::collections::HashSet::new();
    let mut named = std::collections::HashSet::new();
    for _ in 0..200 {
        let parameters = parameters().new_tree(&mut runner).unwrap().current();
        let walk = prop::collection::vec(stretch(), 40);
        let walk = walk.new_tree(&mut runner).unwrap().current();
        let mut supervisor = Supervisor::new(&parameters, T).unwrap();
        let mut heartbeat = 0_i32;
        for stretch in walk {
            for _ in 0..stretch.ticks {
                heartbeat = heartbeat.wrapping_add(i32::from(stretch.beats));
                supervisor.step(&Inputs {
                    heartbeat,
                    ..stretch.inputs
                });
                let status = supervisor.judge(&stretch.report);
                seen.insert(status.state);
                named.insert(status.diagnostic);
            }
        }
    }
    assert_eq!(seen.len(), State::ALL.len());
    assert_eq!(named.len(), Diagnostic::ALL.len());
}
