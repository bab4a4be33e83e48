// Starts the page.
startTheme();
startVerdicts();
for (const element of document.querySelectorAll("details.experiment")) startExperiment(element);

/** A link to an experiment opens it. */
function openLinked() {
  const element = location.hash.length > 1 && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (element && element.matches("details.experiment")) {
    element.hidden = false;
    if (!element.open) element.dataset.linked = "yes";
    element.open = true;
    element.scrollIntoView();
  }
}
addEventListener("hashchange", openLinked);
document.addEventListener("click", (event) => {
  // The same link again does not change the address.
  const link = event.target.closest("a[href^='#']");
  if (link && link.getAttribute("href") === location.hash) openLinked();
});
openLinked();
