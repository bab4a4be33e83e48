// The camera: orbited by hand on any of the views, or put at a preset.

import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Vector3 } from "three";
import { html } from "./dom.js";

/** Where the camera looks from, relative to what it looks at, in distances. */
const PRESETS = {
  Corner: [0.62, -0.78, 0.42],
  Side: [0, -1, 0.06],
  Front: [1, 0, 0.12],
  Above: [-0.001, -0.02, 1],
};

/** Of half a picture: where what must be seen is too near its edge. A step back, of a distance; how far it may go (m). */
const EDGE = 0.93, STEP = 1.03, FARTHEST = 5;

/** Controls for the views' canvases, with buttons; `changed` is called when the camera has moved. */
export function orbit({ look, geometry, changed }) {
  const wide = geometry.bases.length > 1;
  const target = new Vector3(0.32, 0, geometry.table === null ? -0.22 : (geometry.table - 0.14) / 2);
  const distance = wide ? 2.85 : 2.4;
  // A camera that somebody has moved stays where it was put.
  let mine = true;
  const buttons = Object.keys(PRESETS).map((name) => html("button", { type: "button", "aria-pressed": "false" }, name));
  const names = html("button", { type: "button", "aria-pressed": String(look.named) }, "Names");
  const closer = html("button", { type: "button", "aria-label": "Closer" }, "+");
  const farther = html("button", { type: "button", "aria-label": "Farther" }, "−");

  function preset(i) {
    const [name] = Object.entries(PRESETS)[i];
    look.camera.position.set(...PRESETS[name]).normalize().multiplyScalar(distance).add(target);
    look.camera.lookAt(target);
    mine = true;
    buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(k === i)));
    changed();
  }
  buttons.forEach((button, i) => button.addEventListener("click", () => preset(i)));
  names.addEventListener("click", () => {
    look.named = !look.named;
    names.setAttribute("aria-pressed", String(look.named));
    changed();
  });
  const away = (factor) => look.camera.position.sub(target).multiplyScalar(factor).clampLength(0.7, FARTHEST).add(target);
  const zoom = (factor) => () => {
    mine = false;
    away(factor);
    changed();
  };
  closer.addEventListener("click", zoom(0.8));
  farther.addEventListener("click", zoom(1.25));
  preset(0);

  return {
    /** From the eye to what it looks at (m). */
    distance: () => look.camera.position.distanceTo(target),
    /** Steps back until all these points (m) are in the picture, unless somebody has moved the camera. */
    keepIn(points) {
      const seen = new Vector3();
      const outside = (at) => {
        seen.set(...at).project(look.camera);
        return Math.max(Math.abs(seen.x), Math.abs(seen.y)) > EDGE;
      };
      look.camera.updateMatrixWorld();
      while (mine && look.camera.position.distanceTo(target) < FARTHEST - 0.01 && points.some(outside)) {
        away(STEP);
        look.camera.updateMatrixWorld();
      }
    },
    element: html("div", { class: "er-group", role: "group", "aria-label": "Camera" }, html("span", {}, "View"), ...buttons, closer, farther, names),
    attach(element) {
      const controls = new OrbitControls(look.camera, element);
      controls.target = target;
      controls.update();
      Object.assign(controls, { enableDamping: false, enablePan: false, minDistance: 0.7, maxDistance: FARTHEST, maxPolarAngle: 1.65 });
      // The wheel belongs to the page, unless Ctrl is held. This listener comes before that of the controls.
      element.addEventListener("wheel", (event) => (controls.enableZoom = event.ctrlKey), { capture: true, passive: true });
      controls.addEventListener("change", changed);
      controls.addEventListener("start", () => {
        mine = false;
        buttons.forEach((button) => button.setAttribute("aria-pressed", "false"));
      });
      element.style.touchAction = "pan-y";
      return () => controls.dispose();
    },
  };
}
