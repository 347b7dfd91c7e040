// A collision library in JavaScript as a subject of Nearmiss; docs/reference/protocol.md explains each line.
//
//     ./nearmiss run --command "node docs/example-program/balls.js" --subject balls-js
const fs = require("fs");
const readline = require("readline");

function ballsMeet([x1, y1, z1, r1, x2, y2, z2, r2]) {
  return { yes: Math.hypot(x1 - x2, y1 - y2, z1 - z2) <= r1 + r2 };
}

function rayMeetsBall([px, py, pz, vx, vy, vz, cx, cy, cz, radius]) {
  const w = [px - cx, py - cy, pz - cz], v = [vx, vy, vz];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const a = dot(v, v), b = dot(w, v), c = dot(w, w) - radius * radius;
  if (c < 0 || a === 0) return { cannot: "it starts inside, or does not move" };
  if (b >= 0 || b * b < a * c) return { yes: false };
  const time = c / (Math.sqrt(b * b - a * c) - b);
  const location = [px + vx * time, py + vy * time, pz + vz * time];
  return { yes: true, values: [time, ...location, null, null, null] }; // no normal
}

const functions = { sphere_sphere_overlap: ballsMeet, moving_point_sphere: rayMeetsBall };
const gives = { moving_point_sphere: ["time", "location"] };
const say = (what) => fs.writeSync(4, JSON.stringify(what) + "\n");
say({
  nearmiss: 3, name: "balls-js", version: "1.0", scalar: "double", batches: "json",
  offers: Object.keys(functions).map((query) => ({ query, gives: gives[query] })),
});
readline.createInterface({ input: fs.createReadStream(null, { fd: 3 }) }).on("line", (line) => {
  const { query, first, cases } = JSON.parse(line);
  const answers = cases.map((numbers, i) => JSON.stringify({ case: first + i, ...functions[query](numbers) }));
  fs.writeSync(4, answers.join("\n") + "\n");
});
