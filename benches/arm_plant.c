#include "arm_plant.h"
#include "arm_solve.h"

#define OF_THREE(name) name "[1]", name "[2]", name "[3]"

const char *const arm_plant_parameter_names[] = {
    "A1", "L1", "handle.x", "handle.z", "pad.x", "pad.z", OF_THREE("link.m"), OF_THREE("link.x"), OF_THREE("link.z"),
    OF_THREE("link.I_xx"), OF_THREE("link.I_yy"), OF_THREE("link.I_zz"), OF_THREE("link.I_xz"), OF_THREE("rotor.I"),
    OF_THREE("gear"), OF_THREE("gravity"), OF_THREE("friction.F_c"), OF_THREE("friction.F_s"), OF_THREE("friction.v_s"),
    OF_THREE("friction.b"), OF_THREE("stop.min"), OF_THREE("stop.max"), "drive.cutoff", "payload.m", "vacuum.F_max",
    "vacuum.F_attach", "vacuum.F_shear", "table.z", "wall.x", "table.k", "wall.k", "table.c", "wall.c", "table.mu", "wall.mu",
    OF_THREE("q_start"), OF_THREE("dq_start"), OF_THREE("ft.bias"), OF_THREE("ft.drift"), "ft.range", "ft.T", "substep", NULL};

const char *const arm_plant_real_names[] = {
    OF_THREE("q"), OF_THREE("dq"), OF_THREE("p"), OF_THREE("dp"), OF_THREE("f_e"), OF_THREE("tau_applied"),
    OF_THREE("tau_f"), OF_THREE("q_joint"), OF_THREE("p_pad"), "tension", "shear", OF_THREE("tau_drive"),
    "energy.kinetic", "energy.potential", "energy.surface", "energy.work_tau", "energy.work_f_h", "energy.work_f_d",
    "energy.payload", "energy.loss_friction", "energy.loss_viscous", "energy.loss_stop", "energy.loss_surface",
    "energy.loss_rub", "energy.loss_impact", "energy.loss_grip", "energy.loss_step", "energy.residual",
    OF_THREE("f_h_measured"), OF_THREE("rigid_body.M"), "rigid_body.M[4]", "rigid_body.M[5]", "rigid_body.M[6]",
    "rigid_body.M[7]", "rigid_body.M[8]", "rigid_body.M[9]", OF_THREE("rigid_body.C_dq"), OF_THREE("rigid_body.g"), NULL};

const char *const arm_plant_boolean_names[] = {"attached", "contact", NULL};

/* The terms of the energy balance, in the order of the outputs. */
enum { WORK_TAU, WORK_F_H, WORK_F_D, PAYLOAD, FRICTION, VISCOUS, STOP, SURFACE, RUB, IMPACT, GRIP, STEP };

static inline double floored(double x) { return fabs(x) < FLOOR ? 0.0 : x; }

/* A point of link 3 in the yaw frame, from the two pitch axes. */
struct reach {
    double x, z, r_x, r_z;
};

static inline struct reach reach(const struct arm_plant *arm, double x, double z)
{
    struct sin_cos b = arm->pitch;
    double r_x = x * b.c - z * b.s, r_z = x * b.s + z * b.c;
    return (struct reach){arm->with.L1 * arm->shoulder.c + r_x, arm->with.L1 * arm->shoulder.s + r_z, r_x, r_z};
}

static inline void point(const struct arm_plant *arm, struct arm_point *point, double x, double z)
{
    double s = arm->yaw.s, c = arm->yaw.c;
    struct reach at = reach(arm, x, z);
    double rho = arm->with.A1 + at.x;
    *point = (struct arm_point){{rho * c, rho * s, at.z},
                                {{-rho * s, -at.z * c, -at.r_z * c}, {rho * c, -at.z * s, -at.r_z * s}, {0.0, at.x, at.r_x}}};
}

/* A link or a mass fixed to it. */
struct link {
    double m, x, z, I_xx, I_yy, I_zz, I_xz;
};

static inline double about_vertical(const struct link *link, struct sin_cos a, double *slope)
{
    *slope = (link->I_xx - link->I_zz) * a.s * a.c + link->I_xz * (a.c * a.c - a.s * a.s);
    return link->I_xx * a.s * a.s + link->I_zz * a.c * a.c + 2.0 * link->I_xz * a.s * a.c;
}

static inline void add_fore(const struct arm_plant *arm, struct arm_body *sum, const struct link *link, const double g[3])
{
    double s_3 = arm->elbow.s, c_3 = arm->elbow.c, L1 = arm->with.L1, slope;
    struct reach at = reach(arm, link->x, link->z);
    double about_z = about_vertical(link, arm->pitch, &slope), rho = arm->with.A1 + at.x, m = link->m;
    sum->M[0][0] += m * rho * rho + about_z;
    sum->D_2 += slope - m * rho * at.z;
    sum->D_3 += slope - m * rho * at.r_z;
    double about_elbow = link->I_yy + m * (link->x * link->x + link->z * link->z);
    double coupling = about_elbow + m * L1 * (link->x * c_3 - link->z * s_3);
    sum->M[1][1] += link->I_yy + m * (at.x * at.x + at.z * at.z);
    sum->M[1][2] += coupling;
    sum->M[2][1] += coupling;
    sum->M[2][2] += about_elbow;
    sum->H -= m * L1 * (link->x * s_3 + link->z * c_3);
    sum->g[0] -= m * rho * g[1];
    sum->g[1] -= m * (at.x * g[2] - at.z * g[0]);
    sum->g[2] -= m * (at.r_x * g[2] - at.r_z * g[0]);
    sum->potential -= m * (rho * g[0] + at.z * g[2]);
}

static inline struct link link_of(const struct arm_plant_parameters *with, int i)
{
    return (struct link){with->m[i], with->x[i], with->z[i], with->I_xx[i], with->I_yy[i], with->I_zz[i], with->I_xz[i]};
}

/* M, C and g in the present pose, with the payload or without. */
static inline void weigh(const struct arm_plant *arm, struct arm_body *sum, bool attached)
{
    const struct arm_plant_parameters *with = &arm->with;
    const double *of = with->gravity;
    double s = arm->yaw.s, c = arm->yaw.c, g[3] = {c * of[0] + s * of[1], c * of[1] - s * of[0], of[2]};
    double reflected[3];
    for (int i = 0; i < 3; i++) reflected[i] = with->rotor[i] * with->gear[i] * with->gear[i];
    struct link one = link_of(with, 0), two = link_of(with, 1), three = link_of(with, 2);
    *sum = (struct arm_body){.g = {-one.m * one.x * g[1], 0.0, 0.0}, .potential = -one.m * (one.x * g[0] + one.z * g[2])};
    sum->M[0][0] = reflected[0] + one.I_zz + one.m * one.x * one.x;
    sum->M[1][1] = reflected[1], sum->M[2][2] = reflected[2];

    double slope, about_z = about_vertical(&two, arm->shoulder, &slope);
    double x = two.x * arm->shoulder.c - two.z * arm->shoulder.s, z = two.x * arm->shoulder.s + two.z * arm->shoulder.c;
    double rho = with->A1 + x;
    sum->M[0][0] += two.m * rho * rho + about_z;
    sum->D_2 += slope - two.m * rho * z;
    sum->M[1][1] += two.I_yy + two.m * (x * x + z * z);
    sum->g[0] -= two.m * rho * g[1];
    sum->g[1] -= two.m * (x * g[2] - z * g[0]);
    sum->potential -= two.m * (rho * g[0] + z * g[2]);

    add_fore(arm, sum, &three, g);
    if (attached && with->payload_m > 0.0) {
        struct link payload = {.m = with->payload_m, .x = with->pad_x, .z = with->pad_z};
        add_fore(arm, sum, &payload, g);
    }
}

static inline double kinetic(const struct arm_body *body, const double v[3])
{
    double Mv[3];
    times(Mv, body->M, v);
    return 0.5 * dot3(v, Mv);
}

static inline void coriolis(const struct arm_body *body, const double v[3], double out[3])
{
    double D_2 = body->D_2, D_3 = body->D_3, H = body->H;
    double C[3][3] = {{D_2 * v[1] + D_3 * v[2], D_2 * v[0], D_3 * v[0]},
                      {-D_2 * v[0], H * v[2], H * (v[1] + v[2])},
                      {-D_3 * v[0], -H * v[1], 0.0}};
    times(out, C, v);
}

/* Pose, points and rigid body follow the joint angles. */
static inline void follow(struct arm_plant *arm)
{
    struct sin_cos two = sin_cos(arm->q[1]), three = sin_cos(arm->q[2]);
    arm->yaw = sin_cos(arm->q[0]), arm->shoulder = two, arm->elbow = three;
    arm->pitch = (struct sin_cos){two.s * three.c + two.c * three.s, two.c * three.c - two.s * three.s};
    point(arm, &arm->handle, arm->with.handle_x, arm->with.handle_z);
    point(arm, &arm->pad, arm->with.pad_x, arm->with.pad_z);
    weigh(arm, &arm->body, arm->attached);
}

static inline double penetration(const struct arm_plant *arm, int k, const double p[3])
{
    return SIGN[k] * (arm->with.surface[k] - p[NORMAL[k]]);
}

static inline double impedance(const struct arm_plant *arm, int k, double dt) { return arm->with.k[k] * dt + arm->with.c[k]; }

static inline double relaxed(const struct arm_plant *arm, int k, double dt)
{
    double s = arm->s[k] * (arm->with.c[k] / impedance(arm, k, dt));
    return s < FLOOR ? 0.0 : s;
}

static inline double surface_energy(const struct arm_plant *arm, int k, double s) { return 0.5 * arm->with.k[k] * s * s; }

static inline double dry_limit(const struct arm_plant *arm, int i, double v)
{
    double F_c = arm->with.F_c[i], F_s = arm->with.F_s[i];
    if (v == 0.0) return F_s;
    double ratio = v / arm->with.v_s[i], square = ratio * ratio, peak = F_s - F_c;
    if (peak == 0.0 || square > 700.0 || (square > 40.0 && peak <= F_c)) return F_c; /* the exponential would not show */
    return F_c + peak * exp_of_less(-square);
}

/* (M + dt B) v = M dq + dt (tau + J_h' f_h + J_p' f_d - C dq - g) + impulses of friction, stops and surfaces. */
static inline void put_together(const struct arm_plant *arm, const double tau[3], const struct arm_plant_inputs *in, double dt,
                                struct problem *problem)
{
    const struct arm_plant_parameters *with = &arm->with;
    double of_h[3], of_d[3], of_C[3], Mdq[3];
    turned_times(of_h, arm->handle.J, in->f_h);
    turned_times(of_d, arm->pad.J, in->f_d);
    coriolis(&arm->body, arm->dq, of_C);
    times(Mdq, arm->body.M, arm->dq);
    memcpy(problem->A, arm->body.M, sizeof problem->A);
    memcpy(problem->J, arm->pad.J, sizeof problem->J);
    for (int i = 0; i < 3; i++) {
        problem->A[i][i] += with->b[i] * dt;
        problem->b[i] = Mdq[i] + (tau[i] + of_h[i] + of_d[i] - of_C[i] - arm->body.g[i]) * dt;
        problem->dry[i] = dry_limit(arm, i, arm->dq[i]) * dt;
        problem->low[i] = least((with->stop_min[i] - arm->q[i]) / dt, 0.0);
        problem->high[i] = most((with->stop_max[i] - arm->q[i]) / dt, 0.0);
    }
    for (int k = 0; k < 2; k++) {
        double kappa = impedance(arm, k, dt);
        problem->push[k] = kappa * (penetration(arm, k, arm->pad.p) - relaxed(arm, k, dt));
        problem->kappa_dt[k] = kappa * dt, problem->mu[k] = with->mu[k];
    }
}

/* Gripped, released or lost. */
static __attribute__((noinline)) void exchange(struct arm_plant *arm, bool attaches, struct arm_flow *flow)
{
    double m = arm->with.payload_m, potential = -m * dot3(arm->with.gravity, arm->pad.p), w[3], lost[3];
    struct arm_body exchanged;
    arm->attached = attaches;
    weigh(arm, &exchanged, attaches);
    if (attaches) {
        double inverse[3][3], Mv[3], v[3];
        inverted(inverse, exchanged.M);
        times(Mv, arm->body.M, arm->dq);
        times(v, inverse, Mv);
        for (int i = 0; i < 3; i++) lost[i] = arm->dq[i] - v[i];
        times(w, arm->pad.J, v);
        flow->of[PAYLOAD] = potential;
        flow->of[GRIP] = kinetic(&arm->body, lost) + 0.5 * m * dot3(w, w);
        memcpy(arm->dq, v, sizeof v);
    } else {
        times(w, arm->pad.J, arm->dq);
        flow->of[PAYLOAD] = -(potential + 0.5 * m * dot3(w, w));
    }
    arm->body = exchanged;
}

static inline void book(struct arm_sum *sum, double term)
{
    double more = sum->rest + term, head = sum->head + more, seen = head - sum->head;
    sum->rest = (sum->head - (head - seen)) + (more - seen);
    sum->head = head;
}

static inline int substep(struct arm_plant *arm, const struct arm_plant_inputs *in, double keep, double dt)
{
    const struct arm_plant_parameters *with = &arm->with;
    struct problem problem;
    struct solution found;
    double tau[3];
    for (int i = 0; i < 3; i++) tau[i] = floored(in->tau_a[i] + (arm->tau[i] - in->tau_a[i]) * keep);
    put_together(arm, tau, in, dt, &problem);
    if (solve(&problem, arm->guess, arm->pushes, &found) != ARM_PLANT_OK) return ARM_PLANT_ELSEWHERE;

    /* Move. */
    double q[3], dq[3], s[2];
    struct arm_point handle = arm->handle, pad = arm->pad;
    struct arm_body body = arm->body;
    bool moved = false;
    memcpy(q, arm->q, sizeof q), memcpy(dq, arm->dq, sizeof dq), memcpy(s, arm->s, sizeof s);
    for (int i = 0; i < 3; i++) {
        arm->q[i] = least(most(q[i] + found.v[i] * dt, with->stop_min[i]), with->stop_max[i]);
        arm->dq[i] = floored(found.v[i]), arm->tau[i] = tau[i];
        moved |= bits_of(arm->q[i]) != bits_of(q[i]);
    }
    if (moved) follow(arm);
    for (int k = 0; k < 2; k++) arm->s[k] = most(penetration(arm, k, arm->pad.p), relaxed(arm, k, dt));

    /* The energy that it moved, each term by its own formula. */
    struct arm_flow flow = {{0.0}};
    const double *v = arm->dq;
    double friction[3], stop[3], w[3], change[3], way[3], of_handle[3], of_pad[3], of_b[3];
    bool stopped = false;
    times(w, pad.J, v);
    for (int i = 0; i < 3; i++) {
        friction[i] = least(most(found.joint[i], -problem.dry[i]), problem.dry[i]);
        stop[i] = found.joint[i] - friction[i], stopped |= stop[i] != 0.0;
        change[i] = v[i] - dq[i], way[i] = arm->q[i] - q[i], of_b[i] = v[i] * v[i];
        of_handle[i] = arm->handle.p[i] - handle.p[i], of_pad[i] = arm->pad.p[i] - pad.p[i];
    }
    double jump = kinetic(&body, change);
    flow.of[WORK_TAU] = dot3(tau, way), flow.of[WORK_F_H] = dot3(in->f_h, of_handle), flow.of[WORK_F_D] = dot3(in->f_d, of_pad);
    flow.of[FRICTION] = -dot3(friction, v), flow.of[VISCOUS] = dt * dot3(with->b, of_b);
    flow.of[STOP] = -dot3(stop, v) + (stopped ? jump : 0.0), flow.of[RUB] = -dot3(found.tangent, w);
    flow.of[STEP] = stopped ? 0.0 : jump;
    for (int k = 0; k < 2; k++) {
        double ds = arm->s[k] - s[k];
        flow.of[SURFACE] += with->c[k] * ds * (ds / dt);
        flow.of[IMPACT] += found.normal[k] / dt * (s[k] - penetration(arm, k, pad.p));
        flow.of[STEP] += surface_energy(arm, k, ds);
    }

    /* What it shows, and what becomes of the payload. */
    double on_pad[3] = {found.tangent[0], found.tangent[1], found.tangent[2]};
    for (int k = 0; k < 2; k++) on_pad[NORMAL[k]] += SIGN[k] * found.normal[k];
    double held[3] = {0.0}, now[3];
    times(now, arm->pad.J, arm->dq);
    times(w, pad.J, dq);
    for (int i = 0; i < 3; i++) {
        arm->f_e[i] = on_pad[i] / dt;
        arm->tau_f[i] = friction[i] / dt - arm->dq[i] * with->b[i];
        if (arm->attached) held[i] = ((now[i] - w[i]) / dt - with->gravity[i]) * with->payload_m - arm->f_e[i];
        arm->hold[i] = held[i];
    }
    arm->contact = found.normal[0] > 0.0 || found.normal[1] > 0.0;
    double shear = sqrt(held[0] * held[0] + held[1] * held[1]);
    bool breaks = held[2] > with->F_max || (with->F_shear > 0.0 && shear > with->F_shear);
    bool attaches = !arm->attached && in->vacuum && found.normal[0] / dt > with->F_attach;
    if ((attaches || (arm->attached && (!in->vacuum || breaks))) && with->payload_m > 0.0) exchange(arm, attaches, &flow);
    for (int term = 0; term < 12; term++) book(&arm->sums[term], flow.of[term]);
    return ARM_PLANT_OK;
}

static inline double stored(const struct arm_plant *arm, struct arm_plant_outputs *out)
{
    out->kinetic = kinetic(&arm->body, arm->dq), out->potential = arm->body.potential;
    out->surface = surface_energy(arm, 0, arm->s[0]) + surface_energy(arm, 1, arm->s[1]);
    return out->kinetic + out->potential + out->surface;
}

static inline void show(struct arm_plant *arm, const struct arm_plant_inputs *in, const double tau_drive[3],
                        struct arm_plant_outputs *out)
{
    double age = (double)++arm->samples * arm->with.ft_T, range = arm->with.ft_range;
    times(out->dp, arm->handle.J, arm->dq);
    coriolis(&arm->body, arm->dq, out->C_dq);
    for (int i = 0; i < 3; i++) {
        out->q[i] = out->q_joint[i] = arm->q[i], out->dq[i] = arm->dq[i];
        out->p[i] = arm->handle.p[i], out->p_pad[i] = arm->pad.p[i];
        out->f_e[i] = arm->f_e[i], out->tau_f[i] = arm->tau_f[i], out->tau_applied[i] = arm->tau[i];
        out->tau_drive[i] = tau_drive[i], out->g[i] = arm->body.g[i];
        double reading = in->f_h[i] + (0.0 + (arm->with.ft_bias[i] + arm->with.ft_drift[i] * age)) + 0.0;
        out->f_h_measured[i] = least(most(reading, -range), range);
    }
    memcpy(out->M, arm->body.M, sizeof out->M);
    out->tension = arm->hold[2], out->shear = sqrt(arm->hold[0] * arm->hold[0] + arm->hold[1] * arm->hold[1]);
    double now = stored(arm, out), *terms = &out->work_tau, loss = 0.0;
    for (int term = 0; term < 12; term++) terms[term] = arm->sums[term].head;
    for (int term = FRICTION; term <= STEP; term++) loss += terms[term];
    out->residual = out->work_tau + out->work_f_h + out->work_f_d + out->payload - loss - (now - arm->E_0);
    out->attached = arm->attached, out->contact = arm->contact;
}

void arm_plant_start(struct arm_plant *arm, const struct arm_plant_parameters *with)
{
    struct arm_plant_outputs at_start;
    memset(arm, 0, sizeof *arm);
    arm->with = *with;
    memcpy(arm->q, with->q_start, sizeof arm->q), memcpy(arm->dq, with->dq_start, sizeof arm->dq);
    follow(arm);
    arm->E_0 = stored(arm, &at_start);
}

int arm_plant_step(struct arm_plant *arm, const struct arm_plant_inputs *in, double h, struct arm_plant_outputs *out)
{
    double n = ceil(h / arm->with.substep - 1e-6), dt = h / n, sum[3] = {0.0};
    double keep = arm->with.cutoff > 0.0 ? floored(exp_of_less(-2.0 * 3.14159265358979323846 * arm->with.cutoff * dt)) : 0.0;
    for (int k = 0; k < (int)n; k++) {
        if (substep(arm, in, keep, dt) != ARM_PLANT_OK) return ARM_PLANT_ELSEWHERE;
        for (int i = 0; i < 3; i++) sum[i] += arm->tau[i];
    }
    for (int i = 0; i < 3; i++) sum[i] /= n;
    show(arm, in, sum, out);
    return ARM_PLANT_OK;
}
