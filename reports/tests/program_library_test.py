#!/usr/bin/env python3
"""Drives programs that use impl/program/nearmiss.py and nearmiss.mjs over their two pipes, as Nearmiss does.

  reports/tests/program_library_test.py [NODE]   without NODE only the library for Python is tested
"""
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "impl" / "program"

# Each program answers by its inputs, with the same table in both languages.
PYTHON = """
import sys
sys.path.insert(0, LIBRARY)
import nearmiss

def move(q):
    if q.kind == 1: return True
    if q.kind == 2: return False
    if q.kind == 3: return {"time": q.sphere.radius, "location": q.sphere.center, "turned": q.orientation, "corners": [{"point": (7, 8)}, None]}
    if q.kind == 4: return {"yes": False, "time": float("-inf"), "location": (float("nan"), float("inf"), None)}
    if q.kind == 5: return nearmiss.Cannot("it is solid \\u00fc")
    if q.kind == 6: raise nearmiss.Cannot("it is thin")
    if q.kind == 7: return {"tim": 1}
    if q.kind == 8: return {"location": (1, 2)}
    if q.kind == 9: return "yes"
    if q.kind == 10: raise RuntimeError("its own")
    if q.kind == 11: return q.other.center
    if q.kind == 12: return q.sphere.middle[0]
    return None

def total(q):
    return {"sum": q.before + sum(sum(v) for v in q.cloud.vertices) + sum(q.cloud.weights) + q.cloud.radius}

nearmiss.answer(name="table", version="2", scalar="float", batches=BATCHES, not_offered={"other": "why"},
                queries={"move": {"answer": move, "requires": ["moves"]}, "total": total})
"""
JAVASCRIPT = """
import { answer, Cannot } from LIBRARY;

function move(q) {
  switch (q.kind) {
    case 1: return true;
    case 2: return false;
    case 3: return { time: q.sphere.radius, location: q.sphere.center, turned: q.orientation, corners: [{ point: [7, 8] }, null] };
    case 4: return { yes: false, time: -Infinity, location: [NaN, Infinity, null] };
    case 5: return new Cannot("it is solid \\u00fc");
    case 6: throw new Cannot("it is thin");
    case 7: return { tim: 1 };
    case 8: return { location: [1, 2] };
    case 9: return "yes";
    case 10: throw new Error("its own");
    case 11: return q.other.center;
    case 12: return q.sphere.middle[0];
    default: return null;
  }
}
const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
const total = ({ before, cloud }) => ({ sum: before + sum(cloud.vertices.map(sum)) + sum(cloud.weights) + cloud.radius });

answer({ name: "table", version: "2", scalar: "float", batches: BATCHES, not_offered: { other: "why" },
  queries: { move: { answer: move, requires: ["moves"] }, total } });
"""
MOVE = {"query": "move", "decides": True,
        "inputs": ["kind", "sphere.center.x", "sphere.center.y", "sphere.center.z", "sphere.radius",
                   "orientation.x", "orientation.y", "orientation.z", "orientation.w"],
        "outputs": ["time", "location.x", "location.y", "location.z", "turned.x", "turned.y", "turned.z", "turned.w",
                    "corners.0.behind", "corners.0.point.x", "corners.0.point.y", "corners.1.behind", "corners.1.point.x", "corners.1.point.y"]}
TOTAL = {"query": "total", "decides": False,
         "inputs": ["before", {"list": "cloud.vertices", "entry": ["x", "y", "z"]}, {"list": "cloud.weights", "entry": [""]}, "cloud.radius"],
         "outputs": ["sum"]}
HELLO = {"nearmiss": 3, "name": "table", "version": "2", "scalar": "float", "names": True, "not_offered": {"other": "why"},
         "offers": [{"query": "move", "requires": ["moves"]}, {"query": "total"}]}
OTHERS = [0.1, 2.5, -3, 4, 0.5, 0.25, 0, 1]  # the numbers of a move behind its kind
NONE = "none"


def move(kind):
    return [kind, *OTHERS]


class Program:
    """A program between two pipes."""

    def __init__(self, words):
        to_program, self.to = os.pipe()
        self.back, from_program = os.pipe()
        # bash renames the files: they may have the numbers of others here.
        command = ["bash", "-c", f'exec 3<&{to_program} 4>&{from_program} && exec "$@"', "bash", *words]
        self.process = subprocess.Popen(command, pass_fds=(to_program, from_program), stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
        os.close(to_program), os.close(from_program)
        self.answers = os.fdopen(self.back, "rb")
        self.hello = json.loads(self.answers.readline())

    def send(self, data):
        os.write(self.to, data)

    def close(self):
        """Ends the pipe to the program: its exit code, what it still said, and its messages."""
        os.close(self.to)
        rest, messages = self.answers.read(), self.process.stderr.read().decode()
        self.answers.close(), self.process.stderr.close()
        return self.process.wait(), rest, messages


def binary_batch(offer, first, cases):
    numbers = [x for case in cases for x in case]
    return struct.pack(f"=4I{len(cases)}I{len(numbers)}d", offer, len(cases), first, len(numbers), *map(len, cases), *numbers)


def binary_answer(read, outputs):
    """(case, yes, values), with NONE for numbers that are not part of it, or (case, reason)."""
    status, yes, size, case, given = struct.unpack("=BBHIQ", read(16))
    if status == 1:
        return case, read(size).decode()
    values = struct.unpack(f"={outputs}d", read(8 * outputs))
    return case, bool(yes), [x if given >> i & 1 else NONE for i, x in enumerate(values)]


def json_batch(query, first, cases):
    return (json.dumps({"query": query, "first": first, "cases": cases}) + "\n").encode()


def json_answer(line, outputs):
    said = json.loads(line)
    if "cannot" in said:
        return said["case"], said["cannot"]
    words = {"nan": math.nan, "inf": math.inf, "-inf": -math.inf}
    return said["case"], said["yes"], [words.get(x, x) for x in said["values"]]


class Tests:
    """The tests of one library; subclasses say how its program is started."""

    batches = "binary"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / self.name
        library = LIBRARY if self.name.endswith(".py") else LIBRARY / "nearmiss.mjs"
        self.file.write_text(self.text.replace("LIBRARY", json.dumps(str(library))).replace("BATCHES", json.dumps(self.batches)))

    def start(self):
        program = Program([self.interpreter, self.file])
        program.send(json.dumps({"names": [MOVE, TOTAL]}).encode() + b"\n")
        return program

    def ask(self, program, offer, first, cases):
        query = (MOVE, TOTAL)[offer]
        outputs = len(query["outputs"])
        if self.batches == "json":
            program.send(json_batch(query["query"], first, cases))
            return [json_answer(program.answers.readline(), outputs) for _ in cases]
        program.send(binary_batch(offer, first, cases))
        return [binary_answer(program.answers.read, outputs) for _ in cases]

    def test_hello(self):
        program = self.start()
        self.assertEqual(program.hello, {**HELLO, "batches": self.batches})
        self.assertEqual(program.close(), (0, b"", ""))

    def test_answers(self):
        program = self.start()
        nothing = [NONE] * 14
        expected = [(0, False, nothing), (1, True, nothing), (2, False, nothing),
                    (3, True, [4, 0.1, 2.5, -3, 0.5, 0.25, 0, 1, NONE, 7, 8, NONE, NONE, NONE])]
        self.assertEqual(self.ask(program, 0, 0, [move(kind) for kind in range(4)]), expected)
        [(case, yes, values)] = self.ask(program, 0, 4, [move(4)])
        self.assertEqual((case, yes, values[0], values[2], values[3]), (4, False, -math.inf, math.inf, NONE))
        self.assertTrue(math.isnan(values[1]))
        self.assertEqual(self.ask(program, 0, 5, [move(5), move(6)]), [(5, "it is solid ü"), (6, "it is thin")])
        self.assertEqual(program.close(), (0, b"", ""))

    def test_lists(self):
        program = self.start()
        cases = [[1, 2, 1, 2, 3, 4, 5, 6, 1, 100, 1000], [1, 0, 3, 1, 2, 4, 0.5]]
        self.assertEqual(self.ask(program, 1, 0, cases), [(0, True, [1122]), (1, True, [8.5])])
        self.assertEqual(program.close(), (0, b"", ""))

    def test_many_cases(self):
        program = self.start()
        for batch in range(3):
            cases = [move(1)] * 2048
            said = self.ask(program, 0, 2048 * batch, cases)
            self.assertEqual([case for case, *_ in said], list(range(2048 * batch, 2048 * batch + 2048)))
        program.close()

    def test_failures(self):
        """A function that fails costs its own case alone: the answers to the cases before it are written."""
        for kind, words in ((7, "it has no 'tim'; it has time, location, turned, corners"), (8, "it has 3 numbers (x, y, z), and the answer has 2"),
                            (9, "yes"), (10, "its own"), (11, "'other' is no input of move: it has kind, sphere, orientation"),
                            (12, "'middle' is no input of move.sphere: it has center, radius")):
            program = self.start()
            if self.batches == "json":
                program.send(json_batch("move", 0, [move(1), move(kind), move(1)]))
                read = program.answers.readline()
                self.assertEqual(json_answer(read, 14)[:2], (0, True))
            else:
                program.send(binary_batch(0, 0, [move(1), move(kind), move(1)]))
                self.assertEqual(binary_answer(program.answers.read, 14)[:2], (0, True))
            code, rest, messages = program.close()
            self.assertEqual((code, rest), (1, b""), messages)
            last = messages.splitlines()[-1]
            self.assertIn(words, last)
            self.assertRegex(last, r"^\w*Error: " + (self.place(kind) if kind >= 10 else "") + "move: ")

    def place(self, kind):
        """Where the program fails for a move of this kind, as a message begins."""
        lines = self.file.read_text().splitlines()
        [line] = [number for number, text in enumerate(lines, 1) if f"q.kind == {kind}:" in text or f"case {kind}:" in text]
        return f"{self.file.name}, line {line}, "

    def test_default(self):
        """A function that serves several queries may ask for an input that some of them lack."""
        self.file.write_text(self.file.read_text().replace(*self.asks_for_more))
        program = self.start()
        self.assertEqual(self.ask(program, 0, 0, [move(1)])[0][1], True)
        program.close()

    def test_no_decision(self):
        self.file.write_text(self.file.read_text().replace(*self.total_says_yes))
        program = self.start()
        program.send(json_batch("total", 0, [[1, 0, 0, 1]]) if self.batches == "json" else binary_batch(1, 0, [[1, 0, 0, 1]]))
        code, rest, messages = program.close()
        self.assertEqual((code, rest), (1, b""))
        self.assertIn("total: its function returns", messages)
        self.assertIn("sum", messages)

    def test_alone(self):
        done = subprocess.run([self.interpreter, self.file], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "table: Nearmiss starts this program: ./nearmiss run --command '...' --subject table\n")


class Python(Tests, unittest.TestCase):
    interpreter, name, text = sys.executable, "table.py", PYTHON
    total_says_yes = ('return {"sum"', 'return True or {"sum"')
    asks_for_more = ("if q.kind == 1: return True", "if q.kind == 1: return getattr(q, 'velocity', 7) == 7")

    def test_float32(self):
        sys.path.insert(0, str(LIBRARY))
        sys.dont_write_bytecode = True
        import nearmiss
        self.assertEqual(nearmiss.float32(0.1), 0.10000000149011612)
        self.assertEqual(nearmiss.float32(-1e300), -math.inf)
        self.assertTrue(math.isnan(nearmiss.float32(math.nan)))


class PythonInJson(Python):
    batches = "json"


class JavaScript(Tests, unittest.TestCase):
    interpreter, name, text = sys.argv[1] if len(sys.argv) > 1 else None, "table.mjs", JAVASCRIPT
    total_says_yes = ("=> ({ sum", "=> true || ({ sum")
    asks_for_more = ("case 1: return true", "case 1: return (q.velocity ?? 7) === 7 && String(q) === '[object Object]'")

    def setUp(self):
        if self.interpreter is None:
            self.skipTest("no node")
        super().setUp()


class JavaScriptInJson(JavaScript):
    batches = "json"


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
