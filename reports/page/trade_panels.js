"use strict";
/// The price curve of a query: time to the right, and in panels the proved error, the missed and the phantom contacts.
nearmiss.panels = ({raw, scalar, colour, unit, short}) => {
  const {about, percent} = nearmiss.numbers;
  const width = 900, left = 64, right = 24, band = 20;

  const costOf = s => s.time.call.p50;
  const timed = query => query.subjects.filter(s => s.time);
  function timeScale(subjects) {
    const low = d3.min(subjects, costOf) || 1, high = d3.max(subjects, s => s.time.call.p99) || 10;
    return d3.scaleLog().domain([low / 1.5, Math.max(high, low * 2) * 1.5]).range([left, width - right]);
  }

  /// A logarithmic scale with a band below it for what is zero: nothing is proved.
  function errorScale(name, values, limit, top, bottom, least) {
    const positive = values.filter(v => v > 0).concat(limit > 0 ? [limit] : []);
    const low = Math.min(least, ...positive) / 2, high = Math.max(low * 100, ...positive) * (name === "error" ? 30 : 2);
    const scale = d3.scaleLog().domain([low, high]).range([bottom - band, top]);
    return Object.assign(v => (v > 0 ? scale(v) : bottom - band / 2), {ticks: d => d3.range(Math.ceil(Math.log10(low)), Math.log10(high) + 1e-9, d).map(e => 10 ** e)});
  }
  const power = v => { const e = Math.round(Math.log10(v)); return e >= -2 && e <= 0 ? String(v) : `10${nearmiss.numbers.raised(e)}`; };

  function frame(root, x, y, top, bottom, name, withTimes, format) {
    root.append("rect").attr("class", "band").attr("x", left).attr("width", width - left - right).attr("y", bottom - band).attr("height", band);
    const every = Math.max(1, Math.ceil(y.ticks(1).length / 6));
    for (const v of y.ticks(every)) {
      root.append("line").attr("class", "rule").attr("x1", left).attr("x2", width - right).attr("y1", y(v)).attr("y2", y(v));
      root.append("text").attr("x", left - 7).attr("y", y(v) + 3.5).attr("text-anchor", "end").text(format(v));
    }
    root.append("text").attr("x", left - 7).attr("y", bottom - band / 2 + 3.5).attr("text-anchor", "end").text("none");
    root.append("text").attr("class", "name").attr("x", left).attr("y", top - 7).text(name);
    root.append("line").attr("class", "rule").attr("x1", left).attr("x2", width - right).attr("y1", bottom).attr("y2", bottom);
    if (!withTimes) return;
    const ticks = x.ticks().filter(t => [1, 2, 5].includes(Number(t.toPrecision(1)[0] || 1)) && /^[125]0*$/.test(String(t)));
    for (const t of ticks) {
      root.append("text").attr("x", x(t)).attr("y", bottom + 15).attr("text-anchor", "middle").text(t.toLocaleString("en"));
    }
    root.append("text").attr("x", width - right).attr("y", bottom + 30).attr("text-anchor", "end").text("ns a call: the median, and a whisker to p99");
  }

  function mark(root, s, cx, cy, text) {
    const isFloat = scalar(s.subject) === "float", own = root.append("g").attr("class", "point").attr("data-subject", s.subject);
    const shape = isFloat ? own.append("circle").attr("cx", cx).attr("cy", cy).attr("r", 4.6)
      : own.append("rect").attr("x", cx - 4.2).attr("y", cy - 4.2).attr("width", 8.4).attr("height", 8.4);
    shape.style("fill", isFloat ? "var(--paper)" : colour(s.subject)).style("stroke", colour(s.subject)).style("stroke-width", 2);
    own.append("title").text(text);
  }
  function whisker(root, s, x1, y1, x2, y2) {
    root.append("line").attr("class", "whisker").attr("x1", x1).attr("y1", y1).attr("x2", x2).attr("y2", y2).style("stroke", colour(s.subject));
  }

  /// Names above their points, moved apart where they would cover a point or another name.
  function labels(root, points, top, bottom) {
    const placed = points.map(p => ({x: p.x - 5, y: p.y, w: 10}));
    for (const p of [...points].sort((a, b) => a.y - b.y || a.x - b.x)) {
      const w = 6.1 * short(p.s.subject).length, isLeft = p.x + w > width - right, lx = isLeft ? p.x - w - 2 : p.x + 3, own = p.y - 10;
      const clash = y => placed.some(o => Math.abs(o.y - y) < 11 && o.x < lx + w && lx < o.x + o.w);
      const tries = d3.range(0, 40).map(step => own + 6 * Math.ceil(step / 2) * (step % 2 ? -1 : 1)).filter(y => y > top - 2 && y < bottom - 2);
      const ly = tries.find(y => !clash(y) && Math.abs(y - p.y) > 7) ?? own;
      placed.push({x: lx, y: ly, w});
      if (Math.abs(ly - p.y) > 16) root.append("line").attr("class", "leader").attr("x1", p.x).attr("y1", p.y).attr("x2", isLeft ? lx + w : lx).attr("y2", ly);
      root.append("text").attr("class", "label").attr("x", lx).attr("y", ly + 3.8).text(short(p.s.subject));
    }
  }

  function errorPanel(query) {
    const height = 300, top = 24, bottom = height - 6, subjects = timed(query), x = timeScale(subjects);
    const error = s => (s.error ? s.error.max : 0), limit = raw.tolerance.error;
    const y = errorScale("error", subjects.map(error), limit, top, bottom, limit / 1e3);
    const root = d3.create("svg").attr("class", "chart").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img")
      .attr("aria-label", `Proved error against time of ${query.query}`);
    frame(root, x, y, top, bottom, `largest proved error (${unit})`, false, power);
    root.append("text").attr("x", width - right - 6).attr("y", bottom - band / 2 + 3.5).attr("text-anchor", "end").text("the oracle proves no error");
    root.append("line").attr("class", "tolerance").attr("x1", left).attr("x2", width - right).attr("y1", y(limit)).attr("y2", y(limit));
    root.append("text").attr("class", "tolerance-text").attr("x", width - right - 4).attr("y", y(limit) - 4).attr("text-anchor", "end").text(`tolerable: ${about(limit)} ${raw.tolerance.unit}`);
    const front = subjects.filter(s => s.on_front).sort((a, b) => costOf(a) - costOf(b));
    root.append("path").attr("class", "front").attr("d", d3.line().x(s => x(costOf(s))).y(s => y(error(s))).curve(d3.curveStepAfter)(front));
    for (const s of subjects) whisker(root, s, x(costOf(s)), y(error(s)), x(s.time.call.p99), y(error(s)));
    const points = subjects.map(s => ({s, x: x(costOf(s)), y: y(error(s))}));
    labels(root, points, top, bottom);
    for (const p of points) {
      mark(root, p.s, p.x, p.y, `${p.s.subject}: ${about(costOf(p.s))} ns, p99 ${about(p.s.time.call.p99)} ns; error up to ${about(error(p.s))} ${unit}`);
    }
    return root.node();
  }

  function ratePanel(query, member, name, limit, withTimes) {
    const height = withTimes ? 148 : 112, top = 24, bottom = height - (withTimes ? 36 : 6), subjects = timed(query).filter(s => s[member].of > 0);
    const x = timeScale(timed(query)), y = errorScale("rate", subjects.map(s => s[member].share), limit, top, bottom, 1e-4);
    const root = d3.create("svg").attr("class", "chart").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img").attr("aria-label", `${name} against time of ${query.query}`);
    frame(root, x, y, top, bottom, name, withTimes, v => percent(v));
    root.append("line").attr("class", "tolerance").attr("x1", left).attr("x2", width - right).attr("y1", y(limit)).attr("y2", y(limit));
    for (const s of subjects) {
      const r = s[member], cx = x(costOf(s)), cy = y(r.share);
      if (r.count > 0) whisker(root, s, cx, Math.max(top, y(Math.min(1, r.high))), cx, Math.min(bottom - band, y(r.low)));
      const depth = member === "missed" ? s.missed_depth : s.phantom_gap;
      mark(root, s, cx, cy, `${s.subject}: ${r.count} of ${r.of}, 95 % from ${percent(r.low)} to ${percent(r.high)}${depth ? `; up to ${about(depth.max)} ${unit}` : ""}`);
    }
    return root.node();
  }

  function draw(query) {
    if (timed(query).length === 0) return [];
    return [errorPanel(query), ratePanel(query, "missed", "missed contacts, share of the contacts, with 95 % intervals; dashed: the limit for those that are deeper than is tolerable", raw.tolerance.missed_rate, false),
      ratePanel(query, "phantom", "phantom contacts, share of the reported contacts, with 95 % intervals; dashed: the limit for wider ones", raw.tolerance.phantom_rate, true)];
  }
  return {draw};
};
