// The experiment's instant as a slider that stays in sight, with zoom and reset.

/** A bar that shows and sets the bus. */
function createTimeBar(bus, { zoomIn, zoomOut, reset }) {
  const element = document.createElement("div");
  element.className = "timebar";
  const label = document.createElement("label");
  const slider = document.createElement("input");
  const shown = document.createElement("output");
  slider.type = "range";
  slider.setAttribute("aria-label", "Instant");
  [slider.min, slider.max] = bus.range.map(String);
  slider.step = String((bus.range[1] - bus.range[0]) / 1000 || 1);
  slider.addEventListener("input", () => bus.set(Number(slider.value), "timebar"));
  label.append(slider, shown);
  element.append(label);
  for (const [sign, name, act] of [
    ["+", "Zoom in at the cursor", zoomIn],
    ["−", "Zoom out", zoomOut],
    ["Reset", "Show everything again", reset],
  ]) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "plain";
    button.textContent = sign;
    button.title = name;
    button.setAttribute("aria-label", name);
    button.addEventListener("click", act);
    element.append(button);
  }
  return {
    element,
    tell(t) {
      slider.value = String(t);
      shown.textContent = `t = ${t.toFixed(decimals(bus.range))} s`;
      slider.setAttribute("aria-valuetext", `${written(t)} s`);
    },
  };
}

/** As many decimals as a thousandth of the range (s) has, one at least. */
function decimals([from, to]) {
  return Math.min(Math.max(3 - Math.ceil(Math.log10(Math.max(to - from, 1e-6))), 1), 6);
}
