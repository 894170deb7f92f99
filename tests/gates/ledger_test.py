"""The ledger of the gates: which lines count, and which go."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])

#: Names of unit tests have blanks, and what XML escapes.
LINES = ["asan\tdocs.manual\t11\ttest\t4\tc0ffee00\t2026-11-27",
         "long\tAll/Presets.Race/maple  # GetParam() = <maple>\t22\ttest\t9\tc0ffee00\t2026-11-27",
         "long\tend_to_end.irace\t33\ttest\t70\tc0ffee00\t2026-11-27"]


class Ledger(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "tests/gates/green.tsv"
        self.file.parent.mkdir(parents=True)
        (self.folder / "build-gate").mkdir()
        self.file.write_text("\n".join(LINES) + "\n")

    def bash(self, words, given=""):
        return subprocess.run(["bash", "-c", f". {SOURCE}/tests/gates/ledger.sh; {words}"], cwd=self.folder,
                              input=given, capture_output=True, text=True)

    def lines(self):
        return self.file.read_text().splitlines()

    def test_a_line_counts_for_its_gate_its_digest_and_its_time(self):
        for words, status in (("long end_to_end.irace 33", 0), ("long end_to_end.irace 33 70", 0),
                              ("long end_to_end.irace 33 71", 1), ("long end_to_end.irace 34", 1),
                              ("asan end_to_end.irace 33", 1),
                              ("long 'All/Presets.Race/maple  # GetParam() = <maple>' 22", 0)):
            self.assertEqual(self.bash(f"is_green {words}").returncode, status, words)

    def test_a_unit_that_is_gone_or_has_changed_loses_its_line(self):
        named = LINES[1].split("\t")[1] + "\t22\nend_to_end.irace\t34\n"
        self.assertEqual(self.bash("keep_units long", named).returncode, 0)
        self.assertEqual(self.lines(), LINES[:2])

    def test_a_unit_without_a_digest_keeps_its_line(self):
        self.assertEqual(self.bash("keep_units long", "end_to_end.irace\n").returncode, 0)
        self.assertEqual(self.lines(), [LINES[0], LINES[2]])

    def test_no_units_at_all_change_nothing(self):
        done = self.bash("keep_units long")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("stays as it is", done.stderr)
        self.assertEqual(self.lines(), LINES)

    def test_a_later_line_takes_the_place_of_the_one_before(self):
        for words in ("init -q", "add -A", "-c user.name=a -c user.email=a@b commit -qm one"):
            subprocess.run(f"git {words}", shell=True, check=True, cwd=self.folder)
        done = self.bash("note_green long end_to_end.irace 44 test 71.6")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line.split("\t")[:5] for line in self.lines()],
                         [line.split("\t")[:5] for line in LINES[:2]] + [["long", "end_to_end.irace", "44", "test", "72"]])


if __name__ == "__main__":
    unittest.main()
