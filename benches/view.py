#!/usr/bin/env python3
"""What library(ev3dev/view) costs: processor time of its threads, and delays.

    benches/view.py [--seconds S] [--strangers]

A toplevel with a simulated robot that drives in the room, at x1 of the virtual
clock; and pages, as small as can be, that ask for 20 frames a second. Processor time
is that of all threads but the program's, as a share of one core. Beside it the time
from STOP to the motors' `stop`, and from a motor's start until a page shows it.
benches/run.py measures it, too.

With --strangers instead: how long, at worst, a new page, the next frame of an open one
and the stop of a motor take while so many connections without a token are kept up.
"""
import argparse
import base64
import json
import multiprocessing
import os
import socket
import statistics
import struct
import subprocess
import threading
import time
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
SWIPL = os.environ.get("SWIPL", "swipl")
TOKEN = "bench_token"


class Page:
    """A websocket of the view."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.read = b""
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /ws HTTP/1.1\r\nHost: localhost:{port}\r\nOrigin: http://localhost:{port}\r\n"
            f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
            f"Sec-WebSocket-Key: {key}\r\nCookie: ev3view_{port}={TOKEN}\r\n\r\n".encode())
        while b"\r\n\r\n" not in self.read:
            self.read += self.socket.recv(4096)
        self.read = self.read.partition(b"\r\n\r\n")[2]

    def take(self, count):
        while len(self.read) < count:
            more = self.socket.recv(1 << 16)
            if not more:
                raise EOFError
            self.read += more
        taken, self.read = self.read[:count], self.read[count:]
        return taken

    def say(self, line):
        data = line.encode()
        self.socket.sendall(bytes([0x81, 0x80 | len(data), 0, 0, 0, 0]) + data)

    def hear(self):
        kind, length = self.take(2)
        if length == 126:
            length = struct.unpack(">H", self.take(2))[0]
        elif length == 127:
            length = struct.unpack(">Q", self.take(8))[0]
        data = self.take(length)
        # The server asks now and then who is still there.
        return self.hear() if kind == 0x89 else json.loads(data)

    def ask(self, line):
        self.say(line)
        return self.hear()


class Toplevel:
    """A toplevel with a robot and the view."""

    def __init__(self):
        goal = (f"use_module(library(ev3dev)), use_module(library(ev3dev/sim)), "
                f"use_module(library(ev3dev/view)), sim_start(room, [clock(virtual)]), "
                f"set_robot(5.6, 10.6, outB, outC), "
                f"view([port(P), token({TOKEN}), open(false)]), "
                f"format('port ~w~n', [P]), flush_output")
        self.process = subprocess.Popen(
            [SWIPL, "-q", "-p", f"library={TOP}/prolog", "-g", goal],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.port = int(self.process.stdout.readline().split()[1])

    def query(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def begun(self):
        """The time that it has printed."""
        for line in self.process.stdout:
            if line.startswith("at("):
                return float(line[3:].rstrip(")\n"))
        raise EOFError

    def cpu(self):
        """Seconds of all threads but the first."""
        of = Path(f"/proc/{self.process.pid}")
        main = (of / "task" / str(self.process.pid) / "schedstat").read_text().split()[0]
        alive = sum(int((task / "schedstat").read_text().split()[0])
                    for task in (of / "task").iterdir()) / 1e9
        return alive - int(main) / 1e9

    def end(self):
        self.process.stdin.close()
        self.process.kill()
        self.process.wait()


def watch(port, until, counts):
    page, have, count = Page(port), "", 0
    while time.monotonic() < until:
        have, count = page.ask(f"next {have}".strip())["have"], count + 1
    counts.append(count)


def share(toplevel, pages, seconds):
    """The share of a core that so many pages take, and frames a second of each."""
    counts, until = [], time.monotonic() + seconds + 1
    threads = [threading.Thread(target=watch, args=(toplevel.port, until, counts))
               for _ in range(pages)]
    for thread in threads:
        thread.start()
    time.sleep(1)
    before = toplevel.cpu()
    time.sleep(seconds - 0.5)
    taken = (toplevel.cpu() - before) / (seconds - 0.5)
    for thread in threads:
        thread.join()
    rate = statistics.mean(counts) / (seconds + 1) if counts else 0
    return taken, rate


def runs(frame):
    return any("running" in port.get("state", []) for port in frame["ports"])


def until(page, is_it):
    have = ""
    while True:
        frame = page.ask(f"next {have}".strip())
        have = frame["have"]
        if is_it(frame):
            return frame


def moments(seconds):
    """The middle one and the longest."""
    return {"median": round(statistics.median(seconds), 5), "worst": round(max(seconds), 5)}


def measure(seconds):
    """What the page costs: shares of a core, and delays in seconds."""
    drive = "repeat, motors_run([run(outB, 20), run(outC, 10)]), wait(0.1), fail."
    toplevel = Toplevel()
    try:
        page, shares = Page(toplevel.port), {}
        page.ask("pace x1")
        toplevel.query(drive)
        for pages in (0, 1, 10):
            taken, rate = share(toplevel, pages, seconds)
            shares[str(pages)] = {"share": round(taken, 4), "rate": round(rate, 1)}
        stops = []
        for _ in range(10):
            begun = time.monotonic()
            page.say("stop")
            page.hear()
            stops.append(time.monotonic() - begun)
            until(page, is_idle)
            toplevel.query(drive)
            until(page, runs)
        page.ask("stop")
        until(page, is_idle)
        starts = []
        for _ in range(10):
            toplevel.query("get_time(T), motor_run(outA, 30), writeln(at(T)).")
            until(page, runs)
            seen = time.time()
            starts.append(seen - toplevel.begun())
            toplevel.query("motor_stop(outA).")
            until(page, lambda frame: not runs(frame))
    finally:
        toplevel.end()
    return {"pages": shares, "stop_seconds": moments(stops), "seen_seconds": moments(starts)}


HALF = b"GET / HTTP/1.1\r\nHost: localhost\r\nX: "
WHOLE = b"GET /%s HTTP/1.1\r\nHost: localhost:%d\r\nOrigin: http://localhost:%d\r\n%s\r\n"
UPGRADE = (b"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n")

# What strangers send at first, and then again and again.
STRANGERS = {
    "silent": lambda port: (b"", b""),
    "slow": lambda port: (HALF, b"x"),
    "endless": lambda port: (HALF, b"x" * 4096),
    "wrong token": lambda port: (WHOLE % (b"?t=wrong", port, port, b""), b""),
    "websocket": lambda port: (WHOLE % (b"ws", port, port, UPGRADE), b""),
}


def besiege(port, kind, count, over):
    """Keeps so many connections up until it is over: one that has ended comes again."""
    first, more = STRANGERS[kind](port)
    sockets = []
    while not over.is_set():
        while len(sockets) < count and not over.is_set():
            one = socket.socket()
            one.setblocking(False)
            one.connect_ex(("127.0.0.1", port))
            sockets.append((one, [first]))
        for one, unsent in list(sockets):
            try:
                one.send(unsent.pop() if unsent else more)
                if not one.recv(1, socket.MSG_PEEK):
                    raise ConnectionError
            except BlockingIOError:
                pass
            except OSError:
                one.close()
                sockets.remove((one, unsent))
        time.sleep(0.01)
    for one, _ in sockets:
        one.close()


def visit(port):
    with socket.create_connection(("127.0.0.1", port), timeout=20) as one:
        one.sendall(f"GET /?t={TOKEN} HTTP/1.1\r\nHost: localhost:{port}\r\n"
                    "Connection: close\r\n\r\n".encode())
        answer = b""
        while part := one.recv(1 << 16):
            answer += part
    assert answer.startswith(b"HTTP/1.1 200"), answer[:100]


def took(act):
    begun = time.monotonic()
    act()
    return time.monotonic() - begun


def measure_strangers(kind, count):
    """The longest of ten times, in seconds."""
    toplevel, over = Toplevel(), multiprocessing.Event()
    try:
        page = Page(toplevel.port)
        page.ask("next")
        crowd = multiprocessing.Process(target=besiege, args=(toplevel.port, kind, count, over))
        crowd.start()
        time.sleep(1)
        visits, frames, stops = [], [], []
        for _ in range(10):
            visits.append(took(lambda: visit(toplevel.port)))
            frames.append(max(took(lambda: page.ask("next")) for _ in range(5)))
            toplevel.query("motor_run(outA, 30).")
            until(page, runs)
            stops.append(took(lambda: page.ask("stop")))
            until(page, is_idle)
        over.set()
        crowd.join()
    finally:
        toplevel.end()
    return {name: round(max(times), 3)
            for name, times in (("page", visits), ("frame", frames), ("stop", stops))}


def is_idle(frame):
    return frame["program"] == {"state": "idle", "latched": False}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--strangers", action="store_true")
    arguments = parser.parse_args()
    if not arguments.strangers:
        print(json.dumps(measure(arguments.seconds), indent=2))
        return
    for kind in STRANGERS:
        for count in (8, 60, 1000):
            print(count, kind, json.dumps(measure_strangers(kind, count)), flush=True)


if __name__ == "__main__":
    main()
