"""A client that is not ours: python-ev3dev2 on the simulator's mount.

    python_client.py MOUNT

The library is as it comes, but for the root of its tree, and where it looks
which board it runs on.
"""
import os
import struct
import sys
import threading
import time
import unittest

import ev3dev2

ROOT = sys.argv.pop(1)


def board():
    with open(ROOT + "/board-info/board0/uevent") as uevent:
        model = dict(line.strip().split("=") for line in uevent)
    return {"LEGO MINDSTORMS EV3": "ev3"}[model["BOARD_INFO_MODEL"]]


ev3dev2.Device.DEVICE_ROOT_PATH = ROOT
ev3dev2.get_current_platform = board

import ev3dev2._platform.ev3 as platform  # noqa: E402

DEV = os.environ["EV3DEV_DEV"]
KEYS = DEV + "/input/by-path/platform-gpio_keys-event"
platform.BUTTONS_FILENAME = KEYS

import evdev  # noqa: E402
from ev3dev2.button import Button  # noqa: E402

from ev3dev2 import DeviceNotFound  # noqa: E402
from ev3dev2.led import Led, Leds  # noqa: E402
from ev3dev2.motor import (  # noqa: E402
    DcMotor, LargeMotor, MediumMotor, ServoMotor, SpeedNativeUnits,
    SpeedPercent)
from ev3dev2.port import LegoPort  # noqa: E402
from ev3dev2.power import PowerSupply  # noqa: E402
from ev3dev2.sensor import Sensor  # noqa: E402
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


def until(holds):
    end = time.monotonic() + 300
    while not holds():
        if time.monotonic() > end:
            raise AssertionError("it does not come, or the machine is too busy")
        time.sleep(0.01)


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
        color = ColorSensor("ev3-ports:in2").color
        self.assertEqual(color, ColorSensor.COLOR_WHITE)

    def test_gyro_turns_with_the_robot(self):
        gyro = GyroSensor("ev3-ports:in4")
        before = gyro.angle
        left, right = LargeMotor(LEFT), LargeMotor(RIGHT)
        left.on(SpeedPercent(15))
        right.on(SpeedPercent(-15))
        until(lambda: gyro.angle - before > 10)
        left.off()
        right.off()

    def test_bad_speed_raises_its_error(self):
        with self.assertRaises(ValueError):
            LargeMotor(LEFT).on(SpeedNativeUnits(5000))
        with self.assertRaisesRegex(ValueError, "Max speed: .*1050"):
            LargeMotor(LEFT).speed_sp = 5000

    def test_leds_show_colours_and_blink(self):
        leds = Leds()
        leds.set_color("LEFT", "ORANGE")
        red, green = (Led(name_pattern="led0:%s:*" % c)
                      for c in ("red", "green"))
        self.assertEqual((red.brightness, green.brightness), (255, 127))
        leds.all_off()
        self.assertEqual((red.brightness, green.brightness), (0, 0))
        self.assertIn("heartbeat", red.triggers)
        red.brightness = 255
        red.trigger = "timer"
        red.delay_on, red.delay_off = 200, 300
        self.assertEqual((red.delay_on, red.delay_off), (200, 300))
        red.trigger = "none"
        self.assertEqual(red.brightness, 0)

    def test_power_supply_reads(self):
        battery = PowerSupply()
        # More, and less, while motors still hold.
        self.assertTrue(7 < battery.measured_volts < 8)
        self.assertTrue(0.17 <= battery.measured_amps < 4)
        self.assertEqual(battery.technology, "Li-ion")
        self.assertEqual(battery.type, "Battery")

    def test_lego_port_makes_a_dc_motor_appear(self):
        port = LegoPort("ev3-ports:outA")
        self.assertEqual((port.mode, port.status), ("auto", "tacho-motor"))
        self.assertIn("dc-motor", port.modes)
        with self.assertRaises(DeviceNotFound):
            DcMotor()
        port.mode = "dc-motor"
        # As with the real one, the files are not yet open to others.
        motor = DcMotor("ev3-ports:outA")
        until(lambda: os.stat(motor._path + "/command").st_mode & 0o020)
        motor.duty_cycle_sp = 40
        motor.polarity = "inversed"
        motor.time_sp = 300
        motor.stop_action = "brake"
        motor.run_timed()
        self.assertIn("running", motor.state)
        # In the sign that the program gave, inversed or not
        self.assertEqual(motor.duty_cycle, 40)
        until(lambda: motor.state == [])
        self.assertEqual(motor.duty_cycle, 0)
        with self.assertRaises(DeviceNotFound):
            MediumMotor("ev3-ports:outA")
        self.detect(port)
        MediumMotor("ev3-ports:outA")

    def detect(self, port):
        """Back to what is plugged in, which the brick takes a moment to see."""
        port.mode = "auto"
        until(lambda: "ev3-ports:outA\n" in [
            open(entry.path + "/address").read()
            for entry in os.scandir(ROOT + "/tacho-motor")])

    def test_lego_port_is_told_of_another_motor(self):
        port = LegoPort("ev3-ports:outA")
        port.set_device = "lego-nxt-motor"
        self.assertEqual(LargeMotor.SYSTEM_CLASS_NAME, "tacho-motor")
        names = [open(entry.path + "/driver_name").read()
                 for entry in os.scandir(ROOT + "/tacho-motor")]
        self.assertIn("lego-nxt-motor\n", names)
        self.detect(port)

    def test_servo_motor_runs_and_floats(self):
        servo = ServoMotor("ev3-ports:in3:i2c88:sv1")
        self.assertEqual((servo.min_pulse_sp, servo.max_pulse_sp), (500, 2500))
        servo.position_sp = 60
        self.assertEqual(servo.state, [])
        servo.run()
        self.assertEqual((servo.state, servo.position_sp), (["running"], 60))
        servo.rate_sp = 500
        self.assertEqual(servo.rate_sp, 500)
        servo.float()
        self.assertEqual((servo.state, servo.position_sp), ([], -150))

    def test_buttons_are_down_while_they_are_pressed(self):
        button = Button()
        self.assertEqual(button.buttons_pressed, [])
        simulator("sim_press(up), sim_press(back)")
        until(lambda: button.check_buttons(["up", "backspace"]))
        self.assertTrue(button.up)
        self.assertFalse(button.enter)
        simulator("sim_release(up), sim_release(back)")
        until(lambda: not button.any())

    def test_button_handlers_are_called(self):
        button, seen = Button(), []
        button.on_enter = seen.append
        button.process()
        simulator("sim_press(enter)")
        until(lambda: button.process() or seen == [True])
        simulator("sim_release(enter)")
        until(lambda: button.process() or seen == [True, False])

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
        until(bumped)
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

    def test_registers_of_the_bus_are_read_and_written_at_their_offsets(self):
        servos = os.path.join(Sensor("ev3-ports:in3:i2c88")._path, "direct")
        file = os.open(servos, os.O_RDWR)
        try:
            self.assertEqual(os.pread(file, 8, 0x08), b"mndsnsrs")
            self.assertEqual(os.pwrite(file, b"\x01\xff", 0x80), 2)
            self.assertEqual(os.pread(file, 3, 0x80), b"\x01\xff\x00")
            os.lseek(file, 0x10, os.SEEK_SET)
            self.assertEqual(os.read(file, 8), b"NXTServo")
            self.assertEqual(os.pread(file, 8, 250), bytes(5))
            self.assertEqual(os.pread(file, 8, 255), b"")
            with self.assertRaisesRegex(OSError, "File too large"):
                os.pwrite(file, b"x", 255)
        finally:
            os.close(file)
        with open(os.path.join(Sensor("ev3-ports:in1")._path, "direct"),
                  "rb", 0) as ultrasonic:
            with self.assertRaisesRegex(OSError, "Operation not supported"):
                ultrasonic.read(8)

    def test_missing_sensor_raises_device_not_found(self):
        with self.assertRaises(DeviceNotFound):
            TouchSensor()


unittest.main(warnings="ignore")
