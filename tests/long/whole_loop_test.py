"""The whole loop as one command: a campaign's winner drives three robots' nodes in a world by the clock, a virtual camera
films it, and the film is scored with the start that the operator's program wrote: the world's own score comes back, and the
latency that the world was told.
"""
import json
import os
import pathlib
import statistics
import sys
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
sys.path += [str(SOURCE / "tests" / part / "app") for part in ("robot", "tracking")]
from filmed_lab import TRACK, FilmedLab, call, must, runs_in  # noqa: E402
from filmed_world import Recorder, film_trajectory  # noqa: E402
from swarm import ROBOT, SwarmTest, read_log  # noqa: E402

SWARMSMITH = TRACK.with_name("swarmsmith")
INVALID_RUN = 6
SECONDS = 40
LATENCY_S = 0.15
#: Of the world, beyond what it was told; more is a machine on which nothing can be timed.
MOST_LATE_MS = 60
SEED = 5
CAMPAIGN = """format = 1
[campaign]
name = "loop"
seed = 11
[[mission]]
preset = "short.toml"
[[method]]
name = "small"
behaviours = ["exploration", "stop"]
conditions = ["black_floor", "fixed_probability"]
max_states = 2
[race]
max_experiments = 600
[simulator]
profile = "rvr"
"""


class WholeLoop(SwarmTest):
    def setUp(self):
        super().setUp()
        for program in (SWARMSMITH, ROBOT, TRACK):
            if not program.exists():
                self.skipTest(f"skipped: {program.name} is not built")
        self.lab = FilmedLab()
        self.addCleanup(self.lab.close)
        (self.folder / "short.toml").write_text(f'format = 1\npreset = "aggregation"\nduration = "{SECONDS} s"\n')
        (self.folder / "late.toml").write_text(
            'format = 1\nbase = "rvr"\n'
            f'[timing]\ndelays = [ {{ time = "{round(1000 * LATENCY_S)} ms", probability = 1 }} ]\n')
        (self.folder / "campaign.toml").write_text(CAMPAIGN)
        self.store = self.folder / "lab.db"

    def design(self):
        """A campaign, and its winner as the file that robots run."""
        must(SWARMSMITH, "run", self.folder / "campaign.toml", "--store", self.store, "--workers", "2", "--no-dashboard")
        must(SWARMSMITH, "export", self.store, "--design", "d1", "-o", self.machine)

    def drive(self, video):
        """What the world says of the run that the robots made, while a camera recorded."""
        self.start_nodes("--neighbours", "neighbours", "--labels", "black,white,gray,red,green,yellow")
        world = self.start("world", "--mission", self.folder / "short.toml", "--profile", self.folder / "late.toml",
                           "--seeds", SEED, "--real-time", "--json", "--csv", self.folder / "true.csv", "--transport",
                           "zeromq", *self.places)
        world.wait_for("start them with")
        with Recorder(video):
            run = self.start("start", "--run", "run07", "--robots", "1-3", "--seconds", SECONDS, "--json", "--write",
                             self.folder / "run07.toml", "--design", "d1", "--video", video, "--robot-logs", self.folder,
                             "--transport", "zeromq", *self.places)
            self.assertIn(run.finish(SECONDS + 60), (0, INVALID_RUN), run.text)
            self.assertEqual(world.finish(), 0, world.text)
        return world.json()

    def test_a_winner_comes_back_with_the_score_of_the_world_that_it_drove_in(self):
        self.design()
        video = self.folder / "run07.mkv"
        world = self.drive(video)
        film_trajectory(self.lab.lab, video, self.folder / "true.csv", world["start_clock_s"], self.folder / "short.toml",
                        "--seed", SEED)
        done = call(TRACK, "score", "--arena", self.lab.lab / "arena.toml", "--run", self.folder / "run07.toml", "--into",
                    self.store, "--json")
        self.assertIn(done.returncode, (0, INVALID_RUN), done.stdout + done.stderr)
        result = json.loads(done.stdout)
        log = (self.folder / "run07.toml").read_text()
        print(f"world {world}\n{log}\n{json.dumps(result, indent=1)}")
        self.assertIn("\nstart = ", log)
        foreign = [issue for issue in result["issues"] if issue["code"].startswith(("E_LOG", "W_LOG", "W_MOTION"))]
        self.assertEqual(foreign, [])
        if not any(robot["too_close"] for robot in result["robots"]):
            self.assertEqual(result["score"], world["score"])
        self.assertEqual([name for name, _, _ in runs_in(self.store)], ["run07"])
        self.assertEqual(self.replay_all(), 3)
        late_ms = max(world["latest_ms"], *(self.late_ms(robot) for robot in self.nodes))
        if late_ms > MOST_LATE_MS:
            self.skipTest(f"skipped: the latency, since this machine was {late_ms:.0f} ms late")
        told = [robot for robot in result["robots"] if robot["latency_s"] is not None]
        self.assertTrue(told, result["robots"])
        for robot in told:
            self.assertLess(abs(robot["latency_s"] - LATENCY_S), 0.02, robot)

    def late_ms(self, robot):
        """Of nine in ten control cycles."""
        return statistics.quantiles([row["late_ms"] for row in read_log(self.folder, "run07", robot)], n=10)[-1]


if __name__ == "__main__":
    unittest.main()
