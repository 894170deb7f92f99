"""Machines of a real campaign as pictures, and as experiment files of the original simulator."""
import json
import math
import re
import shutil
import unittest
import xml.etree.ElementTree as ElementTree

from programs import ProgramTest, call, ended_well

SVG = "{http://www.w3.org/2000/svg}"


class MachineExport(ProgramTest):
    budget = 1400
    tests = 2

    def setUp(self):
        super().setUp()
        self.store = self.folder / "a.db"
        ended_well(self.run_campaign(self.store, "--workers", "1", "--quiet"))

    def export(self, form, *more):
        done = ended_well(call("export", self.store, "--format", form, *more))
        return done.stdout

    def machine(self):
        return self.export("fsm-config").splitlines()[-1].removeprefix("--fsm-config ")

    def test_pictures_show_every_state_and_transition(self):
        words = self.machine().split()
        states = int(words[1])
        transitions = sum(word.startswith("--c") for word in words)
        svg = ElementTree.fromstring(self.export("svg", "--width", "174mm"))
        self.assertEqual(svg.get("width"), "174mm")
        # The initial state has two circles.
        self.assertEqual(len(svg.findall(f".//{SVG}circle")), states + 1)
        curves = [path for path in svg.findall(SVG + "path") if "Q" in path.get("d")]
        self.assertEqual(len(curves), transitions)
        tikz = self.export("tikz")
        self.assertEqual(tikz.count("controls"), transitions)
        self.assertEqual(tikz.count("{"), tikz.count("}"))
        dot = self.export("dot")
        self.assertEqual(len(re.findall(r"shape=(?:double)?circle", dot)), states)
        self.assertEqual(dot.count("shape=hexagon"), transitions)
        # The same store, the same bytes.
        self.assertEqual(self.export("svg"), self.export("svg"))

    def test_pdf_is_the_same_each_time(self):
        if shutil.which("rsvg-convert") is None:
            self.skipTest("rsvg-convert (package librsvg2-bin) is not there")
        one, two = self.folder / "1.pdf", self.folder / "2.pdf"
        self.export("pdf", "-o", one)
        self.export("pdf", "-o", two)
        self.assertTrue(one.read_bytes().startswith(b"%PDF"))
        self.assertEqual(one.read_bytes(), two.read_bytes())

    def test_experiment_file_has_what_the_original_reads(self):
        text = self.export("argos", "--seed", "12")
        root = ElementTree.fromstring(text)
        self.assertEqual(root.tag, "argos-configuration")
        # The sections that the simulator asks for, and the controller's devices.
        self.assertEqual([child.tag for child in root],
                         ["framework", "loop_functions", "controllers", "arena", "physics_engines",
                          "media"])
        self.assertEqual(root.find("framework/experiment").attrib,
                         {"length": "120", "ticks_per_second": "10", "random_seed": "12"})
        controller = root.find("controllers/automode_controller")
        self.assertEqual({device.tag for device in controller.find("sensors")},
                         {"rvr_proximity", "rvr_light", "rvr_lidar", "rvr_ground",
                          "colored_blob_omnidirectional_camera"})
        self.assertEqual({device.tag for device in controller.find("actuators")},
                         {"rvr_wheels", "rvr_rgb_leds"})
        self.assertEqual(controller.find("params").get("fsm-config"), self.machine())
        self.assertEqual(controller.find("params").get("velocity"), "30")
        for robot in root.findall("arena/rvr"):
            self.assertEqual(robot.find("controller").get("config"), controller.get("id"))
        self.assertEqual(len(root.findall("arena/rvr")), 3)
        walls = root.findall("arena/box")
        self.assertEqual(len(walls), 12)
        for wall in walls:
            x, y, _ = map(float, wall.find("body").get("position").split(","))
            turn = float(wall.find("body").get("orientation").split(",")[0])
            # A regular dodecagon, each wall across the way to the middle.
            self.assertAlmostEqual(math.hypot(x, y), 1.231, delta=0.001)
            across = (math.degrees(math.atan2(y, x)) - turn) % 180
            self.assertLess(min(across, 180 - across), 0.1)
        # The medium of the camera is there.
        self.assertEqual(root.find("media/led").get("id"),
                         controller.find("sensors/colored_blob_omnidirectional_camera").get("medium"))

    def test_the_machine_of_an_experiment_file_scores_as_the_stored_one(self):
        root = ElementTree.fromstring(self.export("argos"))
        text = root.find("controllers/automode_controller/params").get("fsm-config")
        best = self.query(self.store, "SELECT best_candidate FROM v_designs")[0]["best_candidate"]
        world = ("--seeds", "1-3", "--json")
        stored = call("evaluate", f"c{best}", "--store", self.store, "--no-store", *world)
        again = ended_well(call("evaluate", *text.split(), "--flavour", "watermelon-argos3", "--profile",
                                "argos3", "--mission", "aggregation", *world))
        scores = [[json.loads(line)["score"] for line in done.stdout.splitlines()]
                  for done in (stored, again)]
        self.assertEqual(len(scores[0]), 3)
        self.assertEqual(*scores)


class WholeCampaign(ProgramTest):
    """Everything that a score needs can be taken out of a store."""

    made = None  # the store, as the first test has made it

    def setUp(self):
        super().setUp()
        self.file.write_text("""format = 1
[campaign]
seed = 5
repetitions = 2
[[mission]]
name = "aggregation"
  [mission.instances]
  test = { count = 4 }
[[mission]]
name = "color_selection"
  [mission.instances]
  test = { count = 4 }
[[method]]
name = "watermelon"
[[method]]
name = "by_hand"
flavour = "watermelon-argos3"
turn_clock = "seconds"
baseline = "--nstates 2 --s0 0 --rwm0 5 --n0 1 --n0x0 0 --c0x0 6 --p0x0 1 --l0x0 3 --s1 1"
[[method]]
name = "chance"
flavour = "chocolate"
baseline = "random"
[race]
max_experiments = 1400
""")
        self.store = self.folder / "a.db"
        if WholeCampaign.made is None:
            ended_well(self.run_campaign(self.store, "--workers", "2", "--quiet"))
            WholeCampaign.made = self.store.read_bytes()
        else:
            self.store.write_bytes(WholeCampaign.made)

    def stored(self, design):
        return {row["seed"]: row["score"] for row in self.query(
            self.store, f"SELECT seed, score FROM v_design_scores WHERE design = {design}")}

    def scores(self, *words):
        done = ended_well(call("evaluate", *words, "--json"))
        return {run["seed"]: run["score"] for run in map(json.loads, done.stdout.splitlines())}

    def test_each_winner_of_a_file_scores_as_stored_without_a_flag(self):
        folder = self.folder / "machines"
        folder.mkdir()
        self.assertEqual(call("export", self.store, "-o", folder).returncode, 0)
        files = sorted(folder.iterdir())
        self.assertEqual(len(files), 10)  # 2 missions; 2 designs, 2 random machines, and the one by hand
        for file in files:
            design = int(re.match(r"d(\d+)-", file.name)[1])
            stored = self.stored(design)
            self.assertEqual(len(stored), 4)
            self.assertEqual(self.scores(file), stored, file.name)

    def test_tables_of_starts_and_patches_are_what_was_scored(self):
        for what, columns in (("starts", "seed,robot,x,y,theta"), ("patches", "seed,x,y,color")):
            table = self.folder / f"{what}.csv"
            ended_well(call("export", self.store, "--what", what, "--mission", "color_selection", "-o", table))
            self.assertEqual(table.read_text().splitlines()[0], columns)
        machine = self.folder / "machine.fsm"
        design = self.query(self.store, "SELECT design FROM v_designs WHERE mission = 'color_selection' "
                                        "AND method = 'watermelon'")[0]["design"]
        self.assertEqual(call("export", self.store, "--design", f"d{design}", "-o", machine).returncode, 0)
        given = ("--starts", self.folder / "starts.csv", "--patches", self.folder / "patches.csv")
        self.assertEqual(self.scores(machine, *given), self.stored(design))
        # Other patches, other scores: the table is what counts.
        other = {"yellow": "green", "green": "yellow"}
        lines = re.sub("yellow|green", lambda color: other[color[0]], (self.folder / "patches.csv").read_text())
        (self.folder / "patches.csv").write_text(lines)
        self.assertNotEqual(self.scores(machine, *given), self.stored(design))

    def test_patches_are_read_if_only_a_later_design_shuffles_some(self):
        table = self.folder / "patches.csv"
        ended_well(call("export", self.store, "--what", "patches", "-o", table))
        seed = int(table.read_text().splitlines()[1].split(",")[0])
        first = self.query(self.store, "SELECT mission FROM v_designs WHERE design = 1")[0]["mission"]
        self.assertEqual(first, "aggregation", "it shuffles no patches")
        words = ("evaluate", "best", self.store, "--no-store", "--json", "--seeds", str(seed), "--patches", table)
        as_drawn = ended_well(call(*words))
        self.assertNotIn("--patches is not used", as_drawn.stderr)
        other = {"yellow": "green", "green": "yellow"}
        table.write_text(re.sub("yellow|green", lambda color: other[color[0]], table.read_text()))
        self.assertNotEqual(ended_well(call(*words)).stdout, as_drawn.stdout)

    def test_a_table_is_of_one_mission(self):
        done = call("export", self.store, "--what", "starts")
        self.assertEqual(done.returncode, 2)
        self.assertIn("aggregation, color_selection", done.stderr)
        self.assertEqual(call("export", self.store, "--what", "patches").returncode, 0)  # one has some
        done = call("export", self.store, "--what", "patches", "--design", "d1")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(call("export", self.store, "--mission", "aggregation").returncode, 2)

    def test_the_supplement_has_them(self):
        folder = self.folder / "supplement"
        self.assertEqual(call("supplement", self.store, "-o", folder).returncode, 0)
        self.assertEqual(sorted(file.name for file in (folder / "instances").iterdir()),
                         ["aggregation-starts.csv", "color_selection-patches.csv",
                          "color_selection-starts.csv"])
        self.assertIn("instances/*-patches.csv", (folder / "README.md").read_text())

    def test_words_stand_in_one_order_and_the_old_one_is_understood(self):
        sql = "SELECT count(*) AS n FROM v_designs"
        self.assertEqual(call("query", sql, self.store).stdout, call("query", self.store, sql).stdout)
        ended_well(call("evaluate", "best", self.store, "--design", "d1", "--seeds", "1", "--no-store"))
        done = call("evaluate", "--nstates 1 --s0 1", self.store, "--flavour", "watermelon", "--mission", "aggregation")
        self.assertEqual(done.returncode, 2)
        self.assertIn("unexpected word", done.stderr)

    def test_numbers_of_latex_are_mathematics(self):
        done = ended_well(call("compare", self.store, "--by", "method", "--paper", "latex"))
        self.assertIn("difference of the means $", done.stdout)
        self.assertNotRegex(re.sub(r"\$[^$]*\$", "", done.stdout), r"-[0-9]")

    def test_a_finished_store_has_no_worker_at_work(self):
        self.assertNotIn("connected", call("status", self.store).stdout)

    def test_many_pictures_are_no_file(self):
        done = call("export", self.store, "--format", "svg", "-o", self.folder / "all.svg")
        self.assertEqual(done.returncode, 2)
        self.assertFalse((self.folder / "all.svg").exists())

    def test_baselines_are_methods_in_tables_and_report(self):
        self.assert_clean(self.store)
        rows = self.query(self.store, "SELECT method, used, budget, state FROM v_designs "
                                      "WHERE mission = 'aggregation' AND repetition = 1")
        self.assertEqual([(row["method"], row["state"]) for row in rows],
                         [("watermelon", "finished"), ("by_hand", "finished"), ("chance", "finished")])
        self.assertEqual([row["used"] > 0 for row in rows], [True, False, False])
        compared = call("compare", self.store, "--by", "method", "--csv").stdout
        self.assertIn("by_hand", compared)
        report = self.folder / "report.html"
        self.assertEqual(call("report", self.store, "-o", report).returncode, 0)
        self.assertIn("by_hand", report.read_text())


class NoNumber(ProgramTest):
    """A score that is not a finite number is reported by every program that computes it."""

    def test_is_told_by_each_command(self):
        mission = self.folder / "nan.toml"
        mission.write_text('format = 1\nduration = "5 s"\n[score]\nkind = "formula"\nvalue = "0 / (x - x)"\n')
        done = call("evaluate", "--nstates", "1", "--s0", "1", "--flavour", "watermelon", "--mission", mission)
        self.assertEqual(done.returncode, 1)
        self.assertIn("seed 1: the score is not a number", done.stderr)
        self.assertNotIn("mean", done.stdout)
        self.file.write_text('format = 1\n[[mission]]\npreset = "nan.toml"\n[[method]]\nname = "watermelon"\n'
                             "[race]\nmax_experiments = 1400\n")
        self.assertIn("not a finite number", call("check", self.file).stderr)
        done = self.run_campaign(self.folder / "a.db", "--workers", "1", "-q")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, "stopped after .*: every configuration was rejected")


if __name__ == "__main__":
    unittest.main()
