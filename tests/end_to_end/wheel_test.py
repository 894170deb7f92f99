"""The wheel of all programs: `pip install` of the file, where nothing else is, gives the module and the commands."""
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

import bundle_test
from bundle_test import SOURCE, in_root
from programs import BIN, SWARMSMITH

# Tunes a function that sleeps, by jobs; prints how long it took, and the best value of x.
PROGRAM = """
import sys, time
import swarmsmith
def cost(trial):
    time.sleep(0.3)
    return abs(trial.configuration["x"] - 0.3)
begin = time.monotonic()
best = swarmsmith.tune(cost, {"x": (0.0, 1.0)}, max_experiments=72, seed=1, first_test=2, mu=2, n_jobs=int(sys.argv[1]))
print(time.monotonic() - begin, best[0]["configuration"]["x"])
"""


def run(*words, **keywords):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **keywords)
    if done.returncode != 0:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-3000:]}")
    return done.stdout


@unittest.skipIf(bundle_test.why_not(), bundle_test.why_not() or "")
class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-wheel-")
        cls.addClassCleanup(folder.cleanup)
        cls.place = pathlib.Path(folder.name)
        bundle_test.pack(cls.place, kinds=("swarmsmith-worker", "swarmsmith-small"))
        [cls.archive] = cls.place.glob("swarmsmith-small-*.tar.xz")
        cls.wheel = pathlib.Path(run(SOURCE / "packaging/wheel", cls.archive, cls.place).strip())

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def install(self):
        """An empty virtual environment with the wheel: its folder of programs."""
        made = subprocess.run([sys.executable, "-m", "venv", self.folder / "env"], capture_output=True, text=True, check=False)
        if made.returncode != 0:
            self.skipTest("skipped: no virtual environment can be made here: " + made.stdout[-300:] + made.stderr[-300:])
        run(self.folder / "env/bin/pip", "install", "--no-index", "--no-cache-dir", self.wheel)
        return self.folder / "env/bin"

    def test_it_is_the_same_each_time_and_lists_what_it_holds(self):
        again = self.folder / "again"
        run(SOURCE / "packaging/wheel", self.archive, again)
        self.assertEqual((again / self.wheel.name).read_bytes(), self.wheel.read_bytes())
        self.assertIn(f"-py3-none-manylinux_2_5_{platform.machine()}.", self.wheel.name)
        with zipfile.ZipFile(self.wheel) as wheel:
            names = wheel.namelist()
            [record] = [name for name in names if name.endswith("/RECORD")]
            listed = [line.split(",")[0] for line in wheel.read(record).decode().splitlines()]
            modes = {name: wheel.getinfo(name).external_attr >> 16 for name in names}
        self.assertEqual(sorted(listed), sorted(names))
        self.assertLessEqual({file.name for file in (SOURCE / "analysis/python").glob("*.py")}, set(names))
        self.assertEqual(modes["swarmsmith_programs/bin/swarmsmith"] & 0o777, 0o755)
        self.assertIn("swarmsmith_programs/licences/swarmsmith", names)
        self.assertEqual(subprocess.run([SOURCE / "packaging/wheel", "other.tar.xz", again], capture_output=True).returncode, 1)

    def test_in_an_empty_environment_it_tunes_with_four_jobs_in_a_quarter_of_the_time(self):
        programs = self.install()
        alone = {"PATH": f"{programs}:/usr/bin:/bin", "HOME": str(self.folder)}
        self.assertEqual(run("swarmsmith", "--version", env=alone), run(SWARMSMITH, "--version"))
        self.assertEqual(run("swarmsmith-worker", "--version", env=alone), run(BIN / "swarmsmith-worker", "--version"))
        (self.folder / "tune.py").write_text(PROGRAM)
        times, found = zip(*(map(float, run(programs / "python3", self.folder / "tune.py", jobs, env=alone).split()) for jobs in (1, 4)))
        self.assertEqual(found[0], found[1])
        self.assertLess(times[1], 0.6 * times[0], times)
        # The demo gives this build's bits.
        for program, name in (("swarmsmith", "a.db"), (str(SWARMSMITH), "b.db")):
            run(program, "run", "--workers", "2", "--store", name, "--no-dashboard", cwd=self.folder, env=alone)
        self.assertEqual(run("swarmsmith", "digest", "a.db", cwd=self.folder, env=alone), run(SWARMSMITH, "digest", self.folder / "b.db"))

    def in_debian(self, suite):
        """A bare Debian with Python alone, where no compiler is."""
        if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
            self.skipTest("skipped: another Debian is made by root with mmdebstrap")
        root = self.folder / suite
        done = subprocess.run(["mmdebstrap", "--quiet", "--variant=essential", "--include=python3-venv", suite, root],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            self.skipTest(f"skipped: mmdebstrap could not make a root; is there a network? {done.stderr[-500:]}")
        home = root / "home/user"
        home.mkdir(parents=True)
        shutil.copy(self.wheel, home)
        (home / "tune.py").write_text(PROGRAM)
        there = "/home/user/"
        self.assertNotEqual(subprocess.run(in_root(root, "sh", "-c", "command -v gcc cc"), check=False).returncode, 0)
        run(*in_root(root, "python3", "-m", "venv", there + "env"))
        run(*in_root(root, there + "env/bin/pip", "install", "--no-index", "--no-cache-dir", there + self.wheel.name))
        self.assertEqual(run(*in_root(root, there + "env/bin/swarmsmith", "--version")), run(SWARMSMITH, "--version"))
        begin = time.monotonic()
        # Without SWARMSMITH_BIN, which names a folder of this system.
        best = run(*in_root(root, "env", "-i", there + "env/bin/python3", there + "tune.py", "4")).split()[1]
        self.assertLess(abs(float(best) - 0.3), 0.2)
        self.assertLess(time.monotonic() - begin, 300)

    def test_debian_12(self):
        self.in_debian("bookworm")

    def test_debian_13(self):
        self.in_debian("trixie")


if __name__ == "__main__":
    unittest.main()
