// Light or dark: as the system has it, until the reader chooses. The choice is kept where the browser lets a page keep it.

const THEMES = ["system", "light", "dark"];
const SIGNS = { system: "◐", light: "☀", dark: "☾" };
const SAID = { system: "as the system has them", light: "light", dark: "dark" };
const themeListeners = new Set();
const systemIsDark = matchMedia("(prefers-color-scheme: dark)");

function keptTheme() {
  try {
    return THEMES.includes(localStorage.getItem("exo-theme")) ? localStorage.getItem("exo-theme") : "system";
  } catch {
    return "system";
  }
}

function keepTheme(name) {
  try {
    localStorage.setItem("exo-theme", name);
  } catch {
    // A page from a file may keep nothing in some browsers: the choice lasts as long as the page.
  }
}

/** Shows a theme, and tells who draws. */
function showTheme(name) {
  document.documentElement.dataset.theme = name;
  const button = document.getElementById("theme");
  button.textContent = SIGNS[name];
  button.setAttribute("aria-label", `Colours: ${SAID[name]}`);
  button.title = `Colours: ${SAID[name]}`;
  for (const listener of [...themeListeners]) listener();
}

/** Whether the page is dark now. */
function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen === "dark" || (chosen !== "light" && systemIsDark.matches);
}

function startTheme() {
  let chosen = keptTheme();
  showTheme(chosen);
  document.getElementById("theme").addEventListener("click", () => {
    chosen = THEMES[(THEMES.indexOf(chosen) + 1) % THEMES.length];
    keepTheme(chosen);
    showTheme(chosen);
  });
  systemIsDark.addEventListener("change", () => showTheme(chosen));
  // Paper is white.
  addEventListener("beforeprint", () => showTheme("light"));
  addEventListener("afterprint", () => showTheme(chosen));
}
