//! The step uses no heap.

use export::{Log, Model, Step};
use human_operator::HumanOperator;
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
    let mut human = HumanOperator {
        k_h: 300.0,
        delay: 0.1,
        ..HumanOperator::default()
    };
    human.segment.amplitude[0] = 5.0;
    let mut log = Log::silent();
    human.initialize(0.0, &mut log).unwrap();
    let before = allocations();
    for k in 0..1_000 {
        let step = Step {
            start_time: 0.0,
            t: f64::from(k) * 0.001,
            h: 0.001,
        };
        human.p[0] = 0.01 * step.t;
        if human.step(step, &mut log).is_err() {
            panic!("refused");
        }
    }
    assert_eq!(allocations() - before, 0);
    assert!(human.f_h[0].abs() > 0.0);
    drop(std::hint::black_box(Box::new(0)));
    assert_eq!(allocations() - before, 1); // it does count
}
