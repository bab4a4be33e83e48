//! Whose memory strings are.

use abi::messages::owned;
use abi::{Fmu, Phase, Status};
use std::ptr::null;

#[test]
fn a_string_is_copied_by_set() {
    let fmu = Fmu::lag();
    let instance = Phase::Instantiated.enter(&fmu);
    let label = fmu.reference("label");
    let mut buffer = *b"first\0";
    let pointer = buffer.as_ptr().cast();
    // SAFETY: a null-terminated local, one element.
    let status = unsafe {
        (fmu.library.fmi2SetString)(
            instance.component(),
            &raw const label,
            1,
            &raw const pointer,
        )
    };
    assert_eq!(status, Status::OK);
    buffer.copy_from_slice(b"other\0");
    assert_eq!(instance.string(label), "first");
    assert_eq!(&buffer, b"other\0");
}

#[test]
fn strings_of_one_get_live_together_until_the_next_get() {
    let fmu = Fmu::lag();
    let instance = fmu.instantiate_as(&fmu.setup().at("file:///somewhere"));
    let references = fmu.references(["label", "resource_path", "label"]);
    assert_eq!(instance.set_string(references[0], "a label"), Status::OK);
    let mut values = [null(); 3];
    // SAFETY: three elements each.
    let status = unsafe {
        (fmu.library.fmi2GetString)(
            instance.component(),
            references.as_ptr(),
            3,
            values.as_mut_ptr(),
        )
    };
    assert_eq!(status, Status::OK);
    // Other calls in between do not touch them, and they are the importer's to read.
    instance.real(fmu.reference("y"));
    assert_eq!(instance.set_string(references[0], "another"), Status::OK);
    assert_eq!(values.map(owned), ["a label", "/somewhere", "a label"]);
    assert_eq!(instance.string(references[0]), "another");
}

#[test]
fn a_refused_get_leaves_the_importer_s_pointers_alone() {
    let fmu = Fmu::lag();
    let instance = Phase::Instantiated.enter(&fmu);
    let references = [fmu.reference("label"), fmu.reference("u")];
    let mut values = [null(); 2];
    // SAFETY: two elements each.
    let status = unsafe {
        (fmu.library.fmi2GetString)(
            instance.component(),
            references.as_ptr(),
            2,
            values.as_mut_ptr(),
        )
    };
    assert_eq!(status, Status::ERROR);
    assert!(values.iter().all(|pointer| pointer.is_null()));
}

#[test]
fn any_utf_8_comes_back_and_other_bytes_are_refused() {
    let fmu = Fmu::lag();
    let instance = Phase::Instantiated.enter(&fmu);
    let label = fmu.reference("label");
    for text in ["", " ", "ü{1} 100% #r\n", "日本語", &"long ".repeat(10_000)] {
        assert_eq!(instance.set_string(label, text), Status::OK);
        assert_eq!(instance.string(label), text);
    }
    let latin1 = c"\xfc".as_ptr();
    // SAFETY: a null-terminated constant, one element.
    let status = unsafe {
        (fmu.library.fmi2SetString)(instance.component(), &raw const label, 1, &raw const latin1)
    };
    assert_eq!(status, Status::ERROR);
    assert!(instance.message().contains("label is null or not UTF-8"));
}
