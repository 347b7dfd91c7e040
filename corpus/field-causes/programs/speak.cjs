// The protocol of docs/reference/protocol.md for the libraries of this folder, whose packages are in the node_modules of a
// folder that the caller names.
const fs = require("fs");
const path = require("path");
const readline = require("readline");
const { createRequire } = require("module");
const { pathToFileURL } = require("url");

/** The package, with its version, from the folder of the command line. */
async function load(name, file) {
  const from = createRequire(path.resolve(process.argv[2] || ".", "index.js"));
  const entry = from.resolve(name);
  const top = entry.slice(0, entry.lastIndexOf(path.join("node_modules", name)) + path.join("node_modules", name).length);
  const { version } = JSON.parse(fs.readFileSync(path.join(top, "package.json"), "utf8"));
  return { version, library: await import(pathToFileURL(file ? path.join(top, file) : entry)) };
}

/** Answers until the end of file 3. `functions`: for each query, a function from its numbers to an answer. */
function speak(hello, gives, functions) {
  const say = (what) => fs.writeSync(4, JSON.stringify(what) + "\n");
  const offers = Object.keys(functions).map((query) => ({ query, gives: gives[query] }));
  say({ nearmiss: 1, batches: "json", offers, ...hello });
  readline.createInterface({ input: fs.createReadStream(null, { fd: 3 }) }).on("line", (line) => {
    const { query, first, cases } = JSON.parse(line);
    cases.forEach((numbers, i) => say({ case: first + i, ...functions[query](numbers) }));
  });
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const length = (a) => Math.hypot(...a);
const scaled = (a, s) => a.map((x) => x * s);
const unit = (a) => scaled(a, 1 / length(a));
/** The least power of two as a time after which a point is past the ball; 0 without motion. */
function timeToPass(point, velocity, center, radius) {
  const speed = length(velocity);
  if (!(speed > 0)) return 0;
  const way = radius - dot(minus(point, center), unit(velocity));
  return 2 ** Math.ceil(Math.log2((way > 0 ? way : radius || 1) / speed));
}

module.exports = { load, speak, dot, minus, plus, length, scaled, unit, timeToPass };
