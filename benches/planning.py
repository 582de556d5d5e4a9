#!/usr/bin/env python3
"""Planning: achieve(Goal, [shortest(false)]) of library(ev3dev/golog) beside pyperplan.

    benches/planning.py [--rounds N]

Four problems as in planning competitions, the same PDDL for both. Each run is a
process of its own; counted is reading, grounding and searching, without the start of
Prolog or Python. Each plan of Golog is checked by tests/support/pddl_validator.pl. The
medians over the rounds are a table on standard output, that of
docs/cognitive-robotics.md. pyperplan, its greedy best-first search with the heuristic
hadd, is installed into target/bench.
"""
import argparse
import os
import random
import statistics
import subprocess
import sys
import venv
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
WORK = TOP / "target" / "bench" / "planning"
SWIPL = os.environ.get("SWIPL", "swipl")
DOMAINS = TOP / "tests" / "support" / "pddl"

ELEVATOR = """(define (domain elevator)
  (:requirements :strips :typing)
  (:types passenger floor - object)
  (:predicates (origin ?p - passenger ?f - floor) (destin ?p - passenger ?f - floor)
               (above ?f ?g - floor) (boarded ?p - passenger) (served ?p - passenger)
               (lift-at ?f - floor))
  (:action board :parameters (?f - floor ?p - passenger)
    :precondition (and (lift-at ?f) (origin ?p ?f)) :effect (boarded ?p))
  (:action depart :parameters (?f - floor ?p - passenger)
    :precondition (and (lift-at ?f) (destin ?p ?f) (boarded ?p))
    :effect (and (not (boarded ?p)) (served ?p)))
  (:action up :parameters (?f ?g - floor)
    :precondition (and (lift-at ?f) (above ?f ?g))
    :effect (and (lift-at ?g) (not (lift-at ?f))))
  (:action down :parameters (?f ?g - floor)
    :precondition (and (lift-at ?f) (above ?g ?f))
    :effect (and (lift-at ?g) (not (lift-at ?f)))))
"""

PYPERPLAN = """
import logging, sys, time
from pyperplan.grounding import ground
from pyperplan.heuristics.relaxation import hAddHeuristic
from pyperplan.pddl.parser import Parser
from pyperplan.search import greedy_best_first_search
start = time.perf_counter()
parser = Parser(sys.argv[1], sys.argv[2])
task = ground(parser.parse_problem(parser.parse_domain()))
plan = greedy_best_first_search(task, hAddHeuristic(task))
print(time.perf_counter() - start, 0, len(plan))
"""


def problem(domain, objects, init, goal):
    def facts(items):
        return " ".join(f"({item})" for item in items)

    return (f"(define (problem p) (:domain {domain}) (:objects {objects})\n"
            f"  (:init {facts(init)})\n  (:goal (and {facts(goal)})))\n")


def blocks(count, rng):
    names = [f"b{i}" for i in range(count)]

    def towers():
        left = rng.sample(names, count)
        while left:
            size = rng.randint(1, len(left))
            yield left[:size]
            left = left[size:]

    init, goal = ["handempty"], []
    for tower in towers():
        init += [f"ontable {tower[0]}", f"clear {tower[-1]}"]
        init += [f"on {upper} {lower}" for lower, upper in zip(tower, tower[1:])]
    for tower in towers():
        goal += [f"on {upper} {lower}" for lower, upper in zip(tower, tower[1:])]
    return problem("blocks", " ".join(names), init, goal or ["handempty"])


def logistics(count, rng):
    places = ["p0", "p1", "a0", "p2", "p3", "a1", "p4", "p5", "a2"]
    packages = [f"k{i}" for i in range(count)]
    init = [f"in-city {place} c{i // 3}" for i, place in enumerate(places)]
    init += [f"at t{i} p{2 * i}" for i in range(3)] + ["at f0 a0"]
    init += [f"at {package} {rng.choice(places)}" for package in packages]
    goal = [f"at {package} {rng.choice(places)}" for package in packages]
    return problem("logistics",
                   f"{' '.join(packages)} - package t0 t1 t2 - truck f0 - airplane "
                   "a0 a1 a2 - airport p0 p1 p2 p3 p4 p5 - place c0 c1 c2 - city",
                   init, goal)


def elevator(count, rng):
    floors = [f"f{i}" for i in range(count)]
    calls = [(f"p{i}", *rng.sample(floors, 2)) for i in range(count)]
    init = [f"above {low} {high}" for i, low in enumerate(floors)
            for high in floors[i + 1:]] + ["lift-at f0"]
    init += [f"origin {who} {start}" for who, start, _ in calls]
    init += [f"destin {who} {end}" for who, _, end in calls]
    return problem("elevator",
                   f"{' '.join(who for who, _, _ in calls)} - passenger "
                   f"{' '.join(floors)} - floor",
                   init, [f"served {who}" for who, _, _ in calls])


def gripper(count, _):
    balls = [f"b{i}" for i in range(count)]
    init = ["at-robby here", "free left", "free right"]
    return problem("gripper",
                   f"here there - room {' '.join(balls)} - ball left right - gripper",
                   init + [f"at {ball} here" for ball in balls],
                   [f"at {ball} there" for ball in balls])


PROBLEMS = {"blocks, 8 blocks": (blocks, 8), "logistics, 6 packages": (logistics, 6),
            "elevator, 8 calls": (elevator, 8), "gripper, 10 balls": (gripper, 10)}


def files(name):
    make, count = PROBLEMS[name]
    domain = DOMAINS / f"{make.__name__}.pddl"
    if make is elevator:
        domain = WORK / "elevator.pddl"
        domain.write_text(ELEVATOR)
    elif make is logistics:
        # pyperplan wants a type before those below it.
        text = domain.read_text()
        domain = WORK / "logistics.pddl"
        domain.write_text(text.replace("(:types package vehicle - thing",
                                       "(:types thing - object package vehicle - thing"))
    path = WORK / f"{make.__name__}-{count}.pddl"
    path.write_text(make(count, random.Random(1)))
    return domain, path


def pyperplan():
    python = WORK / "pyperplan" / "bin" / "python"
    if not python.exists():
        venv.create(python.parent.parent, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "-q", "pyperplan==2.1"],
                       check=True)
    return python


def run(command):
    """Seconds, inferences and steps of the plan."""
    text = subprocess.run([str(part) for part in command], check=True, text=True,
                          stdout=subprocess.PIPE, timeout=300).stdout
    return [float(word) for word in text.split()]


def main():
    arguments = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--rounds", type=int, default=5)
    rounds = arguments.parse_args().rounds
    WORK.mkdir(parents=True, exist_ok=True)
    workers = [([SWIPL, "-q", "-p", f"library={TOP}/prolog",
                 TOP / "benches" / "planning.pl"], ["[shortest(false)]"]),
               ([pyperplan(), "-c", PYPERPLAN], [])]
    print("| | inferences | steps | seconds | pyperplan: steps | seconds | ratio |")
    print("|---|---|---|---|---|---|---|")
    for name in PROBLEMS:
        runs = [[run([*command, *files(name), *options])
                 for command, options in workers] for _ in range(rounds)]
        ours, theirs = ([statistics.median(column) for column in zip(*rows)]
                        for rows in zip(*runs))
        inferences = f"{ours[1]:,.0f}".replace(",", " ")
        print(f"| {name} | {inferences} | {ours[2]:.0f} | {ours[0]:.3f} "
              f"| {theirs[2]:.0f} | {theirs[0]:.3f} | {ours[0] / theirs[0]:.1f} |",
              flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
