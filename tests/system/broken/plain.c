/* The smallest FMI 2.0 co-simulation FMU: input u (reference 0), output y = u (reference 1). Written against the
 * standard's text, not against this project's exporter. Each macro breaks one thing:
 * SLOW, CRASH, SIGNAL, NO_RESET, DISCARD, CHATTER, HANG, EXIT, FORK, LOUD, FLOOD, WARNS, ANY_GUID, NO_GUID, VERSION, EXTRA, HOME, INCOMPLETE, UNDEFINED;
 * MARK names a file that is written when the library is loaded. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define API __attribute__((visibility("default")))
#ifndef VERSION
#define VERSION "2.0"
#endif

typedef void *Component;
typedef struct {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
} Callbacks;

typedef struct { double u; const Callbacks *callbacks; } Instance;

enum { OK = 0, WARNING = 1, ERROR = 3 };

#ifdef EXTRA
API int step_counter = 0;
#endif
#ifdef HOME
const char *const volatile source = "/home/builder/fmu/plain.c";
#endif
#ifdef MARK
__attribute__((constructor)) static void mark(void) { fclose(fopen(MARK, "w")); }
#endif
API const char *fmi2GetTypesPlatform(void) { return "default"; }
API const char *fmi2GetVersion(void) { return VERSION; }

API Component fmi2Instantiate(const char *name, int type, const char *guid, const char *resources,
                              const Callbacks *callbacks, int visible, int logging) {
  (void)name, (void)type, (void)resources, (void)visible, (void)logging;
#ifdef NO_GUID
  return NULL;
#endif
#ifndef ANY_GUID
  if (strcmp(guid, "{plain}") != 0) return NULL;
#endif
#ifdef LOUD
  fprintf(stderr, "hello from the FMU\n");
#endif
  (void)guid;
  Instance *made = callbacks->allocate(1, sizeof(Instance));
  if (made) made->callbacks = callbacks;
  return made;
}
API void fmi2FreeInstance(Component c) { free(c); }

static double *at(Component c, unsigned reference) { return reference < 2 ? &((Instance *)c)->u : NULL; }
API int fmi2GetReal(Component c, const unsigned *vr, size_t n, double *value) {
  for (size_t i = 0; i < n; i++) {
    if (!at(c, vr[i])) return ERROR;
    value[i] = *at(c, vr[i]);
  }
  return OK;
}
API int fmi2SetReal(Component c, const unsigned *vr, size_t n, const double *value) {
  for (size_t i = 0; i < n; i++) {
    if (!at(c, vr[i])) return ERROR;
    *at(c, vr[i]) = value[i];
  }
  return OK;
}
API int fmi2DoStep(Component c, double t, double h, int no_set) {
  (void)c, (void)t, (void)h, (void)no_set;
#ifdef CRASH
  abort();
#endif
#ifdef SIGNAL
  raise(SIGNAL);
#endif
#ifdef EXIT
  _exit(EXIT);
#endif
#ifdef FORK
  int other = fork();
  if (other == 0) for (;;) pause();
  printf("%d", other), fflush(stdout);
#endif
#ifdef FLOOD
  for (int i = 0; i < FLOOD; i++) printf("%1000d\n", i);
#endif
#ifdef UNDEFINED
  extern int nowhere(void);
  return nowhere();
#endif
#ifdef HANG
  for (;;) pause();
#endif
#ifdef CHATTER
  const Callbacks *callbacks = ((Instance *)c)->callbacks;
  for (int i = 0; i < CHATTER; i++)
    callbacks->logger(callbacks->environment, "plain", WARNING, "\xff", "line %d \xfe of t = %g", i, t);
#endif
#ifdef SLOW
  if (t > SLOW - 1e-6 && t < SLOW + 1e-6) usleep(50000);
#endif
#ifdef DISCARD
  if (t >= DISCARD) return 2;
#endif
#ifdef WARNS
  return WARNING;
#endif
  return OK;
}

#define ACCEPTED(name) API int name(Component c) { (void)c; return OK; }
#define REFUSED(name) API int name(Component c) { (void)c; return ERROR; }
ACCEPTED(fmi2SetDebugLogging) ACCEPTED(fmi2SetupExperiment) ACCEPTED(fmi2EnterInitializationMode)
ACCEPTED(fmi2ExitInitializationMode) ACCEPTED(fmi2Terminate)
#ifdef NO_RESET
REFUSED(fmi2Reset)
#else
ACCEPTED(fmi2Reset)
#endif
REFUSED(fmi2GetInteger) REFUSED(fmi2GetBoolean) REFUSED(fmi2GetString)
REFUSED(fmi2SetInteger) REFUSED(fmi2SetBoolean)
#ifdef TEXT
/* TEXT: Strings are taken, and the output is the sum of the last one's bytes. */
API int fmi2SetString(Component c, const unsigned *vr, size_t n, const char *const *value) {
  for (size_t i = 0; i < n; i++) {
    if (vr[i] < 2) return ERROR;
    ((Instance *)c)->u = 0;
    for (const unsigned char *letter = (const void *)value[i]; *letter; letter++) ((Instance *)c)->u += *letter;
  }
  return OK;
}
#else
REFUSED(fmi2SetString)
#endif
REFUSED(fmi2GetFMUstate) REFUSED(fmi2SetFMUstate) REFUSED(fmi2FreeFMUstate)
REFUSED(fmi2SerializedFMUstateSize) REFUSED(fmi2SerializeFMUstate) REFUSED(fmi2DeSerializeFMUstate)
REFUSED(fmi2GetDirectionalDerivative) REFUSED(fmi2SetRealInputDerivatives) REFUSED(fmi2GetRealOutputDerivatives)
REFUSED(fmi2CancelStep) REFUSED(fmi2GetStatus) REFUSED(fmi2GetIntegerStatus)
#ifdef ENDS
// What a discarded step is asked about: fmi2LastSuccessfulTime, fmi2Terminated.
API int fmi2GetRealStatus(Component c, int kind, double *value) { (void)c; return *value = ENDS, kind == 2 ? OK : ERROR; }
API int fmi2GetBooleanStatus(Component c, int kind, int *value) { (void)c; return *value = 1, kind == 3 ? OK : ERROR; }
#else
REFUSED(fmi2GetRealStatus) REFUSED(fmi2GetBooleanStatus)
#endif
#ifndef INCOMPLETE
REFUSED(fmi2GetStringStatus)
#endif
