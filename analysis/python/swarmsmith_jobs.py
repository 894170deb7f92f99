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
from swarmsmith_tuner import Trial, Tuner


class _Jobs:
    """Processes that call a function. They are forked, so that it may be any function, and end with this process."""

    def __init__(self, function, space, instances, count):
        context = multiprocessing.get_context("fork")
        self._idle, self.busy, self._processes = [], {}, []
        for _ in range(count):
            here, there = context.Pipe()
            process = context.Process(target=self._work, args=(function, space, instances, there))
            process.start()
            there.close()
            self._idle.append(here)
            self._processes.append(process)

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
        link.send(call)

    def take(self, link):
        """Number of the trial and the answer. Raises what the function has raised."""
        call = self.busy.pop(link)
        try:
            answer = link.recv()
        except EOFError:
            raise Error(f"the process that evaluated trial {call[0]} was killed: {call[4]}") from None
        self._idle.append(link)
        if answer[0] == "value":
            return call[0], answer[1]
        raise answer[1] from Error("in a job:\n" + answer[2])

    def close(self):
        for process in self._processes:
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
    if not isinstance(n_jobs, int) or (n_jobs < 1 and n_jobs != -1):
        raise OptionError(f"n_jobs is a number of processes, or -1 for one a core, found {n_jobs!r}")
    jobs, teller = None, _Teller(progress)
    space = Space(space)
    if n_jobs != 1:
        n_jobs = cores if n_jobs == -1 else n_jobs
        options = {**options, "parallel": n_jobs}
        instances = options.get("instances")
        jobs = _Jobs(function, space, [None] if instances is None else list(instances), n_jobs)
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
