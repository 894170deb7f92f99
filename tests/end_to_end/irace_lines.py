"""A table of command lines of `swarmsmith irace`, and what runs a row of it.

A row is a folder with a few files, one or more command lines, and what must come of them. Rows are
independent of each other, so that as many run at a time as there are cores.
"""
import concurrent.futures
import dataclasses
import os
import pathlib
import re
import shlex
import subprocess
import tempfile

from programs import PATIENCE, SWARMSMITH

#: What each row begins with, unless it brings its own: two parameters, ten instances, a cheap target.
PARAMETERS = """\
x    "--x="    i (0, 100)
mode "--mode=" c (a, b, c)
"""
OPTIONS = {"trainInstancesFile": "instances.txt", "maxExperiments": 100, "seed": 42, "parallel": 2}

#: Notes the call; afterwards each parameter with a switch `--name=` is a variable of the shell.
#: `answer` prints and notes; `tenths x 4` is x * 10^4 as a whole number.
RUNNER = """\
#!/bin/sh
echo "$*" >> '{folder}/calls.txt'
id=$1; number=$2; seed=$3; instance=$4; bound=$5
for word; do
  case $word in --*=*) name=${{word%%=*}}; eval "${{name#--}}=\\${{word#*=}}" ;; esac
done
answer() {{ echo "$id $number $seed $*" >> '{folder}/answers.txt'; echo "$*"; }}
tenths() {{ printf %.0f "$1"e"$2"; }}
{body}
"""


@dataclasses.dataclass
class Call:
    """A call of the target, as the target saw it."""
    id: int
    number: str
    seed: int
    instance: str
    words: str
    values: dict


@dataclasses.dataclass
class Row:
    of: str                       # the file of irace's tests that it comes from
    what: str
    lines: tuple                  # (words, exit code, expressions found in its output)
    files: dict
    cwd: str = "."
    home: bool = False            # HOME is the folder
    path: str = ""                # a folder of it that PATH begins with
    budget: int = 0               # most calls of the target; 0: not asked
    every: object = None          # must hold of the parameters of every call
    check: object = None          # gets the finished run, and asserts


class Ran:
    """What became of a row."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.done = []

    out = property(lambda self: self.done[-1].stdout)
    err = property(lambda self: self.done[-1].stderr)

    def lines_of(self, name):
        file = self.folder / name
        return file.read_text().splitlines() if file.exists() else []

    @property
    def calls(self):
        return [call_of(line) for line in self.lines_of("calls.txt")]

    @property
    def times(self):
        """The second word of each answer."""
        return [float(line.split()[4]) for line in self.lines_of("answers.txt")]

    def best(self, number=-1):
        """Number and parameters of the configurations at the end of a run's report."""
        text = self.done[number].stdout.split("# Best configurations as commandlines", 1)
        lines = text[1].split("\n\n")[0].splitlines()[1:] if len(text) == 2 else []
        return [(int(line.split()[0]), values_of(line)) for line in lines]

    def runs_of(self):
        """Calls by configuration."""
        runs = {}
        for call in self.calls:
            runs.setdefault(call.id, []).append(call)
        return runs


def values_of(text):
    """--name=value ...: numbers are numbers."""
    values = {}
    for name, value in re.findall(r"--([\w.]+)=(.*?)(?= +--|$)", text.rstrip()):
        values[name] = float(value) if re.fullmatch(r"-?\d+(\.\d+)?", value) else value
    return values


def call_of(line):
    words = line.split(" ", 4)
    words += [""] * (5 - len(words))
    return Call(int(words[0]), words[1], int(words[2]), words[3], words[4], values_of(words[4]))


def scenario_text(options):
    if isinstance(options, str):
        return options
    whole = {**OPTIONS, **options}
    return "".join(f"{name} = {value if isinstance(value, int) else quoted(value)}\n"
                   for name, value in whole.items() if value is not None)


def quoted(value):
    return str(value) if isinstance(value, float) else f'"{value}"'


class Table:
    """The rows, and the slots in which they run."""

    def __init__(self):
        self.rows = []
        self._slots = concurrent.futures.ThreadPoolExecutor(max(2, os.cpu_count() or 2))
        self._ahead = {}

    def add(self, of, what, line="", *, code=0, says=(), then=(), parameters=PARAMETERS, scenario=None,
            runner="answer $(( 100 + seed % 7 ))", configurations=None, files=None, **more):
        """One row. `says`: expressions that the output must have, standard error where the code is
        not 0. `then`: further command lines, (words, code, says) each."""
        whole = {"parameters.txt": parameters, "scenario.txt": scenario_text(scenario or {}),
                 "instances.txt": "".join(f"{i}\n" for i in range(1, 11)),
                 "target-runner": ("", runner), **(files or {})}
        if configurations is not None:
            whole["configurations.txt"] = configurations
        lines = ((line, code, (says,) if isinstance(says, str) else says), *then)
        self.rows.append(Row(of, what, lines, {k: v for k, v in whole.items() if v is not None}, **more))

    def begin_all(self):
        for number, row in enumerate(self.rows):
            self._ahead[number] = self._slots.submit(run, row)

    def result(self, number):
        if number not in self._ahead:
            self._ahead[number] = self._slots.submit(run, self.rows[number])
        return self._ahead[number].result()


def write(folder, name, text):
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(text, tuple):  # ("", body): a program with the beginning of RUNNER
        text = RUNNER.format(folder=folder, body=text[1])
    elif text.startswith("link:"):
        file.symlink_to(text.removeprefix("link:"))
        return
    file.write_text(text.replace("{folder}", str(folder)))
    if text.startswith("#!"):
        file.chmod(0o755)


def run(row):
    """Runs the row and says what is wrong with it: an empty text for nothing."""
    with tempfile.TemporaryDirectory(prefix="swarmsmith-test-") as name:
        folder = pathlib.Path(name).resolve()
        ran = Ran(folder)
        for file, text in row.files.items():
            write(folder, file, text)
        environment = dict(os.environ)
        if row.home:
            environment["HOME"] = str(folder)
        if row.path:
            environment["PATH"] = f"{folder / row.path}:{environment['PATH']}"
        try:
            for words, code, says in row.lines:
                words = shlex.split(words.replace("{folder}", str(folder)))
                ran.done.append(subprocess.run(
                    [SWARMSMITH, "irace", *words], capture_output=True, text=True, errors="replace",
                    cwd=folder / row.cwd, env=environment, timeout=20 * PATIENCE, check=False))
                check_line(ran, words, code, says)
            check_whole(row, ran)
        except (AssertionError, subprocess.TimeoutExpired) as wrong:
            last = ran.done[-1] if ran.done else None
            heard = f"\nstdout ends with:\n{last.stdout[-2500:]}\nstderr:\n{last.stderr[-2500:]}" if last else ""
            return f"{wrong}{heard}"
        return ""


def check_line(ran, words, code, says):
    done = ran.done[-1]
    assert done.returncode == code, f"exit code {done.returncode}, and not {code}"
    heard = done.stderr if code != 0 else done.stdout + done.stderr
    for expression in says:
        assert re.search(expression, heard, re.MULTILINE), f"nothing of {expression!r} was said"
    if code != 0:
        assert re.search("^swarmsmith: ", done.stderr, re.MULTILINE), "the error does not say who speaks"
        assert "Best configurations" not in done.stdout, "a result beside an error"
    elif not {"--check", "-c", "--help", "--version", "--only-test", "-q", "--quiet", "--json", "ablation",
              "--ablation", "--init"} & set(words):
        assert ran.best(), "no configuration at the end"


def check_whole(row, ran):
    calls = ran.calls
    if row.budget:
        assert len(calls) <= row.budget, f"{len(calls)} runs, and the budget is {row.budget}"
        assert len(calls) >= row.budget // 2, f"only {len(calls)} runs of {row.budget}"
        keys = [(call.id, call.number, call.seed) for call in calls]
        assert len(set(keys)) == len(keys), "a run was made twice"
        assert all(1 <= call.seed <= 2147483647 for call in calls), "a seed that is none"
        known = ran.runs_of()
        for number, runs in known.items():
            assert len({call.words for call in runs}) <= 1 or "bound" in ran.out, f"{number} has two texts"
        for number, _ in ran.best():
            assert number in known, f"configuration {number} was never run"
        survive = re.search(r"^# minNbSurvival: (\d+)$", ran.done[0].stdout, re.MULTILINE)
        assert survive and len(ran.best(0)) <= int(survive[1]), "more elites than may survive"
        used = re.findall(r"^# experimentsUsed: (\d+)$", ran.done[0].stdout, re.MULTILINE)
        assert len(ran.done) > 1 or int(used[-1]) == len(calls), f"{used[-1]} are reported, {len(calls)} were made"
    if row.every is not None:
        assert calls, "the target was never called"
        for call in calls:
            assert row.every(call.values), f"this should not have been called: {call.words}"
    if row.check is not None:
        row.check(ran)
