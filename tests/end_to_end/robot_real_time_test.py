"""Runs by the clock, as in a laboratory, and what robots do in them when something goes wrong: what moves, what is said,
and what the verdict is. The logs of all runs replay."""
import csv
import json
import re
import signal
import time
import unittest

import robots
from programs import ProgramTest
from robots import Master, ZeroMq

NO_ROS = robots.why_no_ros()
#: Looks at everything but light, and mostly drives.
CURIOUS = ("--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.8 "
           "--s1 2 --att1 2 --n1 1 --n1x0 0 --c1x0 5 --p1x0 0.1")
#: From a fault to standing treads, seconds (docs/robot-runtime.md).
STANDS_AFTER = 0.5


def speed(row):
    return max(abs(float(row["left_mps"])), abs(float(row["right_mps"])))


class RealTime(ProgramTest):
    neighbours = "neighbours"  # or `scan`: how robots see each other

    def way(self):
        return ZeroMq()

    def setUp(self):
        super().setUp()
        self.swarm = self.way()
        self.nodes = {}

    def start_node(self, number, *words, limit=None):
        node = self.swarm.node(self, number, CURIOUS, "--flavour", "watermelon", "--color-scale", "255", "--logs",
                               self.folder, "--neighbours", self.neighbours, *words, limit=limit)
        self.nodes[f"rvr{number}"] = node

    def start_nodes(self, *words):
        for number in (1, 2, 3):
            self.start_node(number, *words)

    def start_world(self, *words, mission="aggregation"):
        return self.swarm.program(self, "world", "--mission", mission, "--real-time", "--neighbours", self.neighbours,
                                  *words)

    def start_run(self, seconds, run="run07", names="1-3", patience=20, words=()):
        return self.swarm.program(self, "start", "--run", run, "--robots", names, "--seconds", seconds, "--in", "0.7",
                                  "--json", "--patience", patience, "--write", self.folder / f"{run}.toml", *words, key="operator")

    def answer(self, run):
        return json.loads(run.out[-1])

    def rows(self, robot, run="run07"):
        """Of a robot's log, without one that was being written."""
        text = (self.folder / f"{run}.{robot}.log.csv").read_text()
        return list(csv.DictReader(text[:text.rfind("\n") + 1].splitlines()))

    def end_of(self, robot, run="run07"):
        """What the head of its log says of the end; nothing when the node could not write one."""
        parts = (self.folder / f"{run}.{robot}.toml").read_text().split("[end]")
        return parts[1] if len(parts) == 2 else None

    def assert_stands_after(self, robot, time_s):
        """From so long after `time_s` of the run on, no command turns a tread."""
        late = [row["cycle"] for row in self.rows(robot) if float(row["time_s"]) > time_s + STANDS_AFTER and speed(row) > 0]
        self.assertEqual(late, [])

    def assert_replays(self, logs=3):
        files = sorted(self.folder.glob("*.log.csv"))
        self.assertEqual(len(files), logs)
        replay = robots.Process(self, [robots.ROBOT, "replay", *files])
        self.assertEqual(replay.end(), 0, replay.said())

    # A test a fault; each way runs those that its messages may change.

    def sensor_is_silent_for_a_moment(self):
        self.start_nodes()
        self.start_world("--fault", "rvr1:ranges:silent:2-2.6")
        run = self.start_run(10)  # a twentieth of its cycles may be held
        self.assertEqual(run.end(), 0, run.said())
        self.assertEqual(self.answer(run)["verdict"], "DEGRADED", run.said())
        rows = self.rows("rvr1")
        held = [row for row in rows if row["act"] == "hold"]
        self.assertGreaterEqual(len(held), 2)
        self.assertTrue(all(2.2 < float(row["time_s"]) < 2.9 and speed(row) == 0 for row in held), held)
        self.assertIn("proximity: silent for 0.", held[0]["event"])
        self.assertTrue(held[0]["leds"].startswith("ff0000"))
        self.assertTrue(any(float(row["time_s"]) > 3 and speed(row) > 0 for row in rows), "it goes on")
        self.assertIn('verdict = "DEGRADED"', self.end_of("rvr1"))
        self.assert_replays()
        log = (self.folder / "run07.toml").read_text()
        self.assertRegex(log, r'name = "rvr1"\nverdict = "DEGRADED"')

    def node_gets_a_signal(self):
        self.start_nodes()
        self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        self.nodes["rvr1"].signal(signal.SIGTERM)
        self.assertEqual(self.nodes["rvr1"].end(), 143)
        self.assertEqual(run.end(), 6, run.said())
        self.assertIn("stopped by SIGTERM", self.end_of("rvr1"))
        self.assertIn('state = "stopped"', self.end_of("rvr2"))
        self.assert_replays()
        self.nodes["rvr2"].signal(signal.SIGINT)
        self.assertEqual(self.nodes["rvr2"].end(), 130)

    def node_is_killed(self):
        self.start_nodes()
        world = self.start_world("--json")
        run = self.start_run(30)
        run.wait_for("all robots are running")
        self.nodes["rvr2"].signal(signal.SIGKILL)
        self.assertEqual(run.end(), 6, run.said())
        self.assertIn("rvr2: has sent nothing for 1 s", self.answer(run)["complaints"])
        self.assertEqual(self.answer(run)["verdicts"], {"rvr1": "INVALID", "rvr2": "unknown", "rvr3": "INVALID"})
        self.assertRegex((self.folder / "run07.toml").read_text(),
                         r'name = "rvr2"\nverdict = "INVALID"\nreasons = \["it did not answer after the run"\]')
        self.assertIsNone(self.end_of("rvr2"))
        self.assertIn('state = "stopped"', self.end_of("rvr1"))
        self.assert_replays()
        self.assertIsNone(world.process.poll())

    def run_is_for_one_robot(self):
        rover, mission = robots.mission_of_rovers(self)
        self.start_nodes("--kind", rover)
        self.start_world(mission=mission)
        refused = self.start_run(2, patience=1)
        self.assertEqual(refused.end(), 1, refused.said())
        self.assertIn("rvr2: the run is for the robot `rvr`, and the node drives the robot `rover`; use one for `rover`, or a "
                      "node of `rvr` (`swarmsmith robot run --kind`)", refused.said())
        self.assertFalse((self.folder / "run07.toml").exists())
        for words, why in ((("--mission", mission, "--kind", "rvr"), "the mission is for the robot `rover`"),
                           (("--mission", "rowers.toml"), "or say it with --kind")):
            refused = self.start_run(2, words=words)
            self.assertEqual(refused.end(), 2, refused.said())
            self.assertIn(why, refused.said())
        for run, words in (("run07", ("--mission", "rovers.toml")), ("run08", ("--kind", rover))):
            done = self.start_run(2, run=run, words=words)
            self.assertEqual(done.end(), 0, done.said())
        self.assertTrue(any(speed(row) > 0 for row in self.rows("rvr1")))
        self.assertRegex((self.folder / "run07.rvr1.toml").read_text(), r'(?m)^own_robot = "\\n\[robot\]\\nname = \\"rover')
        self.assert_replays(6)


@robots.by_the_clock
class OverZeroMq(RealTime):
    def test_a_sensor_that_is_silent_for_a_moment_holds_the_robot(self):
        self.sensor_is_silent_for_a_moment()

    def test_a_node_that_gets_a_signal_stops_its_treads_first(self):
        self.node_gets_a_signal()

    def test_all_others_stop_when_a_node_is_killed(self):
        self.node_is_killed()

    def test_a_run_is_for_one_robot(self):
        self.run_is_for_one_robot()

    def test_a_sensor_that_is_silent_for_good_ends_the_run_of_all(self):
        self.start_nodes()
        self.start_world("--fault", "rvr2:ranges:silent:1-")
        run = self.start_run(30)
        self.assertEqual(run.end(), 6, run.said())
        answer = self.answer(run)
        self.assertEqual(answer["verdict"], "INVALID")
        self.assertRegex(answer["complaints"][0], r"rvr2: failed: proximity: silent for 1\.")
        self.assert_stands_after("rvr2", 1)
        self.assertIn('state = "failed"', self.end_of("rvr2"))
        for robot in ("rvr1", "rvr3"):
            self.assertIn('state = "stopped"', self.end_of(robot))
            self.assertLess(float(self.rows(robot)[-1]["time_s"]), 4)
        self.assert_replays()

    def test_a_sensor_that_gives_no_numbers_is_a_missing_one(self):
        self.start_nodes()
        self.start_world("--fault", "rvr1:ranges:nan:1-")
        run = self.start_run(30)
        self.assertEqual(run.end(), 6, run.said())
        self.assertIn("is missing: its value is NaN", self.end_of("rvr1"))
        self.assert_stands_after("rvr1", 1)
        self.assert_replays()

    def test_a_scan_of_another_length_or_turned_is_read_by_its_angles(self):
        self.neighbours = "scan"
        self.start_nodes()
        self.start_world("--fault", "rvr1:scan:500:0-", "--fault", "rvr2:scan:turned:0-")
        run = self.start_run(4)
        self.assertEqual(run.end(), 0, run.said())
        for robot in ("rvr1", "rvr2", "rvr3"):
            self.assertTrue(all(row["age_neighbours_ms"] and float(row["age_neighbours_ms"]) < 300
                                for row in self.rows(robot)), robot)
        self.assert_replays()

    def test_a_node_ends_with_its_input(self):
        self.start_nodes("--pipe")
        self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        self.nodes["rvr3"].process.stdin.close()
        self.assertEqual(self.nodes["rvr3"].end(), 0)
        self.assertEqual(run.end(), 6, run.said())
        self.assertIn("stopped by the end of its input", self.end_of("rvr3"))
        self.assert_replays()

    def test_nodes_stop_when_the_operator_is_gone(self):
        self.start_nodes()
        self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        run.signal(signal.SIGKILL)

        def all_failed():
            check = self.swarm.program(self, "check", "--robots", "1-3", "--json", key="operator")
            check.end()
            states = [robot["state"] for robot in self.answer(check)["robots"]]
            return all(state and state["state"] == "failed" and not state["log_open"] for state in states) and states
        gone_at = time.monotonic()
        for state in robots.wait_for(all_failed, "the end of all nodes' runs"):
            self.assertRegex(state["reasons"][0], r"no message from the operator for 1\.")
        for robot in ("rvr1", "rvr2", "rvr3"):
            moves = [float(row["clock_s"]) for row in self.rows(robot) if speed(row) > 0]
            print(f"{robot} is commanded to stand {moves[-1] + 0.1 - gone_at:.2f} s after the operator is gone")
            self.assertLess(moves[-1] + 0.1 - gone_at, STANDS_AFTER)
        self.assert_replays()

    def test_nodes_stop_when_the_world_is_gone(self):
        self.start_nodes()
        world = self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        world.signal(signal.SIGKILL)
        self.assertEqual(run.end(), 6, run.said())
        self.assertRegex(self.answer(run)["complaints"][0], r"failed: (\w+: silent for 1\.|driver: .* \(for 1\.)")
        self.assert_replays()

    def test_a_person_interrupts_stops_and_kills(self):
        self.start_nodes()
        self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        stop = self.swarm.program(self, "stop", "--robots", "1-3", key="operator")
        self.assertEqual(stop.end(), 0, stop.said())
        self.assertEqual(run.end(), 6, run.said())
        self.assertIn("stopped by order", self.end_of("rvr1"))
        kill = self.swarm.program(self, "stop", "--kill", "--robots", "2", key="operator", of="rvr2")
        self.assertEqual(kill.end(), 0, kill.said())
        again = self.start_run(30, run="run08", patience=1)
        self.assertEqual(again.end(), 1, again.said())
        self.assertIn("rvr2: killed by order: restart the node", again.said())
        self.assertEqual(list(self.folder.glob("run08*")), [])
        self.assert_replays()

    def test_a_full_disk_does_not_stop_the_robot_and_fails_its_run(self):
        self.start_node(1, limit=6000)
        self.start_node(2)
        self.start_node(3)
        self.start_world()
        run = self.start_run(5)
        self.assertEqual(run.end(), 6, run.said())
        first = self.answer(run)["robots"][0]["state"]
        self.assertEqual(first["state"], "failed", run.said())
        self.assertRegex(first["reasons"][0], "the log is incomplete: .*large")
        self.assertGreaterEqual(first["cycle"], 45, "the robot went on")
        self.assertIn('state = "ended"', self.end_of("rvr2"))
        self.assert_replays()

    def test_a_swarm_that_is_not_one_does_not_start(self):
        self.start_node(1)
        self.start_node(2, "--seed", "5")
        mission = self.folder / "two.toml"
        mission.write_text('format = 1\nname = "two"\npreset = "aggregation"\nrobots = 2\n')
        self.swarm.program(self, "world", "--mission", mission, "--real-time", "--neighbours", "neighbours")
        run = self.start_run(5, names="1-2", patience=2)
        self.assertEqual(run.end(), 1, run.said())
        self.assertIn("rvr2: has the seed 5, and rvr1 has 1", run.said())
        self.assertFalse((self.folder / "run07.toml").exists())
        self.assertEqual(list(self.folder.glob("*.log.csv")), [])

    def test_a_log_that_was_changed_does_not_replay(self):
        self.start_nodes()
        self.start_world()
        run = self.start_run(2)
        self.assertEqual(run.end(), 0, run.said())
        file = self.folder / "run07.rvr1.toml"
        file.write_text(re.sub(r"(?m)^seed = 1$", "seed = 2", file.read_text()).replace("robot_index = 0", "robot_index = 9"))
        log = self.folder / "run07.rvr1.log.csv"
        lines = log.read_text().splitlines(keepends=True)
        cells = lines[10].split(",")
        cells[6] = "0.123"
        log.write_text("".join([*lines[:10], ",".join(cells), *lines[11:]]))
        replay = robots.Process(self, [robots.ROBOT, "replay", "--json", log])
        self.assertEqual(replay.end(), 1, replay.said())
        self.assertFalse(self.answer(replay)["same"])
        log.write_text("nonsense\n")
        replay = robots.Process(self, [robots.ROBOT, "replay", log])
        self.assertEqual(replay.end(), 2, replay.said())


@unittest.skipIf(NO_ROS, NO_ROS or "")
@robots.by_the_clock
class OverRos(RealTime):
    def way(self):
        return Master(self, self.folder)

    def test_a_sensor_that_is_silent_for_a_moment_holds_the_robot(self):
        self.sensor_is_silent_for_a_moment()

    def test_a_node_that_gets_a_signal_stops_its_treads_first(self):
        self.node_gets_a_signal()

    def test_all_others_stop_when_a_node_is_killed(self):
        self.node_is_killed()

    def test_a_run_is_for_one_robot(self):
        self.run_is_for_one_robot()


if __name__ == "__main__":
    unittest.main()
