#!/usr/bin/env python3
"""What the generators of pages share; and a program that compares a generated page with what its generator would write now,
without the measured figures.

The frame of a page is its headings, its prose, the headers of its tables, and in each row the cells that name something.
Every number in prose counts as a figure.

  docs/measured/page_frame.py [--mask REGEX] ... PAGE COMMAND [ARGUMENT ...]

compares PAGE with what COMMAND prints. It prints one line per difference, and ends with exit code 1 if there is one. Text
that matches a mask counts as a figure.
"""

import argparse
import difflib
import pathlib
import re
import subprocess
import sys

def catalogue():
    """The names of all queries, in the catalogue's order."""
    folder = pathlib.Path(__file__).resolve().parents[2] / "impl" / "catalogue"
    queries = re.findall(r"^NEARMISS_QUERY\((\w+)\)", (folder / "catalogue.def").read_text(), re.MULTILINE)
    grid = re.findall(r"^NEARMISS_([A-Z_]+)\(([a-z]+), ([a-z]+)\)", (folder / "grid.def").read_text(), re.MULTILINE)
    names = {"CAST": "moving_{}_{}"}
    return queries + [names.get(operation, "{}_{}_" + operation.lower()).format(first, second)
                      for operation, first, second in grid]


# The headers of the columns that name something. All other columns have figures.
NAMES = {"query", "subject", "library", "program", "batches", "part", "scalar", "class", "configuration", "stored case",
         "the bug and its fix"}
NUMBER = re.compile(r"[+-]?\d+(?:[.,]\d+)*(?:e[+-]?\d+)?")
# The line about the machine: it begins with the date of the measurement.
MACHINE = r"^\d{4}-\d\d-\d\d; .*$"


def cells_of(line):
    return [cell.strip() for cell in line.strip().removeprefix("|").removesuffix("|").split("|")]


def frame(text, masks=()):
    """[(number of the line, its text without figures)], without empty lines."""
    found, header = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith("|"):
            header = None
            for mask in (MACHINE, *masks):
                line = re.sub(mask, "#", line)
            line = NUMBER.sub("#", line)
            if line.strip():
                found.append((number, line))
        elif header is None:
            header = cells_of(line)
            found.append((number, line))
        elif set(line) <= set("|-:"):
            continue
        else:
            cells = cells_of(line)
            shown = [cell if name in NAMES else "#" for name, cell in zip(header, cells)] + cells[len(header):]
            found.append((number, "| " + " | ".join(shown) + " |"))
    return found


def differences(page, expected, masks=()):
    """["LINE: what differs"] between the texts of two pages."""
    ours, theirs = frame(page, masks), frame(expected, masks)
    matcher = difflib.SequenceMatcher(None, [text for _, text in ours], [text for _, text in theirs], autojunk=False)
    lines = []
    for kind, begin, end, begin_expected, end_expected in matcher.get_opcodes():
        if kind == "equal":
            continue
        at = ours[min(begin, len(ours) - 1)][0] if ours else 1
        lines += [f"{number}: the generator does not write: {text}" for number, text in ours[begin:end]]
        lines += [f"{at}: the generator also writes: {text}" for _, text in theirs[begin_expected:end_expected]]
    return lines


def check(path, expected, masks=(), text=None):
    """Prints the differences between a stored page, or `text` in place of it, and the expected text. Returns the exit code."""
    lines = differences(path.read_text() if text is None else text, expected, masks)
    for line in lines:
        print(f"{path}:{line}")
    return 1 if lines else 0


def options_of(description, build=None):
    """The parser of a generator, with --check and, where it has a default, --build."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    if build:
        parser.add_argument("--build", type=pathlib.Path, default=build)
    parser.add_argument("--check", action="store_true")
    return parser


def write_or_check(path, text, generator, check):
    """Writes a page without figures, or prints how the stored one differs from it. Returns the exit code."""
    if not check:
        path.write_text(text)
        return 0
    ours = path.read_text().splitlines() if path.exists() else []
    lines = list(difflib.unified_diff(ours, text.splitlines(), path.name, generator, "", "", 0, ""))
    print("\n".join(lines), end="\n" if lines else "")
    return 1 if lines else 0


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--mask", action="append", default=[])
    arguments.add_argument("page", type=pathlib.Path)
    arguments.add_argument("command", nargs=argparse.REMAINDER)
    given = arguments.parse_args()
    ended = subprocess.run(given.command, capture_output=True, text=True)
    if not ended.stdout:
        sys.exit(f"page_frame: {given.command[0]} prints nothing and ends with exit code {ended.returncode}: {ended.stderr}")
    sys.exit(check(given.page, ended.stdout, given.mask))


if __name__ == "__main__":
    main()
