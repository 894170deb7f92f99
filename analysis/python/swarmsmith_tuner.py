"""irace as ask and tell: the program runs, and its calls of a target come here (swarmsmith_relay.py)."""
import collections
import json
import math
import os
import pathlib
import re
import select
import socket
import subprocess
import sys
import tempfile
import warnings

from swarmsmith_space import LARGEST, CostError, Error, OptionError, Space, SpaceError, is_number, plain, sequence
from swarmsmith_store import Store, cannot_start, path_of, program_path

_MAXIMIZE = "direction=maximize"  # a word of each call, so that the program compares it with that of the store
Trial = collections.namedtuple("Trial", "id configuration instance seed bound")
Trial.__doc__ = """What is to be evaluated: `id` for `tell`, the configuration as a dictionary of its active parameters,
the instance (of the list that was given, else None), a seed, and the most time it may take (None without boundMax)."""


Progress = collections.namedtuple("Progress", "trials budget iteration iterations best")
Progress.__doc__ = """How far a run is: trials that have been told, of `budget` (None with max_time); iteration `iteration` of
`iterations`; the mean value of the best configuration so far, or None."""


class Result(list):
    """The elites, best first: dictionaries of `id`, `cost` (the mean, smaller is better), `value` (the mean of what the
    function returned), and `configuration`. `trials` are all runs of the race: dictionaries of `id` (the configuration's),
    `configuration`, `instance`, `seed`, `cost`, `value` and `time`."""

    def __init__(self, best, trials):
        super().__init__(best)
        self.trials = trials

    def frame(self):
        """The elites as a pandas.DataFrame, with a column a parameter."""
        return _frame(self)

    def trials_frame(self):
        """All runs as a pandas.DataFrame, with a column a parameter."""
        return _frame(self.trials)


def _frame(rows):
    import pandas
    return pandas.DataFrame([{**{key: value for key, value in row.items() if key != "configuration"}, **row["configuration"]}
                             for row in rows])


def instances_of(instances):
    """Those of the option: one without a value if there are none."""
    instances = [None] if instances is None else sequence("instances", instances, "values", OptionError)
    if not instances:
        raise OptionError("instances is an empty list: leave it out where there are none")
    return instances


def _check_option(name, value):
    if name.startswith(("test_instances", "train_instances", "target_", "log_file", "exec_dir")) or name.endswith("_file"):
        raise OptionError(f"{name} has no effect here: a function, its instances and a store are given")
    if not isinstance(value, (bool, str)) and not (is_number(value) and abs(value) <= LARGEST):
        raise OptionError(f"{name}: expected a number, a text, True or False, found {value!r}")


def _check_whole(name, value, least):
    if not is_number(value) or value != value // 1 or value < least:
        raise OptionError(f"{name}: expected a whole number of at least {least}, found {value!r}")


class Tuner:
    """irace as ask and tell, for values that Python works out:

        with Tuner({"x": Real(0, 1)}, max_experiments=200, store="x.db") as tuner:
            while trials := tuner.ask():
                for trial in trials:
                    tuner.tell(trial.id, cost_of(trial))
            print(tuner.best[0])

    `space` has a parameter a name: a tuple of two numbers is a range, a list is a choice. `initial` are configurations to
    begin with, `instances` what values are taken on, `forbidden` conditions in R's words that no configuration may fulfil.
    `direction` is "minimize" or "maximize". `digits` are the decimals of reals; without a number as many as the space
    needs, at least 4. Other options are those of irace (docs/irace-options.md), written as max_experiments and seed, but
    for files, programs and test instances, which a tuner has no use for; None leaves one out.
    With `store` the run is kept, and the same call goes on after a crash: what was told is not asked again."""

    def __init__(self, space, *, store=None, instances=(None,), initial=(), forbidden=(), digits=None, parallel=1,
                 direction="minimize", program=None, **options):
        self._space = space if isinstance(space, Space) else Space(space)
        if direction not in ("minimize", "maximize"):
            raise OptionError(f'direction must be "minimize" or "maximize", found {direction!r}')
        self._sign = -1 if direction == "maximize" else 1
        options = {name: value for name, value in options.items() if value is not None}
        for name, value in options.items():
            _check_option(name, value)
        _check_whole("parallel", parallel, 1)
        if digits is not None:
            _check_whole("digits", digits, 0)
        initial = sequence("initial", () if initial is None else initial, "configurations", SpaceError)
        forbidden = sequence("forbidden", () if forbidden is None else forbidden, "conditions", SpaceError)
        self._instances = instances_of(instances)
        kept = None if store is None else path_of("store", store).resolve()
        self._open, self._count, self._best, self.store = {}, 0, None, store
        self._configurations, self._numbers, self._failed = {}, {}, {}
        self._folder = tempfile.TemporaryDirectory(prefix="swarmsmith-tuner-")
        folder = pathlib.Path(self._folder.name)
        self._file = kept or folder / "run.db"
        self._listener = socket.socket(socket.AF_UNIX)
        self._events, self._told, self._race, self._step = None, 0, {}, {}
        self._budget = options.get("max_experiments")
        try:
            self._write_files(folder, initial, forbidden, self._digits(digits, self._check_store(direction)))
            self._start(folder, bool(initial), parallel, program, options)
        except BaseException:
            self._listener.close()
            self._folder.cleanup()
            raise

    def _start(self, folder, begins_with, parallel, program, options):
        try:
            self._listener.bind(str(folder / "socket"))
        except OSError as error:
            raise Error(f"{folder}: {error}; set TMPDIR to a folder with a shorter path") from error
        self._listener.listen(1024)
        relay = pathlib.Path(__file__).resolve().parent / "swarmsmith_relay.py"
        scenario = {"parameterFile": folder / "parameters.txt", "trainInstancesFile": folder / "instances.txt",
                    "execDir": self._file.parent, "targetRunner": relay, "targetRunnerLauncher": sys.executable, "logFile": "",
                    "targetCmdline": "-IS {targetRunner} {configurationID} {instanceID} {seed} bound={bound} instance={instance} "
                                     + (_MAXIMIZE + " " if self._sign < 0 else "") + "{targetRunnerArgs}"}
        if begins_with:
            scenario["configurationsFile"] = folder / "configurations.txt"
        self._given = [*[None] * len(scenario), *options]  # by the line of the scenario, for errors
        scenario |= {re.sub(r"_(\w)", lambda found: found[1].upper(), name): value for name, value in options.items()}
        (folder / "scenario.txt").write_text("".join(f"{name} = {_r(value)}\n" for name, value in scenario.items()))
        words = [program_path(program), "irace", "--scenario", str(folder / "scenario.txt"), "--json",
                 "--parallel", str(parallel), "--store", str(self._file)]
        with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
            try:
                self._process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                                 env={**os.environ, "SWARMSMITH_TUNER": str(folder / "socket")})
            except OSError as error:
                raise cannot_start(words[0], error) from error

    def _check_store(self, direction):
        """The text of the run that a store holds already, which must have this direction: scores have its sign."""
        if not self._file.is_file():
            return ""
        with Store(self._file) as store:
            text = "\n".join(row["file"] for row in store.query("SELECT file FROM v_campaigns"))
        found = "maximize" if re.search(rf"(?m)^command_line = .* {_MAXIMIZE} ", text) else "minimize"
        if found != direction and "swarmsmith_relay.py" in text:
            raise OptionError(f'direction: {self._file} was made with "{found}", and its values would change their sign: give '
                              f'direction="{found}", or another store')
        return text

    def _digits(self, digits, kept):
        """Those of a store that is there already: the same call must go on."""
        if digits is not None:
            return int(digits)
        found = re.search(r"(?m)^digits = (\d+)", kept)
        return int(found[1]) if found else self._space.digits()

    def _write_files(self, folder, initial, forbidden, digits):
        self._lines = [f"space: {name}" for name in self._space.domains]
        self._lines += ["forbidden", *[f"forbidden: {text}" for text in forbidden], "digits", "digits"]
        conditions = []
        for number, text in enumerate(forbidden):
            try:
                conditions.append(self._space.expression(text))
            except SpaceError as error:
                raise SpaceError(f"forbidden[{number}]: {error}") from None
        lines = [*self._space.parameter_lines(), "[forbidden]", *conditions, "[global]", f"digits = {digits}"]
        (folder / "parameters.txt").write_text("\n".join(lines) + "\n")
        names = [f"{number}-{plain(instance)}" for number, instance in enumerate(self._instances, 1)]
        (folder / "instances.txt").write_text("\n".join(names) + "\n")
        rows = [" ".join(self._space.names)]
        for number, one in enumerate(initial):
            try:
                rows.append(self._space.configuration_line(one))
            except SpaceError as error:
                raise SpaceError(f"initial[{number}]: {error}") from None
        (folder / "configurations.txt").write_text("\n".join(rows) + "\n")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def ask(self):
        """Trials that wait for their values, as many as `parallel` at a time; none once the run is over."""
        trials = []
        while not trials and self._process.poll() is None:
            while select.select([self._listener], [], [], 0 if trials else 0.05)[0]:
                trials.append(self._trial(*self._accept()))
        if not trials:
            self._finish()
        return trials

    def _accept(self):
        """A call that waits: its number here, instance, seed, bound, and irace's names and texts."""
        link, _ = self._listener.accept()
        text = b""
        while not text.endswith(b"\n"):
            text += link.recv(65536)
        candidate, instance, seed, bound, _, *words = text.decode()[:-1].split("\0")
        texts = dict(word.split("=", 1) for word in words[self._sign < 0:])  # without _MAXIMIZE
        self._count += 1
        self._open[self._count] = link
        self._configurations[self._count] = self._space.values(texts)
        self._numbers[candidate, instance, seed] = self._count
        bound = bound.removeprefix("bound=")
        return (self._count, int(instance.rstrip("t")) - 1, int(seed), float(bound) if bound else None,
                texts)

    def _trial(self, number, instance, seed, bound, texts):
        return Trial(number, self._space.values(texts), self._instances[instance], seed, bound)

    def tell(self, id, value, time=None):
        """The value of a trial, infinite for a configuration that is to be dropped, and the time it took."""
        if value is None or isinstance(value, (str, bytes)):
            raise self._no_cost(id, "value", f"{value!r}: expected a number, or math.inf to drop its configuration")
        try:
            value = float(value)
        except (TypeError, ValueError, OverflowError):
            raise self._no_cost(id, "value", f"of type {type(value).__name__}: expected a number") from None
        if math.isnan(value):
            raise self._no_cost(id, "value", "not a number; tell math.inf to drop its configuration")
        if time is not None and not (is_number(time) and 0 < time <= LARGEST):
            raise self._no_cost(id, "time", f"{time!r}: expected a finite number above 0, or None")
        text = "Inf" if math.isinf(value) else repr(self._sign * value)
        self._answer(id, "cost " + text + ("" if time is None else f" {float(time)!r}"))
        self._told += 1

    def fail(self, id, reason):
        """There is no value: the run ends (option on_failure of the program), and goes on with the same call."""
        self._answer(id, f"error {reason}")
        self._failed[id] = reason

    def _no_cost(self, number, what, found):
        text = f"the {what} of trial {number} is {found}"
        if self._is_open(number):
            text += f"; its configuration is {self._configurations[number]}"
        return CostError(text)

    def _is_open(self, number):
        return isinstance(number, int) and number in self._open

    def _answer(self, id, text):
        if not self._is_open(id):
            raise Error(f"trial {id} was not asked, or was already told")
        with self._open.pop(id) as link:
            try:
                link.sendall(text.encode())
            except OSError:
                pass  # The program has ended, which ask() says.

    @property
    def progress(self):
        """How far the run is: a Progress."""
        self._events = self._events or open(pathlib.Path(self._folder.name) / "out")
        while (at := self._events.tell()) is not None and (line := self._events.readline()):
            if not line.endswith("\n"):
                self._events.seek(at)
                break
            event = json.loads(line)
            if event.get("event") == "iteration":
                self._race = event
            elif event.get("event") == "race_step":
                self._step = event
        mean = self._step.get("mean_best")
        return Progress(max(self._told, self._step.get("used", 0)), self._budget, self._race.get("iteration", 0),
                        self._race.get("of", 0), None if mean is None else self._sign * mean)

    @property
    def best(self):
        """The elites, best first, with all trials: a Result. Once the run is over."""
        if self._best is None:
            raise Error("the run is not over")
        return self._best

    def _finish(self):
        if self._best is not None:
            return
        folder = pathlib.Path(self._folder.name)
        said = (folder / "err").read_text()
        if self._process.returncode != 0:
            raise self._in_our_words(said)
        if self._count == 0:
            warnings.warn(f"nothing was run: these are the results that {self.store} holds; give another store, or move it "
                          "away, to run all of it again", stacklevel=4)
        done = json.loads((folder / "out").read_text().splitlines()[-1])
        best = [{"id": one["id"], **self._values(one["mean_cost"]), "configuration": self._space.values(one["parameters"])}
                for one in done["best"]]
        self._best = Result(best, self._trials())

    def _values(self, cost):
        """JSON and SQL have a rejection as null."""
        cost = math.inf if cost is None else cost + 0.0
        return {"cost": cost, "value": self._sign * cost + 0.0}

    def _trials(self):
        with Store(self._file) as store:
            configurations = {row["candidate"]: (row["number"], self._space.values(json.loads(row["parameters"]))) for row in
                              store.query("SELECT candidate, number, parameters FROM v_candidates")}
            rows = store.query("SELECT candidate, instance, seed, -score AS cost, time FROM v_evaluations "
                               "WHERE purpose = 'race' ORDER BY pair, candidate")
        trials = []
        for row in rows:
            number, configuration = configurations[row["candidate"]]
            trials.append({"id": number, "configuration": configuration, "instance": self._instances[row["instance"] - 1],
                           "seed": row["seed"], **self._values(row["cost"]), "time": row["time"]})
        return trials

    def _in_our_words(self, said):
        """What the program says of the files that it was given, as what it is here."""
        kind, lines = Error, []
        if found := re.search(r"failed: (.*)\n *The call was:\n.*swarmsmith_relay\.py'? (\S+) (\S+) (\S+) ", said):
            number = self._numbers.get(found.groups()[1:])
            if number is not None:
                return Error(f"trial {number} failed: {self._failed.get(number, found[1])}; its configuration is "
                             f"{self._configurations[number]}" +
                             (f". The same call continues from {self.store}" if self.store else ""))
        if not self.store:
            said = re.sub(r"(?m)^.*everything so far is in .*\n?", "", said)
        for line in said.strip().splitlines():
            line = line.removeprefix("swarmsmith: ")
            if found := re.search(r"(?:\S*/)?\b(scenario|parameters|configurations)\.txt:(\d+)(?::\d+)?: ", line):
                at = int(found[2]) - 1
                name, kind = None, OptionError if found[1] == "scenario" else SpaceError
                if found[1] == "configurations":
                    name = f"initial[{at - 1}]"
                else:
                    name = dict(enumerate(self._given if found[1] == "scenario" else self._lines)).get(at)
                line = line[:found.start()] + (f"{name}: " if name else "") + line[found.end():]
            line = line.replace(" (--log-file NAME)", "").replace("--log-file NAME, or --store PATH", "store=NAME")
            line = line.replace("; names of your own variables must begin with a dot", "")
            for written, name in self._space.names.items():
                line = line.replace(f"'{written}'", f"'{name}'")
            line = re.sub(r"(?<![\w'\"])(`?)([a-z]+(?:[A-Z][a-z]+)+)\b\1|(?<=did you mean \")()(\w+)", _snake, line)
            lines.append(re.sub(r"^(\w+): \1: ", r"\1: ", line))
        return kind("\n".join(lines) or "the run was ended")

    def close(self):
        """Ends the program; with a store the same call goes on later."""
        if self._process.poll() is None:
            self._process.terminate()
        for link in self._open.values():
            link.close()
        self._open.clear()
        self._process.wait()
        if self._events:
            self._events.close()
        self._listener.close()
        self._folder.cleanup()


def _snake(found):
    """firstTest, as irace writes it, is first_test here."""
    return re.sub(r"[A-Z]", lambda letter: "_" + letter[0].lower(), found[2] or found[4])


def _r(value):
    if isinstance(value, bool):
        return str(int(value))
    return repr(float(value)) if is_number(value) and not float(value).is_integer() else \
        str(int(value)) if is_number(value) else json.dumps(str(value))
