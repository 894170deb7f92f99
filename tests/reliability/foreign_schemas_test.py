"""Stores whose schema is not ours: writers refuse them and name what is foreign; `backup` and `recover` make
clean stores of them; who reads answers rightly, or refuses."""
import functools
import shutil
import signal
import unittest

from ends import end_of, what_is_wrong_with
from foreign_schemas import FOREIGN, HARMLESS, HEADERS, make_foreign
from rig import LONG, FaultTest, stored

REFUSED = 3

#: Answers that a view of ours, or none, makes.
READERS = (("digest", "STORE"), ("status", "STORE", "--json"), ("verify", "STORE", "--seed", "1"),
           ("ls", "designs", "STORE"), ("ls", "elites", "STORE"), ("query", "STORE", "select * from v_designs"),
           ("compare", "STORE"), ("report", "STORE", "-o", "r.html"), ("show", "d1", "STORE"),
           ("export", "STORE"), ("figure", "scores", "STORE", "-o", "f.svg"))


class Foreign(FaultTest):
    budget = 2000

    def setUp(self):
        super().setUp()
        self.wrong = []

    @functools.cached_property
    def half(self):
        """A store in the middle of its campaign, which was ended in good order."""
        for n in range(10):  # it may be over before it is interrupted, where this process gets no processor
            self.store = self.folder / f"half-{n}.db"
            serve = self.serve()
            worker = self.worker(serve.address())
            self.wait_stored(self.budget // 3)
            serve.send(signal.SIGINT)
            ended = serve.wait(60)
            worker.kill()
            if ended == 130 and stored(self.store) < self.budget:
                return self.store
        raise AssertionError(f"the campaign was over each time before it could be interrupted: {serve.tail()}")

    @functools.cached_property
    def answers(self):
        return {words: self.ask(self.half, words).out for words in READERS}

    def ask(self, store, words):
        """What is said of a store, whatever its name."""
        end = end_of(*(store if word == "STORE" else word for word in words), cwd=store.parent)
        return end._replace(out=end.out.replace(str(store), "STORE"))

    def changed(self, name, change, whole=False):
        """The store in the middle of its campaign, or that of the whole of it, with a foreign schema."""
        folder = self.folder / (name.replace(" ", "-").replace("'", "") + "-whole" * whole)
        folder.mkdir()
        store = folder / "campaign.db"
        shutil.copy(self.reference() if whole else self.half, store)
        make_foreign(store, change)
        return store

    def complain(self, name, what):
        if what:
            self.wrong.append(f"{name}: {what}")

    def must_refuse(self, name, thing, *words, **limits):
        end = end_of(*words, **limits)
        wrong = what_is_wrong_with(end)
        if not wrong and end.code != REFUSED:
            wrong = f"`{words[0]}` ended with {end.code}: {end.err[-300:]}"
        elif not wrong and thing not in end.err:
            wrong = f"`{words[0]}` does not name {thing}: {end.err[-300:]}"
        self.complain(name, wrong)

    def all_refuse(self, name, store):
        thing, change = {**FOREIGN, **HEADERS}[name]
        before = store.read_bytes()
        self.must_refuse(name, thing, "run", self.file, "--store", store, "--workers", "1", "--no-dashboard")
        self.must_refuse(name, thing, "serve", self.file, "--store", store, "--bind", "127.0.0.1:0", "--http", "none",
                         seconds=120)
        self.must_refuse(name, thing, "pause", store)
        if store.read_bytes() != before:
            self.complain(name, "a refused store was written")
        store = self.changed(name, change, whole=True)
        before = store.read_bytes()
        self.must_refuse(name, thing, "evaluate", "best", "--store", store, "--seeds", "1-2")
        self.must_refuse(name, thing, "extend", "d1", store, "--budget", "500")
        self.must_refuse(name, thing, "import", self.scores(), "--into", store)
        if store.read_bytes() != before:
            self.complain(name, "a refused store was written")
        shutil.rmtree(store.parent)

    def scores(self):
        """A score of the winner, from elsewhere."""
        file = self.folder / "scores.csv"
        file.write_text("design,score,source\nd1,0.5,real\n")
        return file

    def read(self, name, store):
        for words in READERS:
            end = self.ask(store, words)
            self.complain(name, what_is_wrong_with(end))
            if end.code == 0 and end.out != self.answers[words]:
                self.complain(name, f"`{words[0]} {words[1]}` answers otherwise, silently: {end.out[:300]}")

    def mend(self, name, store):
        """At least one of them makes a store that goes on to the right answer, and neither a wrong one."""
        mended = 0
        for words in (("backup", store, store.with_name("backup.db")),
                      ("recover", store, "-o", store.with_name("recovered.db"))):
            end = end_of(*words)
            self.complain(name, what_is_wrong_with(end))
            if end.code != 0:
                continue
            run = end_of("run", self.file, "--store", words[-1], "--workers", "2", "--no-dashboard")
            if run.code != 0:
                self.complain(name, f"what `{words[0]}` made is refused: {run.err[-300:]}")
            elif (digest := self.digest(words[-1])) != self.expected():
                self.complain(name, f"what `{words[0]}` made goes on to another answer, silently: {digest}")
            else:
                mended += 1
        if mended == 0:
            self.complain(name, "neither `backup` nor `recover` mends it")

    def merge(self, name, store):
        """A merged store has our schema and the right rows, or there is none."""
        made = store.with_name("merged.db")
        end = end_of("merge", store, "-o", made)
        self.complain(name, what_is_wrong_with(end))
        if end.code == 0:
            found = self.digest(made)
            if found != self.answers[READERS[0]].strip():
                self.complain(name, f"`merge` made a store of another digest, silently: {found}")

    def try_all(self, names, *ways):
        for name in names:
            store = self.changed(name, {**FOREIGN, **HEADERS}[name][1])
            self.count("foreign schema")
            for way in ways:
                way(name, store)
            shutil.rmtree(store.parent)
        print(f"\n  {len({each.split(':')[0] for each in self.wrong})} of {len(names)} wrong", end="")
        self.assertEqual(self.wrong, [], "\n" + "\n".join(self.wrong))


class Few(Foreign):
    def test_the_most_harmful_are_refused_by_name(self):
        names = ("trigger after insert", "an endless view", "a column more", "a table more", "a unique index")
        self.try_all(names, self.all_refuse)

    def test_nothing_is_refused_without_a_reason(self):
        """The same words on a store that is as it was made."""
        store = self.changed("nothing", lambda db: None, whole=True)
        for words in (("evaluate", "best", "--store", store, "--seeds", "1-2"), ("import", self.scores(), "--into", store),
                      ("extend", "d1", store, "--budget", "500"), ("pause", store)):
            end = end_of(*words)
            self.assertEqual(end.code, 0, end)

    def test_statistics_are_no_schema(self):
        """What `analyze` leaves is not ours, and says nothing about rows: the campaign goes on or it is refused by name."""
        thing, change = HARMLESS["statistics"]
        store = self.changed("statistics", change)
        end = end_of("run", self.file, "--store", store, "--workers", "2", "--no-dashboard")
        self.assertEqual(what_is_wrong_with(end), "")
        if end.code == 0:
            self.assertEqual(self.digest(store), self.expected())
        else:
            self.assertIn(thing, end.err)


@unittest.skipUnless(LONG, "all of them take minutes")
class All(Foreign):
    def test_every_writer_refuses_them_by_name(self):
        self.try_all([*FOREIGN, *HEADERS], self.all_refuse)

    def test_backup_and_recover_make_clean_stores(self):
        self.try_all(FOREIGN, self.mend, self.merge)

    def test_readers_answer_rightly_or_refuse(self):
        self.try_all([*FOREIGN, *HEADERS], self.read)


if __name__ == "__main__":
    unittest.main()
