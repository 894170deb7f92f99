"""Each method's campaign has one answer: for any number of workers, and through kills of both sides.

Campaigns are run by the real programs. The budget is small, so most presets get smaller
generations, too.
"""
import random
import signal
import unittest

from programs import ProgramTest, call, campaign_text, children_of, ended_well, send, used, wait_for

METHODS = {
    "random": "",
    "vanilla": "",
    "evostick": "[method.evolution]\npopulation = 20\nruns = 5\nfinal_runs = 10",
    "cma-es": "[method.cma-es]\npopulation = 20\nruns = 5\nfinal_runs = 10",
    "icepop": "",
    "maple": "",
}

#: A method that has no preset: iterated F-race on the weights of a network.
RACED_NETWORK = 'architecture = "network"\nsearch = "irace"'
#: The other one: a genetic algorithm would need real parameters, random search does not.
RANDOM_TREE = 'architecture = "tree"\nsearch = "random"'


class MethodTest(ProgramTest):
    budget = 2400

    def write(self, name, keys):
        self.file.write_text(campaign_text(self.budget, seed=self.seed, tests=10, name="methods", duration="30 s",
                                           methods=[f'name = "{name}"\n{keys}'], profile=None))

    def answer(self, store, *arguments):
        ended_well(self.run_campaign(store, *arguments))
        self.assert_clean(store)
        return self.digest(store)


class OneAnswer(MethodTest):
    rng = random.Random(2026)

    def interrupt(self, store, whole):
        """Kills a worker at some moment, and then the coordinator; False if the end came first, after the whole number of
        experiments."""
        process = self.start_campaign(store, "--workers", "2")
        for victim in ("worker", "coordinator"):
            before = used(store)
            moment = before + self.rng.uniform(0, 0.2) * (whole - before)
            wait_for(lambda: used(store) >= moment or process.poll() is not None, "no progress")
            workers = children_of(process.pid)
            if process.poll() is not None:
                return False
            if victim == "coordinator":
                send(process.pid, signal.SIGKILL)
                process.wait()
            elif workers:
                send(self.rng.choice(workers), signal.SIGKILL)
        return True

    def one_answer(self, name, keys):
        self.write(name, keys)
        one = self.folder / f"{name}.one.db"
        digest = self.answer(one, "--workers", "1")
        stores = [self.folder / f"{name}.killed{number}.db" for number in range(10)]
        killed = next((store for store in stores if self.interrupt(store, used(one))), None)
        self.assertTrue(killed, "all campaigns were over before they were killed")
        for _ in range(2):
            self.interrupt(killed, used(one))
        self.assertEqual(self.answer(killed, "--workers", "3"), digest)


def one_answer_of(name, keys):
    def test(self):
        self.one_answer(name, keys)
    return test


for preset, settings in METHODS.items():
    setattr(OneAnswer, "test_" + preset.replace("-", "_"),
            one_answer_of(preset, f'method = "{preset}"\n{settings}'))
setattr(OneAnswer, "test_raced_network", one_answer_of("raced-network", RACED_NETWORK))
setattr(OneAnswer, "test_random_tree", one_answer_of("random-tree", RANDOM_TREE))


class Extended(MethodTest):
    """A finished design goes on with more budget, and its answer is one again; or says why not."""

    def test_goes_on(self):
        for preset in ("random", "evostick", "cma-es", "maple"):
            with self.subTest(preset):
                self.write(preset, f'method = "{preset}"\n{METHODS[preset]}')
                digests = []
                for workers in ("1", "3"):
                    store = self.folder / f"{preset}.{workers}.db"
                    self.answer(store, "--workers", workers)
                    ended_well(call("extend", store, "d1", "--budget", "1400"))
                    digests.append(self.answer(store, "--workers", workers))
                    used = self.query(store, "SELECT used FROM v_designs")[0]["used"]
                    self.assertGreater(used, self.budget)
                    self.assertLessEqual(used, self.budget + 1400)
                self.assertEqual(digests[0], digests[1])

    def test_what_follows_from_the_whole_budget_says_why_not(self):
        for preset, why in (("icepop", "temperatures"), ("vanilla", "drawn once")):
            with self.subTest(preset):
                self.write(preset, f'method = "{preset}"')
                store = self.folder / f"{preset}.db"
                self.answer(store)
                done = call("extend", store, "d1", "--budget", "1400")
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("d1: ", done.stderr)
                self.assertIn(why, done.stderr)


class ExplicitForm(MethodTest):
    """A preset and its two halves are the same campaign."""
    budget = 1500

    HALVES = {
        "random": ("machine", "random"),
        "vanilla": ("machine", "f-race"),
        "evostick": ("network", "evolution"),
        "cma-es": ("network", "cma-es"),
        "icepop": ("machine", "annealing"),
        "maple": ("tree", "irace"),
    }

    def test_a_preset_and_its_halves_have_one_digest(self):
        for preset, (architecture, search) in self.HALVES.items():
            with self.subTest(preset):
                self.write("m", f'method = "{preset}"\n{METHODS[preset]}')
                digest = self.answer(self.folder / f"{preset}.db")
                self.write("m", f'architecture = "{architecture}"\nsearch = "{search}"\n'
                           f"{METHODS[preset]}")
                self.assertEqual(self.answer(self.folder / f"{preset}-halves.db"), digest)


if __name__ == "__main__":
    unittest.main()
