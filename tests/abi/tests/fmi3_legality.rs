//! FMI 3.0: which call is legal in which state, tried cell by cell on every FMU, and how instances are made.

use abi::fmi3::calls::call;
use abi::fmi3::standard::{State, Verdict, rows, verdict};
use abi::fmi3::{Fmu, Instance, Interface, Row, Setup, Type, Value};
use abi::{Phase, Status};
use std::ptr::{null, null_mut};

/// A new instance in this state, with an empty log; `None` for a state that the FMU has not.
fn enter(fmu: &Fmu, state: State) -> Option<Instance> {
    let scheduled = state == State::ClockActivationMode;
    if scheduled && !["TestbedController", "ArmController"].contains(&fmu.name()) {
        return None;
    }
    let instance = fmu.instantiate_as(match scheduled {
        true => Interface::ScheduledExecution,
        false => Interface::CoSimulation,
    });
    match state {
        State::Instantiated => {}
        State::InitializationMode => {
            assert_eq!(instance.enter_initialization_mode(0.0, None), Status::OK);
        }
        State::StepMode | State::ClockActivationMode => instance.initialize(0.0),
        State::Terminated => {
            instance.initialize(0.0);
            assert_eq!(instance.terminate(), Status::OK);
        }
        State::Failed => {
            let broken = Phase::Error.enter(&fmu.fmi2).bytes();
            assert_eq!(instance.restore(&broken), Status::OK);
        }
    }
    instance.messages();
    Some(instance)
}

/// What an accepted call of these leaves is not what was before.
const CHANGE: [&str; 7] = [
    "fmi3EnterInitializationMode",
    "fmi3ExitInitializationMode",
    "fmi3Terminate",
    "fmi3Reset",
    "fmi3DoStep",
    "fmi3ActivateModelPartition",
    "fmi3Set",
];

#[test]
fn every_function_in_every_state_does_what_the_standard_says_and_the_instance_goes_on() {
    let every_type = std::iter::once(Fmu::every_type());
    for fmu in Fmu::all().into_iter().chain(every_type) {
        for (function, _) in rows() {
            if function == "fmi3FreeInstance" {
                continue;
            }
            for state in State::ALL {
                let Some(instance) = enter(&fmu, state) else {
                    continue;
                };
                let cell = format!("{} {function} in {state:?}", fmu.name());
                let before = instance.bytes();
                let clocks = usize::from(state == State::ClockActivationMode);
                let status = call(function, &fmu, &instance, clocks);
                let log = instance.messages();
                match verdict(function, state) {
                    Verdict::Accepted => {
                        assert_eq!(status, Status::OK, "{cell}: {log:?}");
                        let told = log.iter().any(|m| m.category == "logStatusError");
                        assert!(!told, "{cell}: {log:?}");
                        // Initial values are computed when they are asked for.
                        let computes =
                            state == State::InitializationMode && function.starts_with("fmi3Get");
                        let changes = CHANGE.iter().any(|change| function.starts_with(change));
                        if !changes && !computes {
                            assert_eq!(instance.bytes(), before, "{cell}");
                        }
                    }
                    Verdict::Refused(reason) => {
                        assert_eq!(status, Status::ERROR, "{cell}");
                        let [message] = &log[..] else {
                            panic!("{cell}: expected one message, got {log:?}")
                        };
                        assert!(
                            message.text.starts_with(&format!("{function}: ")),
                            "{message:?}"
                        );
                        assert!(message.text.contains(reason), "{cell}: {message:?}");
                        assert_eq!(message.category, "logStatusError", "{cell}");
                        assert_eq!(instance.bytes(), before, "{cell}");
                    }
                }
                // Whatever came before, a reset leads to a run.
                assert_eq!(instance.reset(), Status::OK, "{cell}");
                instance.initialize(0.0);
                let step = match clocks {
                    0 => instance.step(0.0, fmu.fmi2.step_size),
                    _ => instance.activate(0.0),
                };
                assert_eq!(step, Status::OK, "{cell}: {:?}", instance.messages());
            }
        }
    }
}

#[test]
fn a_refused_call_is_told_even_with_logging_off() {
    let fmu = Fmu::new(abi::Fmu::lag());
    let silent = Setup {
        logging: false,
        ..fmu.setup()
    };
    let instance = Instance::new(&fmu.library, &silent).expect("instantiated");
    instance.initialize(0.0);
    assert_eq!(instance.messages(), [], "life cycle with logging off");
    assert_eq!(instance.exit_initialization_mode(), Status::ERROR);
    assert!(
        instance
            .message()
            .starts_with("fmi3ExitInitializationMode: not legal")
    );
}

#[test]
fn without_an_instance_every_call_is_an_error_and_free_does_nothing() {
    let fmu = Fmu::new(abi::Fmu::open("TestbedController"));
    let (l, c) = (&fmu.library, null_mut());
    let (mut flags, mut last) = ([7; 3], 0.0);
    let flag = flags.as_mut_ptr();
    // SAFETY: null is what these are asked about; the other pointers are to locals.
    unsafe {
        (l.fmi3FreeInstance)(c);
        let step = (l.fmi3DoStep)(
            c,
            0.0,
            0.1,
            1,
            flag,
            flag.add(1),
            flag.add(2),
            &raw mut last,
        );
        assert_eq!(step, Status::ERROR);
        assert_eq!(
            (l.fmi3ActivateModelPartition)(c, 0xFFFF_FFFE, 0.0),
            Status::ERROR
        );
        assert_eq!(
            (l.fmi3GetFloat64)(c, null(), 0, null_mut(), 0),
            Status::ERROR
        );
        assert_eq!((l.fmi3SetTime)(c, 0.0), Status::ERROR);
        assert_eq!((l.fmi3Reset)(c), Status::ERROR);
    }
    assert_eq!(flags, [7; 3], "nothing is written");
}

#[test]
fn an_instance_is_refused_with_one_message_that_says_why() {
    let fmu = Fmu::new(abi::Fmu::open("Testbed"));
    let good = fmu.setup();
    let of = |interface| Setup {
        interface,
        ..good.clone()
    };
    let cases = [
        (of(Interface::ModelExchange), "no Model Exchange"),
        (of(Interface::ScheduledExecution), "no sample period"),
        (
            Setup {
                event_mode: true,
                ..good.clone()
            },
            "eventModeUsed is true, expected false",
        ),
        (
            Setup {
                intermediate: vec![0],
                ..good.clone()
            },
            "nRequiredIntermediateVariables = 1, expected 0",
        ),
        (
            Setup {
                token: "{another}".into(),
                ..good.clone()
            },
            "instantiationToken = {another}, expected {",
        ),
        (
            Setup {
                name: " ".into(),
                ..good.clone()
            },
            "instanceName is null, blank",
        ),
    ];
    for (setup, reason) in cases {
        for logging in [true, false] {
            let setup = Setup {
                logging,
                ..setup.clone()
            };
            let log = Instance::new(&fmu.library, &setup).err().expect(reason);
            assert_eq!(log.len(), 1, "{reason}: {log:?}");
            assert!(log[0].text.contains(reason), "{log:?}");
            assert_eq!(log[0].status, Status::ERROR);
            let mute = Setup {
                logger: false,
                ..setup
            };
            assert!(Instance::new(&fmu.library, &mute).is_err(), "{reason}");
        }
    }
}

#[test]
fn a_resource_path_is_a_path_and_no_uri() {
    let fmu = Fmu::new(abi::Fmu::lag());
    let path = Row {
        ..fmu.row("resource_path").clone()
    };
    assert_eq!(path.kind, Type::Text);
    for (given, seen, told) in [
        (Some("/a b%20/ü/resources/"), "/a b%20/ü/resources", 0),
        (Some("/plain"), "/plain", 0),
        (Some("file:///plain"), "", 1),
        (None, "", 0),
    ] {
        let setup = Setup {
            resources: given.map(Into::into),
            ..fmu.setup()
        };
        let instance = Instance::new(&fmu.library, &setup).expect("instantiated");
        assert_eq!(instance.read(&path), Ok(vec![Value::Text(seen.into())]));
        assert_eq!(instance.messages().len(), told, "{given:?}");
    }
}

#[test]
fn a_variable_is_set_as_its_causality_and_variability_allow_in_every_state() {
    let every_type = std::iter::once(Fmu::every_type());
    for fmu in Fmu::all().into_iter().chain(every_type) {
        for state in State::ALL {
            let Some(instance) = enter(&fmu, state) else {
                continue;
            };
            for row in fmu.rows.iter().filter(|row| row.name != "panic") {
                let cell = format!("{} {} in {state:?}", fmu.name(), row.name);
                let values = instance.read(row);
                let values = values.unwrap_or_else(|_| panic!("{cell}: {:?}", instance.messages()));
                let before = instance.bytes();
                let status = instance.write(row, &values);
                let early = [State::Instantiated, State::InitializationMode].contains(&state);
                let running = [State::StepMode, State::ClockActivationMode].contains(&state);
                let settable = match (row.causality(), row.variability()) {
                    ("input", _) | ("parameter", "tunable") => early || running,
                    ("parameter", _) => early,
                    _ => false,
                };
                let expected = if settable { Status::OK } else { Status::ERROR };
                let log = instance.messages();
                assert_eq!(status, expected, "{cell}: {log:?}");
                assert_eq!(instance.bytes(), before, "{cell}: the values were its own");
                assert_eq!(log.len(), usize::from(!settable), "{cell}: {log:?}");
            }
        }
    }
}
