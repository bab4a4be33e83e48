/* Ticks of the law in a thread with the smallest stack that the system gives, as a controller's thread may have: 16 kB with
 * glibc on x86-64, of which it keeps some for itself. The law is made outside of it. Exit code 0 when all ticks were made.
 *
 * Each case has its own: task space, joint space, supervision, and an energy budget that acts. Below the stack lies a page
 * that nobody may touch, so that a stack which is too small ends the program.
 */
#include "exo_law.h"
#include <pthread.h>
#include <stdio.h>

enum { TICKS = 600 };

static exo_arm_state law;
static exo_axis_state axis;
static int refused;

static void *ticks(void *unused)
{
    static exo_arm_inputs in;
    static exo_arm_outputs out;
    static exo_axis_inputs axis_in;
    static exo_axis_outputs axis_out;
    exo_arm_inputs_defaults(&in);
    exo_axis_inputs_defaults(&axis_in);
    for (int tick = 0; tick < TICKS; tick++) {
        in.f_h[2] = (exo_real)(tick % 200 < 100 ? 20 : -20);
        in.q[1] = -1.48096 + (tick % 3) * 1e-3;
        in.engage = tick >= 80;
        in.enable = 1;
        in.heartbeat = tick;
        in.emergency_stop = tick >= 560;
        axis_in.q = (tick % 3) * 4e-3;
        if (exo_arm_tick(&law, &in, &out, NULL) != EXO_STATUS_OK) refused++;
        if (exo_axis_tick(&axis, &axis_in, &axis_out, NULL) != EXO_STATUS_OK) refused++;
    }
    return unused;
}

static int in_a_thread(int space, int supervised)
{
    exo_arm_parameters parameters;
    exo_axis_parameters axis_parameters;
    pthread_attr_t with;
    pthread_t thread;
    exo_arm_defaults(&parameters);
    parameters.space = space;
    parameters.supervision = supervised;
    parameters.supervisor.init_time = (exo_real)0.0625;
    parameters.E_0 = (exo_real)0.0625;
    exo_axis_defaults(&axis_parameters);
    axis_parameters.E_0 = (exo_real)0.0625;
    if (exo_arm_init(&law, &parameters, NULL) != EXO_STATUS_OK) return 1;
    if (exo_axis_init(&axis, &axis_parameters, NULL) != EXO_STATUS_OK) return 1;
    pthread_attr_init(&with);
    if (pthread_attr_setstacksize(&with, 16384) || pthread_create(&thread, &with, ticks, NULL)) return 1;
    pthread_join(thread, NULL);
    return refused != 0;
}

int main(void)
{
    for (int supervised = 0; supervised < 2; supervised++) {
        if (in_a_thread(EXO_SPACE_TASK, supervised) || in_a_thread(EXO_SPACE_JOINT, supervised)) return 1;
    }
    puts("all ticks in 16384 bytes");
    return 0;
}
