"use strict";
/// A measured trade (reports/trade.schema.json), and the look of its subjects.
nearmiss.tradeOf = raw => {
  const families = [["collide-fast", "fast"], ["collide-accurate", "accurate"], ["collide-decisive", "decisive"],
    ["collide-certified", "certified"], ["fcl", "fcl"], ["bullet", "bullet"], ["ode", "ode"], ["libccd", "libccd"]];
  const family = name => (families.find(([start]) => name.startsWith(start)) || [null, "other"])[1];
  const scalar = name => (raw.subjects.find(s => s.name === name) || {scalar: "double"}).scalar;
  const colour = name => `var(--${family(name)})`;
  const unit = raw.tolerance.unit || "of the largest length";
  /// Shorter for pictures: "certified-float".
  const short = name => name.replace(/^collide-/, "");
  return {raw, family, scalar, colour, unit, short};
};
