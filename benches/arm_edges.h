/* The limits of the workspace as edges of the handle's velocity: n.v <= c. Looked at where one is near. */
#ifndef ARM_EDGES_H
#define ARM_EDGES_H

#include "arm_law.h"
#include "arm_math.h"

enum { EDGES = 7, ROUNDS = 24 };

/* Where the handle is. */
struct pose {
    double p[3], J[3][3], sigma_min, x, z, r_x, r_z, rho, det;
    struct sin_cos yaw;
};

struct near {
    double n[EDGES][3], d[EDGES], slowing_time;
};

struct edge {
    double n[3], c;
};

static inline bool limits_are_far(const struct arm_law *law, const double q[3], const struct pose *pose)
{
    if (!law->has_step) return false;
    double go_on = (fabs(law->step[0]) + fabs(law->step[1]) + fabs(law->step[2])) * law->samples;
    double radius = pose->J[1][0] * pose->yaw.c - pose->J[0][0] * pose->yaw.s;
    for (int i = 0; i < 3; i++)
        if (!(fabs(q[i] - law->middle[i]) + go_on < law->wide[i])) return false;
    return law->radius + go_on * law->arm < radius;
}

static __attribute__((noinline)) void limits_at(struct near *near, const struct arm_law *law, const double q[3],
                                                const struct pose *pose)
{
    const struct arm_law_parameters *with = &law->with;
    double s = pose->yaw.s, c = pose->yaw.c;
    double joints[3][3] = {{-s, c, 0.0},
                           {pose->r_x * c, pose->r_x * s, pose->r_z},
                           {-pose->x * c, -pose->x * s, -pose->z}};
    double scales[3] = {pose->rho, pose->det, pose->det};
    for (int i = 0; i < 3; i++) {
        double sign = scales[i] < 0.0 ? -1.0 : 1.0;
        for (int a = 0; a < 3; a++) {
            near->n[2 * i][a] = joints[i][a] * sign;
            near->n[2 * i + 1][a] = -near->n[2 * i][a];
        }
        near->d[2 * i] = (with->q_max[i] - q[i]) * fabs(scales[i]);
        near->d[2 * i + 1] = (q[i] - with->q_min[i]) * fabs(scales[i]);
    }
    near->n[6][0] = -c, near->n[6][1] = -s, near->n[6][2] = 0.0;
    near->d[6] = pose->rho - with->radius_min;
    near->slowing_time = with->slowing_time;
}

/* The edges of a nominal that is e ahead of the handle. */
static void edges_of(struct edge edges[EDGES], const struct near *near, const double e[3])
{
    for (int j = 0; j < EDGES; j++) {
        memcpy(edges[j].n, near->n[j], sizeof edges[j].n);
        edges[j].c = most(0.0, near->d[j] - dot3(near->n[j], e)) / near->slowing_time;
    }
}

static double beyond(const struct edge *edge, const double v[3]) { return dot3(edge->n, v) - edge->c; }

static bool edges_keep(const struct edge edges[EDGES], const double v[3])
{
    for (int j = 0; j < EDGES; j++)
        if (!(beyond(&edges[j], v) <= 0.0)) return false;
    return true;
}

/* The velocities within edges and intervals, for those that there would be without: W (v - free) = -sum lambda n. */
static void kept_within(double v[3], const struct edge edges[EDGES], double low, double high, const double W[3],
                        const double free[3])
{
    double lambda[EDGES] = {0.0};
    memcpy(v, free, 3 * sizeof *v);
    for (int round = 0; round < ROUNDS; round++) {
        bool is_found = true;
        for (int j = 0; j < EDGES; j++) {
            const struct edge *edge = &edges[j];
            double along[3] = {edge->n[0] / W[0], edge->n[1] / W[1], edge->n[2] / W[2]};
            double size = dot3(edge->n, along), far = beyond(edge, v);
            if (!(size > 0.0 && (far > 0.0 || lambda[j] > 0.0))) continue;
            double before = lambda[j];
            lambda[j] = most(0.0, before + far / size);
            double sizes = 0.0;
            for (int i = 0; i < 3; i++) v[i] -= along[i] * (lambda[j] - before);
            for (int i = 0; i < 3; i++) sizes += fabs(edge->n[i]) * fabs(v[i]);
            is_found &= fabs((lambda[j] - before) * size) <= 8.0 * EPSILON * (sizes + edge->c);
        }
        if (is_found) break;
    }
    double given = 0.0, own = 0.0;
    for (int i = 0; i < 3; i++) {
        v[i] = v[i] > high ? high : v[i] < low ? low : v[i];
        given += free[i] * (v[i] * W[i]);
        own += v[i] * (v[i] * W[i]);
    }
    if (given < own) {
        double share = most(0.0, least(1.0, given / own));
        for (int i = 0; i < 3; i++) v[i] *= share;
    }
}

#endif
