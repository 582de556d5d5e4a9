#!/usr/bin/env python3
"""The papers that show where things are are true: ARCHITECTURE.md, CONTRIBUTING.md and the
decisions.

    tools/papers.py [--self-test]

Of what stands in back quotes there

    a path, also the end of one (`motor/plan.rs`), is that of a file or a folder,
    the target of a `make` is one,
    a name, also one of a goal or of a path as `Device::number`, is in the code. In a step of a
    walk, a numbered item of walks.md, it is in one of the files that the step names.

A walk says how many files it names, and how many returns, (up).

Links of all papers lead to a file and a heading that are there.

What has a `<` is for the reader to fill in. Lists that repeat what files say are compared
with these files, `compared` below.
"""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAPERS = ["ARCHITECTURE.md", "CONTRIBUTING.md", *sorted(
    str(path.relative_to(ROOT)) for pattern in ("docs/decisions/*.md", "prolog/ev3dev/private/*/README.md", "crates/*/README.md")
    for path in ROOT.glob(pattern))]
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


def walks(text):
    """What each walk says of itself, and what it should say."""
    said, true = set(), set()
    for title, walk in re.findall(r"^## (.*)\n((?:(?!## ).*\n)*)", text, flags=re.M):
        files = []
        for word in re.findall(r"`([^`]+)`", walk):
            if CODE.search(word) and not any(f"/{file}".endswith(f"/{word}") for file in files):
                files.append(word)
        said |= {f"{title}: {line}" for line in re.findall(r"^\d+ files, \d+ returns?$", walk, flags=re.M)}
        count = walk.count("(up)")
        true.add(f"{title}: {len(files)} files, {count} return{'' if count == 1 else 's'}")
    return said, true


def makefile(text):
    """What `make` has, what .PHONY says, and what has a comment above it."""
    targets = set(re.findall(r"^([a-z][\w-]*):(?!=)", text, flags=re.M))
    joined = text.replace("\\\n", " ")
    phony = {name for names_there in re.findall(r"^\.PHONY:(.*)$", joined, flags=re.M) for name in names_there.split()}
    told = set(re.findall(r"^#[^\n]*\n([a-z][\w-]*):", text, flags=re.M))
    return targets, phony, told


def words(folder, files, pattern):
    """The words that a pattern finds in the files below a folder."""
    return {word for path, text in files.items() if path.startswith(folder)
            for word in re.findall(pattern, text, flags=re.M)}


def stems(folder, files):
    """The names of the Prolog files in a folder."""
    return {Path(path).stem for path in files if re.fullmatch(re.escape(folder) + r"[\w-]+\.pl", path)}


def compared(files, papers):
    """Lists of names: what says them, what it is compared with, the names of both. Where only the
    second must be among the first, the first is None."""
    page, view = papers["docs/view-protocol.md"], "prolog/ev3dev/private/view/"
    targets, phony, told = makefile(files["Makefile"])
    yield "Makefile, .PHONY", "its targets", phony, targets
    yield "Makefile, comments above targets", "its targets", told, targets
    recipes = "".join(re.findall(r"^\t.*\n|^check[\w-]*:.*\n", files["Makefile"], flags=re.M))
    yield "CONTRIBUTING.md, or what makes others", "targets that check", None, (
        {name for name in targets if name.startswith("check")},
        set(re.findall(r"[\w-]+(?!:)", papers["CONTRIBUTING.md"])) | set(re.findall(r" ([\w-]+)", recipes)))
    rooms = {path.split("/")[3] for path in files if re.match(r"prolog/ev3dev/private/[^/]+/", path)}
    yield "README.md of each room", "folders of private", {path.split("/")[3] for path in papers if re.fullmatch(
        r"prolog/ev3dev/private/[^/]+/README\.md", path)}, rooms
    yield "README.md of each crate", "crates", {path.split("/")[1] for path in papers if re.fullmatch(
        r"crates/[^/]+/README\.md", path)}, {path.split("/")[1] for path in files if re.match(r"crates/[^/]+/", path)}
    yield "ARCHITECTURE.md", "folders of private", None, (
        rooms, set(re.findall(r"`private/(\w+)/`", papers["ARCHITECTURE.md"])))
    state = files["src/view/state.rs"]
    objects = state[state.index("objects! {\n"):]
    fields = set(re.findall(r"^        (?:r#)?(\w+): .*,$", objects[:objects.index("\n}\n")], flags=re.M))
    fields |= words("crates/sim/src/world/item.rs", files, r'\("(\w+)", (?:[A-Z]\w+\(|\*)')
    yield "docs/view-protocol.md", "keys of src/view/state.rs and item.rs", None, (fields, set(re.findall(r'"(\w+)":', page)) | set(re.findall(r"`(\w+)", page)))
    table = page[page.index("### Page -> server"):page.index("Each but `next`")]
    lines = {word for cell in re.findall(r"^\| ([^|]*) \|", table, flags=re.M)
             for word in re.findall(r"`([a-z]+)", cell)} - {"x"}
    heard = words(view, files, r"^(?:form|line|goal_line|source_line|record_line|request)\((\w+),") | words(
        view, files, r"Word == (\w+)") | {word for found in words(view, files, r"memberchk\(Word, \[([\w, ]+)\]")
                                        for word in found.split(", ")}
    heard = {word for word in heard if word[0].islower()}
    yield "docs/view-protocol.md, lines", "what private/view hears", lines - {"max"}, heard
    yield "what the page sends", "what private/view hears", None, (
        words("prolog/ev3dev/view/", files, r"send\(['`\"]([a-z]+)"), heard)
    kept = words(view, files, r"view_keep_\((\w+),") | words("src/view/", files, r'\.keep\("(\w+)"')
    yield "docs/view-protocol.md", "what is kept in frames", None, (
        {name for name in kept if name[0].islower()}, set(re.findall(r"`(\w+)`", page)))
    for kind in ("worlds", "robots"):
        yield "docs/worlds.md", kind, None, (
            stems(f"prolog/ev3dev/{kind}/", files), set(re.findall(r"`?(\w+)", papers["docs/worlds.md"])))
    yield "docs/pictures", "worlds", {Path(path).stem[6:] for path in papers if "pictures/world_" in path}, stems(
        "prolog/ev3dev/worlds/", files)
    exercises = {path.split("/")[1] for path in files if re.fullmatch(r"course/[^/]+/exercise\.pl", path)}
    yield "docs/teaching.md", "exercises", set(re.findall(r"`course/([\w-]+)`", papers["docs/teaching.md"])), exercises
    tests = " ".join(text for path, text in files.items() if path.startswith("tests/"))
    yield "tests", "examples", None, (stems("examples/", files), set(re.findall(r"\w+", tests)))
    yield "docs/decisions/walks.md", "the walks", *walks(papers["docs/decisions/walks.md"])
    everything = " ".join(papers[path] for path in papers if path.endswith(".md") and path != "CHANGELOG.md")
    commands = set(re.findall(r"^command\((\w+),", files["prolog/ev3dev/private/app/command_line.pl"], flags=re.M))
    yield "README.md and docs", "commands of swipl ev3dev", set(
        re.findall(r"swipl (?:ev3dev|app/ev3dev\.pl) ([a-z]+)", everything)) | set(
            re.findall(r"^\| `([a-z]+)[^`|]*` \|", papers["docs/view.md"].split("| command |")[1].split("\n\n")[0], flags=re.M)), commands
    reasons = papers["docs/predicates.md"]
    reasons = reasons[reasons.index("`reason(R)`:"):]
    yield "docs/predicates.md, reason(R)", "the reasons of crates/driver", set(
        re.findall(r"`(\w+)`", reasons[:reasons.index("instead")])), set(
        re.findall(r'Self::\w+ => "(\w+)"', files["crates/driver/src/motor/wait.rs"]))
    table = files["prolog/ev3dev/private/devices/sensor_table.pl"]
    yield "docs/ev3dev-sysfs.md", "sensor types", None, (
        set(re.findall(r"^sensor\('([\w-]+)'", table, flags=re.M)),
        set(re.findall(r"[\w-]+", papers["docs/ev3dev-sysfs.md"])))
    item = files["crates/sim/src/world/item.rs"]
    form = r'Form::\w+\(\s*"(\w+)"'
    things = set(re.findall(form, item))
    facts = things | set(re.findall(form, files["crates/sim/src/facts.rs"]))
    yield "docs/worlds.md", "facts of worlds and robots", None, (
        facts, set(re.findall(r"`(\w+)\(", papers["docs/worlds.md"])))
    kinds = files["prolog/ev3dev/view/things.js"].partition("KINDS = {")[2]
    yield "KINDS of things.js", "things of item.rs", set(
        re.findall(r"^  (\w+): \{", kinds, flags=re.M)) - {"start", "around"}, things
    code = " ".join(text for path, text in files.items() if path.startswith(("prolog/", "src/", "crates/", "tests/", "tools/")))
    names_used = r"\b(?:EV3DEV_[A-Z_]+|ev3dev_(?:hints|stop_at_\w+|brick))\b"
    yield "code", "variables and flags in papers", None, (
        set(re.findall(names_used, everything)), set(re.findall(names_used, code)))
    yield "papers", "flags in the code", None, (
        words("prolog/", files, r"create_prolog_flag\((ev3dev_\w+)"), set(re.findall(r"ev3dev_\w+", everything)))
    chapters = {Path(path).stem for path in papers if re.fullmatch(r"docs/[^/]+\.md", path)}
    yield "tools/site.py", "papers of docs", None, (
        chapters, {name for both in re.findall(r'docs/([\w-]+)\.md|\("([\w-]+)", "', files["tools/site.py"])
                   for name in both})
    yield "links in papers", "papers of docs", None, (
        chapters, set(re.findall(r"\]\((?:\.\./)?(?:docs/)?([\w-]+)\.md", everything)))
    examples = stems("examples/", files)
    shown = set(re.findall(r"[a-z_]+", re.search(r"^examples=\(([^)]*)\)", files["tools/playground.sh"], flags=re.M)[1]))
    shown |= set(re.findall(r"^(?:demo|film)\((\w+),", files["tools/demo.pl"] + files["tools/films.pl"], flags=re.M))
    yield "examples", "demo.pl, films.pl and playground.sh", None, (shown, examples)
    yield "docs/pictures", "films of films.pl", {Path(path).stem[5:] for path in papers if "pictures/film-" in path}, set(
        re.findall(r"^film\((\w+),", files["tools/films.pl"], flags=re.M))
    versions = {"pack.pl": r"^version\('([\d.]+)'\)", "Cargo.toml": r'^version = "([\d.]+)"',
                "CITATION.cff": r"^version: ([\d.]+)", "README.md": r"ev3dev-([\d.]+)\.tgz",
                "docs/brick.md": r"scp dist/ev3dev-([\d.]+)\.tgz"}
    for path, pattern in versions.items():
        there = files.get(path) or papers[path]
        yield path, "the version of pack.pl", set(re.findall(pattern, there, flags=re.M)), set(
            re.findall(versions["pack.pl"], files["pack.pl"], flags=re.M))
    released = re.search(r"^## \[([\d.]+)\] - ([\d-]+)", papers["CHANGELOG.md"], flags=re.M)
    yield "CITATION.cff, date-released", "the last release in CHANGELOG.md", set(
        re.findall(r"^date-released: ([\d-]+)", papers["CITATION.cff"], flags=re.M)), {released[2]}


def anchors(text):
    """The headings of a paper, as links name them."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\]\(.*?\)", "", heading)).lower().replace(" ", "-")
            for heading in re.findall(r"^#+ +(.*)$", text, flags=re.M)}


def broken(papers, paths):
    """Links to a file or a heading that is not there, each with its paper."""
    for paper in papers:
        for link in re.findall(r"\]\((?!http)([^)\s]+)\)", papers[paper]):
            path, _, anchor = link.partition("#")
            path = os.path.normpath(os.path.join(os.path.dirname(paper), path)) if path else paper
            if path not in paths or (anchor and anchor not in anchors(papers.get(path, ""))):
                yield f"{paper}: {link} leads nowhere"


def differences(lists):
    """What one of two lists has and the other has not."""
    for says, of, names_there, things in lists:
        if names_there is None:
            wanted, found = things
            yield from (f"{says}: {of}: {each} is missing" for each in sorted(wanted - found, key=str))
            things = wanted
        else:
            yield from (f"{says}: {of}: {each} is missing" for each in sorted(things - names_there, key=str))
            yield from (f"{says}: {of}: there is no {each}" for each in sorted(names_there - things, key=str))
        if not things:
            yield f"{says}: {of}: nothing was found"


def self_test():
    """A file, a name and a target that are not there are found, and nothing else."""
    house = House({"src/a.rs": "fn here() {}", "src/b.rs": "fn there() {}", "Makefile": "check:"})
    text = ("1. `a.rs`: `here`, `A::here`, `there/2`\n- `src/c.rs`\n"
            "- `make check`, `make chek` and `there(X)`\n- `gone`, `<any>.rs`\n```\n`c.rs`\n```\n")
    found = list(wrong(text, house, {"check"}))
    expected = [(1, "A::here"), (1, "there/2"), (2, "src/c.rs"), (3, "make chek"), (4, "gone")]
    if sorted(found) != expected:
        sys.exit(f"papers.py: found {found}, not {expected}")
    found = list(differences([("a", "b", {1, 2}, {2, 3}), ("c", "d", None, ({1, 2}, {2})), ("e", "f", set(), set())]))
    expected = ["a: b: 3 is missing", "a: b: there is no 1", "c: d: 1 is missing", "e: f: nothing was found"]
    if found != expected:
        sys.exit(f"papers.py: found {found}, not {expected}")
    found = list(broken({"docs/a.md": "# A `b`, c\n[x](#a-b-c) [x](../src/) [x](b.md) [x](#b)"}, {"src", "docs/a.md"}))
    if found != ["docs/a.md: b.md leads nowhere", "docs/a.md: #b leads nowhere"]:
        sys.exit(f"papers.py: found {found}")
    if walks("# W\n## a\n\n2 files, 1 return\n\n1. `src/a.rs` `b.pl`\n2. `a.rs` (up)\n## b\n1. `c.js`\n") != (
            {"a: 2 files, 1 return"}, {"a: 2 files, 1 return", "b: 1 files, 0 returns"}):
        sys.exit("papers.py: walks are miscounted")
    if makefile("# x\na: b\nc:\n.PHONY: a \\\n c\n") != ({"a", "c"}, {"a", "c"}, {"a"}):
        sys.exit("papers.py: the Makefile is misread")


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
    papers = {path: "" if "/pictures/" in path else (ROOT / path).read_text(errors="replace")
              for path in listed if path.endswith((".md", ".cff")) or re.search("/pictures/(?:world_|film-)", path)}
    make = makefile(files["Makefile"])[0]
    house = House(files)
    found = [f"{paper}:{line}: there is no {what}" for paper in PAPERS
             for line, what in wrong((ROOT / paper).read_text(), house, make, walks=paper.endswith("walks.md"))]
    found += broken(papers, house.paths)
    return "\n".join([*found, *differences(compared(files, papers))]) or None


if __name__ == "__main__":
    sys.exit(main())
