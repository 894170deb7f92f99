"""Every command of the program's own help, with words that lead it into a store."""
import os
import re

from programs import call

# Commands that want more than a store: {store}, {file}, {folder}, {new} are replaced.
ARGUMENTS = {
    "run": [["{file}", "--store", "{store}", "--no-dashboard", "--workers", "1"]],
    "init": [["{new}"]],
    "check": [["{file}"]],
    "profile": [[], ["{store}"]],
    "serve": [["{file}", "--store", "{store}", "--bind", "{store}"]],
    "worker": [["--connect", "{store}"], ["--connect", "tcp://127.0.0.1:1", "--key", "{store}"],
               ["--slots", "{store}"]],
    "pause": [["{store}"], ["{store}", "d1"]],
    "cancel": [["{store}", "d1"]],
    "extend": [["{store}", "d1", "--budget", "5000"]],
    "keygen": [["{new}"]],
    "ls": [[what, "{store}"] for what in ("designs", "candidates", "evaluations", "elites",
                                          "workers", "events", "real-runs")],
    "show": [[what, "{store}"] for what in ("d1", "c1", "c8", "e800001", "r1")],
    "explain": [["e800001", "{store}"], ["e100001", "{store}"]],
    "query": [["{store}", "SELECT * FROM " + view] for view in
              ("v_campaign", "v_designs", "v_candidates", "v_workers", "v_events", "v_failures",
               "v_conflicts", "v_commands", "v_evaluations LIMIT 3", "failure")],
    "compare": [["{store}"], ["{store}", "--by", "method"]],
    "evaluate": [["best", "--store", "{store}", "--seeds", "1-2"], ["{store}"]],
    "assess": [["--flavour", "{store}"]],
    "replay": [["e800001", "{store}"]],
    "figure": [["scores", "{store}", "-o", "{new}.svg"], ["{store}", "{store}"]],
    "export": [["{store}"], ["{store}", "--format", "json"]],
    "import": [["{file}", "--into", "{store}"]],
    "report": [["{store}", "-o", "{new}.html"]],
    "supplement": [["{store}", "-o", "{new}"]],
    "dashboard": [["{store}", "--export", "{new}.html"], ["{store}", "--http", "{store}"]],
    "backup": [["{store}", "{new}.db"]],
    "merge": [["{store}", "{store}", "-o", "{new}.db"]],
    "recover": [["{store}", "-o", "{new}.db"]],
    "irace": [["--check"], ["--scenario", "{file}"], ["--{store}"]],
    "robot": [["replay", "{file}"], ["run", "--robot", "{new}", "--machine", "{file}"], ["{store}"],
              ["check", "--robots", "{store}"]],
    "track": [["check", "{file}"], ["{store}"], ["report", "r1", "{store}"]],
    "version": [[]],
}


def commands():
    """The first words of all that the program's help lists."""
    listed = re.findall(r"^  ([a-z]+(?: [a-z]+)?)  ", call("--help").stdout, re.MULTILINE)
    assert len(listed) > 25, listed
    return listed


def invocations(store, file, folder, forms=((), ("--json",))):
    """Every command with all its words, as bytes. New files are made in the folder."""
    number = 0
    for command in commands():
        for words in ARGUMENTS.get(command, [["{store}"]]):
            number += 1
            names = {"{store}": os.fsencode(store), "{file}": os.fsencode(file),
                     "{new}": os.fsencode(folder / f"new{number}")}
            filled = [os.fsencode(word) for word in words]
            for key, name in names.items():
                filled = [word.replace(key.encode(), name) for word in filled]
            for form in forms:
                yield [*command.split(), *filled, *form]
