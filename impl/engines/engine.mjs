// What the subjects of engines share: the package of npm, arithmetic, and the table.
//
//     node impl/engines/NAME/subject.mjs [FOLDER] [--setting SETTING] [--undeclared] [--package PACKAGE] [--time FILE]
//
// FOLDER has node_modules; without it the engine is the one that './nearmiss engines NAME' installed. --setting takes other
// settings of the engine than the usual ones, a word of its settings.txt; the subject is then NAME-SETTING. With --undeclared the
// subject declares nothing, as if its documentation said nothing, --package takes another package than usual and its name for that of the subject. With --time it
// answers no cases of Nearmiss: it writes how long the calls take for the cases of a file, {"query": ..., "inputs": ...} in each line.
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { answer, Cannot } from "../program/nearmiss.mjs";

const options = process.argv.slice(3);
/** Whether the subject declares its conventions, and leaves out what the documentation calls undefined. */
export const declares = !options.includes("--undeclared");
const option = (name) => (options.includes(name) ? options[options.indexOf(name) + 1] : undefined);
/** A word of settings.txt; undefined for the usual settings. */
export const setting = option("--setting");

const otherPackage = option("--package");
/** The name of the subject without its setting. */
export const named = (name) => otherPackage ?? name;

/** The file that `import` finds for a specifier, "PACKAGE" or "PACKAGE/FILE", and the version of the installed package. */
export function packaged(specifier) {
  const [, name, file] = /^((?:@[^/]+\/)?[^/]+)\/?(.*)$/.exec(specifier);
  const own = path.dirname(process.argv[1]);
  const folder = path.resolve(process.argv[2] ?? path.join(own, "../../../build/engines", path.basename(own)));
  const top = path.join(folder, "node_modules", named(name));
  const { version, main, exports } = JSON.parse(fs.readFileSync(path.join(top, "package.json"), "utf8"));
  const entry = exports?.["."]?.import ?? exports?.["."] ?? main;
  return { version, file: path.join(top, file || (entry.default ?? entry)) };
}

export async function load(specifier) {
  const { version, file } = packaged(specifier);
  return { version, library: await import(pathToFileURL(file)) };
}

/** The inputs as a subject of that scalar gets them. */
const inScalar = (scalar, x) => {
  if (typeof x === "number") return scalar === "float" ? Math.fround(x) : x;
  if (Array.isArray(x)) return x.map((part) => inScalar(scalar, part));
  return typeof x === "object" && x !== null ? Object.fromEntries(Object.entries(x).map(([k, part]) => [k, inScalar(scalar, part)])) : x;
};
function isAnswered(ask, inputs) {
  try {
    return !(ask(inputs) instanceof Cannot);
  } catch {
    return false;
  }
}
/** Nanoseconds of a call with the making of its shapes: the median of 15 rounds over the cases that the function answers. */
function timeOf(ask, cases) {
  const asked = cases.filter((inputs) => isAnswered(ask, inputs)), rounds = [];
  for (let round = -5; round < 15; ++round) {  // the first ones warm up
    const start = process.hrtime.bigint();
    for (const inputs of asked) ask(inputs);
    if (round >= 0) rounds.push(Number(process.hrtime.bigint() - start) / asked.length);
  }
  return asked.length > 0 ? rounds.sort((a, b) => a - b)[7] : null;
}
function writeTimes(scalar, queries, file) {
  const cases = new Map(Object.keys(queries).map((query) => [query, []]));
  for (const line of fs.readFileSync(file, "utf8").split("\n").filter(Boolean)) {
    const { query, inputs } = JSON.parse(line);
    cases.get(query)?.push(inScalar(scalar, inputs));
  }
  const times = [...cases].filter(([, of]) => of.length > 0).map(([query, of]) => [query, timeOf(queries[query].answer ?? queries[query], of)]);
  console.log(JSON.stringify(Object.fromEntries(times)));
}

/** Answers by a table of nearmiss.mjs. */
export function answerBy({ name, queries, ...hello }) {
  if (option("--time")) return writeTimes(hello.scalar, queries, option("--time"));
  const offers = Object.entries(queries).map(([query, offer]) => {
    const { declares: declared, ...others } = typeof offer === "function" ? { answer: offer } : offer;
    return [query, declares && declared ? { ...others, declares: declared } : others];
  });
  answer({ ...hello, name: setting ? `${name}-${setting}` : name, queries: Object.fromEntries(offers) });
}

/** A convention with the sentence of the engine's documentation. */
export const declared = (convention, sentence) => ({ convention, sentence });

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const length = (a) => Math.hypot(...a);
export const scaled = (a, s) => a.map((x) => x * s);
export const unit = (a) => scaled(a, 1 / length(a));
/** A quaternion x, y, z, w of length 1. */
export const turned = (q) => scaled(q, 1 / Math.hypot(...q));

/** The least power of two as a time after which a point is past the ball; 0 without motion. */
export function timeToPass(point, velocity, center, radius) {
  const speed = length(velocity);
  if (!(speed > 0)) return 0;
  const way = radius - dot(minus(point, center), unit(velocity));
  return 2 ** Math.ceil(Math.log2((way > 0 ? way : radius || 1) / speed));
}

/** The same of a ball of that radius and the plane, which it may never meet; 0 without motion. */
export function timeToPlane(point, velocity, { normal, offset }, radius = 0) {
  const n = unit(normal), approach = Math.abs(dot(n, velocity)), speed = length(velocity);
  if (!(speed > 0)) return 0;
  if (!(approach > 0)) return 2 ** Math.ceil(-Math.log2(speed));
  const distance = Math.abs(dot(n, point) + offset / length(normal)) + radius;
  return 2 ** Math.ceil(1 + Math.log2((distance || approach) / approach));
}

/** A contact at that time, with other members of the answer; a miss where the time is beyond the largest float. */
export const impactAt = (time, more) => Math.fround(time) < Infinity && { time, ...more };

/** The ball around a shape of the catalogue: [center, radius]. */
export const around = {
  sphere: ({ center, radius }) => [center, radius],
  box: ({ center, half }) => [center, length(half)],
  triangle: ({ v0, v1, v2 }) => [v0, Math.max(length(minus(v1, v0)), length(minus(v2, v0)))],
  capsule: ({ p0, p1, radius }) => [scaled(plus(p0, p1), 0.5), length(minus(p1, p0)) / 2 + radius],
};

/** The vector from one point to another one; undefined where a float does not hold it exactly. */
export function exactWay(from, to) {
  const way = minus(to, from);
  const isExact = way.every((d, i) => {  // the rounding error of the difference, by Knuth's exact sum
    const part = d - to[i];
    return Math.fround(d) === d && to[i] - (d - part) + (-from[i] - part) === 0;
  });
  return isExact ? way : undefined;
}

/** The rotation that turns the axis `axis` (x, y or z) into the direction of unit length. */
export function turnOf(axis, [x, y, z]) {
  const [q, opposite] = {
    x: [[0, -z, y, 1 + x], [0, 0, 1, 0]],
    y: [[z, 0, -x, 1 + y], [1, 0, 0, 0]],
    z: [[-y, x, 0, 1 + z], [1, 0, 0, 0]],
  }[axis];
  return turned(q[3] > 0 ? q : opposite);
}
