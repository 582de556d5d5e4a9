#!/usr/bin/env python3
"""Plays sessions: what a person types at a terminal, and what it answers.

    tests/sessions/play.py [-j N] [--show] [FILE...]    default: tests/sessions/*.txt and the papers
    tests/sessions/play.py --renew FILE...       writes into the sessions what came

A session is a text as one sees it on the screen:

    # A comment.
    --- square.pl                 a file, up to the next line ---
    start :- go_cm(30, 20).
    ---
    $ swipl square.pl             a command of the shell, in a folder of its own
    ?- start.                     is typed when the prompt ?- has come
    true.

    ?- between(1, 2, X).
    X = 1 <;>                     <...>: these keys, when what is before has come
    X = 2.

    ?- writeln(going), wait(100).
    going
    ^C                            ^C ^D ^Z: a key, when what is before has come
    Action (h for help) ? <a>
    ...
    ?- ^D
    $ swipl ev3dev run nothing.pl
    ...
    [exit 2]                      its status, if it is not 0

`...` stands for any text in a line, and alone for any lines. `{<9}`, `{>=9.1}`
before a line: only in these versions of Prolog; `# only: >=9` says it of a whole
session. Blank lines do not count. What was typed is not looked for in the answer:
the terminal echoes it. `swipl` is that of the variable SWIPL, in a home that has
nothing but this pack. Before 9.1.18, where Prolog has no apps, `swipl ev3dev` runs
app/ev3dev.pl.

A file that ends in .md is a paper. Its queries are typed at one prompt, in their order;
its programs, the blocks of code without a query, are loaded first. `$ ` begins a shell
and what is typed in it. What stands below a query has to come, numbers with a point
within 3 %; where nothing stands, anything but an error, a warning or `false`. The
commands of the shell follow. `tests/sessions/elsewhere.txt` names those that are run
elsewhere, or nowhere, and why; each of its lines has to stand in a paper. A comment
`<!-- file: square.pl -->` before a block says what the file of the block is called,
`<!-- only: >=9 -->` in which versions it is typed; `itself` is a Prolog that starts another
one of itself, as those of tools/emulate.sh do not, which set EV3DEV_EMULATED.

`--renew` writes an answer that differs in the place of the one in the file. It does not do
so for an answer up to a key. A line of the file that agrees stays, as one with `...`. A query
without an answer gets one: `git diff` then shows what a change does to the answers.

Python's own pty does for this what pexpect would: there is nothing to install, on
a machine without network, too.
"""

import argparse
import fcntl
import functools
import multiprocessing
import os
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PATIENCE = 600  # seconds, after which it hangs or the machine is too busy
PROMPT = re.compile(r"(?:^|\n)(?:\|: )?(?:\d+ )?\?- $")
PROMPT_START = re.compile(r"^(?:\d+ )?\?- ")
ESCAPES = re.compile(r"\x1b\[[0-9;?]*[ -/]*[@-~]|\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)|\x1b[=>()][0-9A-B]?|[\r\a]")
OPEN = re.compile(r"(?:^|\n)(?:true|[A-Z_]\w* = .*\S) $")
KEYS = {"^C": "\x03", "^D": "\x04", "^Z": "\x1a", "^\\": "\x1c"}


class Wrong(Exception):
    """The answer is not the expected one."""


class Terminal:
    """A command on a terminal of its own."""

    def __init__(self, command, folder, environment):
        self.text = ""
        self.taken = 0
        self.ended = False
        # A shell that waits gets Ctrl-C, too
        if not re.search(r"[|;&<>]", command):
            command = f"exec {command}"
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execve("/bin/sh", ["sh", "-c", command], environment)
        # Wide, so that nothing is wrapped; high, so that no pager waits
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", 500, 400, 0, 0))

    def send(self, text, keep=False):
        """Types; what has been printed up to now is done with, unless it is to be kept."""
        if not keep:
            self.taken = len(self.text)
        os.write(self.fd, text.encode())

    def news(self):
        """What has come since the last keys, as one sees it, without their echo."""
        text = ESCAPES.sub("", self.text[self.taken :])
        while "\b" in text:
            text = re.sub(r"[^\x08\n]?\x08", "", text, count=1)
        return text

    def read(self, seconds):
        """Reads what comes within some seconds; true if anything came."""
        ready, _, _ = select.select([self.fd], [], [], seconds)
        if not ready:
            return False
        try:
            data = os.read(self.fd, 65536)
        except OSError:  # the last one closed the terminal
            data = b""
        if not data:
            self.ended = True
        self.text += data.decode(errors="replace")
        return bool(data)

    def until(self, condition, what):
        """Reads until condition(news) holds; what says what is waited for."""
        deadline = time.monotonic() + PATIENCE
        while not condition(self.news()):
            left = deadline - time.monotonic()
            if left <= 0:
                raise Wrong(f"waited {PATIENCE} s, in which a busy machine may not have come to {what}")
            if not self.ended:
                self.read(left)
            elif not condition(self.news()):
                raise Wrong(f"ended before {what}")
        return self.news()

    def until_edited(self):
        """A line editor, if there is one, takes over the terminal after the prompt; a key
        before that would be the terminal's. There is none if the program sleeps before."""
        asleep = 0
        while asleep < 5 and termios.tcgetattr(self.fd)[3] & termios.ICANON:
            self.read(0.02)
            asleep = asleep + 1 if self.is_asleep() else 0

    def is_asleep(self):
        """Does the program in the foreground wait, and not only for the processor?"""
        try:
            stat = Path(f"/proc/{os.tcgetpgrp(self.fd)}/stat").read_text()
        except OSError:  # it has ended
            return True
        return stat.rpartition(")")[2].split()[0] == "S"

    def wait(self):
        """Waits for the end; the status as a shell has it."""
        self.until(lambda _: self.ended, "its end")
        _, status = os.waitpid(self.pid, 0)
        os.close(self.fd)
        code = os.waitstatus_to_exitcode(status)
        return 128 - code if code < 0 else code

    def kill(self):
        """Ends it, whatever it does."""
        try:
            os.killpg(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
            os.close(self.fd)
        except (OSError, ChildProcessError):
            pass


NUMBER = re.compile(r"-?\d+\.\d+(?:e[-+]?\d+)?")


def agrees(expected, line, near):
    """Is the line the expected one? near: its numbers with a point may differ a little."""
    if re.fullmatch(pattern(expected), line):
        return True
    if not near:
        return False
    numbers = [[float(n) for n in NUMBER.findall(text)] for text in (expected, line)]
    around = [NUMBER.sub("#", text) for text in (expected, line)]
    close = all(abs(a - b) <= max(0.5, 0.03 * abs(a)) for a, b in zip(*numbers))
    return around[0] == around[1] and close


def pattern(line):
    """The regular expression of an expected line."""
    return ".*?".join(re.escape(part.rstrip() if part.endswith(" ") else part) for part in line.split("..."))


def matches(expected, text, near=False):
    """Is text what is expected?"""
    lines = [line.rstrip() for line in text.split("\n")]
    return fits([line.rstrip() for line in expected if line.strip()], [line for line in lines if line], near)


def fits(expected, lines, near=False):
    if not expected:
        return not lines
    if expected[0] == "...":
        return any(fits(expected[1:], lines[n:], near) for n in range(len(lines) + 1))
    return bool(lines) and agrees(expected[0], lines[0], near) and fits(expected[1:], lines[1:], near)


WRONG = re.compile(r"^(?:ERROR|Warning|false\.)", re.M)
COMMANDS = ("make ", "swipl ", "swipl", "scp ", "ssh ", "sudo ", "tar ", "./", "brick-prolog/")


class Paper:
    """The sessions of a paper."""

    def __init__(self, path):
        self.path = path
        self.program = []  # its program
        self.files = {}  # other files, by their names
        self.queries = []  # lines of the prompt
        self.sessions = []  # commands with what is typed then
        self.commands = []  # commands alone
        self.read()

    def read(self):
        """Sorts the lines."""
        lines = self.path.read_text().split("\n")
        name = None
        only = ""
        number = 0
        while number < len(lines):
            line = lines[number]
            named = re.fullmatch(r"<!-- file: (\S+) -->", line)
            condition = re.fullmatch(r"<!-- only: (\S+) -->", line)
            if named:
                name = named[1]
            elif condition:
                only = f"{{{condition[1]}}} "
            elif line.startswith("```"):
                end = lines.index("```", number + 1)
                self.block(line[3:], lines[number + 1 : end], name, only)
                number, name, only = end, None, ""
            elif line.startswith("    ") and name:
                end = next(n for n in range(number, len(lines)) if lines[n] and not lines[n].startswith("    "))
                self.files[name] = "".join(text[4:] + "\n" for text in lines[number:end]).rstrip("\n") + "\n"
                number, name = end - 1, None
            elif re.match(r"    \S", line) and line[4:].startswith(COMMANDS):
                self.commands.append(re.sub(r"\s+#.*", "", line[4:]))
            number += 1

    def block(self, language, lines, name, only):
        """Sorts the lines of a block of code."""
        if language not in ("", "prolog"):
            return
        if name:
            self.files[name] = "\n".join(lines) + "\n"
        elif lines[0].startswith("$ "):
            self.sessions.append(lines)
        elif language == "prolog":
            queries = []
            is_query = False
            for line in lines:
                # Below a query stands its answer, up to a line that is empty
                is_query = line.startswith("?- ") or (is_query and line != "")
                (queries if is_query else self.program).append(line)
            self.queries += [only + line for line in continued(queries)]

    def plays(self, elsewhere):
        """The sessions, each a list of lines."""
        files = []
        for name, text in self.files.items():
            files += [f"--- {name}", *text.rstrip("\n").split("\n"), "---"]
        if self.queries:
            program = ["--- paper.pl", *self.program, "---"]
            yield [*files, *program, "$ swipl -q paper.pl", *self.queries]
        for lines in self.sessions:
            yield [*files, lines[0].replace("swipl", "swipl -q", 1), *continued(lines[1:])]
        commands = [command for command in self.commands if command not in elsewhere]
        if commands:
            yield [*files, *(line for command in commands for line in (f"$ {command}", "..."))]


def continued(lines):
    """A query of several lines has the mark of that."""
    is_open = False
    for line in lines:
        if is_open and line.startswith(" "):
            line = "|    " + line.strip()
        if line.startswith(("?- ", "|    ")):
            is_open = not re.search(r"\.(?:\s*%.*|\s*)$", line)
        yield line


class Version(tuple):
    """As (9, 0, 4)."""

    @classmethod
    def of(cls, text):
        return cls(int(part) for part in text.split("."))

    def meets(self, condition):
        """condition: as ">=9.1", "<9", "7.2"."""
        for part in condition.split(","):
            if part == "itself":
                if "EV3DEV_EMULATED" in os.environ:
                    return False
                continue
            operator, text = re.fullmatch(r"(<|>=|)([0-9.]+)", part.strip()).groups()
            other = Version.of(text)
            mine = tuple(self[: len(other)])
            if not {"<": mine < other, ">=": mine >= other, "": mine == other}[operator]:
                return False
        return True


class Home:
    """The machine of a person: a home with the pack, and what the shell finds."""

    def __init__(self, swipl):
        self.top = Path(tempfile.mkdtemp(prefix="ev3dev-sessions-"))
        self.swipl = swipl
        asked = subprocess.run([swipl, "--version"], capture_output=True, text=True, check=True)
        self.version = Version.of(re.search(r"(\d+\.\d+\.\d+)", asked.stdout)[1])
        home = Path(os.environ.get("EV3DEV_SESSION_HOME", self.top / "home"))
        programs = self.top / "bin"
        programs.mkdir()
        if "EV3DEV_SESSION_HOME" not in os.environ:
            packs = home / (".local/share/swi-prolog/pack" if self.version >= (8,) else "lib/swipl/pack")
            packs.mkdir(parents=True)
            (packs / "ev3dev").symlink_to(ROOT)
        # An app is found in what is installed
        apps = self.version >= (9, 1, 18)
        app = "" if apps else f'[ "$1" != ev3dev ] || {{ shift; set -- "{ROOT}/app/ev3dev.pl" "$@"; }}\n'
        self.program(programs / "swipl", f'{app}exec "{swipl}" "$@"')
        # As on a machine of one's own, with this folder for what emulated Prologs need
        kept = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("XDG_", "TREES", "EV3DEV_")) or name == "EV3DEV_TOOLCHAIN"
        }
        self.environment = kept | {
            "HOME": str(home),
            "EMULATED_HOME": str(home),
            "PATH": f"{programs}:{os.environ['PATH']}",
            "TERM": "xterm",
            "LANG": "C.UTF-8",
        }

    @staticmethod
    def program(path, text):
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def remove(self):
        shutil.rmtree(self.top)


class Player:
    """Plays one session."""

    def __init__(self, home, show, near=False, renew=None):
        self.home = home
        self.show = show
        self.near = near
        self.renew = renew  # what to call for an answer that differs
        self.number = 0
        self.places = []  # the lines of what is expected, and of what was typed
        self.folder = Path(tempfile.mkdtemp(dir=home.top))
        for name in ("app", "examples"):
            (self.folder / name).symlink_to(ROOT / name)
        self.terminal = None
        self.expected = []
        self.echo = False
        self.typed = ""
        self.enough = False
        self.status = 0
        self.count = 0

    def play(self, lines):
        """Plays the lines; raises Wrong at the first that is not as it should be."""
        lines = iter(enumerate(lines, 1))
        try:
            for self.number, line in lines:
                if line.startswith("--- "):
                    self.file(line[4:].strip(), lines)
                else:
                    self.line(line)
            self.end()
        finally:
            if self.terminal:
                self.terminal.kill()

    def file(self, name, lines):
        content = []
        for self.number, line in lines:
            if line == "---":
                break
            content.append(line + "\n")
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("".join(content))

    def line(self, line):
        number = self.number
        condition = re.match(r"\{([^}]*)\}\s?", line)
        if condition:
            if not self.home.version.meets(condition[1]):
                return
            line = line[condition.end() :]
        if line.startswith("#"):
            return
        keys = re.fullmatch(r"(.*?)<([^<> ]+)>", line)
        if line.startswith("$ "):
            self.end()
            self.terminal = Terminal(line[2:], self.folder, self.home.environment)
            self.count += 1
        elif line.startswith("?- "):
            self.answer(PROMPT, "the prompt")
            typed = line[3:]
            if typed in KEYS:
                self.terminal.until_edited()
            self.type(KEYS[typed] if typed in KEYS else typed + "\n", echo=typed not in KEYS)
            self.places = [number]
        elif line.startswith("|    "):
            self.answer(re.compile(r"(?:^|\n)\|\s+$"), "the prompt of a goal that goes on")
            self.type(line[5:] + "\n")
            self.places = [number]
        elif line.strip() in KEYS:
            self.seen()
            self.type(KEYS[line.strip()], echo=False)
        elif keys:
            self.expected.append(keys[1])
            self.seen()
            self.type(keys[2])
            self.places = [number]
        elif line.startswith("[exit "):
            self.status = int(line[6:].rstrip("]"))
        else:
            self.expected.append(line)
            if line.strip():
                self.places.append(number)

    def type(self, text, echo=True):
        self.terminal.send(text)
        self.expected = []
        self.places = []
        self.echo = echo
        self.typed = text
        self.enough = False
        self.count += 1

    def without_echo(self, text):
        """What was typed ends with the first line. It may stand there twice: what comes
        before the line editor listens is echoed by the terminal, too."""
        if not self.echo:
            return re.sub(r"^\^[CDZ]\n?", "", text)
        _, newline, rest = text.partition("\n")
        first, more, after = rest.partition("\n")
        if more and self.typed.strip() and PROMPT_START.sub("", first).strip() == self.typed.strip():
            rest = after
        return rest if newline else ""

    def answer(self, prompt, what):
        """The whole answer has come when the prompt comes."""
        self.terminal.until(lambda text: self.has_come(prompt, text), what)
        text = self.without_echo(self.terminal.news())
        self.check(text[: prompt.search(text).start()])

    def has_come(self, prompt, text):
        """Has the prompt come? Of a query in a paper the first answer is enough."""
        text = self.without_echo(text)
        if self.near and OPEN.search(text) and not self.enough:
            self.enough = True
            self.terminal.send("\n", keep=True)
        return prompt.search(text)

    def check(self, text):
        if self.show:
            print(text)
        if self.near:
            text = re.sub(r" \n?([.;])$", r"\1", text, flags=re.M)
            if "true." not in self.expected:
                text = re.sub(r"(?:^|\n)true\.\s*$", "\n", text)
            if not any(line.strip() for line in self.expected):
                if WRONG.search(text):
                    raise Wrong("no, or an error")
                return
        if not matches(self.expected, text, self.near):
            if not (self.renew and self.places):
                raise Wrong("another answer")
            self.renew(self.places, text)

    def seen(self):
        """What is expected has come, and no more."""
        if not self.terminal:
            raise Wrong("there is no command yet")
        self.terminal.until(
            lambda text: matches(self.expected, self.without_echo(text)), "what is expected"
        )

    def end(self):
        """The command before ends, by itself or by the end of its input."""
        if not self.terminal:
            return
        terminal = self.terminal
        terminal.until(lambda text: terminal.ended or self.has_come(PROMPT, text), "its end, or a prompt")
        if not terminal.ended:
            self.answer(PROMPT, "the prompt")
            self.type("halt.\n")
            self.expected = ["..."]
        status = terminal.wait()
        self.check(self.without_echo(terminal.news()))
        self.terminal = None
        self.expected = []
        self.echo = False
        if status != self.status:
            raise Wrong(f"status {status}, not {self.status}")
        self.status = 0


class Renewed:
    """A session with other answers."""

    def __init__(self, lines):
        self.lines = list(lines)
        self.renewed = [[line] for line in lines]

    def answer(self, places, text):
        """The answer text comes in the place of lines, whose numbers follow that of the query."""
        query, *numbers = places
        before = [re.fullmatch(r"(\{[^}]*\}\s?)?(.*)", self.lines[number - 1]).groups("") for number in places]
        asked, *before = before
        condition = before[0][0] if before and all(part[0] for part in before) else asked[0]
        came = [line.rstrip() for line in text.split("\n") if line.strip()]
        after = []
        for line in came:
            same = [old for old in before if old[1].strip() != "..." and agrees(old[1].rstrip(), line, False)]
            after.append("".join(same[0]) if same else condition + line)
        for number in numbers:
            self.renewed[number - 1] = []
        if numbers:
            self.renewed[numbers[0] - 1] = after
        else:
            self.renewed[query - 1] += after

    def text(self):
        return "\n".join(line for lines in self.renewed for line in lines)


def play(path, home, show, renew=False):
    """Plays a file: how often something was typed, and in words what was wrong, or None."""
    if path.suffix == ".md":
        sessions = list(Paper(path).plays(elsewhere()))
    else:
        text = path.read_text()
        only = re.search(r"^# only: (.*)$", text, re.M)
        sessions = [text.split("\n")] if not only or home.version.meets(only[1]) else []
    count = 0
    for lines in sessions:
        renewed = Renewed(lines)
        player = Player(home, show, near=path.suffix == ".md", renew=renewed.answer if renew else None)
        try:
            player.play(lines)
            if renew:
                path.write_text(renewed.text())
        except Wrong as wrong:
            came = player.without_echo(player.terminal.news()) if player.terminal else ""
            typed = player.typed.strip() or next((line for line in lines if line.startswith("$ ")), "")
            return count, (
                f"{path}:{player.number}: {wrong}\n  after {typed}\n  expected:\n"
                + indented("\n".join(player.expected))
                + "\n  came:\n"
                + indented(came)
            )
        count += player.count
    return count, None


def elsewhere():
    """The commands of papers that are run elsewhere."""
    lines = (HERE / "elsewhere.txt").read_text().split("\n")
    return {line.split("  #")[0].strip() for line in lines if line}


def stale():
    """How many of these stand in no paper."""
    known = {command for path in papers() for command in Paper(path).commands}
    gone = sorted(elsewhere() - known)
    for command in gone:
        print(f"FAILED elsewhere.txt: in no paper: {command}")
    return len(gone)


def indented(text):
    return "\n".join("    " + line for line in text.split("\n"))


def papers():
    """README.md and those in docs."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def main():
    parser = argparse.ArgumentParser(description="Plays sessions.")
    parser.add_argument("--show", action="store_true", help="print what comes")
    parser.add_argument("-j", type=int, default=4 * os.cpu_count(), dest="jobs", metavar="N",
                        help="so many files at once, as a terminal waits most of the time")
    parser.add_argument("--renew", action="store_true", help="write what comes into the sessions")
    parser.add_argument("file", nargs="*", type=Path)
    arguments = parser.parse_args()
    swipl = shutil.which(os.environ.get("SWIPL", "swipl"))
    if not swipl:
        sys.exit("play.py: there is no swipl")
    if arguments.renew and any(path.suffix == ".md" for path in arguments.file or [ROOT / "README.md"]):
        sys.exit("play.py: --renew is for sessions that are named, and not for papers")
    home = Home(swipl)
    failed = stale()
    passed = typed = 0
    files = arguments.file or sorted({*HERE.glob("*.txt")} - {HERE / "elsewhere.txt"}) + papers()
    files.sort(key=lambda path: -path.stat().st_size)
    playing = functools.partial(play, home=home, show=arguments.show, renew=arguments.renew)
    try:
        with multiprocessing.Pool(1 if arguments.show else arguments.jobs) as pool:
            for path, (count, wrong) in zip(files, pool.imap(playing, files, chunksize=1)):
                if count or wrong:
                    print(f"FAILED {wrong}" if wrong else f"ok     {path.name}: {count} times typed", flush=True)
                failed += wrong is not None
                passed += count > 0 and wrong is None
                typed += count
    finally:
        home.remove()
    print(f"{typed} lines and keys typed in SWI-Prolog {'.'.join(map(str, home.version))}")
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0)


main()
