/*
 * The C library behind the functions of FMI 2.0, so that what couples FMUs can couple the library itself: `exo run --c-library`.
 * A program of a controller calls the library directly, as control.c does.
 *
 *     cc -shared -fPIC -I include examples/fmi2.c libexo_law.a -lm -o fmi2.so
 *
 * The guid says which law an instance is, "exo-law arm" or "exo-law axis". A value reference is the number of the variable in
 * exo_arm_variable or exo_axis_variable, times 256, plus the element from 0. A step is one tick and takes T. Parameters that
 * are set after initialization are tuned before the next tick. Before the first tick all outputs are 0.
 */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exo_law.h"

enum { VARIABLES = 1024 };
enum { FMI_OK, FMI_WARNING, FMI_DISCARD, FMI_ERROR };

typedef struct {
  void (*log)(void *environment, const char *name, int status, const char *category, const char *message, ...);
  void *(*allocate)(size_t count, size_t size);
  void (*free)(void *memory);
  void (*finished)(void *environment, int status);
  void *environment;
} callbacks;

typedef enum { SETTING, RUNNING } phase;

typedef struct {
  callbacks host;
  char name[64];
  int is_arm;
  phase at;
  int tuned; /* a parameter has been set since the last tick */
  size_t count;
  exo_variable variables[VARIABLES];
  union {
    exo_arm_state arm;
    exo_axis_state axis;
  } law;
  union {
    exo_arm_parameters arm;
    exo_axis_parameters axis;
  } parameters;
  union {
    exo_arm_inputs arm;
    exo_axis_inputs axis;
  } in;
  union {
    exo_arm_outputs arm;
    exo_axis_outputs axis;
  } out;
} controller;

static int failed(controller *c, const char *message) {
  if (c->host.log != NULL) {
    c->host.log(c->host.environment, c->name, FMI_ERROR, "logStatusError", "%s", message);
  }
  return FMI_ERROR;
}

/* The status of a call of the library. */
static int told(controller *c, const char *call, exo_status status, const exo_refusal *refusal) {
  char message[320];
  if (status == EXO_STATUS_OK) {
    return FMI_OK;
  }
  if (status == EXO_STATUS_REFUSED && refusal->axis != 0) {
    snprintf(message, sizeof message, "%s: %s[%d] = %g: expected %s", call, refusal->name, (int)refusal->axis,
             (double)refusal->value, refusal->expected);
  } else if (status == EXO_STATUS_REFUSED) {
    snprintf(message, sizeof message, "%s: %s = %g: expected %s", call, refusal->name, (double)refusal->value,
             refusal->expected);
  } else {
    snprintf(message, sizeof message, "%s: status %d; expected 0", call, (int)status);
  }
  return failed(c, message);
}

static void start_values(controller *c) {
  memset(&c->out, 0, sizeof c->out);
  c->at = SETTING;
  c->tuned = 0;
  if (c->is_arm) {
    exo_arm_defaults(&c->parameters.arm);
    exo_arm_inputs_defaults(&c->in.arm);
  } else {
    exo_axis_defaults(&c->parameters.axis);
    exo_axis_inputs_defaults(&c->in.axis);
  }
}

/* Where a value lies; NULL where there is none that may be set or read so. */
static void *place(controller *c, uint32_t reference, int to_set, exo_kind *kind) {
  uint32_t number = reference / 256, element = reference % 256;
  if (number >= c->count || element >= (uint32_t)c->variables[number].count) {
    return NULL;
  }
  const exo_variable *v = &c->variables[number];
  char *base = v->role == EXO_ROLE_PARAMETER ? (char *)&c->parameters : v->role == EXO_ROLE_INPUT ? (char *)&c->in : (char *)&c->out;
  if (to_set && v->role == EXO_ROLE_OUTPUT) {
    return NULL;
  }
  if (to_set && v->role == EXO_ROLE_PARAMETER && c->at == RUNNING) {
    c->tuned = 1;
  }
  *kind = v->kind;
  return base + v->offset + element * v->stride;
}

static int unknown(controller *c, const char *call, uint32_t reference) {
  char message[120];
  snprintf(message, sizeof message, "%s: value reference %lu: expected one of the description", call, (unsigned long)reference);
  return failed(c, message);
}

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const callbacks *host, int visible,
                      int logging) {
  (void)resources, (void)visible, (void)logging;
  controller *c = calloc(1, sizeof *c);
  if (c == NULL) {
    return NULL;
  }
  if (host != NULL) {
    c->host = *host;
  }
  snprintf(c->name, sizeof c->name, "%s", name != NULL ? name : "");
  c->is_arm = guid != NULL && strcmp(guid, "exo-law arm") == 0;
  if (type != 1 || guid == NULL || (!c->is_arm && strcmp(guid, "exo-law axis") != 0)) {
    failed(c, "fmi2Instantiate: expected co-simulation and the guid exo-law arm or exo-law axis");
    free(c);
    return NULL;
  }
  while (c->count < VARIABLES && (c->is_arm ? exo_arm_variable(c->count, &c->variables[c->count])
                                            : exo_axis_variable(c->count, &c->variables[c->count])) == EXO_STATUS_OK) {
    c->count++;
  }
  start_values(c);
  return c;
}

void fmi2FreeInstance(void *instance) {
  free(instance);
}

int fmi2Reset(void *instance) {
  start_values(instance);
  return FMI_OK;
}

int fmi2SetupExperiment(void *instance, int has_tolerance, double tolerance, double start, int has_stop, double stop) {
  (void)instance, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
  return FMI_OK;
}

int fmi2EnterInitializationMode(void *instance) {
  (void)instance;
  return FMI_OK;
}

int fmi2ExitInitializationMode(void *instance) {
  controller *c = instance;
  exo_refusal refusal;
  exo_status status = c->is_arm ? exo_arm_init(&c->law.arm, &c->parameters.arm, &refusal)
                                : exo_axis_init(&c->law.axis, &c->parameters.axis, &refusal);
  c->at = RUNNING;
  return told(c, c->is_arm ? "exo_arm_init" : "exo_axis_init", status, &refusal);
}

int fmi2Terminate(void *instance) {
  (void)instance;
  return FMI_OK;
}

int fmi2DoStep(void *instance, double t, double h, int no_rollback) {
  (void)t, (void)no_rollback;
  controller *c = instance;
  exo_refusal refusal;
  double T = (double)(c->is_arm ? c->parameters.arm.T : c->parameters.axis.T);
  /* A float holds a T of single precision. */
  if (c->at != RUNNING || !(fabs(h - T) <= (sizeof(exo_real) == sizeof(double) ? 1e-9 : 1e-6) * T)) {
    char message[120];
    snprintf(message, sizeof message, "fmi2DoStep: step %g s: expected T = %g s, after initialization", h, T);
    return failed(c, message);
  }
  if (c->tuned) {
    c->tuned = 0;
    exo_status status = c->is_arm ? exo_arm_tune(&c->law.arm, &c->parameters.arm, &refusal)
                                  : exo_axis_tune(&c->law.axis, &c->parameters.axis, &refusal);
    if (told(c, c->is_arm ? "exo_arm_tune" : "exo_axis_tune", status, &refusal) != FMI_OK) {
      return FMI_ERROR;
    }
  }
  if (c->is_arm) {
    return told(c, "exo_arm_tick", exo_arm_tick(&c->law.arm, &c->in.arm, &c->out.arm, &refusal), &refusal);
  }
  return told(c, "exo_axis_tick", exo_axis_tick(&c->law.axis, &c->in.axis, &c->out.axis, &refusal), &refusal);
}

int fmi2SetReal(void *instance, const uint32_t *references, size_t count, const double *values) {
  for (size_t i = 0; i < count; i++) {
    exo_kind kind = EXO_KIND_INTEGER;
    void *to = place(instance, references[i], 1, &kind);
    if (to == NULL || kind == EXO_KIND_INTEGER) {
      return unknown(instance, "fmi2SetReal", references[i]);
    }
    if (kind == EXO_KIND_DOUBLE) {
      *(double *)to = values[i];
    } else {
      *(exo_real *)to = (exo_real)values[i];
    }
  }
  return FMI_OK;
}

int fmi2GetReal(void *instance, const uint32_t *references, size_t count, double *values) {
  for (size_t i = 0; i < count; i++) {
    exo_kind kind = EXO_KIND_INTEGER;
    const void *from = place(instance, references[i], 0, &kind);
    if (from == NULL || kind == EXO_KIND_INTEGER) {
      return unknown(instance, "fmi2GetReal", references[i]);
    }
    values[i] = kind == EXO_KIND_DOUBLE ? *(const double *)from : (double)*(const exo_real *)from;
  }
  return FMI_OK;
}

int fmi2SetInteger(void *instance, const uint32_t *references, size_t count, const int32_t *values) {
  for (size_t i = 0; i < count; i++) {
    exo_kind kind = EXO_KIND_REAL;
    void *to = place(instance, references[i], 1, &kind);
    if (to == NULL || kind != EXO_KIND_INTEGER) {
      return unknown(instance, "fmi2SetInteger", references[i]);
    }
    *(int32_t *)to = values[i];
  }
  return FMI_OK;
}

int fmi2GetInteger(void *instance, const uint32_t *references, size_t count, int32_t *values) {
  for (size_t i = 0; i < count; i++) {
    exo_kind kind = EXO_KIND_REAL;
    const void *from = place(instance, references[i], 0, &kind);
    if (from == NULL || kind != EXO_KIND_INTEGER) {
      return unknown(instance, "fmi2GetInteger", references[i]);
    }
    values[i] = *(const int32_t *)from;
  }
  return FMI_OK;
}

int fmi2SetBoolean(void *instance, const uint32_t *references, size_t count, const int32_t *values) {
  return fmi2SetInteger(instance, references, count, values);
}

int fmi2GetBoolean(void *instance, const uint32_t *references, size_t count, int32_t *values) {
  return fmi2GetInteger(instance, references, count, values);
}

const char *fmi2GetVersion(void) {
  return "2.0";
}

const char *fmi2GetTypesPlatform(void) {
  return "default";
}

int fmi2SetDebugLogging(void *instance, int on, size_t count, const char *const *categories) {
  (void)instance, (void)on, (void)count, (void)categories;
  return FMI_OK;
}

/* What the description does not offer: Strings, states, derivatives, asynchronous steps. */
static int not_offered(controller *c, const char *call) {
  char message[80];
  snprintf(message, sizeof message, "%s: not offered", call);
  return failed(c, message);
}

int fmi2GetString(void *instance, const uint32_t *references, size_t count, const char **values) {
  (void)references, (void)count, (void)values;
  return not_offered(instance, "fmi2GetString");
}

int fmi2SetString(void *instance, const uint32_t *references, size_t count, const char *const *values) {
  (void)references, (void)count, (void)values;
  return not_offered(instance, "fmi2SetString");
}

int fmi2GetFMUstate(void *instance, void **state) {
  (void)state;
  return not_offered(instance, "fmi2GetFMUstate");
}

int fmi2SetFMUstate(void *instance, void *state) {
  (void)state;
  return not_offered(instance, "fmi2SetFMUstate");
}

int fmi2FreeFMUstate(void *instance, void **state) {
  (void)state;
  return not_offered(instance, "fmi2FreeFMUstate");
}

int fmi2SerializedFMUstateSize(void *instance, void *state, size_t *size) {
  (void)state, (void)size;
  return not_offered(instance, "fmi2SerializedFMUstateSize");
}

int fmi2SerializeFMUstate(void *instance, void *state, char *bytes, size_t size) {
  (void)state, (void)bytes, (void)size;
  return not_offered(instance, "fmi2SerializeFMUstate");
}

int fmi2DeSerializeFMUstate(void *instance, const char *bytes, size_t size, void **state) {
  (void)bytes, (void)size, (void)state;
  return not_offered(instance, "fmi2DeSerializeFMUstate");
}

int fmi2GetDirectionalDerivative(void *instance, const uint32_t *unknown, size_t unknowns, const uint32_t *known,
                                 size_t knowns, const double *seed, double *result) {
  (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)result;
  return not_offered(instance, "fmi2GetDirectionalDerivative");
}

int fmi2SetRealInputDerivatives(void *instance, const uint32_t *references, size_t count, const int32_t *order,
                                const double *values) {
  (void)references, (void)count, (void)order, (void)values;
  return not_offered(instance, "fmi2SetRealInputDerivatives");
}

int fmi2GetRealOutputDerivatives(void *instance, const uint32_t *references, size_t count, const int32_t *order,
                                 double *values) {
  (void)references, (void)count, (void)order, (void)values;
  return not_offered(instance, "fmi2GetRealOutputDerivatives");
}

int fmi2CancelStep(void *instance) {
  return not_offered(instance, "fmi2CancelStep");
}

int fmi2GetStatus(void *instance, int kind, int *value) {
  (void)instance, (void)kind, (void)value;
  return FMI_DISCARD;
}

int fmi2GetRealStatus(void *instance, int kind, double *value) {
  (void)instance, (void)kind, (void)value;
  return FMI_DISCARD;
}

int fmi2GetIntegerStatus(void *instance, int kind, int32_t *value) {
  (void)instance, (void)kind, (void)value;
  return FMI_DISCARD;
}

int fmi2GetBooleanStatus(void *instance, int kind, int32_t *value) {
  (void)instance, (void)kind, (void)value;
  return FMI_DISCARD;
}

int fmi2GetStringStatus(void *instance, int kind, const char **value) {
  (void)instance, (void)kind, (void)value;
  return FMI_DISCARD;
}
