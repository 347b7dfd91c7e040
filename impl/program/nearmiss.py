"""Makes a collision library in Python a subject of Nearmiss: one file without dependencies, to be copied or imported.

    import math
    import nearmiss

    def balls_meet(q):
        return math.dist(q.sphere1.center, q.sphere2.center) <= q.sphere1.radius + q.sphere2.radius

    nearmiss.answer(name="balls", version="1.0", scalar="double", queries={"sphere_sphere_overlap": balls_meet})

    ./nearmiss run --command "python3 balls.py" --subject balls

It speaks the protocol of docs/reference/protocol.md, which has the members of an offer and of the hello.

A function gets the inputs of a case by their names (./nearmiss list --members QUERY): q.sphere.radius is a number,
q.sphere.center a tuple of three, q.box.orientation a tuple of x, y, z, w, and a list, such as q.hull.vertices, a list
of its entries. It returns

    True, False, or None                  yes, no, no; without numbers
    {"time": 0.5, "location": (1, 2, 3)}  yes, with these members of the answer; those that it leaves out are not judged
    {"yes": False, "depth": -0.5}         no, with members; where the query has a yes or no
    Cannot("why")                         no answer to this case, never counted as a miss; it may be raised too

A function that raises anything else ends the program with its traceback: that case counts as broken, with the file, the
line, the query and the message of the exception, and Nearmiss starts the program again for the cases behind it.
"""

import json
import math
import os
import struct
import sys
import traceback
import types

PROTOCOL = 3
_VECTORS = (["x", "y", "z"], ["x", "y", "z", "w"])


class Cannot(Exception):
    """The library has no answer to this case, for this reason."""


def float32(x):
    """The float that is nearest to x; infinity where x is beyond all floats."""
    try:
        return struct.unpack("f", struct.pack("f", x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


def answer(*, name, scalar, queries, version=None, batches="binary", not_offered=None):
    """Answers the cases of Nearmiss until there are no more.

    `queries` has for each query its function, or a dict with the function as "answer" and other members of an offer:
    {"moving_point_sphere": {"answer": ray_meets_ball, "requires": ["moves"]}}. `scalar` is "float" or "double".
    """
    table = {query: offer if isinstance(offer, dict) else {"answer": offer} for query, offer in queries.items()}
    hello = {"nearmiss": PROTOCOL, "name": name, "scalar": scalar, "batches": batches, "names": True,
             "offers": [{"query": query, **{k: v for k, v in offer.items() if k != "answer"}} for query, offer in table.items()]}
    if version is not None:
        hello["version"] = version
    if not_offered is not None:
        hello["not_offered"] = not_offered
    try:
        cases, answers = os.fdopen(3, "rb"), os.fdopen(4, "wb")
    except OSError:
        sys.exit(f"{name}: Nearmiss starts this program: ./nearmiss run --command '...' --subject {name}")
    with cases, answers:
        answers.write(json.dumps(hello).encode() + b"\n")
        answers.flush()
        line = cases.readline()
        if not line:
            return
        asked = [_Query(names, table[names["query"]]["answer"]) for names in json.loads(line)["names"]]
        exchange = _binary_batches if batches == "binary" else _json_batches
        for query, batch in exchange(cases, asked):
            _answer_batch(query, batch, answers)


def _answer_batch(query, batch, answers):
    """Writes the answers to a batch; where a function fails, those to the cases before, and ends the program."""
    written = []
    try:
        for encoded in batch:
            written.append(encoded)
    except Exception as error:  # noqa: BLE001 - of the library under test
        answers.write(b"".join(written))
        answers.flush()
        traceback.print_exc()
        print(_in_one_line(error, query), file=sys.stderr)
        sys.exit(1)
    answers.write(b"".join(written))
    answers.flush()


def _in_one_line(error, query):
    """The exception with the line that raised it, outside of this file, and the query: Nearmiss reports this line."""
    places = [f"{os.path.basename(frame.filename)}, line {frame.lineno}, " for frame in traceback.extract_tb(error.__traceback__)
              if frame.filename != __file__]
    return f"{type(error).__name__}: {places[-1] if places else ''}{query.name}: {' '.join(str(error).split())}"


def _binary_batches(cases, asked):
    """The batches that arrive, each as its query and an iterator over its encoded answers."""
    while head := cases.read(16):
        offer, count, first, numbers = struct.unpack("=4I", head)
        lengths = struct.unpack(f"={count}I", cases.read(4 * count))
        values = struct.unpack(f"={numbers}d", cases.read(8 * numbers))
        yield asked[offer], _binary_answers(asked[offer], first, lengths, values)


def _binary_answers(query, first, lengths, values):
    at = 0
    for number, length in enumerate(lengths, first):
        said = query.answer(values[at:at + length])
        at += length
        if isinstance(said, Cannot):
            why = str(said).encode()[:65535]
            yield struct.pack("=BBHIQ", 1, 0, len(why), number, 0) + why
        else:
            yes, given, numbers = said
            yield query.packed.pack(0, yes, 0, number, given, *numbers)


def _json_batches(cases, asked):
    by_name = {query.name: query for query in asked}
    for line in cases:
        batch = json.loads(line)
        query = by_name[batch["query"]]
        yield query, _json_answers(query, batch["first"], batch["cases"])


def _json_answers(query, first, cases):
    for number, values in enumerate(cases, first):
        said = query.answer(values)
        if isinstance(said, Cannot):
            text = {"case": number, "cannot": str(said)}
        else:
            yes, given, numbers = said
            text = {"case": number, "yes": yes}
            if numbers:
                text["values"] = [_json_number(x) if given >> i & 1 else "none" for i, x in enumerate(numbers)]
        yield json.dumps(text).encode() + b"\n"


def _json_number(x):
    return x if math.isfinite(x) else "nan" if math.isnan(x) else "inf" if x > 0 else "-inf"


class _Query:
    """A query with the function that answers it."""

    def __init__(self, names, function):
        self.name, self.decides, self.function = names["query"], names["decides"], function
        self.read = _reader(_tree(names["inputs"]), self.name)
        self.outputs, self.count = _tree(names["outputs"]), len(names["outputs"])
        self.packed = struct.Struct(f"=BBHIQ{self.count}d")

    def answer(self, values):
        """Yes, the bits of the numbers that the answer has, and all numbers; or Cannot."""
        try:
            said = self.function(self.read(iter(values)))
        except Cannot as why:
            said = why
        if isinstance(said, Cannot):
            return said
        numbers = [0.0] * self.count
        if not isinstance(said, dict):
            if said is not None and said not in (True, False):
                raise TypeError(f"its function returns True, False, None, a dict or a Cannot, and returned {said!r}")
            if not self.decides:
                raise TypeError(f"its function returns a dict of {', '.join(self.outputs)}, and returned {said!r}")
            return bool(said), 0, numbers
        members = {k: v for k, v in said.items() if k != "yes"}
        return bool(said.get("yes", True)), _fill("answer", self.outputs, members, numbers), numbers


# The names of numbers form a tree: a number is its index, a list of inputs a _List, anything else a dict.


class _List:
    """A list among the inputs, with the tree of an entry."""

    def __init__(self, entry):
        self.entry = _tree(entry) if entry != [""] else 0


def _tree(names):
    """{"sphere": {"center": {"x": 0, ...}, "radius": 3}} of ["sphere.center.x", ..., "sphere.radius"]."""
    root = {}
    for index, name in enumerate(names):
        is_list = isinstance(name, dict)
        *path, last = (name["list"] if is_list else name).split(".")
        node = root
        for part in path:
            node = node.setdefault(part, {})
        node[last] = _List(name["entry"]) if is_list else index
    return root


class _Inputs(types.SimpleNamespace):
    """Inputs by their names; `_of` is what has them."""

    _of = ""

    def __getattr__(self, name):
        raise AttributeError(f"'{name}' is no input of {self._of}: it has {', '.join(vars(self))}")


def _reader(tree, where):
    """A function that takes the numbers of `tree` from an iterator, in their order. Messages call the inputs `where`."""
    if isinstance(tree, _List):
        entry = _reader(tree.entry, where)
        return lambda numbers: [entry(numbers) for _ in range(int(next(numbers)))]
    if not isinstance(tree, dict):
        return next
    parts = [(name, _reader(part, f"{where}.{name}")) for name, part in tree.items()]
    if list(tree) == _VECTORS[0]:
        return lambda numbers: (next(numbers), next(numbers), next(numbers))
    if list(tree) == _VECTORS[1]:
        return lambda numbers: (next(numbers), next(numbers), next(numbers), next(numbers))
    inputs = type("_Inputs", (_Inputs,), {"_of": where})
    return lambda numbers: inputs(**{name: read(numbers) for name, read in parts})


def _fill(where, tree, said, numbers):
    """Puts what an answer says into the numbers; returns the bits of these numbers."""
    if said is None:
        return 0
    if not isinstance(tree, dict):
        numbers[tree] = float(said)
        return 1 << tree
    if not isinstance(said, dict):
        if len(said) != len(tree):
            raise ValueError(f"{where}: it has {len(tree)} numbers ({', '.join(tree)}), and the answer has {len(said)}")
        said = dict(zip(tree, said))
    given = 0
    for name, value in said.items():
        if name not in tree:
            raise ValueError(f"{where}: it has no '{name}'; it has {', '.join(tree) or 'no numbers'}")
        given |= _fill(f"{where}.{name}", tree[name], value, numbers)
    return given
