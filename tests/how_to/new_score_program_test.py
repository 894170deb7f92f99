"""The programs and new_score_test, built from a copy of the sources that has the new kind of score of docs/missions.md:
its pair of files and its line, and nothing else. Long: it compiles them all."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from page_files import files_of

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
PAGE = SOURCE / "docs/missions.md"
LIST = "sim/mission/CMakeLists.txt"
FOLDERS = ["cmake", *re.findall(r"^ *add_subdirectory\((\w+)\)", (SOURCE / "CMakeLists.txt").read_text(), re.M)]

CAMPAIGN = """\
format = 1
[campaign]
name = "together"
[[mission]]
name = "together"
duration = "10 s"
{score}
[[method]]
name = "watermelon"
[race]
max_experiments = 1350
"""


class Programs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-how-to-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def call(self, *command):
        done = subprocess.run([str(word) for word in command], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])
        return done.stdout

    def follow_the_page(self):
        """The tree as the page leaves it."""
        shutil.copy(SOURCE / "CMakeLists.txt", self.folder)
        for name in FOLDERS:
            shutil.copytree(SOURCE / name, self.folder / name)
        for path, text in files_of(PAGE):
            if path == LIST:
                old = (self.folder / path).read_text()
                text = re.sub(r"set\(score_kinds\n.*?\n\)\n", text, old, flags=re.S)
                self.assertEqual(len(text.splitlines()), len(old.splitlines()) + 1)
            (self.folder / path).write_text(text)

    def test_know_the_kind(self):
        self.follow_the_page()
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.call("cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DSWARMSMITH_TESTS=ON",
                  "-DCMAKE_UNITY_BUILD=ON", *launcher)
        self.call("cmake", "--build", "build", "--target", "programs", "new_score_test")
        self.call("build/bin/new_score_test")
        score = re.search(r"```toml\n([^`]*kind = \"spread\"[^`]*)```", PAGE.read_text()).group(1)
        (self.folder / "campaign.toml").write_text(CAMPAIGN.format(score=score))
        swarmsmith = self.folder / "build/bin/swarmsmith"
        self.call(swarmsmith, "run", "campaign.toml", "--store", "s.db", "--workers", 1)
        self.assertIn("clean", self.call(swarmsmith, "verify", "s.db"))
        rows = self.call(swarmsmith, "query", "s.db", "--csv",
                         "SELECT min(score) AS least, max(score) AS most FROM evaluation")
        least, most = map(float, rows.splitlines()[1].split(","))
        self.assertLess(least, most)
        self.assertLessEqual(most, 0)


if __name__ == "__main__":
    unittest.main()
