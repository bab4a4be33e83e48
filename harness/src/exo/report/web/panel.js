// One pair of axes, drawn by uPlot: curves, marks and bands over the time.

/** Instants of all curves, and each curve over them; undefined where a curve has no point, null where it has a gap. */
function joined(panel, signals) {
  const tables = panel.curves.map((curve) => [
    signals[curve.s].time,
    Array.from(signals[curve.s].values, (value) => (Number.isNaN(value) ? null : value)),
  ]);
  return tables.length ? uPlot.join(tables) : [[], []];
}

/** Room beside the ordinate for its marks, px: the same in all panels, so that their times lie one above the other. */
const ORDINATE = 54;

/** The range of the ordinate: the scenario's while all is shown, else that of what is seen. */
function heights(panel, signals, view) {
  if (panel.yRange && !view.zoomed) return panel.yRange;
  const seen = panel.curves
    .filter((curve) => !view.hidden.has(curve.label))
    .map((curve) => extremesOf(signals[curve.s], view.from, view.to))
    .filter(Boolean);
  if (!seen.length) return panel.yRange || [0, 1];
  let low = Math.min(...seen.map((one) => one[0]));
  let high = Math.max(...seen.map((one) => one[1]));
  if (!view.zoomed) {
    low = Math.min(low, ...panel.marks);
    high = Math.max(high, ...panel.marks);
  }
  const margin = 0.06 * (high - low) || Math.abs(high) * 0.1 || 1;
  return [low - margin, high + margin];
}

/** Stretches of one value, coloured, behind the curves. */
function drawBands(u, panel, signals) {
  if (!panel.bands) return;
  const { time, values } = signals[panel.bands.s];
  const { left, top, width, height } = u.bbox;
  const end = time.length - 1;
  const place = (t) => Math.round(Math.min(Math.max(u.valToPos(t, "x", true), left), left + width));
  for (let first = 0, k = 1; k <= time.length; k++) {
    if (k <= end && values[k] === values[first]) continue;
    const from = place(time[first]);
    if (!Number.isNaN(values[first])) {
      u.ctx.fillStyle = bandColor(panel.bands, Math.round(values[first]));
      u.ctx.fillRect(from, top, place(time[Math.min(k, end)]) - from, height);
    }
    first = k;
  }
}

/** The points of a curve that no line reaches, since gaps lie on both sides: they are dots. */
function lonely(u, number) {
  const values = u.data[number];
  const own = [];
  for (let i = 0; i < values.length; i++) if (values[i] !== undefined) own.push(i);
  const there = (k) => typeof values[own[k]] === "number";
  return own.filter((_, k) => there(k) && !there(k - 1) && !there(k + 1));
}

/** uPlot's options for a panel; `view` says what is shown: {from, to, zoomed, hidden}. */
function optionsOf(panel, signals, view, size) {
  const axis = () => ({
    stroke: () => styleColor("--soft"),
    grid: { stroke: () => styleColor("--grid"), width: 1 },
    ticks: { stroke: () => styleColor("--grid"), width: 1, size: 4 },
    font: "11px system-ui, sans-serif",
    values: (_, marks) => {
      // Sums of steps: what is left of them at zero is rounding.
      const least = 1e-9 * Math.max(...marks.map(Math.abs));
      return marks.map((mark) => (mark === null ? "" : marked(Math.abs(mark) < least ? 0 : mark)));
    },
  });
  return {
    ...size,
    legend: { show: false },
    pxAlign: 0,
    padding: [8, 10, 0, 0],
    scales: {
      x: { time: false, range: () => [view.from, view.to] },
      y: { range: () => heights(panel, signals, view) },
    },
    series: [
      {},
      ...panel.curves.map((curve) => ({
        label: curve.label,
        stroke: () => shownColor(curve.color),
        dash: dashOf(curve),
        width: curve.dash.length ? 1.5 : 1.8,
        points: { show: true, size: 5, fill: () => shownColor(curve.color), filter: lonely },
      })),
    ],
    axes: [
      { ...axis(), size: 24, space: 56 },
      { ...axis(), size: ORDINATE, gap: 3, space: 28 },
    ],
    cursor: {
      y: false,
      points: { show: false },
      drag: { x: true, y: false, setScale: false },
      bind: { dblclick: () => () => null, mouseleave: () => () => null },
    },
    hooks: {
      drawClear: [(u) => drawBands(u, panel, signals)],
      draw: [(u) => drawMarks(u, panel, signals, view)],
    },
  };
}
