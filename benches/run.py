#!/usr/bin/env python3
"""Benches: how fast is the pack, and compared with what?

    benches/run.py [--rounds N] [--no-callgrind]

Five implementations of the same jobs over the same plain tree of 4 motors and 4
sensors:

    pack     library(ev3dev)
    paper    the paper's way in plain Prolog (benches/paper.pl)
    python   python-ev3dev2
    rust     the crate ev3dev-lang-rust
    floor    the bare preads and pwrites on kept descriptors

Each is one process that lives through the run. In each round every job is
measured once by everyone who does it, one after the other; what counts is the
median over the rounds, and ratios of medians. Prints a table and writes
benches/results.json. python and rust take part where they could be installed.
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

TOP = Path(__file__).resolve().parent.parent
WORK = TOP / "target" / "bench"
SWIPL = os.environ.get("SWIPL", "swipl")
SWIPL_PACK = [SWIPL, "-p", f"library={TOP}/prolog"]

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
        for index in range(8):
            write(directory, f"value{index}", value, 0o444)


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


def python_worker(root):
    venv = WORK / "venv"
    python = venv / "bin" / "python"
    steps = ([sys.executable, "-m", "venv", venv],
             [python, "-m", "pip", "install", "-q", "python-ev3dev2==2.1.0.post1"])
    done = python.exists() or all(
        subprocess.run(step).returncode == 0 for step in steps)
    return Worker([str(python), "benches/worker.py"], root) if done else None


def rust_worker(root):
    env = {**os.environ, "EV3DEV_DRIVER_PATH": f"{root}/",
           "CARGO_TARGET_DIR": str(WORK / "rust")}
    built = subprocess.run(
        ["cargo", "build", "--release", "--locked", "--quiet",
         "--manifest-path", TOP / "benches/rust/Cargo.toml"], env=env)
    if built.returncode:
        return None
    return Worker([str(WORK / "rust/release/ev3dev-bench")], root)


def measure(root, rounds, plain=True):
    """Median seconds of each job, by implementation; on a plain tree also the
    gap between two wheels' commands and the share of CPU time while waiting
    for a motor that runs."""
    prolog, python, rust = (prolog_worker(root), python_worker(root),
                            rust_worker(root))
    workers = {"pack": prolog, "paper": prolog, "python": python,
               "rust": rust, "floor": rust}
    missing = {("floor", "enumerate")}
    times = {job: {} for job in JOBS}
    # Each access costs some 10 us more through FUSE
    less = 1 if plain else 5
    for _ in range(rounds):
        for job, (few, many) in JOBS.items():
            for name, worker in workers.items():
                if worker and (name, job) not in missing:
                    count = (few if name in SLOW else many) // less
                    seconds = worker.ask(name, job, count)
                    times[job].setdefault(name, []).append(seconds)
    result = {job: {name: statistics.median(all_of)
                    for name, all_of in by_name.items()}
              for job, by_name in times.items()}
    measured = {"seconds": result}
    if plain:
        gaps = {"paper": prolog.ask("paper", "gap", 101)}
        if rust:
            gaps["pack"] = rust.ask("pack", "gap", 1001)
        waits = {name: prolog.ask(name, "wait", 1)
                 for name in ("pack", "paper")}
        measured |= {"gap_seconds": gaps, "wait_cpu_share": waits}
    for worker in {id(w): w for w in workers.values() if w}.values():
        worker.close()
    return measured


class Mounted:
    """The simulator's tree through FUSE, with the real clock."""

    def __enter__(self):
        self.directory = tempfile.TemporaryDirectory()
        root = Path(self.directory.name)
        goal = f"serve('{root}', 'benches/robot.pl')"
        self.process = subprocess.Popen(
            [*SWIPL_PACK, "-g", goal, "-t", "halt(1)", "tests/clients/serve.pl"],
            stdin=subprocess.PIPE, cwd=TOP)
        while not (root / "tacho-motor").is_dir():
            if self.process.poll() is not None:
                sys.exit("the simulator could not be mounted")
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
    if not worker or not Path("/dev/fuse").exists():
        return None
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
    that of the simulator beside it."""
    said = subprocess.run(
        [*SWIPL_PACK, "benches/drive.pl"], check=True, cwd=TOP,
        capture_output=True, text=True).stdout
    driving, running = map(float, said.split())
    return {"driving": driving, "running": running}


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


def instructions(root):
    """Instructions a call, of the five hottest predicates: callgrind's count
    of 2000 calls less that of 1000. The same in every run."""
    goals = {
        "us_dist_cm": "us_dist_cm(_,_)", "col_ambient": "col_ambient(in2,_)",
        "motor_run": "motor_run(outD,50)", "position": "position(outB,_)",
        "state": "state(outB,_)"}
    result = {}
    for job, goal in goals.items():
        counts = []
        for calls in (1000, 2000):
            said = subprocess.run(
                ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                 *SWIPL_PACK, "-g", "use_module(library(ev3dev))",
                 "-g", f"forall(between(1,{calls},_),once({goal}))", "-t", "halt"],
                env={**os.environ, "EV3DEV_SYSFS": str(root)}, check=True,
                capture_output=True, text=True).stderr
            counts.append(int(said.split("Collected :")[1].split()[0]))
        result[job] = (counts[1] - counts[0]) / 1000
    return result


def table(results):
    names = ["pack", "paper", "python", "rust", "floor"]
    for tree, measured in results["trees"].items():
        title = "us a call, tree " + {
            "disk": "on disk", "memory": "in memory", "FUSE": "through FUSE"}[tree]
        print(f"\n{title:<28}" + "".join(f"{n:>10}" for n in names)
              + f"{'paper/pack':>12}{'pack/floor':>12}")
        for job, by_name in measured["seconds"].items():
            cells = "".join(f"{by_name[n] * 1e6:>10.2f}" if n in by_name
                            else f"{'-':>10}" for n in names)
            ratio = by_name["paper"] / by_name["pack"]
            floor = (f"{by_name['pack'] / by_name['floor']:>12.2f}"
                     if "floor" in by_name else f"{'-':>12}")
            print(f"{job:<28}{cells}{ratio:>12.0f}{floor}")
        if "gap_seconds" not in measured:
            continue
        print("between the commands of two wheels: " + ", ".join(
            f"{n} {s * 1e6:.1f} us"
            for n, s in measured["gap_seconds"].items()))
        print("CPU time while waiting 2 s: " + ", ".join(
            f"{n} {s * 100:.2f} %"
            for n, s in measured["wait_cpu_share"].items()))
    print()
    load = results["loading"]
    more = {key: load["library"][key] - load["bare"][key]
            for key in ("seconds", "kilobytes")}
    print(f"loading: {more['seconds'] * 1e3:.0f} ms and "
          f"{more['kilobytes']:.0f} kB over bare swipl")
    print("position/2 with more motors: " + ", ".join(
        f"{n}: {s * 1e6:.2f} us" for n, s in results["growth_seconds"].items()))
    print("simulator: {seconds_per_second} simulated seconds a second; "
          "{kilobytes_early} kB after 6 min, {kilobytes_late} kB after an hour"
          .format(**results["simulator"]))
    print("the loop of a drive: {:.2f} % of a core".format(
        100 * (results["drive_share"]["driving"]
               - results["drive_share"]["running"])))
    if results["latency_seconds"]:
        print("from a motor's stop to the end of the wait, through FUSE: "
              + ", ".join(f"{name} {s * 1e3:.1f} ms" for name, s
                          in results["latency_seconds"].items()))
    if "instructions" in results:
        print("instructions a call: " + ", ".join(
            f"{job} {n:.0f}" for job, n in results["instructions"].items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--no-callgrind", action="store_true")
    options = parser.parse_args()
    trees = {"disk": WORK / "disk"}
    if Path("/dev/shm").is_dir():
        trees["memory"] = Path("/dev/shm") / f"ev3dev-bench-{os.getpid()}"
    # The one path that is compiled into the rust worker
    root = WORK / "tree"
    results = {"machine": platform.processor() or platform.machine(),
               "rounds": options.rounds, "trees": {}}
    for name, tree in trees.items():
        make_tree(tree, 4)
        root.unlink(missing_ok=True)
        root.symlink_to(tree)
        results["trees"][name] = measure(root, options.rounds)
    if Path("/dev/fuse").exists():
        with Mounted() as tree:
            root.unlink()
            root.symlink_to(tree)
            results["trees"]["FUSE"] = measure(root, options.rounds, False)
    root.unlink()
    root.symlink_to(trees["disk"])
    results["latency_seconds"] = latency(root)
    results["simulator"] = simulator()
    results["growth_seconds"] = growth(options.rounds)
    results["loading"] = loading(options.rounds)
    results["drive_share"] = drive()
    if not options.no_callgrind and shutil.which("valgrind"):
        results["instructions"] = instructions(root)
    for tree in trees.values():
        shutil.rmtree(tree)
    table(results)
    (TOP / "benches/results.json").write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    main()
