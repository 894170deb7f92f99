"""The programs and tests, built from a copy of the sources that has what the how-tos add: the new kind of score of
docs/missions.md, the new search of docs/methods.md and the new condition of docs/flavours.md, and nothing else. Long: it compiles them all."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from page_files import files_of, follow

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
MISSIONS = SOURCE / "docs/missions.md"
METHODS = SOURCE / "docs/methods.md"
FLAVOURS = SOURCE / "docs/flavours.md"
LIST = "sim/mission/CMakeLists.txt"
FOLDERS = ["cmake", "examples", *re.findall(r"^ *add_subdirectory\((\w+)\)", (SOURCE / "CMakeLists.txt").read_text(), re.M)]

CAMPAIGN = """\
format = 1
[campaign]
name = "new"
[[mission]]
name = "{mission}"
duration = "10 s"
{score}
[[method]]
name = "m"
{method}
[race]
max_experiments = {budget}
"""


def shown(page, word):
    """The block of TOML that has the word."""
    return next(block for block in re.findall(r"```toml\n(.*?)^```$", page.read_text(), re.S | re.M) if word in block)


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-how-to-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.swarmsmith = cls.folder / "build/bin/swarmsmith"
        cls.follow_the_pages()
        launcher = [f"-DCMAKE_CXX_COMPILER_LAUNCHER={cls.folder}/cmake/with_ccache"] if shutil.which("ccache") else []
        cls.call("cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DSWARMSMITH_TESTS=ON", "-DCMAKE_UNITY_BUILD=ON",
                 *launcher)
        cls.call("cmake", "--build", "build", "--target", "programs", "new_score_test", "search_test")

    @classmethod
    def call(cls, *command):
        done = subprocess.run([str(word) for word in command], cwd=cls.folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stdout[-3000:] + done.stderr[-3000:])
        return done.stdout

    @classmethod
    def follow_the_pages(cls):
        shutil.copy(SOURCE / "CMakeLists.txt", cls.folder)
        for name in FOLDERS:
            shutil.copytree(SOURCE / name, cls.folder / name)
        (cls.folder / "docs").mkdir()
        shutil.copy(SOURCE / "docs/storage.md", cls.folder / "docs")  # the dashboard tells what views are by it
        for path, text in files_of(MISSIONS):
            if path == LIST:
                old = (cls.folder / path).read_text()
                text = re.sub(r"set\(score_kinds\n.*?\n\)\n", text, old, flags=re.S)
                assert len(text.splitlines()) == len(old.splitlines()) + 1
            (cls.folder / path).write_text(text)
        follow(METHODS, cls.folder)
        follow(FLAVOURS, cls.folder)

    def run_campaign(self, store, workers=1, **keys):
        text = CAMPAIGN.format(**{"mission": "aggregation", "score": "", "method": "", "budget": 1350, **keys})
        (self.folder / "campaign.toml").write_text(text)
        self.call(self.swarmsmith, "run", "campaign.toml", "--store", store, "--workers", workers)
        self.assertIn("clean", self.call(self.swarmsmith, "verify", store))

    def row(self, store, query):
        return self.call(self.swarmsmith, "query", store, "--csv", query).splitlines()[1].split(",")

    def test_know_the_score(self):
        self.call("build/bin/new_score_test")
        self.run_campaign("score.db", mission="together", score=shown(MISSIONS, 'kind = "spread"'))
        least, most = map(float, self.row("score.db", "SELECT min(score), max(score) FROM evaluation"))
        self.assertLess(least, most)
        self.assertLessEqual(most, 0)

    def test_know_the_condition(self):
        machine = "--nstates 2 --s0 0 --rwm0 5 --n0 1 --n0x0 0 --c0x0 6 --p0x0 1 --s1 1"
        said = self.call(self.swarmsmith, "evaluate", machine, "--flavour", "chocolate", "--mission", "aggregation",
                         "--seeds", "1", "--csv", "-")
        # Robots explore until something is in front of them, and stop for good.
        self.assertEqual({row.split(",")[9] for row in said.splitlines()[-3:]}, {"stop"})
        self.assertIn(",exploration,", said)

    def test_know_the_search(self):
        self.assertIn("EverySearch", self.call("build/bin/search_test"))  # halving is one of them
        said = self.call("build/bin/search_test", "--gtest_list_tests", "--gtest_filter=*halving*")
        self.assertIn("Budget/halving", said)
        method = shown(METHODS, 'search = "halving"')
        digests = set()
        for workers in (1, 3):
            store = f"search.{workers}.db"
            self.run_campaign(store, workers, method=method)
            digests.add(self.call(self.swarmsmith, "digest", store))
        self.assertEqual(len(digests), 1)
        # 1,350 runs: 128, 64, ... configurations on 3 pairs each; the last two have the rest.
        self.assertEqual(self.row("search.1.db", "SELECT used FROM v_designs"), ["1350"])
        self.assertIn("final stage: 2 of 2 members", self.call(self.swarmsmith, "status", "search.1.db"))
        self.assertIn("round 3 of 6: 32 members, 3 runs each",
                      self.call(self.swarmsmith, "explain", "d1", "search.1.db"))

    def test_refuse_what_does_not_fit_the_search(self):
        for keys, sentence in (('search = "halvin"', '"halving"'),
                               ('search = "halving"\n[method.halving]\nrun = 3', '"runs"'),
                               ('search = "halving"\n[method.halving]\nruns = 0', "must be from 1 to"),
                               ('search = "halving"\n[method.halving]\nruns = 700', "must be at least 1400")):
            (self.folder / "campaign.toml").write_text(
                CAMPAIGN.format(mission="aggregation", score="", method=keys, budget=1350))
            done = subprocess.run([self.swarmsmith, "check", "campaign.toml"], cwd=self.folder, capture_output=True,
                                  text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, done.stderr)


if __name__ == "__main__":
    unittest.main()
