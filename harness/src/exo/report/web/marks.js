// Levels of a panel, such as the wall or a limit, with what they are: written where the curves leave room.

/** Where along the axis a text may begin, as shares of the room that is left; the first that is free is taken. */
const PLACES = [1, 0, 0.5, 0.75, 0.25, 0.875, 0.125, 0.625, 0.375];

/** Draws the levels and their names. */
function drawMarks(u, panel, signals, view) {
  const { ctx } = u;
  const { left, top, width, height } = u.bbox;
  const scale = devicePixelRatio;
  const curves = panel.curves.filter((curve) => !view.hidden.has(curve.label)).map((curve) => signals[curve.s]);
  const taken = [];
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = shownColor("#444444");
  ctx.lineWidth = scale;
  ctx.font = `${11 * scale}px system-ui, sans-serif`;
  ctx.textAlign = "left";
  ctx.textBaseline = "alphabetic";
  const seen = panel.marks.map((mark) => ({ mark, y: u.valToPos(mark, "y", true) })).filter(({ y }) => y >= top && y <= top + height);
  ctx.setLineDash([8 * scale, 3 * scale, 2 * scale, 3 * scale]);
  for (const { y } of seen) {
    ctx.beginPath();
    ctx.moveTo(left, y);
    ctx.lineTo(left + width, y);
    ctx.stroke();
  }
  ctx.setLineDash([]);
  for (const { mark, y } of seen) {
    const text = `${panel.markLabel} ${written(mark)}`.trim();
    const size = { width: ctx.measureText(text).width + 4 * scale, height: 13 * scale };
    const box = freePlace(u, y, size, curves, [...taken, ...seen.map((other) => lineBox(u, other.y))].filter((one) => one.of !== y));
    taken.push(box);
    // Where nothing is free it can be read all the same.
    ctx.strokeStyle = styleColor("--paper");
    ctx.lineWidth = 3 * scale;
    ctx.lineJoin = "round";
    ctx.strokeText(text, box.x + 2 * scale, box.y + 10 * scale);
    ctx.fillText(text, box.x + 2 * scale, box.y + 10 * scale);
  }
  ctx.restore();
}

/** The room of a level's line. */
function lineBox(u, y) {
  return { x: u.bbox.left, y: y - 1, width: u.bbox.width, height: 2, of: y };
}

/** The first place above or below the level at `y` where no curve and nothing that is taken runs through; else the emptiest. */
function freePlace(u, y, size, curves, taken) {
  const { left, top, width, height } = u.bbox;
  const gap = 2 * devicePixelRatio;
  const rows = [y - gap - size.height, y + gap].filter((one) => one >= top && one + size.height <= top + height);
  let best = null;
  for (const share of PLACES) {
    for (const row of rows.length ? rows : [Math.min(Math.max(y - size.height, top), top + height - size.height)]) {
      const box = { x: left + gap + share * Math.max(0, width - size.width - 2 * gap), y: row, ...size };
      const covered = curves.reduce((sum, signal) => sum + crossings(u, signal, box), 0) + 1000 * taken.filter((one) => meet(one, box)).length;
      if (covered === 0) return box;
      if (!best || covered < best.covered) best = { ...box, covered };
    }
  }
  return best;
}

function meet(one, other) {
  return one.x < other.x + other.width && other.x < one.x + one.width && one.y < other.y + other.height && other.y < one.y + one.height;
}

/** How many pieces of a signal's line run through a box (device px). */
function crossings(u, signal, box) {
  const { min, max } = u.scales.x;
  const [from, to] = [box.x, box.x + box.width].map((x) => min + ((x - u.bbox.left) / u.bbox.width) * (max - min));
  let count = 0;
  for (let k = Math.max(pointBefore(signal, from), 0); k + 1 < signal.time.length && signal.time[k] <= to; k++) {
    // The piece within the box's breadth: its heights at both ends.
    const [begin, end] = [Math.max(signal.time[k], from), Math.min(signal.time[k + 1], to)];
    const ends = [valueAt(signal, begin), valueAt(signal, end)].map((value) => u.valToPos(value, "y", true));
    if (end >= begin && Math.min(...ends) <= box.y + box.height && Math.max(...ends) >= box.y) count++;
  }
  return count;
}
