// A panel's legend: each curve's name with its line and its value at the cursor. A click hides or shows the name in all
// panels of the figure; a double click shows it alone.

/** A small picture of a curve's line. */
function lineOf(curve) {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 26 8");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(space, "line");
  for (const [name, value] of Object.entries({ x1: 0, y1: 4, x2: 26, y2: 4, "stroke-width": 2.4 })) {
    line.setAttribute(name, value);
  }
  line.setAttribute("stroke-dasharray", dashOf(curve).join(" "));
  svg.append(line);
  return svg;
}

/** A dash in pixels: the figures give it in widths of the line. */
function dashOf(curve) {
  return curve.dash.map((length) => Math.max(1.5, length * 1.4));
}

/** The legend of a panel; `figure` is told of clicks. */
function legendOf(panel, signals, figure) {
  const element = document.createElement("div");
  element.className = "legend";
  const entries = panel.curves.map((curve) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "curve";
    button.dataset.label = curve.label;
    button.title = `${signals[curve.s].case}: ${signals[curve.s].column}. Click: hide or show. Double click: this one alone, and again all.`;
    const value = document.createElement("span");
    value.className = "value";
    button.append(lineOf(curve), document.createTextNode(curve.label), value);
    button.addEventListener("click", () => figure.toggle(curve.label));
    button.addEventListener("dblclick", () => figure.showAlone(curve.label));
    element.append(button);
    return { curve, button, value, line: button.querySelector("line") };
  });
  const bands = panel.bands ? bandsLegend(panel.bands) : null;
  if (bands) element.append(bands.element);
  const off = panel.curves.filter((curve) => signals[curve.s].off);
  if (off.length) {
    const told = off.map(({ s, label }) => `${label} by up to ${withUnit(Number(signals[s].off.toPrecision(2)), signals[s].unit)}`);
    element.append(Object.assign(document.createElement("span"), { className: "soft", textContent: `Thinned, and off between its points: ${told.join(", ")}.` }));
  }
  if (!entries.length) element.append(Object.assign(document.createElement("span"), { className: "soft", textContent: "Nothing is drawn: no value is a number." }));
  return {
    element,
    /** Which names are hidden, and colours of the theme. */
    paint(hidden) {
      for (const { curve, button, line } of entries) {
        button.setAttribute("aria-pressed", String(!hidden.has(curve.label)));
        line.setAttribute("stroke", shownColor(curve.color));
      }
      if (bands) bands.paint();
    },
    /** The values at `t`, also as one text for who does not see the page. */
    tell(t) {
      const said = entries.map(({ curve, value }) => {
        const signal = signals[curve.s];
        value.textContent = withUnit(valueAt(signal, t), signal.unit);
        return `${curve.label} ${value.textContent}`;
      });
      if (bands) said.push(bands.tell(signals[panel.bands.s], t));
      return said.join("; ");
    },
  };
}

/** The colours behind the curves, and which one is there at the cursor. */
function bandsLegend(bands) {
  const element = document.createElement("span");
  element.className = "bands";
  const chips = bands.labels.map((label) => {
    const chip = document.createElement("span");
    chip.className = "band";
    chip.textContent = label;
    element.append(chip);
    return chip;
  });
  return {
    element,
    paint() {
      chips.forEach((chip, value) => chip.style.setProperty("--band", bandColor(bands, value)));
    },
    tell(signal, t) {
      const k = pointBefore(signal, t);
      const value = k < 0 ? -1 : Math.round(signal.values[k]);
      chips.forEach((chip, i) => chip.classList.toggle("now", i === value));
      return bands.labels[value] || "";
    },
  };
}
