"use strict";
/// The page's data (reports/page.schema.json) as rows that name their columns.
nearmiss.data = (() => {
  const raw = JSON.parse(document.getElementById("data").textContent);
  const wordColumns = new Set(["query", "subject", "version", "scalar", "fault", "member", "clause", "change",
                               "severity_text", "asked_as", "headline", "cause", "cause_text", "decision"]);
  const column = new Map(raw.columns.map((name, i) => [name, i]));

  /// The value of a row in a column; "" for a missing word, null for a missing number.
  function value(row, name) {
    const at = column.get(name), v = raw.rows[row][at];
    if (!wordColumns.has(name)) return v;
    return v === null ? "" : raw.words[v];
  }

  const texts = [];
  /// Everything that a filter looks at, in small letters.
  function text(row) {
    if (texts[row] === undefined) {
      texts[row] = ["query", "subject", "scalar", "fault", "member", "change", "cause", "cause_text", "decision", "headline", "id"]
        .map(name => value(row, name)).join(" ").toLowerCase();
    }
    return texts[row];
  }

  const reports = new Map();
  /// {"file", "report", "picture", "plots"} of a row's worst or simplest report; null where the page has none.
  function report(row, which) {
    const both = raw.reports[row];
    if (!both || typeof both[which] !== "string") return null;
    const key = `${row} ${which}`;
    if (!reports.has(key)) reports.set(key, JSON.parse(both[which]));
    return reports.get(key);
  }

  return {raw, count: raw.rows.length, value, text, report, details: row => (raw.reports[row] || {}).details || null};
})();
