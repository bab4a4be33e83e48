/* The ArmController's cycle in plain C99: the arithmetic of fmu/arm-law and fmu/admittance, written by hand, to measure the
 * FMU by and to check it. It is not generated from Rust and calls none of it.
 *
 * Configuration: law 4 (passive_bounded) in task space, torque form, on its own (supervision off), a force in the base frame
 * (ft.source 1, ft.frame 1), ticks in time. What runs then at each tick is here: encoder checks, sensor checks, workspace with
 * its edges, singularity, torque limits, ledger, tank with settling and share, the check of all results, every output that
 * changes. What is off at the start values is not: tuning, low passes, tool, tare, deadband, stiff-hand detector, delay,
 * rate limit, box. Where a tick needs one of them, or an encoder is in doubt, arm_law_tick says ARM_LAW_ELSEWHERE. */
#ifndef ARM_LAW_H
#define ARM_LAW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ARM_LAW_OK, ARM_LAW_NOT_FINITE, ARM_LAW_ELSEWHERE };

/* Values under the FMU's names, arm_law_parameter_names, in this order. */
struct arm_law_parameters {
    double Lambda_n[3], D_n[3], K[3], K_P[3], f_max[3], tau_max[3], alpha, T, E_0, dq_max[3], ddq_max[3];
    double A1, L1, handle_x, handle_z, encoder_range[3], ft_handle[3], recovery_time;
    double limited, q_min[3], q_max[3], radius_min, slowing_time, sigma_slow, D;
};

struct arm_law_inputs {
    double q[3], f_h[3];
    int32_t engage, hold, ft_valid, encoder_valid, ft_tare;
};

/* Reals under arm_law_real_names, whole numbers under arm_law_integer_names, in this order. */
struct arm_law_outputs {
    double tau_a[3], p[3], p_n[3], dp_n[3], e_nr[3], f_a[3], sigma_min, H, G, tank, dp[3], tau_demand[3], share;
    double ft_f_h[3], ft_moment[3], ft_bias_force[3], ft_bias_torque[3], authority, q_n[3];
    int32_t saturated, engaged, outside_bounds, slowed, held, debt, ft_fault, state, encoder_fault, timing;
};

/* One axis between two ticks, with what follows from its gains. */
struct arm_law_axis {
    double D_n, K, K_P, f_max, k, half_k, e_max, half_M, M_2, M_2T, KPT, lead, c, port, exchange;
    double q, dq, q_n, v_n;
};

struct arm_law {
    struct arm_law_parameters with;
    struct arm_law_axis axes[3];
    double step_max[3], change_max[3], encoder_step[3], encoder_change[3];
    double middle[3], wide[3], samples, radius, arm;
    double told[3], before[3];
    bool is_told, engaged;
    int32_t ft_fault;
    double ft_sound;
    /* the ledger */
    double H, G, tank, rounding, q[3], step[3], acting[3], supplied, exchanged;
    bool has_q, has_step, outside;
};

extern const char *const arm_law_parameter_names[];
extern const char *const arm_law_real_names[];
extern const char *const arm_law_integer_names[];

void arm_law_start(struct arm_law *law, const struct arm_law_parameters *with);
int arm_law_tick(struct arm_law *law, const struct arm_law_inputs *in, struct arm_law_outputs *out);

#endif
