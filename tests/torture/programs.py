"""Random programs of a few lines that start motors, and how each of them is to end."""

import random
import signal

LINES = 10

# What is done with motors: library and goal.
SERVO = "'in3:i2c88:sv1'"
ROBOT = "set_robot(5.6, 10.6, outB, outC)"
LOOPS = {
    "loop": "repeat, us_dist_cm(_, D), S is min(100, D/2), motor_run(outB, S), fail",
    "loop that waits": "repeat, us_dist_cm(_, D), S is min(100, D/2), motor_run(outB, S), wait(0.01), fail",
    "loop that catches all": "repeat, catch((motor_run(outB, 50), wait(0.5)), _, true), fail",
    "loop of time limits": "repeat, catch(call_with_time_limit(0.05, wait(1)), _, true), "
    "catch(motor_run(outB, 50), _, true), fail",
    "loop that computes": "repeat, catch(call_with_time_limit(0.05, (repeat, fail)), _, true), motor_run(outB, 50), fail",
}
BODIES = {
    "motor_run/2": ("", "motor_run(outB, 50)"),
    "motor_run/3": ("", "motor_run(outC, -50, 100000)"),
    "motor_run/4": ("", "motor_run(outB, 50, 100000, [wait(false)])"),
    "run_forever": ("", "run_forever(outC, 300)"),
    "dc motor": ("", "dc_motor_run(outD, 50)"),
    "servo": ("", f"servo_motor_position({SERVO}, 50)"),
    "steer": ("drive", f"{ROBOT}, steer(40, 20)"),
    "go_cm": ("drive", f"{ROBOT}, go_cm(30, 500)"),
    "turn": ("drive", f"{ROBOT}, turn(30, 36000)"),
    "drive_cm": ("drive", f"{ROBOT}, drive_cm(10, 20)"),
    "go_to": ("drive", f"{ROBOT}, go_to(0, 300, [wait(false)])"),
    "behave": ("rules", "behave([ahead])"),
    "on": ("events", "on((us_dist_cm(_, D), D > 0), motor_run(outB, 50)), wait(0.1)"),
    "every": ("events", "every(0.05, motor_run(outB, 50)), wait(97)"),
    "until": ("events", "until(fail, (motor_run(outB, 50), wait(97)))"),
    "both": ("events", "both((motor_run(outB, 50), wait(97)), (run_forever(outC, 300), wait(97)))"),
    "race": ("events", "race([wait(97), (motor_run(outB, 50), wait(97))], _)"),
    "golog": ("golog", "indigolog(drive)"),
    **{name: ("", goal) for name, goal in LOOPS.items()},
}
FACTS = {
    "behave": "ahead :: us_dist_cm(_, D), D > 0 ~> motor_run(outB, 50).",
    "golog": "prim_action(step). robot_action(step, motor_run(outB, 50)). proc(drive, while(true, step)).",
}

# What main does until somebody ends the program.
RESTS = {
    "wait": "wait(97)",
    "sleep": "sleep(97)",
    "compute": "repeat, fail",
    "shell": "shell('sleep 97')",
    "process": "process_create(path(sleep), [97], [process(P)]), process_wait(P, _)",
    "read": "read(_)",
    "message": "thread_get_message(never)",
    **LOOPS,
}
THREAD_RESTS = ["true", "wait(97)", "sleep(97)", "read(_)", *LOOPS.values()]
NEEDED = {"ev3dev/events": "race(", "ev3dev/sim": "sim_start", "time": "time_limit", "process": "process_create",
          "unix": "fork("}
OWN = "sleep 97"  # what a program may leave: it is no part of the pack

AGAIN = ["motor_run(outC, -50)", "run_forever(outB, 300)", f"servo_motor_position({SERVO}, -50)"]

# Where the motors are started.
STRUCTURES = {
    "main": "go, note(ready), finish",
    "thread": "thread_create((go, more), _, []), note(ready), finish",
    "detached thread": "thread_create((go, more), _, [detached(true)]), note(ready), finish",
    "two threads": "thread_create((go, more), _, []), thread_create((again, wait(97)), _, []), note(ready), finish",
    "engine": "engine_create(x, (repeat, go), E), engine_next(E, _), note(ready), finish",
    "thread_at_exit": "thread_create((thread_at_exit(again), go, more), _, []), note(ready), finish",
    "clean-up in thread": "thread_create(setup_call_cleanup(true, (go, more), again), _, []), note(ready), finish",
    "clean-up in main": "setup_call_cleanup(true, (go, note(ready), finish), again)",
    "at_halt": "at_halt(again), go, note(ready), finish",
    "cancel_halt": "at_halt((retract(first) -> cancel_halt(no) ; true)), go, note(ready), finish",
    "queue": "thread_create((repeat, thread_get_message(G), ignore(G), fail), T, []), "
    "thread_send_message(T, go), note(ready), finish",
    "fork": "again, fork(P), ( P == child -> sleep(0.05), halt ; go, note(ready), finish )",
    "simulation": "go, sim_start(room, [clock(virtual), thinking(brick)]), "
    "thread_create((repeat, us_dist_cm(_, _), wait(0.1), fail), _, []), note(ready), finish",
}
SINGLE = ("main", "engine", "clean-up in main", "at_halt")

# How a program ends by itself.
FINISHES = {
    "end of main": "true",
    "halt": "halt",
    "halt(3)": "halt(3)",
    "halt in a thread": "rest",
    "error": "atom_length(_, _)",
    "failure": "fail",
    "thread_exit": "thread_exit(x)",
    "thread_exit in a race": "race([wait(1), thread_exit(x)], _)",
    "abort": "abort",
    "stack overflow": "catch(set_prolog_flag(stack_limit, 40000000), _, true), deep(0)",
    "memory": "numlist(1, 100000000, L), L = [_|_]",
}
# By a limit: which, a goal, and the seconds that it takes at most.
LIMITED = {
    "limit of time": ("cpu", "repeat, fail", 3),
    "limit of files' size": ("fsize", "open(log, append, S), repeat, writeln(S, 'what the robot does'), fail", 1.5),
    "limit of descriptors": ("nofile", "repeat, open('/dev/null', read, _), fail", 1),
}
LIMITS = ["nofile", "stack", "as", "cpu", "fsize"]

ASKING = [1, 2, 15]
CRASHES = [3, 4, 5, 6, 7, 8, 11, 31]
STANDING = [19, 20, 21, 22]
SIGNALS = [*range(1, 32), 34, 40, 64]
KEYS = {"Ctrl-C": "\x03", "Ctrl-\\": "\x1c", "Ctrl-Z": "\x1a"}

STARTS = ["goals on stdin", "-g main -t halt", "-g main", "initialization(main, main)", "initialization(main)",
          "script", "saved state", "timeout", "nohup", "terminal"]
TO_HALT = ("-g main -t halt", "initialization(main, main)", "script", "saved state", "timeout", "nohup")

FAULTS = ["motor vanishes", "command is a directory", "command is gone", "command is garbage", "state is garbage",
          "tree vanishes"]


def signal_name(number):
    """SIGTERM, or the number of a real-time signal."""
    return signal.Signals(number).name if number < 32 else f"signal {number}"


ENDINGS = [*FINISHES, *LIMITED, "end of input", "hang-up", *KEYS, "asking signal", "SIGKILL", "crash", "standing",
           "other signal"]


class Program:
    """The program of a seed, in a Prolog that has some features."""

    def __init__(self, seed, features):
        chance = random.Random(seed)
        self.seed = seed
        self.start = chance.choice(STARTS)
        self.structure = chance.choice([name for name in STRUCTURES if features.get(name, True)])
        self.body = chance.choice(list(BODIES))
        self.tree = "mount" if chance.random() < 0.25 and self.body != "dc motor" else "plain"
        self.moving = chance.random() < 0.7  # the states of a plain tree
        self.rest = chance.choice(list(RESTS))
        self.delay = chance.choice([0, 0, 0.02, 0.05, 0.1, 0.2, 0.4])
        self.pause = chance.choice(["true", "true", "wait(0.05)", "sleep(0.1)", "wait(0.3)"])
        self.stdin = chance.choice(["open", "closed"])
        self.more = chance.choice(THREAD_RESTS)
        self.again = chance.choice(AGAIN)
        self.fault = chance.choice(FAULTS) if chance.random() < 0.2 else None
        self.limit = chance.choice(LIMITS) if chance.random() < 0.1 else None
        self.signal = None
        self.twice = chance.random() < 0.15
        self.group = chance.random() < 0.25
        self.choose_ending(chance)
        if self.start in ("goals on stdin", "-g main", "initialization(main)") or self.ending == "end of input":
            self.stdin = "open"
        if self.structure == "fork":
            # The copy, which has no motors, is Prolog's own affair: interrupted, it would ask in
            # the debugger for ever, and after an exception by SIGFPE wait in malloc.
            asks = self.signal in ASKING and not (self.signal == signal.SIGINT and self.start == "goals on stdin")
            self.group = asks
        self.write()

    def choose_ending(self, chance):
        """By itself, by a limit, by what is typed, or by a signal."""
        at_keys = chance.random() < 0.4
        kind = chance.random()
        if self.start == "terminal" and at_keys:
            self.ending = chance.choice(["hang-up", *KEYS])
        elif kind < 0.35:
            self.ending = chance.choice(list(FINISHES))
        elif kind < 0.43:
            self.ending = chance.choice(list(LIMITED))
            self.limit, self.rest = LIMITED[self.ending][0], self.ending
        elif kind < 0.48:
            self.ending = "end of input"
            self.rest = chance.choice([self.rest, "read"])
        else:
            self.signal = chance.choice(chance.choice([ASKING, ASKING, [9], CRASHES, STANDING, SIGNALS, SIGNALS]))
            if self.start == "timeout" and self.signal in (17, *STANDING):
                self.signal = 15  # timeout(1) itself would stand, or never hear of the end
            self.ending = signal_name(self.signal)
        if self.ending == "memory":
            self.limit = "as"

    def kind(self):
        """The kind of the ending, for the table."""
        if self.signal is None:
            return self.ending
        for name, numbers in (("asking signal", ASKING), ("SIGKILL", [9]), ("crash", CRASHES), ("standing", STANDING)):
            if self.signal in numbers:
                return name
        return "other signal"

    def ends(self):
        """Does the program end when it has said that it does?"""
        if self.structure == "cancel_halt":
            return False
        if self.ending == "thread_exit":
            return self.structure in SINGLE
        return self.ending in ("halt", "halt(3)", "halt in a thread") or (
            self.ending in ("end of main", "error", "failure", "abort") and self.start in TO_HALT)

    def asks(self):
        """Does the signal ask for the end, or force it?"""
        if self.ending == "hang-up":
            return True
        if self.signal == 2:
            return self.start != "terminal" and self.rest != "shell"
        if self.signal == 1:
            return self.start != "nohup"
        return self.signal in (9, 15)

    def write(self):
        """Its lines."""
        library, goal = BODIES[self.body]
        lines = ["note(Word) :- writeln(Word), flush_output."]
        if self.body in FACTS:
            lines.append(FACTS[self.body])
        if self.structure == "cancel_halt":
            lines.append(":- dynamic(first/0). first.")
        lines.append(f"go :- {goal}.")
        main = STRUCTURES[self.structure]
        for name, text in (("more", self.more), ("again", self.again)):
            if name in main:
                lines.append(f"{name} :- {text}.")
        if self.ending in FINISHES:
            finish = FINISHES[self.ending]
            if self.ending == "stack overflow":
                lines.append("deep(X) :- deep(s(X)), true.")
            if self.ending == "halt in a thread":
                lines.append(f"rest :- {RESTS[self.rest]}.")
                finish = f"thread_create(({self.pause}, note(ends), halt(3)), _, [detached(true)]), rest"
            else:
                finish = f"{self.pause}, note(ends), {finish}"
        elif self.ending in LIMITED:
            finish = LIMITED[self.ending][1]
        else:
            finish = RESTS[self.rest]
        lines += [f"finish :- {finish}.", f"main :- {main}."]
        if self.start in ("initialization(main, main)", "script"):
            lines.append(":- initialization(main, main).")
        elif self.start == "initialization(main)":
            lines.append(":- initialization(main).")
        text = " ".join(lines)
        names = {f"ev3dev/{library}"} if library else set()
        names |= {name for name, call in NEEDED.items() if call in text}
        libraries = ", ".join(f"library({name})" for name in ["ev3dev", *sorted(names)])
        self.lines = [f":- use_module([{libraries}]).", *lines]
        assert len(self.lines) <= LINES, self.lines

    def shown(self):
        """What a person reads."""
        facts = [f"start: {self.start}", f"end: {self.ending}", f"tree: {self.tree}"]
        if self.tree == "plain" and self.moving:
            facts.append("states: running")
        if self.start != "terminal":
            facts.append(f"stdin: {self.stdin}")
        if self.signal or self.ending in KEYS or self.ending == "hang-up":
            facts.append(f"after {self.delay} s" + (", twice" if self.twice else ""))
            facts += ["to the group"] if self.group and self.signal else []
        facts += [f"fault: {self.fault}"] if self.fault else []
        facts += [f"limit: {self.limit}"] if self.limit else []
        return "\n".join([f"seed {self.seed}: " + "; ".join(facts), *("    " + line for line in self.lines)])


def known_bad(features):
    """Programs with what has to be found."""
    plain = {"start": "-g main -t halt", "structure": "main", "ending": "halt", "signal": None, "tree": "plain",
             "fault": None, "limit": None, "stdin": "closed", "rest": "wait", "group": False, "twice": False}
    for kind, goal, others in (
        ("runs", "set_prolog_flag(ev3dev_stop_at_halt, false), motor_run(outB, 50), note(ready), halt", {}),
        ("stays", "on_signal(term, _, stay), note(ready), repeat, sleep(1), fail", {"signal": 15, "ending": "SIGTERM"}),
        ("left", "shell('sleep 31 &'), note(ready), halt", {}),
        ("crash", "note(ready), writeln(\"thread 'robot' panicked at src/lib.rs\"), halt", {}),
    ):
        program = Program(0, features)
        vars(program).update({**plain, **others})
        program.lines = [":- use_module([library(ev3dev)]).", "stay(_).",
                         "note(Word) :- writeln(Word), flush_output.", f"main :- {goal}."]
        yield kind, program
