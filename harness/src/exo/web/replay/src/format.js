// Numbers as text, and steps of scales.

/** A force with its unit: three digits at most. */
export function newtons(value) {
  const size = Math.abs(value);
  // A number and its unit stay on one line.
  return `${value.toFixed(size < 99.95 ? 1 : 0).replace("-", "−")}\u00a0N`;
}

/** A length with its unit. */
export function metres(value) {
  const size = Math.abs(value);
  return `${value.toFixed(size < 0.995 ? 3 : size < 99.5 ? 1 : 0).replace("-", "−")}\u00a0m`;
}

/** The 1, 2 or 5 times a power of ten at or above a value. */
export function nice(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  const step = [1, 2, 5, 10].find((one) => one * power >= value * 0.999999) ?? 10;
  return step * power;
}

