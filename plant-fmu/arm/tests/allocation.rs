//! The step uses no heap.

use counting::{Counting, allocations};
use exoskeleton_arm::ExoskeletonArm;
use fmu_export::{Log, Model, Step};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_allocates_nothing() {
    let mut plant = ExoskeletonArm::default();
    plant.inputs.f_h = [20.0, 10.0, -150.0];
    plant.inputs.vacuum = true;
    plant.parameters.table.z = -0.38;
    plant.parameters.payload_m = 5.0;
    plant.ft.noise = 0.1;
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
    assert!(plant.outputs.attached && plant.outputs.energy.loss_surface > 0.0); // landed and gripped on the way
    let (n, _) = allocations(|| std::hint::black_box(Box::new(0)));
    assert_eq!(n, 1); // it does count
}
