"""A function tuned by irace, in this process or in several."""
import ctypes
import multiprocessing
import os
import pickle
import select
import signal
import sys
import time
import traceback

from swarmsmith_space import Error, OptionError, Space
from swarmsmith_tuner import Trial, Tuner, instances_of


class _Jobs:
    """Processes that call a function. They are forked, so that it may be any function, and end with this process."""

    def __init__(self, function, space, instances, count):
        context = multiprocessing.get_context("fork")
        self._space, self._idle, self.busy, self._processes = space, [], {}, {}
        for _ in range(count):
            here, there = context.Pipe()
            process = context.Process(target=self._work, args=(function, space, instances, there))
            process.start()
            there.close()
            self._idle.append(here)
            self._processes[here] = process

    @staticmethod
    def _work(function, space, instances, link):
        os.setpgid(0, 0)  # what the function starts ends with it, and Ctrl-C is this process's parent's
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
        while True:
            number, instance, seed, bound, texts = link.recv()
            try:
                answer = ("value", function(Trial(number, space.values(texts), instances[instance], seed, bound)))
                pickle.dumps(answer)
            except BaseException as error:  # pylint: disable=broad-except
                answer = ("raised", error, traceback.format_exc())
                try:
                    pickle.loads(pickle.dumps(answer))
                except Exception:  # pylint: disable=broad-except
                    answer = ("raised", Error(f"{type(error).__name__}: {error}"), answer[2])
            link.send(answer)

    def start(self, call):
        link = self._idle.pop()
        self.busy[link] = call
        try:
            link.send(call)
        except OSError:
            raise self._ended(link, call) from None

    def take(self, link):
        """Number of the trial and the answer. Raises what the function has raised."""
        call = self.busy.pop(link)
        try:
            answer = link.recv()
        except (EOFError, OSError):
            raise self._ended(link, call) from None
        self._idle.append(link)
        if answer[0] == "value":
            return call[0], answer[1]
        raise answer[1] from Error("in a job:\n" + answer[2])

    def _ended(self, link, call):
        process = self._processes[link]
        process.join(5)
        code = process.exitcode
        how = "closed its pipe" if code is None else f"ended itself with exit status {code}" if code >= 0 else \
            f"was killed by {signal.Signals(-code).name}"
        return Error(f"the process that evaluated trial {call[0]} {how}; its configuration is {self._space.values(call[4])}")

    def close(self):
        for process in self._processes.values():
            for kill, what in ((os.killpg, process.pid), (os.kill, process.pid)):
                try:
                    kill(what, signal.SIGKILL)
                except OSError:
                    pass
            process.join()


class _Teller:
    """Shows or tells progress, a few times a second."""

    def __init__(self, progress):
        shows = sys.stderr.isatty() if progress is None else progress
        self._tell = progress if callable(progress) else self._show if shows else None
        self._last, self._width = 0, 0

    def tell(self, tuner, last=False):
        if self._tell and (last or time.monotonic() - self._last > 0.2):
            self._last = time.monotonic()
            self._tell(tuner.progress)
            if last and self._width:
                print(file=sys.stderr)

    def _show(self, now):
        text = f"{now.trials}" + (f" of {now.budget}" if now.budget else "") + " trials"
        text += f", iteration {now.iteration} of {now.iterations}" if now.iterations else ""
        text += "" if now.best is None else f", best {now.best:.6g}"
        print("\r" + text.ljust(self._width), end="", file=sys.stderr, flush=True)
        self._width = len(text)


def tune(function, space, *, n_jobs=1, progress=None, **options):
    """The elites of a run of irace, best first (a Result), on a function that takes a Trial and returns a value (smaller is
    better, or larger with direction="maximize"), or value and time. Options as of `Tuner`.

    `n_jobs` processes evaluate at a time, -1 for one a core; what the function changes stays in its process. `progress` is
    a function that takes a Progress, True for a line on standard error, False for none; None shows the line in a terminal.
    An exception of the function ends the run and is raised; with a store the same call goes on."""
    cores = len(os.sched_getaffinity(0))
    if not callable(function):
        raise OptionError(f"function: expected a function that takes a trial, found {function!r}")
    if progress is not None and not isinstance(progress, bool) and not callable(progress):
        raise OptionError(f"progress must be True, False or a function, found {progress!r}")
    if not isinstance(n_jobs, int) or isinstance(n_jobs, bool) or (n_jobs < 1 and n_jobs != -1):
        raise OptionError(f"n_jobs must be a number of processes, or -1 for one per core, found {n_jobs!r}")
    jobs, teller = None, _Teller(progress)
    space = Space(space)
    if n_jobs != 1:
        n_jobs = cores if n_jobs == -1 else n_jobs
        options = {**options, "parallel": n_jobs}
        jobs = _Jobs(function, space, instances_of(options.get("instances")), n_jobs)
    try:
        with Tuner(space, **options) as tuner:
            if jobs:
                _run_jobs(tuner, jobs, teller)
            else:
                while trials := tuner.ask():
                    for trial in trials:
                        _tell(tuner, trial.id, function(trial))
                        teller.tell(tuner)
            teller.tell(tuner, last=True)
            return tuner.best
    finally:
        if jobs:
            jobs.close()


def _tell(tuner, number, answer):
    if isinstance(answer, tuple) and len(answer) != 2:
        raise tuner._no_cost(number, "value", f"{answer!r}: expected a number, or a tuple of a number and a time")
    tuner.tell(number, *(answer if isinstance(answer, tuple) else (answer,)))


def _run_jobs(tuner, jobs, teller):
    while tuner._process.poll() is None:
        for link in select.select([tuner._listener, *jobs.busy], [], [], 0.05)[0]:
            if link is tuner._listener:
                jobs.start(tuner._accept())
            else:
                _tell(tuner, *jobs.take(link))
        teller.tell(tuner)
    tuner._finish()
