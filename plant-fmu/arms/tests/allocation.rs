//! The step uses no heap.

use counting::{Counting, allocations};
use exoskeleton_arms::ExoskeletonArms;
use fmu_export::{Log, Model, Step};
use mechanics::arm::Inputs;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_allocates_nothing() {
    let side = |push: f64| Inputs {
        f_h: [20.0, 10.0, push],
        vacuum: true,
        ..Inputs::default()
    };
    let mut plant = ExoskeletonArms::default();
    plant.inputs.left = side(-150.0);
    plant.inputs.right = side(-130.0);
    plant.parameters.arm.table.z = -0.38;
    plant.parameters.arm.payload_m = 10.0;
    let mut log = Log::silent();
    plant.initialize(0.0, &mut log).unwrap();
    let (n, ()) = allocations(|| {
        for k in 0..1_000 {
            let step = Step::at(f64::from(k) * 0.001, 0.001);
            if plant.step(step, &mut log).is_err() {
                panic!("refused");
            }
        }
    });
    assert_eq!(n, 0);
    assert!(plant.outputs.attached && plant.outputs.lambda != [0.0; 3]); // landed, gripped, and coupled on the way
    let (n, _) = allocations(|| std::hint::black_box(Box::new(0)));
    assert_eq!(n, 1); // it does count
}
