// From a scene's packed columns to the state of a case at an instant.

function column({ unit, steps }) {
  const values = new Float64Array(steps.length);
  let whole = 0;
  for (let i = 0; i < steps.length; i++) values[i] = (whole += steps[i]) * unit;
  return values;
}

/** A case of a scene, ready to be asked for its state at any instant of its run. */
export function decode(id, packed) {
  const columns = Object.fromEntries(Object.entries(packed.frames).map(([name, one]) => [name, column(one)]));
  const { t, ...moving } = columns;
  return { ...packed, id, t, columns: moving, episodes: packed.sticking };
}

/** Instants at which sizes are looked at. */
const SAMPLES = 400;

/** Number of the frame before `time` and the share of the way to the next one; both within the run. */
function place(t, time) {
  let low = 0;
  let high = t.length - 1;
  if (time >= t[high]) return [high, 0];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= time) low = middle;
    else high = middle;
  }
  return [low, Math.max(0, (time - t[low]) / (t[high] - t[low]))];
}

/** The state of a case at `time` (s), as the drawings take it. */
export function stateAt(one, time) {
  const [i, share] = place(one.t, time);
  const value = (name) => {
    const values = one.columns[name];
    if (!values) return undefined;
    return share === 0 ? values[i] : values[i] + share * (values[i + 1] - values[i]);
  };
  if (one.geometry.kind === "testbed") {
    const names = ["q", "q_n", "tau_h", "tau_a", "tau_e", "tau_d"];
    return { time, ...Object.fromEntries(names.map((name) => [name, value(name)])) };
  }
  const vector = (name, side) => (one.columns[`${name}:${side}:1`] ? [1, 2, 3].map((k) => value(`${name}:${side}:${k}`)) : undefined);
  const arms = one.geometry.bases.map((_, side) => ({
    q: vector("q", side),
    p_n: vector("p_n", side),
    f_h: vector("f_h", side),
    f_e: vector("f_e", side),
    f_d: vector("f_d", side),
    tension: value(`tension:${side}`),
  }));
  const changes = one.attached.filter((instant) => instant <= time).length;
  return { time, arms, attached: changes % 2 === 1, payload: lying(one, changes, time) };
}

/** Where a payload that is not held lies: where the next grip finds it, or where the last one has left it. Left in the
 *  air it falls; the plant does not say what becomes of it. */
function lying(one, changes, time) {
  const { attached, places, geometry } = one;
  if (changes === 0 || attached.length > changes) return places[Math.min(changes, places.length - 1)];
  const [x, y, z] = places[places.length - 1];
  const since = time - attached[attached.length - 1];
  return [x, y, Math.max(Math.min(z, geometry.table ?? -0.75), z - 4.903 * since * since)];
}

/** Size that the columns whose name begins so seldom exceed, over the cases: a landing is a hundred times what follows it. */
export function usualSize(cases, ...names) {
  const found = [];
  for (const one of cases) {
    const [first, last] = [one.t[0], one.t[one.t.length - 1]];
    for (const [name, values] of Object.entries(one.columns)) {
      if (!names.includes(name.split(":")[0])) continue;
      for (let k = 0; k <= SAMPLES; k++) found.push(Math.abs(values[place(one.t, first + (k / SAMPLES) * (last - first))[0]]));
    }
  }
  return found.sort((a, b) => a - b)[Math.floor(0.98 * (found.length - 1))] ?? 0;
}

/** Least and largest value of columns over the cases. */
export function extent(cases, ...names) {
  let [low, high] = [Infinity, -Infinity];
  for (const one of cases) {
    for (const name of names) {
      for (const value of one.columns[name] ?? []) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
  }
  return low <= high ? [low, high] : [0, 0];
}
