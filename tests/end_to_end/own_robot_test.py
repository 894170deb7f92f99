"""A robot of one's own, as docs/robots.md describes it with a TurtleBot 4: runs, pictures, a campaign and its report,
and what is refused in one sentence."""
import json
import os
import pathlib
import shutil
import unittest

from programs import ProgramTest, call, campaign_text, ended_well

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
MISSION = """\
format   = 1
name     = "turtles"
robots   = 4
duration = "30 s"
robot    = "turtlebot4.toml"

[arena]
shape  = "rectangle"
width  = 6
height = 4
floor  = "gray"
spots  = [{ shape = "circle", x = 1.5, y = 0, diameter = 1.2, color = "black" }]

[score]
kind  = "robots_on"
color = "black"
at    = "end"
"""
TURNING = ("--nstates", "1", "--s0", "0", "--rwm0", "20")


class OwnRobot(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copy(SOURCE / "examples/missions/robots/turtlebot4.toml", self.folder)
        self.mission = self.folder / "turtles.toml"
        self.mission.write_text(MISSION)

    def evaluate(self, *words):
        return call("evaluate", *TURNING, "--flavour", "chocolate", "--mission", self.mission, *words)

    def test_it_runs_and_is_drawn(self):
        picture = self.folder / "run.svg"
        ended_well(self.evaluate("--seeds", "1", "--svg", picture))
        self.assertIn("</svg>", picture.read_text())
        rows = self.evaluate("--seeds", "1", "--csv", "-").stdout.splitlines()
        self.assertEqual(rows[0].split(",")[:5], ["cycle", "time_s", "robot", "x", "y"])
        places = [[float(cell) for cell in row.split(",")[3:5]] for row in rows[1:] if row[:1].isdigit()]
        self.assertEqual(len(places), 4 * 301)
        # The disc of 0.17 m stays within the walls.
        self.assertLess(max(abs(x) for x, _ in places), 3 - 0.16)
        self.assertLess(max(abs(y) for _, y in places), 2 - 0.16)

    def test_a_ring_of_24_sensors_has_24_columns(self):
        angles = [7.5 + 15 * sensor for sensor in range(24)]
        (self.folder / "footbot.toml").write_text(
            f"format = 1\n[body]\nshape = \"circle\"\ndiameter = 0.17\n[proximity]\nrays = {angles}\n")
        self.mission.write_text(MISSION.replace("turtlebot4", "footbot"))
        rows = ended_well(self.evaluate("--seeds", "1", "--csv", "-", "--readings", "proximity,light_ring")).stdout.splitlines()
        head = rows[0].split(",")
        self.assertEqual([name for name in head if name.startswith(("light", "proximity"))],
                         [f"light{i}_lux" for i in range(24)] + [f"proximity{i}_m" for i in range(24)])
        cells = [dict(zip(head, row.split(","))) for row in rows[1:] if row[:1].isdigit()]
        for i in range(24):
            self.assertTrue(any(row[f"proximity{i}_m"] not in ("", "inf") for row in cells), i)

    def test_a_campaign_of_it_goes_on_without_its_files(self):
        self.file.write_text(campaign_text(1350, tests=3, missions=("turtles.toml",), profile="rvr",
                                           methods=('name = "chocolate"',)).replace('name = "turtles.toml"', 'preset = "turtles.toml"'))
        store = self.folder / "turtles.db"
        ended_well(call("run", self.file, "--store", store, "--no-dashboard", "--workers", "2"))
        for file in ("turtlebot4.toml", "turtles.toml"):
            (self.folder / file).unlink()
        best = ended_well(call("evaluate", "best", store, "--seeds", "1-2", "--json"))
        self.assertEqual(len(best.stdout.splitlines()), 2, best.stdout)
        evaluation = json.loads(best.stdout.splitlines()[0])["id"]
        ended_well(call("replay", evaluation, store, "--json"))
        ended_well(call("export", store, "-o", self.folder / "machines"))

    def test_what_does_not_fit_is_refused_in_a_sentence(self):
        robot = self.folder / "turtlebot4.toml"
        whole = robot.read_text()
        for old, new, words in (
                ("diameter       = 0.342", "diameter       = -0.342", "turtlebot4.toml:"),
                ("rays   = [65.3,", "rays   = [65.3," + 18 * " 1,", "`rays` has 25 sensors; at most 24 are allowed"),
                ("diameter       = 0.342", "diameter       = 0.342\ninertia = 1e-30", "`inertia` is 1e-30 kg m2"),
                ("range  = 2.0", "range  = 2.0\nless = 3", "all distances would be 0"),
                ("out    = 0.17", "out    = 0.6", "`out` is 0.6 m from the centre"),
                ("[ground]", "[grond]", 'did you mean "ground"'),
                ("track     = 0.233", "track     = 0", "`track`")):
            self.assertIn(old, whole)
            robot.write_text(whole.replace(old, new))
            done = self.evaluate("--seeds", "1")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(words, done.stderr)
        robot.unlink()
        self.assertIn("turtlebot4.toml", self.evaluate("--seeds", "1").stderr)


if __name__ == "__main__":
    unittest.main()
