/* How much stack the functions of the law's library take: the stack below a call is painted, and looked at afterwards.
 *
 * Only where MEASURE_STACK is defined; elsewhere nothing is done. Its value says how many bytes are painted. Elsewhere than
 * on a bare Arm all of it runs in a thread, whose stack has as many and some for the system.
 */
enum measured { ARM_INIT, ARM_TUNE, ARM_TICK, AXIS_INIT, AXIS_TICK, MEASURED };

#if !defined(MEASURE_STACK)
#define paint() ((void)0)
#define look(function) ((void)0)
#else

enum { PAINT = 0xa5 };

static const char *const names[MEASURED] = {"exo_arm_init", "exo_arm_tune", "exo_arm_tick", "exo_axis_init", "exo_axis_tick"};
static size_t deepest[MEASURED];
static unsigned char *bottom; /* of the stack */

__attribute__((noinline)) static void paint(void)
{
    /* The bytes just below the caller are this function's own. */
    volatile unsigned char *to = (unsigned char *)__builtin_frame_address(0) - 128;
    for (volatile unsigned char *at = bottom; at < to; at++) *at = PAINT;
}

__attribute__((noinline)) static void looked(enum measured function, const unsigned char *caller)
{
    const volatile unsigned char *lowest = bottom;
    while (lowest < caller && *lowest == PAINT) lowest++;
    if ((size_t)(caller - lowest) > deepest[function]) deepest[function] = (size_t)(caller - lowest);
}

/* In the function that has called: from its frame on, so that the call and the passing of its arguments are counted. */
#define look(function) looked(function, (const unsigned char *)__builtin_frame_address(0))

#endif
