#!/usr/bin/env python3
"""The native predicates, as `natives!` below src/ says them, are the exports of native.pl.

    tools/natives.py [--renew]

Without --renew it only says whether they are. The modes of a predicate are those of the first line
of its comment in src/.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXPORTS = ROOT / "prolog/ev3dev/private/native/native.pl"
NATIVE = re.compile(r'((?:^ *///.*\n)+) *\w+ fn "(\w+)"(?:<[^(]*>)?\(([^)]*)\)', re.M)


def natives(text):
    """The predicates of a file: name, arity, modes."""
    for comment, name, arguments in NATIVE.findall(text):
        modes = re.search(rf"/// {name}\(((?:[^()]|\([^)]*\))*)\)", comment)
        yield name, len(re.findall(r"\w+", arguments)) - 1, re.sub(r"\([^)]*\)", "", modes[1]) if modes else ""


def lines():
    """The exports, file by file."""
    known = set()
    # none.rs has those that a page lacks, without modes
    for path in sorted((ROOT / "src").rglob("*.rs"), key=lambda path: (path.name == "none.rs", path)):
        head = f"            % {path.relative_to(ROOT)}\n"
        for name, arity, modes in natives(path.read_text()):
            if (name, arity) not in known:
                known.add((name, arity))
                line = f"{name}/{arity},"
                line = f"            {line:<27} % {modes}" if modes else f"            {line}"
                yield head + (line if len(line) <= 78 else line[:line.rindex(",", 0, 75)] + ", ..")
                head = ""


def main():
    """The command line."""
    text = EXPORTS.read_text()
    first, rest = text.index("          ["), text.index("          ]).\n")
    *exports, last = lines()
    there = "\n".join(["          [", *exports, re.sub(r"(/\d+),", r"\1 ", last).rstrip(), ""])
    if text[first:rest] == there:
        return None
    if sys.argv[1:] != ["--renew"]:
        return f"{EXPORTS.relative_to(ROOT)}: other exports than natives! of src/: tools/natives.py --renew"
    EXPORTS.write_text(text[:first] + there + text[rest:])
    return None


if __name__ == "__main__":
    sys.exit(main())
