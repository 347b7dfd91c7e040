"use strict";
/// The head of the page, its views, and the keys.
(() => {
  const {data, table, finding, picture} = nearmiss, {element, count, plural} = nearmiss.numbers;
  const {summary} = data.raw, totals = summary.totals || {}, run = summary.run || {};

  // --- head ---
  document.title = `Nearmiss: ${data.raw.name}`;
  document.getElementById("run").textContent = [data.raw.name, run.started ? run.started.replace("T", " ").replace(/:\d\dZ$/, " UTC") : null,
    summary.environment ? `nearmiss ${summary.environment.nearmiss}` : null].filter(Boolean).join(" · ");
  const all = [...Array(data.count).keys()], changeOf = row => data.value(row, "change");
  const change = name => totals[name] ?? all.filter(row => changeOf(row) === name).length;
  const isRegression = row => data.value(row, "decision") === "reopened" || (data.value(row, "ours") === 1 && ["new", "worse"].includes(changeOf(row)));
  const anyChange = all.some(row => changeOf(row) !== "");
  const regressions = all.filter(isRegression).length;
  const others = ["new", "worse"].map(name => [all.filter(row => !isRegression(row) && changeOf(row) === name).length, name]).filter(([n]) => n > 0);
  document.getElementById("verdict").append(...(!anyChange ? [element("b", {}, plural(data.count, "signature"))] : [
    element("b", {class: regressions ? "bad" : "good"}, regressions ? plural(regressions, "regression") : "No regression"),
    others.length ? ` · ${others.map(([n, w]) => `${count(n)} ${w}`).join(", ")} in other libraries` : "", ` · ${plural(data.count, "signature")}`]));
  const total = (name, n) => (typeof n === "number" ? element("div", {}, element("dt", {}, name), element("dd", {}, count(n))) : null);
  document.getElementById("totals").append(...[total("answers", run.cases), total("findings", totals.findings), total("reports", totals.reports),
    total("known", anyChange ? change("known") : null), total("fixed", anyChange ? change("fixed") : null)].filter(Boolean));
  const trend = nearmiss.trend.draw(data.raw.trend);
  if (trend) document.getElementById("trend").append(trend);
  const notes = [];
  for (const link of data.raw.extremes) notes.push(element("a", {href: link}, "maps of extremes"));
  const declared = Object.entries(run.declared || {}).flatMap(([subject, queries]) => Object.entries(queries).flatMap(([query, all]) =>
    all.map(d => `${subject} ${query}: ${d.convention}${d.sentence ? ` ("${d.sentence}")` : ""}`)));
  if (declared.length) {
    notes.push(element("details", {}, element("summary", {}, `${plural(declared.length, "declared convention")}`),
      element("ul", {}, declared.map(line => element("li", {}, line)))));
  }
  if (data.raw.skipped.length) {
    notes.push(element("details", {}, element("summary", {}, `${plural(data.raw.skipped.length, "file")} skipped`),
      element("ul", {}, data.raw.skipped.map(s => element("li", {}, `${s.file}: ${s.why}`)))));
  }
  if (notes.length) document.getElementById("verdict").after(element("p", {class: "notes"}, notes));

  const switchTheme = nearmiss.theme.begin(() => picture.redraw());

  // --- views ---
  const views = nearmiss.views(data.raw.answers, data.raw.trades, () => (table.selected() < 0 ? "" : data.value(table.selected(), "id")),
    words => table.filterBy(words));
  const steps = () => views.shown() || table;

  // --- keys ---
  const keys = document.getElementById("keys"), filter = document.getElementById("filter");
  document.getElementById("help").addEventListener("click", () => keys.showModal());
  const actions = {
    j: () => steps().step(1), k: () => steps().step(-1), ArrowDown: () => table.step(1), ArrowUp: () => table.step(-1),
    Enter: () => finding.focus(), "/": () => { filter.focus(); filter.select(); }, "?": () => keys.showModal(),
    w: () => finding.choose("worst"), s: () => finding.choose("simplest"), c: () => finding.copyReplay(), t: switchTheme,
    1: () => picture.level("whole"), 2: () => picture.level("disagreement"), 3: () => picture.level("ulp"), Escape: () => table.focus(),
  };
  document.addEventListener("keydown", e => {
    if (keys.open || e.ctrlKey || e.metaKey || e.altKey) return;
    const inField = e.target.matches("input[type=search], textarea");
    if (inField && e.key !== "Escape" && e.key !== "Enter") return;
    if (inField && e.key === "Enter") { e.preventDefault(); table.select(0); table.focus(); return; }
    const isArrow = e.key.startsWith("Arrow");
    if (isArrow && !e.target.closest("#table")) return;
    if (e.key === "Enter" && e.target.matches("button, a, summary")) return;
    const action = actions[e.key];
    if (!action || (views.shown() && !"jkt?".includes(e.key))) return;
    e.preventDefault();
    action();
  });

  // --- the selected signature, or the trade and its query, are in the address ---
  const wanted = location.hash.slice(1);
  table.begin(row => {
    finding.show(row);
    history.replaceState(null, "", `#${data.value(row, "id")}`);
  });
  const at = table.rows().findIndex(row => data.value(row, "id") === wanted);
  if (data.count > 0) table.select(Math.max(0, at));
  else document.getElementById("finding").append(element("p", {class: "note"}, "Nothing was found."));
  views.open(wanted);
})();
