"""A run that was started by a clock is filmed and scored without a person typing when it began."""
import json
import time
import unittest

from filmed_lab import BIN, TRACK, FilmedLab, call, must
from filmed_world import film_trajectory, recorded_at, write_robot_logs

SWARMSMITH = BIN / "swarmsmith"
MISSION = 'format = 1\npreset = "aggregation"\nduration = "20 s"\n'
MACHINE = ("--nstates 2 --s0 0 --rwm0 20 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.3 --s1 1 --n1 1 --n1x0 0 --c1x0 1 "
           "--p1x0 0.1")
FLAVOUR = "watermelon-argos3"
SECONDS = 20


class StartedRun(unittest.TestCase):
    def test_is_scored_from_the_start_of_its_log_and_tells_the_latency_of_the_world(self):
        if not SWARMSMITH.exists():
            self.skipTest("skipped: swarmsmith is not built")
        lab = FilmedLab()
        self.addCleanup(lab.close)
        folder = lab.folder / "runs"
        folder.mkdir()
        (folder / "short.toml").write_text(MISSION)
        (folder / "late.toml").write_text('format = 1\nbase = "rvr"\n'
                                          '[timing]\ndelays = [ { time = "150 ms", probability = 1 } ]\n')
        trajectory = folder / "world.csv"
        evaluated = must(SWARMSMITH, "evaluate", MACHINE, "--flavour", FLAVOUR, "--mission", folder / "short.toml",
                         "--profile", folder / "late.toml", "--seeds", "5", "--csv", trajectory, "--json")
        world = json.loads(evaluated.stdout.splitlines()[0])
        start = time.monotonic()
        video = folder / "run07.mkv"
        recorded_at(video, start, before_s=1.37, seconds=SECONDS + 2)
        robots = write_robot_logs(folder, "run07", trajectory, MACHINE, FLAVOUR, start, SECONDS)
        film_trajectory(lab.lab, video, trajectory, start, folder / "short.toml", "--seed", "5")
        log = folder / "run07.toml"
        log.write_text('format = 1\nname = "run07"\nrecorded = 2026-11-25\nmission = "short.toml"\nstart = "1.37 s"\n'
                       f'robots = {json.dumps(robots)}\n[[video]]\nfile = "run07.mkv"\n'
                       + "".join(f'[[robot]]\nname = "{name}"\nlog = "run07.{name}.log.csv"\nverdict = "VALID"\n'
                                 for name in robots))
        done = call(TRACK, "score", "--arena", lab.lab / "arena.toml", "--run", log, "--json")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = json.loads(done.stdout)
        close = any(robot["too_close"] for robot in result["robots"])
        if not close:
            self.assertEqual(result["score"], world["score"], result)
        self.assertNotEqual(result["verdict"], "INVALID", result["reasons"])
        told = [robot for robot in result["robots"] if robot["latency_s"] is not None]
        self.assertTrue(told, result["robots"])
        for robot in told:
            self.assertLess(abs(robot["latency_s"] - 0.15), 0.02, robot)


if __name__ == "__main__":
    unittest.main()
