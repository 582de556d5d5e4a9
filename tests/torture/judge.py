"""Runs one program, does to it what is to be done, and says what is wrong with its end."""

import ctypes
import os
import pty
import re
import resource
import select
import signal
import stat
import subprocess
import time

from programs import CRASHES, FINISHES, KEYS, LIMITED, OWN, STANDING, TO_HALT
from trees import GUARD_S, Mount, Plain

END_S = 2.5  # from a signal to the end of the process
REST_S = 0.5  # from the end of the process, or a stop of it, to motors that rest
LEFT_S = 1.0  # from the end of the process to that of all that it started
HALT_S = 3.0  # from a program's own halt to motors that rest
START_S = 20.0
SHARE = 0.05  # of a processor, which the program has at least
LIMITS = {
    "nofile": (resource.RLIMIT_NOFILE, 32),
    "stack": (resource.RLIMIT_STACK, 512 << 10),
    "as": (resource.RLIMIT_AS, 500 << 20),
    "cpu": (resource.RLIMIT_CPU, 1),
    "fsize": (resource.RLIMIT_FSIZE, 64 << 10),
}
PANIC = re.compile(rb".*(?:panicked at|core::panicking).*")
OURS = re.compile(rb".*ev3dev\.so.*")  # in the stack of a crash
CRASH = re.compile(rb"\[FATAL|fatal signal")
PR_SET_CHILD_SUBREAPER = 36


def status(pid):
    """State and parent of a process; None if there is none."""
    try:
        with open(f"/proc/{pid}/stat", encoding="latin-1") as file:
            fields = file.read().rpartition(")")[2].split()
        # What has lost its main thread alone goes on
        threads = len(os.listdir(f"/proc/{pid}/task"))
    except OSError:
        return None
    return None if fields[0] in "ZX" and threads < 2 else (fields[0], int(fields[1]))


def command_of(pid):
    """Its command line."""
    try:
        with open(f"/proc/{pid}/cmdline", "rb") as file:
            return file.read().replace(b"\0", b" ").decode(errors="replace").strip()
    except OSError:
        return ""


class Stage:
    """Where one worker runs programs, one after the other."""

    def __init__(self, folder, pack):
        self.folder = folder
        self.pack = pack
        self.file = folder / "program.pl"
        # A group in another session would be an orphan, which Ctrl-Z does not stop
        os.setsid()
        # What loses its parent becomes a child of this process
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        folder.mkdir()
        self.plain = Plain(folder / "tree")
        self.mount = None

    def tree(self, name):
        """The tree of a program; plain where nothing can be mounted."""
        if name == "mount" and self.pack.can_mount:
            if self.mount is None or self.mount.server.poll() is not None:
                place = self.folder / f"served{time.monotonic_ns()}"
                place.mkdir()
                self.mount = Mount(place, self.pack.swipl, self.pack.library)
            if self.mount.works:
                return self.mount
        return self.plain

    def descendants(self):
        """What was started here and is still there, but the server of the mount."""
        parents = {}
        for name in os.listdir("/proc"):
            found = status(name) if name.isdigit() else None
            if found:
                parents.setdefault(found[1], []).append(int(name))
        server = self.mount.server.pid if self.mount else None
        found, new = [], [os.getpid()]
        while new:
            new = [child for pid in new for child in parents.get(pid, []) if child != server]
            found += new
        return found

    def clear(self):
        """Ends what is left, by its number."""
        deadline = time.monotonic() + GUARD_S
        while (left := self.descendants()) and time.monotonic() < deadline:
            for pid in left:
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    pass
            time.sleep(0.01)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            pass

    def close(self):
        """The end of a worker."""
        self.clear()
        if self.mount:
            self.mount.close()


class Run:
    """One run of one program."""

    def __init__(self, program, stage):
        self.program = program
        self.stage = stage
        self.tree = stage.tree(program.tree)
        self.output = b""
        self.wrong = []
        self.used = False
        self.said_at = {}
        self.ended_at = None
        self.delays = {}
        self.popen = None
        self.leader = None
        self.reads = None

    # Processes

    def command(self):
        """How it is started."""
        swipl, file = self.stage.pack.swipl, str(self.stage.file)
        plain = [swipl, "-q", "-f", "none"]
        halting = [*plain, "-g", "main", "-t", "halt", file]
        return {
            "-g main -t halt": halting,
            "-g main": [*plain, "-g", "main", file],
            "script": [file],
            "saved state": [swipl, "-x", str(self.stage.pack.state)],
            "timeout": ["timeout", "-s", str(self.program.signal or 15), "1", *halting],
            "nohup": ["nohup", *halting],
        }.get(self.program.start, [*plain, file])

    def prepare(self):
        """In the child: nothing is ignored or blocked, and there are limits."""
        for number in range(1, signal.NSIG):
            try:
                signal.signal(number, signal.SIG_DFL)
            except (OSError, ValueError):
                pass
        signal.pthread_sigmask(signal.SIG_SETMASK, [])
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if self.program.limit:
            which, soft = LIMITS[self.program.limit]
            resource.setrlimit(which, (soft, resource.getrlimit(which)[1]))

    def start(self):
        """Starts the program, which types its goal if it has to."""
        stage, program = self.stage, self.program
        self.tree.fresh(program.moving)
        head = f"#!{stage.pack.swipl}\n" if program.start == "script" else ""
        head += f":- asserta(user:file_search_path(library, '{stage.pack.library}')).\n"
        head += ":- catch(set_prolog_flag(ev3dev_hints, off), _, true).\n"
        stage.file.write_text(head + "\n".join(program.lines) + "\n")
        stage.file.chmod(stat.S_IRWXU)
        environment = {
            **os.environ, "EV3DEV_SYSFS": str(self.tree.root), "EV3DEV_DEV": str(self.tree.dev), "TERM": "xterm",
            "HOME": str(stage.folder), "TMPDIR": str(stage.folder), "TORTURE_PROGRAM": str(stage.file),
        }
        self.started_at = time.monotonic()
        if program.start == "terminal":
            self.start_on_terminal(environment)
            return
        self.popen = subprocess.Popen(
            self.command(), cwd=stage.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            stdin=subprocess.PIPE if program.stdin == "open" else subprocess.DEVNULL,
            preexec_fn=lambda: (os.setpgid(0, 0), self.prepare()))
        self.pid = self.popen.pid
        self.reads = self.popen.stdout.fileno()
        if program.start == "goals on stdin":
            self.popen.stdin.write(b"main.\n")
            self.popen.stdin.flush()

    def start_on_terminal(self, environment):
        """As a shell does: the leader waits for the program, which is in the foreground."""
        told, tells = os.pipe()
        self.leader, self.reads = pty.fork()
        if self.leader == 0:
            try:
                job = os.fork()
                if job == 0:
                    os.setpgid(0, 0)
                    signal.signal(signal.SIGTTOU, signal.SIG_IGN)
                    os.tcsetpgrp(0, os.getpid())
                    os.chdir(self.stage.folder)
                    self.prepare()
                    os.execvpe(self.command()[0], self.command(), environment)
                os.write(tells, str(job).encode())
                for number in (signal.SIGTERM, signal.SIGHUP):  # which `nohup` has ignored
                    signal.signal(number, signal.SIG_DFL)
                os.waitpid(job, 0)
            finally:
                os._exit(0)
        os.close(tells)
        self.pid = int(os.read(told, 32))
        os.close(told)
        self.wait(START_S, lambda: b"?- " in self.output)
        self.type("main.\n")

    def type(self, text):
        """Types at the terminal."""
        try:
            os.write(self.reads, text.encode())
        except OSError:  # there is none any more
            pass

    def ended(self):
        """Is the process over?"""
        if self.ended_at is None:
            over = status(self.pid) is None if self.popen is None else self.popen.poll() is not None
            self.ended_at = time.monotonic() if over else None
        return self.ended_at is not None

    def look(self, seconds=0.005):
        """Waits for a moment, or for what the program prints."""
        if self.reads is None:
            time.sleep(seconds)
        elif select.select([self.reads], [], [], seconds)[0]:
            try:
                text = os.read(self.reads, 65536)
            except OSError:
                text = b""
            if not text:
                self.close_output()
            self.output = (self.output + text)[-100000:]
            for word in (b"ready", b"ends"):
                if word in self.output:
                    self.said_at.setdefault(word, time.monotonic())
            time.sleep(0.001)

    def close_output(self):
        """Closes the reading end, or the terminal."""
        if self.reads is not None:
            if self.popen:
                self.popen.stdout.close()
            else:
                os.close(self.reads)
            self.reads = None

    def wait(self, seconds, condition):
        """Waits until the condition holds, and says whether it does. The time in which
        the program or the simulation waits for a processor does not count."""
        began, before, looked, waiting = time.monotonic(), self.delay(), 0.0, None
        while not condition():
            passed = time.monotonic() - began
            if passed >= seconds and passed >= looked + 0.2:
                looked = passed
                if max(passed - (self.delay() - before), SHARE * passed) < seconds:
                    waiting = None
                elif waiting is None:
                    waiting = self.waiting()
                elif not waiting & self.waiting():
                    return False
            self.look()
        return True

    def delay(self):
        """For how many seconds threads of these processes have waited for a processor."""
        self.delays.update((thread, int(fields[1])) for thread, _, fields in self.threads())
        return sum(self.delays.values()) / 1e9

    def waiting(self):
        """The threads that could run, each with what it has run. The kernel counts a time of
        waiting for a processor when it is over."""
        return {(thread, *fields) for thread, state, fields in self.threads() if state == "R"}

    def threads(self):
        """Of these processes: each with its state, and what the kernel counts of its turns."""
        server = [self.stage.mount.server.pid] if self.stage.mount else []
        for pid in [*server, *self.stage.descendants()]:
            try:
                for thread in os.listdir(f"/proc/{pid}/task"):
                    with open(f"/proc/{pid}/task/{thread}/schedstat", encoding="ascii") as file:
                        fields = file.read().split()
                    with open(f"/proc/{pid}/task/{thread}/stat", encoding="latin-1") as file:
                        yield thread, file.read().rpartition(")")[2].split()[0], fields
            except (OSError, IndexError):
                pass

    def send(self, number):
        """Sends a signal to the process, or to its group."""
        try:
            (os.killpg if self.program.group else os.kill)(self.pid, number)
        except OSError:
            pass

    # The course of a run

    def play(self):
        """Runs it, and judges."""
        try:
            self.start()
            self.wait(START_S, self.is_under_way)
            self.used = bool(self.tree.running())
            self.spoil()
            if not self.ended():
                self.end()
            self.used = self.used or self.tree.used()
            self.after_end()
            self.read_output()
        finally:
            self.stage.clear()
            self.close_output()
            if self.popen:
                self.popen.wait()
                if self.popen.stdin:
                    self.popen.stdin.close()

    def is_under_way(self):
        """Does a motor run, or has there been time for it?"""
        ready = self.said_at.get(b"ready")
        return self.ended() or bool(self.tree.running()) or (ready and time.monotonic() > ready + 0.3)

    def spoil(self):
        """The fault, of a motor that runs."""
        if self.program.fault and not self.ended():
            ports = self.tree.running() or ["outB"]
            self.tree.spoil(self.program.fault, ports[self.program.seed % len(ports)])

    def end(self):
        """What is to end it; if it need not end by that, SIGTERM."""
        program = self.program
        if program.ending in FINISHES:
            self.finish()
        elif program.ending in LIMITED:
            self.wait(LIMITED[program.ending][2], self.ended)
        elif program.ending == "end of input":
            self.end_input()
        elif program.start == "timeout" and program.signal:
            self.give_time(program.signal, self.started_at + 1 - time.monotonic())
        else:
            self.wait(program.delay, self.ended)
            self.by_hand()
        if not self.ended() and "stays" not in dict(self.wrong):
            self.send(signal.SIGTERM)
            self.must_end("SIGTERM")

    def finish(self):
        """It ends by itself, unless it is to go on."""
        program = self.program
        said = self.wait(1.0 if program.ends() else 0.5, lambda: self.ended() or b"ends" in self.said_at)
        if not (said and program.ends()):
            self.wait(0.2, self.ended)
        elif not self.wait(HALT_S, self.ended) and (ports := self.tree.running()):
            self.add("hangs", f"{HALT_S} s after {program.ending} it is there, and {ports} run")

    def end_input(self):
        """The other end of its input is closed."""
        if self.popen is None:
            self.type("\x04")
        else:
            self.popen.stdin.close()
        self.wait(0.8 if self.program.rest == "read" or self.program.start not in TO_HALT else 0.1, self.ended)

    def give_time(self, number, seconds):
        """Waits for a signal that another process sends, and then for the end."""
        self.wait(max(0, seconds), self.ended)
        if self.program.asks():
            self.must_end(f"signal {number}")
        else:
            self.wait(1.0, self.ended)

    def by_hand(self):
        """A signal, keys, or the end of the terminal."""
        program = self.program
        times = 2 if program.twice else 1
        if program.ending == "hang-up":
            self.close_output()
        elif program.ending in KEYS:
            # At once: a second Ctrl-Z that the kernel reads after SIGCONT stops it again
            self.type(KEYS[program.ending] * times)
        else:
            for _ in range(times):
                self.send(program.signal)
        if program.signal in STANDING or program.ending == "Ctrl-Z":
            self.stand()
        elif program.asks():
            self.must_end(program.ending)
        else:
            crash = program.signal in CRASHES or program.ending == "Ctrl-\\"
            self.wait(1.5 if crash else 0.5, self.ended)

    def must_end(self, why):
        """It has been asked to."""
        if not self.wait(END_S, self.ended):
            ports = self.tree.running()
            self.add("stays", f"{END_S} s after {why} it is there" + (f", and {ports} run" if ports else ""))

    def stand(self):
        """It stands, with motors that rest, and goes on."""
        state = lambda: (status(self.pid) or "?")[0]
        may_run = self.program.signal == signal.SIGSTOP  # nobody can do anything then
        rests = lambda: state() == "T" and (may_run or not self.tree.running())
        if not self.wait(REST_S, lambda: self.ended() or rests()):
            self.add("stands", f"{REST_S} s after {self.program.ending} its state is {state()}, "
                     f"and {self.tree.running()} run")
        self.send(signal.SIGCONT)
        if not self.wait(REST_S, lambda: self.ended() or state() != "T"):
            self.add("stands", "after SIGCONT it does not go on")

    def after_end(self):
        """No motor runs, and no process is left."""
        if not self.ended():
            return
        rest = lambda: not self.tree.running()
        if not self.wait(self.ended_at + REST_S - time.monotonic(), rest) and not rest():
            self.add("runs", f"{self.tree.running()} run {REST_S} s after the end, which was {self.how_ended()}")
        # A copy of the program got the signal, too, and has as long
        limit = END_S if self.program.structure == "fork" else LEFT_S
        if not self.wait(self.ended_at + limit - time.monotonic(), lambda: not self.left()) and self.left():
            self.add("left", f"{limit} s after the end there are {[command_of(pid) for pid in self.left()]}")

    def how_ended(self):
        """Its status."""
        return f"with {self.popen.returncode}" if self.popen else "at a terminal"

    def left(self):
        """What the program has left: not the leader of its terminal, nor a command of its own."""
        return [pid for pid in self.stage.descendants() if pid != self.leader and OWN not in command_of(pid)]

    def may_crash(self):
        """Was a crash the aim, or can it come of what the program lacks?"""
        program = self.program
        return program.signal in CRASHES or program.limit or program.ending == "Ctrl-\\"

    def read_output(self):
        """Nothing of the pack panics, or crashes unless that was the aim."""
        self.look(0)
        for pattern in (PANIC,) if self.may_crash() else (PANIC, OURS):
            if found := pattern.search(self.output):
                self.add("crash", found[0].decode(errors="replace").strip()[:200])

    def crashed(self):
        """Did Prolog crash, though that was not the aim?"""
        code = self.popen.returncode if self.popen else 0
        return not self.may_crash() and (-code in CRASHES or bool(CRASH.search(self.output)))

    def add(self, kind, text):
        """One more thing that is wrong."""
        self.wrong.append((kind, text))
