"use strict";
/// The error along each number: bits of the proved backward error, and the fault, where one number alone is moved.
nearmiss.plot = (() => {
  const {element, about, raised} = nearmiss.numbers;
  const svg = (name, attributes, ...children) => {
    const e = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    e.append(...children);
    return e;
  };
  const bits = sample => Math.log2(1 + Math.max(0, sample[3] ?? 0));
  const graves = new Set(["false miss", "false hit", "not finite", "broke"]);

  /// The values around the case's own one with the same fault: {"low", "high", "all"}.
  function sameFault(plot) {
    const s = plot.samples, own = s.findIndex(x => x[0] === 0), fault = s[own][2];
    let low = own, high = own;
    while (low > 0 && s[low - 1][2] === fault) --low;
    while (high + 1 < s.length && s[high + 1][2] === fault) ++high;
    const asked = s.filter(x => x[2] !== null);
    return {low: s[low][1], high: s[high][1], all: asked.every(x => x[2] === fault), lowest: low === 0, highest: high === s.length - 1};
  }

  /// Whether the subject still has the finding: it may have been mended since the report.
  function isGone(plot) {
    return plot.samples.some(s => s[0] === 0 && s[2] === "");
  }

  function draw(plot, ownText, plainly) {
    const width = 330, height = 104, left = 28, right = 12, top = 8, bottom = 20;
    const least = Math.min(...plot.samples.filter(s => s[0] !== 0).map(s => Math.log2(Math.abs(s[0]) / plot.scale)));
    const place = change => (change === 0 ? 0 : Math.sign(change) * (Math.log2(Math.abs(change) / plot.scale) - least + 3));
    const reach = Math.max(...plot.samples.map(s => Math.abs(place(s[0]))));
    const x = d3.scaleLinear().domain([-reach, reach]).range([left, width - right]);
    const y = d3.scaleLinear().domain([0, 52]).range([height - bottom, top]);
    const root = svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", class: "plot",
      "aria-label": `Bits of error where ${plot.number} is moved from ${ownText}`});
    for (const v of [0, 26, 52]) {
      root.append(svg("line", {x1: left, x2: width - right, y1: y(v), y2: y(v), class: "rule"}),
                  svg("text", {x: left - 5, y: y(v) + 3.5, "text-anchor": "end"}, String(v)));
    }
    root.append(svg("line", {x1: x(0), x2: x(0), y1: top - 4, y2: height - bottom, class: "own"}));
    for (const e of [1, 2 ** -20, 2 ** -40].filter(e => Math.log2(e) > least + 5)) {
      for (const sign of [-1, 1]) {
        const name = e === 1 ? "1" : `2${raised(Math.log2(e))}`;
        root.append(svg("text", {x: x(place(sign * e * plot.scale)), y: height - 6, "text-anchor": "middle"}, `${sign < 0 ? "−" : "+"}${name}`));
      }
    }
    root.append(svg("text", {x: x(0), y: height - 6, "text-anchor": "middle", class: "own-text"}, "0"));
    const known = plot.samples.filter(s => s[2] !== null);
    const line = d3.line().x(s => x(place(s[0]))).y(s => y(bits(s)));
    root.append(svg("path", {d: line(known) || "", class: "curve"}));
    for (const s of known) {
      const cx = x(place(s[0])), cy = y(bits(s)), size = 3;
      const mark = graves.has(s[2]) ? svg("path", {d: `M${cx - size} ${cy - size}l${2 * size} ${2 * size}m0 ${-2 * size}l${-2 * size} ${2 * size}`, class: "grave"})
        : svg("circle", {cx, cy, r: s[2] ? size : 2, class: s[2] ? "wrong" : "right"});
      mark.append(svg("title", {}, `${plot.number} = ${s[1]}: ${s[2] || "no finding"}${s[3] === null ? "" : `, more than ${about(bits(s))} bits`}`));
      root.append(mark);
    }
    return element("figure", {class: plainly ? "free" : null},
      element("figcaption", {}, element("b", {}, plot.number), ` = ${ownText}`), root);
  }
  return {draw, isGone, sameFault};
})();
