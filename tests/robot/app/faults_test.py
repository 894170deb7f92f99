"""What robots do when something goes wrong, with the programs that people run and a simulated world by the clock: what
moves, what is said, and what the verdict is. Every log replays."""
import signal
import unittest

from swarm import SwarmTest, read_log, speed

#: From a fault to standing treads, seconds (docs/robot-runtime.md). A cycle more under load.
STANDS_AFTER = 0.5


class Faults(SwarmTest):
    def assert_stands_after(self, robot, time_s, run="run07"):
        """No command of the log, from so long after `time_s` of the run on, turns a tread."""
        late = [row for row in read_log(self.folder, run, robot) if row["time_s"] > time_s + STANDS_AFTER]
        self.assertEqual([row["cycle"] for row in late if row["act"] == "step" and speed(row) > 0], [])

    def run_with(self, *faults, seconds=6, node_words=()):
        self.start_nodes(*node_words)
        world = self.start_world(*(word for fault in faults for word in ("--fault", fault)))
        run = self.start_run(seconds)
        code = run.finish()
        return world, run, code

    def test_a_sensor_that_is_silent_for_a_moment_holds_the_robot(self):
        _, run, code = self.run_with("rvr1:ranges:silent:2-2.6")
        self.assertEqual(code, 0, run.text)
        self.assertEqual(run.json()["verdict"], "DEGRADED")
        rows = read_log(self.folder, "run07", "rvr1")
        held = [row for row in rows if row["act"] == "hold"]
        self.assertGreaterEqual(len(held), 2)
        self.assertTrue(all(2.2 < row["time_s"] < 2.8 and speed(row) == 0 for row in held), held)
        self.assertIn("proximity: silent for 0.", held[0]["event"])
        self.assertIn("ff0000", held[0]["leds"])
        self.assertTrue(any(row["act"] == "step" and row["time_s"] > 3 for row in rows))
        self.assertIn('verdict = "DEGRADED"', self.end_of("rvr1"))
        self.assertIn('verdict = "VALID"', self.end_of("rvr2"))
        self.assertEqual(self.replay_all(), 3)

    def test_a_sensor_that_is_silent_for_good_ends_the_run_of_all(self):
        _, run, code = self.run_with("rvr2:ranges:silent:1-")
        self.assertEqual(code, 6, run.text)
        answer = run.json()
        self.assertEqual(answer["verdict"], "INVALID")
        self.assertIn("rvr2: failed: proximity: silent for 1.", answer["complaints"][0])
        self.assert_stands_after("rvr2", 1)
        for robot in ("rvr1", "rvr3"):
            self.assertIn('state = "stopped"', self.end_of(robot))
            self.assertLess(read_log(self.folder, "run07", robot)[-1]["time_s"], 3.5)
        self.assertIn('state = "failed"', self.end_of("rvr2"))
        self.assertEqual(self.replay_all(), 3)

    def test_a_sensor_that_gives_no_numbers_is_a_missing_one(self):
        _, run, code = self.run_with("rvr1:ranges:nan:1-")
        self.assertEqual(code, 6, run.text)
        self.assertIn("is missing: its value is NaN", self.end_of("rvr1"))
        self.assert_stands_after("rvr1", 1)
        self.replay_all()

    def test_a_scan_of_another_length_or_turned_is_read_by_its_angles(self):
        self.start_nodes("--neighbours", "scan")
        self.start_world("--neighbours", "scan", "--fault", "rvr1:scan:500:0-", "--fault", "rvr2:scan:turned:0-")
        run = self.start_run(4)
        self.assertEqual(run.finish(), 0, run.text)
        for robot in ("rvr1", "rvr2", "rvr3"):
            rows = read_log(self.folder, "run07", robot)
            self.assertTrue(any(row["neighbours"] for row in rows) or robot == "rvr3", robot)
            self.assertIn('verdict = "VALID"', self.end_of(robot))
        self.assertEqual(self.replay_all(), 3)

    def test_a_node_that_gets_a_signal_stops_its_treads_first(self):
        self.start_nodes()
        world = self.start_world()
        run = self.start_run(20)
        run.wait_for("all robots are running")
        self.nodes["rvr1"].process.send_signal(signal.SIGTERM)
        self.assertEqual(self.nodes["rvr1"].finish(), 143)
        self.assertEqual(run.finish(), 6, run.text)
        self.assertIn("stopped by SIGTERM", self.end_of("rvr1"))
        self.assertIn('state = "stopped"', self.end_of("rvr2"))
        self.replay_all()
        for robot, code, what in (("rvr2", 130, signal.SIGINT), ("rvr3", 0, None)):
            node = self.nodes[robot]
            if what:
                node.process.send_signal(what)
                self.assertEqual(node.finish(), code)
        world.kill()

    def test_a_node_ends_with_its_input(self):
        self.start_nodes("--pipe")
        self.start_world()
        run = self.start_run(20)
        run.wait_for("all robots are running")
        self.nodes["rvr3"].process.stdin.close()
        self.assertEqual(self.nodes["rvr3"].finish(), 0)
        self.assertEqual(run.finish(), 6, run.text)
        self.assertIn("stopped by the end of its input", self.end_of("rvr3"))
        self.replay_all()

    def test_a_node_that_is_killed_is_stopped_by_its_driver_and_all_others_by_the_operator(self):
        self.start_nodes()
        world = self.start_world()
        run = self.start_run(6)
        run.wait_for("all robots are running")
        self.nodes["rvr2"].process.kill()
        self.assertEqual(run.finish(), 6, run.text)
        self.assertIn("rvr2: is silent for 1 s", run.json()["complaints"])
        self.assertIsNone(self.end_of("rvr2"), "nobody could write an end")
        self.assertIn('state = "stopped"', self.end_of("rvr1"))
        self.replay_all()
        world.process.send_signal(signal.SIGTERM)
        world.finish()

    def test_nodes_stop_when_the_operator_is_gone(self):
        self.start_nodes()
        self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        run.process.kill()
        check = self.wait_for_state("failed")
        for robot in check["robots"]:
            self.assertIn("the operator is silent for 1.", robot["state"]["reasons"][0])
        for robot in ("rvr1", "rvr2", "rvr3"):
            self.assertIn('state = "failed"', self.end_of(robot))
        self.replay_all()

    def wait_for_state(self, phase):
        """Asks until all robots are in it."""
        for _ in range(100):
            check = self.start("check", "--robots", "1-3", "--json", "--transport", "zeromq", *self.places)
            check.finish()
            answer = check.json()
            if all(robot["state"] and robot["state"]["state"] == phase for robot in answer["robots"]):
                return answer
        raise AssertionError(f"not all robots become {phase}: {answer}")

    def test_nodes_stop_when_the_world_is_gone(self):
        self.start_nodes()
        world = self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        world.process.kill()
        self.assertEqual(run.finish(), 6, run.text)
        self.assertIn("silent for 1.", run.json()["complaints"][0])
        self.replay_all()

    def test_stop_and_kill(self):
        self.start_nodes()
        self.start_world()
        run = self.start_run(30)
        run.wait_for("all robots are running")
        stop = self.start("stop", "--robots", "1-3", "--transport", "zeromq", *self.places)
        self.assertEqual(stop.finish(), 0, stop.text)
        self.assertEqual(run.finish(), 6, run.text)
        self.assertIn("stopped by order", self.end_of("rvr1"))
        kill = self.start("stop", "--kill", "--robots", "2", "--transport", "zeromq", "--at", self.place_of("rvr2"))
        self.assertEqual(kill.finish(), 0, kill.text)
        again = self.start_run(30, "--patience", "1", run="run08")
        self.assertEqual(again.finish(), 1, again.text)
        self.assertIn("rvr2: killed by order: restart the node", again.text["err"])
        self.assertEqual(list(self.folder.glob("run08*")), [])
        self.replay_all()

    def test_a_full_disk_does_not_stop_the_robot_and_fails_its_run(self):
        self.start_node(1, limits=6000)
        self.start_node(2)
        self.start_node(3)
        self.start_world()
        run = self.start_run(6)
        self.assertEqual(run.finish(), 6, run.text)
        answer = run.json()
        self.assertEqual(answer["verdict"], "INVALID")
        first = answer["robots"][0]["state"]
        self.assertEqual(first["state"], "failed")
        self.assertIn("the log is not whole", first["reasons"][0])
        self.assertGreaterEqual(first["cycle"], 55, "the robot went on")
        self.assertIn('state = "ended"', self.end_of("rvr2"))
        self.replay_all()

    def test_a_swarm_that_is_not_complete_does_not_start(self):
        self.start_node(1)
        self.start_node(2, "--seed", "5")
        mission = self.folder / "two.toml"
        mission.write_text('format = 1\nname = "two"\npreset = "aggregation"\nrobots = 2\n')
        self.start("world", "--mission", mission, "--real-time", "--transport", "zeromq", *self.places)
        run = self.start("start", "--run", "run07", "--robots", "1-2", "--patience", "2", "--write",
                         self.folder / "run07.toml", "--transport", "zeromq", *self.places)
        self.assertEqual(run.finish(), 1, run.text)
        self.assertIn("rvr2: has the seed 5, and rvr1 has 1", run.text["err"])
        self.assertFalse((self.folder / "run07.toml").exists())
        self.assertEqual(list(self.folder.glob("*.log.csv")), [])


if __name__ == "__main__":
    unittest.main()
