// A recorded scene on the page: one or two of its cases, in step with a bus.

import { decode, extent, stateAt, usualSize } from "./decode.js";
import { drawingOf, has3d, shared } from "./drawings.js";
import { html, say } from "./dom.js";
import { followTheme, styled } from "./look.js";
import { orbit } from "./orbit.js";
import { player } from "./player.js";
import { onRestored } from "./renderer.js";
import { recordedStatus } from "./status.js";
import { scaleNote, view } from "./view.js";

const NONE = "";

/**
 * Shows `scene` (exo.replay.scene) in `element`, in step with `bus` (timebus.js).
 *
 * `options.autoplay`: plays once when first seen, unless the reader prefers reduced motion. Answers `dispose()`, `play()`,
 * `pause()`, `show(cases)` and `state()`: time, speed, whether it plays, and the pose of each view as it is drawn (m).
 */
export function mount(element, scene, bus, options = {}) {
  if (scene?.version !== 1) throw new Error(`exoReplay: expected a scene of version 1, got ${scene?.version}`);
  styled();
  const ids = Object.keys(scene.cases);
  const decoded = new Map();
  const caseOf = (id) => {
    if (!decoded.has(id)) decoded.set(id, decode(id, scene.cases[id]));
    return decoded.get(id);
  };
  const testbed = scene.kind === "testbed";
  let chosen = scene.pair.filter((id) => id in scene.cases);
  let views = [];
  let camera = null;
  let common = null;
  let dirty = true;
  let visible = true;
  let colours = null;
  let queued = 0;

  const transport = player({ bus, story: scene.story });
  const place = html("div", { class: `er-views ${testbed ? "" : "er-beside"}` });
  const cameraBar = html("div", { class: "er-group" });
  const bar = html("div", { class: "er-bar" }, transport.watch, cameraBar);
  const scales = html("p", { class: "er-scale er-soft" });
  const news = html("div", { class: "er-live", "aria-live": "polite" });
  const note = testbed || has3d() ? null : html("p", { class: "er-note" }, "This browser offers no WebGL, so the arm is drawn from the side and not in three dimensions.");
  const root = html("div", { class: "exo-replay", tabindex: 0, role: "group", "aria-label": `Replay: ${scene.title}` }, note, bar, place, scales, transport.element, news);
  element.append(root);

  function select(row) {
    const list = html("select", { "aria-label": row === 0 ? "First case" : "Second case" });
    for (const id of ids) list.append(html("option", { value: id }, scene.cases[id].label));
    if (row === 1) list.append(html("option", { value: NONE }, "no second case"));
    list.value = chosen[row] ?? NONE;
    list.addEventListener("change", () => {
      chosen[row] = list.value;
      chosen = chosen.filter((id) => id !== NONE);
      build();
      place.querySelectorAll("select")[row]?.focus();
    });
    return ids.length > 1 ? list : html("span", { class: "er-name-line" }, scene.cases[ids[0]].label);
  }

  function build() {
    views.forEach((one) => one.release());
    const cases = chosen.map(caseOf);
    const geometry = cases[0].geometry;
    const before = common?.look;
    common = shared({ geometry, usual: (...names) => usualSize(cases, ...names), extent: testbed ? extent(cases, "q", "q_n") : null });
    // Another pair of cases leaves the camera where it is.
    if (before) common.look = before;
    if (!camera && common.look && has3d()) {
      camera = orbit({ look: common.look, geometry, changed: queue });
      cameraBar.append(camera.element);
    }
    views = cases.map((one, row) => {
      const drawing = drawingOf(one.geometry, common);
      const made = view({ chooser: select(row), about: one.about, geometry: one.geometry, drawing, forces: common.forces });
      const detach = camera?.attach(drawing.element);
      place.append(made.element);
      return { ...made, case: one, release: () => (detach?.(), made.dispose()) };
    });
    if (chosen.length === 1 && ids.length > 1) bar.append((more ??= second()));
    else more?.remove();
    say(scales, scaleNote(geometry, common.forces));
    transport.marks(cases);
    if (colours) views.forEach((one) => one.drawing.paint(colours));
    resize();
  }

  let more = null;
  function second() {
    const button = html("button", { type: "button" }, "Compare with another case");
    button.addEventListener("click", () => {
      chosen = [chosen[0], ids.find((id) => id !== chosen[0])];
      build();
    });
    return button;
  }

  function resize() {
    const density = Math.min(2, window.devicePixelRatio || 1);
    views.forEach((one) => one.resize(density));
    queue();
  }
  function queue() {
    dirty = true;
    if (!queued && visible) queued = requestAnimationFrame(paint);
  }
  function paint() {
    queued = 0;
    if (!dirty) return;
    dirty = false;
    refresh();
    camera?.keepIn(views.flatMap((one) => one.drawing.hands()));
    views.forEach((one) => one.drawing.render());
  }
  /** Poses follow the bus at once, pictures with the next frame. */
  function refresh() {
    for (const one of views) {
      const state = stateAt(one.case, bus.time);
      const heard = one.update(state, (now, pads) => recordedStatus(one.case, now, pads), { quiet: transport.playing });
      if (heard) say(news, `${one.case.label}: ${heard}`);
    }
  }

  const stop = bus.subscribe(() => {
    refresh();
    queue();
  });
  const unfollow = followTheme(root, (palette) => {
    colours = palette;
    views.forEach((one) => one.drawing.paint(palette));
    queue();
  });
  const unrestore = onRestored(queue);
  const sizes = new ResizeObserver(resize);
  let waiting = options.autoplay === true;
  const seen = new IntersectionObserver(([entry]) => {
    visible = entry.isIntersecting;
    if (visible) queue();
    else if (transport.playing && !waiting) transport.pause();
    if (visible && waiting && entry.intersectionRatio > 0.4) {
      waiting = false;
      transport.autoplay();
    }
  }, { threshold: [0, 0.5] });
  const key = (event) => transport.key(event);
  root.addEventListener("keydown", key);
  build();
  refresh();
  sizes.observe(place);
  seen.observe(root);

  return {
    play: () => transport.start(),
    pause: () => transport.pause(),
    show(cases) {
      for (const id of cases) if (!(id in scene.cases)) throw new Error(`exoReplay: no case ${id}; expected one of ${ids.join(", ")}`);
      chosen = cases.slice(0, 2);
      build();
      refresh();
    },
    state: () => ({
      time: bus.time, playing: transport.playing, speed: transport.speed,
      views: views.map((one) => ({ case: one.case.id, ...one.drawing.pose() })),
    }),
    dispose() {
      if (queued) cancelAnimationFrame(queued);
      transport.dispose();
      stop();
      unfollow();
      unrestore();
      sizes.disconnect();
      seen.disconnect();
      views.forEach((one) => one.release());
      root.remove();
    },
  };
}
