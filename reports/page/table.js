"use strict";
/// The table of signatures. Only the rows in sight are elements, so it stays quick with 100,000.
nearmiss.table = (() => {
  const {data} = nearmiss, {element, about, count, epsilons} = nearmiss.numbers;
  const rowHeight = 46, spare = 8;
  const columns = [
    {name: "fault", title: "Fault", text: row => data.value(row, "fault")},
    {name: "subject", title: "Subject", text: row => data.value(row, "subject")},
    {name: "query", title: "Query", text: row => data.value(row, "query")},
    {name: "above_epsilon", title: "Error", number: true, value: row => data.value(row, "above_epsilon") ?? -1},
    {name: "count", title: "Found", number: true, value: row => data.value(row, "findings") ?? data.value(row, "count") ?? 0},
    {name: "severity", title: "Severity", number: true, value: row => data.value(row, "severity") ?? 0},
  ];
  const grid = document.getElementById("table"), body = grid.querySelector(".body"), space = grid.querySelector(".space");
  const shownText = document.getElementById("shown"), filter = document.getElementById("filter");
  let rows = [...Array(data.count).keys()], selected = -1, sort = {name: null, down: true}, change = null, onSelect = () => {};
  let everything = false;  // for print

  function matches(row, words) {
    if (change !== null && (data.value(row, "change") || "") !== change) return false;
    return words.every(w => {
      const [, name, mark, wanted] = w.match(/^([a-z_]+)([:=])(.*)$/) || [];
      if (!data.raw.columns.includes(name)) return data.text(row).includes(w);
      const own = String(data.value(row, name)).toLowerCase();
      return mark === "=" ? own === wanted : own.includes(wanted);
    });
  }
  function update() {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    rows = [];
    for (let row = 0; row < data.count; ++row) if (matches(row, words)) rows.push(row);
    const by = columns.find(c => c.name === sort.name);
    if (by) {
      const sign = sort.down ? -1 : 1;
      if (by.number) {
        const key = new Map(rows.map(r => [r, by.value(r)]));
        rows.sort((a, b) => sign * (key.get(a) - key.get(b)) || a - b);
      } else {
        rows.sort((a, b) => -sign * by.text(a).localeCompare(by.text(b)) || a - b);
      }
    }
    shownText.textContent = rows.length === data.count ? count(rows.length) : `${count(rows.length)} of ${count(data.count)}`;
    grid.setAttribute("aria-rowcount", String(rows.length + 1));
    space.style.height = `${rows.length * rowHeight}px`;
    body.scrollTop = 0;
    heads();
    paint();
  }
  function heads() {
    const head = c => {
      const isSorted = sort.name === c.name;
      return element("div", {role: "columnheader", class: c.name, "aria-sort": isSorted ? (sort.down ? "descending" : "ascending") : "none"},
        element("button", {type: "button", "data-sort": c.name, onclick: () => sortBy(c.name)}, c.title, element("i", {}, isSorted ? (sort.down ? " ↓" : " ↑") : "")));
    };
    const words = columns.filter(c => !c.number), numbers = columns.filter(c => c.number);
    grid.querySelector(".heads").replaceChildren(element("div", {class: "words", role: "presentation"}, words.map(head)), ...numbers.map(head));
  }
  /// The first press sorts numbers from the largest and words from a to z, the second the other way, the third as ranked.
  function sortBy(name) {
    sort = sort.name !== name ? {name, down: true} : sort.down ? {name, down: false} : {name: null, down: true};
    update();
  }
  // The bar is empty for the least severe row and full for the most severe one: most severities of a library are alike.
  const severities = Array.from({length: Math.min(data.count, 1000)}, (_, r) => data.value(r, "severity") || 0);
  const severest = Math.max(...severities), mildest = Math.min(...severities);
  const meter = severity => severest > mildest ? Math.max(3, 100 * Math.min(1, (severity - mildest) / (severest - mildest))) : 100;

  function rowElement(at) {
    const row = rows[at], fault = data.value(row, "fault"), changed = data.value(row, "change"), severity = data.value(row, "severity") || 0;
    const cause = data.value(row, "cause"), decision = data.value(row, "decision");
    const cell = (name, ...content) => element("div", {role: "gridcell", class: name}, ...content);
    return element("div", {role: "row", id: `row-${row}`, class: "row", "data-row": row, "aria-rowindex": at + 2,
                           "aria-selected": String(row === selected), style: everything ? null : `top:${at * rowHeight}px`,
                           onclick: () => { select(at); grid.focus({preventScroll: true}); }},
      cell("what", element("b", {}, element("span", {class: wrongs.has(fault) ? "wrong" : "grave"}, fault || "–"), ` ${data.value(row, "subject")}`),
           element("small", {title: cause ? data.value(row, "cause_text") : null},
                   changed && changed !== "known" ? element("span", {class: `change ${changed}`}, changed) : null,
                   decision ? element("span", {class: "change"}, decision) : null, data.value(row, "query"), cause ? ` · ${cause}` : "")),
      cell("above_epsilon", epsilons(data.value(row, "above_epsilon"))),
      cell("count", count(data.value(row, "findings") ?? data.value(row, "count"))),
      cell("severity", element("span", {title: data.value(row, "severity_text") || about(severity)},
        element("i", {class: "meter"}, element("i", {style: `width:${meter(severity)}%`})))));
  }
  const wrongs = new Set(["wrong time", "negative time", "wrong place", "wrong normal", "wrong depth", "wrong distance", "wrong size", "wrong direction",
    "wrong weight", "wrong flag", "wrong index", "wrong combination", "off the surface", "not unit"]);

  function paint() {
    const first = everything ? 0 : Math.max(0, Math.floor(body.scrollTop / rowHeight) - spare);
    const last = everything ? Math.min(rows.length, 60) : Math.min(rows.length, Math.ceil((body.scrollTop + body.clientHeight) / rowHeight) + spare);
    const elements = [];
    for (let at = first; at < last; ++at) elements.push(rowElement(at));
    if (rows.length === 0) elements.push(element("p", {class: "note"}, "No signature matches."));
    space.replaceChildren(...elements);
    if (selected >= 0) grid.setAttribute("aria-activedescendant", `row-${selected}`);
  }
  /// Selects the row at a place of the table, and scrolls to it.
  function select(at) {
    if (rows.length === 0) return;
    const place = Math.max(0, Math.min(rows.length - 1, at));
    selected = rows[place];
    const top = place * rowHeight;
    if (top < body.scrollTop) body.scrollTop = top;
    if (top + rowHeight > body.scrollTop + body.clientHeight) body.scrollTop = top + rowHeight - body.clientHeight;
    paint();
    onSelect(selected);
  }
  /// As if the words had been typed.
  function filterBy(words) {
    filter.value = words;
    update();
    select(0);
  }
  function step(by) {
    const at = rows.indexOf(selected);
    select(at < 0 ? 0 : at + by);
  }
  function changes() {
    const names = new Map();
    for (let row = 0; row < data.count; ++row) {
      const c = data.value(row, "change");
      if (c) names.set(c, (names.get(c) || 0) + 1);
    }
    if (names.size === 0) return;
    const button = (value, text) => element("button", {type: "button", "aria-pressed": String(change === value),
      onclick: () => { change = value; changes(); update(); }}, text);
    document.getElementById("changes").replaceChildren(button(null, "all"),
      ...["new", "worse", "known", "unproved", "fixed in part", "fixed"].filter(n => names.has(n)).map(n => button(n, `${n} ${count(names.get(n))}`)));
  }

  function begin(listener) {
    onSelect = listener;
    filter.addEventListener("input", update);
    body.addEventListener("scroll", paint, {passive: true});
    new ResizeObserver(paint).observe(body);
    window.addEventListener("beforeprint", () => { everything = true; paint(); });
    window.addEventListener("afterprint", () => { everything = false; paint(); });
    changes();
    update();
  }
  return {begin, select, step, filterBy, sortBy, rows: () => rows, selected: () => selected, place: row => rows.indexOf(row), focus: () => grid.focus()};
})();
