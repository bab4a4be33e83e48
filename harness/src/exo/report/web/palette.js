// Colours of what is drawn on a canvas: those of the figures on white, and on dark ground ones that are as far apart.

const ON_DARK = {
  "#0072b2": "#4fb0ea",
  "#d55e00": "#ff8a3d",
  "#009e73": "#2fd0a2",
  "#cc79a7": "#e79cc6",
  "#e69f00": "#f2b632",
  "#000000": "#e9edf2",
  "#444444": "#b9c2cd",
};
const BANDS_ON_DARK = ["#20262e", "#333b45", "#16364a", "#1d4a66", "#4d3c14", "#6b4a17", "#6e2f25"];

/** A curve's colour as it is shown now. */
function shownColor(color) {
  return isDark() ? ON_DARK[color] || color : color;
}

/** The colour of a band, by what its value is. */
function bandColor(bands, value) {
  return isDark() ? BANDS_ON_DARK[value % BANDS_ON_DARK.length] : bands.colors[value % bands.colors.length];
}

/** A colour of the page's style, for instance `--soft`. */
function styleColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
