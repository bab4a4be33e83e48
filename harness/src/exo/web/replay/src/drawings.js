// Which drawing a geometry gets, with the scales of its arrows.

import { FORCES, scalesOf } from "./arrows.js";
import { armDrawing, cameraOf } from "./arm.js";
import { renderer } from "./renderer.js";
import { sideDrawing } from "./side.js";
import { testbedDrawing } from "./testbed.js";

/** Whether an arm can be drawn in three dimensions here. */
export const has3d = () => renderer() !== null;

/** What two views of one replay share. `usual(...names)` is what these columns seldom exceed (N). */
export function shared({ geometry, usual, extent }) {
  if (geometry.kind === "testbed") {
    const most = Math.max(usual("tau_h"), usual("tau_a"), usual("tau_d"));
    return { extent, most, forces: { longest: most }, look: null };
  }
  // The largest arrows are those of landings, and cut off: see `clipped`.
  const found = Object.entries(FORCES).map(([name, { of }]) => [name, usual(...of)]);
  const there = { hand: true, contact: geometry.table !== null || geometry.wall !== null, payload: geometry.payload !== null };
  const scales = scalesOf(Object.fromEntries(found.filter(([name, most]) => there[name] ?? most > 0.05)));
  return { scales, forces: scales, look: { camera: cameraOf(), named: false } };
}

/** A new drawing. */
export function drawingOf(geometry, common) {
  if (geometry.kind === "testbed") return testbedDrawing({ geometry, ...common });
  return has3d() ? armDrawing({ geometry, ...common }) : sideDrawing({ geometry, ...common });
}
