/* The ExoskeletonArm's step in plain C99: the arithmetic of plant-fmu/mechanics, written by hand, to measure the FMU by and to
 * check it. It is not generated from Rust and calls none of it.
 *
 * Configuration: drives that take torques, gears without loss of their own, ideal encoders, a force sensor in the base frame
 * without noise, hysteresis, tool and failure, no payload at the start. What runs then in each substep is here: drive lag, rigid body with or without
 * payload, friction that sticks, stops, table and wall with friction on each, the guess that is revised until it agrees with
 * its solution, the energy balance, gripping and losing the payload; and after a step every output and local. Where the pad
 * rubs on both surfaces at once, or no guess agrees with its solution, arm_plant_step says ARM_PLANT_ELSEWHERE. */
#ifndef ARM_PLANT_H
#define ARM_PLANT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arm_math.h"

enum { ARM_PLANT_OK, ARM_PLANT_ELSEWHERE };

/* Values under the FMU's names, arm_plant_parameter_names, in this order. */
struct arm_plant_parameters {
    double A1, L1, handle_x, handle_z, pad_x, pad_z;
    double m[3], x[3], z[3], I_xx[3], I_yy[3], I_zz[3], I_xz[3], rotor[3], gear[3], gravity[3];
    double F_c[3], F_s[3], v_s[3], b[3], stop_min[3], stop_max[3], cutoff, payload_m, F_max, F_attach, F_shear;
    double surface[2], k[2], c[2], mu[2], q_start[3], dq_start[3], ft_bias[3], ft_drift[3], ft_range, ft_T, substep;
};

struct arm_plant_inputs {
    double tau_a[3], f_h[3], f_d[3];
    int32_t vacuum;
};

/* Reals under arm_plant_real_names, Booleans under arm_plant_boolean_names, in this order. */
struct arm_plant_outputs {
    double q[3], dq[3], p[3], dp[3], f_e[3], tau_applied[3], tau_f[3], q_joint[3], p_pad[3], tension, shear, tau_drive[3];
    double kinetic, potential, surface, work_tau, work_f_h, work_f_d, payload, loss_friction, loss_viscous, loss_stop;
    double loss_surface, loss_rub, loss_impact, loss_grip, loss_step, residual, f_h_measured[3];
    double M[9], C_dq[3], g[3];
    int32_t attached, contact;
};

struct arm_point {
    double p[3], J[3][3];
};

struct arm_body {
    double M[3][3], g[3], potential, D_2, D_3, H;
};

/* What one substep moved. */
struct arm_flow {
    double of[12];
};

struct arm_sum {
    double head, rest;
};

enum motion { HELD, FORWARD, BACKWARD, HIGH, LOW };

struct arm_plant {
    struct arm_plant_parameters with;
    double q[3], dq[3], tau[3], s[2];
    bool attached;
    struct sin_cos yaw, shoulder, elbow, pitch;
    struct arm_point handle, pad;
    struct arm_body body;
    enum motion guess[3];
    bool pushes[2];
    double f_e[3], tau_f[3], hold[3];
    bool contact;
    double E_0;
    struct arm_sum sums[12];
    uint64_t samples;
};

extern const char *const arm_plant_parameter_names[];
extern const char *const arm_plant_real_names[];
extern const char *const arm_plant_boolean_names[];

void arm_plant_start(struct arm_plant *arm, const struct arm_plant_parameters *with);
/* A step of h (s), in equal substeps no longer than `substep`. */
int arm_plant_step(struct arm_plant *arm, const struct arm_plant_inputs *in, double h, struct arm_plant_outputs *out);

#endif
