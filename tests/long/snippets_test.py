"""What docs/storage.md tells R and pandas users to type works, word for word, on a real store; and the Python module's
frames.

    snippets_test.py [-v] r|python
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests" / "end_to_end"))
from programs import ProgramTest, ended_well  # noqa: E402


# A query's answer, and what a tuner found and tried.
FRAMES = """
import sys
import swarmsmith
query = "SELECT candidate, mean FROM v_convergence WHERE rank = 1"
with swarmsmith.Store(sys.argv[1]) as store:
    frame, rows = store.frame(query), store.query(query)
assert len(rows) > 0 and frame.to_dict("records") == rows, frame
best = swarmsmith.tune(lambda trial: trial.configuration["x"], {"x": (0.0, 1.0), "size": ["small", "large"]},
                       max_experiments=100, seed=3)
assert list(best.frame().columns[-2:]) == ["x", "size"], best.frame()
assert list(best.trials_frame()["x"]) == [row["configuration"]["x"] for row in best.trials]
print("same")
"""


def snippets(language):
    """The fenced blocks of the page in this language, in order."""
    text = (SOURCE / "docs" / "storage.md").read_text()
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


class Snippets(ProgramTest):
    """Each block runs on its own, in a folder with a campaign.db of two missions."""

    budget = 1400
    tests = 5

    def setUp(self):
        super().setUp()
        text = self.file.read_text()
        begin = text.index("[[mission]]")
        end = text.index("[[method]]")
        second = text[begin:end].replace("aggregation", "color_selection")
        self.file.write_text(text[:end] + second + text[end:])
        self.store = self.folder / "campaign.db"
        ended_well(self.run_campaign(self.store, "--workers", "2"))

    def run_blocks(self, language, words, name):
        blocks = snippets(language)
        self.assertGreaterEqual(len(blocks), 2, "the page has lost its blocks")
        before = self.store.read_bytes()
        printed = []
        for block in blocks:
            file = self.folder / name
            file.write_text(block)
            done = subprocess.run([*words, str(file)], cwd=self.folder, capture_output=True,
                                  text=True, timeout=120)
            self.assertEqual(done.returncode, 0, f"{block}\n{done.stdout}{done.stderr}")
            self.assertEqual(done.stderr, "", block)
            printed.append(done.stdout)
        self.assertEqual(self.store.read_bytes(), before)
        for text in printed[:2]:  # what follows is about real runs
            self.assertIn("aggregation", text)
            self.assertIn("color_selection", text)
        return printed


class R(Snippets):
    def setUp(self):
        has = shutil.which("Rscript") and subprocess.run(
            ["Rscript", "-e", "stopifnot(requireNamespace('RSQLite', quietly = TRUE))"],
            capture_output=True, timeout=60).returncode == 0
        if not has:
            self.skipTest("R with RSQLite (r-base-core, r-cran-rsqlite) is not there")
        super().setUp()

    def test_blocks_of_r(self):
        self.run_blocks("r", ["Rscript", "--vanilla"], "snippet.R")
        self.assertTrue((self.folder / "scores.pdf").read_bytes().startswith(b"%PDF"))


class Python(Snippets):
    # Debian's pandas is for Debian's Python, which need not be the one that runs this.
    INTERPRETERS = (sys.executable, "/usr/bin/python3")

    def setUp(self):
        for self.python in self.INTERPRETERS:
            if pathlib.Path(self.python).exists() and subprocess.run(
                    [self.python, "-c", "import pandas"], capture_output=True,
                    timeout=60).returncode == 0:
                break
        else:
            self.skipTest("pandas (python3-pandas) is not there")
        super().setUp()

    def test_blocks_of_python(self):
        printed = self.run_blocks("python", [self.python], "snippet.py")
        # pandas and SQL agree on the median.
        scores = [row["score"] for row in self.query(
            self.store, "SELECT score FROM v_design_scores WHERE mission = 'aggregation' "
                        "ORDER BY score")]
        row = next(line for line in printed[1].splitlines() if line.startswith("aggregation"))
        self.assertEqual(float(row.split()[-3]), scores[len(scores) // 2])

    def test_frames_of_the_module(self):
        done = subprocess.run([self.python, "-c", FRAMES, str(self.store)], cwd=self.folder, text=True,
                              capture_output=True, timeout=120,
                              env={**os.environ, "PYTHONPATH": str(SOURCE / "analysis" / "python")})
        self.assertEqual((done.stdout, done.stderr), ("same\n", ""))


if __name__ == "__main__":
    unittest.main()
