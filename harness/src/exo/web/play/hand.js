// The hand: mouse and finger on the drawing, sliders for the force, keys.
"use strict";

/**
 * `send(message)` goes to the run; `place()` is where the handle is (m, an axis each), or null; `distance()` how far the
 * drawing's eye is from it (m), or null.
 */
function playHand(bench, send, place, distance) {
  const $ = (id) => document.getElementById(id);
  const testbed = bench.kind === "testbed";
  const grip = $("grip");
  const axes = bench.axes.length;
  let [held, queued, target] = [null, 0, null];

  /** Metres of the drawing for one pixel. */
  function scale() {
    if (!testbed) {
      // The camera looks with an opening of 32 degrees, from as far as it has been led.
      const height = grip.querySelector("canvas, .er-draw svg")?.clientHeight || 300;
      return (2 * (distance() ?? 2.4) * Math.tan((16 * Math.PI) / 180)) / height;
    }
    // From two ticks of the rail on this side of the wall.
    const ticks = [...grip.querySelectorAll(".er-tick")].map((tick) => [Number(tick.getAttribute("x1")), Number((tick.nextElementSibling?.textContent ?? "").replace("−", "-"))]);
    for (let i = 1; i < ticks.length; i++) {
      const [dx, dq] = [ticks[i][0] - ticks[i - 1][0], ticks[i][1] - ticks[i - 1][1]];
      if (dx > 0 && dq > 0 && Math.abs(ticks[i][1]) <= 1.01) return dq / dx;
    }
    return 1.4 / grip.clientWidth;
  }

  function aim() {
    queued = 0;
    if (target) send({ hand: { target } });
  }
  function move(event) {
    if (!held || event.pointerId !== held.id) return;
    const [right, down] = [event.clientX - held.x, event.clientY - held.y].map((pixels) => pixels * held.scale);
    const at = [...held.from];
    at[0] += testbed || !event.shiftKey ? right : 0;
    if (!testbed) {
      // From the side, y points away from who looks.
      if (event.shiftKey) at[1] -= down;
      else at[2] -= down;
    }
    target = at.map((one) => Math.min(5, Math.max(-5, Number(one.toFixed(4)))));
    const box = grip.getBoundingClientRect();
    $("dot").style.left = `${event.clientX - box.left}px`;
    $("dot").style.top = `${event.clientY - box.top}px`;
    queued ||= requestAnimationFrame(aim);
  }
  function drop(event) {
    if (!held || event.pointerId !== held.id) return;
    held = target = null;
    $("dot").hidden = true;
    grip.classList.remove("held");
    send({ hand: { target: null } });
  }
  grip.addEventListener("pointerdown", (event) => {
    const from = place();
    if (event.button !== 0 || !from || event.target.closest("button") || mode() !== "hand") return;
    // The camera of the drawing does not turn meanwhile.
    event.stopPropagation();
    held = { id: event.pointerId, x: event.clientX, y: event.clientY, from, scale: scale() };
    try {
      grip.setPointerCapture(event.pointerId);
    } catch {
      // The pointer is gone already.
    }
    grip.classList.add("held");
    $("dot").hidden = false;
    move(event);
  }, true);
  grip.addEventListener("pointermove", move, true);
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) grip.addEventListener(name, drop, true);
  const mode = () => document.querySelector("input[name=mode]:checked").value;
  document.querySelectorAll("input[name=mode]").forEach((one) => one.addEventListener("change", () => grip.classList.toggle("turns", mode() === "camera")));

  // Sliders: an axis each, in N.
  const names = testbed ? ["Push (N)"] : ["Push forward (N)", "Push sideways (N)", "Push up (N)"];
  const sliders = bench.axes.map((axis, i) => {
    const slider = Object.assign(document.createElement("input"), { type: "range", min: -bench.strongest, max: bench.strongest, step: bench.strongest / 40, value: 0, id: `force-${axis}` });
    const shown = Object.assign(document.createElement("output"), { textContent: "0", ariaLive: "off" });
    const label = Object.assign(document.createElement("label"), { className: "force" });
    label.append(names[i], slider, shown);
    $("forces").append(label);
    slider.addEventListener("input", () => press(sliders.map((one) => Number(one.slider.value))));
    slider.setAttribute("aria-valuetext", "0 N");
    return { slider, shown };
  });
  let pressed = -Infinity;
  function show(push) {
    push.forEach((force, i) => {
      const text = `${Number(force.toFixed(2))}`.replace("-", "−");
      if (sliders[i].shown.textContent === text) return;
      sliders[i].slider.value = force;
      sliders[i].slider.setAttribute("aria-valuetext", `${text} N`);
      sliders[i].shown.textContent = text;
    });
  }
  function press(push) {
    pressed = performance.now();
    show(push);
    send({ hand: { push } });
  }
  /** Lets go of all. */
  function release() {
    held = target = null;
    $("dot").hidden = true;
    grip.classList.remove("held");
    down.clear();
    press(Array(axes).fill(0));
    send({ hand: { target: null } });
  }

  // Keys: an arrow pushes while it is down.
  const strength = bench.strongest / 4;
  const down = new Map();
  const keys = testbed
    ? { ArrowRight: [0, 1], ArrowLeft: [0, -1] }
    : { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [2, 1], ArrowDown: [2, -1], PageUp: [1, 1], PageDown: [1, -1] };
  $("keys").textContent = testbed
    ? `Keys: ← and → push with ${strength} N while they are down, the space bar lets go.`
    : `Keys: ← → ↑ ↓ push with ${strength} N while they are down, Page up and Page down sideways, the space bar lets go.`;
  grip.setAttribute("aria-label", testbed ? "The mass on its rail. Drag it, or use the arrow keys." : "The arm. Drag the handle, or use the arrow keys.");
  const elsewhere = (event) => event.ctrlKey || event.altKey || event.metaKey || event.target.closest("input, select, textarea") || (event.key === " " && event.target.closest("button, summary"));
  const pushed = () => {
    const push = Array(axes).fill(0);
    for (const [axis, sign] of down.values()) push[axis] += sign * strength;
    press(push);
  };
  document.addEventListener("keydown", (event) => {
    if (elsewhere(event) || !(event.key in keys || event.key === " ")) return;
    event.preventDefault();
    if (event.key === " ") {
      release();
    } else if (!down.has(event.key)) {
      down.set(event.key, keys[event.key]);
      pushed();
    }
  });
  document.addEventListener("keyup", (event) => down.delete(event.key) && pushed());
  window.addEventListener("blur", () => {
    if (down.size) {
      down.clear();
      pushed();
    }
  });
  $("release").addEventListener("click", release);
  /** The push as the run has it, which another page may have set, unless this page has just set it. */
  function update(state) {
    if (performance.now() - pressed > 700 && !down.size) show(state.push);
  }
  return { update, release, leads: () => held !== null, cleared: () => sliders.some((one) => Number(one.slider.value)) && press(Array(axes).fill(0)) };
}
