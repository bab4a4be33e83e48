/* moving.h as an FMI 3.0 co-simulation FMU; the variables are those of moving3.xml. Its macros, beside those of moving.h:
 * EVENT_ENDLESS, EVENT_REFUSED, EARLY, LATE, VERSION, ANY_TOKEN, OTHER_START, NO_ARRAYS, INCOMPLETE, TWO (exports a function
 * of FMI 2.0). SCHEDULED makes it a scheduled execution FMU. */
#include "moving.h"

#ifndef VERSION
#define VERSION "3.0"
#endif
typedef void (*Intermediate)(void *, double, bool, bool, bool, bool, bool *, double *);
typedef struct {
  Model model;
  Intermediate intermediate;
  void *environment;
  bool early_allowed, events;
  void (*logger)(void *, int, const char *, const char *);
} Instance;
enum { U, K, X, DER_X, AXES, STEPS, ON, LABEL, BLOB, TENTH, MODE, TICK, TICKS, PREVIOUS, TIME };

static void log_3(void *owner, int status, const char *category, const char *message) {
  Instance *i = owner;
  i->logger(i->environment, status, category, message);
}
static Instance *made(const char *token, bool logging, void *environment,
                      void (*logger)(void *, int, const char *, const char *)) {
#ifndef ANY_TOKEN
  if (strcmp(token, "{moving}") != 0) return NULL;
#endif
  (void)token;
  Instance *i = calloc(1, sizeof *i);
  defaults(&i->model);
  i->environment = environment, i->logger = logger;
  if (logging && logger) i->model.log = log_3, i->model.owner = i;
  return i;
}
API const char *fmi3GetVersion(void) { return VERSION; }
API void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                      bool logging, bool events, bool early, const uint32_t *required, size_t n,
                                      void *environment, void (*logger)(void *, int, const char *, const char *),
                                      Intermediate intermediate) {
  (void)name, (void)resources, (void)visible, (void)required, (void)n;
  Instance *i = made(token, logging, environment, logger);
  if (i) i->intermediate = intermediate, i->early_allowed = early, i->events = events;
  return i;
}
API void *fmi3InstantiateModelExchange(void) { return NULL; }
#ifdef SCHEDULED
API void *fmi3InstantiateScheduledExecution(const char *name, const char *token, const char *resources, bool visible,
                                            bool logging, void *environment,
                                            void (*logger)(void *, int, const char *, const char *),
                                            void (*update)(void *), void (*lock)(void), void (*unlock)(void)) {
  (void)name, (void)resources, (void)visible, (void)update, (void)lock, (void)unlock;
  return made(token, logging, environment, logger);
}
API int fmi3ActivateModelPartition(Instance *i, uint32_t clock, double time) {
  if (clock != TICK) return unknown(&i->model);
  return advance(&i->model, time, 0.01);
}
#else
API void *fmi3InstantiateScheduledExecution(void) { return NULL; }
API int fmi3ActivateModelPartition(Instance *i) { return (void)i, ERROR; }
#endif
API void fmi3FreeInstance(Instance *i) { leave((Model *)i); }
API int fmi3SetDebugLogging(Instance *i, bool on, size_t n, const char *const names[]) {
  (void)i, (void)on;
  return categories(n, names);
}
API int fmi3EnterInitializationMode(Instance *i, bool tolerance_defined, double tolerance, double time,
                                    bool stop_defined, double stop) {
  (void)tolerance_defined, (void)tolerance, (void)time;
  return start(&i->model, stop_defined ? stop : INFINITY);
}
API int fmi3ExitInitializationMode(Instance *i) { return (void)i, OK; }
API int fmi3Terminate(Instance *i) { return end(&i->model); }
API int fmi3Reset(Instance *i) { return reset(&i->model); }
API int fmi3EnterEventMode(Instance *i) {
#ifdef EVENT_REFUSED
  return ERROR;
#endif
  return (void)i, OK;
}
API int fmi3EnterStepMode(Instance *i) { return (void)i, OK; }
API int fmi3UpdateDiscreteStates(Instance *i, bool *more, bool *terminate, bool *nominals, bool *states, bool *defined,
                                 double *next) {
  (void)i;
  *more = *terminate = *nominals = *states = *defined = false, *next = 0.0;
#ifdef EVENT_ENDLESS
  *more = true;
#endif
  return OK;
}
API int fmi3DoStep(Instance *i, double time, double size, bool no_set, bool *event, bool *terminate, bool *early,
                   double *last) {
  (void)no_set;
  *event = *terminate = *early = false, *last = time;
#ifdef EARLY
  *early = true, *last = time + 0.5 * size;
  return advance(&i->model, time, 0.5 * size);
#endif
  bool asked = false;
  double at = time + size;
  if (i->intermediate && i->early_allowed)
    i->intermediate(i->environment, time + 0.5 * size, false, true, true, true, &asked, &at);
  if (asked) *early = true, size *= 0.5;
  *last = time + size;
#ifdef LATE
  *last = time + 2.0 * size;
#endif
  return advance(&i->model, time, size);
}

static int values(Instance *i, const uint32_t *vr, size_t n, double *value, size_t total, bool set) {
  Model *m = &i->model;
  size_t at = 0;
  for (size_t j = 0; j < n; j++) {
    size_t count = vr[j] == K || vr[j] == TIME ? 1 : SIZE;
#ifdef NO_ARRAYS
    if (count > 1 && !set) return unknown(m);
#endif
    if ((vr[j] > DER_X && vr[j] != TIME) || at + count > total || (set && vr[j] > K)) return unknown(m);
    for (size_t e = 0; e < count; e++, at++) {
      if (set)
        *real(m, vr[j], (int)e) = value[at];
      else
        value[at] = vr[j] == TIME ? 0.0 : vr[j] == DER_X ? V(m)->k * V(m)->u[e] : *real(m, vr[j], (int)e);
    }
  }
  return OK;
}
API int fmi3GetFloat64(Instance *i, const uint32_t *vr, size_t n, double *value, size_t total) {
  return values(i, vr, n, value, total, false);
}
API int fmi3SetFloat64(Instance *i, const uint32_t *vr, size_t n, const double *value, size_t total) {
  return values(i, vr, n, (double *)value, total, true);
}
#ifdef OTHER_START
#define TENTH_START 0.25f
#else
#define TENTH_START 0.1f
#endif
/* One variable at a time of the other kinds. */
#define ONE(kind, type, test, result)                                                            \
  API int fmi3Get##kind(Instance *i, const uint32_t *vr, size_t n, type *value, size_t total) { \
    if (n != 1 || total != 1 || !(test)) return unknown(&i->model);                             \
    *value = (result);                                                                           \
    return OK;                                                                                   \
  }
ONE(Float32, float, vr[0] == TENTH, TENTH_START)
ONE(UInt64, uint64_t, vr[0] == AXES, SIZE)
ONE(Int64, int64_t, vr[0] == MODE, 2)
ONE(Int32, int32_t, vr[0] == STEPS || vr[0] == TICKS || vr[0] == PREVIOUS, vr[0] == STEPS ? V(&i->model)->steps : 0)
ONE(Boolean, bool, vr[0] == ON, V(&i->model)->on)
ONE(String, const char *, vr[0] == LABEL, "a place")
API int fmi3GetBinary(Instance *i, const uint32_t *vr, size_t n, size_t *sizes, const uint8_t **value, size_t total) {
  static const uint8_t bytes[] = {0x00, 0xff};
  if (n != 1 || total != 1 || vr[0] != BLOB) return unknown(&i->model);
  sizes[0] = sizeof bytes, value[0] = bytes;
  return OK;
}

API int fmi3GetFMUState(Instance *i, void **state) { return get_state(&i->model, state); }
API int fmi3SetFMUState(Instance *i, void *state) { return set_state(&i->model, state); }
API int fmi3FreeFMUState(Instance *i, void **state) { return (void)i, free_state(state); }
API int fmi3SerializedFMUStateSize(Instance *i, void *state, size_t *size) {
  (void)i, (void)state;
  *size = sizeof(Copy);
  return OK;
}
API int fmi3SerializeFMUState(Instance *i, void *state, uint8_t *bytes, size_t size) {
  return (void)i, serialize(state, bytes, size);
}
API int fmi3DeserializeFMUState(Instance *i, const uint8_t *bytes, size_t size, void **state) {
  return (void)i, deserialize(bytes, size, state);
}

#define REFUSED(name) API int fmi3##name(Instance *i) { return (void)i, ERROR; }
REFUSED(GetInt8) REFUSED(GetUInt8) REFUSED(GetInt16) REFUSED(GetUInt16) REFUSED(GetUInt32) REFUSED(GetClock)
REFUSED(SetFloat32) REFUSED(SetInt8) REFUSED(SetUInt8) REFUSED(SetInt16) REFUSED(SetUInt16) REFUSED(SetInt32)
REFUSED(SetUInt32) REFUSED(SetInt64) REFUSED(SetUInt64) REFUSED(SetBoolean) REFUSED(SetString) REFUSED(SetBinary)
REFUSED(SetClock) REFUSED(GetNumberOfVariableDependencies) REFUSED(GetVariableDependencies)
REFUSED(GetDirectionalDerivative) REFUSED(GetAdjointDerivative) REFUSED(EnterConfigurationMode)
REFUSED(ExitConfigurationMode) REFUSED(GetIntervalDecimal) REFUSED(GetIntervalFraction) REFUSED(GetShiftDecimal)
REFUSED(GetShiftFraction) REFUSED(SetIntervalDecimal) REFUSED(SetIntervalFraction) REFUSED(SetShiftDecimal)
REFUSED(SetShiftFraction) REFUSED(EvaluateDiscreteStates) REFUSED(EnterContinuousTimeMode)
REFUSED(CompletedIntegratorStep) REFUSED(SetTime) REFUSED(SetContinuousStates) REFUSED(GetContinuousStateDerivatives)
REFUSED(GetEventIndicators) REFUSED(GetContinuousStates) REFUSED(GetNominalsOfContinuousStates)
REFUSED(GetNumberOfEventIndicators) REFUSED(GetNumberOfContinuousStates)
#ifndef INCOMPLETE
REFUSED(GetOutputDerivatives)
#endif
#ifdef TWO
API const char *fmi2GetVersion(void) { return "2.0"; }
#endif
