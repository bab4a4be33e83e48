/*
 * The arm's law in a control loop: power on, engage, follow a hand, stop. It reads no file; C and C++ compile it.
 *
 *     cc -I include examples/control.c libexo_law.a -o control && ./control
 */
#include <stdio.h>
#include <string.h>

#include "exo_law.h"

enum { STOP = 3000, END = 4000 }; /* ticks */

/* The robot: three joints of 2.5 kg.m2 with friction. Encoders, force sensor, drives and brakes belong in its place. */
static double q[3] = {0.0, -1.48096, 1.70138}, dq[3];

static void sense(exo_arm_inputs *in, int tick) {
  memcpy(in->q, q, sizeof q);
  in->f_h[2] = tick > 1200 && tick < 2200 ? (exo_real)5.0 : 0; /* a hand lifts the handle */
}

static void drive(const exo_real *torques, double T) {
  for (int i = 0; i < 3; i++) {
    dq[i] += T * ((double)torques[i] - 8.0 * dq[i]) / 2.5;
    q[i] += T * dq[i];
  }
}

static void complain(const char *call, exo_status status, const exo_refusal *refusal) {
  fprintf(stderr, "%s: status %d", call, (int)status);
  if (status == EXO_STATUS_REFUSED) {
    fprintf(stderr, ": %s[%d] = %g: expected %s", refusal->name, (int)refusal->axis, (double)refusal->value, refusal->expected);
  }
  fprintf(stderr, "\n");
}

int main(void) {
  static const char *const states[] = {"off", "init", "ready", "engaged", "hold", "soft stop", "fault"};
  static exo_arm_state law; /* all the memory that the law needs */
  exo_arm_parameters parameters;
  exo_arm_inputs in;
  exo_arm_outputs out;
  exo_refusal refusal;

  exo_arm_defaults(&parameters); /* the start values of ArmController.fmu */
  parameters.law = EXO_LAW_PASSIVE_BOUNDED;
  parameters.supervision = 1;
  exo_status status = exo_arm_init(&law, &parameters, &refusal);
  if (strcmp(exo_law_version(), EXO_LAW_VERSION) != 0 || status != EXO_STATUS_OK) {
    complain("exo_arm_init", status, &refusal);
    return 1;
  }

  exo_arm_inputs_defaults(&in);
  in.engage = 0;
  int32_t state = EXO_STATE_OFF;
  double height = 0.0;
  for (int tick = 0; tick < END; tick++) { /* every T, after the encoders have been read */
    sense(&in, tick);
    in.heartbeat = tick;
    in.enable = tick < STOP;
    status = exo_arm_tick(&law, &in, &out, &refusal);
    if (status != EXO_STATUS_OK) {
      complain("exo_arm_tick", status, &refusal);
      return 1; /* brakes; out.tau_a is 0 now, never what it was at the tick before */
    }
    drive(out.tau_a, (double)parameters.T);
    in.engage = out.state != EXO_STATE_OFF && out.state != EXO_STATE_INIT; /* its rising edge counts once the law is ready */
    height = tick == 0 ? (double)out.p[2] : height;
    if (out.state != state) {
      state = out.state;
      printf("%.3f s: %s\n", tick * (double)parameters.T, states[state]);
    }
  }
  printf("the hand has lifted it by %.0f mm\n", 1000.0 * ((double)out.p[2] - height));
  return state == EXO_STATE_OFF ? 0 : 1;
}
