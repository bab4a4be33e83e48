/* moving.h as an FMI 2.0 co-simulation FMU: input u (reference 0), parameter k (1), output x (2), each of its first axis;
 * output steps (Integer, reference 0). */
#include "moving.h"

typedef struct {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
} Callbacks;

static void log_2(void *owner, int status, const char *category, const char *message) {
  const Callbacks *callbacks = owner;
  callbacks->logger(callbacks->environment, "moving", status, category, "%s", message);
}
API const char *fmi2GetTypesPlatform(void) { return "default"; }
API const char *fmi2GetVersion(void) { return "2.0"; }
API void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources,
                          const Callbacks *callbacks, int visible, int logging) {
  (void)name, (void)type, (void)resources, (void)visible;
  if (strcmp(guid, "{moving}") != 0) return NULL;
  Model *m = calloc(1, sizeof *m);
  defaults(m);
  if (logging) m->log = log_2, m->owner = (void *)callbacks;
  return m;
}
API void fmi2FreeInstance(Model *m) { leave(m); }
API int fmi2SetDebugLogging(Model *m, int on, size_t n, const char *const names[]) {
  (void)m, (void)on;
  return categories(n, names);
}
API int fmi2SetupExperiment(Model *m, int tolerance_defined, double tolerance, double time, int stop_defined,
                            double stop) {
  (void)tolerance_defined, (void)tolerance, (void)time;
  return start(m, stop_defined ? stop : INFINITY);
}
API int fmi2EnterInitializationMode(Model *m) { return (void)m, OK; }
API int fmi2ExitInitializationMode(Model *m) { return (void)m, OK; }
API int fmi2Terminate(Model *m) { return end(m); }
API int fmi2Reset(Model *m) { return reset(m); }
API int fmi2GetReal(Model *m, const unsigned *vr, size_t n, double *value) {
  for (size_t i = 0; i < n; i++) {
    if (vr[i] > 2) return unknown(m);
    value[i] = *real(m, vr[i], 0);
  }
  return OK;
}
API int fmi2SetReal(Model *m, const unsigned *vr, size_t n, const double *value) {
  for (size_t i = 0; i < n; i++) {
    if (vr[i] > 1) return unknown(m);
    *real(m, vr[i], 0) = value[i];
  }
  return OK;
}
API int fmi2GetInteger(Model *m, const unsigned *vr, size_t n, int *value) {
  for (size_t i = 0; i < n; i++) {
    if (vr[i] > 0) return unknown(m);
    value[i] = V(m)->steps;
  }
  return OK;
}
API int fmi2DoStep(Model *m, double time, double size, int no_set) {
  (void)no_set;
  return advance(m, time, size);
}
API int fmi2GetFMUstate(Model *m, void **state) { return get_state(m, state); }
API int fmi2SetFMUstate(Model *m, void *state) { return set_state(m, state); }
API int fmi2FreeFMUstate(Model *m, void **state) { return (void)m, free_state(state); }
API int fmi2SerializedFMUstateSize(Model *m, void *state, size_t *size) {
  (void)m, (void)state;
  *size = sizeof(Copy);
  return OK;
}
API int fmi2SerializeFMUstate(Model *m, void *state, uint8_t *bytes, size_t size) {
  return (void)m, serialize(state, bytes, size);
}
API int fmi2DeSerializeFMUstate(Model *m, const uint8_t *bytes, size_t size, void **state) {
  return (void)m, deserialize(bytes, size, state);
}

#define REFUSED(name) API int name(Model *m) { return (void)m, ERROR; }
REFUSED(fmi2GetBoolean) REFUSED(fmi2GetString) REFUSED(fmi2SetInteger) REFUSED(fmi2SetBoolean) REFUSED(fmi2SetString)
REFUSED(fmi2GetDirectionalDerivative) REFUSED(fmi2SetRealInputDerivatives) REFUSED(fmi2GetRealOutputDerivatives)
REFUSED(fmi2CancelStep) REFUSED(fmi2GetStatus) REFUSED(fmi2GetRealStatus) REFUSED(fmi2GetIntegerStatus)
REFUSED(fmi2GetBooleanStatus) REFUSED(fmi2GetStringStatus)
