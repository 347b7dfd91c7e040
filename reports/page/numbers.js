"use strict";
/// Numbers and elements for readers.
const nearmiss = {};

nearmiss.numbers = (() => {
  /// The shortest decimal that reads back as the same number of the scalar.
  function exact(x, scalar) {
    if (typeof x !== "number") return String(x);
    if (scalar !== "float" || !Number.isFinite(x)) return String(x);
    for (let digits = 1; digits <= 9; ++digits) {
      const text = Number(x.toPrecision(digits));
      if (Math.fround(text) === x) return String(text);
    }
    return String(x);
  }
  /// About three digits.
  function about(x) {
    if (typeof x !== "number") return x === null || x === undefined ? "–" : String(x);
    if (x === 0) return "0";
    const size = Math.abs(x);
    if (size >= 1e-3 && size < 1e5) return String(Number(x.toPrecision(3)));
    const [mantissa, exponent] = x.toExponential(2).split("e");
    return `${Number(mantissa)} × 10${raised(Number(exponent))}`;
  }
  const raised = n => String(n).replace(/[-0-9]/g, c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  const count = n => (typeof n === "number" ? n.toLocaleString("en") : "–");
  /// A share of the size of a case: "0.78 %"; below a thousandth of a percent as a power of ten.
  const percent = x => (typeof x !== "number" ? "–" : x >= 1e-5 ? `${about(100 * x)} %` : about(x));
  /// A whole power of two, or a decimal.
  function epsilons(k) {
    if (typeof k !== "number") return "–";
    const e = Math.log2(k);
    return Number.isInteger(e) && k > 64 ? `2${raised(e)} ε` : `${about(k)} ε`;
  }
  /// Text of a report with its powers as a person writes them: 2^50 as 2⁵⁰.
  const readable = text => text.replace(/\^(-?\d+)/g, (_, n) => raised(n));
  const plural = (n, noun) => `${count(n)} ${n === 1 ? noun : noun.replace(/([^aeiou])y$/, "$1ie") + "s"}`;

  /// An element with attributes and children. Text is never read as HTML.
  function element(name, attributes = {}, ...children) {
    const e = document.createElement(name);
    for (const [key, v] of Object.entries(attributes)) {
      if (v === null || v === undefined || v === false) continue;
      if (key === "class") e.className = v;
      else if (key.startsWith("on")) e.addEventListener(key.slice(2), v);
      else e.setAttribute(key, v === true ? "" : v);
    }
    for (const child of children.flat(Infinity)) if (child !== null && child !== undefined) e.append(child);
    return e;
  }
  return {exact, about, raised, readable, count, percent, epsilons, plural, element};
})();
