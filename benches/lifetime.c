/* How long an FMU takes to live, in one process: `lifetime LIBRARY VERSION TOKEN ROUNDS`, for FMI 2 and 3.
 * Prints ns of processor time: load, first instance; then the medians of ROUNDS rounds: instance, initialization, reset, free. */

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { CALLS = 4, MOST = 10000 };

static int64_t now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1000000000 * (int64_t)t.tv_sec + t.tv_nsec;
}

/* FMI 2.0 */
struct callbacks {
    void (*log)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*free)(void *);
    void (*finished)(void *, int);
    void *environment;
};
typedef void *instantiate2(const char *, int, const char *, const char *, const struct callbacks *, int, int);
typedef int setup2(void *, int, double, double, int, double);

/* FMI 3.0: booleans are `bool`, one byte. */
typedef void *instantiate3(const char *, const char *, const char *, char, char, char, char, const uint32_t *, size_t,
                           void *, void (*)(void *, int, const char *, const char *), void *);
typedef int enter3(void *, char, double, double, char, double);

typedef int plain(void *);
typedef void release(void *);

static void quiet2(void *e, const char *n, int s, const char *c, const char *m, ...) {
    (void)e, (void)n, (void)s, (void)c, (void)m;
}
static void quiet3(void *e, int s, const char *c, const char *m) { (void)e, (void)s, (void)c, (void)m; }

static void *library;

/* C has no cast from an object's address to a function's. */
static void found(const char *version, const char *name, void *function) {
    char full[64];
    snprintf(full, sizeof full, "fmi%s%s", version, name);
    void *address = dlsym(library, full);
    if (!address) {
        fprintf(stderr, "lifetime: the library has no %s\n", full);
        exit(1);
    }
    memcpy(function, &address, sizeof address);
}

static int compare(const void *a, const void *b) {
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

static int64_t times[CALLS][MOST];

/* What reading the clock twice shows where nothing is in between. */
static int64_t nothing(void) {
    static int64_t between[MOST];
    for (int i = 0; i < 1001; i++) {
        int64_t t = now();
        between[i] = now() - t;
    }
    qsort(between, 1001, sizeof between[0], compare);
    return between[500];
}

int main(int argc, char **argv) {
    int rounds = argc == 5 ? atoi(argv[4]) : 0;
    if (rounds < 1 || rounds > MOST || (strcmp(argv[2], "2") != 0 && strcmp(argv[2], "3") != 0)) {
        fprintf(stderr, "usage: lifetime LIBRARY 2|3 TOKEN ROUNDS, 1 to %d rounds\n", MOST);
        return 1;
    }
    const char *version = argv[2], *token = argv[3];
    int is_2 = version[0] == '2';
    static const struct callbacks callbacks = {quiet2, calloc, free, NULL, NULL};
    instantiate2 *make2 = NULL;
    instantiate3 *make3 = NULL;
    setup2 *setup = NULL;
    enter3 *enter = NULL;
    plain *enter2 = NULL, *leave, *reset;
    release *end;

    int64_t began = now();
    library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    int64_t load = now() - began;
    if (!library) {
        fprintf(stderr, "lifetime: %s\n", dlerror());
        return 1;
    }
    if (is_2) {
        found(version, "Instantiate", &make2);
        found(version, "SetupExperiment", &setup);
        found(version, "EnterInitializationMode", &enter2);
    } else {
        found(version, "InstantiateCoSimulation", &make3);
        found(version, "EnterInitializationMode", &enter);
    }
    found(version, "ExitInitializationMode", &leave);
    found(version, "Reset", &reset);
    found(version, "FreeInstance", &end);

    int64_t first = 0;
    for (int k = -1; k < rounds; k++) {
        int64_t t[CALLS + 1];
        t[0] = now();
        void *instance = is_2 ? make2("one", 1, token, NULL, &callbacks, 0, 0)
                              : make3("one", token, NULL, 0, 0, 0, 0, NULL, 0, NULL, quiet3, NULL);
        t[1] = now();
        int status = !instance;
        if (instance) {
            status |= is_2 ? setup(instance, 0, 0.0, 0.0, 0, 0.0) | enter2(instance) : enter(instance, 0, 0.0, 0.0, 0, 0.0);
            status |= leave(instance);
            t[2] = now();
            status |= reset(instance);
            t[3] = now();
            end(instance);
            t[4] = now();
        }
        if (status) {
            fprintf(stderr, "lifetime: a call was refused in round %d\n", k);
            return 1;
        }
        if (k < 0)
            first = t[1] - t[0];
        else
            for (int i = 0; i < CALLS; i++) times[i][k] = t[i + 1] - t[i];
    }
    int64_t clock = nothing();
    printf("%lld %lld", (long long)(load - clock), (long long)(first - clock));
    for (int i = 0; i < CALLS; i++) {
        qsort(times[i], (size_t)rounds, sizeof times[i][0], compare);
        printf(" %lld", (long long)(times[i][rounds / 2] - clock));
    }
    printf("\n");
    return 0;
}
