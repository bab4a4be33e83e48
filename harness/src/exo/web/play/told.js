// What is said in words: the banner, the hint, the status, the tank.
"use strict";

const PLAY_LAWS = {
  standard: "standard law: sticks to walls",
  passive: "passive law of the paper",
  passive_applied: "passive, applied force",
  passive_bounded: "passive, bounded: lets go",
};

function playTold(bench) {
  const $ = (id) => document.getElementById(id);
  const testbed = bench.kind === "testbed";
  const surface = testbed ? "wall" : "table";
  let [run, pressed, before, pushed, full] = [0, 0, 0, false, 10];
  const say = (element, text) => element.textContent !== text && (element.textContent = text);

  function banner(state) {
    const away = state.let_go !== null && state.time - state.let_go < 4;
    const contact = testbed ? -state.values["plant.tau_e"] : state.values["plant.f_e[3]"];
    const kind = state.word === "sticks" ? "sticks" : state.word === "touches" ? "touches" : away ? "letgo" : "free";
    if ($("banner").className !== `banner ${kind}`) $("banner").className = `banner ${kind}`;
    const words = { sticks: "Sticks", touches: `At the ${surface}`, letgo: "Lets go", free: "Free" };
    say($("word"), words[kind]);
    const numbers = {
      sticks: `for ${state.stuck.toFixed(1)} s: the hand pulls away, the ${testbed ? "mass" : "handle"} stays.`,
      touches: `pressed with ${Math.abs(contact ?? 0).toFixed(1)} N`,
      letgo: `${state.stuck.toFixed(2)} s after the hand has turned`,
      free: "",
    };
    $("lasted").textContent = numbers[kind];
    return kind;
  }

  function hint(state, kind) {
    const pushing = testbed ? state.force[0] > 0.3 : state.force[2] < -1;
    if (state.run !== run) [run, pressed, pushed] = [state.run, 0, false];
    else if (kind === "touches" && pushing) pressed += Math.max(0, state.time - before);
    before = state.time;
    pushed ||= state.force.some((force) => Math.abs(force) > 0.3);
    const behind = testbed ? state.values["controller.q_n"] - state.settings.wall : 0;
    const nominal = behind > 0.1 && state.word !== "free" ? ` The law's nominal mass is ${behind.toFixed(1)} m behind the wall, so the drive still pushes.` : "";
    if (kind === "sticks") return `${state.repeats ? "The hand pulls" : "You pull"}, and it stays.${nominal} Try the same push with the other law.`;
    if (state.let_go !== null && kind !== "touches") {
      const came = state.stuck >= 0.5 ? `It was stuck for ${state.stuck.toFixed(1)} s.` : `It came away ${state.stuck.toFixed(2)} s after the hand had turned.`;
      return `${came} Try the same push with the other law.`;
    }
    if (state.repeats) return `The hand repeats your push by itself. Take the handle when you like.${nominal}`;
    if (kind === "touches" && pressed >= 5) return `Now pull back.${nominal}`;
    if (kind === "touches" && pushing) return `Hold: ${Math.max(0, 5 - pressed).toFixed(0)} s more, then pull back.${nominal}`;
    if (kind === "touches") return `Pull back.${nominal}`;
    return testbed
      ? "Push the mass into the wall, hold for five seconds, then pull back. Drag the mass to the right with the mouse."
      : "Press the handle down on the table, hold for five seconds, then pull up. Switch the vacuum on to pick up the payload.";
  }

  function tank(state) {
    const value = state.values["controller.energy.tank"];
    if (value === undefined) return;
    full = Math.max(full, value);
    const shown = Math.min(full, Math.max(0, value));
    $("tank-bar").style.width = `${(100 * shown) / full}%`;
    $("tank").className = value < 0 ? "gauge empty" : "gauge";
    $("tank").setAttribute("aria-valuemax", String(full));
    $("tank").setAttribute("aria-valuenow", shown.toFixed(2));
    $("tank").setAttribute("aria-valuetext", $("tank-text").textContent);
    const joules = Math.abs(value) < 1000 ? `${value.toFixed(2)} J` : `${Math.round(value / 1000)} kJ`;
    say($("tank-text"), value < 0 ? `${joules.replace("-", "−")}: this law has created energy. It is not passive.` : `${joules} of ${full.toFixed(0)} J: energy that the law may still give out.`);
  }

  return {
    /** Nobody answers. */
    gone() {
      say($("status"), "no answer");
      say($("speed"), "");
      $("pill").className = "status failed";
    },
    update(state) {
      say($("time"), `${state.time.toFixed(1)} s`);
      const slow = state.status === "slower than real time";
      say($("speed"), slow ? `(${Math.round(100 * state.speed)} %)` : "");
      say($("status"), state.status === "ended" ? `ended after ${bench.longest} s: press New run` : state.status);
      const kind = state.failed ? "failed" : slow ? "slow" : state.status;
      $("pill").className = `status ${kind}`;
      if (!Object.keys(state.values).length) return;
      say($("hint"), hint(state, banner(state)));
      tank(state);
      const other = state.settings.law === "standard" ? ["passive_bounded", "bounded"] : ["standard", "standard"];
      say($("repeat"), `Same push with the ${other[1]} law`);
      $("repeat").dataset.law = other[0];
      $("repeat").disabled = !pushed;
    },
  };
}
