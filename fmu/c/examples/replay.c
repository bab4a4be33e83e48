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

/* Most inputs, or outputs, of a file. */
enum { COLUMNS = 128 };

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

/* Where the variable `name` lies, which may have an index, by the description that the library gives of its structs. */
typedef struct {
  size_t offset;
  exo_kind kind;
} field;

/* The element that `name` means, from 0: `K[2]` is 1, a name without an index the only one. */
static size_t element_of(const char *name, size_t length, int32_t count) {
  char *end;
  if (name[length] == '\0') {
    if (count != 1) {
      fail("expected an index, as in K[2]", name);
    }
    return 0;
  }
  unsigned long index = strtoul(name + length + 1, &end, 10);
  if (strcmp(end, "]") != 0 || index < 1 || index > (unsigned long)count) {
    fprintf(stderr, "replay: %s: expected an index from 1 to %d\n", name, (int)count);
    exit(1);
  }
  return index - 1;
}

static field find(int is_arm, exo_role role, const char *name) {
  exo_variable variable;
  size_t length = strcspn(name, "[");
  for (size_t i = 0;; i++) {
    exo_status status = is_arm ? exo_arm_variable(i, &variable) : exo_axis_variable(i, &variable);
    if (status != EXO_STATUS_OK) {
      fail("the library has no variable of this name", name);
    }
    if (variable.role == role && strlen(variable.name) == length && strncmp(variable.name, name, length) == 0) {
      size_t element = element_of(name, length, variable.count);
      field found = {variable.offset + element * variable.stride, variable.kind};
      return found;
    }
  }
}

static void set(void *values, field to, double value) {
  char *place = (char *)values + to.offset;
  if (to.kind == EXO_KIND_INTEGER) {
    *(int32_t *)place = (int32_t)value;
  } else if (to.kind == EXO_KIND_DOUBLE) {
    *(double *)place = value;
  } else {
    *(exo_real *)place = (exo_real)value;
  }
}

static double get(const void *values, field from) {
  const char *place = (const char *)values + from.offset;
  if (from.kind == EXO_KIND_INTEGER) {
    return *(const int32_t *)place;
  }
  return from.kind == EXO_KIND_DOUBLE ? *(const double *)place : (double)*(const exo_real *)place;
}

/* Splits the rest of a line of names into columns. */
static size_t columns(int is_arm, exo_role role, char *line, field *found, char (*names)[32]) {
  size_t n = 0;
  for (char *name = strtok(line, " \n"); name != NULL; name = strtok(NULL, " \n")) {
    if (n == COLUMNS) {
      fail("more than 128 columns", name);
    }
    snprintf(names[n], sizeof names[n], "%s", name);
    found[n++] = find(is_arm, role, name);
  }
  return n;
}

static const char *after(const char *line, const char *word) {
  size_t length = strlen(word);
  return strncmp(line, word, length) == 0 ? line + length : NULL;
}

int main(int argc, char **argv) {
  static char line[16384], names[COLUMNS][32];
  static state law;
  parameters given;
  inputs in;
  outputs out;
  exo_refusal refusal;
  field reads[COLUMNS], shows[COLUMNS];
  size_t n_in = 0, n_out = 0, ticks = 0, different[COLUMNS] = {0};
  double largest[COLUMNS] = {0};

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
  if (is_arm) {
    exo_arm_defaults(&given.arm);
    exo_arm_inputs_defaults(&in.arm);
  } else {
    exo_axis_defaults(&given.axis);
    exo_axis_inputs_defaults(&in.axis);
  }

  while (n_out == 0 && fgets(line, sizeof line, file) != NULL) {
    char name[64];
    double value;
    if (sscanf(line, "parameter %63s %lf", name, &value) == 2) {
      set(&given, find(is_arm, EXO_ROLE_PARAMETER, name), value);
    } else if (after(line, "inputs ") != NULL) {
      n_in = columns(is_arm, EXO_ROLE_INPUT, line + strlen("inputs "), reads, names);
    } else if (after(line, "outputs ") != NULL) {
      n_out = columns(is_arm, EXO_ROLE_OUTPUT, line + strlen("outputs "), shows, names);
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
      char *begin = rest;
      double value = strtod(begin, &rest);
      if (rest == begin) {
        fail("a number is missing", line);
      }
      set(&in, reads[i], value);
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
