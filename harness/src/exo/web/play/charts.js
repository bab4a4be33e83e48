// Strip charts of the last seconds.
"use strict";

const PLAY_WINDOW = 20;
const PLAY_NAMES = {
  "plant.q": "mass", "controller.q_n": "nominal mass", "controller.tau_h": "hand", "controller.tau_a": "drive",
  "controller.energy.tank": "tank", "plant.p[3]": "handle", "controller.p_n[3]": "nominal handle", "controller.f_h[3]": "hand",
  "plant.f_e[3]": "table", "controller.tau_a[1]": "joint 1", "controller.tau_a[2]": "joint 2", "controller.tau_a[3]": "joint 3",
};

/** As in the drawing above, where it shows them. */
const PLAY_COLOURS = {
  "plant.q": "--robot", "controller.q_n": "--nominal", "controller.tau_h": "--hand", "controller.tau_a": "--drive",
  "controller.energy.tank": "--tank", "plant.p[3]": "--robot", "controller.p_n[3]": "--nominal", "controller.f_h[3]": "--hand",
  "plant.f_e[3]": "--contact", "controller.tau_a[1]": "--drive", "controller.tau_a[2]": "--robot", "controller.tau_a[3]": "--touch",
};
/** Lines of a panel differ without their colours, too. */
const PLAY_DASHES = [[undefined, "solid"], [[6, 3], "dashed"], [[2, 3], "dotted"]];

function playCharts(bench) {
  const place = document.getElementById("charts");
  const columns = [...new Set(bench.panels.flatMap(([, , names]) => names))];
  const rows = Object.fromEntries(columns.map((name) => [name, []]));
  let [times, charts, run, drawn] = [[], [], 0, 0];

  /** The first column in full; the others as far as they stay within a few of its spans, so that it can be read. */
  function range(chart, low, high) {
    if (low === null) return [-1, 1];
    const own = chart.data[1].filter((value) => value !== null);
    const [least, most] = [Math.min(...own), Math.max(...own)];
    const reach = Math.max(0.3, most - least);
    const [from, to] = chart.unit === "m" ? [Math.max(low, least - reach), Math.min(high, most + reach)] : [low, high];
    const margin = Math.max(0.08 * (to - from), chart.unit === "m" ? 0.01 : 0.5);
    return [from - margin, to + margin];
  }

  function build() {
    charts.forEach((chart) => chart.destroy());
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    const axis = { stroke: colour("--soft"), grid: { stroke: colour("--line"), width: 1 }, ticks: { stroke: colour("--line"), width: 1 }, font: "12px system-ui, sans-serif" };
    charts = bench.panels.map(([title, unit, names]) => {
      const chart = new uPlot({
        width: width(), height: 150, title: `${title} [${unit}]`, cursor: { show: false }, select: { show: false },
        legend: { live: false, show: names.length > 1, markers: { width: 3, dash: (_chart, i) => PLAY_DASHES[i - 1]?.[1] ?? "solid" } },
        scales: { x: { time: false, range: () => [Math.max(0, (times.at(-1) ?? 0) - PLAY_WINDOW), Math.max(PLAY_WINDOW, times.at(-1) ?? 0)] }, y: { range } },
        axes: [{ ...axis, size: 28, values: (_chart, values) => values.map((value) => `${value} s`) }, { ...axis, size: 58, values: (_chart, values) => values.map((value) => (Math.abs(value) >= 2000 ? `${value / 1000}k` : `${value}`).replace("-", "−")) }],
        series: [{}, ...names.map((name, i) => ({ label: PLAY_NAMES[name] ?? name, stroke: colour(PLAY_COLOURS[name]), width: 2, dash: PLAY_DASHES[i][0] }))],
      }, [times, ...names.map((name) => rows[name])], place);
      chart.unit = unit;
      chart.names = names;
      chart.root.setAttribute("role", "img");
      chart.root.setAttribute("aria-label", `${title} in ${unit} over the last ${PLAY_WINDOW} s: ${names.map((name) => PLAY_NAMES[name] ?? name).join(", ")}`);
      return chart;
    });
  }
  /** As wide as a column of the page's grid is. */
  function width() {
    const columns = getComputedStyle(place).gridTemplateColumns.split(" ").map(parseFloat);
    return Math.floor(Math.min(...columns.filter((one) => one > 0), place.clientWidth) || 300);
  }

  build();
  new ResizeObserver(() => charts.forEach((chart) => chart.width !== width() && chart.setSize({ width: width(), height: 150 }))).observe(place);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", build);

  return {
    update(state) {
      if (state.run !== run || state.time < (times.at(-1) ?? 0)) {
        run = state.run;
        times = [];
        for (const name of columns) rows[name] = [];
      }
      if (!Object.keys(state.values).length || state.time === times.at(-1)) return;
      times.push(state.time);
      for (const name of columns) rows[name].push(name in bench.forces ? state.force[bench.forces[name]] : state.values[name]);
      while (times[0] < state.time - PLAY_WINDOW - 1) {
        times.shift();
        for (const name of columns) rows[name].shift();
      }
      // Fifteen times a second is enough for the eye.
      const now = performance.now();
      if (now - drawn < 66) return;
      drawn = now;
      for (const chart of charts) chart.setData([times, ...chart.names.map((name) => rows[name])]);
    },
    /** What is plotted: for tests. */
    data: () => ({ times: times.length, last: Object.fromEntries(columns.map((name) => [name, rows[name].at(-1)])) }),
  };
}
