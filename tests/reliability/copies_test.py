"""Copies of a store that a campaign writes at that moment: each goes on to the right answer, or is refused in words.
And each command that reads a copy answers or refuses."""
import contextlib
import os
import shutil
import signal
import subprocess
import unittest

from copying import OTHERS, SOUND, Moving
from ends import end_of, what_is_wrong_with
from rig import LONG, stored


class Copies(Moving):
    budget = 3000

    def setUp(self):
        super().setUp()
        self.wrong = []
        self.right = 0
        self.refused = 0
        self.mended = 0

    def made(self, number, name, make):
        """A copy, of a campaign that has begun and is not over: that may happen where this process gets no processor."""
        for n in range(5):
            if not hasattr(self, "serving"):
                self.begin()
            elif not self.serving.alive() or stored(self.store) > 0.7 * self.budget:
                self.end()
                self.begin()
            to = self.folder / f"copy-{number}-{n}"
            to.mkdir()
            try:
                make(self, to)
            except (OSError, subprocess.CalledProcessError):
                if self.serving.alive():
                    raise
            if self.serving.alive():
                self.count(name)
                return to / "campaign.db"
        raise AssertionError(f"{name}: the campaign was over each time")

    def judge(self, name, store, sound, readers):
        for words in readers:
            end = end_of(*(store if word == "STORE" else word for word in words), cwd=store.parent)
            self.complain(name, what_is_wrong_with(end))
        end = self.goes_on(name, store)
        if end.code == 0:
            self.right += 1
            return
        self.refused += 1
        if sound:
            self.complain(name, f"a store of one moment was refused: {end.err}")
        if LONG:
            self.recover(name, store)

    def goes_on(self, name, store):
        """`run` of it, to the right answer or to a refusal."""
        end = end_of("run", self.file, "--store", store, "--workers", "2", "--no-dashboard")
        self.complain(name, what_is_wrong_with(end))
        if end.code == 0:
            digest, verified = end_of("digest", store), end_of("verify", store)
            if digest.out.strip() != self.expected():
                self.complain(name, f"another answer, silently: {digest.out}{digest.err}")
            elif verified.code != 0:
                self.complain(name, f"the right answer, but `verify` says {verified.out}{verified.err}")
        return end

    def recover(self, name, store):
        """What refusals advise: what can be read goes on to the right answer."""
        new = store.with_name("recovered.db")
        end = end_of("recover", store, "-o", new, "--campaign", self.file)
        self.complain(f"{name}, recovered", what_is_wrong_with(end))
        if end.code == 0:
            run = self.goes_on(f"{name}, recovered", new)
            if run.code != 0:
                self.complain(f"{name}, recovered", f"is refused: {run.err}")
            self.mended += 1

    def complain(self, name, what):
        if what:
            self.wrong.append(f"{name}: {what}")

    def try_all(self, ways, readers):
        copies = [(name, self.made(n, name, make), name in SOUND) for n, (name, make) in enumerate(ways)]
        self.end()
        for name, store, sound in copies:
            self.judge(name, store, sound, readers)
        print(f"\n  {len(copies)} copies: {self.right} went on to an answer, {self.refused} were refused, "
              f"{self.mended} of those were recovered", end="")
        self.assertEqual(self.wrong, [], "\n".join(self.wrong))


class Few(Copies):
    def test_the_usual_accidents(self):
        ways = {**OTHERS, **SOUND}
        names = ("db alone, folded in its middle", "half of the db, more, folded, more", "db, folded, log",
                 "all files at one moment")
        self.try_all([(name, ways[name]) for name in names], [("digest", "STORE"), ("status", "STORE")])


class HardLinks(Copies):
    """No copies, but people take them for some."""

    def linked(self):
        """The campaign's files by other names, and the exit code of the campaign, which goes on for a while."""
        self.begin()
        to = self.folder / "linked"
        to.mkdir()
        for name in ("", "-wal"):
            with contextlib.suppress(FileNotFoundError):
                os.link(self.beside(name), to / f"campaign.db{name}")
        self.later(self.budget // 10)
        self.serving.send(signal.SIGINT)
        self.working.send(signal.SIGCONT)
        self.assertIn(self.serving.wait(60), (0, 130, 3), self.serving.tail())
        self.working.kill()
        self.count("hard link")
        return to / "campaign.db"

    def test_the_store_goes_on_once_the_other_name_is_gone(self):
        link = self.linked()
        shutil.rmtree(link.parent)
        self.judge("the first name", self.store, False, [])
        self.assertEqual(self.wrong, [])

    def test_the_other_name_goes_on_once_the_first_is_gone(self):
        link = self.linked()
        shutil.rmtree(self.store.parent)
        self.judge("the other name", link, False, [("digest", "STORE"), ("status", "STORE")])
        self.assertEqual(self.wrong, [])


@unittest.skipUnless(LONG, "so many copies take minutes")
class Many(Copies):
    budget = 6000
    copies = 72

    def test_every_way_twice(self):
        ways = list({**SOUND, **OTHERS}.items())
        self.rng.shuffle(ways)
        readers = [("digest", "STORE"), ("verify", "STORE"), ("status", "STORE"), ("report", "STORE", "-o", "r.html"),
                   ("query", "STORE", "select * from v_evaluations"), ("ls", "candidates", "STORE")]
        self.try_all([ways[n % len(ways)] for n in range(self.copies)], readers)


if __name__ == "__main__":
    unittest.main()
