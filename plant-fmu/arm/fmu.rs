//! The C interface of the exoskeleton arm, a shared library for importers.
#![allow(
    non_snake_case,
    reason = "the library is named like the model, as the FMI standard asks"
)]

fmu_export::export!(exoskeleton_arm::ExoskeletonArm);
