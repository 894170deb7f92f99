"""Command lines worked out from the tests of R's irace, with the end that each must come to.

Each row names the file of `tests/testthat` in irace's repository that it follows: the facts are
theirs, the files and words are ours. What is only reachable within R has the row of its nearest
equivalent here, or none: ablation's and psRace's inner functions, getConfigurationById,
irace2pyimp, multi_irace's lists of scenarios (the same by several folders), instances that are
objects of R, and path_rel2abs for Windows. A row whose answer differs from R on purpose says so.
"""
import json
import unittest

from irace_lines import PARAMETERS, Table

TABLE = Table()
line = TABLE.add

# --- Spaces that several rows have ----------------------------------------------------------------

COLONY = """\
algorithm "--algorithm=" c (as, mmas, eas, ras, acs)
search    "--search="    c (0, 1, 2, 3)
alpha     "--alpha="     r (0, 5)
beta      "--beta="      r (0, 10)
rho       "--rho="       r (0.01, 1)
ants      "--ants="      i (5, 100)
q0        "--q0="        r (0, 1)   | algorithm == "acs"
rank      "--rank="      i (1, 100) | algorithm == "ras"
elite     "--elite="     i (1, 750) | algorithm == "eas"
near      "--near="      i (5, 50)  | search %in% c(1, 2, 3)
look      "--look="      c (0, 1)   | search %in% c(1, 2, 3)
"""


def colony_holds(v):
    return (("q0" in v) == (v["algorithm"] == "acs") and ("rank" in v) == (v["algorithm"] == "ras")
            and ("elite" in v) == (v["algorithm"] == "eas")
            and ("near" in v) == ("look" in v) == (v["search"] != 0)
            and 0.01 <= v["rho"] <= 1 and 5 <= v["ants"] <= 100)


# Some of a colony's bounds are other parameters.
DEPENDENT = """\
algorithm "--algorithm=" c (as, mmas, ras, eas)
search    "--search="    o (0, 1, 2, 3)
alpha     "--alpha="     r (0, 5)
beta      "--beta="      r (0, 10)
ants      "--ants="      i,log (5, 100)
rank      "--rank="      i (1, "min(ants, 10)") | algorithm == "ras"
elite     "--elite="     i (1, ants)            | algorithm == "eas"
inner     "--inner="     i (0, rank)
near      "--near="      i (5, 50)              | search %in% c("1", "2", "3")
[forbidden]
(alpha == 0) & (beta == 0)
"""


def dependent_holds(v):
    return (("rank" in v) == (v["algorithm"] == "ras") == ("inner" in v)
            and v.get("rank", 1) <= min(v["ants"], 10) and v.get("inner", 0) <= v.get("rank", 0)
            and v.get("elite", 1) <= v["ants"] and ("near" in v) == (v["search"] > 0)
            and not (v["alpha"] == 0 and v["beta"] == 0))


# The space of readconfs, forbidden and bug-44's neighbours.
MODES = """\
one      "--one="      i (1, 10) | mode %in% c("x1", "x2")
two      "--two="      i (1, 10) | mode %in% c("x1", "x3") & real > 2.5 & real <= 3.5
mode     "--mode="     c ("x1", "x2", "x3")
real     "--real="     r (1.5, 4.5)
mutation "--mutation=" o (none, "very low", low, high, all)
"""
FORBIDDEN = """\
one < 5 & mode == "x1"
(two > 6 & mode == "x1") | (two <= 6 & mode == "x3")
real < 4 & mode %in% c("x2", "x3")
"""
FIRST = """\
one two mode real mutation
5   NA  x2   4.0  low
1   NA  x2   4.0  low
1   3   x1   3.0  low
5   6   x1   3.5  low
5   7   x1   3.5  low
NA  NA  x3   4.5  low
NA  6   x3   3.5  low
"""


def modes_hold(v):
    one, two, mode, real = v.get("one", 99), v.get("two"), v["mode"], v["real"]
    return not ((one < 5 and mode == "x1") or (two is not None and two > 6 and mode == "x1")
                or (two is not None and two <= 6 and mode == "x3") or (real < 4 and mode in ("x2", "x3")))


# Costs and times between 1 and some 80, to the nearest whole number; within the bound, if there is one.
XY = 'x "--x=" r (0, 1)\ny "--y=" r (0, 1)\nreject "--reject=" c (0, 1)\n'
VALUE = """\
x=$(tenths $x 4); y=$(tenths $y 4)
a=$(( x - 3000 )); b=$(( y - 7000 ))
value=$(( 1 + (${a#-} + ${b#-}) / 200 + number % 4 ))
[ -z "$bound" ] || [ $value -le $bound ] || value=$bound
"""
TIMED = VALUE + "answer $value $value"
#: Times between 1 and 6, from the parameters and the seed.
TIME_SPACE = 'tmax "--tmax=" i (1, 50)\ntemp "--temp=" r (0, 10)\n'
TIME = "time=$(( 1 + tmax / 10 + seed % 2 ))\nanswer $time $time"


def at(first, *others):
    """A complaint names its place; what else must be said."""
    return (first, *others)


# --- test-argparser -------------------------------------------------------------------------------

line("argparser", "a value with a blank is one word", '--check -p "my parameters.txt"',
     says="Check successful", files={"my parameters.txt": PARAMETERS}, parameters=None)
line("argparser", "and so behind an equals sign", '--check "--parameter-file=my parameters.txt"',
     says="Check successful", files={"my parameters.txt": PARAMETERS}, parameters=None)
line("argparser", "an option at the end lacks its value", "--check -p", code=1, says=("-p|--parameter-file", "value"))
line("argparser", "words that are not options", "scenario.txt", code=1,
     says=("scenario.txt", "not an option", "follow their names"))
line("argparser", "a switch of a scenario's name", "--maxExperiments 100", code=1, says="--max-experiments")
line("argparser", "the last one wins", "--max-experiments 5 --max-experiments=97", budget=97)
line("argparser", "an empty value unsets the budget", "--max-experiments=", code=1,
     says=("--max-experiments", "--max-time", "budget"))
line("argparser", "half an experiment", "--max-experiments 100.5", code=1,
     says=("--max-experiments", "whole", "100.5"))
line("argparser", "fewer than none", "--max-experiments=-100", code=1, says=("--max-experiments", "-100"))
line("argparser", "a number in R's spelling", "--max-experiments 1e2", budget=100)
line("argparser", "no bool", "--elitist maybe", code=1, says=("--elitist", "0 or 1", "maybe"))
line("argparser", "R's bools", "--elitist FALSE --max-experiments 125", says="# Non-elitist race")
line("argparser", "short switches", "-s scenario.txt -p parameters.txt -l log.Rdata -e 1", says="log.db")
line("argparser", "confidence is a share", "--confidence 95", code=1, says=("--confidence", "0 to 1", "95"))

# --- test-bad_scenario (and good_scenario.txt) ----------------------------------------------------

line("bad_scenario", "a name that is not quite an option", code=1,
     says=at(r"scenario\.txt:1:1", "parametersFile", "parameterFile"), scenario='parametersFile = "parameters.txt"\n')
line("bad_scenario", "all unknown names at once", code=1, says=("parametersFile", "targetRuner", "targetRunner"),
     scenario='parametersFile = "p"\nmaxExperiments = 100\ntargetRuner = "t"\n')
line("bad_scenario", "the right name",
     scenario='parameterFile = "parameters.txt"\ntrainInstancesFile = "instances.txt"\nmaxExperiments = 100\n')
line("bad_scenario", "variables of one's own begin with a dot", budget=100,
     scenario='.n <- 50; maxExperiments <- 2 * .n\n.dir = "."\ntrainInstancesFile = file.path(.dir, "instances.txt")\n'
              'seed = 3L; trainInstancesDir = NULL # nothing\n')
line("bad_scenario", "others do not", code=1, says=at(r"scenario\.txt:1:1", "`n`", "dot"),
     scenario='n = 50\nmaxExperiments = 2 * n\n')
line("bad_scenario", "a scenario that is not there", "--scenario other.txt", code=1,
     says=("other.txt", "no such|not"))
line("bad_scenario", "text that is not R", code=1, says=at(r"scenario\.txt:2"),
     scenario='seed = 1\nmaxExperiments = = 5\n')
line("bad_scenario", "a value of the wrong kind", code=1, says=at(r"scenario\.txt:1:\d+", "maxExperiments", "many"),
     scenario='maxExperiments = "many"\n')

# --- test-bugs and test-targetRunnerParallel: functions of R are refused, with what to do ---------

line("bugs", "a function as targetRunner", code=1, says=at(r"scenario\.txt:1", "function", "program"),
     scenario='targetRunner = function(experiment, scenario) list(cost = 1)\n')
line("bugs", "a function's name as targetRunner", code=1, says=at("targetRunner", "target.runner.local", "program"),
     scenario={"targetRunner": "target.runner.local"})
line("bugs", "an ordinal's values are drawn from its own", budget=120, scenario={"maxExperiments": 120},
     parameters='x "--x=" o (a, b, c, d)\n', every=lambda v: v["x"] in "abcd")
line("bugs", "the last value of an ordinal is found (a defect in R)", budget=200, scenario={"maxExperiments": 200},
     parameters='x "--x=" o (a, b, c, d, e)\ny "--y=" r (0, 1)\n', runner="[ $x = e ] && answer 0 || answer 9",
     check=lambda ran: want(ran.best()[0][1]["x"] == "e"))
line("bugs", "a t-test on costs with an outlier drops no winner",
     scenario={"maxExperiments": 60, "testType": "t-test"}, parameters='p "--p=" c (1, 2, 3, 4, 5)\n',
     configurations="p\n1\n2\n3\n", budget=60, line="--configurations-file configurations.txt",
     runner="case $id in 1) answer 0.0$number ;; 2) answer 0.0${number}1 ;; "
            "3) [ $number = 8 ] && answer 1.15 || answer 0.0${number}2 ;; *) answer $id ;; esac",
     check=lambda ran: want(ran.best()[0][0] == 1))
line("targetRunnerParallel", "a function of R", code=1,
     says=at(r"scenario\.txt:1", "targetRunnerParallel", "parallel"),
     scenario='targetRunnerParallel = function(experiments, exec, scenario, runner) 1\n')
line("targetRunnerParallel", "one race of 40 runs", "--parallel 2", parameters='x1 "--x1=" r (0, 1)\n', budget=40,
     scenario='instances = c("a", "b", "c", "d", "e", "f", "g")\nmaxExperiments = 40\nnbIterations = 1\n'
              'minNbSurvival = 1\n',
     check=lambda ran: want({call.instance for call in ran.calls} <= set("abcdefg")))
line("targetRunnerParallel", "data for it mean nothing here", says="[Ww]arning: .*targetRunnerData",
     scenario='instances = c("a", "b")\nmaxExperiments = 42\ntargetRunnerData = list(a = 1, b = 2)\n',
     parameters='x "--x=" r (1, 2)\n', budget=42)
line("targetRunnerParallel", "one run less is too little", "--max-experiments 41", code=1,
     says=("--max-experiments", "41", r"\b42\b"), parameters='x "--x=" r (1, 2)\n')
line("targetRunnerParallel", "MPI", "--mpi 1", code=1, says=("--mpi|mpi", "parallel"))
line("targetRunnerParallel", "one at a time, and several", "--parallel 0 -l a.db",
     then=(("--parallel 4 -l b.db", 0, ()),), check=lambda ran: want(ran.best(0) == ran.best(1)))

# --- test-iteration-callback: a function of R; the runs that it watches ---------------------------

CALLBACK = {"maxExperiments": 100, "postselection": 0, "seed": 1234567}
line("iteration-callback", "a callback", code=1, says=at(r"scenario\.txt:1", "iterationCallback"),
     scenario='iterationCallback = "invalid"\n')
line("iteration-callback", "experiments used and left make the budget", budget=100, scenario=CALLBACK,
     parameters='x "--x=" i (1, 10)\n', runner="d=$(( x - number )); answer ${d#-}",
     check=lambda ran: same_sum(ran, 100))
line("iteration-callback", "a budget of time", budget=100,
     scenario={**CALLBACK, "maxExperiments": None, "maxTime": 100}, parameters='x "--x=" i (1, 10)\n',
     runner="d=$(( x - number )); answer ${d#-} 1", says=("# time budget: 100", "remaining time: \\d+"))

# --- test-badoutputraw: what the target printed is shown ------------------------------------------

for text, why in (("many", "`many`"), ("NA", "is NA"), ("1 2 3", "^  1 2 3"), ("5,3", "`5,3`"), ("1 two", "`two`"),
                  ("1 0", "time .* 0,"), ("1 -2", "time .* -2,"), ("1 Inf", "time .* infinite"), ("'a b'", "^  a b")):
    line("badoutputraw", f"the target prints {text}", code=1, runner=f"answer {text}",
         says=(r"target-runner \d ", "--mode=", why))
line("badoutputraw", "nothing on standard output", code=1, runner="echo 5 >&2",
     says=(r"target-runner \d ", "5", "standard"))
line("badoutputraw", "the exit status counts, whatever was printed", code=1, runner="answer 5; exit 7",
     says=(r"target-runner \d ", r"\b7\b"))
line("badoutputraw", "a signal", code=1, runner="kill -9 $$", says=(r"target-runner \d ", "9|KILL"))
line("badoutputraw", "lines of output among the costs", code=1, runner="echo begin; answer 5",
     says=(r"target-runner \d ", "begin"))
line("badoutputraw", "a cost and a time on two lines", budget=100, runner="answer $(( seed % 9 )); echo 1")
line("badoutputraw", "blanks around a number in R's spelling", budget=100, runner="printf '  0x1A \\n\\n'")
line("badoutputraw", "standard error is not read (R mixes it in)", budget=100,
     runner="echo careful >&2; answer $(( seed % 9 ))")
line("badoutputraw", "-Inf rejects", budget=100, runner="[ $x -gt 70 ] && answer -Inf || answer $x",
     check=lambda ran: want(all(len(calls) == 1 for calls in ran.runs_of().values() if calls[0].values["x"] > 70)))
line("badoutputraw", "nothing at all is rejected twice", code=1, runner="answer -inf", says="every configuration")
line("badoutputraw", "a runner that is not a program", code=1, says=("targetRunner|target-runner", "chmod"),
     files={"target-runner": "echo 5\n"})
line("badoutputraw", "a runner that is not there", "--target-runner ./other", code=1,
     says=("--target-runner", "other"))
line("badoutputraw", "a runner that is a folder", "--target-runner .", code=1, says=("--target-runner", "folder"))
line("badoutputraw", "a runner without its interpreter", code=1, says=("target-runner", "interpreter|start"),
     files={"target-runner": "#!/nowhere/sh\necho 5\n"})
line("badoutputraw", "--check shows the call and the output", "--check", code=1, runner="answer many",
     says=("target-runner 1 1 1234567 1 ", "many"))

# --- test-blocksize and test-bug-blocksize --------------------------------------------------------

FOUR = {"instances.txt": "ackley\ngold\nmatyas\nhimmel\n"}
BLOCKS = {"blockSize": 4, "boundMax": 80, "capping": 1, "testType": "t-test", "maxExperiments": 480}


def whole_blocks(size, instances):
    def check(ran):
        for calls in ran.runs_of().values():
            counts = [sum(call.number == str(number) for call in calls) for number in range(1, instances + 1)]
            want(len(calls) % size == 0, f"{len(calls)} runs are not blocks of {size}")
            if size == instances:
                want(len(set(counts)) == 1, f"instances {counts}")
    return check


line("blocksize", "a block that does not divide the instances", "--block-size 3", code=1,
     says=("--block-size", r"\b4\b", r"\b3\b"), scenario={**BLOCKS, "blockSize": None}, files=FOUR)
line("blocksize", "blocks with capping; mu is raised", scenario={**BLOCKS, "mu": 8}, parameters=XY, runner=TIMED,
     files=FOUR, says=r"Warning: mu is 20", budget=480, check=whole_blocks(4, 4))
line("blocksize", "mu within a block", "--mu 26", code=1, says=("--mu|mu", "blockSize"), scenario=BLOCKS,
     parameters=XY, runner=TIMED, files=FOUR)
line("blocksize", "the least budget counts blocks", "--max-experiments 10", code=1,
     says=("--max-experiments", r"\b384\b"), scenario=BLOCKS, files=FOUR, parameters=XY)
line("blocksize", "blocks with a budget of time", scenario={"maxExperiments": None, "maxTime": 1500, "blockSize": 3},
     files={"instances.txt": "a\nb\nc\n"}, parameters=TIME_SPACE, runner=TIME, check=whole_blocks(3, 3))
line("blocksize", "blocks with many new instances",
     scenario={"maxExperiments": None, "maxTime": 2500, "blockSize": 3, "elitistNewInstances": 6, "elitistLimit": 2},
     files={"instances.txt": "\n".join("abcdefghi") + "\n"}, parameters=TIME_SPACE, runner=TIME,
     check=whole_blocks(3, 9))
line("blocksize", "without elites", "--elitist 0 --max-experiments 520", files=FOUR, budget=520,
     scenario={"blockSize": 4, "firstTest": 2, "mu": 8}, check=whole_blocks(4, 4))
line("blocksize", "no block", "--block-size 0", code=1, says=("--block-size|blockSize", "1 or more"))
line("blocksize", "no first test", "--first-test 0", code=1, says=("--first-test|firstTest", "1 or more"))
line("blocksize", "never a test", "--each-test 0", code=1, says=("--each-test|eachTest", "1 or more"))
line("blocksize", "a first test between tests", "--each-test 2", code=1,
     says=("firstTest|--first-test", "eachTest|--each-test", "multiple"))
line("blocksize", "a block bigger than the list", "--block-size 20", code=1,
     says=("--block-size", r"\b10\b", r"\b20\b"))
line("bug-blocksize", "five instances, tests after 25 runs, in their order", parameters=COLONY, budget=420,
     files={"instances.txt": "1\n2\n3\n4\n5\n"}, every=colony_holds,
     scenario={"firstTest": 25, "eachTest": 5, "sampleInstances": 0, "maxExperiments": 420, "nbIterations": 2, "minNbSurvival": 2,
               "elitistNewInstances": 1, "parallel": 1},
     check=lambda ran: want([call.number for call in ran.calls if call.id == 1][:25] == list("12345" * 5)))
line("bug-blocksize", "one run less is too little", "--max-experiments 1499", code=1, says=r"\b1500\b",
     parameters=COLONY, files={"instances.txt": "1\n2\n3\n4\n5\n"},
     scenario={"firstTest": 25, "eachTest": 5, "sampleInstances": 0})

# --- test-bug-10, 13, no-elite: deterministic, without elites, all costs equal --------------------

NO_ELITE = {"deterministic": 1, "elitist": 0, "elitistNewInstances": 0, "elitistLimit": 0}


def once_each(ran):
    for calls in ran.runs_of().values():
        want(len({call.number for call in calls}) == len(calls) <= 10, "an instance twice")


line("bug-10", "equal costs, no elites, no limit", parameters=COLONY, runner="answer 100", budget=600,
     scenario={**NO_ELITE, "maxExperiments": 600}, every=colony_holds, check=once_each)
line("bug-10", "the least budget without elites", "--max-experiments 299", code=1,
     says=("--max-experiments", r"\b300\b"), scenario=NO_ELITE, parameters=COLONY)
line("bug-10", "just enough", "--max-experiments 300", scenario=NO_ELITE, parameters=COLONY, budget=300,
     runner="answer 100", check=once_each)
line("bug-10", "a first test beyond the instances", "--first-test 11", code=1,
     says=("deterministic", r"\b11\b", r"\b10\b", "firstTest"), scenario={**NO_ELITE, "maxExperiments": 900})
line("bug-10", "postselection without elites", "--postselection 1 --max-experiments 400",
     says="[Ww]arning: .*postselection", scenario=NO_ELITE, runner="answer 100")
line("bug-13", "instances without files, digits in the scenario", parameters=COLONY,
     runner="answer $(( ${rank:-7} + id % 3 ))",
     scenario={"instances": None, "trainInstancesDir": "", "deterministic": 1, "elitist": 0, "seed": 2357,
               "digits": 3, "debugLevel": 3, "maxExperiments": 600}, budget=600,
     says="[Ww]arning: .*digits.*\\[global\\]",
     files={"instances.txt": "".join(f"2000-{n}.tsp\n" for n in range(121, 131))},
     check=lambda ran: (once_each(ran), want({c.instance for c in ran.calls} <= {f"2000-{n}.tsp" for n in range(121, 131)}),
                        want(all(len(str(c.values["alpha"]).split(".")[1]) <= 3 for c in ran.calls))))
line("bug-no-elite", "equal costs with elites", "--elitist 1 --deterministic 1 --max-experiments 300",
     parameters=COLONY, runner="answer 100", check=once_each, budget=300)
line("bug-no-elite", "none is ever dropped by equal costs", "--max-experiments 200", runner="answer 100",
     budget=200, check=lambda ran: want(len(ran.best()) == 3))

# --- test-bug-44: digits --------------------------------------------------------------------------

line("bug-44", "two digits", "--check", says="Check successful",
     parameters='a "--a=" r (0.01, 0.99)\n[global]\ndigits = 2\n', every=lambda v: round(v["a"], 2) == v["a"])
line("bug-44", "one digit", "--check", says="Check successful",
     parameters='a "--a=" r (0, 1)\n[global]\ndigits = 1\n', every=lambda v: round(v["a"], 1) == v["a"])
line("bug-44", "one digit is too few", code=1, says=at(r"parameters\.txt:1", r"\ba\b", r"0\.01", "digits", r"\b2\b"),
     parameters='a "--a=" r (0.01, 0.99)\n[global]\ndigits = 1\n')
line("bug-44", "four are too few", code=1, says=at(r"parameters\.txt:1", r"\ba\b", "digits", r"\b8\b"),
     parameters='a "--a=" r,log (1e-8, 1)\n[global]\ndigits = 4\n')
line("bug-44", "with digits of irace 3.5 bounds are rounded", "--check --digits 1",
     says=("[Ww]arning: .*0\\.126.*0\\.1", "Check successful"), parameters='a "--a=" r (0.126, 1)\n')
for digits in ("0", "16", "x"):
    line("bug-44", f"digits = {digits}", code=1, says=at(r"parameters\.txt:3", "digits", "15"),
         parameters=f'a "--a=" r (0, 1)\n[global]\ndigits = {digits}\n')

# --- test-bug-55 ----------------------------------------------------------------------------------

FOO = 'foo "--foo=" i (0, 1)\nbar "--bar=" c (true, false) | foo == 0\nx "--x=" r (0, 1)\n'
line("bug-55", "row names and <NA>", "--check", parameters=FOO, scenario={"configurationsFile": "configurations.txt"},
     configurations="  foo  bar  x\n1   0 false  0\n2   1  <NA>  1\n",
     check=lambda ran: want([call.words for call in ran.calls[:2]] == ["--foo=0 --bar=false --x=0", "--foo=1 --x=1"]))
line("bug-55", "true and false are words", "--configurations-file configurations.txt", parameters=FOO,
     configurations="foo bar x\n0 true 0.5\n1 NA 0.5\n", every=lambda v: v.get("bar", "true") in ("true", "false"),
     budget=100)
line("bug-55", "the wrong case is not a value", "--configurations-file configurations.txt", parameters=FOO, code=1,
     configurations="foo bar x\n0 TRUE 0.5\n", says=at(r"configurations\.txt:2", "bar", "TRUE"))

# --- test-bug-87, 90, 94, test-bug1col, test-bug71 ------------------------------------------------

line("bug-87", "one instance, dependent domains, an ordinal", parameters=DEPENDENT, budget=300,
     scenario={"maxExperiments": 300}, files={"instances.txt": "1\n"}, every=dependent_holds,
     runner="answer $(( $(tenths $alpha 2) * $(tenths $beta 2) ))")
SIX = "".join(f'{n} "--{n}=" {d}\n' for n, d in (("a", "c (1, 2, 3, 4)"), ("b", "c (0, 1, 2, 3)"), ("c", "r (0, 1)"),
                                                   ("d", "r (0, 1)"), ("e", "r (0, 1)"), ("f", "i (1, 10)")))
line("bug-90", "no elites, just enough", "--elitist 0 --max-experiments 200", parameters=SIX, budget=200,
     runner="answer $(( $(tenths $c 3) * $(tenths $d 3) * $(tenths $e 3) ))",
     check=lambda ran: want(len(ran.best()) <= 4))
line("bug-90", "no elites, one run less", "--elitist 0 --max-experiments 199", parameters=SIX, code=1,
     says=r"\b200\b")
line("bug-94", "an ordinal is there whenever it is active", "--max-experiments 400", budget=400,
     parameters='use "--use=" c (0, 1)\nlevel "--level=" o (a, b, c) | use == "1"\nx "--x=" r (0, 1)\n',
     every=lambda v: (v["use"] == 1) == (v.get("level", "") in ("a", "b", "c")))
TWENTY = 'c_1 "--c_1=" c (' + ", ".join(map(str, range(1, 21))) + ")\n"
ONE_RACE = {"nbIterations": 1, "minNbSurvival": 1, "elitistLimit": 0, "postselection": 0, "testType": "F-test",
            "maxExperiments": 200}
line("bug1col", "a table of one column", "--configurations-file configurations.txt", parameters=TWENTY, budget=200,
     configurations="c_1\n" + "".join(f"{n}\n" for n in range(1, 21)), scenario=ONE_RACE,
     runner="answer $(( seed % 97 + id ))",
     check=lambda ran: (want(ran.best()[0][0] <= 20), want({c.values["c_1"] for c in ran.calls} == set(range(1, 21)))))
line("bug1col", "with quotes", "--check --configurations-file configurations.txt", parameters=TWENTY,
     configurations='"c_1"\n"7"\n', check=lambda ran: want(ran.calls[0].words == "--c_1=7"))
line("bug71", "--check begins with the given configuration", "--check", runner="answer 3",
     parameters='algorithm "--algorithm=" c (as, mmas, eas, ras, acs)\n', configurations="algorithm\nacs\n",
     scenario={"configurationsFile": "configurations.txt"},
     check=lambda ran: (want(ran.calls[0].words == "--algorithm=acs"), want(len(ran.calls) == 3),
                        want({c.seed for c in ran.calls} == {1234567})))
line("bug71", "a table as an object of R", code=1,
     says=at(r"scenario\.txt:1", "initConfigurations|data.frame", "configurationsFile|file"),
     scenario='initConfigurations = data.frame(algorithm = "as")\n')

# --- test-capping ---------------------------------------------------------------------------------

CAPPED = {"capping": 1, "boundMax": 80, "testType": "t-test", "maxExperiments": 300}


def bounded(limit):
    """With bounds the fifth word is one."""
    return lambda ran: want(all(0 < float(call.words.split()[0]) <= limit for call in ran.calls))


line("capping", "a budget of runs", scenario=CAPPED, parameters=XY, runner=TIMED, files=FOUR, budget=300,
     says=("# capping: median", r"\|   Bound\|"), check=bounded(80))
line("capping", "a budget of time lowers the bound", scenario={**CAPPED, "maxExperiments": None, "maxTime": 1000},
     parameters=XY, runner=TIMED, files=FOUR, says=r"[Ww]arning: .*boundMax", check=bounded(80))
line("capping", "some are rejected", scenario={**CAPPED, "maxExperiments": None, "maxTime": 1000, "boundMax": 5},
     parameters=XY,
     runner=VALUE + "[ $reject = 1 ] && [ $(( seed % 29 )) = 0 ] && answer -Inf 80 || answer $value $value",
     files=FOUR)
for kind in ("mean", "worst", "best"):
    line("capping", f"cappingType {kind}", f"--capping-type {kind} --bound-type instance", scenario=CAPPED,
         parameters=XY, runner=TIMED, files=FOUR, budget=300, says=f"# capping: {kind}", check=bounded(80))
line("capping", "only after the first test, and PAR10",
     "--capping-after-first-test 1 --bound-par 10 --bound-as-timeout 0", scenario={**CAPPED, "boundMax": 30},
     parameters=XY, runner=TIMED, files=FOUR, budget=300, check=bounded(30))
line("capping", "bounds with decimals", "--bound-digits 2", scenario=CAPPED, parameters=XY, files=FOUR, budget=300,
     runner="bound=${bound%%.*}\n" + TIMED, check=bounded(80))
line("capping", "without a bound", "--capping 1", code=1, says=("--capping", "boundMax"))
line("capping", "without elites", "--elitist 0", code=1, says=("capping", "elitist"), scenario=CAPPED)
line("capping", "a type that is none", "--capping-type middle", code=1, says=("--capping-type", "median", "middle"),
     scenario=CAPPED)
line("capping", "a bound of no type", "--bound-type run", code=1, says=("--bound-type", "candidate", "instance"),
     scenario=CAPPED)
line("capping", "PAR0", "--bound-par 0", code=1, says=("--bound-par|boundPar", "1 or more"), scenario=CAPPED)
line("capping", "the call must have the bound", "--target-cmdline '{seed} {instance} {targetRunnerArgs}'", code=1,
     says=("--target-cmdline", "{bound}"), scenario=CAPPED)
line("capping", "a target that says no time", code=1, scenario=CAPPED, parameters=XY, runner="answer 5",
     says=("time", "target-runner|configuration"))
line("capping", "a target that does not stop", code=1, scenario={**CAPPED, "boundMax": 10}, parameters=XY,
     runner="answer 5 99", says=(r"c\d on pair 1", r"\b99\b", r"\b10\b", r"target-runner \d "))

# --- test-dependencies ----------------------------------------------------------------------------

for text, what, says in (
        ('p1 "" r (0, 1)\np2 "" r (p3, 1)', "a bound of an unknown name", at(r":2:10", "p3")),
        ('p1 "" c (0, 1)\np2 "" r (1, p1)', "a bound that is not a number", at(r":2:", "p2", "p1", "numeric|number")),
        ('p1 "" r (0, 1)\np2 "" r (1, foobar(p1))', "a function that is not known", at(r":2:", "foobar")),
        ('p1 "" r (0, p3)\np2 "" r (1, p1)\np3 "" r (p2, 1)', "a circle of three", at(r":[123]:", "depends on itself|circle")),
        ('p1 "" r (0, 1)\np2 "" i (0.1, p1)', "an integer's bound with decimals", at(r":2:", "p2", "whole|integer")),
        ('p1 "" r (1, 2)\np2 "" r,log (1, p1)', "a logarithm with a bound that depends", at(r":2:", "p2", "log"))):
    line("dependencies", what, code=1, says=("parameters" + says[0].replace(r":", r"\.txt:", 1), *says[1:]),
         parameters=text + "\n")
INACTIVE = 'p1 "--p1=" r (0, 1)\np2 "--p2=" r (0, p1) | p1 < 0.5\np3 "--p3=" r (0, p2)\n[global]\ndigits = 2\n'
line("dependencies", "inactive bounds make inactive parameters", parameters=INACTIVE, budget=100,
     every=lambda v: ("p2" in v) == ("p3" in v) == (v["p1"] < 0.5) and v.get("p3", 0) <= v.get("p2", 0) <= v["p1"])
line("dependencies", "a value above its bound", "--configurations-file configurations.txt", code=1,
     parameters=INACTIVE, configurations="p1 p2 p3\n0.4 0.4 0.4\n0.4 0.5 0.4\n",
     says=at(r"configurations\.txt:3", "p2", r"0\.5", r"0\.4"))
line("dependencies", "a value above a bound's bound", "--configurations-file configurations.txt", code=1,
     parameters=INACTIVE, configurations="p1 p2 p3\n0.4 0.3 0.2\n0.4 0.3 0.4\n",
     says=at(r"configurations\.txt:3", "p3", r"0\.4", r"0\.3"))
line("dependencies", "values on their bounds", "--check --configurations-file configurations.txt",
     parameters=INACTIVE, configurations="p1 p2 p3\n0.4 0.3 0.2\n0.5 NA NA\n0.4 0.4 0.4\n",
     check=lambda ran: want(ran.calls[1].words == "--p1=0.5"))
DEPENDS = """\
one      "--one="      i (1, "real")
two      "--two="      i ("real", 10)
mode     "--mode="     c (x1, x2, x3)
real     "--real="     r (1.5, 7.5)
"""
DEPENDS_TOO = """\
one      "--one="      i (1, "real")  | mode %in% c("x1", "x2")
two      "--two="      i ("real", 10) | mode %in% c("x1", "x3") & real > 2.5 & real <= 3.5
mode     "--mode="     c (x1, x2, x3)
real     "--real="     r (1.5, 7.5)
"""
line("dependencies", "bounds above and below", parameters=DEPENDS, scenario={"maxExperiments": 200}, budget=200,
     runner="answer $(( one + two ))",
     every=lambda v: 1 <= v["one"] <= v["real"] and int(v["real"]) <= v["two"] <= 10)
line("dependencies", "with conditions", parameters=DEPENDS_TOO, scenario={"maxExperiments": 200}, budget=200,
     every=lambda v: (("one" in v) == (v["mode"] != "x3") and v.get("one", 1) <= v["real"]
                      and ("two" in v) == (v["mode"] != "x2" and 2.5 < v["real"] <= 3.5)
                      and v.get("two", 10) >= int(v["real"])))
line("dependencies", "a bound that passes the other one", code=1, budget=0,
     parameters='a "--a=" i (1, 10)\nb "--b=" i (5, a)\n', says=("\\bb\\b", "5"))

# --- test-forbidden -------------------------------------------------------------------------------

LOGS = MODES.replace("i (1, 10) | mode %in% c(\"x1\", \"x2\")", "i,log (1, 10) | mode %in% c(\"x1\", \"x2\")").replace(
    "r (1.5", "r,log (1.5")
for name, space in (("forbidden", MODES), ("forbidden, logarithms", LOGS)):
    line("forbidden", f"{name}: dropped from the first configurations", "--configurations-file configurations.txt",
         parameters=space + "[forbidden]\n" + FORBIDDEN, configurations=FIRST, scenario={"maxExperiments": 250},
         budget=250, every=modes_hold, says="[Ww]arning: .*forbidden",
         check=lambda ran: want({c.id for c in ran.calls} & {1, 2, 3, 4, 5, 6, 7} == {1, 2, 4, 6}))
line("forbidden", "the file of irace 3.5", "--forbidden-file forbidden.txt", parameters=MODES, every=modes_hold,
     files={"forbidden.txt": "# comment\n" + FORBIDDEN}, scenario={"maxExperiments": 250}, budget=250,
     says="[Ww]arning: .*forbidden.*\\[forbidden\\]")
line("forbidden", "everything", code=1, parameters='a "--a=" i (1, 5)\n[forbidden]\na < 10\n',
     says="forbidden")
line("forbidden", "nearly everything", parameters='a "--a=" i (1, 100)\nb "--b=" r (0, 1)\n[forbidden]\na > 40\n',
     budget=100, every=lambda v: v["a"] <= 40)
line("forbidden", "doubled operators are read as single ones", budget=100, says="[Ww]arning: .*&&",
     parameters='a "--a=" i (1, 4)\nb "--b=" i (1, 4)\n[forbidden]\na > 2 && b > 2\n',
     every=lambda v: not (v["a"] > 2 and v["b"] > 2))
line("forbidden", "expressions in R's scenario", code=1, says=at(r"scenario\.txt:1", "forbiddenExps", "forbidden"),
     scenario='forbiddenExps = expression(a == 1)\n')
line("forbidden", "no comparison", code=1, says=at(r"parameters\.txt:3"),
     parameters='a "--a=" i (1, 4)\n[forbidden]\na >\n')
line("forbidden", "a constant forbids everything or nothing", code=1, says=at(r"parameters\.txt:3"),
     parameters='a "--a=" i (1, 4)\n[forbidden]\nTRUE\n')
line("forbidden", "a misspelt value forbids nothing, as in R", budget=100,
     parameters='a "--a=" c (x, y)\nb "--b=" r (0, 1)\n[forbidden]\na == "z"\n')
line("forbidden", "--check does not try what is forbidden", "--check --configurations-file configurations.txt",
     parameters='a "--a=" i (1, 9)\nb "--b=" r (0, 1)\n[forbidden]\na < 3\n', configurations="a b\n1 0.5\n7 0.5\n",
     says=("Warning: initial configuration 1 is forbidden", "Check successful"), every=lambda v: v["a"] >= 3,
     check=lambda ran: want(ran.calls[0].words == "--a=7 --b=0.5"))
line("forbidden", "all first configurations", "--configurations-file configurations.txt", budget=100,
     parameters='a "--a=" i (1, 9)\nb "--b=" r (0, 1)\n[forbidden]\na < 3\n', configurations="a b\n1 0.5\n2 0.5\n",
     says="[Ww]arning: .*forbidden", every=lambda v: v["a"] >= 3)

# --- test-GenericWrapper4AC -----------------------------------------------------------------------

WRAPPED = 'cost "cost" r (0.1, 1)\nruntime "runtime" r (0.1, 1)\n'
WRAPPER = """\
#!/bin/sh
echo "0 0 0 0 $*" >> '{folder}/calls.txt'
for word; do
  case $last in --instance) instance=$word ;; --seed) seed=$word ;; --cutoff) cutoff=$word ;;
    -cost) cost=$word ;; -runtime) runtime=$word ;; esac
  last=$word
done
STATUS
[ -z "$cutoff" ] || { cost=0.1; runtime=0.1; }
echo 'Result of this algorithm run: {"status": "'$status'", "cost": '$cost', "runtime": '$runtime'}'
"""


def wrapper(status):
    return {"target-runner": WRAPPER.replace("STATUS", status), "instances.txt": "time\ncost\ncost+time\n"}


ACLIB = {"aclib": 1}
line("GenericWrapper4AC", "SUCCESS", scenario=ACLIB, parameters=WRAPPED, files=wrapper("status=SUCCESS"), budget=0,
     check=lambda ran: want(all(" --config -cost 0." in call.words or "-cost" in call.words for call in ran.calls)))
line("GenericWrapper4AC", "TIMEOUT is a cost, too", scenario=ACLIB, parameters=WRAPPED,
     files=wrapper("status=TIMEOUT"))
line("GenericWrapper4AC", "CRASHED", scenario=ACLIB, parameters=WRAPPED, files=wrapper("status=CRASHED"), code=1,
     says=("CRASHED", "target-runner --instance"))
line("GenericWrapper4AC", "ABORT", scenario=ACLIB, parameters=WRAPPED, files=wrapper("status=ABORT"), code=1,
     says=("ABORT", "target-runner --instance"))
line("GenericWrapper4AC", "a status that is none", scenario=ACLIB, parameters=WRAPPED, files=wrapper("status=FINE"),
     code=1, says=("FINE", "target-runner --instance"))
line("GenericWrapper4AC", "a cutoff with bounds", parameters=WRAPPED, files=wrapper("status=SUCCESS"),
     scenario={"aclib": 1, "maxExperiments": None, "maxTime": 40, "boundMax": 1, "capping": 1, "boundDigits": 1},
     check=lambda ran: want(all("--cutoff" in " ".join(line.split()[4:]) for line in ran.lines_of("calls.txt"))))
line("GenericWrapper4AC", "no line with a result", scenario=ACLIB, parameters=WRAPPED, code=1,
     files={"target-runner": "#!/bin/sh\necho 5\n"},
     says=("Result of this algorithm run", "target-runner --instance"))
line("GenericWrapper4AC", "--check calls it so", "--check", scenario=ACLIB, parameters=WRAPPED,
     files=wrapper("status=SUCCESS"),
     says=(r"target-runner --instance time --seed 1234567 --config -cost 0\.", "Check successful"))

# --- test-maxTime ---------------------------------------------------------------------------------


def time_is_used(budget):
    return lambda ran: want(0.6 * budget <= sum(ran.times) <= 1.1 * budget, f"time used: {sum(ran.times)} of {budget}")


for budget in (500, 1111):
    line("maxTime", f"{budget} of time", f"--max-time {budget}", scenario={"maxExperiments": None, "seed": 1234567},
         parameters=TIME_SPACE, runner=TIME, check=time_is_used(budget), says=f"# time budget: {budget}")
line("maxTime", "both budgets", "--max-time 500", code=1, says=("--max-time|maxTime", "maxExperiments"))
line("maxTime", "without elites", "--max-time 500 --elitist 0 --max-experiments 0", code=1,
     says=("maxTime|--max-time", "elitist"))
line("maxTime", "a target without times", "--max-time 500 --max-experiments 0", code=1, runner="answer 5",
     says=("time", "target"))
line("maxTime", "too little time for any race", "--max-time 5 --max-experiments 0", code=1, parameters=TIME_SPACE,
     runner=TIME, says=("maxTime", "give more time"))
line("maxTime", "so little that it takes fewer iterations", "--max-time 260 --max-experiments 0",
     parameters=TIME_SPACE, runner=TIME, says="Warning: .*number of iterations: there are")
line("maxTime", "an estimate of everything", "--max-time 500 --max-experiments 0 --budget-estimation 1", code=1,
     says="--budget-estimation|budgetEstimation")
line("maxTime", "half the time", "--max-time 500.5 --max-experiments 0", code=1, says=("--max-time", "500.5"))

# --- test-mlr: two parameters, one race, 30 runs --------------------------------------------------

line("mlr", "one race of 30 runs", "--max-experiments 30 --iterations 1 --min-survival 1", budget=30,
     parameters='cp "--cp=" r (0.1, 1)\nminsplit "--minsplit=" i (1, 10)\n', files={"instances.txt": "1\n"})
line("mlr", "eleven are too few", "--max-experiments 11 --iterations 1 --min-survival 1", code=1, says=r"\b12\b")
line("mlr", "twelve do", "--max-experiments 12 --iterations 1 --min-survival 1", budget=12)
line("mlr", "a budget of its own size", "--max-experiments= --min-experiments 1 --iterations 1 --min-survival 1",
     check=lambda ran: want(len(ran.calls) <= 12))

# --- test-multi_irace: several folders instead of lists of scenarios ------------------------------

line("multi_irace", "three runs in their own folders", "--exec-dir run_01 --seed 42",
     then=(("--exec-dir run_02 --seed 43 -p two.txt", 0, ()), ("--exec-dir run_03 --seed 42", 0, ())),
     files={"run_01/a": "", "run_02/a": "", "run_03/a": "", "two.txt": 'x "--x=" r (0, 10)\nz "--z=" r (0, 10)\n'},
     check=lambda ran: (want(ran.best(0) == ran.best(2)), want(ran.best(0) != ran.best(1)),
                        want(all((ran.folder / f"run_0{n}/irace.db").exists() for n in (1, 2, 3)))))
line("multi_irace", "a log file elsewhere", "--exec-dir work --log-file {folder}/logs/irace.Rdata",
     files={"work/a": "", "logs/a": ""}, says="logs/irace.db",
     check=lambda ran: want((ran.folder / "logs/irace.db").exists()))
line("multi_irace", "a folder that is not there", "--exec-dir run_09", code=1, says=("--exec-dir", "run_09"))
line("multi_irace", "a log file in no folder", "--log-file logs/irace.Rdata", code=1, says=("--log-file", "logs"))
line("multi_irace", "in turn and in parallel", "--parallel 1 -l a.Rdata", then=(("--parallel 2 -l b.Rdata", 0, ()),),
     check=lambda ran: want(ran.best(0) == ran.best(1)))
line("multi_irace", "one store, two scenarios", "", then=(("--seed 43", 1, ("seed", "--log-file")),))

# --- test-path ------------------------------------------------------------------------------------

PATHS = {"a/b/c": "", "leslie/own": ""}
for words, cwd in (("-s ../../scenario.txt", "a/b"), ("-s ../b/../../scenario.txt", "a/b"), ("-s ./././scenario.txt", "."),
                   ("-s ./a/../scenario.txt", "."), ("-s leslie//../scenario.txt", "."), ("-s {folder}/./scenario.txt", "a/b"),
                   ("-s {folder}/leslie/../scenario.txt", "a")):
    line("path", f"{words} in {cwd}", "--check " + words, cwd=cwd, files=PATHS,
         says="Check successful", scenario={"parameterFile": "parameters.txt", "targetRunner": "./target-runner"})
line("path", "the home folder on the command line", "--check --scenario=~/scenario.txt", cwd="a/b", files=PATHS,
     home=True, scenario={"parameterFile": "parameters.txt", "targetRunner": "./target-runner"},
     says="Check successful")
line("path", "the home folder in a scenario", "--check -s ../scenario.txt", cwd="a", files=PATHS, home=True,
     scenario={"parameterFile": "~/a/../parameters.txt", "targetRunner": "~/target-runner",
               "trainInstancesFile": "~/instances.txt", "execDir": "~"}, says="Check successful")
line("path", "~ within a path is a name", "--check", files={"~/list.txt": "1\n2\n", "a/~/b": ""}, home=True,
     scenario={"trainInstancesFile": "{folder}/~/list.txt"}, says="Check successful")
line("path", "names that begin with dots", "--check -s .scenario -p ..parameters",
     files={".scenario": 'trainInstancesFile = "instances.txt"\nmaxExperiments = 100\n', "..parameters": PARAMETERS},
     parameters=None, says="Check successful")
line("path", "a link to a folder", "--check -s c/scenario.txt", parameters=None,
     files={"d/scenario.txt": 'parameterFile = "parameters.txt"\ntrainInstancesFile = "../instances.txt"\nmaxExperiments = 100\n',
            "d/parameters.txt": PARAMETERS, "c": "link:d"}, says="Check successful")
line("path", "a program by PATH", "--target-runner my-runner", path="bin", budget=100,
     files={"target-runner": "#!/bin/sh\nexit 9\n", "bin/my-runner": "#!/bin/sh\necho \"$*\" >> '{folder}/calls.txt'\necho 5\n"})
line("path", "instances get their folder", "--check --train-instances-dir ../sets", cwd="a", files=PATHS,
     scenario={"parameterFile": "parameters.txt", "targetRunner": "./target-runner"},
     then=(("--check -s ../scenario.txt --train-instances-dir ../sets/", 0, ()),), code=1,
     says="scenario|parameters|instances",
     check=lambda ran: want(ran.calls[0].instance == f"{ran.folder}/sets/1", ran.calls[0].instance))
line("path", "the target runs in execDir", "--exec-dir a/b -l ../log.Rdata", files=PATHS,
     runner="[ -f c ] && answer 5", budget=100, check=lambda ran: want((ran.folder / "a/log.db").exists()))
line("path", "blanks in all of it", "-s 'my folder/scenario.txt'", budget=100,
     files={"my folder/scenario.txt": 'parameterFile = "p p.txt"\ntrainInstancesFile = "i i.txt"\nexecDir = "."\nseed = 1\n'
                                       'targetRunner = "./t t"\nmaxExperiments = 100\nlogFile = "l l.Rdata"\n',
            "my folder/p p.txt": PARAMETERS, "my folder/i i.txt": "1\n2\n",
            "my folder/t t": "#!/bin/sh\necho \"$*\" >> '{folder}/calls.txt'\necho 5\n"},
     check=lambda ran: want((ran.folder / "my folder/l l.db").exists()))

# --- test-psrace, test-psrace-nothing-to-run ------------------------------------------------------

line("psrace", "a last race of 101 runs", "--max-experiments 300", then=(
    ("--max-experiments 300 --psrace --psrace-max-experiments 101", 0, ("configuration \\d+ of the run",)),),
     check=lambda ran: want(310 <= len(ran.calls) <= 401))
line("psrace", "of those that are named", "",
     then=(("--psrace --psrace-max-experiments 60 --psrace-ids 1,2", 0, ()),),
     check=lambda ran: want(len(ran.best()) >= 1))
line("psrace", "of a run that never was", "--psrace --psrace-max-experiments 60 -l other.Rdata", code=1,
     says="other.db")
line("psrace-nothing-to-run", "deterministic, and all seen", "--max-experiments 200",
     scenario={"deterministic": 1, "postselection": 0, "seed": 1234, "parallel": 1},
     parameters='a "--a=" i (1, 10)\nb "--b=" i (1, 10)\n', files={"instances.txt": "1\n2\n3\n4\n5\n"},
     runner="answer $(( a * number + b ))", budget=200)
line("psrace-nothing-to-run", "post-selection with next to nothing left", "--max-experiments 200",
     scenario={"deterministic": 1, "seed": 1234}, parameters='a "--a=" i (1, 10)\nb "--b=" i (1, 10)\n',
     files={"instances.txt": "1\n2\n3\n4\n5\n"}, runner="answer $(( a * number + b ))", budget=200, check=once_each)

# --- test-raceconfs -------------------------------------------------------------------------------

METHODS = 'launch "--launch=" c (L-BFGS-B, SLSQP)\nvisit "--visit=" c (DA, DE)\nglobal "--global=" c (CMAES, DE)\n'
EIGHT = "launch visit global\n" + "".join(f"{a} {b} {c}\n" for c in ("CMAES", "DE") for b in ("DA", "DE")
                                           for a in ("L-BFGS-B", "SLSQP"))
RACE = {"nbConfigurations": 8, "maxExperiments": 96, "configurationsFile": "configurations.txt", "logFile": ""}
line("raceconfs", "all eight, all equal", scenario=RACE, parameters=METHODS, configurations=EIGHT,
     runner="answer 100", budget=0, check=lambda ran: (want(len(ran.calls) <= 96), want(len(ran.best()) <= 3)))
line("raceconfs", "one run less", "--max-experiments 95", code=1, says=r"\b96\b", scenario=RACE, parameters=METHODS,
     configurations=EIGHT)
line("raceconfs", "no more than survive", "--num-configurations 3", code=1,
     says=("--num-configurations", r"\b3\b", "minNbSurvival"))
line("raceconfs", "more than the budget is good for", "--num-configurations 500", code=1,
     says=("nbConfigurations|--num-configurations", r"\b500\b", r"\b12\b"))
line("raceconfs", "a race of five", "--num-configurations 5 --max-experiments 300", budget=0,
     check=lambda ran: want(len(ran.calls) <= 300))

# --- test-readParameters --------------------------------------------------------------------------

for text, what, says in (
        ('rest "--rest=" r,log (0.00001, 0.9)\n[global]\ndigits = 4', "bounds need more digits", (":1:", "rest", r"\b5\b")),
        ('temp "" r (0, 10)\nt-max "" i (1, 50)', "a name with a dash", (":2:", "t-max|-max")),
        ('temp "" r (0, 10)\n[forbidden]\ntmp == 0', "a forbidden name that is none", (":3:", "tmp", "temp")),
        ('temp "" r (0, 10)\ntemp "" i (1, 50)', "a name twice", (":2:", "temp", "twice|already|before")),
        ('temp "" c (a, b, a)', "a value twice", (":1:", "temp", "\\ba\\b")),
        ('temp --temp i (0, 10)', "a switch without quotes", (":1:", "quotes")),
        ('temp "--temp" i,lag (0, 10)', "a type that is none", (":1:", "i,lag", "i,log")),
        ('temp "--temp" x (0, 10)', "another type that is none", (":1:", "type", "\\bx\\b")),
        ('temp "--temp" i c(0, 10)', "a word before the domain", (":1:", "parenthes")),
        ('param "--param " c "a,b,c"', "a domain without parentheses", (":1:", "parenthes")),
        ('param "--param " i (1,2,3 )', "three bounds", (":1:", "two|lower and upper|bounds")),
        ('param "--param " i (1)', "one bound", (":1:", "two|lower and upper|bounds")),
        ('param "--param " i ( 1,10) |', "a bar without a condition", (":1:", "condition")),
        ('param "--param " i ( 1, 10) param < 3', "a condition without a bar", (":1:", r"\|")),
        ('a "" i (0,2)\nb "" r (0,1) | a <> 1', "an operator that is none", (":2:", ">")),
        ('a "" i (0,2)\nb "" r (0,2) | a < b', "a condition on itself", (":2:", r"\bb\b", "itself")),
        ('a "" i (0,2)\nb "" r (0,b)', "a domain of itself", (":2:", r"\bb\b", "itself")),
        ('a "" i (0,2)\nb "" r (0,2) | a < zz', "a condition on an unknown name", (":2:", "zz")),
        ('a "" i (1.1,2.0)', "an integer with decimals", (":1:", r"\ba\b", r"1\.1")),
        ('a "" r (0.01, 0.001)', "bounds the wrong way round", (":1:", r"\ba\b", "lower|below|smaller|less")),
        ('a "" i (1, 1)', "bounds that are equal", (":1:", r"\ba\b", "lower|below|smaller|less")),
        ('#\n\n#', "no parameter at all", ("parameter",)),
        ('a "" o (0, 2, 1)', "an ordinal out of order", (":1:", r"\ba\b", "order|increas")),
        ('a "" r,log (0, 100)', "a logarithm of nothing", (":1:", r"\ba\b", "log|above 0|positive")),
        ('a "" i,log (-1, 100)', "a logarithm of less", (":1:", r"\ba\b", "log|above 0|positive")),
        ('a "" r,log (0.0001, 0.99999)\n[global]\ndigits = 3', "the digits of the finer bound", (":1:", r"\b5\b")),
        ('a "" c (x, y) | 0', "a condition that is a number", (":1:", "condition")),
        ('a "" i (1, 2)\n[globl]\ndigits = 3', "a section that is none", (":2:", "globl", "global")),
        ('a "" i (1, 2)\n[global]\ndigit = 3', "an option that is none", (":3:", "digit", "digits"))):
    line("readParameters", what, code=1, parameters=text + "\n",
         says=(r"parameters\.txt" + says[0] if says[0].startswith(":") else says[0], *says[1:]))
for what, text in (("sections in this order", "[global]\ndigits = 5\n[forbidden]\na == 0\n"),
                   ("sections in that order", "[forbidden]\na == 0\n[global]\ndigits = 5\n"),
                   ("sections with empty lines", "\n[forbidden]\n\na == 0\n\n[global]\n\ndigits = 5\n\n")):
    line("readParameters", what, "--check", parameters='a "--a=" r (0.00001, 1)\n' + text, says="Check successful",
         every=lambda v: v["a"] > 0)
line("readParameters", "bounds in quotes and as sums", "--check", says="Check successful",
     parameters='a "--a=" r ("-1", "10")\nb "--b=" i (-1, 2*5)\nc "--c=" i ("-1", a)\n',
     every=lambda v: -1 <= v["a"] <= 10 and -1 <= v["b"] <= 10 and -1 <= v["c"] <= v["a"])
line("readParameters", "doubled operators in a condition are read (R refuses them)", budget=100,
     says="[Ww]arning: .*&&",
     parameters='a "--a=" i (0, 2)\nb "--b=" i (0, 2)\nd "--d=" c (x, y) | a == 0 && b == 2\n',
     every=lambda v: ("d" in v) == (v["a"] == 0 and v["b"] == 2))
line("readParameters", "conditions on fixed parameters", budget=200, scenario={"maxExperiments": 200},
     parameters='root "--root=" c (S)\nkind "--kind=" c (F) | root %in% c("S")\nsum "--sum=" r (-50, 50) | kind %in% c("F")\n'
                'on "--on=" c (true) | kind == "F"\nmove "--move=" c (A, B) | root == "S" & on == "true"\n'
                'less "--less=" c (false) | sum < 0\nmore "--more=" i (0, 100) | less == "false"\n',
     every=lambda v: v["kind"] == "F" and v["on"] == "true" and "move" in v and ("more" in v) == ("less" in v) == (v["sum"] < 0))
line("readParameters", "a parameter file that is not there", "-p none.txt", code=1,
     says=("-p: ", "none.txt", "no such file"))

# --- test-read_pcs_file ---------------------------------------------------------------------------

PCS = """\
# name domain
algorithm {as,mmas,eas,ras,acs}[as]
search {0, 1, 2, 3}[0]
alpha [0.00, 5.00][1]
rho [0.01, 1.00][0.95]l
ants [1, 100][10]il
q0 [0.0, 1.0][0]
rank [1, 100][1]i
look {0, 1}[1]
Conditionals:
q0 | algorithm in {acs}
rank | algorithm in {ras}
look | search in {1,2,3}
"""
line("read_pcs_file", "is read, and printed as ours", "--check -p space.pcs --max-experiments 300",
     files={"space.pcs": PCS}, runner="answer 1",
     says=(r"^algorithm .*c \(as, ?mmas, ?eas, ?ras, ?acs\)", r"^rho .*r,log \(0\.01, ?1\)", r"^ants .*i,log \(1, ?100\)",
           r"^q0 .*algorithm (%in% c\(\"acs\"\)|== \"acs\")", "^look .*search %in%"))
line("read_pcs_file", "is raced, its defaults first", "-p space.pcs --max-experiments 300",
     files={"space.pcs": PCS}, runner="answer 1",
     check=lambda ran: want({c.words for c in ran.calls if c.id == 1} == {"-algorithm as -search 0 -alpha 1 -rho 0.95 -ants 10"}))
line("read_pcs_file", "with names for aclib", "--check -p space.pcs --aclib 1 --max-experiments 300",
     files={"space.pcs": PCS, **wrapper("status=SUCCESS; cost=1; runtime=1")},
     says=r"--config -algorithm as -search 0")
line("read_pcs_file", "a default outside", "-p space.pcs", code=1, files={"space.pcs": "a [1, 5][9]i\n"},
     says=at(r"space\.pcs:1", r"\ba\b", r"\b9\b"))
line("read_pcs_file", "a condition on an unknown name", "-p space.pcs", code=1,
     files={"space.pcs": "a [1, 5][2]i\nConditionals:\na | b in {x}\n"}, says=at(r"space\.pcs:3", r"\bb\b"))

# --- test-readconfs -------------------------------------------------------------------------------

HEAD = "one two mode real mutation\n"
for text, what, says in (
        (HEAD + '5 NA "x2" 4.0 "low"\n1 NA "x2" 4.0 "low"\n5 NA "x2" 4.0 "low"\nNA NA "x3" 4.5 "low"\n', "a row twice",
         (r":4", r":2|\b1\b")),
        (HEAD + "5 NA x2 4.0 low\n1 NA x2 4.0 low\n5 NA x2 4.0 low\n1 NA x2 4.0 low\n", "two rows twice", (r":[45]",)),
        (HEAD + "5 NA x2 4.0 low\n1 NA x2 4.0 low\n11 NA x2 4.0 low\n", "a value above", (":4", "one", r"\b11\b", r"\b10\b")),
        (HEAD + "5 NA x2 4.0 low\n0 NA x2 4.0 low\n", "a value below", (":3", "one", r"\b0\b", r"\b1\b")),
        (HEAD + "5 NA x2 4.0 low\n1 NA x2 4.5001 low\n", "a value just above", (":3", "real", r"4\.5001", r"4\.5\b")),
        (HEAD + "5 NA x2 4.0 low\n1.1 NA x2 4.5 low\n", "an integer with decimals", (":3", "one", r"1\.1", "whole|integer")),
        (HEAD + "5 NA x2 4.0 low\n1 NA x2 4.5 lower\n", "a value that is none", (":3", "mutation", "lower", "low")),
        (HEAD + "5 NA x3 4.0 low\n1 NA x2 4.5 low\n", "a value where none may be", (":2", "one")),
        (HEAD + "NA NA x2 4.0 low\n", "no value where one must be", (":2", "one", "NA|missing|active")),
        ("one zero mode real mutation\n5 NA x2 4.0 low\n", "a column that is none", (":1", "zero")),
        ("one mode real mutation\n5 x2 4.0 low\n1 x2 4.0 low\n", "a column that is missing", (":1", "two")),
        ("one two mode real mutation three\n5 NA x2 4.0 low NA\n", "a column too many", (":1", "three")),
        (HEAD + "5 NA x2 4.0\n", "a field too few", (":2",)),
        (HEAD + "5 NA x2 four low\n", "a word for a number", (":2", "real", "four"))):
    line("readconfs", what, "--configurations-file configurations.txt", code=1, parameters=MODES, configurations=text,
         says=(r"configurations\.txt" + says[0], *says[1:]))
line("readconfs", "a file that is not there", "--configurations-file none.txt", code=1,
     says=("--configurations-file", "none.txt"))
line("readconfs", "columns in another order, quoted",
     "--check --max-experiments 200 --configurations-file configurations.txt", parameters=MODES,
     configurations="real mutation 'mode' two one # names\n3.0 'very low' \"x1\" 2 5 # one\n",
     check=lambda ran: want(ran.calls[0].words == "--one=5 --two=2 --mode=x1 --real=3 --mutation=very low", ran.calls[0].words))
line("readconfs", "only a header is not a configuration",
     "--configurations-file configurations.txt --max-experiments 200", parameters=MODES, configurations=HEAD,
     budget=200)

# --- test-recovery, and test-targeteval's ---------------------------------------------------------

line("recovery", "the same command goes on", "", code=1, scenario={"maxExperiments": 200, "parallel": 1},
     runner="[ $(wc -l < calls.txt) -eq 100 ] && exit 3\nanswer $(( seed % 50 + x ))",
     says=("the same command", "target-runner"), then=(("", 0, ("Continuing after \\d+ experiments",)),
           ("-l whole.Rdata", 0, ())), check=lambda ran: want(ran.best(1) == ran.best(2)))
line("recovery", "of a budget of time", "", code=1,
     scenario={"maxExperiments": None, "maxTime": 500, "parallel": 1}, parameters=TIME_SPACE,
     runner="[ $(wc -l < calls.txt) -eq 100 ] && exit 3\n" + TIME, says="the same command",
     then=(("", 0, ("Continuing after",)), ("-l whole.Rdata", 0, ())),
     check=lambda ran: want(ran.best(1) == ran.best(2)))
line("recovery", "of a deterministic target", "", code=1,
     scenario={"deterministic": 1, "maxExperiments": 200, "parallel": 1},
     runner="[ $(wc -l < calls.txt) -eq 60 ] && exit 3\nanswer $(( number + x ))", says="the same command",
     then=(("", 0, ("Continuing after",)), ("-l whole.Rdata", 0, ())),
     check=lambda ran: want(ran.best(1) == ran.best(2)))
line("recovery", "a file to recover from is refused: the store is it", "--recovery-file irace.Rdata", code=1,
     says=("--recovery-file|recoveryFile", "same command"))
line("recovery", "and so in a scenario", code=1, says=at(r"scenario\.txt:1", "recoveryFile", "same command"),
     scenario='recoveryFile = "irace.Rdata"\n')
line("recovery", "an empty one is none", "--recovery-file=", budget=100)
line("recovery", "retries of the target", "--target-runner-retries 2", scenario={"parallel": 1}, budget=0,
     runner="case $(wc -l < calls.txt) in 20|21) exit 3 ;; esac; answer 5",
     check=lambda ran: want(len(ran.calls) == len({(c.id, c.seed) for c in ran.calls}) + 2))
line("recovery", "too few retries", "--target-runner-retries 1", scenario={"parallel": 1}, code=1,
     runner="case $(wc -l < calls.txt) in 20|21) exit 3 ;; esac; answer 5", says=("target-runner", r"\b3\b"))

EVALUATED = {"targetEvaluator": "./target-evaluator"}
EVALUATOR = {"target-evaluator": "#!/bin/sh\necho \"$*\" >> '{folder}/evaluations.txt'\necho $(( ($3 + $1 * 7) % 101 ))\n"}
ALGORITHM = 'algorithm "--algorithm=" c (as, mmas, eas, ras, acs)\n'


def evaluated(ran):
    """id instance seed instance count ids: the configuration is among them."""
    for text in ran.lines_of("evaluations.txt"):
        words = text.split()
        want(len(words) == 5 + int(words[4]) and words[0] in words[5:], text)


line("targeteval", "costs come from the evaluator", "--max-experiments 200", scenario=EVALUATED, parameters=ALGORITHM,
     files=EVALUATOR, runner=":", budget=200, check=evaluated)
line("targeteval", "and the runner gives times",
     scenario={**EVALUATED, "maxExperiments": None, "maxTime": 2000, "boundMax": 10}, parameters=ALGORITHM,
     files=EVALUATOR, runner="time=$(( 1 + seed % 10 )); [ $time -le $bound ] || time=$bound; echo $time",
     check=evaluated, says="# capping: ")
line("targeteval", "goes on where it stopped", "", code=1,
     scenario={**EVALUATED, "parallel": 1, "maxExperiments": 200}, parameters=ALGORITHM, files=EVALUATOR,
     runner="[ $(wc -l < calls.txt) -eq 58 ] && exit 3; :", says="the same command",
     then=(("", 0, ("Continuing after",)), ("-l whole.Rdata", 0, ())),
     check=lambda ran: want(ran.best(1) == ran.best(2)))
line("targeteval", "a runner that gives a cost beside it", code=1, scenario=EVALUATED, files=EVALUATOR,
     runner="answer 1 2", says=("target-runner", "1 2"))
line("targeteval", "an evaluator without a cost", code=1, scenario=EVALUATED, runner=":",
     files={"target-evaluator": "#!/bin/sh\necho none\n"}, says=("target-evaluator", "none"))
line("targeteval", "an evaluator that fails", code=1, scenario=EVALUATED, runner=":",
     files={"target-evaluator": "#!/bin/sh\necho 5\nexit 4\n"}, says=("target-evaluator", r"\b4\b"))
line("targeteval", "an evaluator that is not there", code=1, scenario=EVALUATED, runner=":",
     says=at(r"targetEvaluator|target-evaluator", "no such"))
line("targeteval", "--check calls both", "--check", scenario=EVALUATED, files=EVALUATOR, runner=":",
     says=("target-evaluator 1 1 1234567 1 2 1 2", "Check successful"))
line("targeteval", "a batch system needs it", "--batchmode slurm", code=1, says=("batchmode", "targetEvaluator"))
line("targeteval", "a batch system that is none", "--batchmode cloud", code=1, says=("--batchmode", "slurm", "cloud"))

# --- test-repair: a program in place of R's function ----------------------------------------------

THREE = 'p1 "--p1=" r (0, 1)\np2 "--p2=" r (0, 1)\np3 "--p3=" r (0, 1)\ndummy "--dummy=" c (d1, d2)\n'
REPAIR = {"repairConfiguration": "./repair", "maxExperiments": 180, "seed": 1234567}
FIELDS = "#!/bin/sh\nexec awk 'NR == 1 { for (i = 1; i <= NF; i++) { n = $i; gsub(/\"/, \"\", n); at[n] = i } }\nNR == 2 { "
SUM = FIELDS + ("s = $at[\"p1\"] + $at[\"p2\"] + $at[\"p3\"]; a = sprintf(\"%.4f\", $at[\"p2\"] / s); "
                "b = sprintf(\"%.4f\", $at[\"p3\"] / s); $at[\"p2\"] = a; $at[\"p3\"] = b; "
                "$at[\"p1\"] = sprintf(\"%.4f\", 1 - a - b) }\n{ print }'\n")
ORDER = FIELDS + ("for (k = 0; k < 2; k++) for (i = 1; i < 3; i++) if ($at[\"p\" i] + 0 > $at[\"p\" (i + 1)] + 0) "
                  "{ t = $at[\"p\" i]; $at[\"p\" i] = $at[\"p\" (i + 1)]; $at[\"p\" (i + 1)] = t } }\n{ print }'\n")
line("repair", "a sum of one", scenario=REPAIR, parameters=THREE, files={"repair": SUM}, budget=180,
     runner="answer $(( 10000 - $(tenths $p1 4) ))", every=lambda v: abs(v["p1"] + v["p2"] + v["p3"] - 1) < 1e-9)
line("repair", "in increasing order", scenario=REPAIR, parameters=THREE, files={"repair": ORDER}, budget=180,
     runner="answer $(( 10000 - $(tenths $p1 4) ))", every=lambda v: v["p1"] <= v["p2"] <= v["p3"])
line("repair", "--check repairs, too", "--check", scenario=REPAIR, parameters=THREE, files={"repair": ORDER},
     every=lambda v: v["p1"] <= v["p2"] <= v["p3"])
line("repair", "out of the space", scenario=REPAIR, parameters=THREE, code=1, says=("repair", "p1", "7"),
     files={"repair": FIELDS + "$at[\"p1\"] = 7 }\n{ print }'\n"})
line("repair", "by a program that fails", scenario=REPAIR, parameters=THREE, code=1, says=("repair", r"\b6\b"),
     files={"repair": "#!/bin/sh\nexit 6\n"})
line("repair", "by a program that prints nothing", scenario=REPAIR, parameters=THREE, code=1, says="repair",
     files={"repair": "#!/bin/sh\ncat > /dev/null\n"})
line("repair", "by a function of R", code=1, says=at(r"scenario\.txt:1", "function"),
     scenario='repairConfiguration = function(configuration, parameters) configuration\n')

# --- test-sann-irace, test-similar ----------------------------------------------------------------

SANN = 'tmax "--tmax=" i (1, 5000)\ntemp "--temp=" r (0, 100)\n'
SANN_COST = "answer $(( tmax / 100 + seed % 37 ))"
line("sann-irace", "two at a time", "--parallel 2", parameters=SANN, runner=SANN_COST, budget=400,
     scenario={"maxExperiments": 400, "seed": 1234567}, check=lambda ran: want(ran.best()[0][1]["tmax"] < 2000))
line("sann-irace", "some runs reject", "--parallel 2", parameters=SANN, budget=400,
     scenario={"maxExperiments": 400, "seed": 1234567},
     runner="[ $(( (seed + id * 7919) % 41 )) = 0 ] && answer -Inf || " + SANN_COST,
     check=lambda ran: want(not ({i for i, _ in ran.best()} & {int(w.split()[0]) for w in ran.lines_of("answers.txt") if "Inf" in w})))
line("sann-irace", "deterministic on seven instances", "--deterministic 1", parameters=SANN, budget=0,
     scenario={"maxExperiments": 400}, files={"instances.txt": "1\n2\n3\n4\n5\n6\n7\n"},
     runner="answer $(( tmax / 100 + number ))", check=once_each)
line("sann-irace", "logarithms", parameters='tmax "--tmax=" i,log (1, 5000)\ntemp "--temp=" r,log (0.01, 100)\n',
     budget=400, scenario={"maxExperiments": 400}, runner=SANN_COST,
     every=lambda v: 1 <= v["tmax"] <= 5000 and 0.01 <= v["temp"] <= 100)
line("sann-irace", "a logarithm from 0", parameters='temp "--temp=" r,log (0, 100)\n', code=1,
     says=at(r"parameters\.txt:1", "temp"))
LIKE = 'c1 "--c1=" c (a, b)\nc2 "--c2=" c (a, b)\nc3 "--c3=" c (a, b)\n'
line("similar", "alike configurations restart the model", "--max-experiments 200", parameters=LIKE,
     says="Soft restart", budget=0)
line("similar", "unless it is switched off", "--max-experiments 200 --soft-restart 0", parameters=LIKE, budget=0,
     check=lambda ran: want("Soft restart" not in ran.out))
line("similar", "numbers that are apart", "--max-experiments 200 --soft-restart-threshold 0", budget=0,
     parameters='x "--x=" r (0, 1)\ny "--y=" r (0, 1)\n[global]\ndigits = 10\n',
     check=lambda ran: want("Soft restart" not in ran.out))
line("similar", "all numbers are alike", "--max-experiments 200 --soft-restart-threshold 1", budget=0,
     parameters='x "--x=" r (0, 1)\ny "--y=" r (0, 1)\n', says="Soft restart")
line("similar", "a threshold above all", "--soft-restart-threshold 2", code=1,
     says=("--soft-restart-threshold", "0 to 1"))
for name in ("friedman", "T.none", "t.holm", "T-TEST-BONFERRONI"):
    line("similar", f"the test by its other name, {name}", f"--test-type {name}", budget=100)
line("similar", "a test that is none", "--test-type u-test", code=1, says=("--test-type", "F-test", "u-test"))

# --- test-sobol -----------------------------------------------------------------------------------

MANY = "".join(f'p{i} "--p{i}=" r (0, 1)\n' for i in range(1, 1201))
SOBOL = {"maxExperiments": 100, "nbIterations": 2, "minNbSurvival": 1, "postselection": 0, "logFile": ""}
CHEAP = {"target-runner": "#!/bin/sh\necho \"$*\" >> '{folder}/calls.txt'\necho $(( $3 % 100 ))\n"}
line("sobol", "1,025 parameters are still Sobol's", scenario=SOBOL, parameters="".join(MANY.splitlines(True)[:1025]),
     files=CHEAP, budget=100, every=lambda v: len(v) == 1025 and all(0 <= x <= 1 for x in v.values()),
     check=lambda ran: want("uniform" not in ran.err))
line("sobol", "1,200 are drawn uniformly, and it says so", scenario=SOBOL, parameters=MANY, files=CHEAP, budget=100,
     every=lambda v: len(v) == 1200, says="[Ww]arning: .*uniform")
line("sobol", "conditions on dependent domains", parameters=DEPENDENT, every=dependent_holds, budget=0,
     scenario={"maxExperiments": 1000, "nbIterations": 1, "minNbSurvival": 1, "postselection": 0},
     runner="answer $(( seed % 9 ))", check=lambda ran: want(len(ran.runs_of()) > 100))
FIXED = ('root "--root=" c (S)\nmake "--make=" c (Fast, Slow) | root %in% c("S")\n'
         'fast "--fast=" r (-50, 50) | make %in% c("Fast")\nslow "--slow=" i (-10, 10) | make %in% c("Slow")\n'
         'improve "--improve=" c (Flip) | root %in% c("S")\non "--on=" c (true, false) | improve %in% c("Flip")\n'
         'sleepy "--sleepy=" c ("8", "6", "12", "11", "7", "5") | improve %in% c("Flip")\n')
for what, space in (("a fixed root", FIXED), ("a root of two", FIXED.replace("c (S)", "c (S, T)"))):
    line("sobol", f"{what} and its conditions", parameters=space, scenario={"maxExperiments": 200}, budget=200,
         every=lambda v: (("make" in v) == (v["root"] == "S") == ("improve" in v) == ("on" in v) == ("sleepy" in v)
                          and ("fast" in v) == (v.get("make") == "Fast") and ("slow" in v) == (v.get("make") == "Slow")))
line("sobol", "names of R's own variables",
     parameters='n "--n=" i (1, 9)\nnames "--names=" r (0, 1)\nif "--if=" c (a, b) | n > 4\n', budget=100,
     every=lambda v: ("if" in v) == (v["n"] > 4))
line("sobol", "a space smaller than a race", parameters='a "--a=" c (x, y)\n', code=1,
     says=("only 2 different configurations", "minNbSurvival"))
line("sobol", "where one survives it is none", "--min-survival 1", parameters='a "--a=" c (x, y)\n', budget=0,
     check=lambda ran: want(10 <= len(ran.calls) <= 100))
line("sobol", "nothing to tune", parameters='a "--a=" c (x)\n', code=1, says=("parameter",), budget=0)

# --- test-target-runner-dummy ---------------------------------------------------------------------

DUMMY = 'p_int "--p_int=" i (1, 10)\np_real "--p_real=" r (1, 10)\n'
DUMMY_LINE = ("--debug-level 3 --parallel 2 --scenario= --parameter-file=dummy.txt --train-instances-dir= "
              "--train-instances-file=one.txt --target-runner={folder}/target-runner ")
ONE = {"one.txt": "1\n"}
line("target-runner-dummy", "--check", DUMMY_LINE + "--check --max-experiments 500",
     files={**ONE, "dummy.txt": DUMMY}, runner="answer $p_int", says=("Check successful", "500"))
line("target-runner-dummy", "--max-time", DUMMY_LINE + "--max-time 1500 --seed 5",
     files={**ONE, "dummy.txt": DUMMY + 'time "--time=" c (1)\n'}, runner="answer $p_int $(( p_int + seed % 3 ))",
     every=lambda v: v["time"] == 1, check=time_is_used(1500))
line("target-runner-dummy", "--capping", DUMMY_LINE + "--max-time 200 --bound-max 3 --capping 1 --seed 5",
     runner="t=$(( 1 + p_int / 4 )); [ $t -le $bound ] || t=$bound; answer $t $t",
     files={**ONE, "dummy.txt": DUMMY + 'time "--time=" c (1)\n'}, says="[Ww]arning: .*boundMax.*")
line("target-runner-dummy", "test instances, too",
     DUMMY_LINE + "--max-experiments 100 --seed 5 --test-instances-file one.txt --test-num-elites 2",
     files={**ONE, "dummy.txt": DUMMY}, runner="answer $p_int",
     check=lambda ran: want({c.id for c in ran.calls if c.number == "1t"} == {i for i, _ in ran.best()[:2]}))
line("target-runner-dummy", "only testing", DUMMY_LINE + "--test-instances-file one.txt --only-test two.txt",
     runner="answer $p_int", files={**ONE, "dummy.txt": DUMMY, "two.txt": "p_int p_real\n3 1.5\n9 2\n"},
     says="Testing results", check=lambda ran: want([c.number for c in ran.calls] == ["1t", "1t"]))
line("target-runner-dummy", "no list of instances", "--scenario= -p dummy.txt --max-experiments 100", code=1,
     files={"dummy.txt": DUMMY}, says="--train-instances-file|trainInstancesFile")
line("target-runner-dummy", "an empty list", "--train-instances-file empty.txt", code=1,
     files={"empty.txt": "# none\n\n"}, says=("--train-instances-file", "empty.txt"))

# --- test-ablation, test-ablation-cmdline ---------------------------------------------------------

line("ablation-cmdline", "help", "ablation --help", says="--ablation")
line("ablation-cmdline", "a log that is not there", "ablation --log-file other.Rdata", code=1, says="other")
line("ablation", "after a budget of runs", "--configurations-file configurations.txt --max-experiments 200",
     parameters='cat "--cat=" c (0, 1, 2, 3, 4)\nreal "--real=" r (0, 1)\nint "--int=" i (100, 500)\nbool "--bool=" c (0, 1)\n',
     configurations="cat real int bool\n4 1.0 500 1\n",
     runner="k=$(( 100 + 900 * bool )); answer $(( k * (int + cat) + number ))",
     then=(("ablation --configurations-file configurations.txt --max-experiments 200", 0, ("# Step 1",)),
           ("ablation --configurations-file configurations.txt --max-experiments 200 --ablation-source 1 --ablation-target 2", 0, ())))

for what, options, bound in (("a budget of time", "--max-time 1500", ""),
                             ("capping", "--max-time 1500 --bound-max 15 --capping 1", "[ $v -le $bound ] || v=$bound\n")):
    line("ablation", f"after {what}", options, scenario={"maxExperiments": None},
         runner=f"v=$(( a + b ))\n{bound}answer $v $v", parameters='a "--a=" i (1, 10)\nb "--b=" i (1, 10)\n',
         then=((f"ablation {options}", 0, ("# Step 1", "Final best configuration")),))


# --- What runs it ---------------------------------------------------------------------------------

def want(true, why="the check of this row does not hold"):
    assert true, why


def same_sum(ran, budget):
    used = [int(text.split()[-1]) for text in ran.out.splitlines() if text.startswith("# experimentsUsed: ")]
    left = [int(text.split()[-1]) for text in ran.out.splitlines() if text.startswith("# remainingBudget: ")]
    want(used and all(a + b == budget for a, b in zip(used, left)), f"{used} and {left}")


class Lines(unittest.TestCase):
    """A test a row; its name is the file of irace's tests and the row's place in the table."""


def test_of(number, row):
    def test(self):
        wrong = TABLE.result(number)
        if wrong:
            self.fail(f"{row.of}: {row.what}: swarmsmith irace {row.lines[0][0]}\n{wrong}")
    test.__doc__ = f"{row.of}: {row.what}"
    return test


for number_, row_ in enumerate(TABLE.rows):
    setattr(Lines, f"test_{row_.of.replace('-', '_')}_{number_:03}", test_of(number_, row_))


def load_tests(_, tests, __):
    """All of them: the rows begin to run before the first one is asked for."""
    TABLE.begin_all()
    return tests


if __name__ == "__main__":
    unittest.main()
