"""What docs/missions.md shows of files that exist is what stands in them, but for one line."""
import os
import pathlib
import unittest

from page_files import files_of

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
LIST = "sim/mission/CMakeLists.txt"


class MissionsPage(unittest.TestCase):
    def setUp(self):
        self.files = dict(files_of(SOURCE / "docs/missions.md"))

    def test_shows_the_files_of_objects_on_as_they_are(self):
        for ending in ("h", "cpp"):
            path = "sim/mission/scores/objects_on." + ending
            self.assertEqual(self.files[path], (SOURCE / path).read_text())

    def test_adds_one_pair_of_files_and_one_line(self):
        new = {path for path in self.files if not (SOURCE / path).exists()}
        self.assertEqual(new, {"sim/mission/scores/spread.h", "sim/mission/scores/spread.cpp"})
        wanted = self.files[LIST].splitlines()
        self.assertEqual(wanted.count("  spread"), 1)
        before = "\n".join(line for line in wanted if line != "  spread")
        self.assertIn(before, (SOURCE / LIST).read_text())
        self.assertEqual(set(self.files) - new, {LIST, "sim/mission/scores/objects_on.h",
                                                 "sim/mission/scores/objects_on.cpp"})


if __name__ == "__main__":
    unittest.main()
