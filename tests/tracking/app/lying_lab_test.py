"""Films whose laboratory does not tell the truth: tags turned, exchanged or moved, heights and edges wrong, robots pushed.
None may be VALID; the same film with the truth beside it is."""
import csv
import math
import re
import unittest

from filmed_lab import TRACK, FilmedLab, call, runs_in

LAB = None


def setUpModule():
    global LAB
    LAB = FilmedLab()


def turned(text, degrees):
    """What the offset file said before the tag was put back turned about its middle."""
    number = lambda key: float(re.search(rf"^{key} = (\S+)", text, re.M).group(1))
    x, y, yaw, a = number("x"), number("y"), number("yaw_rad"), math.radians(degrees)
    for key, value in (("x", math.cos(a) * x - math.sin(a) * y), ("y", math.sin(a) * x + math.cos(a) * y),
                       ("yaw_rad", math.remainder(yaw - a, 2 * math.pi))):
        text = re.sub(rf"^{key} = \S+", f"{key} = {value!r}", text, count=1, flags=re.M)
    return text


def pushed_aside(truth, file, robot="1", from_s=8):
    """A trajectory in which a hand pushes a robot by 0.25 m within a second, to the side."""
    with truth.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    columns = list(rows[0])
    aside = None
    for row in rows:
        time = int(row["cycle"]) / 10
        if row["robot"] != robot or time <= from_s:
            continue
        if aside is None:  # towards the middle, where nothing stands
            heading = float(row["theta"]) + math.pi / 2
            sign = -1 if math.cos(heading) * float(row["x"]) + math.sin(heading) * float(row["y"]) > 0 else 1
            aside = sign * math.cos(heading), sign * math.sin(heading)
        by = 0.25 * min(1, time - from_s)
        row["x"], row["y"] = float(row["x"]) + by * aside[0], float(row["y"]) + by * aside[1]
    with file.open("w", newline="", encoding="utf-8") as stream:
        out = csv.DictWriter(stream, columns)
        out.writeheader()
        out.writerows(rows)
    return file


class LyingLab(unittest.TestCase):
    def setUp(self):
        self.folder = LAB.folder / self.id().rsplit(".", 1)[-1]
        self.folder.mkdir()

    def lab(self, name):
        return LAB.copy_of_lab(f"{self.folder.name}/{name}").parent

    def score(self, log, lab=None):
        store = self.folder / f"{len(list(self.folder.glob('*.db')))}.db"
        done = call(TRACK, "score", "--arena", (lab or LAB.lab) / "arena.toml", "--run", log, "--into", store)
        return runs_in(store)[0][1] if runs_in(store) else "REFUSED", done.stdout + done.stderr

    def film(self):
        return LAB.film("long", mission="grid_exploration", seconds=25, seed=5)

    def test_the_truth_is_valid(self):
        verdict, text = self.score(self.film())
        self.assertEqual(verdict, "VALID", text)

    def test_a_tag_that_was_put_back_turned(self):
        for degrees in (90, 180):
            lab = self.lab(f"turned{degrees}")
            file = lab / "rvr2.offset.toml"
            file.write_text(turned(file.read_text(), degrees))
            verdict, text = self.score(self.film(), lab)
            # A robot that hardly turns on the spot may as well drive backwards: then it is doubted.
            self.assertIn(verdict, ("INVALID", "DEGRADED") if degrees == 180 else ("INVALID",), text)
            self.assertRegex(text, rf"(E_TAG_TURNED|W_HEADING_OFF).*rvr2.*turned by -?{degrees} degrees")

    def test_heights_and_edges(self):
        for what, change, verdict_wanted, code in (
                ("all lower", lambda t: re.sub(r"^height = (0\.\d+)", lambda m: f"height = {float(m[1]) - 0.1}", t,
                                               flags=re.M), "INVALID", "E_TAG_SIZE.*all robots are off alike"),
                ("one lower", lambda t: re.sub(r"^height = (0\.\d+)", lambda m: f"height = {float(m[1]) - 0.04}", t,
                                               count=1, flags=re.M), "DEGRADED", "W_TAG_SIZE.*on this robot")):
            lab = self.lab(what.replace(" ", "_"))
            arena = lab / "arena.toml"
            head, robots = arena.read_text().split("[[robot]]", 1)
            arena.write_text(head + "[[robot]]" + change(robots))
            heights = re.findall(r"^height = (\S+)", robots, re.M)
            wrong = re.findall(r"^height = (\S+)", change(robots), re.M)
            for robot, (old, new) in enumerate(zip(heights, wrong), 1):
                file = lab / f"rvr{robot}.offset.toml"
                file.write_text(re.sub(r"^height = \S+", f"height = {new}", file.read_text(), count=1, flags=re.M))
                self.assertTrue(old == new or robot == 1 or what == "all lower")
            verdict, text = self.score(self.film(), lab)
            self.assertEqual(verdict, verdict_wanted, text)
            self.assertRegex(text, code)

    def test_a_robot_that_was_pushed(self):
        # While no other robot is near, which could have pushed it.
        pushed = pushed_aside(self.film().with_name("long.trajectory.csv"), self.folder / "pushed.csv", from_s=12)
        log = LAB.film("pushed", "--trajectory", pushed, mission="grid_exploration", seconds=25, seed=5)
        verdict, text = self.score(log)
        self.assertEqual(verdict, "INVALID", text)
        self.assertRegex(text, r"E_PUSHED.*rvr2.*to the side")


if __name__ == "__main__":
    unittest.main()
