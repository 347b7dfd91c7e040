"use strict";
/// The panel of one signature: the verdict first, then the picture, the numbers, the cause, and how to replay it.
nearmiss.finding = (() => {
  const {data} = nearmiss, {element, exact, about, count, percent, plural, readable} = nearmiss.numbers;
  const panel = document.getElementById("finding");
  let row = -1, which = "worst", copied = null;

  const section = (title, ...content) => element("section", {}, element("h3", {}, title), ...content);
  function copyable(text, label) {
    const button = element("button", {type: "button", class: "copy", "data-copy": label, onclick: () => copy(text, button)}, "Copy");
    return element("div", {class: "code"}, element("pre", {tabindex: 0}, text), button);
  }
  async function copy(text, button) {
    try {
      await navigator.clipboard.writeText(text);
    } catch (e) {  // a page of a file may not be allowed to
      const area = element("textarea", {}, text);
      document.body.append(area);
      area.select();
      document.execCommand("copy");
      area.remove();
    }
    button.textContent = "Copied";
    clearTimeout(copied);
    copied = setTimeout(() => { button.textContent = "Copy"; }, 1500);
  }

  // --- the verdict ---
  function head(r) {
    const fault = data.value(row, "fault"), change = data.value(row, "change"), decision = data.value(row, "decision");
    const which_ = data.report(row, "simplest") === null ? null : element("div", {class: "switch", role: "group", "aria-label": "Report"},
      ["worst", "simplest"].map(w => element("button", {type: "button", "aria-pressed": String(w === which), onclick: () => choose(w)}, w)));
    const told = data.value(row, "severity_text"), reports = plural(data.value(row, "count") || 0, "report");
    const share = data.value(row, "ordinary_share") ?? null;
    const facts = told ? [readable(told), reports] : [
      `found ${count(data.value(row, "findings") ?? data.value(row, "count"))} times, in ${reports}`,
      share === null ? null : `${percent(share)} ordinary scenes`];
    facts.push(
      data.value(row, "asked_as") ? `asked as: ${data.value(row, "asked_as")}` : null,
      r ? `${r.report.subject.version}, ${r.report.scalar}` : data.value(row, "version") || null);
    return [
      element("p", {class: "tags"}, element("b", {class: "fault"}, fault), change ? element("span", {class: `change ${change}`}, change) : null,
        decision ? element("span", {class: "change"}, decision) : null, element("code", {}, data.value(row, "query")), which_),
      element("h2", {}, readable(data.value(row, "headline")) || `${data.value(row, "subject")}: ${fault} in ${data.value(row, "query")}`),
      r ? element("p", {class: "explanation"}, readable(r.report.explanation)) : null,
      element("p", {class: "facts"}, facts.filter(Boolean).join(" · ")),
    ];
  }

  // --- the answers ---
  /// The numbers of nested values as pairs of name and value; an enclosure is one value.
  function leaves(values, name = "", out = []) {
    const isEnclosure = v => Array.isArray(v) && v.length === 2 && v.every(x => !Array.isArray(x));
    if (Array.isArray(values) && !isEnclosure(values)) values.forEach((v, i) => leaves(v, `${name}.${values.length === 3 ? "xyz"[i] : i}`, out));
    else if (values !== null && typeof values === "object" && !Array.isArray(values)) Object.entries(values).forEach(([k, v]) => leaves(v, name ? `${name}.${k}` : k, out));
    else out.push([name, values]);
    return out;
  }
  const middle = v => (Array.isArray(v) ? (v[0] === v[1] ? v[0] : v[0] + (v[1] - v[0]) / 2) : v);
  const sign = x => (typeof x === "number" && (x < 0 || Object.is(x, -0)) ? "" : "\u00a0");  // digits stand below digits
  /// A number whose digits are marked from the first on that differs from the exact number's.
  function compared(text, right) {
    let same = 0;
    while (same < text.length && text[same] === right[same]) ++same;
    return [text.slice(0, same), same < text.length ? element("mark", {}, text.slice(same)) : null];
  }
  function nearestAlternative(r) {
    const given = r.report.answer.values ? leaves(r.report.answer.values) : [];
    const distance = a => {
      const exactOnes = new Map(leaves(a.values));
      return given.reduce((sum, [name, v]) => sum + (typeof v === "number" && exactOnes.has(name) ? Math.abs(v - middle(exactOnes.get(name))) : 0), 0);
    };
    return [...r.report.truth.alternatives].sort((a, b) => distance(a) - distance(b))[0];
  }
  function answers(r) {
    const {answer, truth, scalar, kind, subject} = r.report, decides = ["decision", "impact", "depth"].includes(kind);
    if (answer.status !== "answered")
      return section("Answer", element("p", {}, `${subject.name} ${answer.status === "broke" ? "broke" : "has no answer"}: ${answer.reason}. Exactly, ${truth.text}.`),
        r.report.output && r.report.output.length ? element("pre", {class: "output"}, r.report.output.join("\n")) : null);
    const alternative = nearestAlternative(r), said = new Map(leaves(answer.values)), right = new Map(leaves(alternative.values)), decimals = new Map(leaves(alternative.decimals || {}));
    const most = 16, all = [...new Set([...said.keys(), ...right.keys()])];
    const differs = name => said.has(name) && right.has(name) && said.get(name) !== middle(right.get(name));
    const names = all.length <= most ? all : [...all.filter(differs), ...all.filter(n => !differs(n))].slice(0, most);
    const line = name => {
      const a = said.get(name), b = right.get(name), text = b === undefined ? "" : decimals.get(name) ?? exact(middle(b), "double");
      const apart = typeof a === "number" && typeof middle(b) === "number" ? a - middle(b) : null;
      const many = alternative.normal_cone && b === undefined;
      return element("tr", {}, element("th", {scope: "row"}, name), element("td", {}, a === undefined ? "–" : [sign(a), compared(exact(a, scalar), text.replace("≈", ""))]),
        element("td", {}, text ? [sign(middle(b)), text] : many ? "one of many" : "–"), element("td", {class: "apart"}, apart === null ? "" : about(apart)));
    };
    const yes = v => (v ? "yes" : "no");
    const more = truth.alternatives.length - 1, left = all.length - names.length;
    return section("Answer",
      element("table", {class: "answers"}, element("thead", {}, element("tr", {}, element("th", {}, ""), element("th", {scope: "col"}, subject.name), element("th", {scope: "col"}, "exact"), element("th", {scope: "col"}, "difference"))),
        element("tbody", {}, decides ? element("tr", {}, element("th", {scope: "row"}, "decision"), element("td", {}, answer.yes === truth.yes ? yes(answer.yes) : element("mark", {}, yes(answer.yes))), element("td", {}, yes(truth.yes)), element("td")) : null, names.map(line))),
      left > 0 ? element("p", {class: "note"}, `And ${plural(left, "number")} that ${left === 1 ? "is" : "are"} not shown.`) : null,
      more > 0 ? element("p", {class: "note"}, `The nearest of ${more + 1} right answers is shown.`) : null);
  }

  // --- the numbers ---
  /// A narrow range as distances from the case's own value, otherwise its ends.
  function rangeText({low, high, lowest, highest}, own) {
    if (low === high) return "this value alone";
    const isNarrow = !lowest && !highest && high - low < 1e-3 * Math.abs(own);
    if (isNarrow) return `−${about(own - low)} … +${about(high - own)}`;
    return `${lowest ? "lowest" : about(low)} … ${highest ? "highest" : about(high)}`;
  }
  const isGone = r => (r.plots || []).some(nearmiss.plot.isGone);
  function ranges(r) {
    const minimised = new Map(((r.report.minimised || {}).same_finding || []).map(x => [x.number, x]));
    const plots = new Map((r.plots || []).map(p => [p.number, p]));
    const inputs = leaves(r.report.inputs), gone = isGone(r);
    const rows = inputs.map(([name, v]) => {
      const m = minimised.get(name), p = plots.get(name), same = p && !gone ? nearmiss.plot.sameFault(p) : null;
      const free = m ? m.to_lowest && m.to_highest : same ? same.all : false;
      const range = m ? (free ? "any value" : rangeText({low: m.low, high: m.high, lowest: m.to_lowest, highest: m.to_highest}, v))
        : same ? (same.all ? "any asked value" : rangeText(same, v)) : "";
      return {name, v, free, range};
    });
    const proved = minimised.size > 0;
    return section("What matters", element("table", {class: "inputs"},
      element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "number"), element("th", {scope: "col"}, "value"), element("th", {scope: "col"}, "same finding in"))),
      element("tbody", {}, rows.map(x => element("tr", {class: x.free ? "free" : null}, element("th", {scope: "row"}, x.name), element("td", {}, exact(x.v, r.report.scalar)), element("td", {}, x.range))))),
      element("p", {class: "note"}, rows.some(x => x.free) ? "Grey numbers play no part: every asked value gives the same finding. " : "",
        gone && !proved ? "The subject answers this case without the finding now." : proved ? "Ranges are those of minimise, which asks values at distances that double." : plots.size ? "Ranges are those of the plots below." : "No ranges: the subject was not asked."));
  }
  function plots(r) {
    if (!r.plots || r.plots.length === 0) return section("Error along each number", element("p", {class: "note"}, "The subject was not asked: it is not in the build that wrote this page, or the time was over."));
    const free = p => !isGone(r) && nearmiss.plot.sameFault(p).all;
    return section("Error along each number",
      element("p", {class: "note"}, "Bits of the proved backward error where one number is moved, as a share of the largest number of its kind. ",
        element("span", {class: "key grave"}, "×"), " wrong decision or breakage, ", element("span", {class: "key wrong"}, "●"), " another finding, ", element("span", {class: "key right"}, "○"), " none."),
      element("div", {class: "plots"}, r.plots.map(p => nearmiss.plot.draw(p, exact(p.value, r.report.scalar), free(p)))));
  }

  // --- cause, referees, replay ---
  function cause(r) {
    const d = data.details(row) || {}, c = d.cause;
    const parts = [];
    for (const [i, named] of (c ? [c, ...c.either || []] : []).entries())
      parts.push(element("p", {}, i ? "Or " : "", element("b", {}, named.kind), named.text ? `: ${named.text}` : ""));
    if (c && c.evidence && c.evidence.length) parts.push(element("table", {class: "evidence"}, element("tbody", {}, c.evidence.map(e => element("tr", {}, element("th", {scope: "row"}, e.test), element("td", {}, e.result))))));
    if (d.regions && d.regions.length) parts.push(element("p", {class: "note"}, `Where: ${d.regions.join(", ")}`));
    if (d.decision) parts.push(element("p", {}, "Decision: ", element("b", {}, d.decision.kind), d.decision.reopened ? ", reopened because the finding got worse" : "", d.decision.note ? `. ${d.decision.note}` : "", d.decision.url ? ` ${d.decision.url}` : ""));
    const {clause} = r ? r.report.finding : {};
    if (clause) {
      const label = clause.startsWith("the scene ") ? "Not met" : "Broken promise";
      parts.push(element("p", {class: "note"}, `${label}: ${clause}.`));
    }
    const moves = r && r.report.origin ? r.report.origin.moves : null;
    if (moves) parts.push(element("p", {class: "note"}, moves.length ? `The generator made the case by: ${moves.join(", ")}.` : "The case has no special construction."));
    return parts.length ? section("Cause", ...parts) : null;
  }
  function said(answer) {
    if (answer.status !== "answered") return `${answer.status}: ${answer.reason}`;
    const all = leaves(answer.values), first = all.find(([name]) => name === "time" || name === "depth") || all[0];
    return `${answer.yes ? "yes" : "no"}${first ? `, ${first[0]} ${about(first[1])}` : ""}`;
  }
  function referees(r) {
    const checks = r.report.static_checks || [];
    if (!r.report.referees.length && !checks.length) return section("Referees", element("p", {class: "note"}, "No other library answers this query."));
    const touch = v => (v === null ? "no answer" : v ? "touching" : "apart");
    return section("Referees", element("table", {class: "referees"}, element("tbody", {}, r.report.referees.map(o =>
      element("tr", {}, element("th", {scope: "row"}, o.name), element("td", {}, said(o.answer)),
        element("td", {}, o.agrees === null ? "" : o.agrees ? "agrees with the exact answer" : o.agrees_on_decision ? `right decision, ${o.disagreement}` : o.disagreement))),
      checks.map(k => element("tr", {}, element("th", {scope: "row"}, k.name), element("td", {}, `${k.query} at the time of the ${k.of}`), element("td", {}, `before ${touch(k.before.touching)}, then ${touch(k.at.touching)}, after ${touch(k.after.touching)}`))))));
  }
  function replay(r) {
    const d = data.details(row) || {}, test = d.test || r.report.test;
    return section("Replay", copyable(r.report.replay, "replay"), element("h4", {}, "As C++"), copyable(r.report.cpp, "cpp"),
      typeof test === "string" ? [element("h4", {}, "Test"), copyable(test, "test")] : null);
  }
  function files() {
    const d = data.details(row);
    if (!d || !d.files || d.files.length < 2) return null;
    const more = (data.value(row, "count") || 0) - d.files.length;
    return section("Reports", element("ul", {class: "files"}, d.files.map(f => element("li", {}, element("a", {href: f}, f))), more > 0 ? element("li", {}, `and ${count(more)} more`) : null));
  }

  /// The scale at which the inputs would have to move, in units of the picture.
  function movedBy(r) {
    const b = r.report.finding.backward, moved = b && b.moved ? b.moved.position : null;
    return typeof moved === "number" ? moved / 2 ** r.picture.unit_exponent : 0;
  }
  function show(newRow) {
    row = newRow;
    draw();
  }
  function choose(w) {
    if (data.report(row, w) === null) return;
    which = w;
    draw();
  }
  function draw() {
    const r = data.report(row, which) || data.report(row, "worst") || data.report(row, "simplest");
    nearmiss.picture.end();
    const picture = element("div", {class: "picture"});
    if (!r) {
      panel.replaceChildren(...head(null).filter(Boolean), cause(null) || "", element("p", {class: "note"}, "This page has no report of this signature: it holds those of the most severe ones. Render a folder with fewer to see it."));
    } else {
      panel.replaceChildren(...[...head(r), picture, element("div", {class: "pair"}, answers(r), ranges(r)), plots(r), cause(r), referees(r), replay(r), files()].filter(Boolean));
      nearmiss.picture.show(picture, r.picture, {subject: r.report.subject.name, moved: movedBy(r), label: `Picture of ${r.report.query}: ${r.report.headline}`});
    }
    panel.scrollTop = 0;
  }
  const copyReplay = () => { const b = panel.querySelector("[data-copy=replay]"); if (b) b.click(); };
  return {show, choose, copyReplay, redraw: draw, focus: () => panel.focus()};
})();
