"""Swarmsmith's stores, read alone, and the scores of its program."""
import json
import os
import pathlib
import re
import sqlite3
import subprocess

from swarmsmith_space import Error, OptionError

PURPOSES = ("test", "score")  # of v_design_scores


def program_path(program):
    """The one that is named, else that of SWARMSMITH_BIN, of the wheel that the module came with, or of PATH."""
    if program is None:
        beside = pathlib.Path(__file__).resolve().parent / "swarmsmith_programs/bin"
        folder = os.environ.get("SWARMSMITH_BIN") or (beside if beside.is_dir() else None)
        program = pathlib.Path(folder) / "swarmsmith" if folder else "swarmsmith"
    return str(program)


def cannot_start(program, error):
    return Error(f"{program} cannot be started: {error.strerror}. Put `swarmsmith` into PATH, or its folder into SWARMSMITH_BIN")


def path_of(name, path):
    if not isinstance(path, (str, os.PathLike)) or not os.fspath(path):
        raise OptionError(f"{name}: expected the path of a store, found {path!r}")
    return pathlib.Path(path)


class Store:
    """A campaign's store. Each query sees one state of it; queries one after the other may see a later one."""

    def __init__(self, path):
        self.path = path_of("path", path)
        if not self.path.is_file():
            raise Error(f"{self.path}: there is no such store")
        self._connection = sqlite3.connect(self.path.resolve().as_uri() + "?mode=ro", uri=True, timeout=5)
        self._connection.row_factory = sqlite3.Row
        try:
            views = {row["name"] for row in self.query("SELECT name FROM sqlite_master WHERE type = 'view'")}
        except sqlite3.DatabaseError as error:
            raise Error(f"{self.path}: {error}") from error
        if "v_design_scores" not in views:
            raise Error(f"{self.path}: this is not a store of Swarmsmith")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._connection.close()

    def query(self, sql, *parameters):
        """The rows of a statement, as dictionaries."""
        return [dict(row) for row in self._connection.execute(sql, parameters)]

    def frame(self, sql, *parameters):
        """The same as a pandas.DataFrame, which keeps the columns of an answer without rows."""
        import pandas
        return pandas.read_sql_query(sql, self._connection, params=parameters)

    def design_means(self, purpose="test"):
        """A row a finished design and source: mission, method, design, candidate, source, mean, runs. These are the
        values of figures, tables and tests. `purpose`: `test`, on the campaign's own seeds and profile, or `score`, under
        its further profiles or asked for later."""
        if purpose not in PURPOSES:
            raise OptionError(f"purpose: {purpose!r} is not known here; it must be one of {', '.join(PURPOSES)}. "
                              "Other evaluations are rows of v_evaluations")
        return self.query(
            "SELECT mission, method, design, candidate, source, avg(score) AS mean, count(*) AS runs "
            "FROM v_design_scores WHERE purpose = ? GROUP BY design, source ORDER BY design, source", purpose)

    def machine(self, candidate):
        """The text of the grammar of a candidate: 812, or "c812"."""
        if isinstance(candidate, bool) or not re.fullmatch(r"c?[0-9]{1,18}", str(candidate)):
            raise OptionError(f'{candidate!r} is not a candidate: give its number, such as 812 or "c812"')
        number = int(str(candidate).removeprefix("c"))
        rows = self.query("SELECT fsm_config FROM v_candidates WHERE candidate = ?", number)
        if not rows:
            raise Error(f"{self.path}: there is no candidate c{number}")
        return rows[0]["fsm_config"]


def evaluate(machine, seeds=None, *options, program=None):
    """{seed: score} of a machine: a file that `swarmsmith export` wrote, or a text of the grammar, with options of
    `swarmsmith evaluate`: evaluate(text, "1-10", "--flavour", "watermelon", "--mission", "aggregation"). Larger is
    better. The program is `program`, else the one of SWARMSMITH_BIN, else `swarmsmith` in PATH."""
    words = [program_path(program), "evaluate", str(machine), "--json", "--quiet", *map(str, options)]
    if seeds is not None:
        words += ["--seeds", str(seeds)]
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except OSError as error:
        raise cannot_start(words[0], error) from error
    if done.returncode != 0:
        raise Error(done.stderr.strip().removeprefix("swarmsmith: "))
    return {run["seed"]: run["score"] for run in map(json.loads, done.stdout.splitlines())}
