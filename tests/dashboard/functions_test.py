"""Functions of the pages that need no page: texts of numbers, addresses, poses between cycles, brushes."""
import json
import os
import pathlib
import shutil
import subprocess
import unittest

from dashboards import needs_browser, shared_browser, shared_folder

HERE = pathlib.Path(__file__).resolve().parent


@needs_browser
@unittest.skipIf(shutil.which("esbuild") is None, "no esbuild: apt-get install esbuild")
class Functions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        out = shared_folder() / "functions.js"
        preact = os.environ["SWARMSMITH_PREACT"]
        subprocess.run(["esbuild", HERE / "functions.ts", "--bundle", "--format=iife", "--global-name=f", "--target=es2022", "--jsx-factory=h",
                        f"--alias:preact={preact}/preact/src/preact.js", "--log-level=error", f"--outfile={out}"], check=True)
        cls.page = shared_browser().page()
        cls.page.js(out.read_text() + "; window.f = f; 0")

    @classmethod
    def tearDownClass(cls):
        cls.page.close()

    def of(self, name, *arguments):
        return self.page.js(f"f.{name}(...{json.dumps(arguments)})")

    def test_columns_grow_by_what_is_new(self):
        before = {"v": 1, "step": [1, 2], "best": [7, None]}
        self.assertEqual(self.of("grown", before, {"v": 1, "step": [3], "best": [9]}, "step"), {"v": 1, "step": [1, 2, 3], "best": [7, None, 9]})
        self.assertEqual(self.of("grown", before, {"v": 1, "step": [], "best": []}, "step"), before)

    def test_numbers_are_read_by_people(self):
        for value, text in ((12345.6, "12\u2009346"), (999, "999"), (1000000, "1\u2009000\u2009000"), (-4321, "\u22124\u2009321"), (None, "–")):
            self.assertEqual(self.of("whole", value), text)
        for value, text in ((2.76123, "2.761"), (3, "3"), (-0.5, "\u22120.5"), (0, "0"), (None, "–")):
            self.assertEqual(self.of("number", value), text)
        for value, text in ((42, "42\u2009s"), (115, "1\u2009min 55\u2009s"), (3725, "1\u2009h 2\u2009min"), (None, "–"), (-1, "–")):
            self.assertEqual(self.of("duration", value), text)
        self.assertEqual(self.of("percent", 0.256), "26\u2009%")
        self.assertEqual([self.of("id_of", "c", value) for value in (812, "c812", None)], ["c812", "c812", None])

    def test_words_of_a_shell_are_quoted_where_they_must(self):
        self.assertEqual(self.of("shell_word", "demo.db"), "demo.db")
        self.assertEqual(self.of("shell_word", "it's; rm -rf"), "'it'\\''s; rm -rf'")

    def test_csv_reads_back(self):
        rows = [["a", "b"], ['say "x"', "1,5"], ["", "two\nlines"]]
        self.assertEqual(self.of("parse_csv", self.of("csv", rows)), rows)

    def test_no_text_of_a_csv_is_a_formula(self):
        rows = [["=1+1", "-1.5", "--s0 1", "-cmd|x", "'=1", "@a"]]
        text = self.of("csv", rows)
        self.assertEqual(text, "'=1+1,-1.5,--s0 1,'-cmd|x,''=1,'@a\r\n")
        self.assertEqual(self.of("parse_csv", text), rows)

    def test_addresses_read_back(self):
        address = self.of("href", ["c1", "d3", "race", "8"], {"step": 120, "cell": "c812,120", "q": "a&b=c #?", "none": None, "empty": ""})
        self.assertTrue(address.startswith("#/c1/d3/race/8?step=120&cell=c812,120&q="))
        self.assertEqual(self.of("parse_route", address), {"path": ["c1", "d3", "race", "8"],
                                                           "query": {"step": "120", "cell": "c812,120", "q": "a&b=c #?"}})
        self.assertEqual(self.of("match", ":c/:d/race/:iteration?", ["c1", "d3", "race"]), {"c": "c1", "d": "d3"})
        self.assertIsNone(self.of("match", ":c/:d", ["c1", "c812"]))
        self.assertIsNone(self.of("match", ":c/:candidate", ["c1", "d3"]))

    def test_a_value_holds_until_the_next(self):
        pairs = [[0, "a"], [7, "b"], [9, "c"]]
        self.assertEqual([self.of("value_at", pairs, cycle) for cycle in (0, 6, 7, 8.5, 9, 100)], list("aabbcc"))
        self.assertIsNone(self.of("value_at", [[3, "x"]], 2))
        self.assertIsNone(self.of("value_at", [], 2))

    def test_a_pose_between_two_cycles_lies_on_the_line_and_turns_the_short_way(self):
        track = {"x_mm": [0, 100, None], "y_mm": [0, -200, None], "theta_mrad": [3100, -3100, None]}
        half = self.of("pose_at", track, 0.5)
        self.assertAlmostEqual(half["x"], 0.05)
        self.assertAlmostEqual(half["y"], -0.1)
        self.assertAlmostEqual(abs(half["theta"]), 3.14159, places=3)
        self.assertIsNone(self.of("pose_at", track, 2))
        self.assertAlmostEqual(self.of("pose_at", track, 1.5)["x"], 0.1)  # where it is next is not known

    def test_axes_and_brushes(self):
        words = self.of("axis_of", "S0", ["stop", None, "attraction"])
        self.assertEqual(words["words"], ["attraction", "stop"])
        real = self.of("axis_of", "P0", [0.5, 2.5, None, 1.0])
        self.assertEqual([self.of("part_on", real, at) for at in range(4)], [0, 1, None, 0.25])
        self.assertEqual(self.of("chosen_by", [words, real], {"P0": {"from": 0.2, "to": 1}}, 4), [False, True, False, True])
        self.assertEqual(self.of("axis_of", "n", [1, 4, 2])["words"], ["1", "2", "3", "4"])
        self.assertEqual(self.of("varies", [1, 1, 1]), False)
        self.assertEqual(self.of("varies", [1, None]), True)


if __name__ == "__main__":
    unittest.main()
