"use strict";
/// The page of a trade alone: its head and its keys.
(() => {
  const raw = JSON.parse(document.getElementById("data").textContent);
  document.getElementById("run").textContent = [raw.scene || "generated cases", raw.started.replace("T", " ").replace(/:\d\dZ$/, " UTC"), `nearmiss ${raw.environment.nearmiss}`].join(" · ");
  const switchTheme = nearmiss.theme.begin();
  const view = nearmiss.tradeView(raw, query => history.replaceState(null, "", `#${query}`));
  document.getElementById("verdict").textContent = view.description;
  document.querySelector("main").append(...view.elements);
  view.begin(location.hash.slice(1));
  document.addEventListener("keydown", e => {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const step = {j: 1, k: -1}[e.key];
    if (step) view.step(step);
    if (e.key === "t") switchTheme();
  });
})();
