// The arm from the side, in its own vertical plane, where a browser has no WebGL: distance from the yaw axis, and height.

import { LENGTH, clipped, forcesOf, nominalHand, tailAt } from "./arrows.js";
import { put, say, show, svg } from "./dom.js";
import { metres } from "./format.js";
import { middleOfPads, points } from "./kinematics.js";
import { top } from "./stage.js";

const [LEFT, RIGHT, LOW, HIGH] = [-0.2, 0.95, -0.92, 0.5];

/** The drawing, with the same interface as that in three dimensions. */
export function sideDrawing({ geometry, scales }) {
  const element = svg("svg", { class: "er-svg", role: "presentation", focusable: "false" });
  let size = [0, 0];
  let scale = 1;
  const at = (r, z) => [(r - LEFT) * scale, (HIGH - z) * scale];
  const text = (points) => points.map(([r, z]) => at(r, z).map((v) => v.toFixed(1)).join(",")).join(" ");
  const still = svg("g");
  const load = svg("polygon", { class: "er-load" });
  const arms = geometry.bases.map(() => ({
    link: svg("polyline", { class: "er-link" }),
    rod: svg("polyline", { class: "er-rod" }),
    joints: [0, 1].map(() => svg("circle", { class: "er-joint", r: 6 })),
    thread: svg("line", { class: "er-thread" }),
    ghost: svg("circle", { class: "er-ghost", r: 9 }),
    ghostName: svg("text", { class: "er-label er-ghost-name", "text-anchor": "middle" }),
    hand: svg("circle", { class: "er-grip", r: 7 }),
    arrows: Object.fromEntries(Object.keys(scales).map((name) => [name, flatArrow(name)])),
  }));
  element.append(still, load);
  for (const one of arms) {
    element.append(one.rod, one.link, ...one.joints, one.thread, one.ghost, one.hand, ...Object.values(one.arrows).map((each) => each.element), one.ghostName);
  }
  let seen = [];

  function scenery() {
    still.replaceChildren();
    if (geometry.table !== null) {
      const [x, y] = at(0.12, top(geometry));
      still.append(svg("rect", { class: "er-wall", x, y, width: 0.75 * scale, height: 0.03 * scale }), svg("text", { class: "er-label", x: x + 6, y: y + 0.03 * scale + 14 }, "table"));
    }
    if (geometry.wall !== null) {
      const [x, y] = at(geometry.wall, 0.4);
      still.append(svg("rect", { class: "er-wall", x, y, width: 0.03 * scale, height: 1.1 * scale }), svg("text", { class: "er-label", x: x + 4, y: y - 4 }, "wall"));
    }
  }

  return {
    element,
    resize(width, height) {
      scale = Math.min(width / (RIGHT - LEFT), height / (HIGH - LOW));
      size = [Math.round((RIGHT - LEFT) * scale), Math.round((HIGH - LOW) * scale)];
      put(element, { viewBox: `0 0 ${size[0]} ${size[1]}`, width: size[0], height: size[1] });
      scenery();
    },
    paint() {},
    draw(state) {
      seen = state.arms.map((arm, i) => {
        const base = geometry.bases[i];
        const found = points(geometry, base, arm.q);
        const [c, s] = [Math.cos(arm.q[0]), Math.sin(arm.q[0])];
        const flat = ([x, y, z]) => [(x - base[0]) * c + (y - base[1]) * s, z - base[2]];
        const one = arms[i];
        const [shoulder, elbow, hand, pad] = [found.shoulder, found.elbow, found.handle, found.pad].map(flat);
        put(one.link, { points: text([[0, 0], shoulder, elbow, hand]) });
        put(one.rod, { points: text([hand, pad]) });
        [shoulder, elbow].forEach((point, k) => put(one.joints[k], { cx: at(...point)[0], cy: at(...point)[1] }));
        put(one.hand, { cx: at(...hand)[0], cy: at(...hand)[1] });
        const nominal = arm.p_n ? nominalHand(found.handle, arm.p_n) : null;
        for (const part of [one.ghost, one.ghostName, one.thread]) show(part, nominal !== null);
        if (nominal) {
          const [[x0, y0], [x1, y1]] = [at(...hand), at(...flat(nominal.at))];
          put(one.ghost, { cx: x1, cy: y1 });
          put(one.thread, { x1: x0, y1: y0, x2: x1, y2: y1 });
          put(one.ghostName, { x: x1, y: y1 - 14 });
          say(one.ghostName, nominal.distance > 0.02 ? `nominal hand, ${metres(nominal.distance)} away` : "");
        }
        for (const [name, where, [fx, fy, fz]] of forcesOf(arm)) {
          const factor = LENGTH / scales[name];
          const [ahead, , up] = clipped([(fx * c + fy * s) * factor, 0, fz * factor]);
          const [r, , z] = where === "handle" ? tailAt([hand[0], 0, hand[1]], [ahead, 0, up]) : [pad[0] + (name === "contact" ? 0.04 : -0.04), 0, pad[1] - (name === "payload" ? up : 0)];
          one.arrows[name]?.set(at(r, z), at(r + ahead, z + up));
        }
        return { hand: found.handle, pad: found.pad, nominal: nominal?.at, away: nominal?.distance };
      });
      show(load, geometry.payload !== null);
      if (geometry.payload) {
        const [x, y, z] = state.attached ? middleOfPads(geometry, state.arms) : state.payload;
        const [half, height] = [geometry.payload.size[0] / 2, geometry.payload.size[2]];
        const r = Math.hypot(x, y);
        put(load, { points: text([[r - half, z], [r + half, z], [r + half, z - height], [r - half, z - height]]) });
      }
    },
    render() {},
    pose: () => ({ arms: seen }),
    dispose: () => element.remove(),
  };
}

function flatArrow(name) {
  const line = svg("line", { class: "er-shaft" });
  const head = svg("polygon", { class: "er-head" });
  return {
    element: svg("g", { class: `er-arrow er-${name}` }, line, head),
    set([x0, y0], [x1, y1]) {
      const length = Math.hypot(x1 - x0, y1 - y0);
      show(line.parentNode, length > 1);
      if (length <= 1) return;
      const size = Math.min(9, length);
      const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
      const [bx, by] = [x1 - ux * size, y1 - uy * size];
      put(line, { x1: x0, y1: y0, x2: bx, y2: by });
      put(head, { points: `${x1},${y1} ${bx - uy * size * 0.6},${by + ux * size * 0.6} ${bx + uy * size * 0.6},${by - ux * size * 0.6}` });
    },
  };
}
