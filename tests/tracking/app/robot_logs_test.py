"""Robots' own logs beside the film: read, checked, kept, judged again, and the latency that follows from both."""
import json
import os
import pathlib
import re
import shutil
import sqlite3
import tomllib
import unittest

from filmed_lab import BIN, TRACK, FilmedLab, call, must

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
LAB = None
LATENCY_S = 0.12
INVALID_RUN = 6
ROBOTS = ("rvr1", "rvr2", "rvr3")


def setUpModule():
    global LAB
    LAB = FilmedLab()
    LAB.film("run", "--robot-logs", "--latency-ms", round(1000 * LATENCY_S), seconds=12)


class Logged(unittest.TestCase):
    def setUp(self):
        """A copy of the run's texts, to be changed; the film is read where it is."""
        self.folder = LAB.folder / self._testMethodName
        self.folder.mkdir()
        film = LAB.film("run", "--robot-logs").parent
        for file in film.glob("run*.toml"):
            shutil.copy(file, self.folder)
        for file in film.glob("run*.csv"):
            shutil.copy(file, self.folder)
        for file in film.glob("run.mkv"):
            (self.folder / file.name).symlink_to(file)
        self.log = self.folder / "run.toml"
        self.store = self.folder / "lab.db"

    def change(self, name, before, after, count=1):
        file = self.folder / name
        text = file.read_text()
        changed = re.sub(before, after, text, count=count)
        self.assertNotEqual(text, changed, f"{name} has no {before}")
        file.write_text(changed)

    def track(self, *words, accepted=(0,)):
        done = call(TRACK, *words, "--json")
        self.assertIn(done.returncode, accepted, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def score(self, *words, accepted=(0,)):
        return self.track("score", "--arena", LAB.lab / "arena.toml", "--run", self.log, "--into", self.store,
                          *words, accepted=accepted)

    def rescore(self, *words, accepted=(0,)):
        return self.track("rescore", "r1", "--store", self.store, *words, accepted=accepted)

    def rows(self, sql):
        with sqlite3.connect(f"file:{self.store}?mode=ro", uri=True) as base:
            return base.execute(sql).fetchall()

    def codes(self, result):
        return [issue["code"] for issue in result["issues"] if "_LOG" in issue["code"] or "ROBOT_D" in issue["code"]
                or "ROBOT_I" in issue["code"]
                or issue["code"] in ("W_CLOCK_OFFSET", "W_SYNC_DIFFERS")]

    def text_of(self, result, code):
        texts = [issue["text"] for issue in result["issues"] if issue["code"] == code]
        self.assertEqual(len(texts), 1, result["issues"])
        return texts[0]


class RobotLogs(Logged):
    def test_a_good_run_tells_the_latency_and_keeps_the_commands(self):
        result = self.score()
        self.assertNotEqual(result["verdict"], "INVALID", result["reasons"])
        self.assertEqual(self.codes(result), [])
        told = [robot for robot in result["robots"] if robot["latency_s"] is not None]
        self.assertTrue(told, result["robots"])
        for robot in told:
            self.assertLess(abs(robot["latency_s"] - LATENCY_S), 0.02, robot)
            self.assertLess(robot["latency_error_s"], 0.02)
        for robot in result["robots"]:
            self.assertTrue(robot["latency_s"] is not None or robot["latency_reason"], robot)
        logs = self.rows("SELECT name, verdict, stepped, skipped, latency_s FROM v_real_logs ORDER BY robot")
        self.assertEqual([row[:4] for row in logs], [(name, "VALID", 120, 0) for name in ROBOTS])
        self.assertEqual([row[4] for row in logs], [robot["latency_s"] for robot in result["robots"]])
        # Each cycle of the camera has the command that was decided in it.
        beside = self.rows("SELECT count(*), count(l.left_mps), max(abs(c.time_s - l.time_s)) FROM v_real_cycles AS c "
                           "LEFT JOIN v_real_log_cycles AS l USING (run, cycle, robot) WHERE c.cycle > 0")[0]
        self.assertEqual(beside[:2], (360, 360))
        self.assertLess(beside[2], 1e-9)
        # From the stored rows the same follows, without the files.
        kept = {file: file.read_text() for file in self.folder.glob("run.rvr*")}
        for file in kept:
            file.unlink()
        again = self.rescore()
        self.assertEqual(again["robots"], result["robots"])
        self.assertEqual(again["issues"], result["issues"])
        report = self.track("report", "r1", "--store", self.store)
        self.assertEqual([robot["latency"]["seconds"] for robot in report["robots"]],
                         [robot["latency_s"] for robot in result["robots"]])
        self.assertEqual(report["robots"][0]["log"]["stepped"], 120)
        # What the store does not keep, the readings, was counted while they were there.
        neighbours = [robot["reality"]["neighbours"] for robot in report["robots"]]
        self.assertEqual(neighbours, [robot["reality"]["neighbours"] for robot in result["robots"]])
        self.assertTrue(all(robot["there"] == robot["seen"] for robot in neighbours), neighbours)
        for file, text in kept.items():
            file.write_text(text)
        self.check_profile()
        text = call(TRACK, "rescore", "r1", "--store", self.store).stdout
        self.assertRegex(text, r"latency \d+ ms \+- \d+\.\d ms, from its commands to its motion")
        page = call(TRACK, "report", "r1", "--store", self.store, "-o", "-").stdout
        self.assertIn("What the robots recorded themselves", page)

    def check_profile(self):
        """A profile of this run: its latency, and the base's values for what 12 s do not tell."""
        lab = self.folder / "lab.toml"
        made = self.track("profile", "r1", "--store", self.store, "-o", lab)
        self.assertEqual(made["profile"], lab.read_text())
        told = tomllib.loads(lab.read_text())
        self.assertEqual(told["base"], "rvr")
        mean_s = sum(float(delay["time"].removesuffix(" ms")) * delay["probability"]
                     for delay in told["timing"]["delays"]) / 1000
        self.assertLess(abs(mean_s - LATENCY_S), 0.02)
        whole = must(TRACK.with_name("swarmsmith"), "profile", lab)  # the program that designs takes it
        self.assertEqual(tomllib.loads(whole.stdout)["timing"]["delays"], told["timing"]["delays"])
        unknown = [figure["name"] for figure in made["figures"] if figure["mean"] is None]
        for name in unknown:
            self.assertIn(f"# {name}: as in `rvr`", lab.read_text())
        for words, said in ((("r1", "-o", lab), "already exists"),
                            (("r1", "-o", self.folder / "rvr.toml"), "is built in"),
                            (("r1", "r1"), "r1: is named twice"), ((self.log,), "name its arena file"),
                            (("r7",), "r7"), (("r1", "--base", "mars"), "mars"),
                            (("r1", "--base", "epuck"), "give another --base (rvr, argos3, pseudo-reality, thesis-robots, epuck-ideal), or runs of another robot")):
            done = call(TRACK, "profile", *words, "--store", self.store)
            self.assertNotEqual(done.returncode, 0, done.stdout)
            self.assertIn(said, done.stderr)
        # The same run by another name.
        for runs in ((self.log, f"{self.folder}/./run.toml"), ("r1", self.log)):
            done = call(TRACK, "profile", *runs, "--store", self.store, "--arena", LAB.lab / "arena.toml")
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertRegex(done.stderr, f"{runs[0]} and {runs[1]} have the same log of rvr1, so they are one run")
        must(TRACK, "override", "r1", "--store", self.store, "--verdict", "invalid", "--who", "A", "--reason", "seen")
        done = call(TRACK, "profile", "r1", "--store", self.store)
        self.assertEqual(done.returncode, 1)
        self.assertIn("r1 run is INVALID", done.stderr)

    def test_verdicts_of_nodes_enter_that_of_the_run(self):
        self.change("run.rvr1.toml", r'verdict = "VALID"\nreasons = \[\]',
                    'verdict = "DEGRADED"\nreasons = ["1.5 % of the cycles were skipped"]')
        result = self.score()
        self.assertEqual(result["verdict"], "DEGRADED")
        self.assertEqual(self.codes(result), ["W_ROBOT_DEGRADED"])
        self.assertIn("rvr1: its node says that its run is DEGRADED: 1.5 % of the cycles", result["reasons"][0])
        # What `start` heard is worse, and has no log to go with it.
        self.change("run.toml", r'name = "rvr2"\n', 'name = "rvr2"\nverdict = "INVALID"\nreasons = ["silent"]\n')
        again = self.rescore("--run", self.log, accepted=(INVALID_RUN,))
        self.assertEqual(again["verdict"], "INVALID")
        self.assertEqual(self.codes(again), ["W_ROBOT_DEGRADED", "E_ROBOT_INVALID"])

    def test_a_missing_log_is_said_and_can_be_given_later(self):
        for ending in ("log.csv", "toml"):
            (self.folder / f"run.rvr2.{ending}").rename(self.folder / f"kept.{ending}")
        result = self.score()
        self.assertEqual(result["verdict"], "DEGRADED")
        self.assertEqual(self.codes(result), ["W_LOG_UNREADABLE"])
        self.assertIn("rvr2: its log cannot be read", self.text_of(result, "W_LOG_UNREADABLE"))
        self.assertIn("run.rvr2.", self.text_of(result, "W_LOG_UNREADABLE"))
        self.assertEqual(len(self.rows("SELECT * FROM v_real_logs")), 2)
        self.assertEqual(self.codes(self.rescore()), ["W_LOG_UNREADABLE"])
        for ending in ("log.csv", "toml"):
            (self.folder / f"kept.{ending}").rename(self.folder / f"run.rvr2.{ending}")
        again = self.rescore("--run", self.log)
        self.assertEqual(self.codes(again), [])
        self.assertEqual(len(self.rows("SELECT * FROM v_real_logs")), 3)
        # And stays when the file goes away again.
        (self.folder / "run.rvr2.log.csv").unlink()
        self.assertEqual(self.codes(self.rescore("--run", self.log)), [])
        self.assertEqual(len(self.rows("SELECT * FROM v_real_logs")), 3)

    def test_foreign_logs_are_left_out(self):
        self.change("run.rvr1.toml", r'run = "run"', 'run = "run06"')
        self.change("run.rvr2.toml", r'robot = "rvr2"', 'robot = "rvr3"')
        self.change("run.rvr3.toml", r'lock_step = false', 'lock_step = true')
        result = self.score(accepted=(INVALID_RUN,))
        self.assertEqual(self.codes(result), ["E_LOG_FOREIGN"] * 3)
        texts = [issue["text"] for issue in result["issues"] if issue["code"] == "E_LOG_FOREIGN"]
        self.assertIn("is of run run06, this is run", texts[0])
        self.assertIn("is of robot rvr3", texts[1])
        self.assertIn("simulated world", texts[2])
        self.assertEqual(self.rows("SELECT * FROM v_real_logs"), [])

    def test_logs_of_two_machines_do_not_fit(self):
        self.change("run.rvr3.toml", r'machine_digest = "[0-9a-f]*"', 'machine_digest = "00"')
        result = self.score(accepted=(INVALID_RUN,))
        self.assertEqual(self.codes(result), ["E_LOG_FOREIGN"])
        self.assertIn("digest 00, and rvr1 ran one with", self.text_of(result, "E_LOG_FOREIGN"))

    def test_a_log_that_ends_early_is_of_a_node_that_was_killed(self):
        file = self.folder / "run.rvr1.log.csv"
        lines = file.read_text().splitlines(keepends=True)
        file.write_text("".join(lines[:61]) + lines[61][:20])
        self.change("run.rvr1.toml", r'\n\[end\](.|\n)*', '\n')
        result = self.score(accepted=(INVALID_RUN,))
        self.assertEqual(self.codes(result), ["W_ROBOT_DEGRADED", "E_LOG_SHORT"])
        self.assertIn("its log ends at 6.0 s of 12 s", self.text_of(result, "E_LOG_SHORT"))
        self.assertEqual(self.rows("SELECT verdict, stepped FROM v_real_logs WHERE name = 'rvr1'"), [(None, 60)])

    def test_a_clock_that_is_off_is_said(self):
        self.change("run.rvr2.toml", r'(start_unix_s = .*\n)', r'\1clock_offset_s = -0.045\n')
        result = self.score()
        self.assertEqual(self.codes(result), ["W_CLOCK_OFFSET"])
        self.assertIn("rvr2: its clock was 45 ms behind the operator's", self.text_of(result, "W_CLOCK_OFFSET"))

    def test_swapped_logs_do_not_fit_the_motion(self):
        self.change("run.toml", r'run\.rvr1\.log\.csv', 'x.log.csv')
        self.change("run.toml", r'run\.rvr2\.log\.csv', 'run.rvr1.log.csv')
        self.change("run.toml", r'x\.log\.csv', 'run.rvr2.log.csv')
        for name, other in (("rvr1", "rvr2"), ("rvr2", "rvr1")):
            self.change(f"run.{name}.toml", f'robot = "{name}"', f'robot = "{other}"')
        result = self.score()
        self.assertIn("W_MOTION_UNLIKE_LOG", self.codes(result))
        self.assertEqual(result["verdict"], "DEGRADED")
        self.assertIn("were tags or logs swapped", json.dumps(result["reasons"]))

    def test_a_wrong_start_is_seen_in_the_motion(self):
        result = self.score("--start", "1.9 s", accepted=(0, INVALID_RUN))
        self.assertIn("W_MOTION_UNLIKE_LOG", self.codes(result))
        self.assertIn("is the start of the run right?", json.dumps(result["issues"]))

    def test_a_start_and_a_tag_check_each_other(self):
        # The tag is never covered in this film.
        self.change("run.toml", r'start = "1.2 s"\n', 'start = "1.2 s"\nsync = { tag = 99, when = "hidden" }\n')
        result = self.score()
        self.assertEqual(self.codes(result), ["W_SYNC_DIFFERS"])
        self.assertIn("`start` could not be checked", self.text_of(result, "W_SYNC_DIFFERS"))

    def test_unknown_robots_and_words_are_refused(self):
        self.change("run.toml", r'name = "rvr3"', 'name = "rvr9"')
        done = call(TRACK, "score", "--arena", LAB.lab / "arena.toml", "--run", self.log)
        self.assertEqual(done.returncode, 2)
        self.assertIn("rvr9", done.stderr)
        self.assertIn("E_CONFIG", done.stderr)


class Designed(Logged):
    """Runs of a store that has a design, d1, for aggregation."""

    def setUp(self):
        super().setUp()
        must(BIN / "swarmsmith", "backup", SOURCE / "tests/golden/stores/schema-6.sqlite", self.store)

    def with_design(self):
        self.change("run.toml", r'\nstart = ', '\ndesign = "d1"\nstart = ')

    def test_a_candidate_for_another_mission_is_refused(self):
        self.score()
        self.with_design()
        self.change("run.toml", r'mission = ".*"', 'mission = "grid_exploration"')
        done = call(TRACK, "rescore", "r1", "--store", self.store, "--run", self.log)
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertIn('was designed for mission "aggregation", but the run is of mission "grid_exploration"', done.stderr)
        self.assertEqual(self.rows("SELECT mission, candidate FROM v_real_runs"), [("aggregation", None)])

    def test_a_log_that_is_kept_must_be_of_the_design(self):
        self.score()
        self.with_design()
        for file in self.folder.glob("run.rvr*"):
            file.unlink()
        again = self.rescore("--run", self.log, accepted=(INVALID_RUN,))
        self.assertEqual(self.codes(again), ["E_LOG_FOREIGN"] * 3)

    def test_a_profile_of_a_run_log_finds_its_design_in_the_store(self):
        self.with_design()
        self.change("run.toml", r'design = "d1"', 'design = "d9"')
        done = call(TRACK, "profile", self.log, "--arena", LAB.lab / "arena.toml", "--store", self.store)
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertIn("no design d9", done.stderr)


class Sync(unittest.TestCase):
    def test_a_tag_that_was_covered_when_the_run_began_confirms_the_start_and_another_does_not(self):
        log = LAB.film("synced", "--sync", seconds=3)
        text = log.read_text()
        for start, codes in (("1.2", []), ("0.1", ["W_SYNC_DIFFERS"])):
            log.write_text(text.replace("sync =", f'start = "{start} s"\nsync ='))
            done = call(TRACK, "score", "--arena", LAB.lab / "arena.toml", "--run", log, "--json")
            result = json.loads(done.stdout)
            self.assertEqual([issue["code"] for issue in result["issues"] if issue["code"] == "W_SYNC_DIFFERS"], codes)


if __name__ == "__main__":
    unittest.main()
