// Knobs, switches, buttons, and the run that is saved.
"use strict";

function playKnobs(bench, send) {
  const $ = (id) => document.getElementById(id);
  const made = (name, more = {}) => Object.assign(document.createElement(name), more);
  const shown = {};

  function choice(knob) {
    const select = made("select", { id: `knob-${knob.id}` });
    for (const one of knob.choices) select.append(made("option", { value: one, textContent: PLAY_LAWS[one] ?? one }));
    select.addEventListener("change", () => send({ set: { name: knob.id, to: select.value } }));
    shown[knob.id] = (value) => document.activeElement !== select && (select.value = value);
    return made("label", { className: "knob", htmlFor: select.id, textContent: `${knob.label} ` }).appendChild(select).parentElement;
  }

  function number(knob, changed) {
    const label = made("label", { className: "knob" });
    const slider = made("input", { type: "range", id: `knob-${knob.id}`, min: knob.low, max: knob.high, step: "any", value: knob.start });
    const box = made("output");
    const digits = knob.high - knob.low < 2 ? 3 : knob.high < 50 ? 1 : 0;
    const show = (value) => {
      box.textContent = `${value.toFixed(digits)} ${knob.unit}`;
      slider.setAttribute("aria-valuetext", box.textContent);
    };
    let touched = 0;
    // A fixed one begins a new run: only where the slider is let go.
    slider.addEventListener("input", () => {
      touched = performance.now();
      show(Number(slider.value));
      if (knob.live) changed(Number(Number(slider.value).toFixed(digits)));
    });
    slider.addEventListener("change", () => changed(Number(Number(slider.value).toFixed(digits))));
    shown[knob.id] = (value) => {
      if (performance.now() - touched < 700) return;
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
    shown[`switch ${name}`] = (on) => (box.checked = on);
  }

  let paused = false;
  $("pause").addEventListener("click", () => send({ pause: !paused }));
  $("again").addEventListener("click", () => send({ again: {} }));
  $("repeat").addEventListener("click", () => send({ other: { name: "law", to: $("repeat").dataset.law } }));
  $("save").addEventListener("submit", (event) => {
    event.preventDefault();
    send({ save: $("save-name").value });
  });

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
    answered(message) {
      $("saved").className = message.error ? "bad" : "good";
      $("saved").replaceChildren(...(message.error ? [message.error] : ["Saved. This repeats the run, bit for bit: ", made("code", { textContent: message.command })]));
    },
  };
}
