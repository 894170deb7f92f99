"""A store of the thesis' size, three million evaluations, and everything that is done with stores: each documented view, each
command that reads one, `verify` as it is typed. A plain sum over all scores of that store says what each may take,
measured beside it: by processor time, so that other work on the machine does not matter, and by the most memory.

A small campaign is run; then copies of its designs, with other numbers, become further campaigns of the same store. All of
its races can be replayed, and all of its scores be evaluated again.
"""
import json
import os
import pathlib
import resource
import shutil
import sqlite3
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests" / "end_to_end"))
from programs import SWARMSMITH, ProgramTest, call, campaign_text  # noqa: E402

EVALUATIONS = int(os.environ.get("SWARMSMITH_THESIS_SIZE", 3_000_000))
BUDGET = 6_000  # experiments of a design, of three
MB = 1 << 20
#: Of processor time, in sums over all scores.
OF_A_VIEW = 100
#: The 256 MB that a statement may take, and the program itself.
MEMORY_OF_A_VIEW = 330 * MB

#: Command, sums over all scores, MB. What replays or copies all of it may take more of both.
COMMANDS = [
    (["status", "STORE"], 20, 200),
    (["ls", "designs", "STORE"], 20, 200),
    (["ls", "candidates", "STORE", "--where", "design = 2"], 20, 400),
    (["show", "d2", "STORE"], 20, 200),
    (["explain", "d2", "STORE"], 20, 400),
    (["compare", "STORE", "--by", "mission"], 60, 400),
    (["figure", "box", "STORE", "-o", "OUT.svg"], 60, 400),
    (["figure", "convergence", "STORE", "--design", "d2", "-o", "OUT.svg"], 60, 400),
    (["figure", "importance", "STORE", "--design", "d2", "-o", "OUT.svg"], 60, 400),
    (["figure", "race", "STORE", "--design", "d2", "-o", "OUT.svg"], 60, 400),
    (["figure", "parallel", "STORE", "--design", "d2", "-o", "OUT.svg"], 60, 400),
    (["figure", "sampling", "STORE", "--design", "d2", "-o", "OUT.svg"], 60, 400),
    (["figure", "training", "STORE", "-o", "OUT.svg"], 200, 400),
    (["figure", "scores", "STORE", "-o", "OUT.svg"], 60, 400),
    (["replay", "STORE", "--sample", "20"], 100, 400),
    (["digest", "STORE"], 200, 400),
    (["verify", "STORE", "--sample", "0"], 600, 600),
    (["verify", "STORE"], 800, 600),
    (["backup", "STORE", "OUT.db"], 250, 400),
    (["merge", "OTHERS", "-o", "OUT.db"], 400, 400),
    (["recover", "STORE", "-o", "OUT.db"], 800, 1200),
    (["report", "STORE", "-o", "OUT.html"], 900, 600),
]


def columns_of(db, table):
    return [row[1] for row in db.execute(f"PRAGMA table_info({table})")]


def multiply(store, copies):
    """Makes the first campaign's designs again and again, as campaigns of their own."""
    db = sqlite3.connect(store, isolation_level=None)
    db.execute("PRAGMA synchronous = OFF")
    db.execute("BEGIN")
    designs, = db.execute("SELECT count(*) FROM design").fetchone()
    of_design = {"iteration", "pair", "race_step", "elite"}
    for table in ("campaign", "design", "iteration", "candidate", "candidate_totals", "pair", "evaluation", "race_step",
                  "elimination", "elite"):
        names = columns_of(db, table)

        def moved(name):
            if table == "campaign":
                return {"id": "id + k.n", "designs_before": f"k.n * {designs}"}.get(name, name)
            if name == "design" or (table == "design" and name == "id"):
                return f"{name} + k.n * {designs}"
            if name in ("candidate", "best", "parent") or (table == "candidate" and name == "id"):
                return f"{name} + k.n * {designs} * 1000000"
            return "k.n + 1" if name == "campaign" else name

        key = "id" if table in ("campaign", "design", "candidate") else "design" if table in of_design else "candidate"
        most = 1 if table == "campaign" else designs if table in of_design | {"design"} else designs * 1_000_000
        db.execute(f"INSERT INTO {table} ({', '.join(names)}) WITH RECURSIVE k(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM k "
                   f"WHERE n < {copies - 1}) SELECT {', '.join(map(moved, names))} FROM k CROSS JOIN {table} "
                   f"WHERE {table}.{key} <= {most}")
    # As a store of an earlier version, which does not say what its campaign had written.
    db.execute("DELETE FROM meta WHERE key NOT IN ('host', 'sqlite')")
    db.execute("COMMIT")
    db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    db.close()


def measured(words, cwd):
    """Exit code, output, errors, processor seconds and bytes of memory of a program."""
    out, err = cwd / "out.txt", cwd / "err.txt"
    with open(out, "wb") as output, open(err, "wb") as errors:
        pid = os.posix_spawn(SWARMSMITH, [SWARMSMITH, *words], os.environ, file_actions=[
            (os.POSIX_SPAWN_DUP2, output.fileno(), 1), (os.POSIX_SPAWN_DUP2, errors.fileno(), 2)])
        _, status, used = os.wait4(pid, 0)
    return os.waitstatus_to_exitcode(status), head(out), head(err), used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def head(file):
    """Not all of it: a child begins with the memory of who starts it, and that is what is measured."""
    with open(file, errors="replace") as text:
        return text.read(100_000)


class ThesisSize(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.place = tempfile.TemporaryDirectory(dir=os.environ.get("SWARMSMITH_DISK"))
        cls.addClassCleanup(cls.place.cleanup)
        folder = pathlib.Path(cls.place.name)
        cls.store = folder / "thesis.db"
        (folder / "thesis.toml").write_text(campaign_text(
            BUDGET, seed=2022, tests=None, name="thesis", missions=("aggregation", "grid_exploration", "color_selection"),
            methods=['name = "watermelon"\nflavour = "watermelon"'], store=None))
        done = call("run", folder / "thesis.toml", "--store", cls.store, "--no-dashboard", timeout=1800)
        assert done.returncode == 0, done.stderr
        db = sqlite3.connect(cls.store)
        count, = db.execute("SELECT count(*) FROM evaluation").fetchone()
        db.close()
        multiply(cls.store, -(-EVALUATIONS // count))
        cls.evaluations = count * -(-EVALUATIONS // count)
        cls.sum_s = min(cls.seconds_of_a_sum() for _ in range(3))
        print(f"{cls.evaluations} evaluations, {cls.store.stat().st_size / MB:.0f} MB; a sum over all scores: {cls.sum_s:.2f} s")

    def others(self):
        """The store with campaigns that can be told apart, which `merge` wants."""
        others = self.store.with_name("others.db")
        if not others.exists():
            shutil.copy(self.store, others)
            db = sqlite3.connect(others)
            db.execute("UPDATE campaign SET digest = digest || id")
            db.commit()
            db.close()
        return others

    @classmethod
    def seconds_of_a_sum(cls):
        before = resource.getrusage(resource.RUSAGE_SELF)
        db = sqlite3.connect(f"file:{cls.store}?mode=ro", uri=True)
        assert db.execute("SELECT count(*), sum(score) FROM evaluation").fetchone()[0] == cls.evaluations
        db.close()
        after = resource.getrusage(resource.RUSAGE_SELF)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def check(self, words, sums, most):
        code, out, err, seconds, memory = measured(words, self.folder)
        print(f"{' '.join(words)[:90]:90} {seconds:7.2f} s {seconds / self.sum_s:6.1f} sums {memory / MB:5.0f} MB")
        self.assertEqual(code, 0, (words, err[-2000:]))
        self.assertNotIn("SELECT", out + err if words[0] != "query" else err, words)
        if "SWARMSMITH_SANITIZED" in os.environ:
            return out
        self.assertLess(memory, most, words)
        if EVALUATIONS >= 1_000_000:  # of less, starting the program is most of it
            self.assertLess(seconds, sums * self.sum_s, words)
        return out

    def test_every_documented_view_is_counted_and_read(self):
        text = (SOURCE / "docs" / "storage.md").read_text()
        told = json.loads(call("query", self.store, "SELECT name FROM sqlite_schema WHERE type = 'view' AND name GLOB 'v_*'",
                               "--json").stdout)
        views = [row["name"] for row in told["rows"]]
        self.assertGreater(len(views), 25)
        for view in views:
            with self.subTest(view=view):
                self.assertIn(f"{view}", text)
                rows = int(self.check(["query", str(self.store), f"SELECT count(*) FROM {view}", "--csv"], OF_A_VIEW,
                                      MEMORY_OF_A_VIEW).split()[1])
                if view == "v_evaluations":
                    self.assertEqual(rows, self.evaluations)
                # To its end, or to the million that a query gives.
                self.check(["query", str(self.store), f"SELECT * FROM {view}", "--csv"], 3 * OF_A_VIEW, MEMORY_OF_A_VIEW)

    def test_a_part_of_a_view_costs_what_the_part_is(self):
        for view in ("v_race_matrix", "v_states", "v_transitions", "v_modules", "v_parameters", "v_candidates",
                     "v_evaluations"):
            with self.subTest(view=view):
                self.check(["query", str(self.store), f"SELECT count(*) FROM (SELECT * FROM {view} WHERE design = 5)"],
                           OF_A_VIEW / 20, MEMORY_OF_A_VIEW)

    def test_every_command_that_reads_a_store(self):
        for number, (words, sums, megabytes) in enumerate(COMMANDS):
            with self.subTest(command=words):
                store = self.others() if "OTHERS" in words else self.store
                words = [word.replace("OTHERS", "STORE").replace("STORE", str(store))
                         .replace("OUT", str(self.folder / f"out{number}")) for word in words]
                out = self.check(words, sums, megabytes * MB)
                if words[0] == "verify":
                    self.assertRegex(out, rf"^clean: {self.evaluations} evaluations of ")
                for made in self.folder.glob(f"out{number}*"):
                    shutil.rmtree(made) if made.is_dir() else made.unlink()


if __name__ == "__main__":
    unittest.main()
