// Whether a robot is free, at a surface, sticks to it or has just let go, in words.

/** How long "lets go" is shown (s of the run). */
const SHOWN = 4;
/** Shorter times of sticking are not worth a word (s). */
const LEAST = 0.06;
/** Hand forces below this are none (N). */
const NO_FORCE = 0.05;

/** The surface that a part is at, and the hand's force away from it (N); null in free space. */
export function touching(geometry, state, pads) {
  if (geometry.kind === "testbed") {
    const near = geometry.wall !== null && state.q >= geometry.wall - geometry.margin;
    return near ? { surface: "wall", pull: -state.tau_h } : null;
  }
  for (let side = 0; side < pads.length; side++) {
    const f = state.arms[side].f_h ?? [0, 0, 0];
    if (geometry.table !== null && pads[side][2] <= geometry.table + geometry.margin) return { surface: "table", pull: f[2] };
    if (geometry.wall !== null && pads[side][0] >= geometry.wall - geometry.margin) return { surface: "wall", pull: -f[0] };
  }
  return null;
}

/** The status of a recorded case at an instant; its episodes were found at every tick of the run. */
export function recordedStatus(one, state, pads) {
  const { time } = state;
  let last = null;
  for (const side of one.episodes) {
    for (const episode of side) {
      if (episode.from <= time && time < episode.to) return { kind: "sticks", lasted: time - episode.from, surface: episode.surface };
      const over = time >= episode.to && episode.letGo && episode.to - episode.from > LEAST;
      if (over && (last === null || episode.to > last.to)) last = episode;
    }
  }
  const lasted = last ? last.to - last.from : 0;
  if (last && time - last.to < SHOWN) return { kind: "letGo", lasted, surface: last.surface };
  return { ...restingStatus(one.geometry, state, pads), lasted };
}

function restingStatus(geometry, state, pads) {
  const touch = touching(geometry, state, pads);
  if (!touch) return { kind: state.attached ? "carries" : "free", surface: "" };
  return { kind: touch.pull < -NO_FORCE ? "presses" : "rests", surface: touch.surface };
}

/** The same rule for a live page, state by state. */
export function liveStatus() {
  let [begin, before, lasted, left] = [null, null, 0, -Infinity];
  let surface = "";
  return (geometry, state, pads) => {
    const touch = touching(geometry, state, pads);
    if (before !== null && state.time < before) [begin, lasted, left] = [null, 0, -Infinity];
    if (touch && touch.pull > 0) {
      begin ??= before ?? state.time;
      surface = touch.surface;
    } else if (begin !== null) {
      if (!touch) [lasted, left] = [state.time - begin, state.time];
      begin = null;
    }
    before = state.time;
    if (begin !== null) return { kind: "sticks", lasted: state.time - begin, surface };
    if (state.time - left < SHOWN && lasted > LEAST && !touch) return { kind: "letGo", lasted, surface };
    return { ...restingStatus(geometry, state, pads), lasted };
  };
}

/** A word for the badge, and a sentence below the drawing. */
export function words(status, geometry, held) {
  const thing = geometry.kind === "testbed" ? "mass" : held ? "payload" : "pad";
  const seconds = `${status.lasted.toFixed(2)} s`;
  switch (status.kind) {
    case "sticks":
      return ["sticks", `The hand pulls away, but the ${thing} sticks to the ${status.surface}: ${seconds}.`];
    case "letGo":
      return ["lets go", `The ${thing} lets go, ${seconds} after the hand has turned.`];
    case "presses":
      return ["pressed", `The hand presses the ${thing} against the ${status.surface}.`];
    case "rests":
      return ["at rest", `The ${thing} is at the ${status.surface}; the hand does not pull.`];
    case "carries":
      return ["carries", `The ${geometry.bases.length > 1 ? "arms carry" : "arm carries"} the payload.`];
    default:
      return ["free", `The ${thing} moves freely.`];
  }
}
