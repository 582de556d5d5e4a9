#!/usr/bin/env python3
"""Checks that imports go down: from each layer only to those it may import.

    tools/layers.py [TABLE]     checks the tree by a table; tools/layers.txt
    tools/layers.py --list      prints each arrow between files
    tools/layers.py --self-test checks the checker

The table is a list of sections. A section begins with the folder of its files
in brackets; each line is a layer, its folders or files, and, after an arrow,
the layers it may import. Every file must be in a layer, and every name of the table must be there. The most specific name
wins. A layer may always import itself. A section whose folder does not exist
is an error, and so is a crate without a section, or a folder of private/ that
no layer names, or layers that may import each other. A predicate of natives! is short: it converts, calls, and unifies.

    [crates/driver/src]
    ground   error.rs class.rs
    device   device               -> ground
    front    lib.rs               -> *

Whatever the table says, files must not import each other in a circle.

Rust: paths that begin with crate, self, super or a child module, in `use` and
elsewhere, but not in tests, comments and strings. A re-exported name counts as
an import of the file that defines it. Prolog: use_module, autoload, reexport,
ensure_loaded and include, and calls of Module:Predicate.
"""
import glob
import os
import re
import sys

RUST, PROLOG = ".rs", ".pl"


# ---- Rust ----

def blank(match):
    """As many newlines as before, so that lines keep their numbers."""
    return "\n" * match.group(0).count("\n") or " "


RUST_NOISE = re.compile(
    r"""//[^\n]*|/\*.*?\*/|b?r(\#*)".*?"\1|b?"(?:\\.|[^"\\])*"|b?'(?:\\(?:u\{\w+\}|x\w\w|.)|[^'\\\n])'""",
    re.S,
)


def without_tests(code):
    """Drops items behind #[cfg(test)]."""
    while match := re.search(r"#\[cfg\((?:test|all\(test[^\]]*)\)\]", code):
        end, depth = match.end(), 0
        while end < len(code):
            char = code[end]
            end += 1
            if char == "{":
                depth += 1
            elif char == "}":
                depth -= 1
            if (char == ";" and depth == 0) or (char == "}" and depth == 0):
                break
        code = code[: match.start()] + "\n" * code.count("\n", match.start(), end) + code[end:]
    return code


def use_paths(tree, prefix=()):
    """The (path, name) pairs of what follows `use`."""
    tree = tree.strip()
    brace = tree.find("{")
    if brace >= 0:
        head = tuple(part.strip() for part in tree[:brace].split("::") if part.strip())
        depth, start, body = 0, 0, tree[brace + 1 : tree.rindex("}")]
        parts = []
        for index, char in enumerate(body):
            depth += (char == "{") - (char == "}")
            if char == "," and depth == 0:
                parts.append(body[start:index])
                start = index + 1
        parts.append(body[start:])
        for part in parts:
            if part.strip():
                yield from use_paths(part, prefix + head)
        return
    path, _, alias = re.sub(r"\s+", " ", tree).partition(" as ")
    path = prefix + tuple(part.strip() for part in path.split("::") if part.strip())
    if path and path[-1] == "self":
        path = path[:-1]
    if path:
        yield path, alias.strip() or path[-1]


class RustCrate:
    """The modules of one crate, and who imports whom."""

    def __init__(self, root, files):
        self.code, self.modules, self.file_of = {}, {}, {}
        for file in files:
            with open(os.path.join(root, file), encoding="utf-8") as source:
                self.code[file] = source.read()
        named = {}
        for file, text in self.code.items():
            for path, name in re.findall(
                r'#\[path = "([^"]+)"\]\s*(?:pub(?:\([^)]*\))? )?mod (\w+);', text
            ):
                named[os.path.normpath(os.path.join(os.path.dirname(file), path))] = name
        for file, text in self.code.items():
            parts = file[: -len(RUST)].split("/")
            if parts[-1] in ("mod", "lib", "main"):
                parts.pop()
            if file in named:
                parts[-1] = named[file]
            self.modules[file] = tuple(parts)
            self.file_of.setdefault(tuple(parts), []).append(file)
            self.code[file] = without_tests(RUST_NOISE.sub(blank, text))
        self.exports = {module: {} for module in self.file_of}
        self.uses = {}
        for file, code in self.code.items():
            module, uses = self.modules[file], []
            for visible, tree in re.findall(r"(pub(?:\([^)]*\))?\s+)?\buse\s+([^;]+);", code):
                for path, name in use_paths(tree):
                    uses.append(path)
                    if visible:
                        self.exports[module][name] = path
            code = re.sub(r"\buse\s+[^;]+;", " ", code)
            children = set(re.findall(r"\bmod\s+(\w+)\s*;", code))
            inline = re.findall(r"(?<![\w:])((?:crate|super|self)(?:\s*::\s*\w+)+)", code)
            if children:
                either = "|".join(sorted(children))
                inline += re.findall(rf"(?<![\w:.])((?:{either})(?:\s*::\s*\w+)+)", code)
            uses += [tuple(part.strip() for part in path.split("::")) for path in inline]
            self.uses[file] = [(path, children) for path in uses]

    def absolute(self, module, path, children):
        """The path from the crate's root; None for another crate's."""
        if path[0] == "crate":
            return path[1:]
        if path[0] == "self":
            return module + path[1:]
        if path[0] == "super":
            while path and path[0] == "super":
                module, path = module[:-1], path[1:]
            return module + path
        if path[0] in children:
            return module + path
        return None

    def definers(self, path, seen=()):
        """The files that define what a path names."""
        module = path
        while module not in self.file_of:
            module = module[:-1]
        name = path[len(module)] if len(path) > len(module) else None
        exported = self.exports[module].get(name)
        if exported and (module, name) not in seen:
            children = {each[-1] for each in self.file_of if each[:-1] == module and each}
            target = self.absolute(module, exported, children)
            if target is not None:
                return self.definers(target, (*seen, (module, name)))
        return self.file_of[module]

    def arrows(self):
        for file, uses in self.uses.items():
            for path, children in uses:
                target = self.absolute(self.modules[file], path, children)
                if target is not None:
                    for other in self.definers(target):
                        if other != file and other not in self.file_of[self.modules[file]]:
                            yield file, other


# ---- Prolog ----
# library(prolog_xref) finds the same arrows, but needs as many lines, and a second process.

# The first quote of 0'c is no quote, and a quoted atom has no bare newline.
PROLOG_NOISE = re.compile(r"""0'(?:\\.|''|.)|%[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\])*")""", re.S)
LOADS = re.compile(
    r"\b(?:use_module|autoload|reexport|ensure_loaded|include|load_files)\(\s*(\[[^\]]*\]|library\([^)]*\)|'[^']*'|[\w./]+)"
)


def prolog_arrows(root, files):
    code, module_of = {}, {}
    for file in files:
        with open(os.path.join(root, file), encoding="utf-8") as source:
            text = source.read()
        code[file] = PROLOG_NOISE.sub(lambda found: found.group(1) or blank(found), text)
        if found := re.search(r":-\s*module\(\s*'?(\w+)", code[file]):
            module_of[found.group(1)] = file

    def resolve(file, spec):
        spec = spec.strip()
        if spec.startswith("library("):
            base = spec[len("library(") : -1]
        else:
            base = os.path.join(os.path.dirname(file), spec.strip("'"))
        base = os.path.normpath(re.sub(r"\s|'", "", base))
        return next((each for each in (base, base + PROLOG) if each in code), None)

    for file, text in code.items():
        for spec in LOADS.findall(text):
            specs = spec[1:-1].split(",") if spec.startswith("[") else [spec]
            for each in specs:
                other = resolve(file, each)
                if other and other != file:
                    yield file, other
        for module in re.findall(r"\b([a-z]\w*):[a-z]\w*", text):
            other = module_of.get(module)
            if other and other != file:
                yield file, other


# ---- The check ----

def circles(files, arrows):
    """The sets of files that import each other (Tarjan)."""
    after = {file: [] for file in files}
    for source, target in arrows:
        after[source].append(target)
    index, low, stack, on, found = {}, {}, [], set(), []

    def visit(node):
        work = [(node, iter(after[node]))]
        index[node] = low[node] = len(index)
        stack.append(node)
        on.add(node)
        while work:
            at, rest = work[-1]
            for child in rest:
                if child not in index:
                    index[child] = low[child] = len(index)
                    stack.append(child)
                    on.add(child)
                    work.append((child, iter(after[child])))
                    break
                if child in on:
                    low[at] = min(low[at], index[child])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[at])
                if low[at] == index[at]:
                    circle = set()
                    while True:
                        member = stack.pop()
                        on.discard(member)
                        circle.add(member)
                        if member == at:
                            break
                    if len(circle) > 1:
                        found.append(sorted(circle))

    for file in files:
        if file not in index:
            visit(file)
    return found


def read_table(text):
    """[(folder, {layer: (names, allowed layers)})]"""
    sections = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.partition("#")[0].strip()
        if not line:
            continue
        if head := re.fullmatch(r"\[(\S+)\]", line):
            sections.append((head.group(1), {}))
            continue
        left, _, right = line.partition("->")
        layer, *names = left.split()
        if not sections or not names or layer in sections[-1][1]:
            raise SystemExit(f"layers: line {number} is not a layer: {line}")
        sections[-1][1][layer] = (names, right.split())
    for folder, layers in sections:
        for layer, (_, allowed) in layers.items():
            for other in allowed:
                if other != "*" and other not in layers:
                    raise SystemExit(f"layers: {folder}: {layer} -> {other}, which is no layer")
        allowed = [(layer, other) for layer, (_, others) in layers.items() for other in others if other != "*"]
        for circle in circles(layers, allowed):
            raise SystemExit(f"layers: {folder}: these may import each other: {' '.join(circle)}")
    return sections


def layer_of(file, layers):
    best = None
    for layer, (names, _) in layers.items():
        for name in names:
            name = name.rstrip("/")
            if file == name or name == "." or file.startswith(name + "/"):
                length = 0 if name == "." else len(name)
                if best is None or length > best[0]:
                    best = (length, layer)
    return best and best[1]


def crates(top):
    """The folder of the sources of each crate."""
    manifests = glob.glob("crates/*/Cargo.toml", root_dir=top)
    return sorted(os.path.join(os.path.dirname(each), "src") for each in manifests)


def rooms(files):
    """The folders within private/."""
    return sorted({found.group() for file in files if (found := re.match(r".*private/\w+(?=/)", file))})


LONGEST_NATIVE = 15


def long_natives(text):
    """The native predicates with a longer body than that, or a longer part of it."""
    for name, body in re.findall(r'^    \w+ fn "(\w+)".*\n((?:.*\n)*?)    \}$', text, flags=re.M):
        parts = re.findall(r"^        (?:setup|call\(\w+\)) => \{\n((?:.*\n)*?)        \}", body, flags=re.M)
        if max(part.count("\n") for part in parts or [body]) > LONGEST_NATIVE:
            yield name


def check(top, table, listing=False):
    """Prints what it checks; how many errors there are."""
    errors = 0
    sections = read_table(table)
    folders = [folder for folder, _ in sections]
    for folder in crates(top):
        if folder not in folders:
            print(f"layers: {folder} is of a crate that has no section")
            errors += 1
    for folder, layers in sections:
        root = os.path.join(top, folder)
        files = sorted(
            os.path.relpath(os.path.join(where, name), root).replace(os.sep, "/")
            for where, _, names in os.walk(root)
            for name in names
            if name.endswith((RUST, PROLOG))
        )
        inner = [os.path.relpath(f, folder) + "/" for f in folders if f.startswith(folder + "/")]
        files = [file for file in files if not file.startswith(tuple(inner) or ("//",))]
        if not files:
            print(f"layers: {folder}: there are no files")
            errors += 1
            continue
        rust = [file for file in files if file.endswith(RUST)]
        prolog = [file for file in files if file.endswith(PROLOG)]
        for file in rust:
            with open(os.path.join(root, file), encoding="utf-8") as source:
                for name in long_natives(source.read()):
                    print(f"layers: {folder}/{file}: the body of {name} has more than {LONGEST_NATIVE} lines")
                    errors += 1
        arrows = sorted({*RustCrate(root, rust).arrows(), *prolog_arrows(root, prolog)})
        up = 0
        for file in files:
            if layer_of(file, layers) is None:
                print(f"layers: {folder}/{file} is in no layer")
                errors += 1
        all_names = [name.rstrip("/") for names, _ in layers.values() for name in names]
        for room in rooms(files):
            if not any((name + "/").startswith(room + "/") for name in all_names):
                print(f"layers: {folder}/{room} is a room that no layer names")
                errors += 1
        for name in all_names:
            if name != "." and not any(file == name or file.startswith(name + "/") for file in files):
                print(f"layers: {folder}/{name} in the table is no file or folder")
                errors += 1
        for source, target in arrows:
            ours, theirs = layer_of(source, layers), layer_of(target, layers)
            if listing:
                print(f"    {source} -> {target}")
            if ours is None or theirs is None or ours == theirs:
                continue
            allowed = layers[ours][1]
            if theirs not in allowed and "*" not in allowed:
                print(f"layers: {folder}/{source} ({ours}) must not import {target} ({theirs})")
                up += 1
        found = circles(files, arrows)
        for circle in found:
            print(f"layers: {folder}: circle of {len(circle)}: {' '.join(circle)}")
        errors += up + len(found)
        print(
            f"{folder}: {len(files)} files, {len(arrows)} arrows, "
            f"{up} against the table, {len(found)} circles"
        )
    return errors


# ---- The self-test ----

def self_test():
    import contextlib
    import io
    import tempfile

    def run(files, table):
        with tempfile.TemporaryDirectory() as top:
            for name, text in files.items():
                if text is None:
                    continue
                path = os.path.join(top, name)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as out:
                    out.write(text)
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                errors = check(top, table)
            return errors, said.getvalue()

    table = "[src]\nground low.rs\ndevice device -> ground\nmotor motor -> ground device\nfront lib.rs -> *\n"
    base = {
        "src/lib.rs": "pub mod low;\nmod device;\nmod motor;\npub use device::Device;\n",
        "src/low.rs": "//! See [`crate::motor`].\npub fn f() -> char { '\"' }\n",
        "src/device/mod.rs": "mod list;\nuse list::List;\npub struct Device;\n",
        "src/device/list.rs": "use crate::low;\npub struct List;\n#[cfg(test)]\nmod tests { use crate::motor::run; }\n",
        "src/motor/mod.rs": "use crate::{Device, low::{self, f}};\npub fn run() { let _ = \"crate::lib\"; }\n",
    }
    cases = [
        ("a tree by its table", {}, 0, "5 files, 5 arrows, 0 against the table, 0 circles"),
        ("an arrow up in use", {"src/low.rs": "use crate::motor::run;\n"}, 2, "low.rs (ground) must not import motor/mod.rs (motor)"),
        ("an arrow up inline", {"src/device/list.rs": "fn f() { crate::motor::run() }\n"}, 2, "device/list.rs (device) must not import"),
        ("an arrow up by super", {"src/device/list.rs": "use super::super::motor::run as go;\n"}, 2, "device/list.rs (device) must not import"),
        ("an arrow up through a group", {"src/device/list.rs": "use crate::{low, motor::{run}};\n"}, 2, "must not import motor/mod.rs"),
        ("an arrow up through the front", {"src/low.rs": "use crate::Device;\n"}, 1, "low.rs (ground) must not import device/mod.rs"),
        ("a circle within a layer", {"src/device/list.rs": "use super::Device;\n"}, 1, "circle of 2: device/list.rs device/mod.rs"),
        ("a file in no layer", {"src/new.rs": ""}, 1, "src/new.rs is in no layer"),
        ("a crate without a section", {"crates/new/Cargo.toml": ""}, 1, "crates/new/src is of a crate that has no section"),
        ("a long native", {"src/low.rs": 'natives! {\n    semidet fn "p_"(_c) {\n' + 16 * "        x;\n" + "    }\n}\n"}, 1, "src/low.rs: the body of p_ has more than 15 lines"),
        ("a layer without a file", {"src/motor/mod.rs": None}, 1, "src/motor in the table is no file"),
    ]
    failed = 0
    for name, change, errors, text in cases:
        files = {**base, **change}
        got, said = run(files, table)
        # A circle may come with an arrow up; at least the arrow must be seen.
        if (got == 0) != (errors == 0) or text not in said:
            print(f"self-test: {name}: {got} errors\n{said}")
            failed += 1
    prolog = {
        "p/a.pl": ":- module(a, [a/0]).\n:- use_module(b).\n% b:b\na :- b.\n",
        "p/b.pl": ":- module(b, [b/0]).\nb :- X = 0'\", X.\n",
    }
    rules = "[p]\nhigh a.pl -> low\nlow b.pl\n"
    pl_cases = [
        ("Prolog by its table", {}, 0, "2 files, 1 arrows"),
        ("a call through a wall", {"p/b.pl": ":- module(b, []).\nb :- a:a.\n"}, 1, "b.pl (low) must not import a.pl"),
        ("a room without a layer", {"p/private/hall/c.pl": ""}, 1, "p/private/hall is a room that no layer names"),
        ("autoload upwards", {"p/b.pl": ":- module(b, []).\n:- autoload(library(a), [a/0]).\n"}, 1, "b.pl (low) must not import a.pl"),
    ]
    for name, change, errors, text in pl_cases:
        got, said = run({**prolog, **change}, rules)
        if (got == 0) != (errors == 0) or text not in said:
            print(f"self-test: {name}: {got} errors\n{said}")
            failed += 1
    print(f"self-test: {len(cases) + len(pl_cases)} cases, {failed} failed")
    return failed


def main(arguments):
    if "--self-test" in arguments:
        return 1 if self_test() else 0
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    names = [each for each in arguments if not each.startswith("-")]
    path = names[0] if names else os.path.join(top, "tools", "layers.txt")
    with open(path, encoding="utf-8") as table:
        return 1 if check(top, table.read(), "--list" in arguments) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
