//! An interface as bytes, from a library to who packs it.

mod subject;

use fmu_archive::hand_over::{self, Refused};
use fmu_archive::{Guide, Interface, Standard, VERSION, document, header, xml};
use subject::{PACKAGE, Subject};

fn interface() -> Interface {
    Interface::of::<Subject>().expect("a legal declaration")
}

#[test]
fn what_is_written_from_an_interface_that_was_handed_over_is_what_is_written_from_the_declaration()
{
    let interface = interface();
    let read = hand_over::read(hand_over::bytes(Ok(&interface))).expect("our own bytes");
    assert_eq!(xml(&read, PACKAGE), xml(&interface, PACKAGE));
    assert_eq!(
        header(&read, Standard::Fmi2),
        header(&interface, Standard::Fmi2)
    );
    let page = |of| document(of, PACKAGE, Guide::default(), Standard::Fmi2);
    assert_eq!(page(&read), page(&interface));
}

#[test]
fn another_version_is_told_by_name_before_anything_is_read() {
    let mut bytes = hand_over::bytes(Ok(&interface()));
    let at = bytes
        .windows(VERSION.len())
        .position(|part| part == VERSION.as_bytes())
        .expect("the version");
    bytes[at] = b'9';
    // What follows the version may be anything then.
    bytes.truncate(at + VERSION.len());
    let message = hand_over::read(bytes).unwrap_err().to_string();
    let theirs = format!("9{}", &VERSION[1..]);
    assert!(
        message.contains(&format!("fmu-export {theirs}, expected {VERSION}")),
        "{message}"
    );
}

#[test]
fn cut_and_foreign_bytes_are_refused() {
    let bytes = hand_over::bytes(Ok(&interface()));
    for length in [0, 5, 30, bytes.len() - 1] {
        let cut = hand_over::read(bytes[..length].to_vec());
        assert!(matches!(cut, Err(Refused::Foreign(_))), "{length} bytes");
    }
    let foreign = hand_over::read(b"\x03abc\x051.2.3".to_vec());
    assert!(matches!(foreign, Err(Refused::Foreign(text)) if text.contains("abc")));
}

#[test]
fn a_rule_that_the_declaration_breaks_is_handed_over_in_words() {
    let error = fmu_archive::Error::ModelName("my-plant");
    let message = hand_over::read(hand_over::bytes(Err(&error)))
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("model name \"my-plant\": expected a C identifier"),
        "{message}"
    );
    let message = hand_over::read(hand_over::refusal("no start".to_owned())).unwrap_err();
    assert_eq!(message.to_string(), "no start");
}
