"""What programs drive: a plain tree of files, and the files of a simulation in another process."""

import shutil
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

MOTORS = {
    "tacho-motor/motor0": ("outA", "lego-ev3-m-motor"),
    "tacho-motor/motor1": ("outB", "lego-ev3-l-motor"),
    "tacho-motor/motor2": ("outC", "lego-ev3-l-motor"),
    "dc-motor/motor3": ("outD", "rcx-motor"),
    "servo-motor/motor4": ("in3:i2c88:sv1", "ms-8ch-servo"),
}
ZEROS = ("duty_cycle duty_cycle_sp position position_sp ramp_down_sp ramp_up_sp speed speed_sp time_sp rate_sp "
         "hold_pid/Kp hold_pid/Ki hold_pid/Kd speed_pid/Kp speed_pid/Ki speed_pid/Kd")
ATTRIBUTES = {
    **{name: "0" for name in ZEROS.split()},
    "command": "", "polarity": "normal", "count_per_rot": "360", "max_speed": "1050", "stop_action": "coast",
    "stop_actions": "coast brake hold", "max_pulse_sp": "2400", "mid_pulse_sp": "1500", "min_pulse_sp": "600",
    "commands": "run-forever run-to-abs-pos run-to-rel-pos run-timed run-direct stop reset",
}
SENSOR = {
    "address": "ev3-ports:in1", "driver_name": "lego-ev3-us", "decimals": "1", "num_values": "1", "value0": "843",
    "mode": "US-DIST-CM", "modes": "US-DIST-CM US-DIST-IN US-LISTEN US-SI-CM US-SI-IN", "units": "cm",
}


def first_line(path):
    """What a file says; nothing if it is gone."""
    try:
        return path.read_text(errors="replace").split("\n")[0]
    except OSError:
        return ""


GUARD_S = 300.0  # what comes later does not come, or the machine is much too busy


def until(true):
    """Waits for what must come."""
    deadline = time.monotonic() + GUARD_S
    while not true() and time.monotonic() < deadline:
        time.sleep(0.01)


class Plain:
    """Files that nothing moves."""

    def __init__(self, root):
        self.root = root
        self.dev = root.parent / "dev"
        self.dev.mkdir(exist_ok=True)

    def fresh(self, moving):
        """All as after plugging in."""
        shutil.rmtree(self.root, ignore_errors=True)
        for place, (port, driver) in MOTORS.items():
            state = "running" if moving and not place.startswith("servo") else ""
            self.device(place, {**ATTRIBUTES, "state": state, "driver_name": driver, "address": f"ev3-ports:{port}"})
        self.device("lego-sensor/sensor0", SENSOR)

    def device(self, place, attributes):
        """One directory of files."""
        folder = self.root / place
        for part in ("hold_pid", "speed_pid"):
            (folder / part).mkdir(parents=True, exist_ok=True)
        for name, text in attributes.items():
            (folder / name).write_text(text + "\n")

    def running(self):
        """The ports of the motors whose last command was to run."""
        return [port for place, (port, _) in MOTORS.items()
                if first_line(self.root / place / "command").startswith("run")]

    def used(self):
        """Has any motor had a command?"""
        return any(first_line(self.root / place / "command") for place in MOTORS)

    def spoil(self, fault, port):
        """A fault of the motor at the port."""
        folder = next(self.root / place for place, motor in MOTORS.items() if motor[0] == port)
        try:
            if fault == "tree vanishes":
                shutil.rmtree(self.root)
            elif fault == "motor vanishes":
                shutil.rmtree(folder)
            elif fault == "state is garbage":
                (folder / "state").write_bytes(b"\xff\x00 runn\n" * 99)
            else:
                (folder / "command").unlink()
                if fault == "command is a directory":
                    (folder / "command").mkdir()
                elif fault == "command is garbage":
                    (folder / "command").write_bytes(b"\xfe%n\x00" * 999)
        except OSError:  # the program was faster, or the fault has been there
            pass

    def close(self):
        """Nothing is kept."""


def written(file, text):
    """Writes to a device that has just been plugged in: udev lets a normal user do so a little later."""
    while True:
        try:
            file.write_text(text)
        except PermissionError:
            time.sleep(0.01)
        else:
            return


class Mount:
    """The files of a simulation that another Prolog serves."""

    def __init__(self, folder, swipl, library):
        self.root = folder / "mount"
        self.dev = folder / "mount.dev"
        self.root.mkdir()
        self.dev.mkdir()
        self.server = subprocess.Popen(
            [swipl, "-q", "-f", "none", "-p", f"library={library}", "-g", f"serve('{self.root}')", "-t", "halt(1)",
             str(ROOT / "tests/clients/serve.pl")],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        until(lambda: (self.dev / "fb0").exists() or self.server.poll() is not None)
        self.works = (self.dev / "fb0").exists()

    def tell(self, goal):
        """The server calls the goal."""
        self.server.stdin.write(f"{goal}.\n".encode())
        self.server.stdin.flush()

    def ask(self, goal):
        """The server has called the goal, and all that came before."""
        done = self.root.parent / "done"
        self.tell(f"{goal}, open('{done}', write, S), close(S)")
        until(lambda: done.exists() or self.server.poll() is not None)
        done.unlink(missing_ok=True)

    def motors(self):
        """The ports of the motors, each with its directory."""
        return [(first_line(folder / "address").replace("ev3-ports:", ""), folder)
                for name in ("tacho-motor", "servo-motor") for folder in sorted((self.root / name).glob("*"))]

    def fresh(self, _moving):
        """All motors are there and rest, the robot is where it was."""
        # Only now: a wire that was pulled at the end of the last run is pulled before
        self.ask("forall(member(Port-Type, [outA-m, outB-l, outC-l]), (atomic_list_concat(['lego-ev3-', Type, "
                  "'-motor'], Motor), ignore(sim_plug(Port, Motor))))")
        until(self.are_reset)
        self.tell("sim_place(60, 60, 0)")
        until(lambda: not self.running())

    def are_reset(self):
        """Whether all motors are there and have been reset: for a while the kernel shows one that was unplugged."""
        folders = [folder for _, folder in self.motors()]
        try:
            for folder in folders:
                written(folder / "command", "reset" if folder.parent.name == "tacho-motor" else "float")
        except OSError:
            return False
        return sum(folder.parent.name == "tacho-motor" for folder in folders) >= 3

    def running(self):
        """The ports of the motors that run."""
        return [port for port, folder in self.motors() if "running" in first_line(folder / "state")]

    def used(self):
        """Has any motor turned?"""
        return any(first_line(folder / "position") not in ("", "0") for _, folder in self.motors())

    def spoil(self, _fault, port):
        """Somebody pulls the wire of a motor."""
        if port.startswith("out"):
            self.tell(f"ignore(sim_unplug({port}))")

    def close(self):
        """The server unmounts at the end of its input."""
        self.server.stdin.close()
        try:
            self.server.wait(10)
        except subprocess.TimeoutExpired:
            self.server.kill()
            self.server.wait()
            subprocess.run(["fusermount", "-uz", str(self.root)], check=False)
