/* The same tick of the C library again and again, for callgrind to count (`cargo xtask bench`): at the start values, with the
 * inputs of the FMUs' start. After some ticks that nobody counts there are 1,000 of the arm, then 1,000 of one axis.
 * `counted_part` ends each part. Exit code 2 when a tick is refused.
 */
#include "exo_law.h"

enum { WARM_UP = 100, TICKS = 1000 };

__attribute__((noinline)) void counted_part(void)
{
    __asm__ volatile("");
}

int main(void)
{
    static exo_arm_parameters arm_parameters;
    static exo_arm_state arm;
    static exo_arm_inputs arm_inputs = {.q = {0.0, -1.48096, 1.70138}, .ft_valid = 1, .engage = 1};
    static exo_arm_outputs arm_outputs;
    static exo_axis_parameters axis_parameters;
    static exo_axis_state axis;
    static exo_axis_inputs axis_inputs = {.engage = 1};
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
    return refused ? 2 : 0;
}
