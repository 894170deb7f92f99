"""Machines of a real campaign as pictures, and as experiment files of the original simulator."""
import json
import math
import re
import shutil
import unittest
import xml.etree.ElementTree as ElementTree

from programs import ProgramTest, call

SVG = "{http://www.w3.org/2000/svg}"


class MachineExport(ProgramTest):
    budget = 1400
    tests = 2

    def setUp(self):
        super().setUp()
        self.store = self.folder / "a.db"
        done = self.run_campaign(self.store, "--workers", "1", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def export(self, form, *more):
        done = call("export", self.store, "--format", form, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
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
        self.assertEqual(len(svg.findall(SVG + "circle")), states + 1)
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
        again = call("evaluate", *text.split(), "--flavour", "watermelon-argos3", "--profile",
                     "argos3", "--mission", "aggregation", *world)
        self.assertEqual(again.returncode, 0, again.stderr)
        scores = [[json.loads(line)["score"] for line in done.stdout.splitlines()]
                  for done in (stored, again)]
        self.assertEqual(len(scores[0]), 3)
        self.assertEqual(*scores)


if __name__ == "__main__":
    unittest.main()
