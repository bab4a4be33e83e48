/*
 * Replays vectors that were recorded from ArmController.fmu or TestbedController.fmu through the C library, and prints by
 * how much each output differs at most and at how many ticks its bits differ.
 *
 *     cc -I include examples/replay.c libexo_law.a -o replay && ./replay vectors.txt
 *     cc -DEXO_LAW_F32 -I include examples/replay.c libexo_law_f32.a -o replay_f32 && ./replay_f32 vectors.txt
 *
 * A file of vectors is text: `arm` or `axis`; a line `parameter name value` for each parameter that is not at its start
 * value; `inputs names…`; `outputs names…`; then one line of numbers for each tick, inputs before outputs. Names are those
 * of the FMU, elements as in `K[2]`; numbers are read by strtod, so that hexadecimal ones keep every bit.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exo_law.h"

/* What a value is in the library's structs. */
typedef enum { NUMBER, POSITION, CHOICE } kind;

typedef struct {
  const char *name;
  size_t offset;
  kind kind;
} field;

#define ARM(name, member, kind) {name, offsetof(exo_arm_parameters, member), kind}
#define AXIS(name, member, kind) {name, offsetof(exo_axis_parameters, member), kind}

static const field ARM_PARAMETERS[] = {
    ARM("law", law, CHOICE),
    ARM("delay", delay, CHOICE),
    ARM("torque_limiting", torque_limiting, CHOICE),
    ARM("p_n_box", p_n_box, CHOICE),
    ARM("Lambda_n", gains.Lambda_n, NUMBER),
    ARM("D_n", gains.D_n, NUMBER),
    ARM("K", gains.K, NUMBER),
    ARM("K_P", gains.K_P, NUMBER),
    ARM("f_max", gains.f_max, NUMBER),
    ARM("alpha", alpha, NUMBER),
    ARM("T", T, NUMBER),
    ARM("tau_max", tau_max, NUMBER),
    ARM("tau_rate_max", tau_rate_max, NUMBER),
    ARM("dq_max", dq_max, NUMBER),
    ARM("ddq_max", ddq_max, NUMBER),
    ARM("dp_cutoff", dp_cutoff, NUMBER),
    ARM("energy.E_0", E_0, NUMBER),
    ARM("tuning_time", tuning_time, NUMBER),
    ARM("dp_n_max", dp_n_max, NUMBER),
    ARM("p_n_min", p_n_min, NUMBER),
    ARM("p_n_max", p_n_max, NUMBER),
    ARM("kinematics.A1", kinematics.A1, NUMBER),
    ARM("kinematics.L1", kinematics.L1, NUMBER),
    ARM("kinematics.handle_x", kinematics.handle_x, NUMBER),
    ARM("kinematics.handle_z", kinematics.handle_z, NUMBER),
    ARM("singularity.sigma_slow", singularity.sigma_slow, NUMBER),
    ARM("singularity.D", singularity.D, NUMBER),
    ARM("stiff_hand.active", stiff_hand.active, CHOICE),
    ARM("stiff_hand.D_max", stiff_hand.D_max, NUMBER),
    ARM("stiff_hand.f_low", stiff_hand.f_low, NUMBER),
    ARM("stiff_hand.f_high", stiff_hand.f_high, NUMBER),
    ARM("stiff_hand.f_min", stiff_hand.f_min, NUMBER),
    ARM("stiff_hand.growth", stiff_hand.growth, NUMBER),
    ARM("stiff_hand.attack", stiff_hand.attack, NUMBER),
    ARM("stiff_hand.quiet", stiff_hand.quiet, NUMBER),
    ARM("stiff_hand.release", stiff_hand.release, NUMBER),
    ARM("ft.source", ft.source, CHOICE),
    ARM("ft.frame", ft.frame, CHOICE),
    ARM("ft.stuck_samples", ft.stuck_samples, CHOICE),
    ARM("ft.dropout_samples", ft.dropout_samples, CHOICE),
    ARM("ft.mount", ft.mount, NUMBER),
    ARM("ft.handle", ft.handle, NUMBER),
    ARM("ft.mass", ft.mass, NUMBER),
    ARM("ft.cog", ft.cog, NUMBER),
    ARM("ft.gravity", ft.gravity, NUMBER),
    ARM("ft.deadband", ft.deadband, NUMBER),
    ARM("ft.cutoff", ft.cutoff, NUMBER),
    ARM("ft.range_force", ft.range_force, NUMBER),
    ARM("ft.range_torque", ft.range_torque, NUMBER),
    ARM("ft.rate_force", ft.rate_force, NUMBER),
    ARM("ft.rate_torque", ft.rate_torque, NUMBER),
    ARM("ft.recovery_time", ft.recovery_time, NUMBER),
    ARM("ft.tare_time", ft.tare_time, NUMBER),
    ARM("ft.tare_motion", ft.tare_motion, NUMBER),
    ARM("ft.tare_spread_force", ft.tare_spread_force, NUMBER),
    ARM("ft.tare_spread_torque", ft.tare_spread_torque, NUMBER),
    ARM("ft.tare_max_force", ft.tare_max_force, NUMBER),
    ARM("ft.tare_max_torque", ft.tare_max_torque, NUMBER),
    ARM("supervision", supervision.supervision, CHOICE),
    ARM("init_time", supervision.init_time, NUMBER),
    ARM("engage_time", supervision.engage_time, NUMBER),
    ARM("soft_stop_time", supervision.soft_stop_time, NUMBER),
    ARM("heartbeat_timeout", supervision.heartbeat_timeout, NUMBER),
    ARM("hold_enter", supervision.hold_enter, NUMBER),
    ARM("hold_leave", supervision.hold_leave, NUMBER),
    ARM("hold_time", supervision.hold_time, NUMBER),
    ARM("hold_brake", supervision.hold_brake, NUMBER),
    ARM("saturation_time", supervision.saturation_time, NUMBER),
    ARM("space", space, CHOICE),
    ARM("joint.D_n", joint_gains.D_n, NUMBER),
    ARM("joint.K", joint_gains.K, NUMBER),
    ARM("joint.K_P", joint_gains.K_P, NUMBER),
    ARM("joint.dq_n_max", joint.dq_n_max, NUMBER),
    ARM("joint.q_n_box", joint.q_n_box, CHOICE),
    ARM("joint.q_n_min", joint.q_n_min, NUMBER),
    ARM("joint.q_n_max", joint.q_n_max, NUMBER),
    ARM("nominal.m", nominal.m, NUMBER),
    ARM("nominal.x", nominal.x, NUMBER),
    ARM("nominal.z", nominal.z, NUMBER),
    ARM("nominal.I_xx", nominal.I_xx, NUMBER),
    ARM("nominal.I_yy", nominal.I_yy, NUMBER),
    ARM("nominal.I_zz", nominal.I_zz, NUMBER),
    ARM("nominal.I_xz", nominal.I_xz, NUMBER),
    ARM("nominal.rotor", nominal.rotor, NUMBER),
    {NULL, 0, NUMBER},
};

static const field ARM_INPUTS[] = {
    {"q", offsetof(exo_arm_inputs, q), POSITION},
    {"f_h", offsetof(exo_arm_inputs, f_h), NUMBER},
    {"ft.force", offsetof(exo_arm_inputs, ft_force), NUMBER},
    {"ft.torque", offsetof(exo_arm_inputs, ft_torque), NUMBER},
    {"ft.tare", offsetof(exo_arm_inputs, ft_tare), CHOICE},
    {"engage", offsetof(exo_arm_inputs, engage), CHOICE},
    {"hold", offsetof(exo_arm_inputs, hold), CHOICE},
    {"ft_valid", offsetof(exo_arm_inputs, ft_valid), CHOICE},
    {"enable", offsetof(exo_arm_inputs, signals.enable), CHOICE},
    {"acknowledge", offsetof(exo_arm_inputs, signals.acknowledge), CHOICE},
    {"emergency_stop", offsetof(exo_arm_inputs, signals.emergency_stop), CHOICE},
    {"heartbeat", offsetof(exo_arm_inputs, signals.heartbeat), CHOICE},
    {"encoder_valid", offsetof(exo_arm_inputs, signals.encoder_valid), CHOICE},
    {NULL, 0, NUMBER},
};

static const field ARM_OUTPUTS[] = {
    {"tau_a", offsetof(exo_arm_outputs, tau_a), NUMBER},
    {"tau_demand", offsetof(exo_arm_outputs, tau_demand), NUMBER},
    {"f_a", offsetof(exo_arm_outputs, f_a), NUMBER},
    {"p", offsetof(exo_arm_outputs, p), NUMBER},
    {"dp", offsetof(exo_arm_outputs, dp), NUMBER},
    {"p_n", offsetof(exo_arm_outputs, p_n), NUMBER},
    {"dp_n", offsetof(exo_arm_outputs, dp_n), NUMBER},
    {"e_nr", offsetof(exo_arm_outputs, e_nr), NUMBER},
    {"ft.f_h", offsetof(exo_arm_outputs, ft_f_h), NUMBER},
    {"ft.moment", offsetof(exo_arm_outputs, ft_moment), NUMBER},
    {"ft.fault", offsetof(exo_arm_outputs, ft_fault), CHOICE},
    {"ft.tare_state", offsetof(exo_arm_outputs, ft_tare_state), CHOICE},
    {"ft.tare_failure", offsetof(exo_arm_outputs, ft_tare_failure), CHOICE},
    {"stiff_hand.D", offsetof(exo_arm_outputs, stiff_hand_D), NUMBER},
    {"stiff_hand.detected", offsetof(exo_arm_outputs, stiff_hand_detected), CHOICE},
    {"q_n", offsetof(exo_arm_outputs, q_n), NUMBER},
    {"dq_n", offsetof(exo_arm_outputs, dq_n), NUMBER},
    {"e_q", offsetof(exo_arm_outputs, e_q), NUMBER},
    {"authority", offsetof(exo_arm_outputs, authority), NUMBER},
    {"state", offsetof(exo_arm_outputs, state), CHOICE},
    {"diagnostic", offsetof(exo_arm_outputs, diagnostic), CHOICE},
    {"first_fault", offsetof(exo_arm_outputs, first_fault), CHOICE},
    {"sigma_min", offsetof(exo_arm_outputs, sigma_min), NUMBER},
    {"energy.H", offsetof(exo_arm_outputs, H), NUMBER},
    {"energy.G", offsetof(exo_arm_outputs, G), NUMBER},
    {"energy.tank", offsetof(exo_arm_outputs, tank), NUMBER},
    {"energy.share", offsetof(exo_arm_outputs, share), NUMBER},
    {"saturated", offsetof(exo_arm_outputs, saturated), CHOICE},
    {"held", offsetof(exo_arm_outputs, held), CHOICE},
    {"outside_bounds", offsetof(exo_arm_outputs, outside_bounds), CHOICE},
    {"engaged", offsetof(exo_arm_outputs, engaged), CHOICE},
    {"slowed", offsetof(exo_arm_outputs, slowed), CHOICE},
    {"energy.debt", offsetof(exo_arm_outputs, debt), CHOICE},
    {NULL, 0, NUMBER},
};

static const field AXIS_PARAMETERS[] = {
    AXIS("law", law, CHOICE),
    AXIS("delay", delay, CHOICE),
    AXIS("q_n_box", q_n_box, CHOICE),
    AXIS("M_n", gains.M_n, NUMBER),
    AXIS("D_n", gains.D_n, NUMBER),
    AXIS("K", gains.K, NUMBER),
    AXIS("K_P", gains.K_P, NUMBER),
    AXIS("tau_max", gains.tau_max, NUMBER),
    AXIS("alpha", alpha, NUMBER),
    AXIS("T", T, NUMBER),
    AXIS("v_max", v_max, NUMBER),
    AXIS("a_max", a_max, NUMBER),
    AXIS("dq_cutoff", dq_cutoff, NUMBER),
    AXIS("energy.E_0", E_0, NUMBER),
    AXIS("tuning_time", tuning_time, NUMBER),
    AXIS("dq_n_max", dq_n_max, NUMBER),
    AXIS("q_n_min", q_n_min, NUMBER),
    AXIS("q_n_max", q_n_max, NUMBER),
    AXIS("tau_rate_max", tau_rate_max, NUMBER),
    {NULL, 0, NUMBER},
};

static const field AXIS_INPUTS[] = {
    {"q", offsetof(exo_axis_inputs, q), POSITION},
    {"tau_h", offsetof(exo_axis_inputs, tau_h), NUMBER},
    {"engage", offsetof(exo_axis_inputs, engage), CHOICE},
    {"hold", offsetof(exo_axis_inputs, hold), CHOICE},
    {NULL, 0, NUMBER},
};

static const field AXIS_OUTPUTS[] = {
    {"tau_a", offsetof(exo_axis_outputs, tau_a), NUMBER},
    {"tau_demand", offsetof(exo_axis_outputs, tau_demand), NUMBER},
    {"q_n", offsetof(exo_axis_outputs, q_n), NUMBER},
    {"dq_n", offsetof(exo_axis_outputs, dq_n), NUMBER},
    {"e_nr", offsetof(exo_axis_outputs, e_nr), NUMBER},
    {"dq", offsetof(exo_axis_outputs, dq), NUMBER},
    {"energy.H", offsetof(exo_axis_outputs, H), NUMBER},
    {"energy.G", offsetof(exo_axis_outputs, G), NUMBER},
    {"energy.tank", offsetof(exo_axis_outputs, tank), NUMBER},
    {"energy.share", offsetof(exo_axis_outputs, share), NUMBER},
    {"saturated", offsetof(exo_axis_outputs, saturated), CHOICE},
    {"held", offsetof(exo_axis_outputs, held), CHOICE},
    {"outside_bounds", offsetof(exo_axis_outputs, outside_bounds), CHOICE},
    {"engaged", offsetof(exo_axis_outputs, engaged), CHOICE},
    {"energy.debt", offsetof(exo_axis_outputs, debt), CHOICE},
    {NULL, 0, NUMBER},
};

/* A law: all memory that it needs, provided here. */
typedef union {
  exo_arm_parameters arm;
  exo_axis_parameters axis;
} parameters;

typedef union {
  exo_arm_state arm;
  exo_axis_state axis;
} state;

typedef union {
  exo_arm_inputs arm;
  exo_axis_inputs axis;
} inputs;

typedef union {
  exo_arm_outputs arm;
  exo_axis_outputs axis;
} outputs;

static void fail(const char *what, const char *which) {
  fprintf(stderr, "replay: %s: %s\n", what, which);
  exit(1);
}

/* A call that was not refused. */
static void accepted(exo_status status, const char *call, const exo_refusal *refusal) {
  if (status == EXO_STATUS_OK) {
    return;
  }
  if (status == EXO_STATUS_REFUSED) {
    fprintf(stderr, "replay: %s: %s[%d] = %g: expected %s\n", call, refusal->name, (int)refusal->axis,
            (double)refusal->value, refusal->expected);
  } else {
    fprintf(stderr, "replay: %s: status %d\n", call, (int)status);
  }
  exit(1);
}

/* Where the variable `name` lies in a struct; `name` loses its index. */
static field find(const field *fields, char *name) {
  size_t element = 0;
  char *bracket = strchr(name, '[');
  if (bracket != NULL) {
    *bracket = '\0';
    element = strtoul(bracket + 1, NULL, 10) - 1;
  }
  for (; fields->name != NULL; fields++) {
    if (strcmp(fields->name, name) == 0) {
      static const size_t SIZES[] = {sizeof(exo_real), sizeof(double), sizeof(int32_t)};
      field found = *fields;
      found.offset += element * SIZES[found.kind];
      return found;
    }
  }
  fail("the library has no variable of this name", name);
  return *fields;
}

static void set(void *values, field to, double value) {
  char *place = (char *)values + to.offset;
  if (to.kind == CHOICE) {
    *(int32_t *)place = (int32_t)value;
  } else if (to.kind == POSITION) {
    *(double *)place = value;
  } else {
    *(exo_real *)place = (exo_real)value;
  }
}

static double get(const void *values, field from) {
  const char *place = (const char *)values + from.offset;
  return from.kind == CHOICE ? *(const int32_t *)place : (double)*(const exo_real *)place;
}

/* Splits the rest of a line of names into columns. */
static size_t columns(const field *fields, char *line, field *found, char (*names)[32]) {
  size_t n = 0;
  for (char *name = strtok(line, " \n"); name != NULL; name = strtok(NULL, " \n")) {
    if (n == 64) {
      fail("more than 64 columns", name);
    }
    snprintf(names[n], sizeof names[n], "%s", name);
    found[n++] = find(fields, name);
  }
  return n;
}

static const char *after(const char *line, const char *word) {
  size_t length = strlen(word);
  return strncmp(line, word, length) == 0 ? line + length : NULL;
}

int main(int argc, char **argv) {
  static char line[16384], names[64][32];
  static state law;
  parameters given;
  inputs in;
  outputs out;
  exo_refusal refusal;
  field reads[64], shows[64];
  size_t n_in = 0, n_out = 0, ticks = 0, different[64] = {0};
  double largest[64] = {0};

  if (argc != 2) {
    fail("usage", "replay vectors.txt");
  }
  if (exo_law_real_size() != sizeof(exo_real)) {
    fail("the library was built in another precision than this program", "EXO_LAW_F32");
  }
  FILE *file = fopen(argv[1], "r");
  if (file == NULL || fgets(line, sizeof line, file) == NULL) {
    fail("cannot read", argv[1]);
  }
  int is_arm = after(line, "arm") != NULL;
  memset(&in, 0, sizeof in);
  if (is_arm) {
    in.arm.ft_valid = 1;
    in.arm.signals.encoder_valid = 1;
    exo_arm_defaults(&given.arm);
  } else {
    exo_axis_defaults(&given.axis);
  }

  while (n_out == 0 && fgets(line, sizeof line, file) != NULL) {
    char name[64];
    double value;
    if (sscanf(line, "parameter %63s %lf", name, &value) == 2) {
      set(&given, find(is_arm ? ARM_PARAMETERS : AXIS_PARAMETERS, name), value);
    } else if (after(line, "inputs ") != NULL) {
      n_in = columns(is_arm ? ARM_INPUTS : AXIS_INPUTS, line + strlen("inputs "), reads, names);
    } else if (after(line, "outputs ") != NULL) {
      n_out = columns(is_arm ? ARM_OUTPUTS : AXIS_OUTPUTS, line + strlen("outputs "), shows, names);
    } else {
      fail("not understood", line);
    }
  }

  if (is_arm) {
    accepted(exo_arm_init(&law.arm, &given.arm, &refusal), "exo_arm_init", &refusal);
  } else {
    accepted(exo_axis_init(&law.axis, &given.axis, &refusal), "exo_axis_init", &refusal);
  }
  for (; fgets(line, sizeof line, file) != NULL; ticks++) {
    char *rest = line;
    for (size_t i = 0; i < n_in; i++) {
      set(&in, reads[i], strtod(rest, &rest));
    }
    if (is_arm) {
      accepted(exo_arm_tick(&law.arm, &in.arm, &out.arm, &refusal), "exo_arm_tick", &refusal);
    } else {
      accepted(exo_axis_tick(&law.axis, &in.axis, &out.axis, &refusal), "exo_axis_tick", &refusal);
    }
    for (size_t i = 0; i < n_out; i++) {
      char *begin = rest;
      double expected = strtod(begin, &rest), value = get(&out, shows[i]);
      if (rest == begin) {
        fail("a number is missing", line);
      }
      different[i] += memcmp(&expected, &value, sizeof value) != 0;
      /* A number that is none differs by more than any other. */
      double difference = isfinite(value) ? fabs(value - expected) : INFINITY;
      largest[i] = fmax(largest[i], difference);
    }
  }
  fclose(file);
  printf("%zu ticks\n", ticks);
  for (size_t i = 0; i < n_out; i++) {
    printf("%s %.9g %zu\n", names[i], largest[i], different[i]);
  }
  return 0;
}
