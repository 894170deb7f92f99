"""Whoever follows docs/missions.md gets where it leads: its files are written, its commands run."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = os.environ["SWARMSMITH_BIN"]


class MissionsPage(unittest.TestCase):
    def test_its_blocks_work_in_their_order(self):
        text = (SOURCE / "docs" / "missions.md").read_text()
        blocks = re.findall(r"^```(toml file=(\S+)|sh)\n(.*?)^```", text, re.S | re.M)
        self.assertGreaterEqual(sum(kind == "sh" for kind, _, _ in blocks), 2)
        with tempfile.TemporaryDirectory(prefix="swarmsmith-missions-") as folder:
            for kind, file, block in blocks:
                if file:
                    (pathlib.Path(folder) / file).write_text(block)
                    continue
                done = subprocess.run(["bash", "-c", "set -eu\n" + block], cwd=folder, text=True,
                                      capture_output=True, timeout=300,
                                      env={**os.environ, "PATH": BIN + ":" + os.environ["PATH"]})
                self.assertEqual(done.returncode, 0, block + done.stdout + done.stderr)
                # The first block asks for seeds 1-20; the machine of the last one has its own.
                counts = re.findall(r"\bn (\d+)\n", done.stdout)
                self.assertEqual(counts[-1:], ["20" if "--seeds 1-20" in block else "100"])


if __name__ == "__main__":
    unittest.main()
