"""The places that docs/methods.md changes for a new search are in the sources, each once, and its new files are not."""
import os
import pathlib
import unittest

from page_files import edits_of, files_of

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
PAGE = SOURCE / "docs/methods.md"


class MethodsPage(unittest.TestCase):
    def test_adds_a_pair_of_files(self):
        self.assertEqual([path for path, _ in files_of(PAGE)],
                         ["irace_core/search/halving.h", "irace_core/search/halving.cpp"])
        for path, _ in files_of(PAGE):
            self.assertFalse((SOURCE / path).exists())

    def test_changes_places_that_there_are(self):
        edits = edits_of(PAGE)
        self.assertEqual({path for path, _, _ in edits}, {"irace_core/search/CMakeLists.txt"})
        for path, old, new in edits:
            with self.subTest(path, old=old):
                self.assertEqual((SOURCE / path).read_text().count(old), 1)
                self.assertNotEqual(old, new)


if __name__ == "__main__":
    unittest.main()
