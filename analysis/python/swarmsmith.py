"""Swarmsmith's stores and programs from Python: the standard library alone, pandas where it is asked for.

    import swarmsmith
    with swarmsmith.Store("demo.db") as store:
        for row in store.design_means():
            print(row["mission"], row["method"], row["design"], row["mean"])
        frame = store.frame("SELECT * FROM v_convergence WHERE design = ?", 1)  # a pandas.DataFrame
    scores = swarmsmith.evaluate("best.fsm", seeds="1-100")                     # {seed: score}

    space = {"C": swarmsmith.Real(0.01, 100, log=True), "kernel": ["rbf", "poly"],
             "degree": swarmsmith.Integer(2, 5, when='kernel == "poly"')}
    best = swarmsmith.tune(lambda trial: cost_of(**trial.configuration), space, max_experiments=300, store="svm.db")

`tune` is irace (docs/irace.md) for a Python function, `Tuner` the same as ask and tell.

The views are those of docs/storage.md. A store is opened for reading alone, also while a campaign writes it.
"""
import collections
import json
import math
import os
import pathlib
import re
import select
import socket
import sqlite3
import subprocess
import sys
import tempfile

__all__ = ["Error", "Integer", "Ordinal", "Real", "Categorical", "Store", "Trial", "Tuner", "evaluate", "tune"]


class Error(Exception):
    """What cannot be done, in the program's words or in ours."""


def _program(program):
    if program is None:
        folder = os.environ.get("SWARMSMITH_BIN")
        program = pathlib.Path(folder) / "swarmsmith" if folder else "swarmsmith"
    return str(program)


class Store:
    """A campaign's store. Each query sees one state of it; queries one after the other may see a later one."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        if not self.path.is_file():
            raise Error(f"{self.path}: there is no such store")
        self._connection = sqlite3.connect(self.path.resolve().as_uri() + "?mode=ro", uri=True, timeout=5)
        self._connection.row_factory = sqlite3.Row
        try:
            views = {row["name"] for row in self.query("SELECT name FROM sqlite_master WHERE type = 'view'")}
        except sqlite3.DatabaseError as error:
            raise Error(f"{self.path}: {error}") from error
        if "v_design_scores" not in views:
            raise Error(f"{self.path}: this is no store of Swarmsmith")

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
        values of figures, tables and tests. `purpose`: `test`, the campaign's own, or `score`, asked for later."""
        return self.query(
            "SELECT mission, method, design, candidate, source, avg(score) AS mean, count(*) AS runs "
            "FROM v_design_scores WHERE purpose = ? GROUP BY design, source ORDER BY design, source", purpose)

    def machine(self, candidate):
        """The text of the grammar of a candidate: 812, or "c812"."""
        number = int(str(candidate).removeprefix("c"))
        rows = self.query("SELECT fsm_config FROM v_candidates WHERE candidate = ?", number)
        if not rows:
            raise Error(f"{self.path}: there is no candidate c{number}")
        return rows[0]["fsm_config"]


def evaluate(machine, seeds=None, *options, program=None):
    """{seed: score} of a machine: a file that `swarmsmith export` wrote, or a text of the grammar, with options of
    `swarmsmith evaluate`: evaluate(text, "1-10", "--flavour", "watermelon", "--mission", "aggregation"). Larger is
    better. The program is `program`, else the one of SWARMSMITH_BIN, else `swarmsmith` in PATH."""
    words = [_program(program), "evaluate", str(machine), "--json", "--quiet", *map(str, options)]
    if seeds is not None:
        words += ["--seeds", str(seeds)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Error(done.stderr.strip().removeprefix("swarmsmith: "))
    return {run["seed"]: run["score"] for run in map(json.loads, done.stdout.splitlines())}


class _Choice:
    """Values of any type; `when` is a condition on other parameters, in R's words: 'kernel == "poly"'."""

    def __init__(self, values, when=None):
        self.values, self.when = list(values), when
        self.texts = [_plain(value) for value in self.values]
        if len(set(self.texts)) != len(self.texts):
            raise Error(f"two of the values {self.texts} are written alike: give texts that differ")

    def domain(self):
        return ", ".join(f'"{text}"' for text in self.texts)

    def value(self, text):
        return self.values[self.texts.index(str(text))]

    def text(self, value):
        return f'"{self.texts[self.values.index(value)]}"'


class Categorical(_Choice):
    """Values without an order. A list alone means the same."""
    letter = "c"


class Ordinal(_Choice):
    """Values in an order."""
    letter = "o"


class _Number:
    def __init__(self, lower, upper, log=False, when=None):
        self.lower, self.upper, self.log, self.when = lower, upper, log, when

    def domain(self):
        return f"{self.lower}, {self.upper}"

    def value(self, text):
        return self.type(float(text))

    def text(self, value):
        return str(value)

    @property
    def letter(self):
        return self.kind + (",log" if self.log else "")


class Integer(_Number):
    """Whole numbers from lower to upper; with `log` sampled in the logarithm."""
    kind, type = "i", int


class Real(_Number):
    """Numbers from lower to upper; with `log` sampled in the logarithm."""
    kind, type = "r", float


def _plain(value):
    """A text that neither a shell nor irace's files read anything into."""
    return re.sub(r"[^A-Za-z0-9_.+-]", "_", str(value))


Trial = collections.namedtuple("Trial", "id configuration instance seed bound")
Trial.__doc__ = """What is to be evaluated: `id` for `tell`, the configuration as a dictionary of its active parameters,
the instance (of the list that was given, else None), a seed, and the most time it may take (None without boundMax)."""


class Tuner:
    """irace as ask and tell, for costs that Python works out (smaller is better):

        with Tuner({"x": Real(0, 1)}, max_experiments=200, store="x.db") as tuner:
            while trials := tuner.ask():
                for trial in trials:
                    tuner.tell(trial.id, cost_of(trial))
            print(tuner.best[0])

    `space` has a parameter a name; `initial` are configurations to begin with, `instances` what costs are taken on,
    `forbidden` conditions in R's words that no configuration may fulfil. Other options are those of irace
    (docs/irace-options.md), written as max_experiments and seed, but for files, programs and test instances, which a
    tuner has no use for. `digits` are the decimals of reals.
    With `store` the run is kept, and the same call goes on after a crash: what was told is not asked again."""

    def __init__(self, space, *, store=None, instances=(None,), initial=(), forbidden=(), digits=4, parallel=1,
                 program=None, **options):
        self._space = {name: Categorical(domain) if isinstance(domain, (list, tuple)) else domain
                       for name, domain in space.items()}
        for name in self._space:
            if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_.]*", name):
                raise Error(f"'{name}' is no name of a parameter: letters, digits, '_' and '.'")
        for name in options:
            if name.startswith(("test_instances", "train_instances", "target_", "log_file", "exec_dir")) or \
                    name.endswith("_file"):
                raise Error(f"{name} has no effect here: a function, its instances and a store are given")
        self._instances = list(instances)
        self._open, self._count, self._best, self.store = {}, 0, None, store
        self._folder = tempfile.TemporaryDirectory(prefix="swarmsmith-tuner-")
        folder = pathlib.Path(self._folder.name)
        self._listener = socket.socket(socket.AF_UNIX)
        try:
            self._listener.bind(str(folder / "socket"))
        except OSError as error:
            raise Error(f"{folder}: {error}; set TMPDIR to a folder with a shorter path") from error
        self._listener.listen(1024)
        self._write_files(folder, initial, forbidden, digits)
        home = pathlib.Path(store).resolve().parent if store else folder
        relay = pathlib.Path(__file__).resolve().parent / "swarmsmith_relay.py"
        scenario = {"parameterFile": folder / "parameters.txt", "trainInstancesFile": folder / "instances.txt",
                    "execDir": home, "targetRunner": relay, "targetRunnerLauncher": sys.executable, "logFile": "",
                    "targetCmdline": "-IS {targetRunner} {configurationID} {instanceID} {seed} bound={bound} "
                                     "instance={instance} {targetRunnerArgs}"}
        if initial:
            scenario["configurationsFile"] = folder / "configurations.txt"
        scenario |= {re.sub(r"_(\w)", lambda found: found[1].upper(), name): value for name, value in options.items()}
        (folder / "scenario.txt").write_text("".join(f"{name} = {_r(value)}\n" for name, value in scenario.items()))
        words = [_program(program), "irace", "--scenario", str(folder / "scenario.txt"), "--json",
                 "--parallel", str(parallel)]
        if store:
            words += ["--store", str(pathlib.Path(store).resolve())]
        with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
            self._process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                             env={**os.environ, "SWARMSMITH_TUNER": str(folder / "socket")})

    def _write_files(self, folder, initial, forbidden, digits):
        lines = [f'{name} "{name}=" {domain.letter} ({domain.domain()})' + (f" | {domain.when}" if domain.when else "")
                 for name, domain in self._space.items()]
        lines += ["[forbidden]", *forbidden, "[global]", f"digits = {digits}"]
        (folder / "parameters.txt").write_text("\n".join(lines) + "\n")
        names = [f"{number}-{_plain(instance)}" for number, instance in enumerate(self._instances, 1)]
        (folder / "instances.txt").write_text("\n".join(names) + "\n")
        rows = [" ".join(self._space)]
        for one in initial:
            rows.append(" ".join(self._space[name].text(one[name]) if name in one else "NA" for name in self._space))
        (folder / "configurations.txt").write_text("\n".join(rows) + "\n")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def ask(self):
        """Trials that wait for their costs, as many as `parallel` at a time; none once the run is over."""
        trials = []
        while not trials and self._process.poll() is None:
            while select.select([self._listener], [], [], 0 if trials else 0.05)[0]:
                trials.append(self._accept())
        if not trials:
            self._finish()
        return trials

    def _accept(self):
        link, _ = self._listener.accept()
        text = b""
        while not text.endswith(b"\n"):
            text += link.recv(65536)
        number, instance, seed, bound, _, *words = text.decode()[:-1].split("\0")
        configuration = dict(word.split("=", 1) for word in words)
        self._count += 1
        self._open[self._count] = link
        position = int(instance.rstrip("t")) - 1
        bound = bound.removeprefix("bound=")
        return Trial(self._count, self._values(configuration), self._instances[position], int(seed),
                     float(bound) if bound else None)

    def _values(self, configuration):
        return {name: self._space[name].value(text) for name, text in configuration.items() if text is not None}

    def tell(self, id, cost, time=None):
        """The cost of a trial, infinite for a configuration that is to be dropped, and the time it took."""
        if math.isnan(cost):
            raise Error("a cost is not a number; tell math.inf to drop a configuration")
        text = "Inf" if math.isinf(cost) else repr(float(cost))
        self._answer(id, "cost " + text + ("" if time is None else f" {float(time)!r}"))

    def fail(self, id, reason):
        """There is no cost: the run ends (option on_failure of the program), and goes on with the same call."""
        self._answer(id, f"error {reason}")

    def _answer(self, id, text):
        if id not in self._open:
            raise Error(f"trial {id} was not asked, or was told already")
        with self._open.pop(id) as link:
            try:
                link.sendall(text.encode())
            except OSError:
                pass  # The program has ended, which ask() says.

    @property
    def best(self):
        """The elites, best first: dictionaries of id, cost (the mean), and configuration. Once the run is over."""
        if self._best is None:
            raise Error("the run is not over")
        return self._best

    def _finish(self):
        if self._best is not None:
            return
        folder = pathlib.Path(self._folder.name)
        if self._process.returncode != 0:
            raise Error((folder / "err").read_text().strip().removeprefix("swarmsmith: ") or "the run was ended")
        done = json.loads((folder / "out").read_text().splitlines()[-1])
        self._best = [{"id": one["id"], "cost": one["mean_cost"], "configuration": self._values(one["parameters"])}
                      for one in done["best"]]

    def close(self):
        """Ends the program; with a store the same call goes on later."""
        if self._process.poll() is None:
            self._process.terminate()
        for link in self._open.values():
            link.close()
        self._open.clear()
        self._process.wait()
        self._listener.close()
        self._folder.cleanup()


def _r(value):
    if isinstance(value, bool):
        return str(int(value))
    return str(value) if isinstance(value, (int, float)) else json.dumps(str(value))


def tune(function, space, **options):
    """The elites of a run of irace, best first, on a function that takes a Trial and returns its cost, or cost and
    time. Options as of `Tuner`. An exception of the function ends the run and is raised."""
    with Tuner(space, **options) as tuner:
        while trials := tuner.ask():
            for trial in trials:
                answer = function(trial)
                tuner.tell(trial.id, *(answer if isinstance(answer, tuple) else (answer,)))
        return tuner.best


def _ask_and_tell():
    """`python3 -m swarmsmith`: the first line on standard input is {"space": {"x": {"type": "real", "lower": 0,
    "upper": 1}, "m": {"type": "categorical", "values": ["a", "b"]}}, ...options of Tuner}. Lines {"ask": [{"id",
    "configuration", "instance", "seed", "bound"}]} come out, lines {"tell": [{"id", "cost", "time"}]} go in; the last
    is {"best": [...]}."""
    types = {"real": Real, "integer": Integer, "categorical": Categorical, "ordinal": Ordinal}
    options = json.loads(sys.stdin.readline())
    space = {name: types[domain.pop("type")](**domain) for name, domain in options.pop("space").items()}
    with Tuner(space, **options) as tuner:
        while trials := tuner.ask():
            print(json.dumps({"ask": [trial._asdict() for trial in trials]}), flush=True)
            for _ in trials:
                line = sys.stdin.readline()
                if not line:
                    return
                for told in json.loads(line)["tell"]:
                    cost = math.inf if told["cost"] is None else told["cost"]
                    tuner.tell(told["id"], cost, told.get("time"))
                if not tuner._open:
                    break
        print(json.dumps({"best": tuner.best}), flush=True)


if __name__ == "__main__":
    try:
        _ask_and_tell()
    except (Error, KeyError, TypeError, ValueError) as error:
        sys.exit(f"swarmsmith: {error}")
