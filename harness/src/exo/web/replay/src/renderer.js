// One WebGL context for the whole page: browsers give few. Each view copies its picture from it to a canvas of its own.

import { WebGLRenderer, PCFShadowMap, SRGBColorSpace } from "three";

let shared;
const redraws = new Set();

/** The page's renderer, or null where the browser has no WebGL. */
export function renderer() {
  if (shared !== undefined) return shared;
  try {
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("webgl2", { alpha: true, antialias: true, premultipliedAlpha: true });
    if (!context) throw new Error("no WebGL 2");
    shared = new WebGLRenderer({ canvas, context, antialias: true, alpha: true });
    shared.outputColorSpace = SRGBColorSpace;
    shared.shadowMap.enabled = true;
    shared.shadowMap.type = PCFShadowMap;
    shared.setClearColor(0x000000, 0);
    shared.setScissorTest(true);
    // A browser may take the context away and give it back.
    canvas.addEventListener("webglcontextrestored", () => redraws.forEach((redraw) => redraw()));
  } catch {
    shared = null;
  }
  return shared;
}

/** Calls `redraw` where all pictures must be drawn again; answers what ends that. */
export function onRestored(redraw) {
  redraws.add(redraw);
  return () => redraws.delete(redraw);
}

/** Draws a scene into a view's own canvas, whose size in device pixels is that of the picture. */
export function picture(scene, camera, context) {
  const gl = renderer();
  const { width, height } = context.canvas;
  const all = gl.domElement;
  if (all.width < width || all.height < height) gl.setSize(Math.max(all.width, width), Math.max(all.height, height), false);
  gl.setViewport(0, 0, width, height);
  gl.setScissor(0, 0, width, height);
  gl.render(scene, camera);
  context.clearRect(0, 0, width, height);
  // WebGL counts from the bottom.
  context.drawImage(all, 0, all.height - height, width, height, 0, 0, width, height);
}
