/* The law alone, run where it is to run: one program for any processor, with or without an operating system.
 *
 * It closes a loop around each law, with joints (an axis) of mass and damper pushed by a hand, and prints every output of every
 * tick as its bits. Two machines agree when the texts are equal. Built with EXO_LAW_F32 it runs the library in single
 * precision. Exit code 0 when the run went through, 2 when a promise that needs no second machine is broken, which
 * `broken:` lines name.
 *
 * On a bare Arm it starts at `start` and writes through semihosting; elsewhere it is a program like any other. It must be
 * compiled with -ffp-contract=off: a sum of products rounded once is another number.
 *
 * With MEASURE_STACK, a size in bytes, it prints instead how much stack each function of the library took at most.
 */
#define _GNU_SOURCE /* pthread.h, where a stack is measured */
#include "exo_law.h"
#include <stddef.h>
#include <stdint.h>
#include "stack.h"

/* ---- where the text goes ---- */

#if defined(__arm__)
/* https://github.com/ARM-software/abi-aa, semihosting: operation in r0, its arguments in r1. */
static int semihost(int operation, const void *arguments)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = arguments;
    __asm__ volatile("svc 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

enum { SYS_OPEN = 0x01, SYS_WRITE = 0x05, SYS_EXIT_EXTENDED = 0x20, FOR_WRITING = 4, STOPPED = 0x20026 };

static void write_text(const char *text, size_t length)
{
    static int handle = -1;
    if (handle < 0) {
        const struct { const char *name; int mode; size_t length; } standard_output = {":tt", FOR_WRITING, 3};
        handle = semihost(SYS_OPEN, &standard_output);
    }
    const struct { int handle; const char *text; size_t length; } block = {handle, text, length};
    semihost(SYS_WRITE, &block);
}

static int run_all(void);

void start(void)
{
#if defined(MEASURE_STACK)
    bottom = (unsigned char *)__builtin_frame_address(0) - MEASURE_STACK;
#endif
    const struct { int reason, code; } how = {STOPPED, run_all()};
    semihost(SYS_EXIT_EXTENDED, &how);
    for (;;) {
    }
}
#else
#include <stdio.h>

static void write_text(const char *text, size_t length)
{
    fwrite(text, 1, length, stdout);
}

static int run_all(void);

#if defined(MEASURE_STACK)
#include <pthread.h>

static void *in_a_thread(void *result)
{
    bottom = (unsigned char *)__builtin_frame_address(0) - MEASURE_STACK;
    *(int *)result = run_all();
    return NULL;
}

int main(void)
{
    pthread_attr_t with;
    pthread_t thread;
    int result = 1;
    pthread_attr_init(&with);
    /* The system has some of it for itself. */
    if (pthread_attr_setstacksize(&with, MEASURE_STACK + 32768)) return 1;
    if (pthread_create(&thread, &with, in_a_thread, &result)) return 1;
    pthread_join(thread, NULL);
    return result;
}
#else
int main(void)
{
    return run_all();
}
#endif
#endif

static char line[8192];
static size_t used;

static void put(char c)
{
    if (used < sizeof line) line[used++] = c;
}

static void word(const char *text)
{
    while (*text) put(*text++);
}

static void end_line(void)
{
    put('\n');
    write_text(line, used);
    used = 0;
}

#if defined(MEASURE_STACK)
static void number(size_t value)
{
    if (value > 9) number(value / 10);
    put((char)('0' + value % 10));
}

static void print_stack(void)
{
    used = 0; /* the bits of the last ticks are the other program's */
    for (int i = 0; i < MEASURED; i++) {
        word(names[i]);
        put(' ');
        number(deepest[i]);
        end_line();
    }
}
#endif

#if !defined(MEASURE_STACK)
static void bits(const void *from, size_t size)
{
    uint64_t value = 0;
    if (size == 8) value = *(const uint64_t *)from;
    else value = *(const uint32_t *)from;
    put(' ');
    for (int digit = (int)size * 2 - 1; digit >= 0; digit--) put("0123456789abcdef"[value >> (4 * digit) & 15]);
}
#endif

static int broken;

static void expect(int good, const char *promise)
{
    if (good) return;
    broken = 1;
    word("broken: ");
    word(promise);
    end_line();
}

/* ---- the calls, whose stack can be measured ---- */

__attribute__((noinline)) static exo_status init_arm(exo_arm_state *law, const exo_arm_parameters *given, exo_refusal *refusal)
{
    paint();
    exo_status status = exo_arm_init(law, given, refusal);
    look(ARM_INIT);
    return status;
}

__attribute__((noinline)) static exo_status tune_arm(exo_arm_state *law, const exo_arm_parameters *given, exo_refusal *refusal)
{
    paint();
    exo_status status = exo_arm_tune(law, given, refusal);
    look(ARM_TUNE);
    return status;
}

__attribute__((noinline)) static exo_status tick_arm(exo_arm_state *law, const exo_arm_inputs *in, exo_arm_outputs *out,
                                                     exo_refusal *refusal)
{
    paint();
    exo_status status = exo_arm_tick(law, in, out, refusal);
    look(ARM_TICK);
    return status;
}

__attribute__((noinline)) static exo_status init_axis(exo_axis_state *law, const exo_axis_parameters *given,
                                                      exo_refusal *refusal)
{
    paint();
    exo_status status = exo_axis_init(law, given, refusal);
    look(AXIS_INIT);
    return status;
}

__attribute__((noinline)) static exo_status tick_axis(exo_axis_state *law, const exo_axis_inputs *in, exo_axis_outputs *out,
                                                      exo_refusal *refusal)
{
    paint();
    exo_status status = exo_axis_tick(law, in, out, refusal);
    look(AXIS_TICK);
    return status;
}

/* Every output, in the order of the library's description of its structs. */
static void dump(const void *outputs, exo_status (*describe)(size_t, exo_variable *))
{
#if defined(MEASURE_STACK)
    (void)outputs, (void)describe; /* not to be compared */
#else
    exo_variable variable;
    for (size_t n = 0; describe(n, &variable) == EXO_STATUS_OK; n++) {
        if (variable.role != EXO_ROLE_OUTPUT) continue;
        size_t size = variable.kind == EXO_KIND_INTEGER ? sizeof(int32_t) : sizeof(exo_real);
        for (int i = 0; i < variable.count; i++) {
            bits((const char *)outputs + variable.offset + (size_t)i * variable.stride, size);
        }
    }
    end_line();
#endif
}

/* A triangle of height 1 and period 400, in steps of 0.01: each value is one correctly rounded division. */
static double triangle(int n)
{
    int phase = n % 400;
    return (phase < 100 ? phase : phase < 300 ? 200 - phase : phase - 400) / 100.0;
}

/* ---- the arm ---- */

enum { TICKS = 600 };

typedef struct {
    double q[3], dq[3];
} arm;

/* What differs between the runs of the arm; `law` and `space` by their numbers in the FMU. */
typedef struct {
    const char *name;
    int law, space, supervised;
    double shake; /* of the sensed angles, rad: takes energy from the tank until the budget acts */
} arm_case;

static void arm_tick(exo_arm_state *law, arm *robot, const exo_arm_parameters *parameters, const arm_case *which, int n)
{
    static exo_arm_outputs out;
    exo_arm_inputs in;
    exo_refusal refusal;
    exo_arm_inputs_defaults(&in);
    for (int i = 0; i < 3; i++) {
        in.q[i] = robot->q[i] + which->shake * triangle(97 * n);
        in.f_h[i] = (exo_real)(15.0 * triangle(n + 130 * i));
    }
    in.engage = n >= 80;
    in.hold = n >= 420 && n < 450;
    in.enable = 1;
    in.heartbeat = n;
    in.emergency_stop = n >= 560;
    expect(tick_arm(law, &in, &out, &refusal) == EXO_STATUS_OK, "a tick of the arm is made");
    dump(&out, exo_arm_variable);
    for (int i = 0; i < 3; i++) {
        double torque = (double)out.tau_a[i] + 5.0 * triangle(n) - 8.0 * robot->dq[i];
        robot->dq[i] += (double)parameters->T * torque / 2.5;
        robot->q[i] += (double)parameters->T * robot->dq[i];
    }
}

static void run_arm(const arm_case *which)
{
    static const arm home = {{0.0, -1.48096, 1.70138}, {0.0, 0.0, 0.0}};
    static exo_arm_state state, kept;
    exo_arm_parameters parameters;
    exo_refusal refusal;
    word("arm, ");
    word(which->name);
    end_line();
    exo_arm_defaults(&parameters);
    parameters.law = which->law;
    parameters.space = which->space;
    parameters.supervision = which->supervised;
    parameters.supervisor.init_time = (exo_real)0.0625;
    parameters.supervisor.engage_time = (exo_real)0.125;
    for (int i = 0; i < 3; i++) parameters.tau_max[i] = 25;
    if (which->shake > 0.0) parameters.E_0 = (exo_real)0.0625;
    expect(init_arm(&state, &parameters, &refusal) == EXO_STATUS_OK, "the arm's law begins");

    arm robot = home;
    for (int n = 0; n < 300; n++) arm_tick(&state, &robot, &parameters, which, n);
    for (int i = 0; i < 3; i++) parameters.K[i] *= 2;
    expect(tune_arm(&state, &parameters, &refusal) == EXO_STATUS_OK, "other gains are taken");
    arm before = robot;
    kept = state;
    for (int n = 300; n < 350; n++) arm_tick(&state, &robot, &parameters, which, n);
    state = kept;
    robot = before;
    for (int n = 300; n < TICKS; n++) arm_tick(&state, &robot, &parameters, which, n);

#if defined(MEASURE_STACK)
    /* What is refused goes other ways. */
    exo_arm_inputs bad;
    exo_arm_outputs out;
    exo_arm_inputs_defaults(&bad);
    bad.q[1] = (double)parameters.T / 0.0 - (double)parameters.T / 0.0;
    tick_arm(&state, &bad, &out, &refusal);
    bad.engage = 2;
    expect(tick_arm(&state, &bad, &out, &refusal) == EXO_STATUS_REFUSED, "a truth of 2 is refused");
#endif
    parameters.T = 0;
    expect(init_arm(&state, &parameters, &refusal) == EXO_STATUS_REFUSED, "a sample period of 0 is refused");
    word("refused: ");
    word(refusal.name);
    word(": expected ");
    word(refusal.expected);
    end_line();
}

/* ---- one axis ---- */

static void run_axis(int law, double shake)
{
    static exo_axis_state state;
    exo_axis_parameters parameters;
    exo_axis_outputs out;
    exo_refusal refusal;
    word("axis, law ");
    put((char)('0' + law));
    word(shake > 0.0 ? ", shaken" : "");
    end_line();
    exo_axis_defaults(&parameters);
    parameters.law = law;
    if (shake > 0.0) parameters.E_0 = (exo_real)0.0625;
    expect(init_axis(&state, &parameters, &refusal) == EXO_STATUS_OK, "the axis's law begins");
    double q = 0.0, dq = 0.0;
    for (int n = 0; n < TICKS; n++) {
        exo_axis_inputs in = {q + shake * triangle(97 * n), (exo_real)(20.0 * triangle(n)), n >= 80, n >= 420 && n < 450, 1, 0};
        expect(tick_axis(&state, &in, &out, &refusal) == EXO_STATUS_OK, "a tick of the axis is made");
        dump(&out, exo_axis_variable);
        /* A wall at 0.01 m. */
        double wall = q > 0.01 ? -2e4 * (q - 0.01) - 50.0 * dq : 0.0;
        dq += (double)parameters.T * ((double)out.tau_a + (double)in.tau_h + wall - 5.0 * dq) / 10.0;
        q += (double)parameters.T * dq;
    }
}

static int run_all(void)
{
    expect(exo_law_real_size() == sizeof(exo_real), "header and library are of one precision");
    for (int law = 1; law <= 4; law++) run_axis(law, 0.0);
    run_axis(4, 0.004);
    static const arm_case cases[] = {
        {"standard", 1, 1, 0, 0.0},
        {"passive", 2, 1, 0, 0.0},
        {"passive_applied", 3, 1, 0, 0.0},
        {"passive_bounded", 4, 1, 0, 0.0},
        {"passive_bounded, shaken", 4, 1, 0, 0.001},
        {"passive_bounded in joint space", 4, 2, 0, 0.0},
        {"passive_bounded, supervised, with an emergency stop", 4, 1, 1, 0.0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) run_arm(&cases[i]);
#if defined(MEASURE_STACK)
    print_stack();
#endif
    word("end");
    end_line();
    return broken ? 2 : 0;
}
