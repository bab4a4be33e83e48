// Colours and sizes of the page around a replay.

import css from "./replay.css";
import { html } from "./dom.js";

const STYLE = "exo-replay-style";

/** The style sheet, once a page. */
export function styled() {
  if (!document.getElementById(STYLE)) document.head.append(html("style", { id: STYLE }, css));
}

/** Whether what lies behind an element is dark, whoever has made it so. */
function isDark(element) {
  for (let one = element; one; one = one.parentElement) {
    const found = getComputedStyle(one).backgroundColor.match(/[\d.]+/g)?.map(Number);
    if (found && found.length >= 3 && (found.length === 3 || found[3] > 0.5)) return 0.299 * found[0] + 0.587 * found[1] + 0.114 * found[2] < 128;
  }
  return matchMedia("(prefers-color-scheme: dark)").matches && getComputedStyle(document.documentElement).colorScheme.includes("dark");
}

/** Calls `changed` now and whenever the page turns dark or light; answers what ends that. */
export function followTheme(element, changed) {
  const apply = () => {
    element.classList.toggle("er-dark", isDark(element.parentElement ?? document.body));
    changed(palette(element));
  };
  const query = matchMedia("(prefers-color-scheme: dark)");
  const observer = new MutationObserver(apply);
  for (const one of [document.documentElement, document.body]) observer.observe(one, { attributes: true, attributeFilter: ["class", "data-theme", "style"] });
  query.addEventListener("change", apply);
  apply();
  return () => {
    observer.disconnect();
    query.removeEventListener("change", apply);
  };
}

function palette(element) {
  const style = getComputedStyle(element);
  const value = (name) => style.getPropertyValue(`--${name}`).trim();
  const dark = element.classList.contains("er-dark");
  return {
    robot: value("robot"), nominal: value("nominal"), hand: value("hand"), contact: value("contact"), payload: value("payload"), unseen: value("unseen"),
    joint: dark ? "#9aa6b4" : "#4b5663", post: dark ? "#4a5461" : "#b9c1ca", grip: dark ? "#e8ecf1" : "#232a33", cup: dark ? "#c9d1da" : "#2f3842",
    table: dark ? "#69737f" : "#c9ced5", legs: dark ? "#4a5461" : "#aab1ba", load: dark ? "#d6a347" : "#d69a2d",
    grid: dark ? "#2e3742" : "#dde2e8", gridAxis: dark ? "#46515e" : "#bfc7d0", shadow: dark ? 0.45 : 0.18,
  };
}

/** Whether the reader has asked for less motion. */
export const still = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
