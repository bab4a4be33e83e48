//! Supervision in single precision says what it says in double precision, tick by tick.

use arm_law::supervision as double;
use arm_law_f32::supervision as single;

#[test]
fn times_are_the_same_number_of_ticks_in_both_precisions() {
    for period in [0.0005, 0.001, 0.002, 0.004] {
        for ms in 0..2000_u16 {
            let time = f64::from(ms) * 0.004;
            let d = double::parameters::Durations::new(
                &double::Parameters {
                    engage_time: time,
                    ..Default::default()
                },
                period,
            );
            let s = single::parameters::Durations::new(
                &single::Parameters {
                    engage_time: time as f32,
                    ..Default::default()
                },
                period as f32,
            );
            assert_eq!(
                d.unwrap().engage,
                s.unwrap().engage,
                "{time} s in periods of {period} s"
            );
        }
    }
}

/// Enable, engage, a hold, a lost force sensor; at which tick each begins.
const STORY: [(u32, &str); 5] = [
    (10, "enable"),
    (200, "engage"),
    (900, "hold"),
    (950, "free"),
    (1100, "ft lost"),
];

#[test]
fn a_run_has_the_same_states_and_the_same_authority_to_single_precision() {
    let mut d = double::Supervisor::new(&double::Parameters::default(), 0.001).unwrap();
    let mut s = single::Supervisor::new(&single::Parameters::default(), 0.001).unwrap();
    let mut inputs = double::Inputs::default();
    let mut states = Vec::new();
    for k in 0..2000_u16 {
        for (at, what) in STORY {
            if at == u32::from(k) {
                match what {
                    "enable" => inputs.enable = true,
                    "engage" => inputs.engage = true,
                    "hold" => inputs.hold = true,
                    "free" => inputs.hold = false,
                    _ => inputs.ft_valid = false,
                }
            }
        }
        inputs.heartbeat = i32::from(k) / 50;
        let demand = d.step(&inputs);
        let same = s.step(&single::Inputs {
            enable: inputs.enable,
            engage: inputs.engage,
            acknowledge: false,
            emergency_stop: false,
            hold: inputs.hold,
            heartbeat: inputs.heartbeat,
            ft_valid: inputs.ft_valid,
            encoder_valid: true,
            force: 0.0,
            felt: single::Felt::default(),
        });
        match (demand, same) {
            (double::Demand::Rest, single::Demand::Rest) => {}
            (
                double::Demand::Run { authority, freedom },
                single::Demand::Run {
                    authority: a,
                    freedom: f,
                },
            ) => {
                // One quotient, one difference and one product in single precision.
                let rounding = 3.0 * f64::from(f32::EPSILON);
                assert!((authority - f64::from(a)).abs() <= rounding, "tick {k}");
                assert!((freedom - f64::from(f)).abs() <= rounding, "tick {k}");
            }
            other => panic!("tick {k}: {other:?}"),
        }
        let now = d.judge(&double::Report::default());
        let then = s.judge(&single::Report::default());
        assert_eq!(now.state.number(), then.state.number(), "tick {k}");
        assert_eq!(
            now.diagnostic.number(),
            then.diagnostic.number(),
            "tick {k}"
        );
        if states.last() != Some(&now.state) {
            states.push(now.state);
        }
    }
    use double::State::*;
    assert_eq!(
        states,
        [Off, Init, Ready, Engaged, Hold, Engaged, SoftStop, Fault]
    );
}
