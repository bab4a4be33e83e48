//! What reaches the importer's logger, and what must not.

use abi::{Fmu, Instance, Message, Phase, Status};

/// Drives an instance through success and refusals and returns all it said.
fn a_talkative_life(fmu: &Fmu) -> Vec<Message> {
    let instance = fmu.instantiate_as(&fmu.setup().at("http://host/50%25#1"));
    let r = fmu.variables[0].reference;
    instance.step(0.0, 0.01);
    instance.set_real(&[r], &[f64::NAN]);
    instance.set_integer(&[r], &[1]);
    instance.set_debug_logging(true, &["100%d #r1#\nof\r\neverything\t\u{1b}[0m"]);
    instance.deserialize(b"garbage").err();
    instance.initialize(0.0);
    instance.step(0.0, 0.01);
    instance.step(0.0, 0.01);
    instance.step(0.01, -1.0);
    instance.terminate();
    instance.messages()
}

#[test]
fn messages_are_finished_text_under_a_declared_category_and_the_instance_s_name() {
    for fmu in Fmu::all() {
        let log = a_talkative_life(&fmu);
        assert!(log.len() >= 10, "{log:?}");
        for message in log {
            assert_eq!(message.instance, fmu.name);
            assert!(
                fmu.log_categories.contains(&message.category),
                "{message:?}"
            );
            assert!(!message.text.is_empty(), "{message:?}");
            // `%` starts a printf directive, `#` a reference that importers expand, a line break a second message.
            let forbidden = |c: char| c == '%' || c == '#' || c.is_control();
            assert!(!message.text.contains(forbidden), "{message:?}");
            let expected = match message.category.as_str() {
                "logStatusError" => Status::ERROR,
                "logStatusWarning" => Status::WARNING,
                _ => Status::OK,
            };
            assert_eq!(message.status, expected, "{message:?}");
        }
    }
}

#[test]
fn logging_off_is_silence() {
    for fmu in Fmu::all() {
        let setup = fmu.setup().silent();
        let wrong = abi::Setup {
            guid: "wrong".into(),
            ..setup.clone()
        };
        let log = Instance::new(&fmu.library, &wrong)
            .err()
            .expect("a wrong guid is refused");
        assert_eq!(log, []);
        let instance = fmu.instantiate_as(&setup.at("http://host"));
        instance.initialize(0.0);
        assert_eq!(instance.step(0.0, f64::NAN), Status::ERROR);
        assert_eq!(instance.terminate(), Status::OK);
        assert_eq!(instance.messages(), []);
    }
}

/// Categories of the messages of a run with one refused call.
fn categories(instance: &Instance) -> Vec<String> {
    assert_eq!(instance.reset(), Status::OK);
    instance.messages();
    instance.initialize(0.0);
    assert_eq!(instance.step(0.0, 0.0), Status::ERROR);
    assert_eq!(instance.terminate(), Status::OK);
    let mut all: Vec<_> = instance
        .messages()
        .into_iter()
        .map(|m| m.category)
        .collect();
    all.sort();
    all.dedup();
    all
}

#[test]
fn each_category_is_switched_by_its_name_and_all_at_once() {
    for fmu in Fmu::all() {
        let instance = fmu.instantiate_as(&fmu.setup().silent());
        let (error, event) = ("logStatusError", "logEvents");
        for (on, names, expected) in [
            (true, &[error][..], &[error][..]),
            (true, &[event], &[event, error]),
            (false, &[error], &[event]),
            (true, &["logAll"], &[event, error]),
            (false, &[event, error], &[]),
            (true, &[], &[event, error]),
            (false, &[], &[]),
        ] {
            assert_eq!(instance.set_debug_logging(on, names), Status::OK);
            assert_eq!(categories(&instance), expected, "{on} {names:?}");
        }
    }
}

#[test]
fn an_unknown_category_is_refused_by_name_and_switches_nothing() {
    for fmu in Fmu::all() {
        let instance = Phase::Instantiated.enter(&fmu);
        assert_eq!(
            instance.set_debug_logging(false, &["logEvents", "logNothing"]),
            Status::ERROR
        );
        let text = instance.message();
        assert!(text.contains("'logNothing'"), "{text}");
        for category in &fmu.log_categories {
            assert!(
                text.contains(category.as_str()),
                "{category} is not offered: {text}"
            );
        }
        assert_eq!(categories(&instance), ["logEvents", "logStatusError"]);
    }
}

#[test]
fn a_run_says_well_under_one_message_a_step() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        let inputs: Vec<_> = fmu
            .variables
            .iter()
            .filter(|v| v.causality == "input" && v.kind == abi::Kind::Real {})
            .map(|v| v.reference)
            .collect();
        for k in 0..1000_u32 {
            // Large and changing: whatever a model reports (saturation, contact) it reports now.
            let value = 30.0 * (f64::from(k) * 0.05).sin();
            assert_eq!(
                instance.set_real(&inputs, &vec![value; inputs.len()]),
                Status::OK
            );
            assert_eq!(instance.step(f64::from(k) * 0.002, 0.002), Status::OK);
        }
        let log = instance.messages();
        assert!(log.len() < 100, "{} messages: {:?}", log.len(), &log[..10]);
    }
}
