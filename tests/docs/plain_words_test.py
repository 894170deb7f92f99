"""The check of odd words in added lines (tests/gates/plain_words.py) finds them where people read them, and nowhere else."""
import os
import pathlib
import sys
import unittest

SOURCE = pathlib.Path(os.environ.get("SWARMSMITH_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
sys.path.insert(0, str(SOURCE / "tests" / "gates"))
import plain_words  # noqa: E402

DIFF = """\
+++ b/base/rng.cpp
@@ -3,0 +7,4 @@
+// Nobody asks.
+int nobody = 1;
+fail("it is told");
+int whoevers;  // nobodyless
+++ b/tests/base/rng_test.cpp
@@ -1 +1 @@
+// nobody
+++ b/docs/README.md
@@ -1 +2 @@
-nobody
+Pages of which one is odd.
"""


class PlainWords(unittest.TestCase):
    def test_are_flagged_in_comments_texts_and_pages(self):
        words = plain_words.words_of((SOURCE / "CONTRIBUTING.md").read_text())
        self.assertEqual(len(words), 10)
        self.assertEqual(list(plain_words.flagged(DIFF, words)),
                         [("base/rng.cpp", 7, "nobody"), ("base/rng.cpp", 9, "is told"), ("docs/README.md", 2, "of which")])


if __name__ == "__main__":
    unittest.main()
