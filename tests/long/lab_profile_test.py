"""A laboratory of which the truth is known, filmed and measured: `track profile` gives latency, slip and missed neighbours
back, and machines that were designed under that profile do there at least as well as those designed under `rvr`.
"""
import json
import math
import statistics
import sys
import os
import pathlib
import tomllib
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
sys.path += [str(SOURCE / "tests" / "end_to_end"), str(SOURCE / "tests" / "tracking" / "app")]
from filmed_lab import TRACK, FilmedLab, must  # noqa: E402
from programs import ProgramTest  # noqa: E402

SWARMSMITH = TRACK.with_name("swarmsmith")
LATENCY_MS = 200
WAY, TURN, MISS = 0.85, 0.75, 0.3
TRUTH = f"""format = 1
base = "rvr"
[timing]
delays = [ {{ time = "{LATENCY_MS} ms", probability = 1 }} ]
[treads]
way = {WAY}
turn = {TURN}
[neighbours]
miss_rate = {MISS}
"""
CAMPAIGN = """format = 1
[campaign]
name = "{name}"
seed = 5
repetitions = {designs}
[[mission]]
name = "{mission}"
[[method]]
name = "chocolate"
[race]
max_experiments = {experiments}
[simulator]
profile = "{profile}"
"""
RUNS = 4
SECONDS = 60
DESIGNS = int(os.environ.get("SWARMSMITH_LAB_DESIGNS", "10"))
EXPERIMENTS = int(os.environ.get("SWARMSMITH_LAB_EXPERIMENTS", "10000"))
MISSION = os.environ.get("SWARMSMITH_LAB_MISSION", "grid_exploration")
TESTS = 50


class LabProfile(ProgramTest):
    def setUp(self):
        super().setUp()
        if not SWARMSMITH.exists():
            self.skipTest("skipped: swarmsmith is not built")
        self.lab = FilmedLab()
        self.addCleanup(self.lab.close)
        self.truth = self.folder / "truth.toml"
        self.truth.write_text(TRUTH)

    def measured(self):
        """The profile that `track profile` makes of filmed runs."""
        store = self.folder / "lab.db"
        for run in range(1, RUNS + 1):
            log = self.lab.film(f"run{run}", "--robot-logs", "--profile", self.truth, mission="grid_exploration",
                                machine="--nstates 1 --s0 0 --rwm0 30", seconds=SECONDS, seed=run)
            must(TRACK, "score", "--arena", self.lab.lab / "arena.toml", "--run", log, "--into", store)
        profile = self.folder / "lab.toml"
        made = must(TRACK, "profile", *(f"r{run}" for run in range(1, RUNS + 1)), "--store", store, "-o", profile)
        print(f"{made.stdout}\n{profile.read_text()}", file=sys.stderr)
        return profile

    def test_a_known_laboratory_comes_back_and_is_worth_designing_for(self):
        profile = self.measured()
        found = tomllib.loads(profile.read_text())
        latency_ms = sum(float(delay["time"].removesuffix(" ms")) * delay["probability"]
                         for delay in found["timing"]["delays"])
        self.assertLess(abs(latency_ms - LATENCY_MS), 0.1 * LATENCY_MS)
        self.assertLess(abs(found["treads"]["way"] - WAY), 0.1 * (1 - WAY))
        self.assertLess(abs(found["treads"]["turn"] - TURN), 0.1 * (1 - TURN))
        self.assertLess(abs(found["neighbours"]["miss_rate"] - MISS), 0.1 * MISS)
        self.assertEqual(found["neighbours"]["weak_share"], 0)
        there = {name: self.designed(name, word) for name, word in (("lab", "lab.toml"), ("rvr", "rvr"))}
        means = {name: statistics.mean(scores) for name, scores in there.items()}
        error = math.sqrt(sum(statistics.variance(scores) / len(scores) for scores in there.values()))
        print(f"{MISSION}: {means}, standard error of the difference {error:.3f}; {there}", file=sys.stderr)
        self.assertGreaterEqual(means["lab"], means["rvr"] - 2 * error)

    def designed(self, name, profile):
        """The mean score in the true laboratory of each of the machines that were designed under a profile."""
        campaign = self.folder / f"{name}.campaign.toml"
        store = self.folder / f"{name}.db"
        campaign.write_text(CAMPAIGN.format(name=name, profile=profile, mission=MISSION, designs=DESIGNS,
                                            experiments=EXPERIMENTS))
        must(SWARMSMITH, "run", campaign, "--store", store, "--workers", "2", "--no-dashboard")
        done = must(SWARMSMITH, "evaluate", "best", store, "--profile", self.truth, "--seeds", f"1001-{1000 + TESTS}",
                    "--no-store", "--json")
        scores = {}
        for line in done.stdout.splitlines():
            row = json.loads(line)
            if "seed" in row:
                scores.setdefault(row["design"], []).append(row["score"])
        self.assertEqual(len(scores), DESIGNS)
        return [statistics.mean(one) for one in scores.values()]


if __name__ == "__main__":
    unittest.main()
