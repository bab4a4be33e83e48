//! What a supervisor is refused for.

use arm_law::supervision::parameters::{Durations, Parameters};

fn refused(change: impl FnOnce(&mut Parameters)) -> String {
    let mut parameters = Parameters::default();
    change(&mut parameters);
    Durations::new(&parameters, 0.001).unwrap_err().to_string()
}

#[test]
fn a_time_or_threshold_out_of_range_is_refused_by_name_value_and_range() {
    let of = "expected a finite value not less than 0";
    assert_eq!(
        refused(|p| p.init_time = -1.0),
        format!("init_time = -1: {of}")
    );
    assert_eq!(
        refused(|p| p.engage_time = -0.5),
        format!("engage_time = -0.5: {of}")
    );
    assert_eq!(
        refused(|p| p.soft_stop_time = f64::NAN),
        format!("soft_stop_time = NaN: {of}")
    );
    assert_eq!(
        refused(|p| p.heartbeat_timeout = f64::INFINITY),
        format!("heartbeat_timeout = inf: {of}")
    );
    assert_eq!(
        refused(|p| p.hold_enter = -2.0),
        format!("hold_enter = -2: {of}")
    );
    assert_eq!(
        refused(|p| p.hold_time = -2.0),
        format!("hold_time = -2: {of}")
    );
    assert_eq!(
        refused(|p| p.hold_brake = -2.0),
        format!("hold_brake = -2: {of}")
    );
    assert_eq!(
        refused(|p| p.saturation_time = -2.0),
        format!("saturation_time = -2: {of}")
    );
    assert_eq!(
        refused(|p| p.drift_distance = -0.1),
        format!("drift_distance = -0.1: {of}")
    );
    assert_eq!(
        refused(|p| p.drift_stop_time = f64::NAN),
        format!("drift_stop_time = NaN: {of}")
    );
    assert_eq!(
        refused(|p| p.drift_mass = -1.0),
        format!("drift_mass = -1: {of}")
    );
    for (message, name) in [
        (refused(|p| p.drift_band = 0.0), "drift_band"),
        (refused(|p| p.drift_time = 0.0), "drift_time"),
    ] {
        assert!(
            message.starts_with(&format!("{name} = 0: expected ")),
            "{message}"
        );
    }
}

#[test]
fn a_hold_cannot_be_left_below_the_force_at_which_it_is_entered() {
    let message = refused(|p| (p.hold_enter, p.hold_leave) = (2.0, 1.0));
    assert_eq!(
        message,
        "hold_leave = 1: expected a value not less than hold_enter"
    );
}

#[test]
fn a_sample_period_that_is_none_is_refused() {
    for period in [0.0, -0.001, f64::NAN, f64::INFINITY] {
        let message = Durations::new(&Parameters::default(), period).unwrap_err();
        assert!(message.to_string().starts_with("T = "), "{message}");
    }
}

#[test]
fn times_become_the_nearest_number_of_ticks_and_at_least_one_where_they_are_not_zero() {
    let parameters = Parameters {
        init_time: 0.0,
        engage_time: 0.3, // 0.3/0.001 = 299.99999999999994
        soft_stop_time: 0.0,
        heartbeat_timeout: 1e-9,
        hold_time: 1e12,
        hold_brake: 0.0024,
        saturation_time: 0.0,
        drift_time: 0.0004,
        drift_stop_time: 0.0,
        ..Parameters::default()
    };
    let durations = Durations::new(&parameters, 0.001).unwrap();
    assert_eq!(
        durations,
        Durations {
            init: 0,
            engage: 300,
            soft_stop: 1,
            heartbeat: 1,
            hold: u32::MAX,
            brake: 2,
            saturation: 0,
            drift: 1,
            drift_stop: 0
        }
    );
}
