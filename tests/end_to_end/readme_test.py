"""Every command of the README and then of docs/getting-started.md, in a folder that looks like a built checkout."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
from command_blocks import blocks_to_run  # noqa: E402

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BUILD = pathlib.Path(os.environ["SWARMSMITH_BIN"]).parent
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))


def commands():
    """The lines of the blocks of shell, those of the README first."""
    return "\n".join(block.text for page in ("README.md", "docs/getting-started.md") for block in blocks_to_run(page))


class Readme(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-readme-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in os.listdir(SOURCE):
            if not name.startswith(".") and not name.startswith("build") and ".db" not in name:
                (self.folder / name).symlink_to(SOURCE / name)
        (self.folder / "build").symlink_to(BUILD)

    def test_its_commands_work_as_written(self):
        script = "set -eux\n" + commands()
        # As this build is: `./dev` would configure it for another kind.
        kind = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.M)[1]
        self.assertIn("./dev run", script)
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True,
                              text=True, timeout=500 * PATIENCE,
                              env={**os.environ, "SWARMSMITH_BUILD_TYPE": kind})
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])
        self.assertIn("fresh seeds", done.stdout)
        self.assertRegex(done.stdout, r"--nstates [1-4] ")
        self.assertRegex(done.stdout, r"(?m)^[0-9a-f]{32}$")
        self.assertIn("clean", done.stdout)


if __name__ == "__main__":
    unittest.main()
