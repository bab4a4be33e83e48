//! The step uses no heap.

use exoskeleton_arms::{ExoskeletonArms, Side};
use export::{Log, Model, Step};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    /// Allocations of this thread: the test runner's own thread allocates when it likes.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn allocations() -> usize {
    ALLOCATIONS.get()
}

/// The system's allocator, counting.
struct Counting;

// SAFETY: every call is passed on unchanged to `System`, which keeps the contract of `GlobalAlloc`.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's contract is that of `System.alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, ptr: *mut u8, layout: Layout) {
        // SAFETY: `ptr` came from `alloc` above, that is from `System`, with this layout.
        unsafe { System.dealloc(ptr, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_allocates_nothing() {
    let side = |push: f64| Side {
        f_h: [20.0, 10.0, push],
        vacuum: true,
        ..Side::default()
    };
    let mut plant = ExoskeletonArms {
        left: side(-150.0),
        right: side(-130.0),
        ..ExoskeletonArms::default()
    };
    plant.parameters.table.position = -0.38;
    plant.parameters.payload_m = 10.0;
    let mut log = Log::silent();
    plant.initialize(0.0, &mut log).unwrap();
    let before = allocations();
    for k in 0..1_000 {
        let step = Step {
            start_time: 0.0,
            t: f64::from(k) * 0.001,
            h: 0.001,
        };
        if plant.step(step, &mut log).is_err() {
            panic!("refused");
        }
    }
    assert_eq!(allocations() - before, 0);
    assert!(plant.attached && plant.lambda != [0.0; 3]); // landed, gripped, and coupled on the way
    drop(std::hint::black_box(Box::new(0)));
    assert_eq!(allocations() - before, 1); // it does count
}
