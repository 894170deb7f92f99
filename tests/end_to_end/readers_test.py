"""Readers that hold a store open during a campaign: they see the one moment at which they began,
whole, and the campaign goes on to its usual end."""
import contextlib
import shutil
import signal
import sqlite3
import subprocess
import unittest

from programs import ProgramTest, children_of, ended_well, send, wait_for

SHELL = shutil.which("sqlite3")

# What must agree within one moment of a campaign: each row is a name and how many rows break it.
# A score is stored when it arrives; steps, totals and what a design has used count it when its step
# is over (docs/storage.md), so that scores of a step that goes on are left out here.
BROKEN = """
WITH held AS MATERIALIZED (
  SELECT e.* FROM v_evaluations AS e
  JOIN v_race_steps AS s
    ON s.design = e.design AND s.iteration = e.iteration AND s.pair = e.pair
  WHERE e.purpose = 'race' AND e.used)
SELECT 'used is the number of evaluations of steps', count(*) FROM v_designs AS d
WHERE used <> (SELECT count(*) FROM held WHERE held.design = d.design)
UNION ALL
SELECT 'used is what the last step says', count(*) FROM v_designs AS d
WHERE used <> (SELECT coalesce(max(s.used), 0) FROM v_race_steps AS s WHERE s.design = d.design)
UNION ALL
SELECT 'the campaign has used what its designs have', count(*) FROM v_campaign_status
WHERE used <> (SELECT sum(used) FROM v_designs)
  OR evaluations <> (SELECT count(*) FROM v_evaluations)
  OR candidates <> (SELECT count(*) FROM v_candidates)
UNION ALL
SELECT 'steps say how many experiments there were', count(*) FROM (
  SELECT used, sum(evaluated) OVER (PARTITION BY design ORDER BY step) AS sum FROM v_race_steps)
WHERE used <> sum
UNION ALL
SELECT 'means of candidates are those of their evaluations', count(*) FROM (
  SELECT c.candidate, c.runs, c.mean, count(e.score) AS n, avg(e.score) AS average
  FROM v_candidates AS c LEFT JOIN held AS e ON e.candidate = c.candidate
  GROUP BY c.candidate)
WHERE runs <> n OR abs(coalesce(mean, 0) - coalesce(average, 0)) > 1e-6
UNION ALL
SELECT 'the race matrix has every evaluation', count(*) FROM held AS e
WHERE NOT EXISTS (SELECT 1 FROM v_race_matrix AS m WHERE m.design = e.design
                  AND m.iteration = e.iteration AND m.pair = e.pair
                  AND m.candidate = e.candidate AND m.score IS e.score)
  AND e.iteration = (SELECT max(iteration) FROM held)
  AND e.candidate % 10 = 0
UNION ALL
SELECT 'every machine is whole', count(*) FROM v_candidates
WHERE fsm_config NOT LIKE '--nstates %' OR json_valid(parameters) = 0 OR json_valid(modules) = 0
"""
# What a campaign that goes on changes.
MOMENT = """
SELECT (SELECT used FROM v_designs), (SELECT count(*) FROM v_evaluations WHERE used),
       (SELECT count(*) FROM v_candidates), (SELECT sum(score) FROM v_evaluations),
       (SELECT max(step) FROM v_race_steps), (SELECT candidates FROM v_campaign_status)
"""


class Shell:
    """The sqlite3 shell with a statement after the other; rows as its own list mode prints them."""

    def __init__(self, test, store, *arguments):
        self.process = subprocess.Popen([SHELL, *arguments, str(store)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        test.addCleanup(self.close)

    def ask(self, sql):
        self.process.stdin.write(sql.strip().rstrip(";") + ";\n.print end-of-rows\n")
        self.process.stdin.flush()
        rows = []
        for line in self.process.stdout:
            if line == "end-of-rows\n":
                return rows
            rows.append(tuple(line.rstrip("\n").split("|")))
        raise AssertionError(f"the shell ended: {rows}")

    def close(self):
        if self.process.poll() is None:
            self.process.stdin.close()
            self.process.wait(60)
            self.process.stdout.close()


@unittest.skipUnless(SHELL, "there is no sqlite3 shell")
class Readers(ProgramTest):
    budget = 2500

    def setUp(self):
        super().setUp()
        self.store = self.folder / "s.db"

    def python_reader(self):
        reader = sqlite3.connect(f"file:{self.store}?mode=ro", uri=True, isolation_level=None)
        self.addCleanup(reader.close)
        return reader

    def begun_campaign(self, steps):
        """A campaign that has held so many steps, and far from all. Its workers stand still until `go_on`, so that it
        does not end before the test has looked."""
        campaign = self.start_campaign(self.store, "--workers", "2")
        wait_for(lambda: self.store.exists() and self.steps() >= steps, "steps", 200)
        self.workers = children_of(campaign.pid)
        for worker in self.workers:
            send(worker, signal.SIGSTOP)
        self.assertIsNone(campaign.poll(), "the campaign ended before the test could look")
        return campaign

    def go_on(self):
        for worker in self.workers:
            send(worker, signal.SIGCONT)

    def steps(self):
        try:
            uri = f"file:{self.store}?mode=ro"
            with contextlib.closing(sqlite3.connect(uri, uri=True)) as reader:
                return reader.execute("SELECT count(*) FROM v_race_steps").fetchone()[0]
        except sqlite3.OperationalError:  # not born yet
            return 0

    def log_size(self):
        log = self.store.with_name(self.store.name + "-wal")
        return log.stat().st_size if log.exists() else 0

    def reference(self):
        store = self.folder / "reference.db"
        ended_well(self.run_campaign(store, "--workers", "2"))
        return self.digest(store)

    def assert_consistent(self, rows):
        self.assertEqual(len(rows), 7)
        for what, broken in rows:
            self.assertEqual(int(broken), 0, what)

    def test_a_moment_stays_as_it_was_and_the_campaign_goes_on(self):
        campaign = self.begun_campaign(steps=7)
        python, shell = self.python_reader(), Shell(self, self.store, "-readonly")
        python.execute("BEGIN")
        seen = python.execute(MOMENT).fetchall()
        shell.ask("BEGIN")
        shell_seen = shell.ask(MOMENT)
        asked = 0
        while campaign.poll() is None:
            if asked == 1:
                self.go_on()
            self.assert_consistent(python.execute(BROKEN).fetchall())
            self.assert_consistent(shell.ask(BROKEN))
            self.assertEqual(python.execute(MOMENT).fetchall(), seen)
            self.assertEqual(shell.ask(MOMENT), shell_seen)
            asked += 1
        self.assertEqual(campaign.returncode, 0)

        # The moment is still the same one, while others see the end.
        self.assertEqual(python.execute(MOMENT).fetchall(), seen)
        self.assertEqual(shell.ask(MOMENT), shell_seen)
        now = self.python_reader().execute(MOMENT).fetchall()
        self.assertGreater(now[0][1], seen[0][1])
        self.assertEqual(self.digest(self.store), self.reference())
        self.assert_clean(self.store)

        # Readers for reading alone leave the log where it is; the next writer folds it in.
        self.assertGreater(self.log_size(), 0)
        python.execute("COMMIT")
        python.close()
        shell.close()
        self.assertEqual(self.run_campaign(self.store).returncode, 0)
        self.assertEqual(self.log_size(), 0)
        self.assertEqual(self.python_reader().execute(MOMENT).fetchall(), now)

    def test_every_moment_is_whole(self):
        campaign = self.begun_campaign(steps=1)
        moments = []
        while True:
            ended = campaign.poll() is not None
            reader = self.python_reader()
            reader.execute("BEGIN")
            self.assert_consistent(reader.execute(BROKEN).fetchall())
            moments += reader.execute(MOMENT).fetchall()
            reader.close()
            if ended:
                break
            self.go_on()
        self.assertEqual(campaign.returncode, 0)
        self.assertGreater(len(set(moments)), 1, "the test looked at too few moments")
        self.assertEqual([m[1] for m in moments], sorted(m[1] for m in moments))

    def test_a_shell_that_is_the_last_to_close_folds_the_log_in(self):
        campaign = self.begun_campaign(steps=2)
        shell = Shell(self, self.store)  # which may write, as the shell does by default
        shell.ask("BEGIN")
        seen = shell.ask(MOMENT)
        self.go_on()
        self.assertEqual(campaign.wait(300), 0)
        self.assertEqual(shell.ask(MOMENT), seen)
        self.assertGreater(self.log_size(), 0)
        shell.close()
        self.assertEqual(self.log_size(), 0)
        self.assertEqual(self.digest(self.store), self.reference())


if __name__ == "__main__":
    unittest.main()
