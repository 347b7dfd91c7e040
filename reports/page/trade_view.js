"use strict";
/// The view of a trade: the list of its queries, and the chosen one with its curves and figures.
nearmiss.tradeView = (raw, onChoose) => {
  const {element, about, count, percent, plural} = nearmiss.numbers, trade = nearmiss.tradeOf(raw), {scalar, colour, unit} = trade;
  const panels = nearmiss.panels(trade), profile = nearmiss.profile(trade), stages = nearmiss.stages(trade);
  const subjectOf = (query, name) => query.subjects.find(s => s.subject === name);
  const list = element("div", {class: "queries"}), place = element("article", {class: "query", "aria-label": "Query", tabindex: "-1"});

  const buttons = raw.queries.map((query, i) => {
    const best = query.cheapest && subjectOf(query, query.cheapest);
    return element("button", {type: "button", "aria-pressed": "false", onclick: () => choose(i)}, element("b", {}, query.query),
      element("small", {class: best ? null : "none"}, best ? best.subject : "none meets it"), element("span", {class: "ns"}, best ? `${about(best.time.call.p50)} ns` : ""));
  });
  list.append(...buttons);

  const cell = (text, name = "n") => element("td", {class: name}, text);
  function row(s) {
    const t = s.time, failed = s.requirements.filter(r => r.state === "failed"), open = s.requirements.some(r => r.state === "met so far");
    const why = s.requirements.map(r => `${r.name}: ${about(r.worst)}, at most ${about(r.limit)} ${r.unit}: ${r.state}`).join("\n");
    return element("tr", {}, element("th", {}, element("i", {class: `mark ${scalar(s.subject)}`, style: `--own: ${colour(s.subject)}`}), s.subject),
      cell(t ? about(t.call.p50) : "–"), cell(t ? about(t.call.p99) : "–"), cell(t ? about(t.call.max) : "–"),
      cell(t ? `${about(t.median_of_repeats.low)} … ${about(t.median_of_repeats.high)}` : "–"),
      cell(t && t.calls_per_second ? about(t.calls_per_second / 1e6) : "–"), cell(s.error ? about(s.error.max) : "–"),
      cell(s.forward_ulps ? about(s.forward_ulps.p50) : "–"), cell(s.forward_ulps ? about(s.forward_ulps.p99) : "–"), cell(s.forward_ulps ? about(s.forward_ulps.max) : "–"),
      cell(s.missed.of ? percent(s.missed.share) : "–"), cell(s.phantom.of ? percent(s.phantom.share) : "–"), cell(s.broke.count ? percent(s.broke.share) : "0"),
      element("td", {class: s.meets_all ? "meets" : "fails", title: why}, s.meets_all ? (open ? "so far" : "yes") : `no: ${failed.map(r => r.name).join(", ") || "nothing compared"}`),
      element("td", {}, s.time && s.time.how !== "typed calls" ? s.time.how : ""));
  }
  function table(query) {
    const heads = ["subject", "ns p50", "p99", "max", "p50 of repeats", "million/s", "error", "ulps p50", "p99", "max", "missed", "phantom", "broke", "meets", ""];
    return element("div", {class: "scroll"}, element("table", {}, element("thead", {}, element("tr", {}, heads.map((h, i) => element("th", {class: i > 0 && i < 13 ? "n" : null}, h)))),
      element("tbody", {}, query.subjects.map(row))));
  }
  function headline(query) {
    const best = query.cheapest && subjectOf(query, query.cheapest);
    if (!best) return element("p", {class: "headline"}, "No subject meets every requirement.");
    return element("p", {class: "headline"}, "The cheapest that meets it: ", element("b", {}, best.subject), `, ${about(best.time.call.p50)} ns a call, `,
      `at most ${percent(best.beyond.high)} of its answers beyond the tolerance with 95 % confidence.`);
  }
  function choose(i) {
    const query = raw.queries[i];
    buttons.forEach((b, k) => b.setAttribute("aria-pressed", String(k === i)));
    place.replaceChildren(element("h2", {}, query.query), headline(query), element("div", {class: "charts"}, panels.draw(query)),
      element("p", {class: "note"}, `${plural(query.cases, "case")}, ${count(query.contacts)} of them contacts. A circle is a subject in float, a square one in double. Dotted: the Pareto front. Errors are proved lower bounds.`),
      element("h3", {}, "Figures"), table(query), ...stages.draw(query),
      element("h3", {}, "All queries: performance profile"), profile.draw() || "",
      element("p", {class: "note"}, "The share of all cases with an answer that is not proved wrong beyond the tolerance, at no more than so many times the least time (Dolan and Moré). A query that a subject does not offer counts as unsolved. Dashed: in float."));
    place.scrollTop = 0;
    onChoose(query.query);
  }
  function step(by) {
    const at = buttons.findIndex(b => b.getAttribute("aria-pressed") === "true");
    if (!buttons[at + by]) return;
    choose(at + by);
    buttons[at + by].scrollIntoView({block: "nearest"});
  }
  /// Shows the query of that name, or the first.
  function begin(name) {
    if (raw.queries.length > 0) choose(Math.max(0, raw.queries.findIndex(q => q.query === name)));
    else place.replaceChildren(element("p", {class: "note"}, "No query was measured."));
  }

  const {machine, tolerance} = raw, limit = `${about(tolerance.error)} ${unit}`;
  const description = `${raw.title ? `${raw.title}. ` : ""}${plural(raw.cases, "case")} of each query, the same for every subject; sampled, seed ${raw.seed}. `
    + `Tolerable error: ${limit} (${tolerance.source}). ${machine.processor || "Unknown processor"}, ${plural(machine.processors, "processor")}, load ${about(machine.load)}; median of ${plural(raw.repeats, "repeat")}.`;
  const elements = [element("section", {class: "overview", "aria-label": "Queries"}, element("h3", {}, "The cheapest that meets it"), list), place];
  return {elements, description, begin, step};
};
