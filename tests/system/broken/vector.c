/* The smallest FMI 3.0 co-simulation FMU with vectors: y = k u, each of three elements, and n counts the steps. Written
 * against the standard's text, not against this project's exporter; it does what fmpy calls. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct { double u[3], y[3], k[3]; int64_t n; } Instance;
enum { OK = 0, ERROR = 3 };
enum { U = 1, Y = 2, K = 3, N = 4 };

const char *fmi3GetVersion(void) { return "3.0"; }
void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, _Bool visible, _Bool logging,
                                  _Bool events, _Bool early, const uint32_t required[], size_t count, void *environment,
                                  void *log, void *update) {
  (void)name, (void)resources, (void)visible, (void)logging, (void)events, (void)early, (void)required, (void)count;
  (void)environment, (void)log, (void)update;
  if (strcmp(token, "{vector}") != 0) return NULL;
  Instance *own = calloc(1, sizeof(Instance));
  for (int i = 0; i < 3; i++) own->k[i] = 1.0;
  return own;
}
void fmi3FreeInstance(void *own) { free(own); }

static void compute(Instance *own) {
  for (int i = 0; i < 3; i++) own->y[i] = own->k[i] * own->u[i];
}
static double *at(Instance *own, uint32_t reference) {
  return reference == U ? own->u : reference == Y ? own->y : reference == K ? own->k : NULL;
}
int fmi3GetFloat64(void *own, const uint32_t vr[], size_t count, double values[], size_t values_count) {
  if (values_count != 3 * count) return ERROR;
  for (size_t i = 0; i < count; i++) {
    double *place = at(own, vr[i]);
    if (place == NULL) return ERROR;
    memcpy(values + 3 * i, place, 3 * sizeof(double));
  }
  return OK;
}
int fmi3SetFloat64(void *own, const uint32_t vr[], size_t count, const double values[], size_t values_count) {
  if (values_count != 3 * count) return ERROR;
  for (size_t i = 0; i < count; i++) {
    double *place = at(own, vr[i]);
    if (place == NULL || place == ((Instance *)own)->y) return ERROR;
    memcpy(place, values + 3 * i, 3 * sizeof(double));
  }
  return OK;
}
int fmi3GetInt64(void *own, const uint32_t vr[], size_t count, int64_t values[], size_t values_count) {
  if (count != 1 || values_count != 1 || vr[0] != N) return ERROR;
  values[0] = ((Instance *)own)->n;
  return OK;
}
int fmi3EnterInitializationMode(void *own, _Bool tolerance, double value, double start, _Bool stop, double end) {
  (void)own, (void)tolerance, (void)value, (void)start, (void)stop, (void)end;
  return OK;
}
int fmi3ExitInitializationMode(void *own) {
  compute(own);
  return OK;
}
int fmi3DoStep(void *own, double t, double h, _Bool no_rollback, _Bool *event, _Bool *terminate, _Bool *early, double *last) {
  (void)no_rollback;
  compute(own);
  ((Instance *)own)->n++;
  *event = *terminate = *early = 0;
  *last = t + h;
  return OK;
}
int fmi3Terminate(void *own) {
  (void)own;
  return OK;
}

/* fmpy wants the others to be there, too. */
#define NONE(name) int fmi3##name(void) { return ERROR; }
NONE(ActivateModelPartition) NONE(CompletedIntegratorStep) NONE(DeserializeFMUState) NONE(EnterConfigurationMode)
NONE(EnterContinuousTimeMode) NONE(EnterEventMode) NONE(EnterStepMode) NONE(EvaluateDiscreteStates)
NONE(ExitConfigurationMode) NONE(FreeFMUState) NONE(GetAdjointDerivative) NONE(GetBinary) NONE(GetBoolean)
NONE(GetClock) NONE(GetContinuousStateDerivatives) NONE(GetContinuousStates) NONE(GetDirectionalDerivative)
NONE(GetEventIndicators) NONE(GetFMUState) NONE(GetFloat32) NONE(GetInt16) NONE(GetInt32) NONE(GetInt8)
NONE(GetIntervalDecimal) NONE(GetIntervalFraction) NONE(GetNominalsOfContinuousStates) NONE(GetNumberOfContinuousStates)
NONE(GetNumberOfEventIndicators) NONE(GetNumberOfVariableDependencies) NONE(GetOutputDerivatives) NONE(GetShiftDecimal)
NONE(GetShiftFraction) NONE(GetString) NONE(GetUInt16) NONE(GetUInt32) NONE(GetUInt64) NONE(GetUInt8)
NONE(GetVariableDependencies) NONE(InstantiateModelExchange) NONE(InstantiateScheduledExecution) NONE(Reset)
NONE(SerializeFMUState) NONE(SerializedFMUStateSize) NONE(SetBinary) NONE(SetBoolean) NONE(SetClock)
NONE(SetContinuousStates) NONE(SetDebugLogging) NONE(SetFMUState) NONE(SetFloat32) NONE(SetInt16) NONE(SetInt32)
NONE(SetInt64) NONE(SetInt8) NONE(SetIntervalDecimal) NONE(SetIntervalFraction) NONE(SetShiftDecimal)
NONE(SetShiftFraction) NONE(SetString) NONE(SetTime) NONE(SetUInt16) NONE(SetUInt32) NONE(SetUInt64) NONE(SetUInt8)
NONE(UpdateDiscreteStates)
