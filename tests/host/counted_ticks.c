/* Ticks of the C library, for callgrind to count (`cargo xtask bench`): at the start values, with the inputs of the FMUs'
 * start. After some ticks that nobody counts there are 1,000 of the arm and 1,000 of one axis at rest, then as many of each
 * with a hand that pushes and a robot that moves. `counted_part` ends each part. Exit code 2 when a tick is refused, 3 when
 * a moving law exerts no force.
 */
#include "exo_law.h"

enum { WARM_UP = 100, TICKS = 1000 };

__attribute__((noinline)) void counted_part(void)
{
    __asm__ volatile("");
}

/* A triangle of period 40 and height 1. */
static double triangle(int n)
{
    int phase = n % 40;
    return (phase < 10 ? phase : phase < 30 ? 20 - phase : phase - 40) / 10.0;
}

int main(void)
{
    static exo_arm_parameters arm_parameters;
    static exo_arm_state arm;
    static exo_arm_inputs arm_inputs = {.q = {0.0, -1.48096, 1.70138}, .ft_valid = 1, .encoder_valid = 1, .engage = 1};
    static exo_arm_outputs arm_outputs;
    static exo_axis_parameters axis_parameters;
    static exo_axis_state axis;
    static exo_axis_inputs axis_inputs = {.engage = 1, .encoder_valid = 1};
    static exo_axis_outputs axis_outputs;

    int refused = exo_arm_defaults(&arm_parameters) || exo_arm_init(&arm, &arm_parameters, 0);
    refused |= exo_axis_defaults(&axis_parameters) || exo_axis_init(&axis, &axis_parameters, 0);
    for (int n = 0; n < WARM_UP; n++) {
        refused |= exo_arm_tick(&arm, &arm_inputs, &arm_outputs, 0);
        refused |= exo_axis_tick(&axis, &axis_inputs, &axis_outputs, 0);
    }
    counted_part();
    for (int n = 0; n < TICKS; n++) refused |= exo_arm_tick(&arm, &arm_inputs, &arm_outputs, 0);
    counted_part();
    for (int n = 0; n < TICKS; n++) refused |= exo_axis_tick(&axis, &axis_inputs, &axis_outputs, 0);
    counted_part();

    int still = 0;
    for (int n = 0; n < TICKS; n++) {
        arm_inputs.q[1] = -1.48096 + 0.002 * triangle(n);
        for (int i = 0; i < 3; i++) arm_inputs.f_h[i] = 20.0 * triangle(n + 7 * i);
        refused |= exo_arm_tick(&arm, &arm_inputs, &arm_outputs, 0);
        still |= n > 0 && arm_outputs.tau_a[1] == 0.0;
    }
    counted_part();
    for (int n = 0; n < TICKS; n++) {
        axis_inputs.q = 0.002 * triangle(n);
        axis_inputs.tau_h = 20.0 * triangle(n + 7);
        refused |= exo_axis_tick(&axis, &axis_inputs, &axis_outputs, 0);
        still |= n > 0 && axis_outputs.tau_a == 0.0;
    }
    counted_part();
    return refused ? 2 : still ? 3 : 0;
}
