/* The implicit velocity problem of a substep: guess which forces hold, solve what remains, revise the guess. */
#ifndef ARM_SOLVE_H
#define ARM_SOLVE_H

#include "arm_disc.h"
#include "arm_plant.h"

/* Table and wall: axis of the normal, axes of the plane, direction of the push. */
static const int NORMAL[2] = {2, 0}, PLANE[2][2] = {{0, 1}, {1, 2}};
static const double SIGN[2] = {1.0, -1.0};

/* A v = b + friction and stops of the joints + J' (friction and normals of the surfaces). */
struct problem {
    double A[3][3], b[3], J[3][3];
    double dry[3], low[3], high[3];           /* joints */
    double push[2], kappa_dt[2], mu[2];       /* surfaces */
};

struct solution {
    double v[3], joint[3], normal[2], tangent[3];
};

static inline double pressure(const struct problem *problem, int k, const double w[3])
{
    return problem->push[k] - problem->kappa_dt[k] * SIGN[k] * w[NORMAL[k]];
}

static inline void inverted(double out[3][3], const double M[3][3])
{
    double a = M[1][1] * M[2][2] - M[2][1] * M[1][2];
    double b = M[1][0] * M[2][2] - M[2][0] * M[1][2];
    double c = M[1][0] * M[2][1] - M[2][0] * M[1][1];
    double det = M[0][0] * a - M[0][1] * b + M[0][2] * c;
    if (det == 0.0) {
        memset(out, 0, 9 * sizeof(double));
        return;
    }
    out[0][0] = a / det;
    out[0][1] = (M[0][2] * M[2][1] - M[2][2] * M[0][1]) / det;
    out[0][2] = (M[0][1] * M[1][2] - M[1][1] * M[0][2]) / det;
    out[1][0] = -b / det;
    out[1][1] = (M[0][0] * M[2][2] - M[2][0] * M[0][2]) / det;
    out[1][2] = (M[0][2] * M[1][0] - M[1][2] * M[0][0]) / det;
    out[2][0] = c / det;
    out[2][1] = (M[0][1] * M[2][0] - M[2][1] * M[0][0]) / det;
    out[2][2] = (M[0][0] * M[1][1] - M[1][0] * M[0][1]) / det;
}

/* Friction of surface k alone on a pad that would move at w without it. */
static inline void rubbed(double friction[3], const struct problem *problem, int k, const double S[3][3], const double w[3])
{
    int i = PLANE[k][0], j = PLANE[k][1], normal = NORMAL[k];
    double stiff = problem->kappa_dt[k] * SIGN[k], t[2];
    struct slip slip = {S[i][i], S[i][j], S[j][j], {w[i], w[j]}, pressure(problem, k, w),
                        {S[normal][i] * stiff, S[normal][j] * stiff}, problem->mu[k]};
    slip_friction(&slip, t);
    friction[0] = friction[1] = friction[2] = 0.0;
    friction[i] = t[0], friction[j] = t[1];
}

/* Adds friction of the surface that pushes to a solution without it. */
static __attribute__((noinline)) void rub(const struct problem *problem, const bool pushes[2], const double inverse[3][3],
                                          const double J_free[3][3], struct solution *found)
{
    double spread[3][3], S[3][3], w[3], friction[3], moved[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            spread[i][j] = inverse[i][0] * J_free[j][0] + inverse[i][1] * J_free[j][1] + inverse[i][2] * J_free[j][2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            S[i][j] = J_free[i][0] * spread[0][j] + J_free[i][1] * spread[1][j] + J_free[i][2] * spread[2][j];
    int k = pushes[0] ? 0 : 1;
    times(w, problem->J, found->v);
    rubbed(friction, problem, k, S, w);
    for (int i = 0; i < 3; i++) friction[i] += 0.0; /* the other surface's */
    times(moved, spread, friction);
    for (int i = 0; i < 3; i++) found->v[i] += moved[i];
    times(w, problem->J, found->v);
    double n = found->normal[k] = pressure(problem, k, w);
    double most_of = problem->mu[k] * most(n, 0.0), square = dot3(friction, friction);
    double part = square > most_of * most_of ? most_of / sqrt(square) : 1.0;
    for (int i = 0; i < 3; i++) found->tangent[i] = friction[i] * part;
}

/* What remains of the problem when the guess is taken for granted. */
static inline void solve_guessed(const struct problem *problem, const enum motion guess[3], const bool pushes[2],
                                 struct solution *found)
{
    double K[3][3], r[3], at[3] = {0.0}, slide[3] = {0.0}, K_free[3][3], J_free[3][3], inverse[3][3], still[3], r_free[3];
    bool held[3];
    memcpy(K, problem->A, sizeof K);
    memcpy(r, problem->b, sizeof r);
    for (int k = 0; k < 2; k++) {
        if (!pushes[k]) continue;
        const double *d = problem->J[NORMAL[k]];
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) K[i][j] += d[i] * (d[j] * problem->kappa_dt[k]);
            r[i] += d[i] * (SIGN[k] * problem->push[k]);
        }
    }
    for (int i = 0; i < 3; i++) {
        held[i] = guess[i] != FORWARD && guess[i] != BACKWARD;
        if (guess[i] == HIGH) at[i] = problem->high[i];
        if (guess[i] == LOW) at[i] = problem->low[i];
        if (guess[i] == FORWARD) slide[i] = -problem->dry[i];
        if (guess[i] == BACKWARD) slide[i] = problem->dry[i];
    }
    memcpy(K_free, K, sizeof K);
    memcpy(J_free, problem->J, sizeof J_free);
    for (int i = 0; i < 3; i++) {
        if (!held[i]) continue;
        for (int other = 0; other < 3; other++) K_free[other][i] = K_free[i][other] = J_free[other][i] = 0.0;
        K_free[i][i] = 1.0;
    }
    inverted(inverse, K_free);
    times(still, K, at);
    for (int i = 0; i < 3; i++) r_free[i] = held[i] ? at[i] : r[i] + slide[i] - still[i];
    times(found->v, inverse, r_free);
    found->normal[0] = found->normal[1] = 0.0;
    found->tangent[0] = found->tangent[1] = found->tangent[2] = 0.0;
    double needed[3], back[3] = {0.0};
    if (pushes[0] || pushes[1]) {
        rub(problem, pushes, inverse, J_free, found);
        turned_times(back, problem->J, found->tangent);
    }
    times(needed, K, found->v);
    for (int i = 0; i < 3; i++) found->joint[i] = held[i] ? needed[i] - r[i] - back[i] : slide[i];
}

static inline double least_held(const struct problem *p, int i) { return p->high[i] > 0.0 ? -p->dry[i] : -INFINITY; }
static inline double most_held(const struct problem *p, int i) { return p->low[i] < 0.0 ? p->dry[i] : INFINITY; }

/* The motion of joint i that follows from its velocity and impulse. */
static inline enum motion moves(const struct problem *p, int i, enum motion motion, const struct solution *found,
                                double rounding, double rounding_v)
{
    double v = found->v[i], impulse = found->joint[i];
    switch (motion) {
    case FORWARD:
        if (v < -rounding_v) return HELD;
        return v > p->high[i] + rounding_v ? (p->high[i] == 0.0 ? HELD : HIGH) : FORWARD;
    case BACKWARD:
        if (v > rounding_v) return HELD;
        return v < p->low[i] - rounding_v ? (p->low[i] == 0.0 ? HELD : LOW) : BACKWARD;
    case HELD:
        if (impulse < least_held(p, i) - rounding) return FORWARD;
        return impulse > most_held(p, i) + rounding ? BACKWARD : HELD;
    case HIGH: return impulse > -p->dry[i] + rounding ? FORWARD : HIGH;
    default: return impulse < p->dry[i] - rounding ? BACKWARD : LOW;
    }
}

/* Revises the guess where its solution contradicts it; `singly` in the first place only. */
static inline bool revise(const struct problem *problem, const struct solution *found, double rounding,
                          const double rounding_v[3], enum motion guess[3], bool pushes[2], bool singly)
{
    double w[3];
    bool revised = false;
    times(w, problem->J, found->v);
    for (int k = 0; k < 2; k++) {
        double n = pressure(problem, k, w);
        bool next = pushes[k] ? !(n < -rounding) : n > rounding;
        revised |= next != pushes[k];
        pushes[k] = next;
        if (singly && revised) return true;
    }
    for (int i = 0; i < 3; i++) {
        enum motion next = moves(problem, i, guess[i], found, rounding, rounding_v[i]);
        revised |= next != guess[i];
        guess[i] = next;
        if (singly && revised) return true;
    }
    return revised;
}

/* Solves the problem from the last guess, and leaves the right one there. */
static inline int solve(const struct problem *problem, enum motion guess[3], bool pushes[2], struct solution *found)
{
    double scale = most(most(fabs(problem->b[0]), fabs(problem->b[1])), fabs(problem->b[2])), rounding_v[3];
    for (int i = 0; i < 3; i++) scale = most(scale, problem->dry[i]);
    for (int k = 0; k < 2; k++) scale = most(scale, problem->push[k]);
    double rounding = 1e-14 * scale;
    for (int i = 0; i < 3; i++) rounding_v[i] = rounding / problem->A[i][i];
    int round = 0;
    for (;; round++) {
        if (round == 40 || (pushes[0] && pushes[1])) return ARM_PLANT_ELSEWHERE;
        solve_guessed(problem, guess, pushes, found);
        if (!revise(problem, found, rounding, rounding_v, guess, pushes, round >= 10)) break;
    }
    for (int i = 0; i < 3; i++) {
        double *v = &found->v[i], *impulse = &found->joint[i];
        switch (guess[i]) {
        case FORWARD: *v = least(most(*v, 0.0), problem->high[i]); break;
        case BACKWARD: *v = most(least(*v, 0.0), problem->low[i]); break;
        case HELD: *impulse = least(most(*impulse, least_held(problem, i)), most_held(problem, i)); break;
        case HIGH: *impulse = least(*impulse, -problem->dry[i]); break;
        default: *impulse = most(*impulse, problem->dry[i]);
        }
    }
    for (int k = 0; k < 2 && (pushes[0] || pushes[1]); k++) found->normal[k] = most(found->normal[k], 0.0);
    return ARM_PLANT_OK;
}

#endif
