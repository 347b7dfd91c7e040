#!/usr/bin/env node
// Tests a decision in float against the exact answers to random cases: node docs/example-truth/balls.js ./nearmiss
const { execFileSync } = require("child_process"), float = Math.fround;

function overlap([x1, y1, z1, r1, x2, y2, z2, r2]) { // the function under test
  const [x, y, z, r] = [float(x2 - x1), float(y2 - y1), float(z2 - z1), float(r1 + r2)];
  return float(float(float(x * x) + float(y * y)) + float(z * z)) <= float(r * r);
}

const ball = () => [...[1, 2, 3].map(() => float(Math.random() * 2 - 1)), float(Math.random())];
const cases = Array.from({ length: 1000 }, () => ({ query: "sphere_sphere_overlap", scalar: "float", values: [...ball(), ...ball()] }));
const lines = execFileSync(process.argv[2], ["truth"], { input: cases.map((c) => JSON.stringify(c)).join("\n"), encoding: "utf8" });
lines.trimEnd().split("\n").map((line) => JSON.parse(line)).forEach((truth, i) => {
  const isSure = truth.margin !== null && truth.margin.at_least_epsilon >= 8; // the roundings may flip the other decisions
  if (isSure && overlap(cases[i].values) !== truth.yes) throw new Error(`exactly, ${truth.text}: ${JSON.stringify(cases[i])}`);
});
console.log(`${cases.length} decisions are right`);
