//! Instances and states do not leak: no memory, no file, no thread. Alone in its file: the process's memory is what is measured.
#![cfg(target_os = "linux")]

use abi::{Fmu, Status};

/// Resident memory in bytes.
fn resident() -> usize {
    let statm = std::fs::read_to_string("/proc/self/statm").expect("Linux");
    let pages: usize = statm
        .split_whitespace()
        .nth(1)
        .and_then(|field| field.parse().ok())
        .expect("the second field is the resident size in pages");
    pages * 4096
}

/// Open files, sockets and the like.
fn open_files() -> usize {
    std::fs::read_dir("/proc/self/fd").expect("Linux").count()
}

/// Threads of the process.
fn threads() -> usize {
    std::fs::read_dir("/proc/self/task").expect("Linux").count()
}

/// A whole life, with everything that allocates.
fn life(fmu: &Fmu) {
    let instance = fmu.instantiate_as(&fmu.setup().at("file:///resources"));
    instance.initialize(0.0);
    let mut state = instance.state();
    for k in 0..10 {
        assert_eq!(instance.step(f64::from(k) * 0.002, 0.002), Status::OK);
    }
    assert_eq!(instance.step(0.0, f64::NAN), Status::ERROR);
    assert!(instance.deserialize(b"bad").is_err());
    let bytes = instance.serialize(state);
    let mut copy = instance.deserialize(&bytes).expect("our own bytes");
    assert_eq!(instance.set_state(copy), Status::OK);
    assert_eq!(instance.free_state(&mut copy), Status::OK);
    assert_eq!(instance.free_state(&mut state), Status::OK);
    if fmu.name == "Lag" {
        instance.string(fmu.reference("label"));
    }
}

#[test]
fn a_thousand_lives_do_not_grow_the_process() {
    for fmu in Fmu::all() {
        (0..200).for_each(|_| life(&fmu)); // warm: allocator arenas, lazily bound symbols
        let (before, others) = (resident(), (open_files(), threads()));
        (0..1000).for_each(|_| life(&fmu));
        let grown = resident().saturating_sub(before);
        // The smallest possible leak, one string or state of 64 bytes a life, would be 64 kB; an instance is ten times
        // that. Half of it is what the allocator may move around.
        assert!(grown < 32 << 10, "{} grew by {grown} bytes", fmu.name);
        assert_eq!((open_files(), threads()), others, "{}", fmu.name);
    }
}
