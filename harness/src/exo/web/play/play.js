// The page of `exo play`: what comes from the socket goes to drawing, words, knobs and charts.
"use strict";

(() => {
  const bench = JSON.parse(document.getElementById("bench").textContent);
  const testbed = bench.kind === "testbed";
  const place = document.getElementById("drawing");
  let [drawing, state] = [null, null];

  const send = playLink(taken, (trouble) => {
    const lost = document.getElementById("lost");
    lost.textContent = trouble;
    lost.hidden = !trouble;
    // What is still drawn is old.
    document.body.classList.toggle("gone", Boolean(trouble));
    if (!trouble) return;
    state = null;
    told.gone();
    hand.release();
  });
  const told = playTold(bench);
  const hand = playHand(bench, send, () => state && Object.keys(state.values).length ? bench.position.map((name) => state.values[name]) : null, () => drawing?.distance() ?? null);
  const knobs = playKnobs(bench, send);
  const charts = playCharts(bench);
  document.getElementById("modes").hidden = testbed;

  function taken(message) {
    if (message.geometry) shape(message.geometry);
    else if (message.state) update(message.state);
    else if (message.error && !knobs.waits()) refused(message.error);
    else knobs.answered(message);
  }
  let until = 0;
  /** What was not done, and why; for as long as it takes to read. */
  function refused(sentence) {
    const place = document.getElementById("refused");
    place.textContent = sentence;
    place.hidden = false;
    clearTimeout(until);
    until = setTimeout(() => (place.hidden = true), 8000);
  }
  function shape(geometry) {
    if (drawing) return drawing.reshape(geometry);
    // What the mouse leads stays below it: no step back meanwhile.
    drawing = exoReplay.live(place, geometry, { still: () => hand.leads() });
    // The mouse leads the handle in this view.
    [...place.querySelectorAll("button")].find((one) => one.textContent === "Side")?.click();
    return undefined;
  }
  function update(next) {
    // In a new run nobody holds the handle.
    if (state && next.run !== state.run) hand.cleared();
    state = next;
    hand.update(state);
    told.update(state);
    knobs.update(state);
    charts.update(state);
    if (drawing && Object.keys(state.values).length) drawing.update(drawn(state));
  }
  function drawn({ time, values, force }) {
    if (testbed) return { time, q: values["plant.q"], q_n: values["controller.q_n"], tau_h: force[0], tau_a: values["controller.tau_a"], tau_e: values["plant.tau_e"] };
    const vector = (name) => [1, 2, 3].map((i) => values[`${name}[${i}]`]);
    const arm = { q: vector("plant.q"), p_n: vector("controller.p_n"), f_h: force, f_e: vector("plant.f_e"), tension: values["plant.tension"] };
    return { time, arms: [arm], attached: values["plant.attached"] > 0.5 };
  }
  /** For tests. */
  window.exoPlay = { state: () => state, drawn: () => drawing?.state(), charts: () => charts.data() };
})();
