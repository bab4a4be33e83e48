//! What the committed descriptions say of whole models.

use abi::{Fmu, Kind};

#[test]
fn a_sampled_controller_is_discrete_and_its_step_size_is_its_period() {
    for name in ["TestbedController", "ArmController"] {
        let fmu = Fmu::open(name);
        let variables = fmu.committed_variables();
        for v in &variables {
            if ["input", "output"].contains(&v.causality.as_str()) {
                assert_eq!(v.variability, "discrete", "{name} {}", v.name);
            }
        }
        let period = fmu.variable("T").start.as_deref();
        let period: Option<f64> = period.and_then(|text| text.parse().ok());
        assert_eq!(period, Some(fmu.step_size), "{name}");
    }
}

#[test]
fn the_library_starts_with_the_start_values_of_the_description() {
    for fmu in Fmu::products() {
        let instance = fmu.instantiate();
        for v in fmu.committed_variables() {
            let (Some(start), r) = (v.start.as_deref(), v.reference) else {
                continue;
            };
            let same = match v.kind {
                Kind::Real {} => start.parse() == Ok(instance.real(r)),
                Kind::Integer {} | Kind::Enumeration {} => start.parse() == Ok(instance.integer(r)),
                Kind::Boolean {} => start == ["false", "true"][instance.boolean(r) as usize],
                Kind::String {} => start == instance.string(r),
            };
            assert!(
                same,
                "{} {} starts otherwise than with {start}",
                fmu.name, v.name
            );
        }
    }
}
