"""A reader who follows docs/tracking.md gets where it leads: its commands run, in their order, in a rendered laboratory
whose files have the names of the page. And the page speaks of every command, option and message that there is."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
from command_blocks import blocks_to_run  # noqa: E402

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))  # see programs.py
PAGE = (SOURCE / "docs" / "tracking.md").read_text()
ENVIRONMENT = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"}
ENVIRONMENT.pop("SWARMSMITH_STORE", None)


def run(words, folder=None, check=True):
    done = subprocess.run(words, cwd=folder, text=True, capture_output=True, timeout=500 * PATIENCE, env=ENVIRONMENT)
    if check and done.returncode != 0:
        raise AssertionError(f"{words}\n{done.stdout}{done.stderr}")
    return done


class HowTo(unittest.TestCase):
    def test_its_blocks_work_in_their_order(self):
        if not shutil.which("rsvg-convert"):
            self.skipTest("rsvg-convert is not there; install librsvg2-bin")
        blocks = [block.text for block in blocks_to_run("docs/tracking.md")]
        self.assertGreaterEqual(len(blocks), 6)
        with tempfile.TemporaryDirectory(prefix="swarmsmith-tracking-") as name:
            folder = pathlib.Path(name)
            run([BIN / "film", "lab", folder, "--size", "960x540", "--form", "h264", "--fps", "15"])
            truth = json.loads(run([BIN / "film", "run", folder / "run01", "--lab", folder, "--machine", "tA3",
                                    "--mission", "aggregation", "--seconds", "30"]).stdout)
            for block in blocks:
                run(["bash", "-c", "set -eu\n" + block], folder)
            self.assertTrue((folder / "run01.html").read_text().startswith("<!DOCTYPE html>"))
            self.assertTrue((folder / "tags.pdf").read_bytes().startswith(b"%PDF"))
            report = json.loads(run([BIN / "swarmsmith", "track", "report", "r1", "--store", "lab.db", "--json"],
                                    folder).stdout)
            self.assertGreater(truth["score"], 0)
            self.assertEqual(report["score"], truth["score"], report["reasons"])
            self.assertEqual(report["measured_verdict"], "VALID", report["reasons"])
            for robot in report["robots"]:
                self.assertEqual(sum(robot["cycles"].values()), 300)
            keys = set(re.findall(r"`([a-z_]+)", PAGE))
            self.assertLessEqual(set(report), keys)
            for part in ("run", "frames"):
                self.assertLessEqual(set(report[part]), keys)
            self.assertLessEqual(set(report["robots"][0]), keys)


class Templates(unittest.TestCase):
    def test_floor_tags_lie_where_the_form_proposes_them(self):
        with tempfile.TemporaryDirectory(prefix="swarmsmith-init-") as name:
            run([BIN / "swarmsmith-track", "init", name])
            tags = tomllib.loads((pathlib.Path(name) / "arena.toml").read_text())["reference"]
            ids = f"{tags[0]['tag']}-{tags[-1]['tag']}"
            run([BIN / "swarmsmith-track", "print", "survey", "--ids", ids, "--edge", str(tags[0]["edge"]), "-o", "form.svg"], name)
            form = (pathlib.Path(name) / "form.svg").read_text()
            for tag in tags:
                self.assertIn(f"{tag['x']:.3f}, {tag['y']:.3f}".replace("-0.000", "0.000"), form.replace("-0.000", "0.000"))
            self.assertEqual(len(tags), 6)


class Completeness(unittest.TestCase):
    def test_every_check_is_told(self):
        names = []
        for path in (SOURCE / "tracking").rglob("*.cpp"):
            names += re.findall(r'constexpr Question k\w+\{"([^"]+)"', path.read_text())
            names += re.findall(r'Check check\{\.name = "([^"]+)"', path.read_text())
        self.assertIn("order of the pictures", names)
        self.assertGreaterEqual(len(names), 32)
        for name in names:
            self.assertIn(name, PAGE)

    def test_every_command_and_option_is_told(self):
        text = run([BIN / "swarmsmith-track", "--help"]).stdout
        names = re.findall(r"^  ([a-z]+(?: (?:camera|arena|robot|tags|board|survey))?)  +[A-Z]", text, re.M)
        self.assertGreaterEqual(len(names), 9, text)
        for name in names:
            self.assertIn(f"`{name}", PAGE)
            help_text = run([BIN / "swarmsmith-track", *name.split(), "--help"]).stdout
            options = set(re.findall(r"(?:^|[ ,])(--[a-z][a-z-]+)", help_text.split("Example")[0]))
            for option in options - {"--help", "--json", "--quiet", "--verbose", "--no-color"}:
                self.assertIn(option, PAGE, f"{option} of {name}")

    def test_every_message_is_told(self):
        codes = re.findall(r'"([EW]_[A-Z_]+)"', (SOURCE / "tracking" / "rig" / "issue.cpp").read_text())
        self.assertGreaterEqual(len(codes), 27)
        for code in codes:
            self.assertIn(f"| `{code}` |", PAGE)

    def test_its_pictures_are_there_and_small(self):
        pictures = re.findall(r"\((figures/tracking-[^)]+)\)", PAGE)
        self.assertGreaterEqual(len(pictures), 5)
        for picture in pictures:
            self.assertLess((SOURCE / "docs" / picture).stat().st_size, 150_000, picture)


class Printing(unittest.TestCase):
    def refused(self, code, said, *words):
        done = run([BIN / "swarmsmith-track", *words], self.folder, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(said, done.stderr)

    def test_pages_and_refusals(self):
        with tempfile.TemporaryDirectory(prefix="swarmsmith-printing-") as name:
            self.folder = pathlib.Path(name)
            tags = ("print", "tags", "--edge", "0.1")
            done = run([BIN / "swarmsmith-track", *tags, "--ids", "1-3", "-o", "tags.svg", "--json"], self.folder)
            self.assertEqual(json.loads(done.stdout), {"pages": 2, "files": ["tags-1.svg", "tags-2.svg"]})
            self.assertIn('height="297mm"', (self.folder / "tags-2.svg").read_text())
            self.refused(2, "largest that fits has 151 mm", "print", "tags", "--edge", "0.2", "--ids", "1", "-o", "t.pdf")
            self.refused(2, ".pdf or .svg", *tags, "--ids", "1", "-o", "tags.png")
            self.refused(2, '"x" is not an id', *tags, "--ids", "x", "-o", "tags.pdf")
            self.refused(2, "too large for A4", "print", "board", "chessboard:10x7:0.1", "-o", "b.pdf")
            self.refused(2, "not a positive number", "print", "survey", "--ids", "1", "--edge", "-1", "-o", "s.pdf")
            self.refused(1, "cannot", *tags, "--ids", "1", "-o", "no/such/folder/tags.svg")
            self.refused(2, "no store", "report", "r1")
            self.refused(3, "no such store", "report", "r1", "--store", "none.db")
            self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["tags-1.svg", "tags-2.svg"])


if __name__ == "__main__":
    unittest.main()
