// One instant of an experiment, shared by its plots and its replay.
//
//   const bus = createTimeBus([0, 12]);          bus.range is [0, 12] (s)
//   const stop = bus.subscribe((t, source) => …) called after each change of the instant
//   bus.set(3.2, "plots");                       bus.time is 3.2; `source` says who moved it
//   stop();
//
// Who has set the instant hears of it, too: `source` lets it do nothing then. A listener that sets the instant while
// it is told of one does not start a second round: the last instant set is told when the round is over.
"use strict";

/** A bus over `range` = [t0, t1] in s. The instant begins at t0. */
function createTimeBus(range = [0, 0]) {
  const listeners = new Set();
  let time = range[0];
  let waiting = null;
  let telling = false;

  function tell() {
    telling = true;
    try {
      while (waiting !== null) {
        const source = waiting;
        waiting = null;
        for (const listener of [...listeners]) {
          if (listeners.has(listener)) listener(time, source);
        }
      }
    } finally {
      telling = false;
    }
  }

  return {
    range: [range[0], range[1]],
    get time() {
      return time;
    },
    /** Moves to `t` (s), held within the range; what is no number is left out. */
    set(t, source = "") {
      if (!Number.isFinite(t)) return;
      const held = Math.min(Math.max(t, range[0]), range[1]);
      if (held === time) return;
      time = held;
      waiting = String(source);
      if (!telling) tell();
    },
    /** Calls `listener(t, source)` after each change; the function that it answers ends that. */
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}
