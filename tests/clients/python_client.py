"""A client that is not ours: python-ev3dev2 on the simulator's mount.

    python_client.py MOUNT

The library is as it comes, but for the root of its tree.
"""
import os
import struct
import sys
import threading
import time
import unittest

import ev3dev2

ev3dev2.Device.DEVICE_ROOT_PATH = sys.argv.pop(1)
ev3dev2.get_current_platform = lambda: "ev3"

import ev3dev2._platform.ev3 as platform  # noqa: E402

DEV = os.environ["EV3DEV_DEV"]
KEYS = DEV + "/input/by-path/platform-gpio_keys-event"
platform.BUTTONS_FILENAME = KEYS

import evdev  # noqa: E402
from ev3dev2.button import Button  # noqa: E402

from ev3dev2 import DeviceNotFound  # noqa: E402
from ev3dev2.motor import (  # noqa: E402
    LargeMotor, SpeedNativeUnits, SpeedPercent)
from ev3dev2.sensor.lego import (  # noqa: E402
    ColorSensor, GyroSensor, TouchSensor, UltrasonicSensor)

def simulator(goal):
    """Has the simulator that mounts the tree call a Prolog goal."""
    with open(os.environ["EV3_SERVER"], "w") as server:
        server.write(goal + ".\n")


class KnownButton(Button):
    # The library looks for devices in /dev/input only.
    evdev_device = property(lambda self: evdev.InputDevice(KEYS))


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

    def eventually(self, is_so):
        deadline = time.monotonic() + 10
        while not is_so():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def test_buttons_are_down_while_they_are_pressed(self):
        button = Button()
        self.assertEqual(button.buttons_pressed, [])
        simulator("sim_press(up), sim_press(back)")
        self.eventually(lambda: button.check_buttons(["up", "backspace"]))
        self.assertTrue(button.up)
        self.assertFalse(button.enter)
        simulator("sim_release(up), sim_release(back)")
        self.eventually(lambda: not button.any())

    def test_button_handlers_are_called(self):
        button, seen = Button(), []
        button.on_enter = seen.append
        button.process()
        simulator("sim_press(enter)")
        self.eventually(lambda: button.process() or seen == [True])
        simulator("sim_release(enter)")
        self.eventually(lambda: button.process() or seen == [True, False])

    def test_waiting_for_a_button_ends_when_it_is_pressed(self):
        button, done = KnownButton(), []
        waiter = threading.Thread(
            target=lambda: done.append(button.wait_for_bump("left")), daemon=True)
        waiter.start()

        # It may not have opened the device yet.
        def bumped():
            simulator("sim_press(left), sleep(0.05), sim_release(left)")
            waiter.join(0.2)
            return not waiter.is_alive()
        self.eventually(bumped)
        self.assertEqual(done, [True])

    def test_the_key_device_introduces_itself(self):
        device = evdev.InputDevice(KEYS)
        self.assertEqual(device.name, "EV3 Brick Buttons")
        keys = device.capabilities()[evdev.ecodes.EV_KEY]
        self.assertEqual(sorted(keys), [14, 28, 103, 105, 106, 108])
        device.close()

    def test_a_tone_is_written_as_an_event(self):
        event = struct.pack("llHHi", 0, 0, evdev.ecodes.EV_SND, evdev.ecodes.SND_TONE, 440)
        with open(DEV + "/input/by-path/platform-sound-event", "wb", 0) as sound:
            self.assertEqual(sound.write(event), len(event))
            sound.write(struct.pack("llHHi", 0, 0, evdev.ecodes.EV_SND, evdev.ecodes.SND_TONE, 0))

    def test_the_screen_keeps_what_is_written(self):
        with open(DEV + "/fb0", "r+b", 0) as screen:
            screen.seek(712)
            screen.write(b"\x01\x02\x03\x00")
            screen.seek(0)
            shown = screen.read()
        self.assertEqual((len(shown), shown[712:716]), (91136, b"\x01\x02\x03\x00"))

    def test_missing_sensor_raises_device_not_found(self):
        with self.assertRaises(DeviceNotFound):
            TouchSensor()


unittest.main(warnings="ignore")
