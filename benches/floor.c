/* The FMI floor: an FMU that does nothing. It keeps what is set and gives it back, as any FMU must; a step returns at once.
 * `benches/floor.py` makes an archive of it for each of ours, with the same variables, numbered from 0 for each type. */

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#define EXPORT __attribute__((visibility("default")))

/* Variables of one type; `floor.py` says so when a description has more. */
enum { MOST = 2048 };
enum { OK, WARNING, DISCARD, ERROR };

struct floor {
    double reals[MOST];
    int32_t integers[MOST], booleans[MOST];
};

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }

EXPORT void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const void *callbacks,
                             int visible, int logging) {
    (void)guid, (void)resources, (void)callbacks, (void)visible, (void)logging;
    return name && type == 1 ? calloc(1, sizeof(struct floor)) : NULL;
}

EXPORT void fmi2FreeInstance(void *f) { free(f); }

/* What is asked for is there, or nothing is done. */
#define TRANSFER(name, type, member, to, from, constant)                                                               \
    EXPORT int name(void *instance, const uint32_t *references, size_t count, constant type *values) {                 \
        struct floor *f = instance;                                                                                    \
        for (size_t i = 0; i < count; i++) {                                                                           \
            if (references[i] >= MOST) return ERROR;                                                                   \
            to = from;                                                                                                 \
        }                                                                                                              \
        return OK;                                                                                                     \
    }
#define PAIR(what, type, member)                                                                                       \
    TRANSFER(fmi2Get##what, type, member, values[i], f->member[references[i]], )                                       \
    TRANSFER(fmi2Set##what, type, member, f->member[references[i]], values[i], const)

PAIR(Real, double, reals)
PAIR(Integer, int32_t, integers)
PAIR(Boolean, int32_t, booleans)

EXPORT int fmi2GetString(void *f, const uint32_t *references, size_t count, const char **values) {
    (void)f, (void)references;
    for (size_t i = 0; i < count; i++) values[i] = "";
    return OK;
}

EXPORT int fmi2DoStep(void *f, double t, double h, int no_rollback) {
    (void)f, (void)t, (void)h, (void)no_rollback;
    return OK;
}

EXPORT int fmi2SetupExperiment(void *f, int has_tolerance, double tolerance, double start, int has_stop, double stop) {
    (void)f, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return OK;
}

#define NOTHING(name)                                                                                                  \
    EXPORT int name(void *f) {                                                                                         \
        (void)f;                                                                                                       \
        return OK;                                                                                                     \
    }
NOTHING(fmi2EnterInitializationMode)
NOTHING(fmi2ExitInitializationMode)
NOTHING(fmi2Terminate)

EXPORT int fmi2Reset(void *f) {
    *(struct floor *)f = (struct floor){{0}, {0}, {0}};
    return OK;
}

EXPORT int fmi2SetDebugLogging(void *f, int on, size_t count, const char *const *categories) {
    (void)f, (void)on, (void)count, (void)categories;
    return OK;
}

/* The rest of the standard, which the description does not offer. */
EXPORT int fmi2SetString(void *f, const uint32_t *references, size_t count, const char *const *values) {
    (void)f, (void)references, (void)count, (void)values;
    return ERROR;
}
EXPORT int fmi2GetFMUstate(void *f, void **state) {
    (void)f, (void)state;
    return ERROR;
}
EXPORT int fmi2SetFMUstate(void *f, void *state) {
    (void)f, (void)state;
    return ERROR;
}
EXPORT int fmi2FreeFMUstate(void *f, void **state) {
    (void)f, (void)state;
    return ERROR;
}
EXPORT int fmi2SerializedFMUstateSize(void *f, void *state, size_t *size) {
    (void)f, (void)state, (void)size;
    return ERROR;
}
EXPORT int fmi2SerializeFMUstate(void *f, void *state, char *bytes, size_t size) {
    (void)f, (void)state, (void)bytes, (void)size;
    return ERROR;
}
EXPORT int fmi2DeSerializeFMUstate(void *f, const char *bytes, size_t size, void **state) {
    (void)f, (void)bytes, (void)size, (void)state;
    return ERROR;
}
EXPORT int fmi2GetDirectionalDerivative(void *f, const uint32_t *unknown, size_t unknowns, const uint32_t *known,
                                        size_t knowns, const double *seed, double *result) {
    (void)f, (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)result;
    return ERROR;
}
EXPORT int fmi2SetRealInputDerivatives(void *f, const uint32_t *references, size_t count, const int *order,
                                       const double *values) {
    (void)f, (void)references, (void)count, (void)order, (void)values;
    return ERROR;
}
EXPORT int fmi2GetRealOutputDerivatives(void *f, const uint32_t *references, size_t count, const int *order,
                                        double *values) {
    (void)f, (void)references, (void)count, (void)order, (void)values;
    return ERROR;
}
EXPORT int fmi2CancelStep(void *f) {
    (void)f;
    return ERROR;
}
#define STATUS(name, type)                                                                                             \
    EXPORT int name(void *f, int kind, type *value) {                                                                  \
        (void)f, (void)kind, (void)value;                                                                              \
        return DISCARD;                                                                                                \
    }
STATUS(fmi2GetStatus, int)
STATUS(fmi2GetRealStatus, double)
STATUS(fmi2GetIntegerStatus, int32_t)
STATUS(fmi2GetBooleanStatus, int32_t)
STATUS(fmi2GetStringStatus, const char *)
