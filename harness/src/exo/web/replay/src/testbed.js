// The testbed of one axis as a drawing: mass on its rail, load cell and hand, wall, and the nominal mass as a ghost.

import { metres, newtons, nice } from "./format.js";
import { put, say, show, svg } from "./dom.js";
import { rail } from "./rail.js";

const HEIGHT = 206;
const FLOOR = 158;
const BLOCK = { width: 74, height: 46 };
const TOP = FLOOR - 8 - BLOCK.height;

/** The drawing; `extent` is where mass and nominal come to (m), `most` the largest force (N). */
export function testbedDrawing({ geometry, extent, most }) {
  const root = svg("svg", { class: "er-svg", role: "presentation", focusable: "false" });
  const box = svg("g");
  root.append(box);
  let parts = null;
  let width = 0;
  let range = extent;
  let strongest = most;
  let last = null;

  function build() {
    box.replaceChildren();
    put(root, { viewBox: `0 0 ${width} ${HEIGHT}`, width, height: HEIGHT });
    const narrow = width < 520;
    // A block's place is its right face: what hangs on its left needs room.
    const scale = rail({ extent: range, wall: geometry.wall, left: BLOCK.width + 52, right: width - (narrow ? 12 : 24) });
    const longest = narrow ? 58 : 92;
    const perNewton = longest / strongest;
    parts = { scale, perNewton, longest, width, ...moving(geometry) };
    box.append(...background(scale, geometry, width), ...parts.layers);
    if (last) move(parts, geometry, ...last);
  }

  return {
    element: root,
    resize(pixels) {
      width = Math.max(260, Math.round(pixels));
      build();
    },
    draw(state, status) {
      const seen = [state.q, state.q_n ?? state.q];
      const force = Math.max(Math.abs(state.tau_h ?? 0), Math.abs(state.tau_a ?? 0));
      const grown = [Math.min(range[0], ...seen), Math.max(range[1], ...seen)];
      if (grown[0] < range[0] || grown[1] > range[1] || force > strongest) {
        range = [grown[0] < range[0] ? 1.5 * grown[0] : range[0], grown[1] > range[1] ? 1.5 * grown[1] : range[1]];
        strongest = nice(Math.max(force, strongest));
        if (width) build();
      }
      last = [state, status];
      if (parts) move(parts, geometry, state, status);
    },
    paint() {},
    render() {},
    /** What is drawn where (m). */
    pose: () => ({ q: last?.[0].q, q_n: last?.[0].q_n }),
    dispose: () => root.remove(),
  };
}

function background(scale, geometry, width) {
  const layers = [];
  for (const [from, to] of [[scale.left, scale.linear[0]], [scale.linear[1], scale.right]]) {
    if (to - from < 1) continue;
    layers.push(svg("rect", { class: "er-squeezed", x: from, y: FLOOR + 1, width: to - from, height: 13 }));
    if (to - from > 120) layers.push(svg("text", { class: "er-small", x: (from + to) / 2, y: HEIGHT - 8, "text-anchor": "middle" }, "scale squeezed here"));
  }
  layers.push(svg("line", { class: "er-rail", x1: 4, x2: scale.right, y1: FLOOR, y2: FLOOR }));
  for (const { q, text } of scale.ticks) {
    const x = scale.at(q);
    layers.push(svg("line", { class: "er-tick", x1: x, x2: x, y1: FLOOR, y2: FLOOR + 6 }));
    layers.push(svg("text", { class: "er-small", x, y: FLOOR + 22, "text-anchor": "middle" }, text));
  }
  layers.push(svg("text", { class: "er-small", x: width - 4, y: HEIGHT - 8, "text-anchor": "end" }, "q [m]"));
  if (geometry.wall !== null) {
    const x = scale.at(geometry.wall);
    layers.push(svg("rect", { class: "er-beyond", x, y: 34, width: Math.max(0, scale.right - x), height: FLOOR - 34 }));
    layers.push(svg("rect", { class: "er-wall", x, y: 34, width: 12, height: FLOOR - 34 }));
    for (let y = 34; y < FLOOR - 6; y += 12) layers.push(svg("line", { class: "er-hatch", x1: x, y1: y + 12, x2: x + 12, y2: y }));
    layers.push(svg("text", { class: "er-label", x: x + 6, y: 28, "text-anchor": "middle" }, "wall"));
  }
  return layers;
}

function moving(geometry) {
  const spring = svg("polyline", { class: "er-spring" });
  const mass = svg("g", {});
  const middle = -BLOCK.width / 2;
  mass.append(
    svg("line", { class: "er-rod", x1: -BLOCK.width - 40, x2: -BLOCK.width, y1: TOP + 26, y2: TOP + 26 }),
    svg("rect", { class: "er-cell", x: -BLOCK.width - 20, y: TOP + 17, width: 16, height: 18, rx: 2 }),
    svg("circle", { class: "er-hand", cx: -BLOCK.width - 40, cy: TOP + 26, r: 8 }),
    svg("circle", { class: "er-wheel", cx: -BLOCK.width + 14, cy: FLOOR - 6, r: 6 }),
    svg("circle", { class: "er-wheel", cx: -14, cy: FLOOR - 6, r: 6 }),
    svg("rect", { class: "er-mass", x: -BLOCK.width, y: TOP, width: BLOCK.width, height: BLOCK.height, rx: 4 }),
    svg("text", { class: "er-on", x: middle, y: TOP + 20, "text-anchor": "middle" }, "mass"),
    svg("text", { class: "er-on", x: middle, y: TOP + 36, "text-anchor": "middle" }, `${Number(geometry.M.toPrecision(3))} kg`),
  );
  const ghost = svg("g", {}, svg("rect", { class: "er-ghost", x: -BLOCK.width, y: TOP, width: BLOCK.width, height: BLOCK.height, rx: 4 }));
  const ghostName = svg("text", { class: "er-label er-ghost-name", y: 14 });
  const leader = svg("line", { class: "er-leader", y1: 19, y2: TOP - 2 });
  const cell = svg("text", { class: "er-small", y: TOP + BLOCK.height + 2, "text-anchor": "end" }, "load cell");
  // Where only the direction can be seen, a number says how far.
  const place = svg("text", { class: "er-label er-place", y: 30 });
  const arrows = Object.fromEntries(["hand", "drive", "wall", "unseen"].map((name) => [name, arrow(name)]));
  const verdict = svg("text", { class: "er-verdict", y: TOP - 30, "text-anchor": "middle" });
  const layers = [ghost, spring, mass, cell, place, leader, ghostName, verdict, ...Object.values(arrows).map((one) => one.element)];
  return { spring, mass, place, ghost, ghostName, leader, cell, verdict, arrows, layers };
}

function arrow(name) {
  const line = svg("line", { class: "er-shaft" });
  const head = svg("polygon", { class: "er-head" });
  const text = svg("text", { class: "er-label" });
  const element = svg("g", { class: `er-arrow er-${name}` }, line, head, text);
  return { element, line, head, text };
}

/** An arrow from `x` along the rail; `label` stands behind its tail or above it. */
function point({ element, line, head, text }, { x, y, force, parts, label, anchor, labelX, labelY, most = parts.longest }) {
  const reach = Math.sign(force) * Math.min(Math.abs(force) * parts.perNewton, force < 0 ? most : parts.longest);
  const seen = Math.abs(reach) > 0.8;
  show(element, seen);
  if (!seen) return;
  const tip = x + reach;
  const size = Math.min(9, Math.max(4, Math.abs(reach)));
  const neck = tip - Math.sign(reach) * size;
  put(line, { x1: x, x2: neck, y1: y, y2: y });
  put(head, { points: `${tip},${y} ${neck},${y - size * 0.62} ${neck},${y + size * 0.62}` });
  put(text, { x: labelX, y: labelY, "text-anchor": anchor });
  say(text, label);
}

function move(parts, geometry, state, status) {
  const { scale, arrows } = parts;
  const x = scale.at(state.q);
  put(parts.mass, { transform: `translate(${x.toFixed(2)} 0)` });
  put(parts.mass, { class: status.kind === "sticks" ? "er-stuck" : status.kind === "letGo" ? "er-loose" : "" });
  put(parts.cell, { x: (x - BLOCK.width - 2).toFixed(1) });
  const far = state.q < scale.seen[0] - 0.005 || state.q > scale.seen[1] + 0.005;
  show(parts.place, far);
  put(parts.place, { x: Math.max(4, x - BLOCK.width - 48).toFixed(1) });
  if (far) say(parts.place, `mass at ${metres(state.q)}`);
  badge(parts, status, x);
  nominal(parts, geometry, state, x);
  // The arrow ends at a hand that pushes, and begins at one that pulls.
  const hand = x - BLOCK.width - 48;
  const push = Math.max(0, Math.min((state.tau_h ?? 0) * parts.perNewton, parts.longest));
  const pull = Math.min(0, Math.max((state.tau_h ?? 0) * parts.perNewton, 10 - hand));
  point(arrows.hand, {
    x: hand - push, most: -pull, y: TOP + 26, force: state.tau_h ?? 0, parts, label: `hand ${(state.tau_h ?? 0) < 0 ? "pulls" : "pushes"} ${newtons(Math.abs(state.tau_h ?? 0))}`,
    labelX: Math.max(4, hand - 8), labelY: TOP - 8, anchor: "start",
  });
  const middle = x - BLOCK.width / 2;
  point(arrows.drive, {
    x: middle, y: TOP + BLOCK.height - 3, force: state.tau_a ?? 0, parts, label: `drive ${newtons(Math.abs(state.tau_a ?? 0))}`,
    labelX: Math.min(middle + 4, scale.right - 70), labelY: FLOOR + 40, anchor: "middle",
  });
  point(arrows.wall, {
    x, y: TOP + 10, force: state.tau_e ?? 0, parts, label: `wall ${newtons(Math.abs(state.tau_e ?? 0))}`,
    labelX: x + 18, labelY: TOP - 10, anchor: "start",
  });
  point(arrows.unseen, {
    x: middle, y: TOP - 4, force: state.tau_d ?? 0, parts, label: `unseen ${newtons(Math.abs(state.tau_d ?? 0))}`,
    labelX: middle, labelY: TOP - 34, anchor: "middle",
  });
}

/** What happens, above the mass. */
function badge(parts, status, x) {
  const words = { sticks: `sticks ${status.lasted.toFixed(1)} s`, letGo: `lets go after ${status.lasted.toFixed(2)} s` }[status.kind] ?? "";
  show(parts.verdict, words !== "");
  const half = 4.9 * words.length;
  put(parts.verdict, { class: `er-verdict er-${status.kind}`, x: Math.min(Math.max(x - BLOCK.width / 2, half), x - half + 8 > half ? x - half : half).toFixed(1) });
  say(parts.verdict, words);
}

function nominal(parts, geometry, state, x) {
  const { scale } = parts;
  const known = state.q_n !== undefined;
  for (const element of [parts.ghost, parts.ghostName, parts.leader, parts.spring]) show(element, known);
  if (!known) return;
  const ghost = scale.at(state.q_n);
  put(parts.ghost, { transform: `translate(${ghost.toFixed(2)} 0)` });
  const e = state.q_n - state.q;
  const beyond = geometry.wall !== null && state.q_n > geometry.wall + 0.005;
  const text = beyond ? `nominal mass, ${metres(state.q_n - geometry.wall)} behind the wall` : Math.abs(e) < 0.02 ? "nominal mass" : `nominal mass, ${metres(Math.abs(e))} to the ${e < 0 ? "left" : "right"}`;
  say(parts.ghostName, text);
  const centre = ghost - BLOCK.width / 2;
  const half = 3.95 * text.length;
  put(parts.ghostName, { x: Math.min(Math.max(centre, half + 2), parts.width - half - 2).toFixed(1), "text-anchor": "middle" });
  put(parts.leader, { x1: centre.toFixed(1), x2: centre.toFixed(1) });
  show(parts.spring, Math.abs(ghost - x) > BLOCK.width + 6);
  const [from, to] = ghost > x ? [x, ghost - BLOCK.width] : [x - BLOCK.width, ghost];
  const y = TOP + 30;
  const turns = 9;
  const zigzag = Array.from({ length: 2 * turns + 1 }, (_, i) => `${(from + ((to - from) * (i + 0.5)) / (2 * turns + 1)).toFixed(1)},${y + (i % 2 ? 5 : -5)}`);
  put(parts.spring, { points: [`${from.toFixed(1)},${y}`, ...zigzag, `${to.toFixed(1)},${y}`].join(" ") });
}
