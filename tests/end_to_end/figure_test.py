"""Figures of a real campaign, as the program writes them."""
import csv
import json
import os
import pathlib
import shutil
import stat
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml

from programs import SWARMSMITH, call, campaign_text, ended_well

SVG = "{http://www.w3.org/2000/svg}"
#: Kinds with the options that they need, and the least number of rows in their tables.
KINDS = {"box": ([], 20), "scores": ([], 20), "modules": ([], 3), "convergence": ([], 2),
         "trajectories": (["--design", "d1"], 4 * 3 * 1201)}


class Figure(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.store = cls.folder / "campaign.db"
        file = cls.folder / "campaign.toml"
        file.write_text(campaign_text(1400, seed=7, tests=20))
        done = call("run", file, "--store", cls.store, "--workers", "2", "--no-dashboard", "-q")
        assert done.returncode == 0, done.stderr

    def figure(self, kind, *options):
        done = ended_well(call("figure", kind, self.store, *options))
        return done.stdout

    def refused(self, code, *words):
        """Standard error of a call that must fail and write nothing."""
        before = sorted(self.folder.iterdir())
        done = call("figure", *words)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(self.folder.iterdir()), before)
        return done.stderr

    def test_every_kind_is_drawn(self):
        for kind, (options, rows) in KINDS.items():
            with self.subTest(kind=kind):
                root = xml.fromstring(self.figure(kind, *options))
                self.assertEqual(root.get("width"), "84mm")
                texts = [element.text for element in root.iter(SVG + "text")]
                self.assertTrue(any("aggregation" in text for text in texts), texts)
                self.assertEqual(self.figure(kind, *options), self.figure(kind, *options, "-o", "-"))
                table = self.folder / f"{kind}.csv"
                done = call("figure", kind, self.store, *options, "-o", table, "--json")
                answer = json.loads(done.stdout)
                with open(table, newline="") as stream:
                    lines = list(csv.DictReader(stream, strict=True))
                self.assertEqual(answer,
                                 {"figure": kind, "file": str(table), "points": len(lines)})
                self.assertGreaterEqual(len(lines), rows)
                self.assertNotIn(None, set().union(*lines))
                table.unlink()

    def test_its_numbers_are_those_of_the_views(self):
        table = self.folder / "box.csv"
        self.figure("box", "-o", table)
        with open(table, newline="") as stream:
            scores = [float(row["score"]) for row in csv.DictReader(stream)]
        table.unlink()
        done = call("query", self.store, "SELECT score FROM v_design_scores ORDER BY pair",
                    "--json")
        self.assertEqual(scores, [row["score"] for row in json.loads(done.stdout)["rows"]])

    def test_runs_are_those_of_the_seeds(self):
        table, replayed = self.folder / "figure.csv", self.folder / "replay.csv"
        self.figure("trajectories", "--candidate", "c1", "--seed", "7", "--seed", "8", "-o", table)
        ended_well(call("replay", "c1", self.store, "--seed", "8", "--csv", replayed))
        with open(table, newline="") as one, open(replayed, newline="") as other:
            rows = [row for row in csv.DictReader(one) if row["seed"] == "8"]
            expected = list(csv.DictReader(other))
        columns = ("cycle", "robot", "x", "y", "theta")
        self.assertEqual([[row[c] for c in columns] for row in rows],
                         [[row[c] for c in columns] for row in expected])
        table.unlink()
        replayed.unlink()

    def test_widths_are_those_asked_for(self):
        root = xml.fromstring(self.figure("box", "--width", "3.5in"))
        self.assertEqual(root.get("width"), "88.9mm")
        self.assertIn("60mm to 1000mm", self.refused(2, "box", self.store, "--width", "2mm"))

    @unittest.skipUnless(shutil.which("rsvg-convert"), "needs rsvg-convert of librsvg2-bin")
    def test_pdfs_are_the_same_each_time(self):
        first, second = self.folder / "a.pdf", self.folder / "b.pdf"
        self.figure("box", "-o", first)
        self.figure("box", "-o", second)
        self.assertTrue(first.read_bytes().startswith(b"%PDF"))
        self.assertEqual(first.read_bytes(), second.read_bytes())
        first.unlink()
        second.unlink()

    def test_without_the_converter_the_package_is_named(self):
        file = self.folder / "a.pdf"
        done = subprocess.run([SWARMSMITH, "figure", "box", str(self.store), "-o", str(file)],
                              env={"PATH": str(self.folder)}, capture_output=True, text=True,
                              timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("librsvg2-bin", done.stderr)
        self.assertFalse(file.exists())

    def test_a_file_is_written_whole_or_not_at_all(self):
        file = self.folder / "figure.svg"
        older = "<svg>older</svg>"
        file.write_text(older)
        self.assertIn("no design d9", self.refused(4, "box", self.store, "-o", file, "--design", "d9"))
        self.assertEqual(file.read_text(), older)
        notes = self.folder / "notes.svg"
        notes.write_text("of a person")
        self.assertIn("is a text, not an SVG picture",
                      self.refused(1, "box", self.store, "-o", notes))
        self.assertEqual(notes.read_text(), "of a person")
        link = self.folder / "link.svg"
        link.symlink_to(file)
        self.figure("box", "-o", link)
        self.assertTrue(link.is_symlink())
        self.assertEqual(file.read_text(), self.figure("box"))
        self.assertEqual([f.name for f in self.folder.iterdir() if ".part" in f.name], [])
        link.unlink()
        file.unlink()
        self.assertIn("there is no folder",
                      self.refused(1, "box", self.store, "-o", self.folder / "no" / "a.svg"))

    def test_a_pipe_stays_a_pipe(self):
        pipe = self.folder / "pipe.svg"
        os.mkfifo(pipe)
        program = subprocess.Popen([SWARMSMITH, "figure", "box", self.store, "-o", pipe])
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        with open(pipe) as stream:
            self.assertEqual(stream.read(), self.figure("box"))
        self.assertEqual(program.wait(60), 0)
        self.assertTrue(stat.S_ISFIFO(pipe.stat().st_mode))
        pipe.unlink()

    def test_the_kinds_are_told(self):
        done = call("figure")
        self.assertEqual(done.returncode, 0)
        kinds = json.loads(call("figure", "--json").stdout)["kinds"]
        self.assertTrue(set(KINDS) <= {kind["kind"] for kind in kinds})
        usage = " ".join(call("figure", "--help").stdout.split())
        for kind in kinds:
            self.assertIn(kind["summary"], done.stdout)
            self.assertIn(kind["summary"], usage)

    def test_gap_is_the_change_from_the_tests_to_another_source(self):
        own = self.folder / "gap.db"
        shutil.copy(self.store, own)
        self.assertEqual(call("evaluate", "best", own, "--profile", "pseudo-reality", "--seeds", "1-3", "-q").returncode, 0)
        rows = json.loads(call("query", "SELECT source, avg(score) AS mean, count(*) AS runs FROM v_design_scores "
                               "GROUP BY source", own, "--json").stdout)["rows"]
        views = {row["source"]: row for row in rows}
        table = self.folder / "gap.csv"
        ended_well(call("figure", "gap", own, "-o", table))
        with open(table, newline="") as stream:
            drawn = {row["source"]: row for row in csv.DictReader(stream)}
        self.assertEqual(set(drawn), {"argos3", "pseudo-reality"})
        for source, row in drawn.items():
            self.assertEqual(float(row["mean"]), views[source]["mean"])
            self.assertEqual(int(row["runs"]), views[source]["runs"])
            self.assertEqual(row["reference_source"], "argos3")
            self.assertEqual(float(row["change"]), views[source]["mean"] - views["argos3"]["mean"])
        texts = " ".join(t.text for t in xml.fromstring(call("figure", "gap", own).stdout).iter(SVG + "text"))
        self.assertIn("runs a design: argos3 20, pseudo-reality 3", texts)
        self.assertIn("too few for a test", texts)
        table.unlink()
        for file in self.folder.glob("gap.db*"):
            file.unlink()

    def test_a_paper_has_its_font_and_pixels(self):
        svg = self.figure("box", "--paper", "--font", "Linux Libertine")
        self.assertIn("font-family=\"'Linux Libertine', Helvetica", svg)
        self.assertNotIn("Scores by", svg)
        for font in ("x'><script>", "a;b"):
            self.assertIn("a font's name", self.refused(2, "box", self.store, "--font", font))
        self.assertIn("has no effect", self.refused(2, "box", self.store, "--font", "Carlito", "-o", self.folder / "a.csv"))
        if shutil.which("rsvg-convert") is None:
            self.skipTest("rsvg-convert (package librsvg2-bin) is not there")
        file = self.folder / "a.png"
        self.figure("box", "--width", "84mm", "-o", file)
        data = file.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertAlmostEqual(int.from_bytes(data[16:20], "big"), 84 / 25.4 * 300, delta=2)
        file.unlink()

    def test_what_cannot_be_meant_is_refused(self):
        for words, sentence in (
                (("bxo", self.store), 'did you mean "box"?'),
                (("modules", self.store, "--by", "source"), "has no effect on the figure `modules`"),
                (("convergence", self.store, "--source", "rvr"), "--source"),
                (("box", self.store, "--iteration", "2"), "--iteration"),
                (("box", self.store, "--by", "robot"), "source, method, mission"),
                (("box", self.store, "--source", "argos"), 'did you mean "argos3"?'),
                (("box", self.store, "--mission", "agregation"), 'did you mean "aggregation"?'),
                (("box", self.store, "--method", "x"), "it has: argos3"),
                (("box", self.store, "--design", "3"), "an id such as d3"),
                (("box", self.store, "-o", self.folder / "a.gif"), ".svg, .pdf, .png, .csv or .tex"),
                (("box", self.store, "-o", self.folder / "a.tex"), "has no TeX form"),
                (("box", self.store, "--json"), "name a file"),
                (("box", self.store, "--seed", "7"), "--seed"),
                (("trajectories", self.store, "--candidate", "c1", "--seed", "x"), "--seed"),
                (("trajectories", self.store, "--source", "rvr"), "--source"),
        ):
            with self.subTest(words=words):
                self.assertIn(sentence, self.refused(2, *words))
        self.assertIn("no such store", self.refused(3, "box", self.folder / "none.db"))


if __name__ == "__main__":
    unittest.main()
