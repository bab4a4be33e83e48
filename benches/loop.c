/* What a coupled macro step costs without any engine: `raw_loop` is what one writes by hand for the testbed's pair, recording
 * included; the `empty_` functions are an FMU that does nothing, so that what is left is the engine's own. */

#include <stddef.h>
#include <stdint.h>

typedef int (*transfer)(void *, const uint32_t *, size_t, void *);
typedef int (*step_function)(void *, double, double, int);

/* An FMU of the pair. Rows of reals and of whole numbers (Integers, Booleans), one for each communication point. */
struct fmu {
    void *instance;
    step_function do_step;
    transfer set_real, get_real, get_integer, get_boolean;
    const uint32_t *inputs, *reals, *integers, *booleans;
    size_t inputs_count, reals_count, integers_count, booleans_count;
    double *input_rows, *real_rows;
    int32_t *integer_rows, *boolean_rows;
};

static int recorded(struct fmu *f, size_t row) {
    if (f->get_real(f->instance, f->reals, f->reals_count, f->real_rows + row * f->reals_count)) return 1;
    if (f->integers_count &&
        f->get_integer(f->instance, f->integers, f->integers_count, f->integer_rows + row * f->integers_count))
        return 1;
    return f->booleans_count &&
           f->get_boolean(f->instance, f->booleans, f->booleans_count, f->boolean_rows + row * f->booleans_count);
}

/* Controller, then plant: q of the last step goes to the controller, tau_a of this one to the plant. `q_in`, `tau_in` are the
 * columns among the inputs, `q_out`, `tau_out` among the recorded reals; the clock stands at step `first`. Returns the step
 * that failed, or -1. */
long raw_loop(struct fmu *controller, struct fmu *plant, size_t q_in, size_t q_out, size_t tau_in, size_t tau_out,
              size_t first, size_t steps, double h) {
    for (size_t k = 0; k < steps; k++) {
        double t = (double)(first + k) * h;
        double *u = controller->input_rows + k * controller->inputs_count;
        u[q_in] = plant->real_rows[k * plant->reals_count + q_out];
        if (controller->set_real(controller->instance, controller->inputs, controller->inputs_count, u)) return (long)k;
        if (controller->do_step(controller->instance, t, h, 1)) return (long)k;
        if (recorded(controller, k + 1)) return (long)k;
        double *v = plant->input_rows + k * plant->inputs_count;
        v[tau_in] = controller->real_rows[(k + 1) * controller->reals_count + tau_out];
        if (plant->set_real(plant->instance, plant->inputs, plant->inputs_count, v)) return (long)k;
        if (plant->do_step(plant->instance, t, h, 1)) return (long)k;
        if (recorded(plant, k + 1)) return (long)k;
    }
    return -1;
}

/* One FMU by itself: each row of inputs is set, each row of outputs taken. Returns the step that failed, or -1. */
long alone(struct fmu *f, size_t steps, double h) {
    for (size_t k = 0; k < steps; k++) {
        if (f->inputs_count && f->set_real(f->instance, f->inputs, f->inputs_count, f->input_rows + k * f->inputs_count))
            return (long)k;
        if (f->do_step(f->instance, (double)k * h, h, 1)) return (long)k;
        if (recorded(f, k + 1)) return (long)k;
    }
    return -1;
}

int empty_transfer(void *instance, const uint32_t *references, size_t count, void *values) {
    (void)instance, (void)references, (void)count, (void)values;
    return 0;
}

int empty_step(void *instance, double t, double h, int no_rollback) {
    (void)instance, (void)t, (void)h, (void)no_rollback;
    return 0;
}
