/* What law and arm in C share: vectors and matrices of three, and elementary functions to the last digit of those that the
 * Rust side calls (the crate libm), so that results can be compared bit for bit. The sums run from left to right, as
 * nalgebra's do.
 *
 * sincos and exp are the methods of fdlibm (Sun Microsystems, 1993) with its coefficients, written anew, for the arguments
 * that occur: |x| < 2^20 pi/2 for the angles, -700 <= x <= 0 for exp. */
#ifndef ARM_MATH_H
#define ARM_MATH_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define EPSILON 0x1p-52

static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most(double a, double b) { return a < b ? b : a; }

/* x within +-bound. */
static inline double sat(double x, double bound) { return x > bound ? bound : x < -bound ? -bound : x; }

static inline double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* M v. Matrices lie row by row. */
static inline void times(double out[3], const double M[3][3], const double v[3])
{
    for (int i = 0; i < 3; i++) out[i] = M[i][0] * v[0] + M[i][1] * v[1] + M[i][2] * v[2];
}

/* M transposed times v. */
static inline void turned_times(double out[3], const double M[3][3], const double v[3])
{
    for (int i = 0; i < 3; i++) out[i] = M[0][i] * v[0] + M[1][i] * v[1] + M[2][i] * v[2];
}

static inline uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

struct sin_cos {
    double s, c;
};

static inline double sin_kernel(double x, double y, bool reduced)
{
    double z = x * x, w = z * z;
    double r = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06) +
               z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
    double v = z * x, s1 = -1.66666666666666324348e-01;
    return reduced ? x - ((z * (0.5 * y - v * r) - y) - v * s1) : x + v * (s1 + z * r);
}

static inline double cos_kernel(double x, double y)
{
    double z = x * x, w = z * z;
    double r = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05)) +
               w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
    double hz = 0.5 * z, rest = 1.0 - hz;
    return rest + (((1.0 - rest) - hz) + (z * r - x * y));
}

#define PIO2_1 1.57079632673412561417e+00
#define PIO2_1T 6.07710050650619224932e-11

/* Any multiple of pi/2 taken off; a second and a third part of pi/2 where the first leaves too few digits. */
static __attribute__((noinline)) int reduced_medium(double x, uint32_t ix, double *y0, double *y1)
{
    double to_int = 1.5 / EPSILON;
    double f = x * 6.36619772367581382433e-01 + to_int - to_int;
    double r = x - f * PIO2_1, w = f * PIO2_1T;
    int ex = (int)(ix >> 20);
    *y0 = r - w;
    if (ex - (int)(bits_of(*y0) >> 52 & 0x7ff) > 16) {
        double t = r;
        w = f * 6.07710050630396597660e-11;
        r = t - w;
        w = f * 2.02226624879595063154e-21 - ((t - r) - w);
        *y0 = r - w;
        if (ex - (int)(bits_of(*y0) >> 52 & 0x7ff) > 49) {
            t = r;
            w = f * 2.02226624871116645580e-21;
            r = t - w;
            w = f * 8.47842766036889956997e-32 - ((t - r) - w);
            *y0 = r - w;
        }
    }
    *y1 = (r - *y0) - w;
    return (int)f;
}

/* The nearest multiple n pi/2, |n| <= 4, taken off. */
static inline int reduced_by(int n, double x, double *y0, double *y1)
{
    double f = n, z = x - f * PIO2_1;
    *y0 = z - f * PIO2_1T;
    *y1 = (z - *y0) - f * PIO2_1T;
    return n;
}

static inline struct sin_cos sin_cos(double x)
{
    uint32_t high = (uint32_t)(bits_of(x) >> 32), ix = high & 0x7fffffff;
    if (ix <= 0x3fe921fb) { /* |x| <= pi/4 */
        if (ix < 0x3e46a09e) return (struct sin_cos){x, 1.0};
        return (struct sin_cos){sin_kernel(x, 0.0, false), cos_kernel(x, 0.0)};
    }
    double y0, y1;
    int n, sign = high >> 31 ? -1 : 1;
    if (ix <= 0x400f6a7a && (ix & 0xfffff) != 0x921fb)
        n = reduced_by(sign * (ix <= 0x4002d97c ? 1 : 2), x, &y0, &y1);
    else if (ix > 0x400f6a7a && ix <= 0x401c463b && ix != 0x4012d97c && ix != 0x401921fb)
        n = reduced_by(sign * (ix <= 0x4015fdbc ? 3 : 4), x, &y0, &y1);
    else
        n = reduced_medium(x, ix, &y0, &y1);
    double s = sin_kernel(y0, y1, true), c = cos_kernel(y0, y1);
    switch (n & 3) {
    case 0: return (struct sin_cos){s, c};
    case 1: return (struct sin_cos){c, -s};
    case 2: return (struct sin_cos){-s, -c};
    default: return (struct sin_cos){-c, s};
    }
}

/* e^x for -700 <= x <= 0: no result is a denormal number. */
static inline double exp_of_less(double x)
{
    uint32_t hx = (uint32_t)(bits_of(x) >> 32) & 0x7fffffff;
    double hi = x, lo = 0.0;
    int k = 0;
    if (hx > 0x3fd62e42) { /* |x| > ln 2/2 */
        k = hx >= 0x3ff0a2b2 ? (int)(1.44269504088896338700e+00 * x - 0.5) : -1;
        hi = x - (double)k * 6.93147180369123816490e-01;
        lo = (double)k * 1.90821492927058770002e-10;
        x = hi - lo;
    } else if (hx <= 0x3e300000) {
        return 1.0 + x;
    }
    double xx = x * x;
    double c = x - xx * (1.66666666666666019037e-01 +
                         xx * (-2.77777777770155933842e-03 +
                               xx * (6.61375632143793436117e-05 +
                                     xx * (-1.65339022054652515390e-06 + xx * 4.13813679705723846039e-08))));
    double y = 1.0 + (x * c / (2.0 - c) - lo + hi);
    return k == 0 ? y : y * of_bits((uint64_t)(0x3ff + k) << 52);
}

#endif
