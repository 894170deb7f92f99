"""Stores made so that reading them is much work: no command takes more than 256 MB or ten seconds of processor time, has no
end, or crashes."""
import os
import shutil
import unittest

from crafted_stores import CRAFTED, craft
from ends import end_of, what_is_wrong_with
from every_command import invocations
from rig import LONG, SANITIZED, FaultTest, call, ended_well

#: MiB of one process, and seconds of processor time.
MOST_MEMORY = 256
MOST_TIME = 10
#: Commands that look into no store.
ELSEWHERE = ("init", "check", "profile", "worker", "keygen", "assess", "irace", "robot", "version")


class Crafted(FaultTest):
    budget = 1350
    tests = 3

    def setUp(self):
        super().setUp()
        self.kept = self.folder / "kept.db"
        ended_well(call("run", self.file, "--store", self.kept, "--no-dashboard", "--workers", "2"))

    def try_all(self, names, wanted=None):
        wrong, tried, most = [], 0, (0, 0)
        for name in names:
            folder = self.folder / "crafted"
            folder.mkdir()
            made = folder / "made.db"
            shutil.copy(self.kept, made)
            craft(made, CRAFTED[name])
            self.count("crafted store")
            for words in self.words(made, folder, wanted):
                # Each has its own: what one writes does not reach the next.
                store = folder / "campaign.db"
                for suffix in ("", "-wal", "-shm", ".lock"):
                    store.with_name(store.name + suffix).unlink(missing_ok=True)
                shutil.copy(made, store)
                # Without rsvg-convert: PDFs are another program's time, some 0.1 s for each.
                end = end_of(*words, processor=2 * MOST_TIME, cwd=folder, env={"PATH": str(folder)})
                tried += 1
                most = max(most, (end.memory, end.processor))
                wrong += [f"{name}: {each}" for each in self.complaints(end)]
            shutil.rmtree(folder)
        print(f"\n  {tried} commands, {len(wrong)} wrong; at most {most[0]:.0f} MB", end="")
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    @staticmethod
    def words(made, folder, wanted):
        for each in invocations(folder / "campaign.db", folder.parent / "campaign.toml", folder, forms=((),)):
            words = [os.fsdecode(word) for word in each]
            if words[0] not in ELSEWHERE and (wanted is None or words[0] in wanted):
                yield words

    def complaints(self, end):
        name = " ".join(str(word)[-40:] for word in end.words)
        if wrong := what_is_wrong_with(end):
            yield wrong
        if end.memory > MOST_MEMORY and not SANITIZED:
            yield f"`{name}` took {end.memory:.0f} MB"
        if end.processor > MOST_TIME and not SANITIZED:
            yield f"`{name}` took {end.processor:.0f} s"


class Few(Crafted):
    def test_readers_of_the_worst(self):
        names = ("a code that expands to 2 GB", "a mission of 100,000 letters", "endless designs", "largest numbers")
        self.try_all(names, ("digest", "verify", "report", "backup"))


@unittest.skipUnless(LONG, "every command on all of them takes many minutes")
class All(Crafted):
    def test_every_command_on_every_store(self):
        self.try_all(CRAFTED)


if __name__ == "__main__":
    unittest.main()
