#!/usr/bin/python3
"""Tunes a Python function with irace: a support vector machine where scikit-learn is installed, else a formula.

    PYTHONPATH=analysis/python python3 examples/tuner.py
"""
import math
import sys

import swarmsmith

SPACE = {
    "C": swarmsmith.Real(0.01, 1000, log=True),
    "kernel": ["rbf", "poly", "linear"],
    "gamma": swarmsmith.Real(0.0001, 10, log=True, when='kernel != "linear"'),
    "degree": swarmsmith.Integer(2, 5, when='kernel == "poly"'),
}
DEFAULTS = {"C": 1.0, "kernel": "rbf", "gamma": 0.1}


def model_error(trial):
    """The share of handwritten digits that a model takes for others, on a part of the data drawn by the seed."""
    from sklearn import datasets, model_selection, svm
    x, y = datasets.load_digits(return_X_y=True)
    train_x, test_x, train_y, test_y = model_selection.train_test_split(
        x / 16, y, train_size=300, test_size=300, random_state=trial.seed)
    return 1 - svm.SVC(**trial.configuration).fit(train_x, train_y).score(test_x, test_y)


def formula(trial):
    """Shaped like an error that depends on these parameters, with some noise."""
    values = trial.configuration
    cost = {"rbf": 0.0, "poly": 0.1, "linear": 0.3}[values["kernel"]]
    cost += 0.02 * (math.log10(values["C"]) - 1) ** 2
    cost += 0.05 * (math.log10(values.get("gamma", 1)) + 1) ** 2
    return cost + 0.01 * (trial.seed % 100) / 100


def main():
    try:
        import sklearn  # noqa: F401
        function = model_error
    except ImportError:
        function = formula
        print("scikit-learn is not installed: a formula is tuned")
    store = sys.argv[1] if len(sys.argv) > 1 else None
    best = swarmsmith.tune(function, SPACE, initial=[DEFAULTS], max_experiments=300, seed=1, digits=5, store=store)
    for one in best:
        print(f"{one['cost']:.4f}  {one['configuration']}")


if __name__ == "__main__":
    main()
