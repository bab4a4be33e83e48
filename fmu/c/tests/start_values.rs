//! The start values are those of the FMUs.

#![allow(non_snake_case, reason = "FMU in names of tests")]

use arm_controller::ArmController;
use exo_law::arm::parameters::ArmParameters;
use exo_law::axis::AxisParameters;
use testbed_controller::TestbedController;

/// Asserts that fields of the library equal those of the FMU.
macro_rules! equal {
    ($library:ident, $fmu:ident: $($($of:ident).+ = $($from:ident).+),+ $(,)?) => {
        $(assert_eq!($library.$($of).+, $fmu.$($from).+, stringify!($($from).+));)+
    };
}

#[test]
fn the_arm_starts_with_the_values_of_its_FMU() {
    let (library, fmu) = (ArmParameters::default(), ArmController::default());
    equal!(library, fmu:
        law = law,
        delay = delay,
        torque_limiting = torque_limiting,
        gains.Lambda_n = Lambda_n,
        gains.D_n = D_n,
        gains.K = K,
        gains.K_P = K_P,
        gains.f_max = f_max,
        alpha = alpha,
        T = T,
        tau_max = tau_max,
        tau_rate_max = tau_rate_max,
        dq_max = dq_max,
        ddq_max = ddq_max,
        dp_cutoff = dp_cutoff,
        E_0 = energy.E_0,
        tuning_time = tuning_time,
        dp_n_max = dp_n_max,
        p_n_min = p_n_min,
        p_n_max = p_n_max,
        kinematics.A1 = kinematics.A1,
        kinematics.L1 = kinematics.L1,
        kinematics.handle_x = kinematics.handle_x,
        kinematics.handle_z = kinematics.handle_z,
        singularity.sigma_slow = singularity.sigma_slow,
        singularity.D = singularity.D,
        stiff_hand.D_max = stiff_hand.D_max,
        stiff_hand.f_low = stiff_hand.f_low,
        stiff_hand.f_high = stiff_hand.f_high,
        stiff_hand.f_min = stiff_hand.f_min,
        stiff_hand.growth = stiff_hand.growth,
        stiff_hand.attack = stiff_hand.attack,
        stiff_hand.quiet = stiff_hand.quiet,
        stiff_hand.release = stiff_hand.release,
        ft.source = ft.source,
        ft.frame = ft.frame,
        ft.stuck_samples = ft.stuck_samples,
        ft.dropout_samples = ft.dropout_samples,
        ft.mount = ft.mount,
        ft.handle = ft.handle,
        ft.mass = ft.mass,
        ft.cog = ft.cog,
        ft.gravity = ft.gravity,
        ft.deadband = ft.deadband,
        ft.cutoff = ft.cutoff,
        ft.range_force = ft.range_force,
        ft.range_torque = ft.range_torque,
        ft.rate_force = ft.rate_force,
        ft.rate_torque = ft.rate_torque,
        ft.recovery_time = ft.recovery_time,
        ft.tare_time = ft.tare_time,
        ft.tare_motion = ft.tare_motion,
        ft.tare_spread_force = ft.tare_spread_force,
        ft.tare_spread_torque = ft.tare_spread_torque,
        ft.tare_max_force = ft.tare_max_force,
        ft.tare_max_torque = ft.tare_max_torque,
        supervision.init_time = init_time,
        supervision.engage_time = engage_time,
        supervision.soft_stop_time = soft_stop_time,
        supervision.heartbeat_timeout = heartbeat_timeout,
        supervision.hold_enter = hold_enter,
        supervision.hold_leave = hold_leave,
        supervision.hold_time = hold_time,
        supervision.hold_brake = hold_brake,
        supervision.saturation_time = saturation_time,
        space = space,
        joint_gains.D_n = joint.D_n,
        joint_gains.K = joint.K,
        joint_gains.K_P = joint.K_P,
        joint.dq_n_max = joint.dq_n_max,
        joint.q_n_min = joint.q_n_min,
        joint.q_n_max = joint.q_n_max,
        nominal.m = nominal.m,
        nominal.x = nominal.x,
        nominal.z = nominal.z,
        nominal.I_xx = nominal.I_xx,
        nominal.I_yy = nominal.I_yy,
        nominal.I_zz = nominal.I_zz,
        nominal.I_xz = nominal.I_xz,
        nominal.rotor = nominal.rotor,
    );
    let choices = [
        (library.p_n_box, fmu.p_n_box),
        (library.stiff_hand.active, fmu.stiff_hand.active),
        (library.supervision.supervision, fmu.supervision),
        (library.joint.q_n_box, fmu.joint.q_n_box),
    ];
    for (ours, theirs) in choices {
        assert_eq!(ours, i32::from(theirs));
    }
}

#[test]
fn one_axis_starts_with_the_values_of_its_FMU() {
    let (library, fmu) = (AxisParameters::default(), TestbedController::default());
    equal!(library, fmu:
        law = law,
        delay = delay,
        gains.M_n = M_n,
        gains.D_n = D_n,
        gains.K = K,
        gains.K_P = K_P,
        gains.tau_max = tau_max,
        alpha = alpha,
        T = T,
        v_max = v_max,
        a_max = a_max,
        dq_cutoff = dq_cutoff,
        E_0 = energy.E_0,
        tuning_time = tuning_time,
        dq_n_max = dq_n_max,
        q_n_min = q_n_min,
        q_n_max = q_n_max,
        tau_rate_max = tau_rate_max,
    );
    assert_eq!(library.q_n_box, i32::from(fmu.q_n_box));
}
