"""What surrounds the programs: limits of the system, quotas of control groups, being process 1, other accounts."""
import contextlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

from rig import SANITIZED, SWARMSMITH, WORKER, FaultTest, call, need, need_root, stored, wait_for

REFUSED = 1  # exit code: the environment has too little
#: Between a limit and the program: `python3 -c LIMITED NAME SOFT HARD PROGRAM...`
LIMITED = """
import os, resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python ignores it
resource.setrlimit(getattr(resource, sys.argv[1]), (int(sys.argv[2]), int(sys.argv[3])))
os.execvp(sys.argv[4], sys.argv[4:])
"""
#: `python3 -c IN_GROUPS FILE... -- PROGRAM...`
IN_GROUPS = """
import os, sys
end = sys.argv.index("--")
for file in sys.argv[1:end]:
    open(file, "w").write(str(os.getpid()))
os.execvp(sys.argv[end + 1], sys.argv[end + 1:])
"""


def limited(name, soft, hard=None):
    """A prefix of a command."""
    return [sys.executable, "-c", LIMITED, name, str(soft), str(soft if hard is None else hard)]


class Environment(FaultTest):
    budget = 1500
    tests = 5

    def run_here(self, *arguments, prefix=(), env=None):
        """`run` to its end; exit code and words."""
        run = self.run_local("--workers", "2", *arguments, prefix=prefix, env=env)
        return run.wait(300), run.log()

    def assert_goes_on(self):
        """The same command, where there is enough, gives the usual answer."""
        code, words = self.run_here()
        self.assertEqual(code, 0, words)
        self.assert_same_answer()


    def contained(self):
        """A prefix: as process 1."""
        need("unshare", "util-linux")
        prefix = ["unshare", "--fork", "--pid", "--mount-proc", "--kill-child"]
        if os.geteuid() != 0:
            prefix += ["--user", "--map-root-user"]
        done = subprocess.run([*prefix, "true"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            self.skipTest("skipped: no namespace of processes can be made: " + done.stderr.strip())
        return prefix

    @staticmethod
    def slots(coordinator):
        """Of its workers."""
        lines = [json.loads(line) for line in coordinator.out.read_text().splitlines()]
        return {line["slots"] for line in lines if line["event"] == "worker"}


class Limits(Environment):
    def assert_refused(self, code, words, *parts):
        self.assertEqual(code, REFUSED, words)
        for part in parts:
            self.assertIn(part, words)
        self.assertNotIn("terminate called", words)
        self.assertEqual([file.name for file in self.folder.glob("campaign.db*")], [])

    def test_descriptors_are_counted_before_there_is_a_store(self):
        for number in (10, 20, 40):
            with self.subTest(number=number):
                self.assert_refused(*self.run_here(prefix=limited("RLIMIT_NOFILE", number)),
                                    "a campaign with 2 worker processes", f"may have {number} in all",
                                    "ulimit -n")
                self.count("too few descriptors")
        worker = self.worker("127.0.0.1:1", prefix=limited("RLIMIT_NOFILE", 12))
        self.assertEqual(worker.wait(30), 2)
        self.assertIn("a worker with 1 slot needs", worker.log())
        # What the system allows is taken.
        hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
        code, words = self.run_here(prefix=limited("RLIMIT_NOFILE", 20, hard))
        self.assertEqual(code, 0, words)
        self.assert_same_answer()

    @unittest.skipIf(SANITIZED, "a sanitizer reserves address space of its own")
    def test_address_space_is_counted_before_there_is_a_store(self):
        for mib in (80, 200):
            with self.subTest(mib=mib):
                self.assert_refused(*self.run_here(prefix=limited("RLIMIT_AS", mib << 20)),
                                    "of address space", "ulimit -v")
                self.count("too little address space")
        worker = self.worker("127.0.0.1:1", slots=16, prefix=limited("RLIMIT_AS", 80 << 20))
        self.assertEqual(worker.wait(30), 2)
        self.assertIn("a worker with 16 slots needs", worker.log())
        self.assert_goes_on()

    def test_files_that_may_not_grow_are_full_disks(self):
        run = self.run_local("--workers", "2", prefix=limited("RLIMIT_FSIZE", 1_000_000))
        wait_for(lambda: "store cannot be written" in run.log() or not run.alive(),
                 "the word that the store cannot grow")
        self.assertTrue(run.alive(), run.tail())
        self.assertIn("File too large", run.log())
        wait_for(lambda: run.progress().get("trouble"), "trouble in the numbers")
        run.send(signal.SIGINT)
        self.assertEqual(run.wait(), 130, run.tail())
        # What is printed is what is stored.
        last = run.progress()
        self.assertGreater(last["uncommitted"], 0)
        self.assertIn(f"{stored(self.store)} evaluations are stored; {last['uncommitted']} more "
                      "could not be written", run.log())
        self.assertNotIn("everything so far", run.log())
        self.count("files that may not grow")
        self.assert_goes_on()

    def test_a_store_that_cannot_be_born_leaves_none_that_is_in_the_way(self):
        for size in (1000, 20_000):
            with self.subTest(size=size):
                code, words = self.run_here(prefix=limited("RLIMIT_FSIZE", size))
                self.assertNotIn(code, (0, -signal.SIGXFSZ), words)
                self.assertIn(str(self.store), words)
                self.count("store not born")
        self.assert_goes_on()

    def test_every_command_says_that_its_processor_time_is_used_up(self):
        """`ulimit -t` sets both limits, and at the second the kernel kills without a signal."""
        machine = ["--nstates", "1", "--s0", "0", "--rwm0", "10"]
        done = subprocess.run(
            [*limited("RLIMIT_CPU", 2), SWARMSMITH, "evaluate", *machine, "--flavour", "watermelon",
             "--profile", "rvr", "--mission", "aggregation", "--seeds", "1-1000000"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 128 + signal.SIGXCPU, done.stderr)
        self.assertIn("processor time that it may use (ulimit -t)", done.stderr)


class ProcessorTime(Environment):
    """Its coordinator needs some seconds of processor time."""
    budget = 60_000

    def test_the_end_of_processor_time_is_a_clean_stop(self):
        run = self.run_local("--workers", "1")
        # Of the coordinator alone: a worker that is started after this has the limit too.
        self.wait_stored(1)
        resource.prlimit(run.pid, resource.RLIMIT_CPU, (1, resource.RLIM_INFINITY))
        self.assertEqual(run.wait(120), 143, run.tail())
        self.assertIn("processor time that it may use (ulimit -t)", run.log())
        self.assertIn("the same command continues", run.log())
        self.count("processor time used up")
        self.assert_goes_on()


def groups_of(test, quota, period=100_000):
    """Makes a control group with such a quota; the files that take its processes."""
    for line in pathlib.Path("/proc/self/mountinfo").read_text().splitlines():
        words, _, kind = line.partition(" - ")
        point = pathlib.Path(words.split()[4])
        kind = kind.split()
        first = kind[0] == "cgroup" and "cpu" in kind[2].split(",")
        second = kind[0] == "cgroup2" and "cpu" in (point / "cgroup.controllers").read_text().split()
        if not first and not second:
            continue
        group = point / f"swarmsmith-test-{test.mark}"
        try:
            if second:
                (point / "cgroup.subtree_control").write_text("+cpu")
            group.mkdir()
            test.addCleanup(lambda: wait_for(lambda: removed(group), "the end of the group"))
            if second:
                (group / "cpu.max").write_text(f"{quota} {period}")
            else:
                (group / "cpu.cfs_period_us").write_text(str(period))
                (group / "cpu.cfs_quota_us").write_text(str(quota))
        except OSError as error:
            test.skipTest(f"skipped: no control group with a quota can be made: {error}")
        return [group / "cgroup.procs"]
    return test.skipTest("skipped: no control groups of processors are mounted")


def removed(group):
    with contextlib.suppress(OSError):
        group.rmdir()
    return not group.exists()


class Processors(Environment):
    def within(self, quota):
        """A prefix: in a group with that many processors."""
        files = groups_of(self, int(quota * 100_000))
        return [sys.executable, "-c", IN_GROUPS, *map(str, files), "--"]

    def test_of_a_quota_are_the_slots_of_all_who_count(self):
        need_root("making a control group")
        processors = len(os.sched_getaffinity(0))
        prefix = self.within(0.5)
        check = subprocess.run([*prefix, SWARMSMITH, "check", str(self.file), "--json"],
                               capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(json.loads(check.stdout)["slots"], 1, check.stderr)
        run = self.run_local(prefix=prefix)
        self.assertEqual(run.wait(), 0, run.tail())
        self.assertEqual(self.slots(run), {1})
        self.assert_same_answer()
        # Without the group it has more, where there are more.
        check = call("check", self.file, "--json")
        self.assertEqual(json.loads(check.stdout)["slots"], processors)

    def test_of_a_worker_from_elsewhere(self):
        need_root("making a control group")
        serve = self.serve()
        worker = self.start("worker", WORKER, "--connect", f"tcp://{serve.address()}",
                            prefix=self.within(0.5))
        self.finish(serve, [worker])
        self.assertEqual(self.slots(serve), {1})


class FirstProcess(Environment):
    """Process 1 of a container, which here is a namespace of processes."""

    #: A program for a campaign that leaves an orphan with each evaluation.
    program = """#!/bin/sh
setsid sh -c 'exec sleep 0.01' >/dev/null 2>&1 </dev/null &
echo 1.5
"""
    targets = """format = 1
[[mission]]
name = "orphans"
[[method]]
name = "m"
parameters_text = 'x "--x " r (0, 1)'
[race]
max_experiments = 100000
[simulator]
kind = "command"
command = ["./program"]
"""

    @staticmethod
    def children(pid):
        with contextlib.suppress(OSError):
            text = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text()
            return [int(word) for word in text.split()]
        return []

    @staticmethod
    def is_zombie(pid):
        with contextlib.suppress(OSError):
            return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
        return False

    def first(self, program):
        """Its process id out here, once the program under it runs."""
        wait_for(lambda: any(self.children(pid) for pid in self.children(program.pid)),
                 "process 1 and its child")
        [pid] = self.children(program.pid)
        return pid

    def test_reaps_orphans(self):
        program = self.folder / "program"
        program.write_text(self.program)
        program.chmod(0o755)
        self.file.write_text(self.targets)
        run = self.run_local("--workers", "2", prefix=self.contained())
        pid = self.first(run)
        self.wait_stored(100)
        wait_for(lambda: not run.alive() or not any(map(self.is_zombie, self.children(pid))),
                 lambda: f"a moment without zombies; {len(self.children(pid))} children")
        self.assertTrue(run.alive(), run.tail())
        self.count("orphans", stored(self.store))
        os.kill(pid, signal.SIGINT)
        self.assertEqual(run.wait(), 130, run.tail())

    def test_passes_signals_on_and_ends_as_its_program(self):
        for number, code in ((signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGKILL, 137)):
            with self.subTest(signal=number):
                serve = self.serve(prefix=self.contained(), wait=False)
                pid = self.first(serve)
                [program] = self.children(pid)
                wait_for(lambda s=serve: s.address(), "a coordinator that listens")
                os.kill(program if number == signal.SIGKILL else pid, number)
                self.assertEqual(serve.wait(30), code, serve.tail())
                self.count("signals")
        worker = self.worker("127.0.0.1:1", prefix=self.contained())
        os.kill(self.first(worker), signal.SIGHUP)
        self.assertEqual(worker.wait(30), 129, worker.tail())

    def test_ends_with_the_code_of_its_program(self):
        done = subprocess.run([*self.contained(), SWARMSMITH, "no-such-command"],
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("no-such-command", done.stderr)


class BehindFuse(Environment):
    """Folders that bindfs shows: real FUSE, under the names that the test gives it."""

    def show(self, *options):
        """A folder of this disk, behind FUSE."""
        need_root("mounting bindfs")
        need("bindfs", "bindfs")
        place = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        behind, shown = place / "behind", place / "shown"
        behind.mkdir()
        shown.mkdir()
        done = subprocess.run(["bindfs", *options, str(behind), str(shown)], capture_output=True,
                              text=True, timeout=60, check=False)
        if done.returncode != 0:
            self.skipTest("skipped: bindfs cannot be mounted: " + done.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "-l", str(shown)], check=False)
        return shown

    def test_a_local_folder_is_local(self):
        for options in ((), ("-o", "subtype=gocryptfs")):
            self.store = self.show(*options) / f"campaign{len(options)}.db"
            code, words = self.run_here()
            self.assertEqual(code, 0, words)
            self.assert_same_answer()
            self.count("local folders behind FUSE")

    def test_what_may_be_remote_is_refused_by_its_name(self):
        for name in ("sshfs", "glusterfs", "some-new-thing"):
            self.store = self.show("-o", f"subtype={name}") / "campaign.db"
            code, words = self.run_here()
            self.assertEqual(code, 3, words)
            self.assertIn(f"fuse.{name}", words)
            self.assertIn("SWARMSMITH_ALLOW_NETWORK_FS", words)
            self.count("remote folders behind FUSE")


class Outsider(Environment):
    """A container: another user without any right, half a processor, process 1, no home."""

    def test_runs_a_campaign_in_a_container(self):
        need_root("another user")
        need("setpriv", "util-linux")
        programs = self.folder / "bin"
        programs.mkdir()
        for program in (SWARMSMITH, WORKER):
            shutil.copy(program, programs)
        self.folder.chmod(0o777)
        groups = groups_of(self, 50_000)
        prefix = [sys.executable, "-c", IN_GROUPS, *map(str, groups), "--", *self.contained(),
                  "env", "-u", "HOME", "-u", "USER", "-u", "XDG_CONFIG_HOME",
                  "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups",
                  "--no-new-privs", "--bounding-set=-all", "--inh-caps=-all"]
        run = self.start("run", programs / "swarmsmith", "run", self.file, "--store", self.store,
                         "--json", "--no-dashboard", prefix=prefix)
        self.assertEqual(run.wait(), 0, run.tail())
        self.assertEqual(self.slots(run), {1})
        self.assertEqual(self.store.stat().st_uid, 65534)
        self.assert_same_answer()


if __name__ == "__main__":
    unittest.main()
