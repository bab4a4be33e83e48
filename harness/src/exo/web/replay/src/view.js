// One case on the page: its name or a choice of cases, the drawing, a sentence, forces with their units.

import { FORCES, LENGTH } from "./arrows.js";
import { html, put, say, show } from "./dom.js";
import { newtons } from "./format.js";
import { points } from "./kinematics.js";
import { words } from "./status.js";

/** A view; `chooser` is what stands in its head: a select, or a name; `about` says what law it is. */
export function view({ chooser, about = "", geometry, drawing, forces = {} }) {
  const badge = html("span", { class: "er-badge" });
  const count = html("span", { class: "er-count" });
  const sentence = html("p", { class: "er-say" });
  const values = Object.fromEntries(Object.keys(forces).map((name) => [name, html("b")]));
  const legend = html("ul", { class: "er-legend" }, ...entries(geometry, values, forces));
  const draw = html("div", { class: "er-draw", role: "img" }, drawing.element);
  const element = html("section", { class: "er-view" }, html("div", { class: "er-head-line" }, chooser, badge, count), about ? html("p", { class: "er-about" }, about) : null, draw, sentence, legend);
  let told = "";

  return {
    element,
    drawing,
    resize: (density) => drawing.resize(draw.clientWidth, heightOf(draw.clientWidth), density),
    /** Draws a state; `status(state, pads)` says what it is. Answers a sentence when the robot sticks or lets go. */
    update(state, status, { quiet = false } = {}) {
      const pads = geometry.kind === "testbed" ? [] : state.arms.map((arm, i) => points(geometry, geometry.bases[i], arm.q).pad);
      const now = status(state, pads);
      const [word, text] = words(now, geometry, state.attached);
      drawing.draw(state, now);
      say(badge, word);
      put(badge, { class: `er-badge er-${now.kind}` });
      const stuck = now.kind === "sticks" || now.lasted > 0;
      show(count, stuck);
      if (stuck) say(count, `${now.kind === "sticks" ? "stuck" : "was stuck"} ${now.lasted.toFixed(2)} s`);
      put(count, { class: `er-count er-${now.kind}` });
      say(sentence, text + behind(geometry, state, now));
      if (geometry.kind !== "testbed") forcesTold(values, state);
      if (!quiet) put(draw, { "aria-label": `At ${state.time.toFixed(1)} s: ${sentence.textContent}` });
      const news = now.kind !== told && (now.kind === "sticks" || now.kind === "letGo");
      told = now.kind;
      return news ? sentence.textContent : "";
    },
    dispose() {
      drawing.dispose();
      element.remove();
    },
  };
}

const heightOf = (width) => Math.round(Math.min(430, Math.max(250, 0.68 * width)));

/** Why it sticks: where the nominal is, and what the drive therefore does. */
function behind(geometry, state, status) {
  if (geometry.kind !== "testbed" || geometry.wall === null || state.q_n === undefined || status.kind === "free") return "";
  const depth = state.q_n - geometry.wall;
  if (depth < 0.1 || (state.tau_a ?? 0) <= 0) return "";
  return ` The nominal mass is ${depth.toFixed(depth < 10 ? 1 : 0)} m behind the wall, so the drive pushes with ${newtons(state.tau_a)}.`;
}

function entries(geometry, values, forces) {
  if (geometry.kind === "testbed") {
    return [
      ...[["robot", "mass"], ["nominal", "nominal mass: the law's model"]].map(([color, text]) => entry(color, text, null, "ball")),
    ];
  }
  return [
    entry("nominal", "nominal hand: the law's model", null, "ball"),
    ...Object.keys(forces).map((name) => entry(name, FORCES[name].name, values[name])),
  ];
}

/** How long the arrows are, and what is drawn otherwise than it is. */
export function scaleNote(geometry, forces) {
  if (geometry.kind === "testbed") return `The longest arrow stands for ${newtons(forces.longest)}; larger forces are cut off.`;
  const scales = Object.entries(forces).map(([name, newton]) => `${FORCES[name].short} ${newtons((0.1 * newton) / LENGTH).replace(".0\u00a0", "\u00a0")}`);
  const plate = geometry.payload ? " The payload is a point in the model; drawn is a steel plate of its mass." : "";
  return `0.1 m of an arrow stands for: ${scales.join(", ")}; very large forces are cut off. Squares of the grid: 0.1 m.${plate}`;
}

function entry(color, text, value, shape = "") {
  return html("li", {}, html("span", { class: `er-swatch ${shape && `er-${shape}`}`, style: `background:var(--${color})` }), text, value);
}

function forcesTold(values, state) {
  const size = (name) => Math.max(...state.arms.map((arm) => (name === "payload" ? Math.max(0, arm.tension ?? 0) : Math.hypot(...(arm[FORCES[name].of[0]] ?? [0, 0, 0])))));
  for (const [name, element] of Object.entries(values)) say(element, newtons(size(name)));
}
