"use strict";
/// The share of wrong answers over the last nights.
nearmiss.trend = (() => {
  const {element, count, percent} = nearmiss.numbers;
  const most = 30;

  function draw(nights) {
    const shown = nights.slice(-most);
    if (shown.length < 2) return null;
    const width = 190, height = 44, share = n => (n.cases > 0 ? n.findings / n.cases : 0);
    const x = d3.scaleLinear().domain([0, shown.length - 1]).range([4, width - 4]);
    const y = d3.scaleLinear().domain([0, d3.max(shown, share) || 1]).range([height - 4, 5]);
    const root = d3.create("svg").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img")
      .attr("aria-label", `Share of wrong answers in ${shown.length} runs`);
    root.append("path").attr("class", "curve").attr("d", d3.line().x((_, i) => x(i)).y(n => y(share(n)))(shown));
    const dots = root.selectAll("circle").data(shown).enter().append("circle").attr("r", 2.6)
      .attr("cx", (_, i) => x(i)).attr("cy", n => y(share(n)))
      .attr("class", (_, i) => (i === shown.length - 1 ? "last" : null));
    dots.append("title").text(n => `${n.run}, ${n.started}: ${count(n.findings)} findings in ${count(n.cases)} cases (${percent(share(n))})`);
    const last = shown[shown.length - 1];
    return element("figure", {}, root.node(), element("figcaption", {}, `${percent(share(last))} of answers wrong; ${shown.length} runs`));
  }
  return {draw};
})();
