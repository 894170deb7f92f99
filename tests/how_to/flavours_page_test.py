"""The places that docs/flavours.md changes for a new condition are in the sources, once, and its new file is not."""
import os
import pathlib
import unittest

from page_files import edits_of, files_of

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
PAGE = SOURCE / "docs/flavours.md"


class FlavoursPage(unittest.TestCase):
    def test_adds_a_file(self):
        paths = [path for path, _ in files_of(PAGE)]
        self.assertEqual(paths, ["sim/control/conditions/obstacle_ahead.h"])
        self.assertFalse((SOURCE / paths[0]).exists())

    def test_changes_places_that_there_are(self):
        edits = edits_of(PAGE)
        self.assertEqual([path for path, _, _ in edits],
                         ["sim/control/CMakeLists.txt", "sim/control/flavours/chocolate.toml"])
        for path, old, new in edits:
            self.assertEqual((SOURCE / path).read_text().count(old), 1)
            self.assertNotEqual(old, new)


if __name__ == "__main__":
    unittest.main()
