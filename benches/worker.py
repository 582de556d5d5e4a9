"""Worker of benches/run.py: python-ev3dev2, as its users write it.

Reads `IMPLEMENTATION CASE COUNT` lines, answers each with the seconds one call
took.
"""
import os
import sys
import time

import ev3dev2

ev3dev2.Device.DEVICE_ROOT_PATH = os.environ["EV3DEV_SYSFS"]
os.environ.setdefault("EV3DEV_PLATFORM", "ev3")

from ev3dev2 import motor, sensor  # noqa: E402
from ev3dev2.sensor import lego  # noqa: E402


def prepare(case):
    def wheel(port):
        return motor.LargeMotor("ev3-ports:" + port)

    def eye(port):
        return lego.ColorSensor("ev3-ports:" + port)

    if case == "us_dist_cm":
        device = lego.UltrasonicSensor("ev3-ports:in1")
        return lambda: device.distance_centimeters_continuous
    if case == "col_ambient":
        device = eye("in2")
        return lambda: device.ambient_light_intensity
    if case == "gyro_ang":
        device = lego.GyroSensor("ev3-ports:in4")
        return lambda: device.angle
    if case == "position":
        device = wheel("outB")
        return lambda: device.position
    if case == "state":
        device = wheel("outB")
        return lambda: device.state
    if case == "motor_run":
        device = wheel("outD")
        return lambda: run(device, 50)
    if case == "vehicle2":
        eyes = [eye("in2"), eye("in3")]
        wheels = [wheel("outB"), wheel("outC")]

        def step():
            for e, w in zip(eyes, wheels):
                run(w, e.ambient_light_intensity)
        return step
    if case == "enumerate":
        return lambda: [m.address for m in motor.list_motors()]
    raise ValueError(case)


def run(device, percent):
    device.speed_sp = int(percent / 100 * device.max_speed)
    device.command = "run-forever"


def main():
    for line in sys.stdin:
        _, case, count = line.split()
        call = prepare(case)
        call()
        start = time.perf_counter()
        for _ in range(int(count)):
            call()
        print((time.perf_counter() - start) / int(count), flush=True)


main()
