"""A laboratory whose truth is known, filmed and measured: `track profile` gives latency, slip and missed neighbours
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
from programs import ProgramTest, campaign_text  # noqa: E402

SWARMSMITH = TRACK.with_name("swarmsmith")
TRUTH = """format = 1
base = "rvr"
[timing]
delays = [ {{ time = "{latency_ms} ms", probability = 1 }} ]
[treads]
way = {way}
turn = {turn}
[neighbours]
miss_rate = {miss}
"""


class Truth:
    """A laboratory, and how it is filmed."""

    def __init__(self, latency_ms, way, turn, miss, rate):
        self.latency_ms, self.way, self.turn, self.miss, self.rate = latency_ms, way, turn, miss, rate

    def __str__(self):
        return TRUTH.format(**vars(self))


DESIGNED_FOR = Truth(200, 0.85, 0.75, 0.3, 15)
OTHERS = (Truth(100, 0.95, 1.2, 0.5, 30), Truth(350, 0.7, 0.6, 0.4, 25))
RUNS = 4
SECONDS = 60
DESIGNS = int(os.environ.get("SWARMSMITH_LAB_DESIGNS", "10"))
EXPERIMENTS = int(os.environ.get("SWARMSMITH_LAB_EXPERIMENTS", "3000"))
MISSION = os.environ.get("SWARMSMITH_LAB_MISSION", "aggregation")
TESTS = 50


class LabProfile(ProgramTest):
    def setUp(self):
        super().setUp()
        if not SWARMSMITH.exists():
            self.skipTest("skipped: swarmsmith is not built")
        self.lab = FilmedLab()
        self.addCleanup(self.lab.close)

    def measured(self, truth, name):
        """The profile that `track profile` makes of filmed runs, and its file."""
        store = self.folder / f"{name}.db"
        file = self.folder / f"{name}.truth.toml"
        file.write_text(str(truth))
        for run in range(1, RUNS + 1):
            log = self.lab.film(f"{name}{run}", "--robot-logs", "--every-step", "--profile", file, "--fps", truth.rate,
                                mission="grid_exploration", machine="--nstates 1 --s0 0 --rwm0 30", seconds=SECONDS,
                                seed=run)
            must(TRACK, "score", "--arena", self.lab.lab / "arena.toml", "--run", log, "--into", store)
        profile = self.folder / f"{name}.toml"
        made = must(TRACK, "profile", *(f"r{run}" for run in range(1, RUNS + 1)), "--store", store, "-o", profile)
        print(f"{truth}{made.stdout}\n{profile.read_text()}", file=sys.stderr)
        return tomllib.loads(profile.read_text()), file

    def check(self, truth, found):
        latency_ms = sum(float(delay["time"].removesuffix(" ms")) * delay["probability"]
                         for delay in found["timing"]["delays"])
        self.assertLess(abs(latency_ms - truth.latency_ms), 0.1 * truth.latency_ms)
        self.assertLess(abs(found["treads"]["way"] - truth.way), 0.1 * abs(1 - truth.way))
        self.assertLess(abs(found["treads"]["turn"] - truth.turn), 0.1 * abs(1 - truth.turn))
        self.assertLess(abs(found["neighbours"]["miss_rate"] - truth.miss), 0.1 * truth.miss)
        self.assertEqual(found["neighbours"]["weak_share"], 0)

    def test_known_laboratories_come_back(self):
        for number, truth in enumerate(OTHERS):
            with self.subTest(latency_ms=truth.latency_ms):
                self.check(truth, self.measured(truth, f"other{number}_")[0])

    def test_a_known_laboratory_is_worth_designing_for(self):
        found, self.truth = self.measured(DESIGNED_FOR, "lab")
        self.check(DESIGNED_FOR, found)
        there = {name: self.designed(name, word) for name, word in (("lab", "lab.toml"), ("rvr", "rvr"))}
        means = {name: statistics.mean(scores) for name, scores in there.items()}
        error = math.sqrt(sum(statistics.variance(scores) / len(scores) for scores in there.values()))
        above = sum((lab > rvr) + (lab == rvr) / 2 for lab in there["lab"] for rvr in there["rvr"])
        print(f"{MISSION}: {means}, standard error of the difference {error:.3f}, Mann-Whitney U {above} of "
              f"{DESIGNS * DESIGNS}; {there}", file=sys.stderr)
        self.assertGreaterEqual(means["lab"], means["rvr"] - 2 * error)

    def designed(self, name, profile):
        """The mean score in the true laboratory of each of the machines that were designed under a profile."""
        campaign = self.folder / f"{name}.campaign.toml"
        store = self.folder / f"{name}.campaign.db"
        campaign.write_text(campaign_text(EXPERIMENTS, seed=5, tests=None, name=name, repetitions=DESIGNS, missions=[MISSION],
                                          methods=['name = "chocolate"'], profile=profile, store=None))
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
