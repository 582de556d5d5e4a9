#!/usr/bin/env python3
"""No verdict depends on the wall's clock: each place that has to do with it is known.

    tools/clocks.py             compares the tree with the table, tools/clocks.txt
    tools/clocks.py --list      prints each place
    tools/clocks.py --renew     writes the numbers of places into the table
    tools/clocks.py --self-test checks the checker

A line of the table says of a file how many places of each kind it has, their classes, what
they are for, and what another process can do to them. A line of a folder is about the files
below that have no place of another kind, and has no numbers:

    crates/door/src/lib.rs  reads 5, lasts 3  guard  a silent stranger is dropped, later if busy
    crates/sim/tests/it/    lasts             tree   steps of a machine, which has no other clock

A kind is how the clock comes in: a place reads the clock, sleeps, limits how long something
takes, or says how long a time lasts. A class is one of CLASSES. There is none for a verdict:
what passes or fails, counts points, warns or ends a program by the wall's clock has no place
here. A new place, or one that has gone, is an error. --renew marks the line of a new one with a
`?`, which stays until somebody has looked at it and has written a class.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "tools" / "clocks.txt"
CLASSES = {
    "pace": "an animation, an interval, a retry: later does no harm",
    "guard": "the last resort: it says that the machine was too busy, or ends what hangs",
    "robot": "it is about real time: how long a robot, a person or the network takes",
    "measure": "a figure for a reader, which decides nothing",
    "tree": "the clock of the tree: the simulated one, or the brick's",
    "input": "what a test gives to a program, or a program that is tested does",
}
KINDS = ("reads", "sleeps", "limits", "lasts")
FOLDERS = ("app", "benches", "course", "crates", "examples", "playground", "prolog", "src",
           "tests", "tools")
PROLOG = {
    "reads": r"\bget_time\(|\bstatistics\((?:walltime|real_time|epoch|system_time)\b",
    "sleeps": r"\bsleep\(",
    "limits": r"\bcall_with_time_limit\(|\balarm(?:_at)?\(|\bset_stream\([^()]*, timeout\("
              r"|\b(?:thread_get_message|process_wait|thread_wait)\((?:[^()]|\([^()]*\))*\[timeout\("
              r"|\bwait_for_input\(",
}
RUST = {
    "reads": r"\b(?:Instant|SystemTime)::now\b|\bstarted\.elapsed\b",
    "sleeps": r"\bsleep\(|\bpark_timeout\(",
    "limits": r"\b(?:recv|wait|set_read|set_write)_timeout\(",
    "lasts": r"\bDuration::from_(?:secs|millis|micros|nanos|mins)",
}
SCRIPT = {
    "reads": r"\bperformance\.now\(|\bDate\.now\(|\bnew Date\(\)",
    "sleeps": r"\bset(?:Timeout|Interval)\(|\brequestAnimationFrame\(",
    "limits": r"\btimeout: |\bAbortSignal\.timeout\(|\bsetDefaultTimeout\(",
}
PYTHON = {
    "reads": r"\btime\.(?:time|monotonic|perf_counter)\(",
    "sleeps": r"\btime\.sleep\(",
    "limits": r"\btimeout=|\bsettimeout\(|\bselect\.select\((?:[^()]|\([^()]*\))*, ",
}
SHELL = {
    "reads": r"\bSECONDS=0|\bdate \+%s",
    "sleeps": r"^\s*sleep [\d.]|[;&|] *sleep [\d.]",
    "limits": r"\btimeout\S* (?:-|\d|\")|\bread -t",
}
LANGUAGES = {".pl": PROLOG, ".rs": RUST, ".js": SCRIPT, ".mjs": SCRIPT, ".py": PYTHON, ".sh": SHELL}
COMMENTS = {".pl": r"%.*", ".rs": r"//.*", ".js": r"//.*", ".mjs": r"//.*", ".py": r"#.*", ".sh": r"(?:^|\s)#.*"}


def places(path, text):
    """Each place of a file: (kind, line, text)."""
    suffix = Path(path).suffix
    for number, line in enumerate(text.split("\n"), 1):
        code = re.sub(COMMENTS[suffix], "", line)
        for kind, pattern in LANGUAGES[suffix].items():
            for _ in re.finditer(pattern, code):
                yield kind, number, line.strip()


def count(there):
    """{kind: number}, sorted."""
    kinds = [kind for kind, _, _ in there]
    return {kind: kinds.count(kind) for kind in KINDS if kind in kinds}


def all_places():
    """{path: its places} of the files that git knows."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", *FOLDERS], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout.split("\n")
    found = {path: list(places(path, (ROOT / path).read_text(errors="replace"))) for path in listed
             if Path(path).suffix in LANGUAGES and (ROOT / path).exists() and path != "tools/clocks.py"}
    return {path: there for path, there in found.items() if there}


LINE = re.compile(r"(\S+)\s+((?:\w+(?: \d+)?)(?:, \w+(?: \d+)?)*)\s\s+(\S+)\s*(.*)")



def entry(line):
    """(path, {kind: number or None}, classes, words) of a line of the table, or None."""
    if not line.strip() or line.startswith("#"):
        return None
    match = LINE.fullmatch(line)
    if not match:
        sys.exit(f"tools/clocks.txt: cannot be read: {line}")
    kinds = {kind: int(number) if number else None
             for kind, _, number in (part.partition(" ") for part in match[2].split(", "))}
    return match[1], kinds, match[3], match[4]


def read(text):
    """{path: (kinds, classes, words)} of a table."""
    return {path: rest for path, *rest in filter(None, map(entry, text.split("\n")))}


def above(table, path, there):
    """The folder whose line is about this file, or None."""
    if path not in table:
        for up in Path(path).parents:
            if f"{up}/" in table and set(count(there)) <= set(table[f"{up}/"][0]):
                return f"{up}/"
    return None


def faults(table, found):
    """What is wrong with a table."""
    used = {above(table, path, there) for path, there in found.items()} | set(found)
    for path, there in sorted(found.items()):
        if path in table and table[path][0] != count(there):
            yield f"{path} {said(count(there))}, in tools/clocks.txt {said(table[path][0])}. They are now:"
        if path in table and table[path][0] != count(there) or not (path in table or above(table, path, there)):
            yield from (f"{path}:{number}: {kind}: {line}" for kind, number, line in there)
    for path, (_, classes, words) in table.items():
        if path not in used:
            yield f"tools/clocks.txt: {path} has nothing of the clock any more"
        elif not set(classes.split("+")) <= set(CLASSES):
            yield f"tools/clocks.txt: {path}: {classes}: the classes are {', '.join(CLASSES)}"
        elif not words:
            yield f"tools/clocks.txt: {path}: say what it is for, and what a busy machine does to it"


def said(kinds):
    """As the table has it."""
    return ", ".join(kind if number is None else f"{kind} {number}" for kind, number in kinds.items())


def renewed(text, found):
    """The table with what is found; comments stay at their place."""
    table, kept = read(text), []
    used = {above(table, path, there) for path, there in found.items()}
    for line in text.rstrip("\n").split("\n"):
        path, kinds, classes, words = entry(line) or (None, None, None, None)
        if path in found and kinds != count(found[path]):
            mark = "?" * any(number > kinds.get(kind, 0) for kind, number in count(found[path]).items())
            kept.append(f"{path}  {said(count(found[path]))}  {mark}{classes.lstrip('?') if mark else classes}  {words}")
        elif path is None or path in found or path in used:
            kept.append(line)
    new = [f"{path}  {said(count(there))}  ?" for path, there in sorted(found.items())
           if path not in table and not above(table, path, there)]
    return "\n".join([*kept, *new]) + "\n"


def self_test():
    """New, more and fewer places are found; comments and simulated time are not."""
    files = {
        "a/x.pl": "t(T) :-\n    get_time(T),  % get_time(T)\n    wait(1), go(1, [timeout(2)]).\n",
        "a/y.rs": "let a = Instant::now(); // Instant::now()\nsleep(Duration::from_secs(1));\n",
        "b/z.mjs": "setTimeout(go, 5);\nconst t = performance.now();\n",
        "b/w.sh": "sleep 1\ntimeout 5 sleep 9\n",
        "b/v.py": "time.sleep(1)\nrun(x, timeout=3)\n",
    }
    found = {path: list(places(path, text)) for path, text in files.items()}
    counts = {path: said(count(there)) for path, there in found.items()}
    expected = {"a/x.pl": "reads 1", "a/y.rs": "reads 1, sleeps 1, lasts 1", "b/z.mjs": "reads 1, sleeps 1",
                "b/w.sh": "sleeps 1, limits 1", "b/v.py": "sleeps 1, limits 1"}
    assert counts == expected, counts
    text = ("# x\na/x.pl  reads 2  pace  why\na/  reads, sleeps, lasts  tree  why\n"
            "b/w.sh  sleeps 1, limits 1  verdict  why\nb/  reads  pace  why\n"
            "b/v.py  sleeps 1, limits 1  guard+pace\nb/gone.py  reads 1  pace  why\n")
    listed = "\n".join(faults(read(text), found))
    for part in ("a/x.pl reads 1, in tools/clocks.txt reads 2", "b/z.mjs:2: reads", "b/v.py: say",
                 "b/gone.py has nothing", "b/ has nothing", "b/w.sh: verdict"):
        assert part in listed, (part, listed)
    assert "y.rs" not in listed, listed
    again = renewed(text, found)
    assert "a/x.pl  reads 1  pace  why" in again and "gone" not in again and "b/ " not in again, again
    assert "b/z.mjs  reads 1, sleeps 1  ?\n" in again and "a/  reads, sleeps, lasts  tree" in again, again
    assert renewed(again, found) == again, again
    assert "a/x.pl  reads 1  ?pace" in renewed(again.replace("reads 1  pace", "reads 0  pace"), found)


def main():
    """The command line."""
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    found = all_places()
    if sys.argv[1:] == ["--list"]:
        return print("\n".join(f"{path}:{number}: {kind}: {line}" for path, there in sorted(found.items())
                               for kind, number, line in there))
    text = TABLE.read_text() if TABLE.exists() else ""
    if sys.argv[1:] == ["--renew"]:
        TABLE.write_text(renewed(text, found))
        text = TABLE.read_text()
    return "\n".join(faults(read(text), found)) or None


if __name__ == "__main__":
    sys.exit(main())
