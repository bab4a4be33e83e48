/* The smallest importer, to run one FMU's library where no importer is at hand (under wine, under qemu).
 *
 *     host <library> <table>
 *
 * The table (written by `cargo xtask dist`) says what the variables are. The host instantiates, steps with inputs that
 * are exact on any machine, saves and restores the state, provokes errors, and prints every status, message and number,
 * the Reals as their bits. By FMI 3.0 it goes on from the state that FMI 2.0 saved, in co-simulation and, where there is a
 * clock, by activations: the states at the end are those of FMI 2.0, byte by byte. Two platforms agree when the texts are equal. Exit code: 0 when the run went through,
 * whatever it printed; 1 when the library or the table cannot be used; 2 when a promise that needs no second platform
 * is broken, which `broken:` lines name.
 */
#define __USE_MINGW_ANSI_STDIO 1
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#else
#include <dlfcn.h>
#endif

/* fmi2TypesPlatform.h and fmi2FunctionTypes.h, as far as used here. */
typedef void *Component;
typedef unsigned Reference;
typedef int Status;
enum { fmi2OK = 0, fmi2Error = 3 };
typedef struct {
    void (*logger)(void *, const char *, Status, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, Status);
    void *environment;
} Callbacks;

/* Functions of the library. */
static struct {
    const char *(*GetVersion)(void);
    const char *(*GetTypesPlatform)(void);
    Component (*Instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int);
    void (*FreeInstance)(Component);
    Status (*SetupExperiment)(Component, int, double, double, int, double);
    Status (*EnterInitializationMode)(Component);
    Status (*ExitInitializationMode)(Component);
    Status (*Terminate)(Component);
    Status (*Reset)(Component);
    Status (*GetReal)(Component, const Reference *, size_t, double *);
    Status (*GetInteger)(Component, const Reference *, size_t, int *);
    Status (*GetBoolean)(Component, const Reference *, size_t, int *);
    Status (*SetReal)(Component, const Reference *, size_t, const double *);
    Status (*SetBoolean)(Component, const Reference *, size_t, const int *);
    Status (*DoStep)(Component, double, double, int);
    Status (*GetFMUstate)(Component, void **);
    Status (*SetFMUstate)(Component, void *);
    Status (*FreeFMUstate)(Component, void **);
    Status (*SerializedFMUstateSize)(Component, void *, size_t *);
    Status (*SerializeFMUstate)(Component, void *, char *, size_t);
    Status (*DeSerializeFMUstate)(Component, const char *, size_t, void **);
} fmi2;

/* fmi3PlatformTypes.h and fmi3FunctionTypes.h, as far as used here. */
typedef void Log3(void *, Status, const char *, const char *);
static struct {
    Component (*InstantiateCoSimulation)(const char *, const char *, const char *, bool, bool, bool, bool, const Reference *,
                                         size_t, void *, Log3 *, void (*)(void));
    Component (*InstantiateScheduledExecution)(const char *, const char *, const char *, bool, bool, void *, Log3 *,
                                               void (*)(void), void (*)(void), void (*)(void));
    void (*FreeInstance)(Component);
    Status (*EnterInitializationMode)(Component, bool, double, double, bool, double);
    Status (*ExitInitializationMode)(Component);
    Status (*SetFloat64)(Component, const Reference *, size_t, const double *, size_t);
    Status (*SetBoolean)(Component, const Reference *, size_t, const bool *, size_t);
    Status (*DoStep)(Component, double, double, bool, bool *, bool *, bool *, double *);
    Status (*ActivateModelPartition)(Component, Reference, double);
    Status (*GetFMUState)(Component, void **);
    Status (*SetFMUState)(Component, void *);
    Status (*FreeFMUState)(Component, void **);
    Status (*SerializedFMUStateSize)(Component, void *, size_t *);
    Status (*SerializeFMUState)(Component, void *, uint8_t *, size_t);
    Status (*DeserializeFMUState)(Component, const uint8_t *, size_t, void **);
} fmi3;
static const Reference CLOCK = 0xfffffffe;

static void stop(const char *what, const char *which)
{
    fprintf(stderr, "host: %s: %s\n", what, which);
    exit(1);
}

static void load(const char *path)
{
#ifdef _WIN32
    HMODULE library = LoadLibraryA(path);
    if (!library) stop("cannot be loaded", path);
#define SYMBOL(name) (void *)GetProcAddress(library, name)
#else
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) stop("cannot be loaded", dlerror());
#define SYMBOL(name) dlsym(library, name)
#endif
#define OF(version, name)                                                                                              \
    do {                                                                                                               \
        void *symbol = SYMBOL(#version #name);                                                                         \
        if (!symbol) stop("has no function", #version #name);                                                          \
        memcpy(&version.name, &symbol, sizeof symbol);                                                                 \
    } while (0)
#define FIND(name) OF(fmi2, name)
    FIND(GetVersion); FIND(GetTypesPlatform); FIND(Instantiate); FIND(FreeInstance); FIND(SetupExperiment);
    FIND(EnterInitializationMode); FIND(ExitInitializationMode); FIND(Terminate); FIND(Reset);
    FIND(GetReal); FIND(GetInteger); FIND(GetBoolean); FIND(SetReal); FIND(SetBoolean); FIND(DoStep);
    FIND(GetFMUstate); FIND(SetFMUstate); FIND(FreeFMUstate); FIND(SerializedFMUstateSize); FIND(SerializeFMUstate);
    FIND(DeSerializeFMUstate);
    OF(fmi3, InstantiateCoSimulation); OF(fmi3, InstantiateScheduledExecution); OF(fmi3, FreeInstance);
    OF(fmi3, EnterInitializationMode); OF(fmi3, ExitInitializationMode); OF(fmi3, SetFloat64); OF(fmi3, SetBoolean);
    OF(fmi3, DoStep); OF(fmi3, ActivateModelPartition); OF(fmi3, GetFMUState); OF(fmi3, SetFMUState);
    OF(fmi3, FreeFMUState); OF(fmi3, SerializedFMUStateSize); OF(fmi3, SerializeFMUState); OF(fmi3, DeserializeFMUState);
}

/* ---- the table: one variable a line ---- */

enum { REAL_INPUT, BOOLEAN_INPUT, REAL_SETTING, BOOLEAN_SETTING, REAL_OUTPUT, INTEGER_OUTPUT, BOOLEAN_OUTPUT, KINDS };
static const char *const WORDS[KINDS] = {"real-input",     "boolean-input", "real-setting",  "boolean-setting",
                                         "real-output",    "integer-output", "boolean-output"};

static char name[256], guid[256];
static double T;         /* communication step size, s */
static long panic = -1;  /* reference of a Boolean input that makes the next step panic, or -1 */
enum { MOST = 4096 };
static Reference references[KINDS][MOST];
static size_t count[KINDS];
static double start[MOST], amplitude[MOST]; /* of the Real inputs */
static double real_setting[MOST];            /* values of parameters, set before initialization */
static int boolean_setting[MOST];

static void read_table(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) stop("cannot be read", path);
    char word[64];
    while (fscanf(file, "%63s", word) == 1) {
        int good = 0;
        if (!strcmp(word, "model")) good = fscanf(file, "%255s", name) == 1;
        else if (!strcmp(word, "guid")) good = fscanf(file, "%255s", guid) == 1;
        else if (!strcmp(word, "step")) good = fscanf(file, "%lf", &T) == 1;
        else if (!strcmp(word, "panic")) good = fscanf(file, "%ld", &panic) == 1;
        else
            for (int kind = 0; kind < KINDS; kind++)
                if (!strcmp(word, WORDS[kind]) && count[kind] < MOST) {
                    size_t i = count[kind]++;
                    good = fscanf(file, "%u", &references[kind][i]) == 1;
                    if (kind == REAL_SETTING) good = good && fscanf(file, "%lf", &real_setting[i]) == 1;
                    if (kind == BOOLEAN_SETTING) good = good && fscanf(file, "%d", &boolean_setting[i]) == 1;
                    if (kind == REAL_INPUT) good = good && fscanf(file, "%lf %lf", &start[i], &amplitude[i]) == 2;
                }
        if (!good) stop("not understood in the table", word);
    }
    fclose(file);
    if (!*name || !*guid || !(T > 0)) stop("needs model, guid and step", path);
}

/* ---- the run ---- */

static Component c;
static int broken;
static uint64_t digest; /* FNV-1a of the values printed since it was set */

static void mix(uint64_t word)
{
    for (int i = 0; i < 8; i++) digest = (digest ^ (word >> (8 * i) & 0xff)) * UINT64_C(0x100000001b3);
}

static void expect(int good, const char *promise)
{
    if (!good) {
        broken = 1;
        printf("broken: %s\n", promise);
    }
}

/* The guid that a refusal named, for a library without a description. */
static char heard[256];

static void logger(void *environment, const char *instance, Status status, const char *category, const char *format, ...)
{
    (void)environment;
    va_list arguments;
    char text[2048];
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    printf("log %s %d %s: %s\n", instance, status, category, text);
    for (const char *brace = text; (brace = strchr(brace, '{')); brace++)
        if (strncmp(brace, "{another}", 9) && !*heard) sscanf(brace, "%254[^}]", heard);
}

static Status say(const char *call, Status status)
{
    printf("%s: status %d\n", call, status);
    return status;
}

/* A triangle of period 40 and height 1 in steps of 0.1: each value is one correctly rounded division. */
static double triangle(long n)
{
    long phase = n % 40;
    return (double)(phase < 10 ? phase : phase < 30 ? 20 - phase : phase - 40) / 10.0;
}

static void dump(long n)
{
    static double reals[MOST];
    static int integers[MOST], booleans[MOST];
    expect(fmi2.GetReal(c, references[REAL_OUTPUT], count[REAL_OUTPUT], reals) == fmi2OK, "Reals can be read");
    expect(fmi2.GetInteger(c, references[INTEGER_OUTPUT], count[INTEGER_OUTPUT], integers) == fmi2OK,
           "Integers can be read");
    expect(fmi2.GetBoolean(c, references[BOOLEAN_OUTPUT], count[BOOLEAN_OUTPUT], booleans) == fmi2OK,
           "Booleans can be read");
    printf("%ld", n);
    for (size_t i = 0; i < count[REAL_OUTPUT]; i++) {
        uint64_t bits;
        memcpy(&bits, &reals[i], sizeof bits);
        printf(" %u=%016" PRIx64, references[REAL_OUTPUT][i], bits);
        mix(bits);
    }
    for (size_t i = 0; i < count[INTEGER_OUTPUT]; i++) {
        printf(" %u=%d", references[INTEGER_OUTPUT][i], integers[i]);
        mix((uint64_t)(int64_t)integers[i]);
    }
    for (size_t i = 0; i < count[BOOLEAN_OUTPUT]; i++) {
        printf(" %u=%d", references[BOOLEAN_OUTPUT][i], booleans[i]);
        mix((uint64_t)booleans[i]);
    }
    printf("\n");
}

static void real_inputs(long n, double *values)
{
    for (size_t i = 0; i < count[REAL_INPUT]; i++) values[i] = start[i] + amplitude[i] * triangle(n + 7 * (long)i);
}

/* Steps number `from` to `to` - 1. Every input moves; Boolean inputs are true from 10 to 160. */
static void run(long from, long to)
{
    for (long n = from; n < to; n++) {
        double reals[MOST];
        int booleans[MOST];
        real_inputs(n, reals);
        for (size_t i = 0; i < count[BOOLEAN_INPUT]; i++) booleans[i] = n >= 10 && n < 160;
        expect(fmi2.SetReal(c, references[REAL_INPUT], count[REAL_INPUT], reals) == fmi2OK, "Real inputs can be set");
        expect(fmi2.SetBoolean(c, references[BOOLEAN_INPUT], count[BOOLEAN_INPUT], booleans) == fmi2OK,
               "Boolean inputs can be set");
        expect(fmi2.DoStep(c, (double)n * T, T, 1) == fmi2OK, "the step succeeds");
        dump(n + 1);
    }
}

static void initialize(void)
{
    say("fmi2SetupExperiment", fmi2.SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0));
    expect(fmi2.SetReal(c, references[REAL_SETTING], count[REAL_SETTING], real_setting) == fmi2OK &&
               fmi2.SetBoolean(c, references[BOOLEAN_SETTING], count[BOOLEAN_SETTING], boolean_setting) == fmi2OK,
           "parameters can be set");
    say("fmi2EnterInitializationMode", fmi2.EnterInitializationMode(c));
    say("fmi2ExitInitializationMode", fmi2.ExitInitializationMode(c));
}

/* ---- by FMI 3.0 ---- */

static void log3(void *environment, Status status, const char *category, const char *text)
{
    (void)environment;
    printf("log3 %d %s: %s\n", status, category, text);
}

/* The variables of FMI 3.0: an array is one, and what FMI 2.0 has as its elements follow each other. */
static size_t variables(int kind, Reference *first)
{
    size_t n = 0;
    for (size_t i = 0; i < count[kind]; i++)
        if (!n || first[n - 1] != references[kind][i] / 256 * 256) first[n++] = references[kind][i] / 256 * 256;
    return n;
}

/* Steps, or activations, number `from` to `to` - 1, with the inputs of `run`. */
static void run3(Component one, bool scheduled, long from, long to)
{
    static Reference of_reals[MOST], of_booleans[MOST];
    size_t reals = variables(REAL_INPUT, of_reals), booleans = variables(BOOLEAN_INPUT, of_booleans);
    for (long n = from; n < to; n++) {
        double values[MOST], last = 0.0;
        bool truths[MOST], event = true, terminate = true, early = true;
        real_inputs(n, values);
        for (size_t i = 0; i < count[BOOLEAN_INPUT]; i++) truths[i] = n >= 10 && n < 160;
        expect(fmi3.SetFloat64(one, of_reals, reals, values, count[REAL_INPUT]) == fmi2OK, "Float64 inputs can be set");
        expect(fmi3.SetBoolean(one, of_booleans, booleans, truths, count[BOOLEAN_INPUT]) == fmi2OK,
               "Boolean inputs can be set by FMI 3.0");
        double t = (double)n * T;
        if (scheduled) {
            expect(fmi3.ActivateModelPartition(one, CLOCK, t) == fmi2OK, "the activation succeeds");
        } else {
            expect(fmi3.DoStep(one, t, T, true, &event, &terminate, &early, &last) == fmi2OK, "the step by FMI 3.0 succeeds");
            expect(!event && !terminate && !early && last == t + T, "the step by FMI 3.0 is whole");
        }
    }
}

/* Goes on from one state and must come to the other; then each damaged byte of the header is refused. */
static void goes_on(Component one, bool scheduled, uint8_t *from, size_t size, const uint8_t *to, size_t expected)
{
    void *state = NULL, *none = NULL;
    size_t length = 0;
    expect(fmi3.DeserializeFMUState(one, from, size, &state) == fmi2OK, "FMI 3.0 reads the state of FMI 2.0");
    expect(fmi3.SetFMUState(one, state) == fmi2OK, "FMI 3.0 goes on from the state of FMI 2.0");
    run3(one, scheduled, 100, 140);
    expect(fmi3.GetFMUState(one, &state) == fmi2OK, "FMI 3.0 saves its state");
    expect(fmi3.SerializedFMUStateSize(one, state, &length) == fmi2OK && length == expected,
           "the state has the size of FMI 2.0");
    uint8_t *bytes = malloc(length);
    expect(fmi3.SerializeFMUState(one, state, bytes, length) == fmi2OK, "FMI 3.0 writes its state");
    expect(length == expected && !memcmp(bytes, to, length),
           scheduled ? "activations lead to the state of FMI 2.0" : "steps lead to the state of FMI 2.0");
    for (size_t i = 0; i < 66; i++) {
        from[i] ^= 0x81;
        expect(fmi3.DeserializeFMUState(one, from, size, &none) == fmi2Error && !none, "a damaged state is an error by FMI 3.0");
        from[i] ^= 0x81;
    }
    expect(fmi3.FreeFMUState(one, &state) == fmi2OK && !state, "FMI 3.0 frees its state");
    free(bytes);
}

static void by_fmi3(uint8_t *from, size_t size, const uint8_t *to, size_t expected)
{
    Component one = fmi3.InstantiateCoSimulation(name, guid, NULL, false, true, false, true, NULL, 0, NULL, log3, NULL);
    if (!one) stop("cannot be instantiated by FMI 3.0", name);
    goes_on(one, false, from, size, to, expected);
    fmi3.FreeInstance(one);

    one = fmi3.InstantiateCoSimulation(name, guid, NULL, false, true, false, true, NULL, 0, NULL, log3, NULL);
    if (!one) stop("cannot be instantiated by FMI 3.0", name);
    bool event, terminate, early;
    double last;
    say("fmi3EnterInitializationMode", fmi3.EnterInitializationMode(one, false, 0.0, 0.0, true, 2 * T));
    say("fmi3ExitInitializationMode", fmi3.ExitInitializationMode(one));
    run3(one, false, 0, 2);
    expect(say("past the stop time", fmi3.DoStep(one, 2 * T, T, true, &event, &terminate, &early, &last)) == fmi2Error,
           "a step past the stop time is an error");
    fmi3.FreeInstance(one);

    one = fmi3.InstantiateScheduledExecution(name, guid, NULL, false, true, NULL, log3, NULL, NULL, NULL);
    printf("scheduled execution: %s\n", one ? "yes" : "no");
    if (one) goes_on(one, true, from, size, to, expected);
    fmi3.FreeInstance(one);
}

int main(int n, char **argument)
{
    if (n != 3) stop("usage", "host <library> <table>");
#ifdef _WIN32
    _setmode(_fileno(stdout), _O_BINARY); /* the same line ends everywhere */
#endif
    read_table(argument[2]);
    load(argument[1]);
    Callbacks callbacks = {logger, calloc, free, NULL, NULL};
    printf("%s, FMI %s, types %s\n", name, fmi2.GetVersion(), fmi2.GetTypesPlatform());

    expect(!fmi2.Instantiate(name, 1, "{another}", NULL, &callbacks, 0, 1), "another interface's guid is refused");
    if (!strcmp(guid, "?")) snprintf(guid, sizeof guid, "%.254s}", heard);
    c = fmi2.Instantiate(name, 1, guid, NULL, &callbacks, 0, 1);
    if (!c) stop("cannot be instantiated", name);
    initialize();
    dump(0);
    run(0, 100);

    /* A state, as bytes; 40 steps; back; the same 40 steps. */
    void *state = NULL, *copy = NULL;
    size_t size = 0;
    say("fmi2GetFMUstate", fmi2.GetFMUstate(c, &state));
    say("fmi2SerializedFMUstateSize", fmi2.SerializedFMUstateSize(c, state, &size));
    char *bytes = malloc(size);
    say("fmi2SerializeFMUstate", fmi2.SerializeFMUstate(c, state, bytes, size));
    digest = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++) mix((unsigned char)bytes[i]);
    printf("state: %lu bytes, %016" PRIx64 "\n", (unsigned long)size, digest);
    digest = UINT64_C(0xcbf29ce484222325);
    run(100, 140);
    uint64_t first = digest;
    say("fmi2DeSerializeFMUstate", fmi2.DeSerializeFMUstate(c, bytes, size, &copy));
    say("fmi2SetFMUstate", fmi2.SetFMUstate(c, copy));
    digest = UINT64_C(0xcbf29ce484222325);
    run(100, 140);
    expect(digest == first, "steps after a restored state give the same bits");

    /* The state at the end of these steps, and the same steps by FMI 3.0. */
    void *later = NULL;
    size_t length = 0;
    say("fmi2GetFMUstate", fmi2.GetFMUstate(c, &later));
    say("fmi2SerializedFMUstateSize", fmi2.SerializedFMUstateSize(c, later, &length));
    char *end = malloc(length);
    say("fmi2SerializeFMUstate", fmi2.SerializeFMUstate(c, later, end, length));
    say("fmi2FreeFMUstate", fmi2.FreeFMUstate(c, &later));
    digest = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < length; i++) mix((unsigned char)end[i]);
    printf("state: %lu bytes, %016" PRIx64 "\n", (unsigned long)length, digest);
    by_fmi3((uint8_t *)bytes, size, (uint8_t *)end, length);
    free(end);

    /* Refused calls: an error each, and the run goes on. */
    double nan = NAN;
    int integer = 0;
    Reference unknown = 0xffffffff;
    void *none = NULL;
    expect(say("h = 0", fmi2.DoStep(c, 140 * T, 0.0, 1)) == fmi2Error, "h = 0 is an error");
    expect(say("h = NaN", fmi2.DoStep(c, 140 * T, nan, 1)) == fmi2Error, "h = NaN is an error");
    expect(say("another time", fmi2.DoStep(c, 7 * T, T, 1)) == fmi2Error, "another time is an error");
    expect(say("unknown reference", fmi2.GetInteger(c, &unknown, 1, &integer)) == fmi2Error,
           "an unknown reference is an error");
    /* Refused, unless a sensor's failure may pass here; set again before the next step. */
    if (count[REAL_INPUT]) say("a NaN", fmi2.SetReal(c, references[REAL_INPUT], 1, &nan));
    bytes[size / 2] ^= 1;
    expect(say("damaged state", fmi2.DeSerializeFMUstate(c, bytes, size, &none)) == fmi2Error && !none,
           "a damaged state is an error");
    run(140, 200);

    if (panic >= 0) {
        Reference reference = (Reference)panic;
        int yes = 1;
        say("a panic is asked for", fmi2.SetBoolean(c, &reference, 1, &yes));
        expect(say("panic", fmi2.DoStep(c, 200 * T, T, 1)) == fmi2Error, "a panic is an error");
        dump(200);
        expect(say("after it", fmi2.DoStep(c, 200 * T, T, 1)) == fmi2Error, "after a panic no step is made");
        say("fmi2SetFMUstate", fmi2.SetFMUstate(c, state));
        run(100, 120);
    }

    say("fmi2FreeFMUstate", fmi2.FreeFMUstate(c, &state));
    say("fmi2FreeFMUstate", fmi2.FreeFMUstate(c, &copy));
    say("fmi2Terminate", fmi2.Terminate(c));
    say("fmi2Reset", fmi2.Reset(c));
    initialize();
    run(0, 5);
    fmi2.FreeInstance(c);
    free(bytes);
    printf("end\n");
    return broken ? 2 : 0;
}
