#!/usr/bin/env python3
"""The papers that show where things are, ARCHITECTURE.md and CONTRIBUTING.md, are true.

    tools/papers.py [--self-test]

Of what stands in back quotes there

    a path, also the end of one (`motor/plan.rs`), is that of a file or a folder,
    the target of a `make` is one,
    a name, also one of a goal or of a path as `Device::number`, is in the code. In a step of a
    walk, a numbered item of ARCHITECTURE.md, it is in one of the files that the step names.

What has a `<` is for the reader to fill in.
"""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAPERS = ("ARCHITECTURE.md", "CONTRIBUTING.md")
CODE = re.compile(r"\.(?:pl|rs|js|mjs|py|sh|toml|c|h|css|html|txt)$|(?:^|/)Makefile$")
PATH = re.compile(r"[\w.@*-]+(?:/[\w.@*-]+)*/?")
# Not written by hand
MADE = {".git", ".toolchain", "target", "lib", "dist", "doc", "compiled", "node_modules", "__pycache__"}
# Beginnings of names, a name for any, and what is made
OTHERS = re.compile(r"\w+_|p|(?:" + "|".join(MADE) + r")/")


class House:
    """All files, and what they say."""

    def __init__(self, files):
        self.files = files
        self.paths = set(files) | {str(up) for path in files for up in Path(path).parents}
        self.words = {}

    def found(self, name):
        """The paths with this end."""
        name = name.rstrip("/")
        pattern = re.compile(r"(?:^|.*/)" + re.escape(name).replace(r"\*", "[^/]*") + "$")
        return [path for path in self.paths if pattern.match(path)]

    def words_of(self, path):
        """The words of a file."""
        if path not in self.words:
            self.words[path] = set(re.findall(r"\w+", self.files[path]))
        return self.words[path]

    def anywhere(self):
        """The code."""
        return [path for path in self.files if CODE.search(path)]


def items(text):
    """The items of lists and the paragraphs, each with its first line."""
    text = re.sub(r"^```.*?^```", lambda block: "\n" * block[0].count("\n"), text, flags=re.M | re.S)
    item, first = [], 1
    for number, line in enumerate([*text.split("\n"), ""], 1):
        if not line.strip() or re.match(r"(?:\d+\.|- |\||#)", line):
            if item:
                yield first, "\n".join(item)
            item, first = [], number
        item.append(line)


def is_path(word):
    """Does it look like one?"""
    return bool(PATH.fullmatch(word)) and not re.search(r"/(?:\d+|[MN])$", word) and bool(
        CODE.search(word) or word.endswith((".md", "/")) or re.match(r"[a-z.]+/[\w./*-]+$", word))


def names(quoted):
    """The names in it: of `a::b`, `a/2`, `a(B, c)`, `a`."""
    if found := re.fullmatch(r"(\w+(?:::\w+)*)(?:/\w+|\(.*\))?!?", quoted):
        return [name for name in found[1].split("::") if not OTHERS.fullmatch(name)]
    return []


def wrong(text, house, make, walks=True):
    """What is not there: (line, text)."""
    for first, item in items(text):
        quotes = [(first + item.count("\n", 0, found.start()), " ".join(found[1].split()))
                  for found in re.finditer(r"`([^`]+)`", item) if "<" not in found[1]]
        files = []
        for line, quoted in quotes:
            for word in quoted.split():
                if is_path(word) and not OTHERS.fullmatch(word):
                    found = house.found(word)
                    files += found
                    if not found:
                        yield line, word
            for target in re.findall(r"\bmake ([\w-]+)", quoted):
                if target not in make:
                    yield line, f"make {target}"
        code = [path for path in files if path in house.files and CODE.search(path)]
        if not (walks and code and re.match(r"\d", item)):
            code = house.anywhere()
        for line, quoted in quotes:
            for name in [] if is_path(quoted) else names(quoted):
                if not any(name in house.words_of(path) for path in code):
                    yield line, quoted


def self_test():
    """A file, a name and a target that are not there are found, and nothing else."""
    house = House({"src/a.rs": "fn here() {}", "src/b.rs": "fn there() {}", "Makefile": "check:"})
    text = ("1. `a.rs`: `here`, `A::here`, `there/2`\n- `src/c.rs`\n"
            "- `make check`, `make chek` and `there(X)`\n- `gone`, `<any>.rs`\n```\n`c.rs`\n```\n")
    found = list(wrong(text, house, {"check"}))
    expected = [(1, "A::here"), (1, "there/2"), (2, "src/c.rs"), (3, "make chek"), (4, "gone")]
    if sorted(found) != expected:
        sys.exit(f"papers.py: found {found}, not {expected}")


def main():
    """The command line."""
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    listed = []
    for folder, inner, names_there in os.walk(ROOT):
        inner[:] = [name for name in inner if name not in MADE]
        listed += [os.path.relpath(os.path.join(folder, name), ROOT) for name in names_there]
    files = {path: (ROOT / path).read_text(errors="replace") if CODE.search(path) else ""
             for path in listed}
    make = set(re.findall(r"^([\w-]+):", files["Makefile"], flags=re.M))
    house = House(files)
    found = [f"{paper}:{line}: there is no {what}" for paper in PAPERS
             for line, what in wrong((ROOT / paper).read_text(), house, make, walks=paper == "ARCHITECTURE.md")]
    return "\n".join(found) or None


if __name__ == "__main__":
    sys.exit(main())
