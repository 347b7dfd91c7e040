"use strict";
/// The performance profile over all queries.
nearmiss.profile = ({raw, scalar, colour, short}) => {
  const {percent} = nearmiss.numbers;

  function draw() {
    const {taus, curves} = raw.profile;
    if (curves.length === 0) return null;
    const width = 900, height = 320, left = 64, right = 150, top = 16, bottom = height - 38;
    const x = d3.scaleLog().domain([1, taus[taus.length - 1]]).range([left, width - right]), y = d3.scaleLinear().domain([0, 1]).range([bottom, top]);
    const root = d3.create("svg").attr("class", "chart").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img").attr("aria-label", "Performance profile over all queries");
    for (const v of [0, 0.25, 0.5, 0.75, 1]) {
      root.append("line").attr("class", "rule").attr("x1", left).attr("x2", width - right).attr("y1", y(v)).attr("y2", y(v));
      root.append("text").attr("x", left - 7).attr("y", y(v) + 3.5).attr("text-anchor", "end").text(percent(v));
    }
    for (const t of [1, 2, 4, 10, 30, 100, 300, 1000]) root.append("text").attr("x", x(t)).attr("y", bottom + 16).attr("text-anchor", "middle").text(String(t));
    root.append("text").attr("x", width - right).attr("y", bottom + 32).attr("text-anchor", "end").text("times the least time of any subject");
    const line = d3.line().x((_, i) => x(taus[i])).y(v => y(v)).curve(d3.curveStepAfter);
    for (const c of curves) {
      root.append("path").attr("class", `curve ${scalar(c.subject)}`).attr("d", line(c.share)).attr("data-subject", c.subject).style("stroke", colour(c.subject))
        .append("title").text(`${c.subject}: right within the tolerance in ${percent(c.solved)} of all cases`);
    }
    let above = -Infinity;
    for (const c of [...curves].sort((a, b) => b.share[b.share.length - 1] - a.share[a.share.length - 1])) {
      const at = Math.max(y(c.share[c.share.length - 1]), above + 12);
      above = at;
      root.append("text").attr("x", width - right + 7).attr("y", at + 3.5).style("fill", colour(c.subject)).text(short(c.subject));
    }
    return root.node();
  }
  return {draw};
};
