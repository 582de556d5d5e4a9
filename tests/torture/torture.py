#!/usr/bin/env python3
"""Random programs, each ended in some way: none ends, hangs or crashes with a motor running.

    tests/torture/torture.py [--count N] [--from SEED] [-j N]
    tests/torture/torture.py --seed N [--times K]     the program of one seed
    tests/torture/torture.py --show N                 prints it
    tests/torture/torture.py --self-test              does it find what is wrong?

A program has at most ten lines. Its seed says where it starts motors (main, threads, engines,
clean-ups, hooks), how it is started, what happens to the files, and how it ends: by itself, by
a limit, at a terminal, or by a signal. Then

    its process is over, 2.5 s after a signal that asks for it at the latest;
    no motor runs 0.5 s after that;
    1 s after it nothing is there that it started, but a `sleep` of its own;
    it printed no panic, nor the stack of a crash in the pack that nobody sent;
    while it stands by Ctrl-Z, no motor runs, and then it goes on.

SWI-Prolog itself crashes now and then when it halts while another thread starts, waits with a
time limit, or catches all that is to end it. That is counted apart: it may happen to one program
in 500, and to two of fewer.

It drives a plain tree of files, or the mount of a simulation in another process, if there is FUSE.
SWIPL names another Prolog. The time in which processes wait for a processor does not count, so a
busy machine judges as a quiet one, up to a load of twenty.
"""

import argparse
import collections
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from pathlib import Path

from judge import Run, Stage
from programs import BODIES, ENDINGS, STARTS, STRUCTURES, Program, known_bad
from trees import ROOT, Mount

LIBRARIES = ["ev3dev", *(f"ev3dev/{name}" for name in ("drive", "rules", "events", "golog", "sim"))]
FEATURES = {
    "engine": "predicate_property(system:engine_create(_,_,_), defined)",
    "cancel_halt": "predicate_property(system:cancel_halt(_), defined)",
    "fork": "catch((use_module(library(unix)), current_predicate(unix:fork/1)), _, fail)",
}


class Pack:
    """A copy of this pack, compiled as `make install` does, and a saved state."""

    def __init__(self, folder):
        self.swipl = shutil.which(os.environ.get("SWIPL", "swipl"))
        self.library = folder / "pack" / "prolog"
        self.state = folder / "state"
        for name in ("prolog", "lib"):
            shutil.copytree(ROOT / name, folder / "pack" / name, copy_function=shutil.copy2)
        shutil.copy2(ROOT / "pack.pl", folder / "pack")
        self.ask("use_module(library(ev3dev/compile)), ev3dev_compile")
        libraries = ",".join(f"library({name})" for name in LIBRARIES)
        (folder / "start.pl").write_text(
            f":- use_module([{libraries}]).\n:- dynamic(main/0).\n"
            "torture :- getenv('TORTURE_PROGRAM', File), load_files(user:File, []), main.\n")
        with tempfile.TemporaryDirectory() as disk:  # 7.2.3 saves none in /dev/shm
            self.ask(f"consult('{folder}/start.pl'), "
                     f"qsave_program('{disk}/state', [goal(torture), toplevel(halt)])")
            shutil.move(f"{disk}/state", self.state)
        asked = ", ".join(f"( {goal} -> writeln({name}) ; true )" for name, goal in FEATURES.items())
        answer = self.ask(f"{asked}, current_prolog_flag(version, V), writeln(V)").split()
        self.features = {name: name in answer for name in FEATURES}
        self.version = answer[-1]
        self.can_mount = True
        self.can_mount = self.mounts(folder / "trial")

    def ask(self, goal):
        """What Prolog prints."""
        return subprocess.run(
            [self.swipl, "-q", "-f", "none", "-p", f"library={self.library}", "-g", f"{goal}, halt", "-t", "halt(1)"],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=True, text=True).stdout

    def mounts(self, folder):
        """Can a tree be mounted?"""
        folder.mkdir()
        mount = Mount(folder, self.swipl, self.library)
        mount.close()
        return mount.works


def result_of(program, stage):
    """Runs a program: its wrongs, and whether a motor had to run."""
    run = Run(program, stage)
    run.play()
    return {"program": program, "wrong": run.wrong, "used": run.used,
            "crashed": run.crashed(), "output": run.output[-2000:]}


def work(folder, pack, next_seed, last, results):
    """A worker: programs as long as there are any."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    stage = Stage(folder, pack)
    try:
        while True:
            with next_seed.get_lock():
                seed = next_seed.value
                next_seed.value += 1
            if seed > last:
                break
            results.put(result_of(Program(seed, pack.features), stage))
    except Exception:  # the one who waits has to hear of it
        results.put(traceback.format_exc())
    finally:
        stage.close()


def torture(first, count, jobs, pack, folder):
    """Runs the programs of many seeds; yields their results."""
    next_seed, results = multiprocessing.Value("i", first), multiprocessing.SimpleQueue()
    workers = [
        multiprocessing.Process(target=work, args=(folder / f"worker{n}", pack, next_seed, first + count - 1, results))
        for n in range(jobs)
    ]
    for worker in workers:
        worker.start()
    try:
        for _ in range(count):
            result = results.get()
            if isinstance(result, str):
                sys.exit(f"a worker broke down:\n{result}")
            yield result
    finally:
        for worker in workers:
            worker.terminate() if sys.exc_info()[0] else None
            worker.join()


def report(result):
    """One failure, and how to see it again."""
    program = result["program"]
    word = "FAILED" if result["wrong"] else "ok    "
    print(f"{word} {program.shown()}")
    for kind, text in result["wrong"]:
        print(f"    -> {kind}: {text}")
    if result["wrong"]:
        print(f"    again: tests/torture/torture.py --seed {program.seed} --times 10", flush=True)


def table(title, rows, columns, cells):
    """Runs and failures by two kinds."""
    print(f"\n{title}: runs/failures\n   " + ", ".join(f"{n} {name}" for n, name in enumerate(columns, 1)))
    print(" " * 22 + "".join(f"{n:>7}" for n in range(1, len(columns) + 1)))
    for row in rows:
        shown = [cells.get((row, column), (0, 0)) for column in columns]
        print(f"{row:<22}" + "".join(f"{f'{runs}/{bad}' if bad else runs:>7}" for runs, bad in shown))


def summary(results, seconds, pack):
    """The tables, and the last lines."""
    sides = {
        "end": (ENDINGS, lambda program: program.kind()),
        "where": (list(STRUCTURES), lambda program: program.structure),
        "start": (STARTS, lambda program: program.start),
        "what": (list(BODIES), lambda program: program.body),
    }
    tables = (("end", "where"), ("end", "start"), ("what", "where")) if len(results) > 20 else ()
    for row, column in tables:
        cells = collections.defaultdict(lambda: (0, 0))
        for result in results:
            key = sides[row][1](result["program"]), sides[column][1](result["program"])
            cells[key] = cells[key][0] + 1, cells[key][1] + failed(result)
        table(f"{row}, {column}", sides[row][0], sides[column][0], cells)
    used = sum(result["used"] for result in results)
    crashed = [result["program"].seed for result in results if result["crashed"]]
    wrong = collections.Counter(kind for result in results if failed(result) for kind in dict(result["wrong"]))
    print(f"\n{len(results)} programs in SWI-Prolog {pack.version}, {seconds:.0f} s; in {used} of them a motor ran")
    if not pack.can_mount:
        print("skipped: the mount, as a tree cannot be mounted here")
    if crashed:
        print(f"in {len(crashed)} Prolog crashed, seeds {sorted(crashed)[:9]}")
    print(f"{sum(map(failed, results))} failed" + "".join(f", {kind}: {n}" for kind, n in sorted(wrong.items())))


def failed(result):
    """Is anything wrong?"""
    return bool(result["wrong"])


def self_test(pack, folder):
    """Programs that are known to be bad are found."""
    stage = Stage(folder / "worker", pack)
    missed = 0
    try:
        for kind, program in known_bad(pack.features):
            found = [kind for kind, _ in result_of(program, stage)["wrong"]]
            print(f"{'ok    ' if found == [kind] else 'MISSED'} {kind}: found {found}")
            missed += found != [kind]
    finally:
        stage.close()
    return missed


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--from", type=int, default=1, dest="first", metavar="SEED")
    parser.add_argument("-j", type=int, default=os.cpu_count(), dest="jobs", metavar="N")
    parser.add_argument("--seed", type=int, metavar="N")
    parser.add_argument("--times", type=int, default=1, metavar="K")
    parser.add_argument("--show", type=int, metavar="N")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))

    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    folder = Path(tempfile.mkdtemp(prefix="ev3dev-torture-", dir=memory))
    try:
        pack = Pack(folder)
        if arguments.show is not None:
            print(Program(arguments.show, pack.features).shown())
            return 0
        if arguments.self_test:
            return self_test(pack, folder)
        began = time.monotonic()
        results = []
        if arguments.seed is not None:
            stage = Stage(folder / "worker", pack)
            try:
                for _ in range(arguments.times):
                    results.append(result_of(Program(arguments.seed, pack.features), stage))
                    report(results[-1])
                    print(results[-1]["output"].decode(errors="replace").strip())
            finally:
                stage.close()
        else:
            for result in torture(arguments.first, arguments.count, arguments.jobs, pack, folder):
                results.append(result)
                if result["wrong"]:
                    report(result)
        summary(results, time.monotonic() - began, pack)
        # A run in which no motor ran says little
        idle = len(results) > 20 and 2 * sum(result["used"] for result in results) < len(results)
        crashes = sum(result["crashed"] for result in results) > max(2, len(results) // 500)
        return int(idle or crashes or any(map(failed, results)))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
