"use strict";
/// Light and dark: as the system says, or as the reader chose; the browser keeps the choice.
nearmiss.theme = (() => {
  const root = document.documentElement, system = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => (root.dataset.theme || (system.matches ? "dark" : "light")) === "dark";

  /// Makes the button of the head switch. `onChange` is called after each change; returns the function that switches.
  function begin(onChange = () => {}) {
    try { if (localStorage.getItem("nearmiss-theme")) root.dataset.theme = localStorage.getItem("nearmiss-theme"); } catch (e) { /* a page of a file may have no storage */ }
    const change = () => {
      root.dataset.theme = isDark() ? "light" : "dark";
      try { localStorage.setItem("nearmiss-theme", root.dataset.theme); } catch (e) { /* as above */ }
      onChange();
    };
    document.getElementById("theme").addEventListener("click", change);
    system.addEventListener("change", onChange);
    return change;
  }
  return {begin};
})();
