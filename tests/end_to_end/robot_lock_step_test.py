"""Nodes of robots, stepped by a simulated world over a real ROS master or over ZeroMQ, all in processes of their own,
have the scores and last states of `evaluate`, bit for bit."""
import json
import pathlib
import re
import signal
import tempfile
import unittest

import robots
from programs import ProgramTest, call, ended_well
from robots import Master, ZeroMq, machine_file

# Each looks at the floor, at others and at obstacles, and draws.
WATERMELON = ("--nstates 3 --s0 0 --rwm0 12 --n0 2 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 4.5 --n0x1 1 --c0x1 0 --p0x1 0.8 "
              "--s1 2 --att1 3.25 --n1 2 --n1x0 0 --c1x0 5 --p1x0 0.03 --n1x1 1 --c1x1 2 --p1x1 0.9 "
              "--s2 3 --rep2 2.5 --n2 1 --n2x0 0 --c2x0 4 --p2x0 2 --w2x0 7.5")
CHOCOLATE = ("--nstates 3 --s0 0 --rwm0 12 --n0 2 --n0x0 0 --c0x0 3 --p0x0 1 --w0x0 4.5 --n0x1 1 --c0x1 0 --p0x1 0.8 "
             "--s1 4 --att1 3.25 --n1 2 --n1x0 0 --c1x0 5 --p1x0 0.03 --n1x1 1 --c1x1 2 --p1x1 0.9 "
             "--s2 2 --n2 1 --n2x0 0 --c2x0 4 --p2x0 2 --w2x0 7.5")
MACHINES = {"watermelon": WATERMELON, "watermelon-argos3": WATERMELON, "chocolate": CHOCOLATE}
NO_ROS = robots.why_no_ros()


def mission_of(folder, preset, robots_wanted=3, seconds=20):
    """The file of a short mission with so many robots: each cycle takes a round of all processes."""
    name = f"{preset}{robots_wanted}"
    file = folder / f"{name}.toml"
    file.write_text(f'format = 1\nname = "{name}"\npreset = "{preset}"\nrobots = {robots_wanted}\n'
                    f'duration = "{seconds} s"\n')
    return file


class LockStep(ProgramTest):
    def compared(self, way, mission, flavour, profile, seeds, count=3, lock_step="senses", node_words=(), world_words=()):
        """Runs the world with nodes; its rows, which have the bits of a run in its process and the scores of
        `evaluate`."""
        machine = machine_file(self, MACHINES[flavour])
        logs = pathlib.Path(tempfile.mkdtemp(dir=self.folder, prefix="logs-"))
        nodes = way.nodes(self, count, machine, "--flavour", flavour, "--lock-step", lock_step, "--logs", logs,
                          *node_words)
        world = way.program(self, "world", "--mission", mission, "--profile", profile, "--seeds", seeds, "--lock-step",
                            "--compare", "--machine", machine, "--flavour", flavour, "--json", *world_words)
        code = world.end()
        said = world.said() + "".join(node.said() for node in nodes)
        self.assertEqual(code, 0, said)
        rows = world.rows()
        self.assertTrue(all(row["same_in_process"] for row in rows), rows)
        done = ended_well(call("evaluate", machine, "--flavour", flavour, "--profile", profile, "--mission", mission,
                               "--seeds", seeds, "--json"))
        evaluated = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([(row["seed"], row["score"]) for row in rows],
                         [(row["seed"], row["score"]) for row in evaluated])
        for node in nodes:
            if lock_step == "topics":  # no message says that there are no more runs
                node.signal(signal.SIGTERM)
            self.assertEqual(node.end(), 0 if lock_step == "senses" else 143, node.said())
        files = sorted(logs.glob("*.log.csv"))
        self.assertEqual(len(files), count * len(rows))
        replay = robots.Process(self, [robots.ROBOT, "replay", *files])
        self.assertEqual(replay.end(), 0, replay.said())
        return rows


    def refuses_nodes_of_another_robot(self, way):
        """`of`: the robot of the nodes; `wanted`: the mission's."""
        rover, rovers = robots.mission_of_rovers(self, 1)
        rvrs = mission_of(self.folder, "aggregation", 1)
        machine = machine_file(self, WATERMELON)
        for kind, mission, wanted, of in (("rvr", rovers, "rover", "rvr"), (rover, rvrs, "rvr", "rover")):
            swarm = way()
            swarm.node(self, 1, machine, "--flavour", "watermelon", "--lock-step", "senses", "--kind", kind)
            world = swarm.program(self, "world", "--mission", mission, "--seeds", "1", "--lock-step")
            self.assertEqual(world.end(), 1, world.said())
            self.assertIn(f"rvr1: the mission is for the robot `{wanted}`, and the node drives the robot `{of}`; use one for "
                          f"`{of}`, or a node of `{wanted}` (`swarmsmith robot run --kind`)", world.said())


@unittest.skipIf(NO_ROS, NO_ROS or "")
class OverRos(LockStep):
    def test_nodes_of_another_robot_are_refused(self):
        self.refuses_nodes_of_another_robot(lambda: Master(self, self.folder))

    def test_missions_flavours_and_profiles(self):
        master = Master(self, self.folder)
        for mission, flavour, profile in (("aggregation", "watermelon", "rvr"),
                                          ("grid_exploration", "watermelon-argos3", "argos3"),
                                          ("color_selection", "chocolate", "pseudo-reality")):
            with self.subTest(mission=mission, flavour=flavour, profile=profile):
                self.compared(master, mission_of(self.folder, mission), flavour, profile, "1-2")

    def test_one_robot_and_ten(self):
        master = Master(self, self.folder)
        for count in (1, 10):
            with self.subTest(robots=count):
                self.compared(master, mission_of(self.folder, "aggregation", count), "watermelon", "rvr", "5",
                              count=count)

    def test_two_masters_at_once(self):
        masters = [Master(self, self.folder), Master(self, self.folder)]
        machine = machine_file(self, WATERMELON)
        worlds = []
        for master in masters:
            master.nodes(self, 3, machine, "--flavour", "watermelon", "--lock-step", "senses")
        for master in masters:
            worlds.append(master.program(self, "world", "--mission", mission_of(self.folder, "aggregation"), "--seeds",
                                         "1-3", "--lock-step", "--compare", "--machine", machine, "--flavour", "watermelon", "--json"))
        for world in worlds:
            self.assertEqual(world.end(), 0, world.said())
        self.assertEqual(worlds[0].rows(), worlds[1].rows())

    def test_another_seed_is_another_run(self):
        master = Master(self, self.folder)
        machine = machine_file(self, WATERMELON)
        nodes = [master.node(self, i + 1, machine, "--flavour", "watermelon", "--lock-step", "senses", "--index", i + 1)
                 for i in range(3)]
        world = master.program(self, "world", "--mission", mission_of(self.folder, "aggregation"), "--seeds", "1",
                               "--lock-step", "--compare", "--machine", machine, "--flavour", "watermelon", "--json")
        self.assertEqual(world.end(), 1, world.said())
        self.assertFalse(world.rows()[0]["same_in_process"])
        self.assertIn("each have its own random stream", world.said())
        for node in nodes:
            node.end()

    def test_the_drivers_own_topics(self):
        """RangeArray, ColorRGBA and Float32MultiArray are float32: equal to a profile that rounds as they do."""
        master = Master(self, self.folder)
        profile = self.wire_profile("rvr")
        self.compared(master, mission_of(self.folder, "aggregation"), "watermelon", profile, "3", lock_step="topics",
                      node_words=("--seed", "3", "--wheels", "floats", "--color-scale", "255", "--neighbours",
                                  "neighbours"),
                      world_words=("--topics", "--wheels", "floats"))

    def test_the_drivers_own_topics_of_a_profile_with_a_lidar(self):
        master = Master(self, self.folder)
        profile = self.wire_profile("rvr", (r'(?m)^source( *)= "camera"', r'source\1= "lidar"'))
        self.compared(master, mission_of(self.folder, "aggregation"), "watermelon", profile, "4", lock_step="topics",
                      node_words=("--seed", "4", "--wheels", "floats", "--color-scale", "255", "--neighbours",
                                  "neighbours"),
                      world_words=("--topics", "--wheels", "floats"))

    def test_rounded_topics_differ_from_a_profile_that_does_not_round(self):
        master = Master(self, self.folder)
        machine = machine_file(self, WATERMELON)
        master.nodes(self, 3, machine, "--flavour", "watermelon", "--lock-step", "topics", "--seed", "3", "--wheels",
                     "floats", "--color-scale", "255", "--neighbours", "neighbours")
        world = master.program(self, "world", "--mission", mission_of(self.folder, "aggregation"), "--seeds", "3",
                               "--lock-step", "--topics", "--wheels", "floats", "--compare", "--machine", machine, "--flavour", "watermelon",
                               "--json")
        self.assertEqual(world.end(), 1, world.said())
        self.assertIn('wire = "float32"', world.said())

    def wire_profile(self, name, *changes):
        done = ended_well(call("profile", name))
        text = done.stdout
        for pattern, by in ((r'(?m)^wire( *)= "float64"', r'wire\1= "float32"'), *changes):
            changed = re.sub(pattern, by, text)
            self.assertNotEqual(changed, text, pattern)
            text = changed
        file = self.folder / f"{name}-wire.toml"
        file.write_text(text)
        return file


class OverZeroMq(LockStep):
    def test_the_same_bits(self):
        self.compared(ZeroMq(), mission_of(self.folder, "aggregation"), "watermelon", "rvr", "1-2")

    def test_the_same_bits_of_a_robot_of_ones_own(self):
        rover, mission = robots.mission_of_rovers(self)
        self.compared(ZeroMq(), mission, "watermelon", "rvr", "1-2", node_words=("--kind", rover))

    def test_nodes_of_another_robot_are_refused(self):
        self.refuses_nodes_of_another_robot(ZeroMq)

    def test_machines_and_robots_that_a_node_does_not_drive_are_refused(self):
        machine = self.folder / "best.fsm"
        head = 'format = 1\nflavour = "{}"\n[[mission]]\nname = "theirs"\npreset = "aggregation"\nrobot = "{}"'
        for flavour, robot in (("watermelon", "rvr"), ("chocolate-epuck", "epuck")):
            lines = head.format(flavour, robot).splitlines()
            machine.write_text("".join(f"#: {line}\n" for line in lines) + "--nstates 1 --s0 1\n")
            node = robots.Process(self, [robots.ROBOT, "run", "--robot", "1", "--machine", machine, "--transport", "zeromq",
                                         "--bind", "tcp://127.0.0.1:*", "--lock-step", "senses"])
            if robot == "rvr":
                node.wait_for("rvr1: robot rvr, ")
            else:
                self.assertEqual(node.end(), 2, node.said())
                self.assertIn("the machine is for the robot `epuck`, and the node drives the robot `rvr`; use one for `rvr`",
                              node.said())
        rover, _ = robots.mission_of_rovers(self)
        for words, why in ((("--kind", "epuck"), "the robot `epuck` has proximity sensors that give strengths"),
                           (("--kind", rover, "--color-scale", "255", "--wheels", "twist"), "and the robot `rover` has another one"),
                           (("--kind", rover, "--color-scale", "255"), "let its driver send `neighbours`")):
            node = robots.Process(self, [robots.ROBOT, "run", "--robot", "1", "--machine", WATERMELON, "--flavour", "watermelon",
                                         "--transport", "zeromq", *words])
            self.assertEqual(node.end(), 2, node.said())
            self.assertIn(why, node.said())

    def test_the_same_bits_with_keys(self):
        keys = self.folder / "keys"
        ended_well(call("keygen", keys))
        self.compared(ZeroMq(keys), mission_of(self.folder, "color_selection"), "chocolate", "pseudo-reality", "7")

    def test_the_same_bits_by_counting(self):
        self.compared(ZeroMq(), mission_of(self.folder, "grid_exploration"), "watermelon", "argos3", "4",
                      lock_step="topics", node_words=("--seed", "4", "--color-scale", "255", "--neighbours", "neighbours"),
                      world_words=("--topics", "--neighbours", "neighbours"))


if __name__ == "__main__":
    unittest.main()
