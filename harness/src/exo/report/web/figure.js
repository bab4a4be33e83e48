// A figure: its panels in the paper's arrangement. Zoom and hidden names are shared by the panels that show the same time.

const HEIGHT = { wide: 230, narrow: 168 };

/** The parts of a panel beside its axes. */
function panelParts(panel, figure) {
  const element = document.createElement("div");
  element.className = "panel";
  const head = document.createElement("div");
  head.className = "panel-head";
  const title = document.createElement("h5");
  title.textContent = panel.title;
  const unit = document.createElement("span");
  unit.className = "soft";
  unit.textContent = panel.y;
  head.append(title, unit);
  const plot = document.createElement("div");
  plot.className = "plot";
  plot.tabIndex = 0;
  plot.setAttribute("role", "slider");
  plot.setAttribute("aria-label", `${figure.title}: ${panel.title} ${panel.y}: instant`);
  return { element, head, plot };
}

/** Draws `figure` into `element`; answers what the experiment steers it with. */
function createFigure(element, figure, signals, bus) {
  const hidden = new Set();
  const drawn = figure.panels.map((panel) => {
    const own = panel.curves.map((curve) => signals[curve.s].time);
    const ends = Math.max(bus.range[0], ...own.map((time) => time[time.length - 1]));
    // One instant alone stands in the middle.
    const home = panel.xRange || (ends > bus.range[0] ? [bus.range[0], ends] : [ends - 0.5, ends + 0.5]);
    const view = { from: home[0], to: home[1], zoomed: false, hidden };
    const legend = legendOf(panel, signals, controls());
    const parts = panelParts(panel, figure);
    parts.element.append(parts.head, legend.element, parts.plot);
    element.append(parts.element);
    return { panel, home, view, legend, ...parts, u: null, sized: 0 };
  });

  function controls() {
    return {
      toggle(label) {
        if (!hidden.delete(label)) hidden.add(label);
        paint();
      },
      /** This name alone; all, where it is alone already. */
      showAlone(label) {
        const others = drawn.flatMap(({ panel }) => panel.curves.map((curve) => curve.label)).filter((one) => one !== label);
        const alone = !hidden.has(label) && others.every((one) => hidden.has(one));
        hidden.clear();
        if (!alone) others.forEach((one) => hidden.add(one));
        paint();
      },
    };
  }

  /** Shows what is chosen: names, colours, ranges. */
  function paint() {
    for (const { panel, legend, u, view } of drawn) {
      legend.paint(hidden);
      u.batch(() => {
        panel.curves.forEach((curve, i) => u.setSeries(i + 1, { show: !hidden.has(curve.label) }));
        u.setScale("x", { min: view.from, max: view.to });
      });
      u.redraw(false);
    }
  }

  /** All panels that show at first what `one` shows go to [from, to] (s); without it back to that. */
  function zoom(one, range) {
    for (const other of drawn) {
      if (other.home[0] !== one.home[0] || other.home[1] !== one.home[1]) continue;
      const [from, to] = range ? held(range, other.home) : other.home;
      Object.assign(other.view, { from, to, zoomed: Boolean(range) && (from > other.home[0] || to < other.home[1]) });
      other.element.classList.toggle("zoomed", other.view.zoomed);
      mark(other);
      other.u.setScale("x", { min: from, max: to });
    }
  }

  /** What is seen, where styles and tests find it. */
  function mark({ plot, view }) {
    Object.assign(plot.dataset, { from: Number(view.from.toPrecision(9)), to: Number(view.to.toPrecision(9)) });
  }

  /** A range no shorter than a two-thousandth of the whole, and within it. */
  function held([from, to], home) {
    const whole = home[1] - home[0];
    const width = Math.min(Math.max(to - from, whole / 2000), whole);
    const start = Math.min(Math.max((from + to - width) / 2, home[0]), home[1] - width);
    return [start, start + width];
  }

  for (const one of drawn) {
    const size = () => {
      const width = Math.max(Math.floor(one.plot.clientWidth), 60);
      return { width, height: width > 420 ? HEIGHT.wide : HEIGHT.narrow };
    };
    one.u = new uPlot(optionsOf(one.panel, signals, one.view, size()), joined(one.panel, signals), one.plot);
    one.sized = one.plot.clientWidth;
    mark(one);
    steer(one, bus, (range) => zoom(one, range));
    one.resizing = new ResizeObserver(() => {
      if (one.plot.clientWidth === one.sized) return;
      one.sized = one.plot.clientWidth;
      one.u.setSize(size());
      place(one, bus.time);
    });
    one.resizing.observe(one.plot);
  }
  paint();

  function place(one, t) {
    const inside = t >= one.view.from && t <= one.view.to;
    one.u.setCursor({ left: inside ? one.u.valToPos(t, "x") : -10, top: 0 }, false);
  }

  return {
    paint,
    /** Cursor and values at `t` (s). */
    tell(t) {
      for (const one of drawn) {
        place(one, t);
        const said = one.legend.tell(t);
        one.plot.setAttribute("aria-valuenow", String(Number(t.toPrecision(6))));
        one.plot.setAttribute("aria-valuetext", `${written(t)} s: ${said}`);
      }
    },
    reset() {
      hidden.clear();
      for (const one of drawn) zoom(one, null);
      paint();
    },
    zoomBy(factor, t) {
      for (const one of new Map(drawn.map((each) => [each.home.join(), each])).values()) {
        zoom(one, scaled(one.view, factor, t));
      }
    },
    panels: drawn,
    dispose() {
      for (const one of drawn) {
        one.resizing.disconnect();
        one.u.destroy();
      }
      element.replaceChildren();
    },
  };
}
