//! fmi2Instantiate: what is refused with null, and what is not.

use abi::messages::{Messages, logger};
use abi::types::*;
use abi::{Fmu, Message, Phase, Status};
use std::ffi::{CStr, c_int};
use std::ptr::null;

/// Raw arguments, all of which may be wrong.
struct Arguments<'a> {
    name: Option<&'a CStr>,
    kind: c_int,
    guid: Option<&'a CStr>,
}

/// Whether an instance came (it is freed again), and what was logged.
fn instantiate(fmu: &Fmu, arguments: &Arguments<'_>) -> (bool, Vec<Message>) {
    let messages = Messages::default();
    let callbacks = Callbacks {
        logger: Some(logger),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        environment: (&raw const messages).cast_mut().cast(),
    };
    let pointer = |text: Option<&CStr>| text.map_or(null(), CStr::as_ptr);
    // SAFETY: every pointer is null or to something that outlives the instance, which is freed here.
    let came = unsafe {
        let component = (fmu.library.fmi2Instantiate)(
            pointer(arguments.name),
            arguments.kind,
            pointer(arguments.guid),
            null(),
            &raw const callbacks,
            0,
            1,
        );
        (fmu.library.fmi2FreeInstance)(component);
        !component.is_null()
    };
    (came, messages.take())
}

#[test]
fn a_wrong_guid_name_or_type_gives_null_and_one_message_that_says_what_was_expected() {
    for fmu in Fmu::all() {
        let guid = std::ffi::CString::new(fmu.guid.clone()).expect("no null byte");
        let good = || Arguments {
            name: Some(c"name"),
            kind: CO_SIMULATION,
            guid: Some(&guid),
        };
        assert!(instantiate(&fmu, &good()).0);
        let own = fmu.guid.as_str();
        let not_utf8 = c"\xff\xfe";
        for (arguments, parts) in [
            (
                Arguments {
                    guid: Some(c"{wrong}"),
                    ..good()
                },
                ["fmuGUID = {wrong}", own],
            ),
            (
                Arguments {
                    guid: Some(c""),
                    ..good()
                },
                ["fmuGUID = ", own],
            ),
            (
                Arguments {
                    guid: None,
                    ..good()
                },
                ["fmuGUID", own],
            ),
            (
                Arguments {
                    guid: Some(not_utf8),
                    ..good()
                },
                ["fmuGUID", own],
            ),
            (
                Arguments {
                    name: None,
                    ..good()
                },
                ["instanceName", "expected a name"],
            ),
            (
                Arguments {
                    name: Some(c""),
                    ..good()
                },
                ["instanceName", "expected a name"],
            ),
            (
                Arguments {
                    name: Some(not_utf8),
                    ..good()
                },
                ["instanceName", "expected a name"],
            ),
            (
                Arguments { kind: 0, ..good() },
                ["fmuType = 0", "fmi2CoSimulation (1)"],
            ),
            (
                Arguments { kind: -7, ..good() },
                ["fmuType = -7", "fmi2CoSimulation (1)"],
            ),
        ] {
            let (came, log) = instantiate(&fmu, &arguments);
            assert!(!came, "{parts:?}");
            let [message] = &log[..] else {
                panic!("expected one message, got {log:?}")
            };
            assert_eq!(
                (message.category.as_str(), message.status),
                ("logStatusError", Status::ERROR)
            );
            assert!(message.text.starts_with("fmi2Instantiate: "), "{message:?}");
            for part in parts {
                assert!(message.text.contains(part), "{part} is not in {message:?}");
            }
            assert!(
                !message.instance.is_empty(),
                "printf with a null name crashes some importers"
            );
        }
    }
}

#[test]
fn without_callbacks_there_is_no_instance_and_no_crash() {
    for fmu in Fmu::all() {
        let guid = std::ffi::CString::new(fmu.guid.clone()).expect("no null byte");
        // SAFETY: null callbacks are what is tested; the strings outlive the call.
        let component = unsafe {
            (fmu.library.fmi2Instantiate)(
                c"name".as_ptr(),
                CO_SIMULATION,
                guid.as_ptr(),
                null(),
                null(),
                0,
                1,
            )
        };
        assert!(component.is_null());
    }
}

#[test]
fn without_a_logger_everything_works_silently() {
    for fmu in Fmu::all() {
        let instance = fmu.instantiate_as(&abi::Setup {
            logger: false,
            ..fmu.setup()
        });
        assert_eq!(
            instance.step(0.0, 0.01),
            Status::ERROR,
            "not initialized: refused without a word"
        );
        instance.initialize(0.0);
        assert_eq!(instance.step(0.0, 0.01), Status::OK);
    }
}

#[test]
fn two_instances_of_one_name_are_two() {
    let fmu = Fmu::lag();
    let (a, b) = (
        Phase::StepComplete.enter(&fmu),
        Phase::StepComplete.enter(&fmu),
    );
    assert_eq!(a.set_real(&[fmu.reference("u")], &[1.0]), Status::OK);
    assert_eq!(
        (a.step(0.0, 0.1), b.step(0.0, 0.1)),
        (Status::OK, Status::OK)
    );
    assert!(a.real(fmu.reference("y")) > 0.0);
    assert_eq!(b.real(fmu.reference("y")), 0.0);
}
