// The rail of the testbed as a scale: linear around the wall, squeezed beyond, where only the direction matters.

const SQUEEZE = 0.25;

/** A scale from positions in `extent` (m) to pixels within `left` … `right`; `wall` may be null. */
export function rail({ extent: [least, most], wall, left, right }) {
  const room = wall === null ? [least, most] : [Math.max(least, wall - 1.15), Math.min(Math.max(most, wall + 0.1), wall + 0.35)];
  const widest = wall === null ? 4 : Infinity;
  let [low, high] = room;
  if (high - low > widest) [low, high] = [-widest / 2, widest / 2];
  if (high - low < 0.2) [low, high] = [low - 0.1, high + 0.1];
  const beyond = [Math.max(0, low - least), Math.max(0, most - high)];
  const width = right - left;
  const before = beyond[0] > 0 ? 0.1 * width : 0;
  const after = beyond[1] > 0 ? 0.34 * width : 0;
  const perMetre = (width - before - after) / (high - low);
  const squeezed = (distance, farthest) => Math.log1p(distance / SQUEEZE) / Math.log1p(farthest / SQUEEZE);
  const at = (q) => {
    if (q < low) return left + before * (1 - squeezed(Math.min(low - q, beyond[0] || 1), beyond[0] || 1));
    if (q > high) return right - after + after * squeezed(Math.min(q - high, beyond[1] || 1), beyond[1] || 1);
    return left + before + (q - low) * perMetre;
  };
  const marked = ticks({ low, high, perMetre, beyond, least, most }).sort((a, b) => a.q - b.q);
  // Those of the squeezed ends give way where they would touch one that is nearer.
  const apart = marked.filter(({ q }) => q >= low && q <= high);
  for (const tick of marked.filter(({ q }) => q > high)) if (at(tick.q) - at(apart.at(-1)?.q ?? low) > 36) apart.push(tick);
  for (const tick of marked.filter(({ q }) => q < low).reverse()) if (at(apart[0]?.q ?? high) - at(tick.q) > 36) apart.unshift(tick);
  return { at, left, right, seen: [low, high], linear: [left + before, right - after], ticks: apart };
}

function ticks({ low, high, perMetre, beyond, least, most }) {
  const step = [0.1, 0.2, 0.5, 1].find((one) => one * perMetre >= 52) ?? 2;
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9; i++) found.push({ q: i * step, text: (i * step).toFixed(step < 1 ? 1 : 0) });
  const far = [1, 10, 100, 1000];
  if (beyond[1] > 0) for (const q of far) if (q > high + 0.5 && q <= most) found.push({ q, text: `${q}` });
  if (beyond[0] > 0) for (const q of far) if (-q < low - 0.5 && -q >= least) found.push({ q: -q, text: `−${q}` });
  return found.map((tick) => ({ ...tick, text: tick.text.replace("-", "−") }));
}
