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

/** Controls for the views' canvases, with buttons; `changed` is called when the camera has moved. */
export function orbit({ look, geometry, changed }) {
  const wide = geometry.bases.length > 1;
  const target = new Vector3(0.32, 0, geometry.table === null ? -0.22 : (geometry.table - 0.14) / 2);
  const distance = wide ? 2.85 : 2.4;
  const attached = [];
  const buttons = Object.keys(PRESETS).map((name) => html("button", { type: "button", "aria-pressed": "false" }, name));
  const names = html("button", { type: "button", "aria-pressed": String(look.named) }, "Names");
  const closer = html("button", { type: "button", "aria-label": "Closer" }, "+");
  const farther = html("button", { type: "button", "aria-label": "Farther" }, "−");

  function preset(i) {
    const [name] = Object.entries(PRESETS)[i];
    look.camera.position.set(...PRESETS[name]).normalize().multiplyScalar(distance).add(target);
    look.camera.lookAt(target);
    buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(k === i)));
    changed();
  }
  buttons.forEach((button, i) => button.addEventListener("click", () => preset(i)));
  names.addEventListener("click", () => {
    look.named = !look.named;
    names.setAttribute("aria-pressed", String(look.named));
    changed();
  });
  const zoom = (factor) => () => {
    look.camera.position.sub(target).multiplyScalar(factor).clampLength(0.7, 5).add(target);
    changed();
  };
  closer.addEventListener("click", zoom(0.8));
  farther.addEventListener("click", zoom(1.25));
  preset(0);

  return {
    /** From the eye to what it looks at (m). */
    distance: () => look.camera.position.distanceTo(target),
    element: html("div", { class: "er-group", role: "group", "aria-label": "Camera" }, html("span", {}, "View"), ...buttons, closer, farther, names),
    attach(element) {
      const controls = new OrbitControls(look.camera, element);
      controls.target = target;
      controls.update();
      Object.assign(controls, { enableDamping: false, enablePan: false, minDistance: 0.7, maxDistance: 5, maxPolarAngle: 1.65 });
      // The wheel belongs to the page, unless Ctrl is held. This listener comes before that of the controls.
      element.addEventListener("wheel", (event) => (controls.enableZoom = event.ctrlKey), { capture: true, passive: true });
      controls.addEventListener("change", changed);
      controls.addEventListener("start", () => buttons.forEach((button) => button.setAttribute("aria-pressed", "false")));
      element.style.touchAction = "pan-y";
      attached.push(controls);
      return () => {
        attached.splice(attached.indexOf(controls), 1);
        controls.dispose();
      };
    },
  };
}
