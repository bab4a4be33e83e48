// Knobs, switches, buttons, and the run that is saved.
"use strict";

function playKnobs(bench, send) {
  const $ = (id) => document.getElementById(id);
  const made = (name, more = {}) => Object.assign(document.createElement(name), more);
  const shown = {};
  const minus = (text) => text.replace("-", "−");

  /** Whether somebody has changed an element just now, or still holds it: then the run's answer is on its way. */
  function touches(element) {
    let [touched, held] = [-Infinity, false];
    const touch = () => (touched = performance.now());
    // What is drawn over the page, as an open list, hides where the pointer goes up.
    if (element.type === "range") element.addEventListener("pointerdown", () => (held = true));
    for (const name of ["pointerup", "pointercancel", "change", "blur"]) element.addEventListener(name, () => ((held = false), touch()));
    element.addEventListener("input", touch);
    return () => held || performance.now() - touched < 700;
  }

  function choice(knob) {
    const select = made("select", { id: `knob-${knob.id}` });
    for (const one of knob.choices) select.append(made("option", { value: one, textContent: PLAY_LAWS[one] ?? one }));
    select.addEventListener("change", () => send({ set: { name: knob.id, to: select.value } }));
    const busy = touches(select);
    // A list that is open keeps what is lit in it.
    shown[knob.id] = (value) => !busy() && select.value !== value && (select.value = value);
    return made("label", { className: "knob", htmlFor: select.id, textContent: `${knob.label} ` }).appendChild(select).parentElement;
  }

  function number(knob, changed) {
    const label = made("label", { className: "knob" });
    const slider = made("input", { type: "range", id: `knob-${knob.id}`, min: knob.low, max: knob.high, step: "any", value: knob.start });
    // The slider itself is what a screen reader reads; the run writes here, too.
    const box = made("output", { ariaLive: "off" });
    const digits = knob.high - knob.low < 2 ? 3 : knob.high < 50 ? 1 : 0;
    const show = (value) => {
      const text = minus(`${value.toFixed(digits)} ${knob.unit}`);
      if (box.textContent === text) return;
      box.textContent = text;
      slider.setAttribute("aria-valuetext", text);
    };
    const busy = touches(slider);
    // A fixed one begins a new run: only where the slider is let go.
    slider.addEventListener("input", () => {
      show(Number(slider.value));
      if (knob.live) changed(Number(Number(slider.value).toFixed(digits)));
    });
    slider.addEventListener("change", () => changed(Number(Number(slider.value).toFixed(digits))));
    shown[knob.id] = (value) => {
      if (busy()) return;
      slider.value = value;
      show(value);
    };
    show(knob.start);
    label.append(made("span", { textContent: knob.label }), slider, box);
    return label;
  }

  for (const knob of bench.knobs) {
    const part = knob.choices.length ? choice(knob) : number(knob, (to) => send({ set: { name: knob.id, to } }));
    $(knob.live ? "live" : "fixed").append(part);
  }
  $("fixed").append(made("p", { className: "soft", textContent: "These are set before a run: a change begins a new one." }));
  const stiff = { id: "stiffness", label: "stiffness of your hand", unit: "N/m", low: 5, high: 1000, start: 200, live: true };
  $("live").append(number(stiff, (to) => send({ hand: { stiffness: to } })));
  for (const name of bench.switches) {
    const box = made("input", { type: "checkbox", id: `switch-${name}` });
    box.addEventListener("change", () => send({ switch: { name, to: box.checked } }));
    const label = made("label", { className: "knob switch" });
    label.append(box, ` ${name}`);
    $("live").append(label);
    const busy = touches(box);
    shown[`switch ${name}`] = (on) => !busy() && (box.checked = on);
  }

  let paused = false;
  $("pause").addEventListener("click", () => send({ pause: !paused }));
  $("again").addEventListener("click", () => send({ again: {} }));
  $("repeat").addEventListener("click", () => send({ other: { name: "law", to: $("repeat").dataset.law } }));
  $("save").addEventListener("submit", (event) => {
    event.preventDefault();
    waits = send({ save: $("save-name").value });
    if (!waits) answered({ error: "Not saved: exo play does not answer." });
  });
  let waits = false;
  function answered(message) {
    waits = false;
    $("saved").className = message.error ? "bad" : "good";
    $("saved").replaceChildren(...(message.error ? [message.error] : ["Saved. This repeats the run, bit for bit: ", made("code", { textContent: message.command })]));
  }

  return {
    update(state) {
      for (const [name, value] of Object.entries(state.settings)) shown[name]?.(value);
      for (const [name, on] of Object.entries(state.switches)) shown[`switch ${name}`]?.(on);
      shown.stiffness(state.stiffness);
      if (paused !== state.paused) {
        paused = state.paused;
        $("pause").textContent = paused ? "Go on" : "Pause";
        $("pause").setAttribute("aria-pressed", String(paused));
      }
    },
    answered,
    /** Whether a run is being saved: the next answer tells of it. */
    waits: () => waits,
  };
}
