// Filter and search over all verdicts; experiments without a row that is shown are hidden with them. One that has no
// numbers at all is shown where no filter asks for numbers.

const FILTERS = {
  all: () => true,
  fail: (row) => row.dataset.v === "fail",
  pass: (row) => row.dataset.v === "pass",
  info: (row) => row.dataset.v === "info",
  requirement: (row) => row.dataset.r !== undefined,
  changed: (row) => row.dataset.c !== undefined,
};

function startVerdicts() {
  const bodies = [...document.querySelectorAll("#all-verdicts tbody")];
  const rows = bodies.flatMap((body) => [...body.rows].map((row) => ({ row, of: body.dataset.of, text: "" })));
  const experiments = [...document.querySelectorAll("details.experiment")];
  const search = document.getElementById("search");
  const buttons = [...document.querySelectorAll("[data-filter]")];
  let filter = "all";

  /** Every word must stand somewhere in the text. */
  function has(text, words) {
    return words.every((word) => text.includes(word));
  }

  function textOf(element) {
    return element.textContent.toLowerCase().replace(/\s+/g, " ");
  }

  const about = new Map(
    experiments.map((one) => [one.id, textOf(one.querySelector("summary")) + textOf(one.querySelector(".about"))]),
  );

  function show() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const with_ = new Set();
    let count = 0;
    for (const one of rows) {
      if (words.length && !one.text) one.text = textOf(one.row);
      const shown = FILTERS[filter](one.row) && (has(one.text, words) || has(about.get(one.of), words));
      one.row.hidden = !shown;
      if (shown) {
        count += 1;
        with_.add(one.of);
      }
    }
    for (const one of experiments) one.hidden = !with_.has(one.id) && (filter !== "all" || !has(about.get(one.id), words));
    for (const group of document.querySelectorAll("h3.group")) {
      let next = group.nextElementSibling;
      let any = false;
      for (; next && next.matches("details.experiment"); next = next.nextElementSibling) any = any || !next.hidden;
      group.hidden = !any;
    }
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.filter === filter));
    document.getElementById("verdicts").classList.toggle("unfiltered", filter === "all" && !words.length);
    const what = count === rows.length ? `All ${count} numbers` : `${count} of ${rows.length} numbers`;
    document.getElementById("shown").textContent = `${what}, in ${with_.size} of ${experiments.length} experiments.`;
  }

  search.addEventListener("input", show);
  for (const button of buttons) {
    button.addEventListener("click", () => {
      const again = button.classList.contains("tile") && filter === button.dataset.filter;
      filter = again ? "all" : button.dataset.filter;
      show();
      if (button.classList.contains("tile")) document.getElementById("verdicts").scrollIntoView();
    });
  }
  show();
}

/** The rows of one experiment, as a table of its own. */
function verdictsOf(id) {
  const all = document.getElementById("all-verdicts");
  const table = document.createElement("table");
  table.className = all.className;
  table.append(all.tHead.cloneNode(true));
  const body = all.querySelector(`tbody[data-of="${CSS.escape(id)}"]`).cloneNode(true);
  for (const row of body.rows) row.hidden = false;
  for (const link of body.querySelectorAll("a.of")) link.remove();
  table.append(body);
  return table;
}
