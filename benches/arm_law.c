#include "arm_law.h"
#include "arm_edges.h"
#include "arm_math.h"

static const double SMALLEST = 1e-150; /* a slower nominal stands still */
static const double REACH_ROUNDING = 1e4 * EPSILON, SAMPLE_ROUNDING = 64.0 * EPSILON;

enum { OFF = 0, ENGAGED = 3, HOLD = 4, DEBT = 7, NOT_FINITE = 1, DROPOUT = 5 };

/* One axis at a tick. */
struct sensed {
    double q[3], dq[3], e[3], v_n[3];
};

/* What the axes ask for. */
struct proposal {
    double damping, low, high, f_h[3], f_demand[3], v_m[3];
    bool held[3];
};

/* How the nominals move. */
struct driven {
    double v_m[3];
    bool held[3];
};

/* The sample that ended. */
struct settlement {
    double step[3], H, G, tank, rounding;
    bool has_step, outside;
};

#define OF_THREE(name) name "[1]", name "[2]", name "[3]"

const char *const arm_law_parameter_names[] = {
    OF_THREE("Lambda_n"), OF_THREE("D_n"), OF_THREE("K"), OF_THREE("K_P"), OF_THREE("f_max"), OF_THREE("tau_max"), "alpha",
    "T", "energy.E_0", OF_THREE("dq_max"), OF_THREE("ddq_max"), "kinematics.A1", "kinematics.L1", "kinematics.handle_x",
    "kinematics.handle_z", OF_THREE("encoder.range"), OF_THREE("ft.handle"), "ft.recovery_time", "workspace.limited",
    OF_THREE("workspace.q_min"), OF_THREE("workspace.q_max"), "workspace.radius_min", "workspace.slowing_time",
    "singularity.sigma_slow", "singularity.D", NULL};

const char *const arm_law_real_names[] = {
    OF_THREE("tau_a"), OF_THREE("p"), OF_THREE("p_n"), OF_THREE("dp_n"), OF_THREE("e_nr"), OF_THREE("f_a"), "sigma_min",
    "energy.H", "energy.G", "energy.tank", OF_THREE("dp"), OF_THREE("tau_demand"), "energy.share", OF_THREE("ft.f_h"),
    OF_THREE("ft.moment"), OF_THREE("ft.bias_force"), OF_THREE("ft.bias_torque"), "authority", OF_THREE("q_n"), NULL};

const char *const arm_law_integer_names[] = {"saturated", "engaged",  "outside_bounds", "slowed",        "held",  "energy.debt",
                                             "ft.fault",  "state",    "encoder.fault",  "timing",        NULL};

void arm_law_start(struct arm_law *law, const struct arm_law_parameters *with)
{
    memset(law, 0, sizeof *law);
    law->with = *with;
    double T = with->T;
    for (int i = 0; i < 3; i++) {
        struct arm_law_axis *axis = &law->axes[i];
        double K = with->K[i], K_P = with->K_P[i], M_n = with->Lambda_n[i], lead = 1.0 + K_P * T / 2.0;
        *axis = (struct arm_law_axis){.D_n = with->D_n[i], .K = K, .K_P = K_P, .f_max = with->f_max[i], .lead = lead};
        axis->k = K * K_P, axis->half_k = 0.5 * axis->k, axis->e_max = with->f_max[i] / axis->k;
        axis->half_M = 0.5 * M_n, axis->M_2 = 2.0 * M_n, axis->M_2T = 2.0 * M_n / T;
        axis->KPT = K_P * T, axis->c = with->alpha * lead, axis->port = K / with->alpha, axis->exchange = K * T * lead;
        law->step_max[i] = with->dq_max[i] * T * (1.0 + REACH_ROUNDING);
        law->change_max[i] = with->ddq_max[i] * T * T * (1.0 + REACH_ROUNDING);
        law->encoder_change[i] = least(law->step_max[i], with->ddq_max[i] * T * T);
        law->middle[i] = (with->q_min[i] + with->q_max[i]) / 2.0;
        law->wide[i] = (with->q_max[i] - with->q_min[i]) / 2.0 - 0.25;
    }
    law->samples = with->slowing_time / T;
    law->radius = with->radius_min + 0.05;
    law->arm = with->L1 + with->handle_x + fabs(with->handle_z);
    law->tank = with->E_0;
}

/* Whether nothing is wrong with the joint angles. */
static inline bool encoders_are_sound(const struct arm_law *law, const struct arm_law_inputs *in)
{
    if (!in->encoder_valid) return false;
    bool far = false, other = false;
    for (int i = 0; i < 3; i++) {
        if (!(fabs(in->q[i]) <= law->with.encoder_range[i])) return false;
        double way = in->q[i] - law->told[i];
        far |= fabs(way) > law->step_max[i];
    }
    if (!law->is_told || !far) return true;
    for (int i = 0; i < 3; i++) {
        double way = in->q[i] - law->told[i], foretold = law->told[i] - law->before[i];
        other |= fabs(way) > law->step_max[i] && fabs(way - foretold) > law->encoder_change[i];
    }
    return !other;
}

/* Where the handle is at the joint angles q: p, J and its smallest singular value. */
static inline void turn(struct pose *pose, const struct arm_law_parameters *with, const double q[3])
{
    struct sin_cos one = sin_cos(q[0]), two = sin_cos(q[1]), three = sin_cos(q[2]);
    double s_b = two.s * three.c + two.c * three.s, c_b = two.c * three.c - two.s * three.s;
    double r_x = with->handle_x * c_b - with->handle_z * s_b, r_z = with->handle_x * s_b + with->handle_z * c_b;
    double x = with->L1 * two.c + r_x, z = with->L1 * two.s + r_z, rho = with->A1 + x;
    double det = with->L1 * (with->handle_x * three.s + with->handle_z * three.c);
    *pose = (struct pose){.p = {rho * one.c, rho * one.s, z},
                          .J = {{-rho * one.s, -z * one.c, -r_z * one.c},
                                {rho * one.c, -z * one.s, -r_z * one.s},
                                {0.0, x, r_x}},
                          .x = x, .z = z, .r_x = r_x, .r_z = r_z, .rho = rho, .det = det, .yaw = one};
    double a = -z, b = -r_z, c = x, d = r_x, sum, difference;
    double size = fabs(a) + fabs(b) + fabs(c) + fabs(d);
    if (size > 1e-15 && size < 1e15) {
        sum = sqrt((a + d) * (a + d) + (b - c) * (b - c));
        difference = sqrt((a - d) * (a - d) + (b + c) * (b + c));
    } else {
        sum = hypot(a + d, b - c), difference = hypot(a - d, b + c);
    }
    pose->sigma_min = least(fabs(rho), fabs(det) / (0.5 * (sum + difference)));
}

/* The hand's force and moment, zero while the sensor has a fault. */
static inline int hand(struct arm_law *law, const struct arm_law_inputs *in, double force[3], double moment[3], double *sound)
{
    const double *r = law->with.ft_handle, *bias = (const double[3]){0.0, 0.0, 0.0};
    double none = 0.0;
    for (int i = 0; i < 3; i++) none += 0.0 * in->f_h[i];
    int found = none != 0.0 ? NOT_FINITE : !in->ft_valid ? DROPOUT : 0, fault = found;
    *sound = 0.0;
    if (!found && law->ft_fault) {
        *sound = law->ft_sound + law->with.T;
        fault = *sound > law->with.recovery_time - 0.5 * law->with.T ? 0 : law->ft_fault;
    }
    for (int i = 0; i < 3; i++) force[i] = fault ? 0.0 : in->f_h[i] - bias[i];
    moment[0] = 0.0 - (r[1] * force[2] - r[2] * force[1]);
    moment[1] = 0.0 - (r[2] * force[0] - r[0] * force[2]);
    moment[2] = 0.0 - (r[0] * force[1] - r[1] * force[0]);
    none = 0.0;
    for (int i = 0; i < 3; i++) none += 0.0 * force[i] + 0.0 * moment[i];
    if (none == 0.0) return fault;
    for (int i = 0; i < 3; i++) force[i] = moment[i] = 0.0;
    return NOT_FINITE;
}

static inline void sense(const struct arm_law *law, struct sensed *now, const double p[3])
{
    for (int i = 0; i < 3; i++) {
        const struct arm_law_axis *axis = &law->axes[i];
        now->q[i] = p[i];
        if (law->engaged) {
            now->dq[i] = (p[i] - axis->q) / law->with.T;
            now->e[i] = sat(axis->q_n - p[i], axis->e_max);
            now->v_n[i] = axis->v_n;
        } else {
            now->dq[i] = now->e[i] = now->v_n[i] = 0.0;
        }
    }
}

static inline double spring(const struct arm_law_axis *axis, double e)
{
    double x = fabs(e);
    return axis->half_k * x * x;
}

static inline double mass(const struct arm_law *law, const struct arm_law_axis *axis, double v_n)
{
    return axis->K * (axis->half_M * v_n * v_n / law->with.alpha);
}

static inline double stored(const struct arm_law *law, const struct sensed *now)
{
    double of[3];
    for (int i = 0; i < 3; i++) of[i] = mass(law, &law->axes[i], now->v_n[i]) + spring(&law->axes[i], now->e[i]);
    return of[0] + of[1] + of[2];
}

/* Work of the torques in the sample that ends at the joint angles q. */
static inline double work(const struct arm_law *law, const double q[3])
{
    if (!law->has_q) return 0.0;
    double way[3] = {q[0] - law->q[0], q[1] - law->q[1], q[2] - law->q[2]};
    return dot3(law->acting, way);
}

static inline double created(const struct arm_law *law, double H, double work) { return H - law->H + work - law->supplied; }

static double kept_fraction(double energy, double affordable)
{
    return affordable <= 0.0 ? 0.0 : affordable < energy ? sqrt(affordable / energy) : 1.0;
}

/* Gives up what the tank cannot pay for: the springs first. */
static __attribute__((noinline)) void give_up(const struct arm_law *law, struct sensed *now, double work)
{
    double springs = 0.0, masses = 0.0, affordable = law->tank - created(law, 0.0, work);
    for (int i = 0; i < 3; i++) {
        springs += spring(&law->axes[i], now->e[i]);
        masses += mass(law, &law->axes[i], now->v_n[i]);
    }
    double e = kept_fraction(springs, affordable - masses), v_n = kept_fraction(masses, affordable);
    for (int i = 0; i < 3; i++) now->e[i] *= e, now->v_n[i] *= v_n;
}

static inline void settle(const struct arm_law *law, struct settlement *ended, double H, double made, const double q[3])
{
    ended->has_step = law->has_q;
    ended->outside = false;
    for (int i = 0; i < 3 && law->has_q; i++) {
        ended->step[i] = q[i] - law->q[i];
        double change = law->has_step ? ended->step[i] - law->step[i] : 0.0;
        ended->outside |= fabs(ended->step[i]) > law->step_max[i] || fabs(change) > law->change_max[i];
    }
    ended->H = H;
    ended->G = law->G + made;
    ended->tank = least(law->tank - made, law->with.E_0);
    ended->rounding = 0.0;
    if (ended->tank < 0.0) {
        double size = 0.0;
        for (int i = 0; i < 3 && law->has_q; i++) size += fabs(law->acting[i]) * fabs(q[i] - law->q[i]);
        size = fabs(law->tank) + H + law->H + size + fabs(law->supplied) + law->exchanged;
        ended->rounding = most(law->rounding, SAMPLE_ROUNDING * size);
    }
}

static inline double coupled(const struct arm_law *law, const struct arm_law_axis *axis, const struct sensed *now, int i,
                             const struct proposal *asks)
{
    double dq = now->dq[i];
    return (axis->M_2 * now->v_n[i] / law->with.T + asks->f_h[i] +
            law->with.alpha * (dq + axis->KPT * dq / 2.0 - axis->K_P * now->e[i])) /
           (axis->M_2T + (axis->D_n + asks->damping) + axis->c);
}

static inline double coupling(const struct arm_law *law, const struct arm_law_axis *axis, const struct sensed *now, int i,
                              double v_m)
{
    double w = v_m - now->dq[i];
    return w + axis->K_P * (now->e[i] + law->with.T * w / 2.0);
}

/* The nominal's velocity while it feels the force f. */
static inline double feeling(const struct arm_law *law, const struct arm_law_axis *axis, const struct sensed *now, int i,
                             const struct proposal *asks, double f)
{
    double y_s = f / axis->K;
    return (axis->M_2 * now->v_n[i] / law->with.T + asks->f_h[i] - law->with.alpha * y_s) /
           (axis->M_2T + (axis->D_n + asks->damping));
}

static inline double within(const struct proposal *asks, double v)
{
    return v > asks->high ? asks->high : v < asks->low ? asks->low : v;
}

static inline void propose(const struct arm_law *law, const struct sensed *now, struct proposal *asks)
{
    for (int i = 0; i < 3; i++) {
        const struct arm_law_axis *axis = &law->axes[i];
        double free = coupled(law, axis, now, i, asks);
        asks->v_m[i] = within(asks, free);
        asks->held[i] = asks->v_m[i] != free;
        asks->f_demand[i] = axis->K * coupling(law, axis, now, i, asks->v_m[i]);
    }
}

/* How the nominals move within the edges: all of K y acts on them, or the force f. */
static __attribute__((noinline)) void within_edges(const struct arm_law *law, const struct sensed *now,
                                                   const struct proposal *asks, const struct edge edges[EDGES],
                                                   const double *f, struct driven *moves)
{
    double free[3], weight[3];
    for (int i = 0; i < 3; i++) {
        const struct arm_law_axis *axis = &law->axes[i];
        double inertia = axis->M_2T + (axis->D_n + asks->damping);
        free[i] = f ? feeling(law, axis, now, i, asks, f[i]) : coupled(law, axis, now, i, asks);
        weight[i] = axis->K * (f ? inertia : inertia + axis->c);
    }
    kept_within(moves->v_m, edges, asks->low, asks->high, weight, free);
    for (int i = 0; i < 3; i++) moves->held[i] = moves->v_m[i] != free[i];
}

static __attribute__((noinline)) void propose_within(const struct arm_law *law, const struct sensed *now,
                                                     const struct near *near, struct proposal *asks)
{
    struct edge edges[EDGES];
    struct driven moves;
    edges_of(edges, near, now->e);
    if (edges_keep(edges, asks->v_m)) return;
    within_edges(law, now, asks, edges, NULL, &moves);
    for (int i = 0; i < 3; i++) {
        asks->v_m[i] = moves.v_m[i], asks->held[i] = moves.held[i];
        asks->f_demand[i] = law->axes[i].K * coupling(law, &law->axes[i], now, i, moves.v_m[i]);
    }
}

/* How the nominals move if the robot gets the force f. */
static inline void drive(const struct arm_law *law, const struct sensed *now, const struct near *near,
                         const struct proposal *asks, const double f[3], struct driven *moves)
{
    bool all = true, is_held = false;
    for (int i = 0; i < 3; i++) {
        bool same = f[i] == asks->f_demand[i];
        double free = same ? asks->v_m[i] : feeling(law, &law->axes[i], now, i, asks, f[i]);
        moves->v_m[i] = same ? free : within(asks, free);
        moves->held[i] = same ? asks->held[i] : moves->v_m[i] != free;
        all &= same, is_held |= asks->held[i];
    }
    if (!near || all) return;
    struct edge edges[EDGES];
    edges_of(edges, near, now->e);
    if (is_held || !edges_keep(edges, moves->v_m)) within_edges(law, now, asks, edges, f, moves);
}

/* Energy that the law is sure to take in the sample that begins. */
static inline double taken(const struct arm_law *law, const struct sensed *now, const struct proposal *asks,
                           const struct driven *moves, const double f[3])
{
    double T = law->with.T, of[3];
    for (int i = 0; i < 3; i++) {
        const struct arm_law_axis *axis = &law->axes[i];
        double v = moves->v_m[i];
        of[i] = f[i] * v * T + axis->port * (axis->D_n + asks->damping) * v * v * T + spring(axis, now->e[i]);
    }
    return of[0] + of[1] + of[2];
}

/* Most work of the torques tau in the sample that begins, within the robot's reach. */
static inline double most_work(const struct arm_law *law, const struct settlement *ended, const double tau[3])
{
    const struct arm_law_parameters *with = &law->with;
    double T = with->T, sum = 0.0;
    for (int i = 0; i < 3; i++) {
        double size = fabs(tau[i]), by_speed = size * with->dq_max[i] * T, by_acceleration = by_speed;
        if (ended->has_step && !ended->outside)
            by_acceleration = tau[i] * ended->step[i] + size * with->ddq_max[i] * T * T;
        if (size > 0.0) sum += least(by_speed, by_acceleration);
    }
    return sum;
}

/* The share of force and torque that the tank covers, where it does not cover the whole. */
static __attribute__((noinline)) double share_of(const struct arm_law *law, const struct sensed *now, const struct near *near,
                                                 const struct proposal *asks, const struct settlement *ended, double most,
                                                 const double f[3])
{
    double covered = 0.0, not = 1.0;
    for (int k = 0; k < 53; k++) {
        double between = 0.5 * (covered + not), part[3] = {f[0] * between, f[1] * between, f[2] * between};
        struct driven moves;
        drive(law, now, near, asks, part, &moves);
        if (0.0 + between * most - taken(law, now, asks, &moves, part) <= ended->tank)
            covered = between;
        else
            not = between;
    }
    return covered;
}

/* What the joints deliver: all by one factor. */
static inline bool deliver(const struct arm_law *law, const double J[3][3], double f[3], double tau[3])
{
    const double *limit = law->with.tau_max;
    turned_times(tau, J, f);
    if (fabs(tau[0]) <= limit[0] && fabs(tau[1]) <= limit[1] && fabs(tau[2]) <= limit[2]) return false;
    double s = 1.0;
    for (int i = 0; i < 3; i++)
        if (fabs(tau[i]) > limit[i]) s = least(s, limit[i] / fabs(tau[i]));
    for (int i = 0; i < 3; i++) {
        tau[i] = most(least(tau[i] * s, limit[i]), -limit[i]);
        f[i] *= s;
    }
    return s < 1.0;
}

static inline double slower(double v, double other) { return other * other <= v * v ? other : v; }

static inline void commit(struct arm_law *law, const struct sensed *now, const struct proposal *asks,
                          const struct driven *moves, const double f[3])
{
    for (int i = 0; i < 3; i++) {
        struct arm_law_axis *axis = &law->axes[i];
        double v = 2.0 * moves->v_m[i] - now->v_n[i];
        if (moves->held[i]) v = slower(v, moves->v_m[i]);
        if (f[i] != asks->f_demand[i]) v = slower(v, (f[i] / axis->K - axis->K_P * now->e[i]) / axis->lead + now->dq[i]);
        axis->q = now->q[i], axis->dq = now->dq[i];
        axis->q_n = now->q[i] + now->e[i] + law->with.T * moves->v_m[i];
        axis->v_n = fabs(v) < SMALLEST ? 0.0 : v;
    }
    law->engaged = true;
}

static inline void book(struct arm_law *law, const struct settlement *ended, const double q[3], const double tau[3],
                        double supplied, double exchanged)
{
    memcpy(law->q, q, sizeof law->q);
    memcpy(law->step, ended->step, sizeof law->step);
    memcpy(law->acting, tau, sizeof law->acting);
    law->has_q = true, law->has_step = ended->has_step, law->outside = ended->outside;
    law->H = ended->H, law->G = ended->G, law->tank = ended->tank, law->rounding = ended->rounding;
    law->supplied = supplied, law->exchanged = exchanged;
}

/* A tick out of the loop: no torque, what was stored is given up. */
static __attribute__((noinline)) int rest(struct arm_law *law, const double q[3], const struct pose *pose,
                                          struct arm_law_outputs *out)
{
    struct settlement ended = {.step = {0.0}};
    settle(law, &ended, 0.0, created(law, 0.0, work(law, q)), q);
    if (!(fabs(ended.G) < INFINITY)) return ARM_LAW_NOT_FINITE;
    memset(out, 0, sizeof *out);
    memcpy(out->p_n, pose->p, sizeof out->p_n);
    out->share = 1.0, out->outside_bounds = ended.outside;
    book(law, &ended, q, (const double[3]){0.0, 0.0, 0.0}, 0.0, 0.0);
    law->engaged = false;
    return ARM_LAW_OK;
}

/* A tick in the loop. */
static inline int run(struct arm_law *law, const double q[3], const struct pose *pose, struct proposal *asks,
                      struct arm_law_outputs *out)
{
    struct near near_limits, *near = NULL;
    if (law->with.limited != 0.0 && !limits_are_far(law, q, pose)) limits_at(near = &near_limits, law, q, pose);

    /* Settle: the sample that ends is paid for. */
    struct sensed now;
    struct settlement ended = {.step = {0.0}};
    sense(law, &now, pose->p);
    double H = stored(law, &now), done = work(law, q), made = created(law, H, done);
    if (!(made <= law->tank)) {
        give_up(law, &now, done);
        H = stored(law, &now), made = created(law, H, done);
    }
    settle(law, &ended, H, made, q);
    if (!law->engaged) ended.has_step = ended.outside = false;

    /* Propose, deliver, share. */
    double f[3], tau[3], share = 1.0;
    struct driven moves;
    propose(law, &now, asks);
    if (near) propose_within(law, &now, near, asks);
    for (int i = 0; i < 3; i++) f[i] = sat(asks->f_demand[i], law->axes[i].f_max);
    bool limited = deliver(law, pose->J, f, tau);
    drive(law, &now, near, asks, f, &moves);
    double needed = most_work(law, &ended, tau);
    if (!(0.0 + needed - taken(law, &now, asks, &moves, f) <= ended.tank)) {
        share = share_of(law, &now, near, asks, &ended, needed, f);
        for (int i = 0; i < 3; i++) f[i] *= share, tau[i] *= share;
        drive(law, &now, near, asks, f, &moves);
    }

    /* Commit, if all is finite. */
    double supplied[3], exchanged[3], demand[3], p_n[3], none = 0.0;
    turned_times(demand, pose->J, asks->f_demand);
    for (int i = 0; i < 3; i++) {
        const struct arm_law_axis *axis = &law->axes[i];
        double v = moves.v_m[i];
        supplied[i] = axis->port * asks->f_h[i] * v * law->with.T;
        exchanged[i] = axis->exchange * (v * v + now.dq[i] * now.dq[i]);
        p_n[i] = now.q[i] + now.e[i];
        none += 0.0 * f[i] + 0.0 * tau[i] + 0.0 * demand[i] + 0.0 * p_n[i] + 0.0 * now.v_n[i];
    }
    if (none != 0.0 || !(fabs(ended.G) < INFINITY)) return ARM_LAW_NOT_FINITE;
    commit(law, &now, asks, &moves, f);
    book(law, &ended, q, tau, supplied[0] + supplied[1] + supplied[2], exchanged[0] + exchanged[1] + exchanged[2]);

    out->saturated = limited, out->held = false;
    for (int i = 0; i < 3; i++) {
        out->tau_a[i] = tau[i], out->tau_demand[i] = demand[i], out->f_a[i] = f[i];
        out->p_n[i] = p_n[i], out->dp_n[i] = now.v_n[i], out->e_nr[i] = now.e[i], out->dp[i] = now.dq[i];
        out->saturated |= f[i] != asks->f_demand[i], out->held |= moves.held[i];
    }
    out->share = share, out->outside_bounds = ended.outside, out->engaged = true;
    return ARM_LAW_OK;
}

int arm_law_tick(struct arm_law *law, const struct arm_law_inputs *in, struct arm_law_outputs *out)
{
    const struct arm_law_parameters *with = &law->with;
    if (in->ft_tare || !encoders_are_sound(law, in)) return ARM_LAW_ELSEWHERE;
    struct pose pose;
    struct proposal asks;
    double moment[3], sound;
    turn(&pose, with, in->q);
    int fault = hand(law, in, asks.f_h, moment, &sound), status;

    asks.damping = 0.0;
    if (pose.sigma_min < with->sigma_slow && with->D > 0.0) {
        double ratio = 1.0 / most(pose.sigma_min / with->sigma_slow, 0.25);
        asks.damping = with->D * (ratio * ratio - 1.0);
    }
    asks.low = in->hold ? 0.0 : -INFINITY, asks.high = in->hold ? 0.0 : INFINITY;
    status = in->engage ? run(law, in->q, &pose, &asks, out) : rest(law, in->q, &pose, out);
    if (status != ARM_LAW_OK) return status;

    law->ft_fault = fault, law->ft_sound = sound;
    memcpy(law->before, law->is_told ? law->told : in->q, sizeof law->before);
    memcpy(law->told, in->q, sizeof law->told);
    law->is_told = true;
    for (int i = 0; i < 3; i++) {
        out->p[i] = pose.p[i], out->q_n[i] = in->q[i];
        out->ft_f_h[i] = asks.f_h[i], out->ft_moment[i] = moment[i];
        out->ft_bias_force[i] = out->ft_bias_torque[i] = 0.0;
    }
    out->sigma_min = pose.sigma_min, out->H = law->H, out->G = law->G, out->tank = law->tank;
    out->slowed = in->engage && asks.damping > 0.0;
    out->debt = law->tank < -law->rounding;
    out->ft_fault = fault, out->encoder_fault = 0, out->timing = 0;
    out->authority = in->engage ? 1.0 : 0.0;
    out->state = !in->engage ? OFF : out->debt ? DEBT : in->hold ? HOLD : ENGAGED;
    return ARM_LAW_OK;
}
