"use strict";
/// The view of all answers of the run: a row for each query, a column for each subject. A cell leads to its findings.
nearmiss.subjects = (answers, showFindings) => {
  const {element, count, epsilons, percent, plural} = nearmiss.numbers;
  const cells = answers.map(([query, subject, cases, falseHits, falseMisses, others, broke, none, worst]) =>
    ({query, subject, cases, falseHits, falseMisses, others, broke, none, worst, wrong: falseHits + falseMisses + others + broke}));
  const subjects = [...new Set(cells.map(c => c.subject))], queries = [...new Set(cells.map(c => c.query))];
  const cellOf = new Map(cells.map(c => [`${c.query} ${c.subject}`, c]));

  /// The sum of a row or a column.
  const sum = list => list.reduce((all, c) => {
    for (const key of ["cases", "falseHits", "falseMisses", "others", "broke", "none", "wrong"]) all[key] += c[key];
    return all;
  }, {cases: 0, falseHits: 0, falseMisses: 0, others: 0, broke: 0, none: 0, wrong: 0, worst: null});
  const told = c => [plural(c.cases, "case"), c.falseHits ? plural(c.falseHits, "false hit") : null,
    c.falseMisses ? `${count(c.falseMisses)} false ${c.falseMisses === 1 ? "miss" : "misses"}` : null, c.others ? `${count(c.others)} other wrong ${c.others === 1 ? "answer" : "answers"}` : null,
    c.broke ? `broke in ${count(c.broke)}` : null, c.none ? `no answer to ${count(c.none)}` : null, c.wrong ? null : "nothing wrong",
    typeof c.worst === "number" && c.worst > 0 ? `proved error up to ${epsilons(c.worst)}` : null].filter(Boolean).join(", ");
  /// The least share that is seen is one in a million; each tenfold share is darker.
  const shade = c => (c.wrong === 0 ? 0 : Math.max(0.08, 1 + Math.log10(c.wrong / c.cases) / 6));
  const grave = c => c.falseHits + c.falseMisses + c.broke > 0;
  const text = c => (c.wrong === 0 ? "0" : count(c.wrong));

  function cell(c, what) {
    if (!c || c.cases === 0) return element("td", {class: "none", title: `${what}: not asked`});
    const attributes = {class: c.wrong === 0 ? "right" : grave(c) ? "grave" : "wrong", style: `--share:${(100 * shade(c)).toFixed(0)}%`, title: `${what}: ${told(c)}`};
    if (c.wrong === 0 || !c.query) return element("td", attributes, text(c));
    return element("td", attributes, element("button", {type: "button", onclick: () => showFindings(c.subject, c.query)}, text(c)));
  }
  const row = (name, what, list, all) => element("tr", {class: what === "all" ? "all" : null}, element("th", {scope: "row"}, name),
    list.map((c, i) => cell(c, `${subjects[i]}, ${what === "all" ? "all queries" : what}`)), all);
  const columns = subjects.map(s => sum(cells.filter(c => c.subject === s)));
  const widest = Math.max(...subjects.map(s => s.length));
  return element("section", {"aria-label": "Answers of all subjects"},
    element("p", {class: "note"}, "Wrong answers of each subject to each query: false hits, false misses and breakages ",
      element("b", {class: "grave"}, "in this colour"), ", else ", element("b", {class: "wrong"}, "in this one"),
      "; the darker, the larger the share. A number leads to its findings; point at it for all counts."),
    element("div", {class: "scroll"}, element("table", {},
      element("thead", {}, element("tr", {}, element("td"), subjects.map(s => element("th", {scope: "col"}, element("span", {style: `height:${(0.52 * widest + 1).toFixed(1)}em`}, s))))),
      element("tbody", {}, queries.length > 1 ? row("all", "all", columns, null) : null,
        queries.map(q => row(q, q, subjects.map(s => cellOf.get(`${q} ${s}`)), null))))),
    element("p", {class: "note"}, `${percent(sum(cells).wrong / Math.max(1, sum(cells).cases))} of ${count(sum(cells).cases)} answers are wrong.`));
};
