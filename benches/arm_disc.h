/* Friction of the pad on one surface: the projection on the disc that Coulomb's law allows. */
#ifndef ARM_DISC_H
#define ARM_DISC_H

#include "arm_math.h"

#define FLOOR 1e-140

/* w + S t and n - c.t in the plane's two axes; S = [S_11 S_12; S_12 S_22]. */
struct slip {
    double S_11, S_12, S_22, w[2], n, c[2], mu;
};

/* t(gamma) = -(u + gamma e)/(p + gamma (r + gamma z)). */
struct answer {
    double u[2], e[2], p, r, z;
};

static inline double dot2(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

static inline struct answer answer_of(const struct slip *slip, double trace)
{
    const double *w = slip->w;
    double det = slip->S_11 * slip->S_22 - slip->S_12 * slip->S_12, none = 1e-11 * trace;
    double u[2] = {slip->S_22 * w[0] - slip->S_12 * w[1], slip->S_11 * w[1] - slip->S_12 * w[0]};
    if (det > none * trace) return (struct answer){{u[0], u[1]}, {w[0], w[1]}, det, trace, 1.0};
    if (dot2(u, u) > none * none * dot2(w, w)) return (struct answer){{u[0], u[1]}, {w[0], w[1]}, 0.0, trace, 1.0};
    return (struct answer){{w[0], w[1]}, {0.0, 0.0}, trace, 1.0, 0.0};
}

static inline void answer_at(const struct answer *a, double gamma, double t[2])
{
    double below = -(a->p + gamma * (a->r + gamma * a->z));
    for (int i = 0; i < 2; i++) t[i] = (a->u[i] + a->e[i] * gamma) / below;
}

/* Friction: it holds the pad where it can, else it has its limit and opposes the velocity. */
static inline void slip_friction(const struct slip *slip, double t[2])
{
    const double *w = slip->w, *c = slip->c, mu = slip->mu, n = slip->n;
    double limit = mu * n, trace = slip->S_11 + slip->S_22, square = dot2(w, w), speed = sqrt(square);
    t[0] = t[1] = 0.0;
    if (limit <= FLOOR || speed <= FLOOR) return;
    if (trace <= 0.0) {
        for (int i = 0; i < 2; i++) t[i] = w[i] * -(limit / speed);
        return;
    }
    struct answer answer = answer_of(slip, trace);
    if (answer.p > 0.0) {
        answer_at(&answer, 0.0, t);
        double most = mu * (n - dot2(c, t));
        if (most >= 0.0 && dot2(t, t) <= most * most) return;
    }
    double fast = speed / limit, most = mu * (n + dot2(c, w) / fast);
    double Sw[2] = {slip->S_11 * w[0] + slip->S_12 * w[1], slip->S_12 * w[0] + slip->S_22 * w[1]};
    double gamma = (most > 0.0 ? speed / most : fast) - dot2(w, Sw) / square;
    if (gamma <= 0.0) gamma = answer.p > 0.0 ? 0.0 : 0.5 * fast;
    double low = 0.0, high = INFINITY;
    for (int round = 0; round < 80; round++) {
        double inverse = 1.0 / (answer.p + gamma * (answer.r + gamma * answer.z)), slope[2];
        for (int i = 0; i < 2; i++) {
            t[i] = (answer.u[i] + answer.e[i] * gamma) * -inverse;
            slope[i] = (answer.e[i] + t[i] * (answer.r + 2.0 * gamma * answer.z)) * -inverse;
        }
        double size = sqrt(dot2(t, t)), most_now = mu * (n - dot2(c, t)), over = size - most_now;
        if (over > 0.0)
            low = gamma;
        else
            high = gamma;
        double rise = -mu * dot2(c, slope) - most_now / size * (dot2(t, slope) / size);
        double next = gamma + (rise > 0.0 ? over / rise : -1.0);
        if (rise > 0.0 && next > low && next <= high)
            gamma = next;
        else
            gamma = high < INFINITY ? 0.5 * (low + high) : 2.0 * gamma + fast;
        if (fabs(over) <= 1e-8 * size) break;
    }
    answer_at(&answer, gamma, t);
}

#endif
