// The signals of an experiment: instants and values of the points that are kept.

/** Signals from the head's facts and the body's blocks: {time, values, unit, case, column}. A gap is a NaN. */
function signalsOf(head, body) {
  return head.series.map((facts) => {
    const ticks = body.ticks(facts.n);
    const values = body.values(facts.n);
    const time = new Float64Array(facts.n);
    let tick = 0;
    for (let k = 0; k < facts.n; k++) {
      tick += ticks[k];
      time[k] = tick * facts.step;
    }
    return { ...facts, time, values };
  });
}

/** Index of the last point at or before `t`; −1 where there is none. */
function pointBefore(signal, t) {
  let low = 0;
  let high = signal.time.length;
  const after = t + 1e-9;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (signal.time[middle] <= after) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The value on the drawn line at `t` (s); NaN outside the signal. */
function valueAt(signal, t) {
  const k = pointBefore(signal, t);
  const { time, values } = signal;
  if (k < 0 || t > time[time.length - 1] + 1e-9) return NaN;
  if (k === time.length - 1) return values[k];
  const share = (t - time[k]) / (time[k + 1] - time[k]);
  return values[k] + Math.max(share, 0) * (values[k + 1] - values[k]);
}

/** Smallest and largest value within [from, to] (s), as [low, high]; null where the signal is not there. */
function extremesOf(signal, from, to) {
  let low = Infinity;
  let high = -Infinity;
  for (const t of [Math.max(from, signal.time[0]), Math.min(to, signal.time[signal.time.length - 1])]) {
    const value = valueAt(signal, t);
    if (t >= from && t <= to && Number.isFinite(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  for (let k = pointBefore(signal, from) + 1; k < signal.time.length && signal.time[k] <= to; k++) {
    if (Number.isNaN(signal.values[k])) continue;
    low = Math.min(low, signal.values[k]);
    high = Math.max(high, signal.values[k]);
  }
  return low <= high ? [low, high] : null;
}

/** A number with four digits, as people write it. */
function written(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  return text.replace(/-/g, "−");
}

/** A number as it stands beside an axis: as short as it can be, since there is little room. */
function marked(value) {
  const size = Math.abs(value);
  if (size === 0 || (size >= 1e-3 && size < 1e5)) return written(value);
  return Number(value.toPrecision(3)).toExponential().replace("e+", "e").replace(/-/g, "−");
}

/** A number with its unit; what has no unit has unit 1. */
function withUnit(value, unit) {
  return !Number.isFinite(value) || unit === "1" || unit === "" ? written(value) : `${written(value)} ${unit}`;
}
