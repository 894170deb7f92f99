"""Random walks over ordinary acts on one campaign: whatever happens, the end is the right answer, or a refusal in words.

SWARMSMITH_WALK_SECONDS: how long (default 180 in the long tests; the ordinary ones do a fixed number of walks).
SWARMSMITH_WALK_SEED: of the first walk; the others count on. Each walk prints its seed and its acts when it ends badly.
"""
import os
import random
import shutil
import subprocess
import time
import unittest

from ends import end_of, what_is_wrong_with
from ordinary_acts import HARMFUL, HARMLESS, Life, NotHere, mend
from rig import LONG, SWARMSMITH, WORKER, FaultTest

SEED = int(os.environ.get("SWARMSMITH_WALK_SEED", "1"))
SECONDS = float(os.environ.get("SWARMSMITH_WALK_SECONDS", "180" if LONG else "0"))
MOST_ACTS = 8


class RandomWalk(FaultTest):
    budget = 2500

    def setUp(self):
        super().setUp()
        self.place = self.folder
        self.disk = self.mounted()
        self.programs = self.readable_programs()
        self.left_out = set()
        self.ends = {}

    def mounted(self):
        """A disk of its own, which can be filled; none where that may not be done."""
        disk = self.folder / "disk"
        disk.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=48m", "tmpfs", str(disk)], capture_output=True, check=False)
        if done.returncode != 0:
            return None
        self.addCleanup(subprocess.run, ["umount", "-l", str(disk)], check=True)
        self.place = disk
        return disk

    def readable_programs(self):
        """Where another user finds them; none where there is no other user."""
        if os.geteuid() != 0 or shutil.which("setpriv") is None:
            return None
        programs = self.folder / "bin"
        programs.mkdir()
        for program in (SWARMSMITH, WORKER):
            shutil.copy(program, programs)
        self.folder.chmod(0o755)
        return programs

    def walk(self, seed):
        """One life of a store, to its end."""
        rng = random.Random(seed)
        life = Life(self, self.place / f"walk-{seed}", rng)
        acts = []
        harmful = rng.random() < 0.6
        for _ in range(rng.randrange(2, MOST_ACTS + 1)):
            harm = harmful and rng.random() < 0.3
            chosen = [rng.choice(HARMFUL if harm else HARMLESS)] + ([mend] if harm and rng.random() < 0.6 else [])
            life.harmed = life.harmed or harm
            for act in chosen:
                acts.append(act.__name__)
                self.do(act, life, f"walk {seed}: {', '.join(acts)}")
        life.at_rest()
        self.end(life, f"walk {seed}: {', '.join(acts)}")
        shutil.rmtree(life.folder)

    def do(self, act, life, story):
        try:
            act(life)
            self.count(act.__name__)
        except NotHere as reason:
            self.left_out.add(str(reason))
        except Exception as error:
            raise AssertionError(story) from error

    def end(self, life, story):
        self.assertEqual(life.wrong, [], story)
        end = end_of("run", self.file, "--store", life.store, "--no-dashboard", "--workers", "2")
        self.assertEqual(what_is_wrong_with(end), "", story)
        if end.code != 0:
            self.assertTrue(life.harmed, f"{story}: refused, though nothing was harmed: {end.err}")
            return self.mended(life, story, end)
        return self.right(life.store, story, "right")

    def right(self, store, story, word):
        self.assertEqual(self.digest(store), self.expected(), f"{story}: another answer, silently")
        self.assert_clean(store)
        self.ends[word] = self.ends.get(word, 0) + 1

    def mended(self, life, story, refusal):
        """A store that is refused goes on by what its refusal says, or it is refused again."""
        for words in (("recover", life.store, "-o", life.folder / "recovered.db"),
                      ("backup", life.store, life.folder / "backed-up.db")):
            end = end_of(*words)
            self.assertEqual(what_is_wrong_with(end), "", story)
            if end.code != 0:
                continue
            run = end_of("run", self.file, "--store", words[-1], "--no-dashboard", "--workers", "2")
            self.assertEqual(what_is_wrong_with(run), "", story)
            if run.code == 0:
                return self.right(words[-1], f"{story}, {words[0]}", f"right after {words[0]}")
        self.ends["refused"] = self.ends.get("refused", 0) + 1
        print(f"\n  {story}: refused: {refusal.err.strip()[:200]}", end="")
        return None

    def test_the_end_is_the_right_answer_or_a_refusal(self):
        until = time.monotonic() + SECONDS
        seed = SEED
        while True:
            with self.subTest(seed=seed):
                self.walk(seed)
            seed += 1
            if time.monotonic() > until and seed >= SEED + 2:
                break
        print(f"\n  walks {SEED} to {seed - 1}: {self.ends}", end="")
        for reason in sorted(self.left_out):
            print(f"\n  left out: {reason}", end="")


if __name__ == "__main__":
    unittest.main()
