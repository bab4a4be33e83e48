// An experiment's section: what is packed is taken out when it is opened, and given back when it is closed.

/** Opens and closes with the <details> `element`. */
function startExperiment(element) {
  const stage = element.querySelector(".stage");
  const own = element.querySelector(".own-verdicts");
  let open = null;

  async function show() {
    const turn = (open = { dispose() {} });
    if (!own.childElementCount) ownVerdicts(own, element.id);
    stage.setAttribute("aria-busy", "true");
    try {
      const pack = await unpack(`pack-${element.id}`);
      const scene = await unpack(`scene-${element.id}`);
      if (open !== turn) return;
      Object.assign(turn, draw(stage, element.querySelector(".replay"), pack, scene && scene.head));
    } catch (error) {
      console.error(error);
      stage.textContent = `The signals cannot be drawn: ${error.message}. A newer browser may help; the pictures lie in the folder ${element.id}.`;
    }
    stage.removeAttribute("aria-busy");
    // The page has grown since the link to here was followed.
    if (element.dataset.linked) element.scrollIntoView();
    delete element.dataset.linked;
  }

  element.addEventListener("toggle", () => {
    if (element.open) {
      show();
    } else if (open) {
      open.dispose();
      open = null;
    }
  });
}

function ownVerdicts(place, id) {
  const table = verdictsOf(id);
  if (!table.tBodies[0].rows.length) return;
  const title = document.createElement("h4");
  title.textContent = "Verdicts";
  const box = document.createElement("div");
  box.className = "box tall";
  box.tabIndex = 0;
  box.setAttribute("role", "region");
  box.setAttribute("aria-label", `Verdicts of ${id}`);
  box.append(table);
  place.append(title, box);
}

/** Draws figures, time bar and replay; answers how they end. */
function draw(stage, replayPlace, pack, scene) {
  const { head, body } = pack;
  const bus = createTimeBus(scene && scene.range ? rangeOf(head, scene) : head.range);
  const signals = signalsOf(head, body);
  const plots = [];
  const urls = [];
  const bar = createTimeBar(bus, {
    zoomIn: () => plots.forEach((one) => one.zoomBy(0.5, bus.time)),
    zoomOut: () => plots.forEach((one) => one.zoomBy(2, bus.time)),
    reset: () => plots.forEach((one) => one.reset()),
  });
  if (head.series.length || scene) stage.append(bar.element);
  for (const figure of head.figures) {
    const { element, inside } = frame(figure);
    stage.append(element);
    if (figure.panels) {
      plots.push(createFigure(inside, figure, signals, bus));
    } else {
      const picture = still(figure, body.bytes(figure.still));
      urls.push(picture.src);
      inside.append(picture);
    }
  }
  const replay = scene && typeof exoReplay !== "undefined" ? mountReplay(replayPlace, scene, bus) : null;

  // At most once a frame, however often the instant moves.
  let waiting = 0;
  function tell() {
    waiting = 0;
    bar.tell(bus.time);
    for (const one of plots) one.tell(bus.time);
  }
  const stop = bus.subscribe(() => (waiting ||= requestAnimationFrame(tell)));
  const repaint = () => plots.forEach((one) => one.paint());
  themeListeners.add(repaint);
  // Where the first plot begins there is something to see.
  const first = plots.length ? plots[0].panels[0].home[0] : bus.range[0];
  bus.set(first, "plots");
  tell();
  return {
    bus,
    dispose() {
      stop();
      cancelAnimationFrame(waiting);
      themeListeners.delete(repaint);
      if (replay) replay.dispose();
      replayPlace.hidden = true;
      replayPlace.replaceChildren();
      for (const one of plots) one.dispose();
      for (const url of urls) URL.revokeObjectURL(url);
      stage.replaceChildren();
    },
  };
}

/** From the first to the last instant that plots or replay show (s). */
function rangeOf(head, scene) {
  const ranges = head.series.length ? [head.range, scene.range] : [scene.range];
  return [Math.min(...ranges.map((one) => one[0])), Math.max(...ranges.map((one) => one[1]))];
}

/** The replay, in step with the bus; where it cannot be drawn the plots stand without it. */
function mountReplay(place, scene, bus) {
  place.hidden = false;
  try {
    return exoReplay.mount(place, scene, bus);
  } catch (error) {
    console.error(error);
    place.textContent = `The replay cannot be drawn: ${error.message}.`;
    return null;
  }
}

/** A figure's frame with its title and the paper's label. */
function frame(figure) {
  const element = document.createElement("figure");
  const caption = document.createElement("figcaption");
  const title = document.createElement("h4");
  title.textContent = figure.title;
  caption.append(title);
  if (figure.label) {
    const label = document.createElement("code");
    label.textContent = figure.label;
    caption.append(label);
  }
  if (figure.x) {
    const over = document.createElement("span");
    over.className = "soft";
    over.textContent = `over ${figure.x}`;
    caption.append(over);
  }
  const inside = document.createElement("div");
  inside.className = "panels";
  inside.style.setProperty("--columns", figure.columns || 1);
  inside.dataset.columns = figure.columns || 1;
  element.append(caption, inside);
  return { element, inside };
}

/** A figure that is no time plot. */
function still(figure, bytes) {
  const picture = document.createElement("img");
  picture.alt = figure.title;
  picture.src = URL.createObjectURL(new Blob([bytes], { type: "image/png" }));
  return picture;
}
