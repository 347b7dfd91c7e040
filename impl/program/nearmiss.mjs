// Makes a collision library in JavaScript a subject of Nearmiss: one file without dependencies, to be copied or imported.
//
//     import { answer } from "./nearmiss.mjs";
//
//     const ballsMeet = ({ sphere1, sphere2 }) =>
//       Math.hypot(...sphere1.center.map((x, i) => x - sphere2.center[i])) <= sphere1.radius + sphere2.radius;
//
//     answer({ name: "balls", version: "1.0", scalar: "double", queries: { sphere_sphere_overlap: ballsMeet } });
//
//     ./nearmiss run --command "node balls.mjs" --subject balls
//
// It speaks the protocol of docs/reference/protocol.md, which has the members of an offer and of the hello.
//
// A function gets the inputs of a case by their names (./nearmiss list --members QUERY): q.sphere.radius is a number,
// q.sphere.center an array of three, q.box.orientation an array of x, y, z, w, and a list, such as q.hull.vertices, an
// array of its entries. It returns, without a promise,
//
//     true, false, or null                   yes, no, no; without numbers
//     { time: 0.5, location: [1, 2, 3] }     yes, with these members of the answer; those that it leaves out are not judged
//     { yes: false, depth: -0.5 }            no, with members; where the query has a yes or no
//     new Cannot("why")                      no answer to this case, never counted as a miss; it may be thrown too
//
// A function that throws anything else, such as the trap of a library in WebAssembly, ends the program with the error:
// that case counts as broken, with the file, the line, the query and the message of the error, and Nearmiss starts the
// program again for the cases behind it.
import fs from "node:fs";

const PROTOCOL = 3;
const MOST_OF_A_REASON = 65535;
const littleEndian = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

/** The library has no answer to this case, for this reason. */
export class Cannot {
  constructor(why) {
    this.why = String(why);
  }
}

/**
 * Answers the cases of Nearmiss until there are no more. `queries` has for each query its function, or an object with the
 * function as `answer` and other members of an offer: { moving_point_sphere: { answer: rayMeetsBall, requires: ["moves"] } }.
 * `scalar` is "float" or "double". Math.fround gives the float that is nearest to a number.
 */
export function answer({ name, version, scalar, queries, batches = "binary", not_offered }) {
  const table = new Map(Object.entries(queries).map(([query, offer]) => [query, typeof offer === "function" ? { answer: offer } : offer]));
  const offers = [...table].map(([query, offer]) => ({ query, ...offer, answer: undefined }));
  const hello = { nearmiss: PROTOCOL, name, version, scalar, batches, names: true, offers, not_offered };
  const pipes = openPipes(name, Buffer.from(JSON.stringify(hello) + "\n"));
  const line = pipes.readLine();
  if (line === null) return;
  const asked = JSON.parse(line).names.map((names) => new Query(names, table.get(names.query).answer));
  const next = batches === "binary" ? () => binaryBatch(pipes, asked) : () => jsonBatch(pipes, asked);
  for (let batch = next(); batch !== null; batch = next()) {
    const written = [];
    try {
      for (const encoded of batch.answers) written.push(encoded);
    } catch (error) {
      pipes.write(Buffer.concat(written));
      if (error instanceof Error) console.error(error);
      console.error(inOneLine(error, batch.query));
      process.exit(1);
    }
    pipes.write(Buffer.concat(written));
  }
}

/** The error with the line that threw it, outside of this file, and the query: Nearmiss reports this line. */
function inOneLine(error, query) {
  if (!(error instanceof Error)) return `${query.name}: threw ${JSON.stringify(error) ?? String(error)}`;
  const frames = String(error.stack).split("\n").filter((line) => /^ +at /.test(line));
  const own = frames.findIndex((frame) => frame.includes(import.meta.url));
  const [, file, line] = frames.slice(0, Math.max(own, 0)).map((frame) => /([^/\\(\s]+):(\d+):\d+\)?$/.exec(frame)).find((found) => found && !found.input.includes("node:")) ?? [];
  const place = file ? `${file}, line ${line}, ` : "";
  const message = error.message.split(/\s+/).join(" ");
  const told = error instanceof TypeError && query.missing !== "" ? `${query.missing} (${message})` : message;  // the end of a long line is cut
  return `${error.name}: ${place}${query.name}: ${told}`;
}

/** Files 3 and 4, the latter with the hello. Nothing else happens while the program waits for cases. */
function openPipes(name, hello) {
  let buffer = Buffer.alloc(0);
  const some = Buffer.alloc(1 << 16);
  const read = () => {
    const got = fs.readSync(3, some);
    buffer = Buffer.concat([buffer, some.subarray(0, got)]);
    return got > 0;
  };
  const taken = (size) => {
    const bytes = buffer.subarray(0, size);
    buffer = buffer.subarray(size);
    return bytes;
  };
  const write = (bytes) => {
    for (let at = 0; at < bytes.length;) at += fs.writeSync(4, bytes, at);
  };
  try {
    if (!fs.fstatSync(3).isFIFO()) throw new Error("no pipe");
    write(hello);
  } catch {  // without pipes these files may be of Node itself
    console.error(`${name}: Nearmiss starts this program: ./nearmiss run --command '...' --subject ${name}`);
    process.exit(1);
  }
  return {
    write,
    /** So many bytes; null at the end of the file. */
    read(size) {
      while (buffer.length < size) if (!read()) return null;
      return taken(size);
    },
    readLine() {
      let end = buffer.indexOf(10);
      while (end < 0) {
        if (!read()) return null;
        end = buffer.indexOf(10);
      }
      return taken(end + 1).toString();
    },
  };
}

/** The query of the next batch and the encoded answers, made one by one; null where there is none. */
function binaryBatch(pipes, asked) {
  const head = pipes.read(16);
  if (head === null) return null;
  const [offer, count, first, numbers] = words(head);
  const lengths = words(pipes.read(4 * count));
  const bytes = pipes.read(8 * numbers);
  const values = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  return { query: asked[offer], answers: binaryAnswers(asked[offer], first, lengths, values) };
}
const words = (bytes) => new Uint32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));

function* binaryAnswers(query, first, lengths, values) {
  let at = 0;
  for (let i = 0; i < lengths.length; ++i) {
    const said = query.answer(values.subarray(at, (at += lengths[i])));
    const why = said instanceof Cannot ? Buffer.from(said.why).subarray(0, MOST_OF_A_REASON) : null;
    const reply = new ArrayBuffer(16 + (why ? 0 : 8 * query.count)), view = new DataView(reply);
    view.setUint8(0, why ? 1 : 0);
    view.setUint32(4, first + i, littleEndian);
    if (why) {
      view.setUint16(2, why.length, littleEndian);
      yield Buffer.concat([Buffer.from(reply), why]);
    } else {
      view.setUint8(1, said.yes ? 1 : 0);
      view.setBigUint64(8, said.given, littleEndian);
      new Float64Array(reply, 16).set(said.numbers);
      yield Buffer.from(reply);
    }
  }
}

function jsonBatch(pipes, asked) {
  const line = pipes.readLine();
  if (line === null) return null;
  const { query: name, first, cases } = JSON.parse(line), query = asked.find((one) => one.name === name);
  return { query, answers: jsonAnswers(query, first, cases) };
}

function* jsonAnswers(query, first, cases) {
  for (let i = 0; i < cases.length; ++i) {
    const said = query.answer(cases[i]);
    const text = said instanceof Cannot ? { case: first + i, cannot: said.why } : { case: first + i, yes: said.yes };
    if (!(said instanceof Cannot) && query.count > 0) text.values = said.numbers.map((x, k) => (said.given >> BigInt(k) & 1n ? jsonNumber(x) : "none"));
    yield Buffer.from(JSON.stringify(text) + "\n");
  }
}
const jsonNumber = (x) => (Number.isFinite(x) ? x : Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf");

/** A query with the function that answers it. */
class Query {
  constructor({ query, decides, inputs, outputs }, ask) {
    this.name = query, this.decides = decides, this.ask = ask;
    this.missing = "";  // what its function last asked that is no input, for messages
    this.read = reader(treeOf(inputs), this.name, (text) => { this.missing = text; });
    this.outputs = treeOf(outputs), this.count = outputs.length;
  }
  /** { yes, given, numbers }: `given` has the bits of the numbers that the answer has; or a Cannot. */
  answer(values) {
    let said;
    this.missing = "";
    try {
      said = this.ask(this.read({ values, at: 0 }));
    } catch (why) {
      if (!(why instanceof Cannot)) throw why;
      said = why;
    }
    if (said instanceof Cannot) return said;
    const numbers = Array(this.count).fill(0);
    if (said === true || said === false || said === null) {
      if (!this.decides) throw new TypeError(`its function returns an object of ${[...this.outputs.keys()].join(", ")}, and returned ${said}`);
      return { yes: said === true, given: 0n, numbers };
    }
    if (typeof said !== "object" || said instanceof Promise) {
      const what = said instanceof Promise ? "a promise" : String(said);
      throw new TypeError(`its function returns true, false, null, an object or a Cannot, and returned ${what}`);
    }
    const { yes = true, ...members } = said;
    return { yes, given: fill("answer", this.outputs, members, numbers), numbers };
  }
}

// The names of numbers form a tree: a number is its index, a list of inputs a List, anything else a Map.

class List {
  constructor(entry) {
    this.entry = entry.length === 1 && entry[0] === "" ? 0 : treeOf(entry);
  }
}

function treeOf(names) {
  const root = new Map();
  names.forEach((name, index) => {
    const path = (name.list ?? name).split("."), last = path.pop();
    let node = root;
    for (const part of path) {
      if (!node.has(part)) node.set(part, new Map());
      node = node.get(part);
    }
    node.set(last, name.list === undefined ? index : new List(name.entry));
  });
  return root;
}

/** What inputs inherit: it has nothing but what every object has, and tells `miss` of any other name that is read. */
function without(where, names, miss) {
  const get = (of, name) => {
    if (typeof name === "string" && !(name in of)) miss(`'${name}' is no input of ${where}: it has ${names.join(", ")}`);
    return Reflect.get(of, name);
  };
  return new Proxy(Object.create(Object.prototype), { get });
}

/** A function that takes the numbers of `tree` from { values, at }, in their order. `where` and `miss`: see without(). */
function reader(tree, where, miss) {
  if (tree instanceof List) {
    const entry = reader(tree.entry, where, miss);
    return (from) => Array.from({ length: from.values[from.at++] }, () => entry(from));
  }
  if (!(tree instanceof Map)) return (from) => from.values[from.at++];
  const names = [...tree.keys()].join();
  const parts = [...tree].map(([name, part]) => [name, reader(part, `${where}.${name}`, miss)]);
  if (names === "x,y,z" || names === "x,y,z,w") return (from) => parts.map(([, read]) => read(from));
  const inherited = without(where, [...tree.keys()], miss);
  return (from) => {
    const object = {};
    for (const [name, read] of parts) object[name] = read(from);
    return { __proto__: inherited, ...object };  // an assignment would ask the proxy for a setter, which takes long
  };
}

/** Puts what an answer says into the numbers; returns the bits of these numbers. */
function fill(where, tree, said, numbers) {
  if (said === null || said === undefined) return 0n;
  if (!(tree instanceof Map)) {
    if (typeof said !== "number" && typeof said !== "boolean") throw new TypeError(`${where}: it is a number, and the answer has ${typeof said === "object" ? JSON.stringify(said) : String(said)}`);
    numbers[tree] = Number(said);
    return 1n << BigInt(tree);
  }
  const names = [...tree.keys()];
  const isList = Array.isArray(said) || ArrayBuffer.isView(said);
  if (isList && said.length !== names.length) throw new RangeError(`${where}: it has ${names.length} numbers (${names.join(", ")}), and the answer has ${said.length}`);
  let given = 0n;
  for (const [name, value] of isList ? names.map((n, i) => [n, said[i]]) : Object.entries(said)) {
    if (!tree.has(name)) throw new RangeError(`${where}: it has no '${name}'; it has ${names.join(", ") || "no numbers"}`);
    given |= fill(`${where}.${name}`, tree.get(name), value, numbers);
  }
  return given;
}
