//! The step uses no heap.

use counting::{Counting, allocations};
use fmu_export::{Log, Model, Step};
use human_operator::HumanOperator;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_allocates_nothing() {
    let mut human = HumanOperator {
        k_h: 300.0,
        delay: 0.1,
        ..HumanOperator::default()
    };
    human.segments[0].amplitude = 5.0;
    human.target.kind = 2;
    human.target.amplitude = [0.1; 3];
    let mut log = Log::silent();
    human.initialize(0.0, &mut log).unwrap();
    let (n, ()) = allocations(|| {
        for k in 0..1_000 {
            let step = Step::at(f64::from(k) * 0.001, 0.001);
            human.inputs.p[0] = 0.01 * step.t;
            if human.step(step, &mut log).is_err() {
                panic!("refused");
            }
        }
    });
    assert_eq!(n, 0);
    assert!(human.outputs.f_h[0].abs() > 0.0);
    let (n, _) = allocations(|| std::hint::black_box(Box::new(0)));
    assert_eq!(n, 1); // it does count
}
