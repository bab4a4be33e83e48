//! Importers read after they have set and before they step.

use abi::{Fmu, Kind, Phase, Status};

#[test]
fn a_reading_after_a_set_computes_no_tick() {
    for fmu in Fmu::all() {
        let instance = Phase::StepComplete.enter(&fmu);
        let reals = |causality: &str| -> Vec<u32> {
            let of = |v: &&abi::Variable| v.causality == causality && v.kind == (Kind::Real {});
            fmu.variables
                .iter()
                .filter(of)
                .map(|v| v.reference)
                .collect()
        };
        let (inputs, outputs) = (reals("input"), reals("output"));
        for k in 0..5_u32 {
            let values = vec![0.1 * f64::from(k + 1); inputs.len()];
            let before = instance.get_real(&outputs).expect("outputs");
            assert_eq!(instance.set_real(&inputs, &values), Status::OK);
            let set = instance.bytes();
            for _ in 0..3 {
                // NaN, as a failed sensor shows it, is not equal to itself.
                let bits =
                    |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
                let after = instance.get_real(&outputs).expect("outputs");
                assert_eq!(bits(after), bits(before.clone()), "{} step {k}", fmu.name);
                assert_eq!(
                    instance.get_real(&inputs),
                    Ok(values.clone()),
                    "{}",
                    fmu.name
                );
            }
            assert!(
                instance.bytes() == set,
                "{} step {k}: reading changed something",
                fmu.name
            );
            let (t, h) = (f64::from(k) * fmu.step_size, fmu.step_size);
            assert_eq!(instance.step(t, h), Status::OK);
            assert!(
                instance.bytes() != set,
                "{}: the step does nothing",
                fmu.name
            );
        }
    }
}
