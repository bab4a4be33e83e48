/* The loops that are measured: law and arm in C over recorded inputs, and an FMU over the same ones; each makes the steps
 * `first` to before `end` of h (s), and returns the one that failed, or -1. callgrind counts inside them. */
#include "arm_law.h"
#include "arm_plant.h"

/* valgrind's own header: without it nothing can be counted, and nobody asks for it. */
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_DUMP_STATS
#endif

static bool counts;

/* Whether callgrind is to count in the loops that follow, each into a file of its own. */
void count_calls(int whether) { counts = whether; }

static void begins(void)
{
    if (counts) {
        CALLGRIND_START_INSTRUMENTATION;
    }
}

static long ended(long failed)
{
    if (counts) {
        CALLGRIND_DUMP_STATS;
        CALLGRIND_STOP_INSTRUMENTATION;
    }
    return failed;
}

typedef int (*transfer)(void *, const uint32_t *, size_t, void *);
typedef int (*step_function)(void *, double, double, int);

/* An FMU with the references of what is set and what is read; inputs lie row by row, outputs have room for one row. */
struct fmu {
    void *instance;
    step_function do_step;
    transfer set_real, set_boolean, get_real, get_integer, get_boolean;
    const uint32_t *inputs, *switches, *reals, *integers, *booleans;
    size_t inputs_count, switches_count, reals_count, integers_count, booleans_count;
    double *input_rows;
    int32_t *switch_rows;
    double *real_row;
    int32_t *integer_row, *boolean_row;
};

/* Set, step, get. */
long fmu_cycles(const struct fmu *f, size_t first, size_t end, double h)
{
    begins();
    for (size_t k = first; k < end; k++) {
        int32_t *on = f->switch_rows + k * f->switches_count;
        if (f->set_real(f->instance, f->inputs, f->inputs_count, f->input_rows + k * f->inputs_count)) return (long)k;
        if (f->switches_count && f->set_boolean(f->instance, f->switches, f->switches_count, on)) return (long)k;
        if (f->do_step(f->instance, (double)k * h, h, 1)) return (long)k;
        if (f->get_real(f->instance, f->reals, f->reals_count, f->real_row)) return (long)k;
        if (f->integers_count && f->get_integer(f->instance, f->integers, f->integers_count, f->integer_row)) return (long)k;
        if (f->booleans_count && f->get_boolean(f->instance, f->booleans, f->booleans_count, f->boolean_row)) return (long)k;
    }
    return ended(-1);
}

/* The law with rows of q and f_h. Outputs go to `outputs`, the next ones `stride` structs further on. */
long law_cycles(struct arm_law *law, const double *sensed, const int32_t *unused, size_t first, size_t end, double h,
                struct arm_law_outputs *outputs, size_t stride)
{
    struct arm_law_inputs in = {.engage = 1, .ft_valid = 1, .encoder_valid = 1};
    (void)unused, (void)h;
    begins();
    for (size_t k = first; k < end; k++, outputs += stride) {
        for (int i = 0; i < 3; i++) in.q[i] = sensed[6 * k + i], in.f_h[i] = sensed[6 * k + 3 + i];
        if (arm_law_tick(law, &in, outputs) != ARM_LAW_OK) return (long)k;
    }
    return ended(-1);
}

/* The arm with rows of tau_a, f_h and f_d, and the vacuum's switch. */
long plant_cycles(struct arm_plant *arm, const double *forces, const int32_t *vacuum, size_t first, size_t end, double h,
                  struct arm_plant_outputs *outputs, size_t stride)
{
    struct arm_plant_inputs in;
    begins();
    for (size_t k = first; k < end; k++, outputs += stride) {
        memcpy(&in, forces + 9 * k, 9 * sizeof *forces);
        in.vacuum = vacuum[k];
        if (arm_plant_step(arm, &in, h, outputs) != ARM_PLANT_OK) return (long)k;
    }
    return ended(-1);
}

size_t plant_size(void) { return sizeof(struct arm_plant); }

size_t law_size(void) { return sizeof(struct arm_law); }
