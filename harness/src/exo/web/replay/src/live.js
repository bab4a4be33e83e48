// The same drawing for a page that feeds it state by state.

import { drawingOf, has3d, shared } from "./drawings.js";
import { html, say } from "./dom.js";
import { followTheme, styled } from "./look.js";
import { orbit } from "./orbit.js";
import { points } from "./kinematics.js";
import { onRestored } from "./renderer.js";
import { liveStatus } from "./status.js";
import { scaleNote, view } from "./view.js";

/** What a hand, a table and a payload come to where nobody says more (N). */
const USUAL = { f_h: 20, f_e: 500, tension: 200, tau_h: 5, tau_a: 12.5, tau_e: 20 };

/**
 * Shows a plant whose state comes later. `geometry` is `exo.replay.geometry(parameters)`; `options.title` names it,
 * `options.largest` replaces what the arrows are scaled by (N, by column). A camera that nobody has moved steps back where a
 * handle would leave the picture, but not while `options.still()`.
 *
 * `update(state)` draws a state. Testbed: `time`, `q`, `q_n` (m), `tau_h`, `tau_a`, `tau_e`, `tau_d` (N), of which only `time`
 * and `q` must be there. Arm: `time`, `arms` with one object an arm, `q` (three joint angles, rad), `p_n` (m), `f_h`, `f_e`,
 * `f_d`, `tension` (N), of which only `q` must be there; `attached`, and `payload`, where it lies while it is not held (m).
 * It answers the status: `kind` is free, presses, rests, sticks or letGo; `lasted` is how long it has stuck (s).
 * `reshape(geometry)` takes another table, wall or payload. `distance()` is that of the eye (m), or null.
 */
export function live(element, geometry, options = {}) {
  styled();
  const sizes = { ...USUAL, ...options.largest };
  const usual = (...names) => Math.max(0, ...names.map((name) => sizes[name] ?? 0));
  const title = html("span", { class: "er-name-line" }, options.title ?? (geometry.kind === "testbed" ? "Testbed" : "Arm"));
  const place = html("div", { class: "er-views" });
  const cameraBar = html("div", { class: "er-bar" });
  const note = geometry.kind === "testbed" || has3d() ? null : html("p", { class: "er-note" }, "This browser offers no WebGL, so the arm is drawn from the side and not in three dimensions.");
  const scales = html("p", { class: "er-scale er-soft" });
  const news = html("div", { class: "er-live", "aria-live": "polite" });
  const root = html("div", { class: "exo-replay", role: "group", "aria-label": `Live: ${title.textContent}` }, note, cameraBar, place, scales, news);
  element.append(root);
  const status = liveStatus();
  let [shown, camera, detach, common, colours, state] = [null, null, null, null, null, null];
  let queued = 0;

  function build(next) {
    detach?.();
    shown?.dispose();
    const look = common?.look;
    const wall = next.wall ?? 0.5;
    common = shared({ geometry: next, usual, extent: next.kind === "testbed" ? [Math.min(-0.8, wall - 1.1), wall + 0.3] : null });
    if (look) common.look = look;
    if (!camera && common.look && has3d()) {
      camera = orbit({ look: common.look, geometry: next, changed: queue });
      cameraBar.append(camera.element);
    }
    const drawing = drawingOf(next, common);
    shown = view({ chooser: title, geometry: next, drawing, forces: common.forces });
    detach = camera?.attach(drawing.element);
    place.append(shown.element);
    say(scales, scaleNote(next, common.forces));
    if (colours) drawing.paint(colours);
    resize();
  }
  function resize() {
    shown.resize(Math.min(2, window.devicePixelRatio || 1));
    queue();
  }
  function queue() {
    if (!queued) queued = requestAnimationFrame(paint);
  }
  let last = { kind: "free", lasted: 0, surface: "" };
  function paint() {
    queued = 0;
    if (!state) return;
    const heard = shown.update(state, () => last);
    if (heard) say(news, heard);
    if (!options.still?.()) camera?.keepIn(shown.drawing.hands());
    shown.drawing.render();
  }
  const unfollow = followTheme(root, (palette) => {
    colours = palette;
    shown?.drawing.paint(palette);
    queue();
  });
  const unrestore = onRestored(queue);
  const observer = new ResizeObserver(resize);
  let shape = geometry;
  build(geometry);
  observer.observe(place);

  return {
    update(next) {
      state = shape.kind === "testbed" ? next : { payload: [0.44, 0, shape.table ?? -0.75], ...next };
      last = status(shape, state, shape.kind === "testbed" ? [] : state.arms.map((arm, i) => points(shape, shape.bases[i], arm.q).pad));
      queue();
      return last;
    },
    reshape(next) {
      shape = next;
      build(next);
    },
    /** From the eye to the arm (m); null for a drawing that has none. */
    distance: () => camera?.distance() ?? null,
    state: () => ({ ...shown.drawing.pose(), status: last }),
    dispose() {
      if (queued) cancelAnimationFrame(queued);
      observer.disconnect();
      unfollow();
      unrestore();
      detach?.();
      shown.dispose();
      root.remove();
    },
  };
}
