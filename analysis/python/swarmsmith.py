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
import json
import math
import sys

from swarmsmith_jobs import tune
from swarmsmith_space import Categorical, CostError, Error, Integer, OptionError, Ordinal, Real, SpaceError
from swarmsmith_store import Store, evaluate
from swarmsmith_tuner import Progress, Result, Trial, Tuner

__all__ = ["Categorical", "CostError", "Error", "Integer", "OptionError", "Ordinal", "Progress", "Real", "Result", "SpaceError",
           "Store", "Trial", "Tuner", "evaluate", "tune"]


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
