/* The model of moving2.c and moving3.c: x' = k u for SIZE axes, and a counter of steps. Written against the standard's
 * text. Each macro breaks one promise about what happens over time:
 * UNREPEATABLE, READS_COUNT, STATE_WITHOUT_X, STATE_ONCE, SERIAL_WITHOUT_X, SERIAL_OWN, RESET_KEEPS_X, RESET_KEEPS_K,
 * RESET_REFUSED, SHARED, STEP_FIXED, STEP_DRIFTS, NAN_CRASHES, NAN_HANGS, NAN_STAYS, STOP_IGNORED, LOG_REFUSED,
 * LOG_SECRET, LOG_SECRET_ERROR, NULL_CRASHES, EARLY_FREE_CRASHES, SECOND_RUN_CRASHES. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define API __attribute__((visibility("default")))
#define SIZE 2
enum { OK = 0, ERROR = 3 };

typedef struct {
  double u[SIZE], x[SIZE], k;
  int32_t steps;
  bool on;
} Values;
typedef struct {
  Values values;
  double stop;
  bool started, ended, used;
  void (*log)(void *owner, int status, const char *category, const char *message);
  void *owner;
} Model;

#ifdef SHARED
static Values shared;
#define V(m) (&shared)
#else
#define V(m) (&(m)->values)
#endif
#ifdef UNREPEATABLE
static double unrepeatable = 0.0;
#endif
#ifdef NAN_STAYS
static double stays = 0.0;
#endif
#ifdef STEP_DRIFTS
static int odd_steps = 0;
#endif

static void defaults(Model *m) {
  double *x = V(m)->x, k = V(m)->k, old[SIZE];
  memcpy(old, x, sizeof old);
  memset(V(m), 0, sizeof(Values));
  V(m)->k = 1.0;
  m->stop = INFINITY, m->started = m->ended = false;
#ifdef RESET_KEEPS_X
  memcpy(x, old, sizeof old);
#endif
#ifdef RESET_KEEPS_K
  if (m->used) V(m)->k = k;
#endif
  (void)k, (void)old, (void)x;
}
static void speak(Model *m, int status, const char *category, const char *message) {
  if (m->log) m->log(m->owner, status, category, message);
}
static int reset(Model *m) {
#ifdef RESET_REFUSED
  return ERROR;
#endif
  m->used = true;
  defaults(m);
  return OK;
}
static int start(Model *m, double stop) {
#ifdef SECOND_RUN_CRASHES
  if (m->used) abort();
#endif
  m->stop = stop, m->started = true;
#ifdef UNREPEATABLE
  unrepeatable += 1e-12;
#endif
  return OK;
}
static int end(Model *m) {
  m->ended = true;
  return OK;
}
static void leave(Model *m) {
#ifdef NULL_CRASHES
  if (!m) abort();
#endif
#ifdef EARLY_FREE_CRASHES
  if (m && m->started && !m->ended) abort();
#endif
  free(m);
}
static int advance(Model *m, double time, double size) {
  Values *v = V(m);
#ifdef NAN_CRASHES
  if (!isfinite(v->u[0])) abort();
#endif
#ifdef NAN_HANGS
  while (!isfinite(v->u[0])) {}
#endif
#ifdef NAN_STAYS
  if (!isfinite(v->u[0])) stays = 1.0;
  v->x[0] += stays;
#endif
#ifdef STEP_FIXED
  if (fabs(size - 0.01) > 1e-9) return ERROR;
#endif
#ifdef STEP_DRIFTS
  if (fabs(size - 0.01) > 1e-9) v->x[0] += 1e-9 * ++odd_steps;
#endif
#ifndef STOP_IGNORED
  if (time + size > m->stop * (1.0 + 1e-9)) {
    speak(m, ERROR, "logStatusError", "a step beyond the stop time");
    return ERROR;
  }
#endif
#ifdef LOG_SECRET
  speak(m, OK, "secret", "a step");
#endif
  speak(m, OK, "logEvents", "a step");
  for (int i = 0; i < SIZE; i++) v->x[i] += size * v->k * v->u[i];
#ifdef UNREPEATABLE
  v->x[0] += unrepeatable;
#endif
  v->steps++;
  return OK;
}
static double *real(Model *m, unsigned reference, int element) {
  double *const all[] = {V(m)->u, &V(m)->k, V(m)->x};
#ifdef READS_COUNT
  if (reference == 2) V(m)->x[0] += 1e-9;
#endif
  return all[reference] + element;
}
static int unknown(Model *m) {
#ifdef LOG_SECRET_ERROR
  speak(m, ERROR, "secret", "no such variable");
#endif
  speak(m, ERROR, "logStatusError", "no such variable");
  return ERROR;
}
static int categories(size_t n, const char *const names[]) {
  for (size_t i = 0; i < n; i++) {
    if (strcmp(names[i], "logEvents") == 0) continue;
#ifndef LOG_REFUSED
    if (strcmp(names[i], "logStatusError") == 0) continue;
#endif
    return ERROR;
  }
  return OK;
}

/* A copy of the state. Its owner is the instance that made it, for SERIAL_OWN. */
typedef struct {
  Values values;
  Model *owner;
  bool used;
} Copy;
static int get_state(Model *m, void **state) {
  Copy *copy = *state ? *state : malloc(sizeof *copy);
  copy->values = *V(m), copy->owner = m, copy->used = false;
  *state = copy;
  return OK;
}
static int set_state(Model *m, Copy *copy) {
  double x[SIZE];
  memcpy(x, V(m)->x, sizeof x);
#ifdef SERIAL_OWN
  if (copy->owner != m) return ERROR;
#endif
#ifdef STATE_ONCE
  if (copy->used) return OK;
#endif
  copy->used = true;
  *V(m) = copy->values;
#ifdef STATE_WITHOUT_X
  memcpy(V(m)->x, x, sizeof x);
#endif
  return OK;
}
static int free_state(void **state) {
  free(*state);
  *state = NULL;
  return OK;
}
static int serialize(const Copy *copy, uint8_t *bytes, size_t size) {
  if (size != sizeof *copy) return ERROR;
  memcpy(bytes, copy, size);
  return OK;
}
static int deserialize(const uint8_t *bytes, size_t size, void **state) {
  Copy *copy = malloc(sizeof *copy);
  if (size != sizeof *copy) return ERROR;
  memcpy(copy, bytes, size);
#ifdef SERIAL_WITHOUT_X
  memset(copy->values.x, 0, sizeof copy->values.x);
#endif
  *state = copy;
  return OK;
}
