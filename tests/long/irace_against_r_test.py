"""Random cases of irace's rules, ours against R itself: base R, and Debian's irace, which is 3.5 in Debian 12 and 4.2 in 13.

They differ in places (docs/irace.md); what both have is compared with the version that is here. SEED and CASES in the environment change which cases, and how many of each kind.
"""
import math
import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = pathlib.Path(os.environ["SWARMSMITH_BIN"]) / "irace_rules"
SEED = int(os.environ.get("SEED", "1"))
CASES = int(os.environ.get("CASES", "600"))


def r_is_there():
    if shutil.which("Rscript") is None:
        return False
    return subprocess.run(["Rscript", "-e", 'v <- packageVersion("irace"); quit(status = !(v >= "3.5" && v < "5"))'],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def words(*values):
    # In hexadecimal: R reads some decimal texts as the neighbour of the nearest number (0.4141735).
    return " ".join("NA" if value is None else value.hex() if isinstance(value, float) else str(value)
                    for value in values)


def matrix(rng, n, k):
    """Costs of many kinds: reals, few values, all equal in a row, one column better, huge scales."""
    kind = rng.randrange(6)
    shift = [rng.choice([0.0, 0.0, rng.uniform(0, 2)]) for _ in range(k)]
    rows = []
    for _ in range(n):
        scale = 10.0 ** rng.randint(-3, 5) if kind == 1 else 1.0
        if kind == 2:
            rows.append([float(rng.randint(0, 3)) for _ in range(k)])
        elif kind == 3:
            rows.append([float(rng.randint(0, 1))] * k if rng.random() < 0.5 else
                        [float(rng.randint(0, 9)) for _ in range(k)])
        elif kind == 4:
            rows.append([round(rng.gauss(s, 1), 1) for s in shift])
        else:
            rows.append([scale * (rng.gauss(s, 1) + 5) for s in shift])
    return [round(cost, 6) for row in rows for cost in row]


def eliminate(rng):
    kind = rng.choice(["f", "f", "none", "bonferroni", "holm"])
    k = rng.choice([2, 2, 3, 4, 7, 15])
    n = rng.choice([2, 5, 6, 8, 12, 25, 60])
    return words("eliminate", kind, rng.choice([0.95, 0.99, 0.8]), n, k, *matrix(rng, n, k))


def agreement(rng):
    n, k = rng.randint(1, 12), rng.randint(1, 9)
    return words("agreement", n, k, *matrix(rng, n, k))


def overall(rng):
    n, k = rng.randint(2, 9), rng.randint(2, 8)
    costs = matrix(rng, n, k)
    # Each configuration has seen the first pairs, or some at random; all the first one.
    for j in range(k):
        seen = rng.randint(1, n)
        for i in range(1, n):
            if i >= seen and rng.random() < 0.9:
                costs[i * k + j] = None
    return words("overall", rng.choice(["f", "none"]), n, k, *costs)


def size(rng):
    elites = rng.randint(0, 9)
    return words("size", rng.randint(10, 100_000), rng.randint(1, 12), rng.randint(1, 20), rng.randint(1, 4), elites,
                 rng.randint(0, 80) if elites else 0, rng.randint(0, 4) if elites else 0)


def minimum(rng):
    return words("minimum", rng.randint(0, 1), rng.randint(1, 12), rng.randint(1, 12), rng.randint(1, 20),
                 rng.randint(1, 5), rng.randint(0, 4))


def update(rng):
    k = rng.randint(2, 9)
    weights = [rng.random() + 0.01 for _ in range(k)]
    iterations = rng.randint(2, 12)
    return words("update", rng.randint(0, 1), rng.randint(2, iterations), iterations, rng.randint(1, 150),
                 rng.randint(1, k), k, *(weight / sum(weights) for weight in weights))


def draws(rng):
    kind = rng.choice(["o", "i", "i,log", "r", "r,log"])
    lower = rng.randint(1, 4)
    upper = lower + rng.randint(1, 10)
    value = round(rng.uniform(lower, upper), 3) if kind[0] == "r" else rng.randint(lower, upper)
    return words("draws", kind, lower, upper, value, rng.choice([1.0, 0.7, 0.3, 0.05]), 20_000,
                 rng.randint(1, 1_000_000))


def rank(rng):
    n = rng.randint(1, 30)
    return words("rank", n, *(rng.choice([rng.randint(0, 5), rng.gauss(0, 1)]) for _ in range(n)))


def rounding(rng):
    digits = rng.randint(0, 9)
    whole = rng.randint(-10**6, 10**6)
    value = rng.choice([rng.uniform(-100, 100), (whole + 0.5) / 10**digits, whole / 10**(digits + 1),
                        rng.uniform(-1, 1) * 10.0 ** rng.randint(-8, 8)])
    return words("round", digits, float(value))


def number_text(rng):
    value = rng.choice([float(rng.randint(0, 10**rng.randint(1, 15))), round(rng.uniform(0, 100), rng.randint(0, 6)),
                        rng.uniform(0, 1) * 10.0 ** rng.randint(-5, 9), 10.0 ** rng.randint(-5, 14)])
    return words("text", value)


def adjust(rng):
    n = rng.randint(1, 20)
    return words("adjust", rng.choice(["bonferroni", "holm"]), n,
                 *(rng.choice([rng.random(), rng.random()**4, 0.0, 1.0]) for _ in range(n)))


def logical_text(rng, depth):
    """An expression that R gives a logical value for."""
    if depth == 0:
        return rng.choice(["TRUE", "FALSE", "NA", "is.na(a)", "is.na(d)"])
    one, two = (lambda: logical_text(rng, depth - 1)), (lambda: number_expression(rng, depth - 1))
    quoted = ['"0"', '"1"', '"2"', '"x"', '"Ab"']
    return rng.choice([
        lambda: f"({one()} & {one()})", lambda: f"({one()} | {one()})", lambda: f"!{one()}",
        lambda: f"xor({one()}, {one()})",
        lambda: f"({two()} {rng.choice(['<', '<=', '>', '>=', '==', '!='])} {two()})",
        lambda: f"({rng.choice('ab')} {rng.choice(['==', '!='])} {rng.choice(quoted + ['b'])})",
        lambda: f"{rng.choice('ab')} %in% c({', '.join(rng.sample(quoted, 3))})",
        lambda: f"{rng.choice('cd')} %in% c({rng.randint(0, 3)}, {rng.randint(0, 3)}, NA)",
        lambda: f"(a == {rng.randint(0, 2)})", lambda: f"as.numeric({rng.choice('ab')}) > {rng.randint(0, 2)}",
    ])()


def number_expression(rng, depth):
    if depth == 0:
        return rng.choice(["c", "d", str(rng.randint(0, 9)), str(rng.randint(0, 90) / 4), "NA", "1e1", "3L"])
    one = lambda: number_expression(rng, depth - 1)
    return rng.choice([
        lambda: f"({one()} {rng.choice(['+', '-', '*', '/', '%%', '%/%'])} {one()})", lambda: f"-{one()}",
        lambda: f"{rng.choice(['min', 'max'])}({one()}, {one()})",
        lambda: f"{rng.choice(['floor', 'ceiling', 'trunc', 'abs', 'round'])}({one()})",
        lambda: f"round({one()}, {rng.randint(0, 3)})", lambda: f"ifelse({logical_text(rng, depth - 1)}, {one()}, {one()})",
        lambda: f"as.integer({one()})", lambda: f"{one()} ^ 2",
    ])()


def expression(rng):
    text = rng.choice([logical_text, number_expression])(rng, rng.randint(1, 4))
    texts = ["0", "1", "2", "x", "Ab", None]
    return words("expression", rng.choice(texts), rng.choice(texts), rng.choice([None, *range(-2, 8)]),
                 rng.choice([None, -1.5, 0.0, 0.25, 2.0, 7.5]), text)


def number(text):
    return math.nan if text == "NA" else float(text)


def same_numbers(ours, theirs):
    """Equal up to rounding; what is undefined must be so in both."""
    if len(ours.split()) != len(theirs.split()):
        return False
    for a, b in zip(map(number, ours.split()), map(number, theirs.split())):
        if math.isnan(a) != math.isnan(b) or (not math.isnan(a) and abs(a - b) > 1e-9 * max(1, abs(a), abs(b))):
            return False
    return True


def same_or_text(ours, theirs):
    try:
        return same_numbers(ours, theirs)
    except ValueError:
        return ours == theirs


def same_distribution(ours, theirs):
    """Counts of two samples of the same size: each difference within five standard errors."""
    pairs = list(zip(map(number, ours.split()), map(number, theirs.split())))
    return len(ours.split()) == len(theirs.split()) and all(abs(a - b) <= 5 * math.sqrt(a + b + 4) for a, b in pairs)


KINDS = [(eliminate, same_numbers, 3), (agreement, same_numbers, 1), (overall, same_numbers, 1),
         (size, same_numbers, 1), (minimum, same_numbers, 1), (update, same_numbers, 1),
         (draws, same_distribution, 0.5), (rank, same_numbers, 1), (rounding, lambda a, b: float(a) == float(b), 2),
         (number_text, str.__eq__, 1), (adjust, same_numbers, 1), (expression, same_or_text, 3)]


@unittest.skipUnless(r_is_there(), "needs R with irace 3.5 or 4 (Debian: r-base-core, r-cran-irace)")
class AgainstR(unittest.TestCase):
    def test_rules_give_what_r_gives(self):
        with tempfile.TemporaryDirectory(prefix="swarmsmith-r-") as folder:
            for make, same, weight in KINDS:
                with self.subTest(make.__name__):
                    self.compare(make, same, int(CASES * weight), pathlib.Path(folder) / make.__name__)

    def compare(self, make, same, count, file):
        rng = random.Random(f"{make.__name__} {SEED}")
        cases = [make(rng) for _ in range(count)]
        file.write_text("\n".join(cases) + "\n")
        ours = subprocess.run([PROGRAM], input=file.read_text(), check=True, text=True,
                              stdout=subprocess.PIPE).stdout.splitlines()
        theirs = subprocess.run(["Rscript", HERE / "against_r.R", file], check=True, text=True,
                                stdout=subprocess.PIPE).stdout.splitlines()
        self.assertEqual(len(ours), count)
        self.assertEqual(len(theirs), count)
        bad = [f"{case}\n  ours {a}\n  R    {b}" for case, a, b in zip(cases, ours, theirs) if not same(a, b)]
        print(f"{make.__name__}: {count} cases, {len(bad)} differ", flush=True)
        self.assertFalse(bad, f"{len(bad)} of {count} differ, the first ones:\n" + "\n".join(bad[:5]))


if __name__ == "__main__":
    unittest.main()
