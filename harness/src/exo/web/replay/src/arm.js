// The arm in three dimensions, on a canvas of its own, with names as text over it.

import { PerspectiveCamera, Scene, Vector3 } from "three";
import { LENGTH, clipped, forcesOf, nominalHand, tailAt } from "./arrows.js";
import { html, say, show } from "./dom.js";
import { metres } from "./format.js";
import { middleOfPads, points } from "./kinematics.js";
import { limbs } from "./limbs.js";
import { arrow, ghost, plate } from "./marks.js";
import { picture } from "./renderer.js";
import { floorOf, stage, top } from "./stage.js";

/** The view: `look` has the camera that all views of a replay share, `scales` the forces of an arrow (N). */
export function armDrawing({ geometry, scales, look }) {
  const canvas = html("canvas", { class: "er-canvas" });
  const names = html("div", { class: "er-names", "aria-hidden": "true" });
  const element = html("div", { class: "er-stage" }, canvas, names);
  const context = canvas.getContext("2d");
  const scene = new Scene();
  const around = stage(geometry);
  scene.add(around.group);
  const floor = floorOf(geometry);
  const arms = geometry.bases.map((base) => {
    const one = { ...limbs(geometry, base, floor), ghost: ghost(), arrows: {} };
    for (const name of Object.keys(scales)) one.arrows[name] = arrow();
    scene.add(one.root, one.cup, one.ghost.group, ...Object.values(one.arrows).map((each) => each.group));
    return one;
  });
  let load = null;
  if (geometry.payload) {
    load = plate(geometry.payload.size);
    scene.add(load.mesh);
  }
  const labels = labelling(names);
  let state = null;
  let seen = [];

  function texts() {
    const found = [];
    const side = geometry.bases.length > 1 ? ["left ", "right "] : [""];
    arms.forEach((one, i) => {
      const { hand, shoulder, elbow, pad, nominal } = seen[i];
      if (nominal && nominal.distance > 0.03) found.push([`nominal hand, ${metres(nominal.distance)} away`, nominal.at, "ghost"]);
      found.push([`${side[i]}handle`, hand, "part"], ["shoulder", shoulder, "part"], ["elbow", elbow, "part"], ["suction pad", pad, "part"]);
    });
    if (load) found.push([`payload ${geometry.payload.mass} kg`, load.mesh.position.toArray(), "name low"]);
    if (geometry.table !== null) found.push(["table", [0.78, geometry.bases.length > 1 ? -0.55 : -0.34, top(geometry)], "part low"]);
    if (geometry.wall !== null) found.push(["wall", [geometry.wall, 0, 0.4], "part"]);
    return found;
  }

  return {
    element,
    resize(width, height, density) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
      canvas.style.width = `${width}px`;
      canvas.style.height = `${height}px`;
      look.camera.aspect = width / height;
      look.camera.updateProjectionMatrix();
    },
    paint(palette) {
      around.paint(palette);
      for (const one of arms) {
        one.paint(palette);
        one.ghost.paint(palette.nominal);
        for (const [name, each] of Object.entries(one.arrows)) each.look.color.set(palette[name]);
      }
      load?.look.color.set(palette.load);
    },
    draw(next) {
      state = next;
      seen = state.arms.map((arm, i) => {
        const at = points(geometry, geometry.bases[i], arm.q);
        const one = arms[i];
        one.pose(arm.q, at.pad);
        one.root.updateMatrixWorld(true);
        const hand = one.hand.getWorldPosition(new Vector3()).toArray();
        const nominal = arm.p_n ? nominalHand(hand, arm.p_n) : null;
        one.ghost.group.visible = nominal !== null;
        if (nominal) one.ghost.set(hand, nominal, arm.q[0]);
        for (const [name, where, force] of forcesOf(arm)) {
          const vector = clipped(force.map((value) => (value * LENGTH) / scales[name]));
          // Beside the pad an arrow is not hidden in its rod; a pull of the payload ends on it.
          const pad = beside(at.pad, arm.q[0], name === "contact" ? 0.065 : -0.065);
          const from = where === "handle" ? tailAt(hand, vector) : name === "payload" ? pad.map((value, k) => value - vector[k]) : pad;
          one.arrows[name]?.set(from, vector);
        }
        return { ...at, hand, nominal };
      });
      if (load) load.set(state.attached ? middleOfPads(geometry, state.arms) : state.payload, geometry.bases.length > 1 ? 0 : state.attached ? state.arms[0].q[0] : 0);
    },
    render() {
      if (!state || !canvas.width) return;
      const camera = look.camera;
      camera.aspect = canvas.width / canvas.height;
      camera.updateProjectionMatrix();
      picture(scene, camera, context);
      labels(texts(), camera, canvas.clientWidth, canvas.clientHeight, look.named);
    },
    /** Where the handles are drawn (m). */
    hands: () => seen.map(({ hand }) => hand),
    /** Where hand, pad and nominal hand of each arm are drawn (m). */
    pose: () => ({ arms: seen.map(({ hand, pad, nominal }) => ({ hand, pad, nominal: nominal?.at, away: nominal?.distance })), payload: load?.mesh.position.toArray() }),
    dispose() {
      scene.traverse((one) => {
        one.geometry?.dispose();
        one.material?.dispose?.();
      });
      element.remove();
    },
  };
}

/** A camera for all views of a replay. */
export function cameraOf() {
  const camera = new PerspectiveCamera(32, 1, 0.05, 20);
  camera.up.set(0, 0, 1);
  return camera;
}

/** A point beside the pad (m). */
function beside([x, y, z], yaw, by) {
  return [x - by * Math.sin(yaw), y + by * Math.cos(yaw), z];
}

/** Texts at points of the scene; a text that would cover another one is left out. */
function labelling(parent) {
  const place = new Vector3();
  const made = [];
  return (texts, camera, width, height, named) => {
    const taken = [];
    texts.forEach(([text, at, kind], i) => {
      made[i] ??= parent.appendChild(html("span"));
      const label = made[i];
      place.set(...at).project(camera);
      const half = (kind === "ghost" ? 3.7 : 3.3) * text.length + 5;
      const low = kind.endsWith("low");
      const centre = ((place.x + 1) / 2) * width;
      const right = centre + half + 20;
      const x = low ? centre : right + half < width ? right : centre - half - 20;
      const y = ((1 - place.y) / 2) * height + (low ? 26 : 0);
      const free = taken.every((other) => Math.abs(other.x - x) > other.half + half || Math.abs(other.y - y) > 15);
      const wanted = named || !kind.startsWith("part");
      const shown = wanted && free && place.z < 1 && x > 0 && x < width && y > 0 && y < height;
      show(label, shown);
      if (!shown) return;
      taken.push({ x, y, half });
      say(label, text);
      label.className = `er-tag ${kind.split(" ").map((one) => `er-tag-${one}`).join(" ")}`;
      label.style.transform = `translate(${Math.min(Math.max(x, half), width - half).toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    });
    for (let i = texts.length; i < made.length; i++) show(made[i], false);
  };
}
