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

`tune` is irace (docs/tuner.md) for a Python function, `Tuner` the same as ask and tell.

The views are those of docs/storage.md. A store is opened for reading alone, also while a campaign writes it.
"""
import contextlib
import json
import math
import sys

from swarmsmith_jobs import tune
from swarmsmith_space import Categorical, CostError, Error, Integer, OptionError, Ordinal, Real, SpaceError
from swarmsmith_store import Store, evaluate
from swarmsmith_tuner import Progress, Result, Trial, Tuner

__all__ = ["Categorical", "CostError", "Error", "Integer", "OptionError", "Ordinal", "Progress", "Real", "Result", "SpaceError",
           "Store", "Trial", "Tuner", "evaluate", "tune"]


_TYPES = {"real": Real, "integer": Integer, "categorical": Categorical, "ordinal": Ordinal}


def _ask_and_tell():
    """`python3 -m swarmsmith`: the first line on standard input is {"space": {"x": {"type": "real", "lower": 0,
    "upper": 1}, "m": {"type": "categorical", "values": ["a", "b"]}}, ...options of Tuner}. Lines {"ask": [{"id",
    "configuration", "instance", "seed", "bound"}]} come out, lines {"tell": [{"id", "cost", "time"}]} go in; the last
    is {"best": [...]}."""
    lines = _Lines()
    options = lines.read("the space and the options")
    with lines.named():
        space = _member(options, "space", dict, "the first line")
        space = {name: _domain(name, domain) for name, domain in space.items()}
        tuner = Tuner(space, **{name: value for name, value in options.items() if name not in ("space", "self")})
    with tuner:
        while trials := tuner.ask():
            print(json.dumps({"ask": [trial._asdict() for trial in trials]}), flush=True)
            while tuner._open:
                message = lines.read("an answer to trial " + ", ".join(map(str, tuner._open)))
                with lines.named():
                    for told in _member(message, "tell", list, "an answer"):
                        _tell(tuner, told)
        print(json.dumps({"best": tuner.best}), flush=True)


class _Lines:
    """JSON objects on standard input, and errors with the line's number."""

    def __init__(self):
        self._number = 0

    def read(self, wanted):
        self._number += 1
        line = sys.stdin.readline()
        with self.named():
            if not line:
                raise Error(f"the input ended before {wanted}: the run is not over")
            try:
                read = json.loads(line)
            except ValueError as error:
                raise Error(f"this is not JSON: {error}") from None
            if not isinstance(read, dict):
                raise Error(f"expected a JSON object with {wanted}, found {line.strip()}")
            return read

    @contextlib.contextmanager
    def named(self):
        try:
            yield
        except Error as error:
            raise Error(f"line {self._number}: {error}") from error


def _member(message, name, kind, where):
    if name not in message:
        raise Error(f"`{name}` is missing in {where}")
    if not isinstance(message[name], kind):
        raise Error(f"`{name}` must be {'an object' if kind is dict else 'a list'} in {where}, found {json.dumps(message[name])}")
    return message[name]


def _domain(name, domain):
    """One parameter of the first line."""
    if not isinstance(domain, dict) or str(domain.get("type")) not in _TYPES:
        raise SpaceError(f"{name}: expected an object with `type`, one of {', '.join(_TYPES)}, found {json.dumps(domain)}")
    kind = _TYPES[domain["type"]]
    needed, others = (("values",), ("when",)) if kind in (Categorical, Ordinal) else (("lower", "upper"), ("log", "when"))
    for member in needed:
        if member not in domain:
            raise SpaceError(f"{name}: `{member}` is missing")
    for member in domain:
        if member not in ("type", *needed, *others):
            raise SpaceError(f"{name}: `{member}` is not known; there are {', '.join(('type', *needed, *others))}")
    try:
        return kind(**{member: value for member, value in domain.items() if member != "type"})
    except SpaceError as error:
        raise SpaceError(f"{name}: {error}") from None


def _tell(tuner, told):
    if not isinstance(told, dict) or "id" not in told or "cost" not in told:
        raise Error(f"`tell` must be a list of objects with `id` and `cost`, found {json.dumps(told)}")
    cost = math.inf if told["cost"] is None else told["cost"]
    if not isinstance(cost, (int, float)) or math.isnan(cost):
        raise CostError(f"the cost of trial {told['id']} is {json.dumps(cost)}: expected a number, or null to drop its "
                        "configuration")
    tuner.tell(told["id"], cost, told.get("time"))


if __name__ == "__main__":
    try:
        _ask_and_tell()
    except Error as error:
        sys.exit(f"swarmsmith: {error}")
