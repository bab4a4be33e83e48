// Play, pause, scrub, speed: moves the bus, and follows it.

import { html, put, say, svg } from "./dom.js";
import { still } from "./look.js";

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8, 16];
export const SOURCE = "replay";
const STRIP = { row: 7, gap: 3 };

/** The transport of a bus; `step` is what an arrow key moves (s). */
export function player({ bus, story, step = 0.1 }) {
  const [first, last] = bus.range;
  const play = html("button", { type: "button", class: "er-play", "aria-keyshortcuts": "Space" });
  const slider = html("input", { type: "range", min: first, max: last, step: 0.001, "aria-label": "Time", value: bus.time });
  const strip = svg("svg", { class: "er-strip", "aria-hidden": "true" });
  const marks = html("div", { class: "er-marks", "aria-hidden": "true" });
  const time = html("span", { class: "er-time" });
  const speeds = html("select", { "aria-label": "Speed" }, ...SPEEDS.map((one) => html("option", { value: one }, one < 1 ? `1/${1 / one}×` : `${one}×`)));
  const watch = story ? html("button", { type: "button", class: "er-story" }) : null;
  speeds.value = "1";
  let frame = 0;
  let before = 0;
  let end = last;

  function tick(now) {
    const passed = Math.min(0.1, (now - before) / 1000) * Number(speeds.value);
    before = now;
    const next = Math.min(bus.time + passed, end);
    bus.set(next, SOURCE);
    if (next >= end) pause();
    else frame = requestAnimationFrame(tick);
  }
  function start(until = last) {
    if (frame) cancelAnimationFrame(frame);
    end = until;
    if (bus.time >= end - 1e-6) bus.set(first, SOURCE);
    before = performance.now();
    frame = requestAnimationFrame(tick);
    told();
  }
  function pause() {
    if (frame) cancelAnimationFrame(frame);
    frame = 0;
    told();
  }
  function told() {
    say(play, frame ? "❚❚ Pause" : "▶ Play");
    put(play, { "aria-label": frame ? "Pause" : "Play" });
  }
  function watched() {
    speeds.value = String(SPEEDS.includes(story.speed) ? story.speed : 1);
    bus.set(story.from, SOURCE);
    start(story.to);
  }
  function moved(t) {
    slider.value = String(t);
    put(slider, { "aria-valuetext": `${t.toFixed(2)} seconds of ${last.toFixed(0)}` });
    say(time, `${t.toFixed(2)} s / ${last.toFixed(0)} s`);
  }
  play.addEventListener("click", () => (frame ? pause() : start()));
  slider.addEventListener("input", () => bus.set(Number(slider.value), SOURCE));
  if (watch) {
    const length = Math.round((story.to - story.from) / story.speed);
    say(watch, `▶ Watch how it sticks (${length} s)`);
    watch.addEventListener("click", watched);
  }
  const stop = bus.subscribe(moved);
  told();
  moved(bus.time);

  /** Space plays; arrows step, with Shift ten times as far; Home and End. Where a control has a use for a key it keeps it. */
  function key(event) {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const on = event.target.closest?.("button, select, input");
    const by = event.shiftKey ? 10 * step : step;
    const moves = { ArrowLeft: () => bus.set(bus.time - by, SOURCE), ArrowRight: () => bus.set(bus.time + by, SOURCE), Home: () => bus.set(first, SOURCE), End: () => bus.set(last, SOURCE) };
    if (event.key === " " && (!on || on === slider)) (frame ? pause : start)();
    else if (moves[event.key] && (!on || on === slider || on.tagName === "BUTTON")) moves[event.key]();
    else return;
    event.preventDefault();
  }

  return {
    element: html("div", { class: "er-transport" }, play, html("div", { class: "er-scrub" }, slider, strip, marks), time, html("label", { class: "er-group" }, html("span", {}, "Speed"), speeds)),
    watch,
    key,
    start,
    pause,
    get playing() {
      return frame !== 0;
    },
    get speed() {
      return Number(speeds.value);
    },
    /** Plays the story, unless the reader wants no motion. */
    autoplay() {
      if (!still()) (story ? watched : start)();
    },
    /** Shows when each case sticks: a row of the strip a case. */
    marks(cases) {
      const height = cases.length * (STRIP.row + STRIP.gap) + 1;
      put(strip, { viewBox: `0 0 1000 ${height}`, height, preserveAspectRatio: "none" });
      const at = (t) => (1000 * (t - first)) / (last - first);
      marks.replaceChildren(...turns(cases).map(([t, text]) => html("span", { style: `left:${(at(t) / 10).toFixed(2)}%` }, text)));
      strip.replaceChildren(
        ...cases.flatMap((one, row) => {
          const y = row * (STRIP.row + STRIP.gap) + 1;
          const stuck = one.episodes.flat().filter((each) => each.to - each.from > 0.05);
          return [
            svg("rect", { class: "er-track", x: 0, y, width: 1000, height: STRIP.row }),
            ...stuck.map((each) => svg("rect", { class: "er-stuck-time", x: at(each.from), y, width: Math.max(2, at(each.to) - at(each.from)), height: STRIP.row })),
          ];
        }),
      );
    },
    dispose() {
      pause();
      stop();
    },
  };
}

/** What the story is about, on the time line: when the hand turns, and when the one lets go that has stuck the longest. */
function turns(cases) {
  const all = cases.flatMap((one) => one.episodes.flat()).sort((a, b) => b.to - b.from - (a.to - a.from));
  const longest = all[0];
  if (!longest || longest.to - longest.from < 1) return [];
  return [[longest.from, "hand turns"], ...(longest.letGo ? [[longest.to, "lets go"]] : [])];
}
