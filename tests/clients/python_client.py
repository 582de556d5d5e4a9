"""A client that is not ours: python-ev3dev2 on the simulator's mount.

    python_client.py MOUNT

The library is as it comes, but for the root of its tree.
"""
import sys
import time
import unittest

import ev3dev2

ev3dev2.Device.DEVICE_ROOT_PATH = sys.argv.pop(1)

from ev3dev2 import DeviceNotFound  # noqa: E402
from ev3dev2.motor import (  # noqa: E402
    LargeMotor, SpeedNativeUnits, SpeedPercent)
from ev3dev2.sensor.lego import (  # noqa: E402
    ColorSensor, GyroSensor, TouchSensor, UltrasonicSensor)

LEFT, RIGHT = "ev3-ports:outB", "ev3-ports:outC"


class Client(unittest.TestCase):
    def test_motor_runs_for_degrees_and_blocks_until_done(self):
        motor = LargeMotor(LEFT)
        before = motor.position
        motor.on_for_degrees(SpeedPercent(30), 90)
        self.assertNotIn("running", motor.state)
        # It brakes at the target, and rolls on a little.
        self.assertAlmostEqual(motor.position - before, 95, delta=10)

    def test_sensors_read(self):
        distance = UltrasonicSensor("ev3-ports:in1").distance_centimeters
        self.assertTrue(3 <= distance <= 255, distance)
        light = ColorSensor("ev3-ports:in2").ambient_light_intensity
        self.assertTrue(0 <= light <= 100, light)
        color = ColorSensor("ev3-ports:in3").color
        self.assertEqual(color, ColorSensor.COLOR_WHITE)

    def test_gyro_turns_with_the_robot(self):
        gyro = GyroSensor("ev3-ports:in4")
        before = gyro.angle
        left, right = LargeMotor(LEFT), LargeMotor(RIGHT)
        left.on(SpeedPercent(15))
        right.on(SpeedPercent(-15))
        time.sleep(0.5)
        left.off()
        right.off()
        self.assertGreater(gyro.angle - before, 10)

    def test_bad_speed_raises_its_error(self):
        with self.assertRaises(ValueError):
            LargeMotor(LEFT).on(SpeedNativeUnits(5000))
        with self.assertRaisesRegex(ValueError, "Max speed: .*1050"):
            LargeMotor(LEFT).speed_sp = 5000

    def test_missing_sensor_raises_device_not_found(self):
        with self.assertRaises(DeviceNotFound):
            TouchSensor()


unittest.main(warnings="ignore")
