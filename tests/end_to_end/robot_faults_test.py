"""What goes wrong between robots' nodes and a simulated world is said by name, and no tread goes on turning."""
import csv
import math
import signal
import unittest

import robots
from programs import PATIENCE, ProgramTest
from robots import Master, ZeroMq, machine_file
from robot_lock_step_test import WATERMELON, mission_of

NO_ROS = robots.why_no_ros()
FORWARD = "--nstates 1 --s0 0 --rwm0 1"
SILENCE_S = 2 * PATIENCE  #: after which a robot or a world counts as gone
LOCK_STEP = ("--flavour", "watermelon", "--lock-step", "senses")


class Faults(ProgramTest):
    def setUp(self):
        super().setUp()
        self.machine = machine_file(self, WATERMELON)

    def world_in_steps(self, way, *words):
        mission = mission_of(self.folder, "aggregation", seconds=5)
        return way.program(self, "world", "--mission", mission, "--seeds", "1-20000", "--lock-step", "--json",
                           "--patience", SILENCE_S, *words)

    def assert_killed_node_is_named(self, way):
        nodes = way.nodes(self, 3, self.machine, *LOCK_STEP)
        world = self.world_in_steps(way)
        world.wait_for('"digest"')
        nodes[1].signal(signal.SIGKILL)
        self.assertEqual(world.end(), 5, world.said())
        self.assertRegex(world.said(), r"rvr2: no answer from rvr2 in cycle \d+ of seed \d+ within "
                                       rf"{SILENCE_S} s; its node has disconnected")

    def assert_killed_world_is_told(self, way):
        nodes = way.nodes(self, 3, self.machine, *LOCK_STEP, "--patience", SILENCE_S)
        world = self.world_in_steps(way)
        world.wait_for('"digest"')
        world.signal(signal.SIGKILL)
        for node in nodes:
            self.assertEqual(node.end(), 5, node.said())
            self.assertIn("no message from the world", node.said())

    def assert_stopped_node_is_named(self, way):
        nodes = way.nodes(self, 3, self.machine, *LOCK_STEP)
        world = self.world_in_steps(way)
        world.wait_for('"digest"')
        nodes[2].signal(signal.SIGSTOP)
        self.assertEqual(world.end(), 5, world.said())
        self.assertRegex(world.said(), r"no answer from rvr3 in cycle \d+")


@unittest.skipIf(NO_ROS, NO_ROS or "")
@robots.by_the_clock
class OverRos(Faults):
    def setUp(self):
        super().setUp()
        self.master = Master(self, self.folder)

    def test_a_killed_node_is_named_with_the_cycle(self):
        self.assert_killed_node_is_named(self.master)

    def test_a_stopped_node_is_named_with_the_cycle(self):
        self.assert_stopped_node_is_named(self.master)

    def test_a_killed_world_ends_the_nodes(self):
        self.assert_killed_world_is_told(self.master)

    def test_a_node_that_is_missing_is_named(self):
        self.master.nodes(self, 2, self.machine, *LOCK_STEP)
        world = self.world_in_steps(self.master, "--wait", "1")
        self.assertEqual(world.end(), 5, world.said())
        self.assertIn("no node of rvr3 after 1 s", world.said())

    def test_a_killed_master_ends_no_run(self):
        self.master.nodes(self, 3, self.machine, *LOCK_STEP)
        world = self.world_in_steps(self.master)
        world.wait_for('"digest"')
        self.master.kill()
        before = len(world.out)
        robots.wait_for(lambda: len(world.out) > before + 3, "runs after the master's end")
        world.signal(signal.SIGTERM)
        self.assertEqual(world.end(), 143, world.said())

    def test_without_a_master_it_is_said_where_it_was_looked_for(self):
        self.master.kill()
        node = self.master.node(self, 1, self.machine, *LOCK_STEP)
        self.assertEqual(node.end(), 5, node.said())
        self.assertIn("no ROS master answers", node.said())
        self.assertIn(self.master.variables["ROS_MASTER_URI"].rstrip("/"), node.said())

    def test_a_second_node_of_the_same_name_ends_the_first(self):
        first = self.master.node(self, 1, self.machine, *LOCK_STEP)
        first.wait_for("random stream 0")
        # Registered when the second comes: the world sees its state.
        second = self.master.node(self, 1, self.machine, *LOCK_STEP)
        self.assertEqual(first.end(), 5, first.said())
        self.assertIn("another node took the name /rvr1/control", first.said())
        self.assertIsNone(second.process.poll())

    def test_a_host_name_that_does_not_resolve_is_said_on_both_sides(self):
        self.master.variables["ROS_HOSTNAME"] = "nosuch-robot.invalid"
        node = self.master.node(self, 1, self.machine, *LOCK_STEP)
        node.wait_for("other nodes get for this one the address `nosuch-robot.invalid`, which does not resolve on this host; set ROS_IP")
        self.master.variables["ROS_HOSTNAME"] = "localhost"
        world = self.master.program(self, "world", "--mission", "aggregation", "--lock-step")
        world.wait_for("/rvr1/control .* `nosuch-robot.invalid` does not resolve here; set ROS_IP")

    def real_time(self, count, seconds):
        """A world by the clock with robots that drive straight on, and where their true poses go."""
        mission = self.folder / "short.toml"
        mission.write_text(f'format = 1\npreset = "aggregation"\nrobots = {count}\nduration = "{seconds} s"\n')
        self.machine = machine_file(self, FORWARD)
        world = self.master.program(self, "world", "--mission", mission, "--real-time", "--json", "--csv",
                                    self.folder / "true.csv")
        return world

    def start(self, robots_wanted, seconds):
        self.check_until_ready(robots_wanted)
        return self.master.program(self, "start", "--run", "r1", "--robots", robots_wanted, "--seconds", seconds,
                                   "--write", self.folder / "r1.toml")

    def check_until_ready(self, robots_wanted):
        def ready():
            check = self.master.program(self, "check", "--robots", robots_wanted)
            return check.end() == 0
        robots.wait_for(ready, "robots that are ready")

    def moved_after(self, seconds):
        """How far the first robot drove after so many seconds."""
        with (self.folder / "true.csv").open() as file:
            rows = [row for row in csv.DictReader(file) if row["robot"] == "0"]
        poses = [(float(row["x"]), float(row["y"])) for row in rows if float(row["time_s"]) >= seconds]
        return math.dist(poses[0], poses[-1])

    def test_two_nodes_that_command_one_robot_stop_it(self):
        world = self.real_time(1, 4)
        words = ("--flavour", "watermelon-argos3", "--logs", self.folder)
        self.master.node(self, 1, self.machine, *words)
        self.master.node(self, 2, self.machine, *words, *(word for topic in ("ranges", "wheels")
                                                          for word in ("--topic", f"{topic}:=/rvr1/{topic}")))
        start = self.start("1-2", 4)
        self.assertEqual(world.end(), 0, world.said())
        start.end()
        self.assertEqual(world.rows()[-1]["stops_by_rivals"], 1, world.said())
        self.assertRegex(world.said(), "rvr1: two nodes command it, /rvr[12]/control and /rvr[12]/control")
        self.assertLess(self.moved_after(0.7), 0.001, world.said() + start.said())

    def test_a_master_that_is_killed_in_a_run_changes_nothing(self):
        world = self.real_time(2, 4)
        self.master.nodes(self, 2, self.machine, "--flavour", "watermelon-argos3", "--logs", self.folder)
        start = self.start("1-2", 4)
        robots.wait_for(lambda: list(self.folder.glob("r1.rvr*.log.csv")), "logs of the run")
        self.master.kill()
        self.assertEqual(world.end(), 0, world.said())
        self.assertEqual(world.rows()[-1]["stops_by_rivals"], 0, world.said())
        self.assertGreater(self.moved_after(1), 0.1, world.said() + start.said())

    def test_names_that_ros_does_not_take_are_refused(self):
        node = self.master.node(self, "a-b", self.machine, *LOCK_STEP, "--index", "0")
        self.assertEqual(node.end(), 2, node.said())
        node = self.master.node(self, 1, self.machine, *LOCK_STEP, "--topic", "ranges:=/a b")
        self.assertEqual(node.end(), 2, node.said())
        self.assertIn("ROS does not take this name", node.said())
        self.master.variables["ROS_MASTER_URI"] = "localhost"
        node = self.master.node(self, 1, self.machine, *LOCK_STEP)
        self.assertEqual(node.end(), 2, node.said())
        self.assertIn("not the address of a master", node.said())


class OverZeroMq(Faults):
    def test_a_killed_node_is_named_with_the_cycle(self):
        self.assert_killed_node_is_named(ZeroMq())

    def test_a_killed_world_ends_the_nodes(self):
        self.assert_killed_world_is_told(ZeroMq())

    def test_a_second_node_at_the_address_is_refused(self):
        way = ZeroMq()
        way.node(self, 1, self.machine, *LOCK_STEP)
        place = way.places[0].split("=")[1]
        second = robots.Process(self, [robots.ROBOT, "run", "--robot", "1", "--machine", self.machine, *LOCK_STEP,
                                       "--transport", "zeromq", "--bind", place])
        self.assertEqual(second.end(), 5, second.said())
        self.assertIn("another program listens on this port", second.said())

    def test_words_of_the_other_transport_are_refused(self):
        for words, said in (((), "the address of rvr1's node is missing"), (("--at", "x"), "write NAME=tcp://HOST:PORT"),
                            (tuple(word for i in (1, 2, 3) for word in ("--at", f"rvr{i}=tcp://10.0.0.1:5570")), "need a key"),
                            (("--at", "rvr9=tcp://127.0.0.1:5570"), "the address of rvr1's node is missing")):
            with self.subTest(words=words):
                world = robots.Process(self, [robots.ROBOT, "world", "--mission", "aggregation", "--lock-step",
                                              "--robots", "1-3", "--transport", "zeromq", *words])
                self.assertEqual(world.end(), 2, world.said())
                self.assertIn(said, world.said())


if __name__ == "__main__":
    unittest.main()
