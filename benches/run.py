#!/usr/bin/env python3
"""Benches: how fast is the pack, and compared with what?

    benches/run.py [--rounds N] [--no-callgrind]
    benches/run.py --part view
    benches/run.py --part rules
    benches/run.py --part localize
    benches/run.py --table
    benches/run.py --count
    benches/run.py --smoke

Five implementations of the same jobs over the same plain tree of 4 motors and 4
sensors:

    pack     library(ev3dev)
    paper    the paper's way in plain Prolog (benches/paper.pl)
    python   python-ev3dev2
    rust     the crate ev3dev-lang-rust
    floor    the bare preads and pwrites on kept descriptors

Each is one process that lives through the run. In each round every job is
measured once by everyone who does it, one after the other; what counts is the
median over the rounds, and ratios of medians. Writes benches/results.json, and
from that the tables of docs/performance.md and docs/localization.md; --table does the
latter alone. What cannot take part ends the run: no column is left out in silence. --part measures
one part again, and keeps the others; --count counts instructions again, and writes
benches/instructions.json.

--smoke measures nothing: in seconds it has each worker do each job a few times,
and makes sure that the papers have the figures of benches/results.json, if there is
one, and that no call takes 1 % more instructions than
benches/instructions.json says. It says so, and goes on, where python-ev3dev2 cannot be
installed, there is no FUSE, or instructions cannot be compared.
"""
import argparse
import json
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import view

TOP = Path(__file__).resolve().parent.parent
WORK = TOP / "target" / "bench"
RESULTS = TOP / "benches" / "results.json"
INSTRUCTIONS = TOP / "benches" / "instructions.json"
PAPERS = [TOP / "docs" / name for name in ("performance.md", "localization.md")]
SWIPL = os.environ.get("SWIPL", "swipl")
SWIPL_PACK = [SWIPL, "-p", f"library={TOP}/prolog"]

# What can be measured alone, by its name in the results.
PARTS = {"view": lambda: view.measure(10), "rules": lambda: rules(),
         "localize": lambda: localize()}

# Job: how often it is done in a round by the slow ones and by the fast ones
JOBS = {
    "us_dist_cm": (40, 4000),
    "col_ambient": (40, 4000),
    "gyro_ang": (40, 4000),
    "motor_run": (20, 2000),
    "position": (100, 6000),
    "state": (100, 6000),
    "enumerate": (100, 3000),
    "vehicle2": (10, 1000),
}
SLOW = {"paper", "python"}

MOTOR = {
    "command": ("", 0o664),
    "commands": ("run-forever run-to-abs-pos run-to-rel-pos run-timed "
                 "run-direct stop reset", 0o444),
    "count_per_rot": ("360", 0o444),
    "duty_cycle_sp": ("0", 0o664),
    "max_speed": ("1050", 0o444),
    "position": ("1234", 0o664),
    "position_sp": ("0", 0o664),
    "ramp_down_sp": ("0", 0o664),
    "ramp_up_sp": ("0", 0o664),
    "speed": ("0", 0o444),
    "speed_sp": ("0", 0o664),
    "state": ("running", 0o444),
    "stop_action": ("coast", 0o664),
    "stop_actions": ("coast brake hold", 0o444),
    "time_sp": ("0", 0o664),
}
SENSORS = {
    "lego-ev3-us": ("US-DIST-CM US-DIST-IN US-LISTEN", "1", "843"),
    "lego-ev3-color": ("COL-AMBIENT COL-REFLECT COL-COLOR", "0", "42"),
    "lego-ev3-gyro": ("GYRO-ANG GYRO-RATE GYRO-G&A", "0", "7"),
}


def write(directory, name, text, mode):
    path = directory / name
    path.write_text(text + "\n")
    path.chmod(mode)


def make_tree(root, motors):
    """A plain tree: `motors` large motors, and the paper's four sensors."""
    shutil.rmtree(root, ignore_errors=True)
    names = ["out" + c for c in "ABCD"] + [f"M{n}" for n in range(4, 64)]
    for number, port in enumerate(names[:motors]):
        directory = root / "tacho-motor" / f"motor{number}"
        directory.mkdir(parents=True)
        write(directory, "address", "ev3-ports:" + port, 0o444)
        write(directory, "driver_name", "lego-ev3-l-motor", 0o444)
        for name, (text, mode) in MOTOR.items():
            write(directory, name, text, mode)
    types = ["lego-ev3-us", "lego-ev3-color", "lego-ev3-color",
             "lego-ev3-gyro"]
    for number, kind in enumerate(types):
        modes, decimals, value = SENSORS[kind]
        directory = root / "lego-sensor" / f"sensor{number}"
        directory.mkdir(parents=True)
        write(directory, "address", f"ev3-ports:in{number + 1}", 0o444)
        write(directory, "driver_name", kind, 0o444)
        write(directory, "modes", modes, 0o444)
        write(directory, "mode", modes.split()[0], 0o664)
        write(directory, "decimals", decimals, 0o444)
        write(directory, "num_values", "1", 0o444)
        for index in range(8):  # which benches/rules.pl changes, as a normal user, too
            write(directory, f"value{index}", value, 0o644)


def choose_tree(tree):
    """The one path that is compiled into the rust worker leads to this tree."""
    root = WORK / "tree"
    root.unlink(missing_ok=True)
    root.symlink_to(tree)
    return root


def plain_tree():
    make_tree(WORK / "disk", 4)
    return choose_tree(WORK / "disk")


class Worker:
    """A process that measures."""

    def __init__(self, command, root, line="{} {} {}\n"):
        self.line = line
        self.process = subprocess.Popen(
            command, env={**os.environ, "EV3DEV_SYSFS": str(root)},
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            cwd=TOP)

    def ask(self, implementation, job, count):
        return self.ask_all(implementation, job, count)[0]

    def ask_all(self, implementation, job, count):
        self.process.stdin.write(self.line.format(implementation, job, count))
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            sys.exit(f"{implementation} gave no answer for {job}")
        return [float(word) for word in answer.split()]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def prolog_worker(root):
    return Worker([*SWIPL_PACK, "benches/worker.pl"], root,
                  "measure({}, {}, {}).\n")


def python_worker(root, is_smoke=False):
    python = WORK / "venv" / "bin" / "python"

    def has_ev3dev2():
        return python.exists() and not subprocess.run(
            [python, "-c", "import ev3dev2"], capture_output=True).returncode

    if not has_ev3dev2():
        for command in ([sys.executable, "-m", "venv", WORK / "venv"],
                        [python, "-m", "pip", "install", "-q", "python-ev3dev2==2.1.0.post1"]):
            if subprocess.run(command, capture_output=is_smoke).returncode:
                break
    if not has_ev3dev2():
        if not is_smoke:
            sys.exit("python-ev3dev2 cannot be installed: no column python")
        print("left out: python-ev3dev2 cannot be installed")
        return None
    return Worker([str(python), "benches/worker.py"], root)


def rust_worker(root, is_smoke=False):
    # Optimizing it takes minutes, which what measures nothing can do without
    profile, output = ("dev", "debug") if is_smoke else ("release", "release")
    target = WORK / f"rust-{output}"
    env = {**os.environ, "EV3DEV_DRIVER_PATH": f"{WORK}/tree/",
           "CARGO_TARGET_DIR": str(target)}
    built = subprocess.run(
        ["cargo", "build", "--profile", profile, "--locked", "--quiet",
         "--package", "ev3dev-bench"], cwd=TOP, env=env)
    if built.returncode:
        sys.exit("benches/rust cannot be built: no columns rust and floor")
    return Worker([str(target / output / "ev3dev-bench")], root)


def measure(root, rounds, plain=True, is_smoke=False):
    """Median seconds of each job, by implementation; on a plain tree also the
    gap between two wheels' commands and the share of CPU time while waiting
    for a motor that runs."""
    prolog, python, rust = (prolog_worker(root), python_worker(root, is_smoke),
                            rust_worker(root, is_smoke))
    workers = {"pack": prolog, "paper": prolog, "python": python,
               "rust": rust, "floor": rust}
    workers = {name: worker for name, worker in workers.items() if worker}
    missing = {("floor", "enumerate")}
    times = {job: {} for job in JOBS}
    for _ in range(rounds):
        for job, (few, many) in JOBS.items():
            for name, worker in workers.items():
                if (name, job) not in missing:
                    count = 2 if is_smoke else few if name in SLOW else many
                    seconds = worker.ask(name, job, count)
                    times[job].setdefault(name, []).append(seconds)
    result = {job: {name: statistics.median(all_of)
                    for name, all_of in by_name.items()}
              for job, by_name in times.items()}
    measured = {"seconds": result}
    if plain:
        few, many, wait = (3, 3, 0.1) if is_smoke else (101, 1001, 2)
        measured |= {
            "gap_seconds": {"pack": rust.ask("pack", "gap", many),
                            "paper": prolog.ask("paper", "gap", few)},
            "wait_cpu_share": {name: prolog.ask(name, "wait", wait)
                               for name in ("pack", "paper")}}
    for worker in {id(w): w for w in workers.values()}.values():
        worker.close()
    return measured


class NotMounted(Exception):
    """There is no FUSE here, or none for this user."""


class Mounted:
    """The simulator's tree through FUSE, with the real clock."""

    def __enter__(self):
        self.directory = tempfile.TemporaryDirectory()
        root = Path(self.directory.name) / "class"
        root.mkdir()
        # Where serve.pl shows the device files
        root.with_suffix(".dev").mkdir()
        goal = f"serve('{root}', 'benches/robot.pl')"
        self.process = subprocess.Popen(
            [*SWIPL_PACK, "-g", goal, "-t", "halt(1)", "tests/clients/serve.pl"],
            stdin=subprocess.PIPE, cwd=TOP)
        while not (root / "tacho-motor").is_dir():
            if self.process.poll() is not None:
                self.__exit__()
                raise NotMounted
            time.sleep(0.05)
        return root

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()
        self.directory.cleanup()


def latency(root):
    """Median and worst seconds from a motor's stop to the end of the wait for
    it, in the simulator, through FUSE, with the real clock."""
    worker = rust_worker(root)
    median, worst = worker.ask_all("pack", "latency", 100)
    worker.close()
    return {"median": median, "worst": worst}


def simulator():
    """Simulated seconds a second of a program that polls, and resident
    kilobytes early and late in a simulated hour."""
    said = subprocess.run(
        [*SWIPL_PACK, "benches/simulator.pl"], check=True, cwd=TOP,
        capture_output=True, text=True).stdout
    speed, early, late = map(int, said.split())
    return {"seconds_per_second": speed, "kilobytes_early": early,
            "kilobytes_late": late}


def drive():
    """The share of a core that the loop of a drive takes, in real time, over
    that of the simulator beside it, in several runs."""
    said = subprocess.run(
        [*SWIPL_PACK, "benches/drive.pl"], check=True, cwd=TOP,
        capture_output=True, text=True).stdout
    return sorted(map(float, said.split()))


def rules(is_smoke=False):
    """Of rules, in real time, over a plain tree: median and worst seconds from a
    sensor's change to the first write, by the number of rules; the share of a core
    that a hundred rules take, and a wait; seconds to note a command in the journal."""
    root = plain_tree()
    prolog = Worker([*SWIPL_PACK, "benches/rules.pl"], root, "{}({}, {}).\n")
    rust = rust_worker(root, is_smoke)
    changes, seconds, notes = (3, 0.1, 10) if is_smoke else (400, 10, 1000000)
    reaction = {}
    for count in (1, 10, 100):
        median, worst = prolog.ask_all("reaction", count, changes)
        reaction[count] = {"median": median, "worst": worst}
    result = {
        "reaction_seconds": reaction,
        "rules_cpu_share": prolog.ask("rules", 100, seconds),
        "wait_cpu_share": prolog.ask("wait", "idle", seconds),
        "journal_seconds": rust.ask("pack", "journal", notes)}
    for worker in (prolog, rust):
        worker.close()
    return result


# Case of benches/localize.pl: what it is
PLACES = {
    "room": "`room`, at most 3 looks around",
    "room_by_table": "the same with the EV3's table",
    "noise_doubled": "twice the noise, 12",
    "three_rooms_wide": "three rooms, 3",
    "real_sonar": "a sonar that misses echoes: `echo(in1, [incidence(40), miss(0.05), "
                  "spurious(0.02)])`, 1 cm of noise",
    "cone_25_believed_15": "a cone of 25 degrees, believed to have 15",
    "moved_box": "a box was moved by 54 cm, 6",
    "somebody_walks": "somebody walks through the room",
    "kidnapped": "carried elsewhere: noticed, then 2",
    "two_alike": "two rooms that look alike: two clusters, neither believed",
    "textbook": "particles spread and weighed one by one, as textbooks have it",
    "lejos": "leJOS's model: 200 particles, one ray, a bell curve",
}
DRIVES = {
    "drive": "`noise(true)`",
    "drive_by_table": "the same with the EV3's table",
    "drive_bad_odometry": "slip 2 %, a wheel 1 % small, axle 2 % long, a gyro that drifts",
    "drive_no_gyro": "the same without a gyro",
    "drive_real_sonar": "the sonar that misses",
}


def localize(seeds=20, minutes=20, cases=(*PLACES, *DRIVES)):
    """Of localization, for each case: how many seeds reached what is asked, the claims, how
    many of them are wrong; of drives the errors in cm."""
    output = subprocess.run(
        [*SWIPL_PACK, "-g", "main", "-t", "halt(1)", "benches/localize.pl", "--",
         str(seeds), str(minutes), *cases],
        capture_output=True, text=True, check=True, cwd=TOP).stdout
    measured = {}
    for line in output.splitlines()[1:]:
        case, reached, _, of, claims, wrong, *errors = line.split()
        measured[case] = {"reached": int(reached), "of": int(of), "claims": int(claims),
                          "wrong": int(wrong), "errors_cm": [float(error) for error in errors]}
    return measured


def localize_smoke():
    """Few seeds, with which it goes as always."""
    least = {"room": 4, "noise_doubled": 4, "three_rooms_wide": 4, "real_sonar": 3,
             "kidnapped": 4, "drive": 4}
    for case, result in localize(4, 1, (*least, "lejos")).items():
        if result["reached"] < least.get(case, 0) or result["wrong"]:
            sys.exit(f"localize, {case}: {result}")
        if case == "lejos" and result["reached"] > 1:
            sys.exit("leJOS's model is as good: what is compared?")


def growth(rounds):
    """Median seconds of position/2 with ever more motors."""
    times = {}
    with tempfile.TemporaryDirectory() as directory:
        workers = {}
        for motors in (2, 4, 16, 64):
            root = Path(directory) / str(motors)
            make_tree(root, motors)
            workers[motors] = prolog_worker(root)
        for _ in range(rounds):
            for motors, worker in workers.items():
                seconds = worker.ask("pack", "position", 6000)
                times.setdefault(motors, []).append(seconds)
        for worker in workers.values():
            worker.close()
    return {motors: statistics.median(all_of)
            for motors, all_of in times.items()}


def loading(rounds):
    """Median seconds and resident kilobytes of a Prolog that only starts, and
    of one that loads the library too."""
    memory = ("open('/proc/self/status', read, S), repeat, "
              "read_line_to_string(S, L), sub_string(L, 0, _, _, \"VmRSS\"), "
              "!, write(L), nl")
    goals = {"bare": "true", "library": "use_module(library(ev3dev))"}
    times, sizes = {}, {}
    for _ in range(rounds):
        for name, goal in goals.items():
            start = time.perf_counter()
            subprocess.run([*SWIPL_PACK, "-g", goal, "-t", "halt"], check=True)
            times.setdefault(name, []).append(time.perf_counter() - start)
            said = subprocess.run(
                [*SWIPL_PACK, "-g", f"{goal}, {memory}", "-t", "halt"],
                check=True, capture_output=True, text=True).stdout
            sizes.setdefault(name, []).append(int(said.split()[1]))
    return {name: {"seconds": statistics.median(times[name]),
                   "kilobytes": statistics.median(sizes[name])}
            for name in goals}


# By how much the instructions of a call may grow unnoticed
GROWTH = 1.01

COUNTED = {
    "loop": "true", "us_dist_cm": "us_dist_cm(_,_)", "col_ambient": "col_ambient(in2,_)",
    "motor_run": "motor_run(outD,50)", "position": "position(outB,_)",
    "state": "state(outB,_)"}


def instructions(root, times=80, calls=2):
    """Instructions a call of the five hottest predicates, in the loop of
    benches/calls.pl, and of that loop alone, by callgrind: what twice as many calls take
    more. Of each length the least of so many loops counts, as what the clock brings is in the
    others: the listing of devices, which is made again ten times a second. So one call comes
    before each loop, and the loops are short: some end before another process has its turn.
    The environment is always the same, as it moves what Prolog allocates."""
    with tempfile.TemporaryDirectory() as directory:
        subprocess.run(
            [shutil.which("valgrind"), "--tool=callgrind", "--zero-before=unsetenv", "--dump-before=getenv",
             f"--callgrind-out-file={directory}/out", *SWIPL_PACK, "--no-threads",
             "-g", f"count({times},{calls},[{','.join(COUNTED.values())}])",
             "-t", "halt(1)", "-g", "halt", "benches/calls.pl"],
            env={"PATH": "/usr/bin:/bin", "HOME": "/", "EV3DEV_SYSFS": str(root)},
            check=True, cwd=TOP, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        parts = Path(directory).glob("out.*")
        parts = sorted(parts, key=lambda part: int(part.suffix[1:]))
        totals = [int(part.read_text().split("\ntotals: ")[1].split()[0]) for part in parts]
    # The last one is of the end
    loops = totals[-2 * times * len(COUNTED) - 1:-1]
    least = [min(loops[first:first + times]) for first in range(0, len(loops), times)]
    return {job: (twice - once) / calls
            for job, once, twice in zip(COUNTED, least[::2], least[1::2])}


def counted_with():
    """What counts depend on, besides this tree."""
    version = [SWIPL, "-g", "current_prolog_flag(version,V),write(V)", "-t", "halt"]
    said = [subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
            for command in (version, ["rustc", "--version"])]
    return {"swipl": said[0], "rustc": said[1], "machine": platform.machine()}


def write_json(path, value):
    path.write_text(as_json(value) + "\n")


def as_json(value, indent="\n"):
    """A line for each part; what has only numbers and texts is one line."""
    if not isinstance(value, dict) or not any(
            isinstance(part, dict) for part in value.values()):
        return json.dumps(value)
    deeper = indent + "  "
    parts = [f"{deeper}{json.dumps(name)}: {as_json(part, deeper)}"
             for name, part in value.items()]
    return "{" + ",".join(parts) + indent + "}"


def write_instructions(root):
    write_json(INSTRUCTIONS, {"with": counted_with(), "counts": instructions(root)})


def compare_instructions(root):
    """Ends the program where a call takes more instructions than were written down."""
    if not shutil.which("valgrind"):
        print("left out: instructions, there is no valgrind here")
        return
    kept = json.loads(INSTRUCTIONS.read_text())
    if kept["with"] != counted_with():
        print("left out: instructions, which were counted with", *kept["with"].values())
        return
    # On a machine that hardly runs, what the clock brings may be in each loop: counted again
    for _ in range(3):
        counts = instructions(root)
        grown = [f"{job}: {counts[job]:.0f} instructions, not {known:.0f}"
                 for job, known in kept["counts"].items() if counts[job] > known * GROWTH]
        if not grown:
            break
    if grown:
        sys.exit("\n".join(grown) + "\nIf it is meant so: benches/run.py --count")
    print("instructions as before:", *(f"{job} {count:.0f}" for job, count in counts.items()))


CALLS = {
    "us_dist_cm": "`us_dist_cm(_, D)`",
    "col_ambient": "`col_ambient(in2, V)`",
    "gyro_ang": "`gyro_ang(_, A)`",
    "motor_run": "`motor_run(outD, 50)`",
    "position": "`position(outB, P)`",
    "state": "`state(outB, S)`",
    "enumerate": "enumerate 4 motors",
    "vehicle2": "a Braitenberg vehicle's step: 2 reads, 2 runs",
}
COLUMNS = {"pack": "this pack", "paper": "paper's way",
           "python": "python-ev3dev2", "rust": "ev3dev-lang-rust",
           "floor": "floor"}
TREES = {"disk": "on disk", "memory": "in memory"}


def us(seconds):
    """Microseconds, three digits of them."""
    number = seconds * 1e6
    return f"{number:.0f}" if number >= 100 else f"{number:.3g}"


def core_share(runs):
    """The median of these shares of a core, if it is more than they differ by."""
    median, least, most = statistics.median(runs), min(runs), max(runs)
    if median <= most - least:
        return f"less than {most:.1%} of a core, in each of {len(runs)} runs"
    return f"{median:.1%} of a core ({least:.1%} to {most:.1%} in {len(runs)} runs)"


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def tables(results):
    """The tables of docs/performance.md, by name."""
    written = {}
    for tree, measured in results["trees"].items():
        lines = [row("us a call, " + TREES[tree], *COLUMNS.values(), "pack / floor"),
                 "|---|---|---|---|---|---|---|"]
        for job, by_name in measured["seconds"].items():
            cells = [us(by_name[name]) if name in by_name else "-" for name in COLUMNS]
            ratio = (f"{by_name['pack'] / by_name['floor']:.1f}"
                     if "floor" in by_name else "-")
            lines.append(row(CALLS[job], *cells, ratio))
        written[tree] = lines
    plain = results["trees"]["disk"]
    gap, wait = plain["gap_seconds"], plain["wait_cpu_share"]
    load, latency = results["loading"], results["latency_seconds"]
    more = {key: load["library"][key] - load["bare"][key]
            for key in ("seconds", "kilobytes")}
    growth = results["growth_seconds"]
    written["more"] = [
        row("", "this pack", "paper's way"), "|---|---|---|",
        row("between the commands of two wheels", f"{us(gap['pack'])} us",
            f"{us(gap['paper'])} us, two threads"),
        row("CPU time while waiting 2 s for a motor", f"{wait['pack']:.1%}",
            f"{wait['paper']:.0%}"),
        row("from a motor's stop to the end of the wait, simulated, through FUSE",
            f"{latency['median'] * 1e3:.1f} ms, at worst "
            f"{latency['worst'] * 1e3:.1f} ms", ""),
        row("loading the library, over bare `swipl`",
            f"{more['seconds'] * 1e3:.0f} ms, {more['kilobytes'] / 1024:.1f} MB", ""),
        row("the loop that keeps a driving robot on its course",
            core_share(results["drive_share"]), ""),
        row(f"`position/2` with {', '.join(growth)} motors",
            " ".join(us(seconds) for seconds in growth.values()) + " us", ""),
        row("simulator, a program that polls its sensors",
            f"{results['simulator']['seconds_per_second']} simulated seconds a "
            "second", "")]
    written["rules"] = rules_table(results["rules"])
    written["view"] = view_table(results["view"])
    written["places"] = places_table(results["localize"])
    written["drives"] = drives_table(results["localize"])
    if INSTRUCTIONS.exists():
        counts = json.loads(INSTRUCTIONS.read_text())["counts"]
        written["instructions"] = [
            row("instructions a call, x86-64",
                *(job if job == "loop" else f"`{job}`" for job in counts)),
            "|---" * (len(counts) + 1) + "|",
            row("with the loop", *(f"{count:.0f}" for count in counts.values())),
            row("without", *(f"{count - counts['loop']:.0f}"
                             for count in counts.values()))]
    return written


def rules_table(measured):
    reaction = measured["reaction_seconds"]
    return [
        row("", *(f"{count} rules" if count != "1" else "1 rule" for count in reaction)),
        "|---" * (len(reaction) + 1) + "|",
        row("from a sensor's change to the first write of the new action: median",
            *(f"{seconds['median'] * 1e3:.1f} ms" for seconds in reaction.values())),
        row("at worst", *(f"{seconds['worst'] * 1e3:.1f} ms"
                          for seconds in reaction.values())),
        row("of a core", "", "", f"{measured['rules_cpu_share']:.1%}"),
        row("of a core, `wait/1` without rules", f"{measured['wait_cpu_share']:.1%}",
            "", ""),
        row("a motor's command in the journal",
            f"{us(measured['journal_seconds'])} us", "", "")]


def places_table(measured):
    return [row("case", "right", "wrong of its claims"), "|---|---|---|",
            *(row(what, f"{case['reached']} of {case['of']}",
                  f"{case['wrong']} of {case['claims']}" if case["claims"] else "never sure")
              for name, what in PLACES.items() for case in [measured[name]])]


def drives_table(measured):
    return [row("case", "median", "95 %", "99 %", "most", "wrong of its claims"),
            "|---|---|---|---|---|---|",
            *(row(what, *(f"{error:.1f}" for error in case["errors_cm"]),
                  f"{case['wrong']} of {case['claims']}")
              for name, what in DRIVES.items() for case in [measured[name]])]


def view_table(measured):
    return [
        row("", ""), "|---|---|",
        *(row(f"{count} page{'s' * (count != '1')}, {part['rate']:.0f} frames a second each"
              if part["rate"] else "no page", f"{part['share']:.1%} of a core")
          for count, part in measured["pages"].items()),
        *(row(what, f"{measured[name]['median'] * 1e3:.1f} ms, at worst "
                    f"{measured[name]['worst'] * 1e3:.1f} ms of ten")
          for what, name in (("STOP to the motors' `stop`", "stop_seconds"),
                             ("a motor's start until a page shows it", "seen_seconds")))]


def papers(results):
    """The papers with the tables of these results, each between two comments with its
    name."""
    texts = {paper: paper.read_text() for paper in PAPERS}
    for name, lines in tables(results).items():
        mark = f"<!-- {name}: by benches/run.py -->\n"
        paper = next(paper for paper, text in texts.items() if mark in text)
        before, _, after = texts[paper].split(mark)
        texts[paper] = before + mark + "\n".join(lines) + "\n" + mark + after
    return texts


def smoke():
    """Each worker does each job; the tables of the papers are up to date."""
    root = plain_tree()
    trees = ["disk"]
    measure(root, 1, is_smoke=True)
    rules(is_smoke=True)
    localize_smoke()
    try:
        with Mounted() as tree:
            measure(choose_tree(tree), 1, plain=False, is_smoke=True)
        trees.append("FUSE")
    except NotMounted:
        print("skipped: the tree through FUSE, which cannot be mounted here")
    if RESULTS.exists():
        for paper, text in papers(json.loads(RESULTS.read_text())).items():
            if text != paper.read_text():
                sys.exit(f"{paper.relative_to(TOP)} has other figures than "
                         "benches/results.json: benches/run.py --table")
    print("the bench answers:", ", ".join(trees))
    compare_instructions(plain_tree())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--no-callgrind", action="store_true")
    parser.add_argument("--part", choices=PARTS)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--count", action="store_true")
    parser.add_argument("--smoke", action="store_true")
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    if options.smoke:
        return smoke()
    if options.count:
        write_instructions(plain_tree())
    elif options.part:
        results = json.loads(RESULTS.read_text())
        results[options.part] = PARTS[options.part]()
        write_json(RESULTS, results)
    elif not options.table:
        run(options)
    results = json.loads(RESULTS.read_text())
    for paper, text in papers(results).items():
        paper.write_text(text)
    for lines in tables(results).values():
        print("\n".join(lines), end="\n\n")


def run(options):
    """Measures everything, and writes benches/results.json."""
    try:
        with Mounted():
            pass
    except NotMounted:
        sys.exit("nothing can be measured through FUSE: the simulator could not be mounted")
    if not options.no_callgrind and not shutil.which("valgrind"):
        sys.exit("valgrind is missing: install it, or say --no-callgrind")
    trees = {"disk": WORK / "disk"}
    if Path("/dev/shm").is_dir():
        trees["memory"] = Path("/dev/shm") / f"ev3dev-bench-{os.getpid()}"
    results = {"machine": platform.processor() or platform.machine(),
               "rounds": options.rounds, "trees": {}}
    for name, tree in trees.items():
        make_tree(tree, 4)
        results["trees"][name] = measure(choose_tree(tree), options.rounds)
    root = choose_tree(trees["disk"])
    results["latency_seconds"] = latency(root)
    results["simulator"] = simulator()
    results["growth_seconds"] = growth(options.rounds)
    results["loading"] = loading(options.rounds)
    results["drive_share"] = drive()
    for name, part in PARTS.items():
        results[name] = part()
    if not options.no_callgrind:
        write_instructions(root)
    for tree in trees.values():
        shutil.rmtree(tree)
    write_json(RESULTS, results)


if __name__ == "__main__":
    main()
