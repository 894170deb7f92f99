"""The thesis at a hundredth: killed, interrupted, gone on with, and what its page promises."""
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import tempfile
import unittest

from programs import BIN

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
MAKE = SOURCE / "examples" / "thesis" / "make"


def begun(folder):
    return subprocess.Popen([MAKE, "--quick", "--designs", "2", "--folder", folder], text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)


def until(process, words):
    """Reads what it says up to a line with these words."""
    said = []
    for line in process.stderr:
        said.append(line)
        if words in line:
            return
    raise AssertionError(f"no word of {words!r}:\n" + "".join(said))


class Thesis(unittest.TestCase):
    def test_goes_on_and_keeps_the_promises_of_its_page(self):
        with tempfile.TemporaryDirectory(prefix="swarmsmith-thesis-") as name:
            folder = pathlib.Path(name)
            self.stop_twice(folder)
            process = begun(folder)
            told, said = process.communicate()
            self.assertEqual(process.returncode, 0, said)
            self.assertEqual(told.strip(), str(folder / "thesis.md"))
            self.assertNotIn("racing", said)
            self.follow(folder, (folder / "thesis.md").read_text())

    def stop_twice(self, folder):
        process = begun(folder)
        until(process, "d2 finished")
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.communicate()
        process = begun(folder)
        until(process, "the laboratory")
        designs = self.rows(folder, "SELECT count(*) AS n FROM v_designs")[0]["n"]
        self.assertEqual(designs, 36)
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("the same command goes on here", said)
        self.assertFalse((folder / "thesis.md").exists())

    def rows(self, folder, sql):
        return json.loads(subprocess.run([BIN / "swarmsmith", "query", sql, "thesis.db", "--json"], cwd=folder, check=True,
                                         capture_output=True, text=True).stdout)["rows"]

    def follow(self, folder, page):
        """Each table and figure of the thesis is there, and the store answers what stands before it."""
        for number in ("Figure 7.1", "Figure 7.2", "Figure 7.3", "Figure 7.4", "Figure 7.5", "Figure 7.6", "Table 7.1",
                       "Table 7.2", "Table 7.3"):
            self.assertRegex(page, rf"(?m)^### {number}: ")
        self.assertIn("Figures A.21 to A.30".lower(), page.lower())
        pictures = re.findall(r"!\[.+\]\((.+)\)", page)
        self.assertEqual(sorted(folder / picture for picture in pictures), sorted((folder / "figures/thesis").iterdir()))
        self.assertIn("Some sittings were killed, and their time is not counted: the campaign.", page)
        claims = re.findall(r"(?m)^\| .* \| (\**(?:agrees|differs|not seen).*?) \|$", page)
        agreed = page.split("\n## Modules")[0].count("| agrees |")
        self.assertIn(f"Of {len(page.split('| verdict |')[1].split(chr(10) * 2)[0].splitlines()) - 2} claims {agreed} agree.",
                      page)
        self.assertGreater(len(claims), agreed)
        films = self.rows(folder, "SELECT name, scorings FROM v_real_runs ORDER BY run")
        self.assertEqual([film["scorings"] for film in films], [1, 2, 1])
        asked = [line for line in page.splitlines() if re.match("swarmsmith (query|compare) ", line)]
        self.assertGreater(len(asked), 12)
        for line in asked:
            answer = subprocess.run([BIN / "swarmsmith", *shlex.split(line)[1:]], cwd=folder, check=True, capture_output=True,
                                    text=True).stdout
            self.assertGreater(len(answer.splitlines()), 1, line)


if __name__ == "__main__":
    unittest.main()
