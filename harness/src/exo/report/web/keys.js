// A panel answers mouse, finger and keys: they move the experiment's instant, zoom and shift what is seen.

const STEPS = 200;

/** The view, `factor` times as long, with `t` (s) where it was. */
function scaled(view, factor, t) {
  const at = Math.min(Math.max(t, view.from), view.to);
  return [at - factor * (at - view.from), at + factor * (view.to - at)];
}

/** Lets `one` set the bus, and call `zoom` with the range (s) to be seen, or null for all. */
function steer(one, bus, zoom) {
  const { plot, view, u } = one;
  const over = u.over;
  const instant = (event) => u.posToVal(event.clientX - over.getBoundingClientRect().left, "x");
  const shifted = (by) => zoom([view.from + by, view.to + by]);
  let shifting = null;

  plot.setAttribute("aria-valuemin", String(bus.range[0]));
  plot.setAttribute("aria-valuemax", String(bus.range[1]));
  over.addEventListener("pointermove", (event) => {
    if (shifting) {
      const width = view.to - view.from;
      const from = shifting.from - ((event.clientX - shifting.x) / over.clientWidth) * width;
      zoom([from, from + width]);
    } else if (event.pointerType !== "mouse" || event.buttons === 0) {
      bus.set(instant(event), "plots");
    }
  });
  over.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "mouse") bus.set(instant(event), "plots");
    if (event.shiftKey || event.button === 1) {
      shifting = { x: event.clientX, from: view.from };
      over.setPointerCapture(event.pointerId);
      event.preventDefault();
    }
  });
  over.addEventListener("pointerup", () => (shifting = null));
  over.addEventListener("pointercancel", () => (shifting = null));
  // uPlot begins to select on this one.
  over.addEventListener("mousedown", (event) => event.shiftKey && event.stopImmediatePropagation(), true);
  over.addEventListener("dblclick", () => zoom(null));
  over.addEventListener(
    "wheel",
    (event) => {
      // Without the key the wheel is the page's.
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      zoom(scaled(view, event.deltaY > 0 ? 1.25 : 0.8, instant(event)));
    },
    { passive: false },
  );
  (u.hooks.setSelect ||= []).push(() => {
    if (u.select.width < 4) return;
    const range = [u.posToVal(u.select.left, "x"), u.posToVal(u.select.left + u.select.width, "x")];
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    zoom(range);
  });
  plot.addEventListener("keydown", (event) => {
    const width = view.to - view.from;
    const step = (width / STEPS) * (event.shiftKey ? 10 : 1);
    const keys = {
      ArrowRight: () => bus.set(bus.time + step, "keys"),
      ArrowUp: () => bus.set(bus.time + step, "keys"),
      ArrowLeft: () => bus.set(bus.time - step, "keys"),
      ArrowDown: () => bus.set(bus.time - step, "keys"),
      Home: () => bus.set(view.from, "keys"),
      End: () => bus.set(view.to, "keys"),
      PageUp: () => shifted(-width / 2),
      PageDown: () => shifted(width / 2),
      "+": () => zoom(scaled(view, 0.5, bus.time)),
      "=": () => zoom(scaled(view, 0.5, bus.time)),
      "-": () => zoom(scaled(view, 2, bus.time)),
      0: () => zoom(null),
      Escape: () => zoom(null),
    };
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
}
