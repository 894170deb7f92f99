"""Robots that carry two tags: one of them may be hidden, and one that came loose is named."""
import json
import re
import sqlite3
import unittest

from filmed_lab import TRACK, FilmedLab, call

SECONDS = 20
LAB = None


class TwoTagLab(FilmedLab):
    WISHES = ("--two-tags",)


def setUpModule():
    global LAB
    LAB = TwoTagLab()


class SeveralTags(unittest.TestCase):
    def score(self, name, *wishes, arena=None, more=()):
        """Its answer, and what is true."""
        log = LAB.film(name, "--robot-logs", *wishes, mission="grid_exploration", seconds=SECONDS)
        done = call(TRACK, "score", "--run", log, "--arena", arena or LAB.lab / "arena.toml", "--json", *more)
        self.assertIn(done.returncode, (0, 6), done.stderr)
        answer = json.loads(done.stdout)
        answer["texts"] = {issue["code"]: issue["text"] for issue in answer["issues"]}
        return answer, json.loads(log.with_suffix(".truth.json").read_text())["score"]

    def test_calibration_has_both_tags(self):
        text = (LAB.lab / "rvr1.offset.toml").read_text()
        self.assertEqual(re.findall(r"^tag = (\d+)", text, flags=re.M), ["1", "21"])
        checked = call(TRACK, "check", LAB.lab / "arena.toml", "--json")
        robots = json.loads(checked.stdout)["robots"]
        self.assertEqual([more["tag"] for robot in robots for more in robot["more_tags"]], [21, 22, 23])

    def test_a_hidden_tag_loses_nothing(self):
        store = LAB.folder / "lab.db"
        answer, truth = self.score("covered", "--cover", "6:11", more=("--into", store))
        self.assertEqual(answer["verdict"], "VALID", answer["texts"])
        self.assertAlmostEqual(answer["score"], truth, delta=abs(0.01 * truth))
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as base:
            seen = dict(base.execute("SELECT tag, count(*) FROM real_sample WHERE robot = 0 GROUP BY tag"))
        self.assertGreater(seen[21], 300)
        self.assertAlmostEqual(seen[1], seen[21] - 5 * 15, delta=3)
        # From the store alone, with the calibrations of both tags in it.
        again = call(TRACK, "rescore", "r1", "--store", store, "--json")
        self.assertIn(f'"score":{answer["score"]},', again.stdout.replace(" ", ""), again.stderr)

    def test_the_same_with_one_tag_is_a_gap(self):
        changes = [(f"[[robot.more_tags]]\ntag = {tag}\nedge = 0.1\nheight = 0.23\n", "") for tag in (21, 22, 23)]
        arena = LAB.copy_of_lab("one_tag", arena_toml=changes)
        answer, _ = self.score("covered", "--cover", "6:11", arena=arena)
        self.assertEqual(answer["verdict"], "INVALID")
        self.assertIn("E_GAP", answer["texts"])

    def test_a_tag_that_moved_by_20_mm_is_named(self):
        for moved in ("20", "-20"):
            answer, _ = self.score("moved" + moved, "--second-moved-mm=" + moved)
            self.assertEqual(answer["verdict"], "INVALID")
            self.assertIn("rvr1 has tags 1 and 21", answer["texts"].get("E_TAGS_DISAGREE", ""), answer["texts"])
            self.assertNotIn("rvr2 has tags", answer["texts"]["E_TAGS_DISAGREE"])


if __name__ == "__main__":
    unittest.main()
