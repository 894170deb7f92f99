"""Drivers of the treads that fail in a run, over ROS and over ZeroMQ, with drivers that have no code of ours: no run in which
the treads did not obey is VALID, the reason and the time are in the log and in the run's file, and the robot's treads are
not told to turn half a second later."""
import csv
import pathlib
import re
import signal
import sys
import time
import tomllib
import unittest

import robots
from programs import ProgramTest
from robots import Master, Process, ZeroMq, machine_file

NO_ROS = robots.why_no_ros()
DRIVERS = pathlib.Path(__file__).with_name("drivers.py")
FORWARD = "--nstates 1 --s0 0 --rwm0 1"
#: From what the treads first do wrong to the command to stand, seconds (docs/robot-runtime.md).
STANDS_AFTER = 0.5
#: A command may take so long until the treads do it.
ALLOWED_S = 0.3
#: Drivers learn of their fault by a line, and see it when they look.
TOLD_S = 0.05


class Drivers:
    """The tests of both ways to the robots, one a fault."""

    def setUp(self):
        super().setUp()
        self.swarm = self.way()
        self.node = self.swarm.node(self, 1, machine_file(self, FORWARD), "--flavour", "watermelon-argos3", "--logs",
                                    self.folder)
        self.driver("sensors")

    def driver(self, role, name=None):
        """`name`: in ROS."""
        place = self.swarm.places[0].split("=")[1] if self.kind == "zeromq" else "rvr1"
        variables = {**self.swarm.variables, **({"SWARMSMITH_DRIVER": name} if name else {})}
        driver = Process(self, [sys.executable, DRIVERS, role, self.kind, place], variables)
        driver.wait_for("begins")
        return driver

    def spoil(self, driver, fault):
        """When it heard of it."""
        driver.process.stdin.write(fault + "\n")
        driver.process.stdin.flush()
        return float(driver.wait_for(r"fault (\S+)\n").group(1))

    def start(self, run, seconds):
        return self.swarm.program(self, "start", "--run", run, "--robots", "1", "--seconds", seconds, "--in", "0.6",
                                  "--patience", "20", "--write", self.folder / f"{run}.toml", key="operator")

    def begin(self, seconds=30, role="treads"):
        """A run with a driver that obeys, until the treads turn."""
        treads = self.driver(role)
        start = self.start("r1", seconds)
        treads.wait_for(r"\d 0\.3 0\.3\n")
        return treads, start

    def rows(self):
        with (self.folder / "r1.rvr1.log.csv").open() as file:
            return list(csv.DictReader(file))

    def wrong_from(self, treads):
        """When the treads first did what was not commanded then or 0.3 s before."""
        commands = [(float(row["clock_s"]), float(row["left_mps"]), float(row["right_mps"])) for row in self.rows()]
        acts = [tuple(map(float, line.split())) for line in treads.out if re.match(r"\d", line)]
        begins, ends = commands[0][0], commands[-1][0]
        for act, (_, *speeds) in enumerate(acts):
            until = acts[act + 1][0] if act + 1 < len(acts) else ends
            if not any(speeds):
                continue
            fits = [(at, later) for (at, *of), (later, *_) in zip(commands, [*commands[1:], (ends + 1, 0, 0)])
                    if max(abs(a - b) for a, b in zip(of, speeds)) < 0.011]
            at = max(acts[act][0], begins)
            while at < until and any(first - 0.02 <= at <= last + ALLOWED_S for first, last in fits):
                at = 0.001 + max(last + ALLOWED_S for first, last in fits if first - 0.02 <= at)
            if at < until:
                return at
        raise AssertionError("the treads did nothing wrong")

    def assert_invalid(self, start, fault_at, reason, within=STANDS_AFTER, resumes=False):
        """The run ends INVALID for this reason, and the node stops the treads in time. `fault_at`: when, or the driver whose treads
        do wrong.
        `resumes`: it may obey the stop, go on, and be wrong again."""
        self.assertEqual(start.end(), 6, start.said())
        self.assertIn("r1: INVALID", start.said())
        with (self.folder / "r1.toml").open("rb") as file:
            noted = tomllib.load(file)["robot"][0]
        with (self.folder / "r1.rvr1.toml").open("rb") as file:
            end = tomllib.load(file)["end"]
        self.assertEqual((noted["verdict"], end["verdict"]), ("INVALID", "INVALID"))
        if end["driven"]:
            self.assertEqual(end["driver"], "INVALID")
        self.assertRegex(end["reasons"][0], reason)
        self.assertRegex(end["reasons"][0], r"since \d+\.\d s")
        self.assertEqual(noted["reasons"], end["reasons"])
        rows = self.rows()
        self.assertRegex(rows[-1]["event"], reason)
        wrong_at = self.wrong_from(fault_at) if isinstance(fault_at, Process) else fault_at
        moves = [float(row["clock_s"]) for row in rows if float(row["left_mps"]) or float(row["right_mps"])]
        if resumes:
            stop = min(float(row["clock_s"]) for row in rows
                       if float(row["clock_s"]) > wrong_at and not float(row["left_mps"]) and not float(row["right_mps"]))
            moves = [move for move in moves if move < stop]
        after = moves[-1] + 0.1 - wrong_at if wrong_at else 0
        print(f"{self.id().split('.', 1)[1]} | {after:.2f} s | {end['reasons'][0]}")
        self.assertLess(after, within)

    def assert_treads_stand(self, treads, fault_at):
        """What the driver itself had the treads do."""
        lines = [line.split() for line in treads.out if re.match(r"\d", line)]
        times = [(float(at) - fault_at, float(left) or float(right)) for at, left, right in lines]
        self.assertEqual(times[-1][1], 0, times[-3:])
        self.assertLess(times[-1][0], STANDS_AFTER + TOLD_S)

    def obeys(self, seconds=3):
        treads = self.driver("treads")
        start = self.start("r0", seconds)
        self.assertEqual(start.end(), 0, start.said())
        self.assertIn("r0: VALID", start.said())
        with (self.folder / "r0.rvr1.toml").open("rb") as file:
            end = tomllib.load(file)["end"]
        self.assertEqual((end["driven"], end["driver"]), (True, "VALID"))
        self.assertLess(end["driver_off_s"], 0.3)
        return treads

    def test_silent(self):
        treads, start = self.begin()
        treads.signal(signal.SIGSTOP)
        self.assert_invalid(start, time.monotonic(), "does not report what the treads do")

    def test_dead(self):
        treads, start = self.begin()
        treads.kill()
        self.assert_invalid(start, time.monotonic(), "has disconnected: no driver listens to the speeds|does not report what the treads do")

    def test_replaced(self):
        treads, start = self.begin()
        treads.kill()
        fault_at = time.monotonic()
        self.driver("treads")
        self.assert_invalid(start, fault_at, "drives the treads in place of|has disconnected: no driver listens|does not report what the treads do")

    def test_a_driver_that_obeys_is_valid(self):
        self.obeys()

    def slow(self, seconds):
        treads, start = self.begin()
        self.spoil(treads, f"slow {seconds}")
        self.assert_invalid(start, treads, r"s behind|after its command", resumes=True)

    def test_slow(self):
        self.slow(1)

    def test_slow_by_half_a_second(self):
        self.slow(0.5)

    def test_half_of_the_treads(self):
        """Its run before is VALID."""
        treads = self.obeys(seconds=1)
        treads.out.clear()
        start = self.start("r1", 30)
        treads.wait_for(r"\d 0\.3 0\.3\n")
        self.spoil(treads, "half")
        self.assert_invalid(start, treads, "only the left one obeys")

    def other_speeds(self, fault):
        treads, start = self.begin()
        self.spoil(treads, fault)
        self.assert_invalid(start, treads, "it follows other commands")

    def test_contradicted(self):
        self.other_speeds("foreign")

    def test_half_of_the_speed(self):
        self.other_speeds("weak")

    def test_backwards(self):
        self.other_speeds("reversed")

    def test_one_that_says_what_was_never_commanded(self):
        treads, start = self.begin()
        fault_at = self.spoil(treads, "invented")
        self.assert_invalid(start, fault_at, "it follows other commands")

    def test_stuck(self):
        """It does what is commanded half of the time, by chance."""
        treads, start = self.begin()
        fault_at = self.spoil(treads, "stuck")
        self.assert_invalid(start, fault_at, r"s behind|ignored the command \S+ and \S+ m/s, which was given \d+ times", within=8)

    def test_one_that_hears_no_speeds(self):
        """Its treads stand."""
        treads, start = self.begin()
        self.spoil(treads, "deaf")
        self.assert_invalid(start, None, "stopped them")

    def test_one_that_stutters(self):
        treads, start = self.begin()
        self.spoil(treads, "stutters")
        self.assert_invalid(start, None, "does not report what the treads do|s behind")

    def test_one_that_is_late_by_no_more_than_is_allowed(self):
        treads, start = self.begin(seconds=8)
        self.spoil(treads, "slow 0.15")
        self.assertEqual(start.end(), 0, start.said())

    def test_a_second_one(self):
        treads, start = self.begin()
        self.driver("second", "/elsewhere/second")
        fault_at = time.monotonic()
        self.assert_invalid(start, fault_at, "also drives the treads, besides")
        self.assert_treads_stand(treads, fault_at)

    def test_one_that_does_not_say_what_the_treads_do(self):
        _, start = self.begin(seconds=2, role="quiet")
        self.assertEqual(start.end(), 0, start.said())
        self.assertIn("driver: no driver reports what the treads do", start.said())
        self.assertIn("r1: DEGRADED", start.said())

    def test_one_that_does_not_say_what_the_treads_do_and_hangs(self):
        treads, start = self.begin(role="quiet")
        treads.signal(signal.SIGSTOP)
        self.assert_invalid(start, time.monotonic(), "does not respond", within=1.5)


@robots.by_the_clock
class OverZeroMq(Drivers, ProgramTest):
    kind = "zeromq"

    def way(self):
        return ZeroMq()

    def test_how_the_run_of_a_killed_node_ended_is_unknown(self):
        treads, start = self.begin()
        self.node.kill()
        fault_at = time.monotonic()
        self.assertEqual(start.end(), 6, start.said())
        self.assertRegex(start.said(), r"rvr1: unknown; it was last heard \d+\.\d s ago, running after \d+ cycles")
        self.assertNotIn("VALID\n", start.said().replace("r1: INVALID\n", ""))
        with (self.folder / "r1.toml").open("rb") as file:
            noted = tomllib.load(file)["robot"][0]
        self.assertEqual((noted["verdict"], noted["reasons"]), ("INVALID", ["it did not answer after the run"]))
        self.assert_treads_stand(treads, fault_at)

    def test_one_that_says_that_it_is_an_operator(self):
        treads, start = self.begin()
        fault_at = self.spoil(treads, "operator")
        self.assert_invalid(start, fault_at, "has disconnected|does not report what the treads do|it stopped them")
        self.assertIn("no longer drives: it sent `hello operator`", self.node.said())


@unittest.skipIf(NO_ROS, NO_ROS or "")
@robots.by_the_clock
class OverRos(Drivers, ProgramTest):
    kind = "ros"

    def way(self):
        return Master(self, self.folder)

    def test_another_one_that_sends_speeds(self):
        treads, start = self.begin()
        joystick = self.driver("joystick", "/elsewhere/joystick")
        fault_at = time.monotonic()
        self.assert_invalid(start, fault_at, "/elsewhere/joystick also commands the treads")
        self.assert_treads_stand(treads, fault_at)
        joystick.kill()
        self.node.wait_for("/elsewhere/joystick also publishes /rvr1/wheels|also commands the treads|$")


if __name__ == "__main__":
    unittest.main()
