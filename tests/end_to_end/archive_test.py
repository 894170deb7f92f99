"""The archive of all programs where there is nothing else: in an empty root, in an older and a newer Debian, and as all
that a container has."""
import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import bundle_test
import robots
from bundle_test import SOURCE, in_root, why_no_root
from programs import BIN, PATIENCE, SWARMSMITH, ProgramTest, call

sys.path.insert(0, str(SOURCE / "tests/reliability"))
import network  # noqa: E402

PROGRAMS = ("swarmsmith", "swarmsmith-worker", "swarmsmith-robot", "swarmsmith-track")
DEMO = ("run", "--workers", "2", "--store", "demo.db", "--no-dashboard")


def said(words, timeout=300, **keywords):
    """What a command prints; it must end well."""
    words = [str(word) for word in words]
    done = subprocess.run(words, capture_output=True, text=True, timeout=timeout * PATIENCE, stdin=subprocess.DEVNULL, **keywords)
    if done.returncode != 0:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-3000:]}")
    return done.stdout


@unittest.skipIf(bundle_test.why_not(), bundle_test.why_not() or "")
class Archived(ProgramTest):
    """Tests with the archive of this build, unpacked in a root as `self.programs`."""
    budget = 1500

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-archive-")
        cls.addClassCleanup(folder.cleanup)
        cls.place = pathlib.Path(folder.name)
        bundle_test.pack(cls.place, kinds=("swarmsmith-worker", "swarmsmith"))
        [cls.archive] = cls.place.glob("swarmsmith-[0-9]*.tar.xz")
        cls.unpacked = bundle_test.unpacked(cls.archive, cls.place)
        call("run", *DEMO[1:-3], "--store", cls.place / "demo.db", "--no-dashboard", cwd=cls.place)
        cls.demo = said([SWARMSMITH, "digest", cls.place / "demo.db"])

    def into(self, root):
        """Puts the archive into a home in `root`; what to put before a command there."""
        home = root / "home/user"
        home.mkdir(parents=True)
        shutil.copytree(self.unpacked, home / self.unpacked.name)
        shutil.copytree(home / self.unpacked.name / "share/doc/swarmsmith/examples/lab", home / "lab")
        (root / "etc").mkdir(exist_ok=True)
        (root / "etc/ld.so.preload").write_text("/of/another/libc.so\n")
        self.root, self.home = root, home
        self.bin = pathlib.Path("/home/user", self.unpacked.name, "bin")

    def there(self, program, *words, folder=""):
        mine = [] if os.geteuid() == 0 else ["--map-root-user"]
        return ["unshare", *mine, "--root", str(self.root), "--wd", f"/home/user/{folder}", str(self.bin / program), *map(str, words)]

    def answers(self):
        """All programs say their version, the demo gives this build's bits, a film is scored, pages are shown."""
        for program in PROGRAMS:
            self.assertEqual(said(self.there(program, "--version")), said([BIN / program, "--version"]))
        said(self.there("swarmsmith", *DEMO))
        self.assertEqual(said(self.there("swarmsmith", "digest", "demo.db")), self.demo)
        scored = said(self.there("swarmsmith", "track", "score", "--arena", "arena.toml", "--run", "run01.toml", "--into", "lab.db",
                                 folder="lab"))
        self.assertIn("score 1, VALID", scored)
        said(self.there("swarmsmith", "track", "overlay", "r1", "--store", "lab.db", "--at", "10", "-o", "r1.png", folder="lab"))
        self.assertEqual((self.home / "lab/r1.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(said(self.there("swarmsmith", "robot", "version", "--json")), said([SWARMSMITH, "robot", "version", "--json"]))

    def two_hosts(self):
        """A campaign over CURVE: coordinator and worker in this root, on hosts of their own."""
        hosts = network.Hosts(self, ["w"])
        said(self.there("swarmsmith", "keygen", "keys"))
        shutil.copy(self.file, self.home)
        (self.root / "etc/hosts").write_text("10.77.0.1 coordinator.example\n")
        serve = robots.Process(self, [*hosts.at("c"), *self.there(
            "swarmsmith", "serve", "campaign.toml", "--store", "two.db", "--keys", "keys", "--bind", "10.77.0.1:5555", "--http", "none")])
        worker = robots.Process(self, [*hosts.at("w"), *self.there(
            "swarmsmith", "worker", "--connect", "tcp://coordinator.example:5555", "--key", "keys/worker.key", "--slots", "1")])
        self.assertEqual(serve.end(), 0, serve.said() + worker.said())
        self.assertEqual(worker.end(), 0, worker.said())
        local = self.folder / "local.db"
        self.assertEqual(self.run_campaign(local, "--workers", "2").returncode, 0)
        self.assertEqual(said(self.there("swarmsmith", "digest", "two.db")), said([SWARMSMITH, "digest", local]))


class EmptyRoot(Archived):
    def test_the_programs_answer(self):
        if why := why_no_root():
            self.skipTest(why)
        root = self.folder / "root"
        root.mkdir()
        self.into(root)
        self.answers()
        self.assertEqual(sorted(entry.name for entry in root.iterdir()), ["etc", "home"])


class Layout(Archived):
    """What a Python wheel, which is a zip, can hold as it is."""

    def test_no_links_no_paths_from_a_root_and_a_licence_of_each(self):
        self.assertEqual([path for path in self.unpacked.rglob("*") if path.is_symlink()], [])
        said(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=self.unpacked)
        folders = {path.name for path in self.unpacked.iterdir() if path.is_dir()}
        self.assertEqual(folders, {"bin", "lib", "share", "licences"})
        for program in PROGRAMS:
            done = said([self.unpacked / "lib/ld.so", "--inhibit-cache", "--library-path", self.unpacked / "lib", "--list",
                         self.unpacked / "lib" / program])
            outside = [place for place in re.findall(r"=> (\S+)", done) if not place.startswith(str(self.unpacked))]
            self.assertEqual(outside, [])
        self.assertTrue((self.unpacked / "share/man/man1/swarmsmith-run.1").exists())
        self.assertTrue((self.unpacked / "share/bash-completion/completions/swarmsmith-track").exists())
        licences = {path.name for path in (self.unpacked / "licences").iterdir()}
        self.assertLessEqual({"swarmsmith", "libc6", "libavcodec59", "libeigen3-dev"} if "12" in said(["cat", "/etc/debian_version"])
                             else {"swarmsmith", "libc6"}, licences)

    def test_from_a_zip_by_any_way_of_calling(self):
        home = self.folder / "a home"
        said(["python3", "-c", "import shutil, sys; shutil.make_archive(sys.argv[1], 'zip', sys.argv[2])", self.folder / "all", self.unpacked])
        said(["unzip", "-q", self.folder / "all.zip", "-d", home])
        version = said([SWARMSMITH, "--version"])
        link = self.folder / "link"
        link.symlink_to(home / "bin/swarmsmith")
        self.assertEqual(said([link, "--version"]), version)
        self.assertEqual(said(["./swarmsmith", "--version"], cwd=home / "bin"), version)
        self.assertEqual(said(["sh", "-c", "swarmsmith track --version"], cwd="/",
                              env={"PATH": f"{home}/bin:/usr/bin:/bin"}), said([BIN / "swarmsmith-track", "--version"]))

    def test_programs_that_it_starts_are_the_systems(self):
        """A target of a campaign has this system's loader and libraries, and no setting of ours."""
        (self.folder / "runner").write_text("#!/bin/sh\nenv >env\nreadlink /proc/$$/exe >exe\nls >/dev/null && echo 1.5\n")
        (self.folder / "runner").chmod(0o755)
        self.file.write_text('format = 1\n[[mission]]\nname = "m"\n[[method]]\nname = "m"\nparameters_text = \'x "--x " r (0, 1)\'\n'
                             '[race]\nmax_experiments = 100\n[simulator]\nkind = "command"\ncommand = ["./runner"]\n')
        said([self.unpacked / "bin/swarmsmith", "run", self.file, "--store", "a.db", "--workers", "1", "--no-dashboard"], cwd=self.folder)
        where = next(self.folder.rglob("env"))
        self.assertNotIn("LD_", where.read_text())
        self.assertNotIn("ld.so", (where.parent / "exe").read_text())


class OtherDebians(Archived):
    def answers_in(self, suite):
        if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
            self.skipTest("skipped: another Debian is made by root with mmdebstrap")
        root = self.folder / suite
        done = subprocess.run(["mmdebstrap", "--quiet", "--variant=essential", suite, root], capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest(f"skipped: mmdebstrap could not make a root; is there a network? {done.stderr[-500:]}")
        self.into(root)
        self.answers()
        self.two_hosts()

    def test_debian_11(self):
        self.answers_in("bullseye")

    def test_debian_13(self):
        self.answers_in("trixie")


class Container(Archived):
    """A root made by the lines of packaging/Containerfile, with process 1 of ours in it. No engine is asked: what it would
    add is /proc, and the files /etc/hosts and /etc/resolv.conf."""

    def image(self):
        """Root, environment and entry point."""
        root, environment, folder, entry = self.folder / "image", {}, "/", None
        root.mkdir()
        arguments = {"ARCHIVE": self.unpacked.name}
        for line in (SOURCE / "packaging/Containerfile").read_text().splitlines():
            for name, value in arguments.items():
                line = line.replace("${" + name + "}", value)
            word, _, rest = line.partition(" ")
            if word in ("#", "", "ARG"):
                continue
            elif word == "FROM":
                self.assertEqual(rest, "scratch")
            elif word == "ADD":
                source, place = rest.split()
                (root / place.lstrip("/")).mkdir(parents=True, exist_ok=True)
                said(["tar", "-xf", self.place / source, "-C", root / place.lstrip("/")])
            elif word == "ENV":
                environment.update(pair.split("=", 1) for pair in rest.split())
            elif word == "WORKDIR":
                folder = rest
                (root / folder.lstrip("/")).mkdir(parents=True, exist_ok=True)
            elif word == "ENTRYPOINT":
                entry = json.loads(rest)
            else:
                self.fail(f"a line that this test does not know: {line}")
        (root / "proc").mkdir()
        return root, environment, folder, entry

    def contained(self, *words):
        """A command line that runs in it as process 1."""
        root, environment, folder, entry = self.made
        mine = [] if os.geteuid() == 0 else ["--map-root-user"]
        settings = [f"{name}={value}" for name, value in environment.items()]
        program = next(str(path) for path in (root / environment["PATH"].lstrip("/")).glob(entry[0]))
        return ["unshare", *mine, "--fork", "--pid", "--mount", "--kill-child", "sh", "-c",
                'mount -t proc proc "$1/proc" && shift && exec "$@"', "sh", str(root), "env", "-i", *settings,
                shutil.which("unshare"), "--root", str(root), "--wd", folder, program.removeprefix(str(root)), *entry[1:], *words]

    def setUp(self):
        super().setUp()
        if why := why_no_root():
            self.skipTest(why)
        self.made = self.image()

    def process_1(self, outer):
        """Its process id out here."""
        children = pathlib.Path(f"/proc/{outer.pid}/task/{outer.pid}/children")
        robots.wait_for(lambda: children.read_text(), "process 1")
        pid = int(children.read_text().split()[0])
        robots.wait_for(lambda: pathlib.Path(f"/proc/{pid}/comm").read_text() == "swarmsmith-init\n", "our own as process 1")
        return pid

    def test_the_demo(self):
        said(self.contained(*DEMO))
        self.assertEqual(said(self.contained("digest", "demo.db")), self.demo)

    def test_reaps_orphans_and_ends_on_sigterm(self):
        shutil.copy(self.file, self.made[0] / "data")
        outer = subprocess.Popen(self.contained("serve", "campaign.toml", "--store", "a.db", "--bind", "127.0.0.1:0", "--http", "none"),
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(outer.wait)
        self.addCleanup(outer.kill)
        first = self.process_1(outer)
        robots.wait_for(lambda: (self.made[0] / "data/a.db.coordinator").exists(), "a coordinator that listens")
        children = pathlib.Path(f"/proc/{first}/task/{first}/children")
        for _ in range(20):
            said(["nsenter", "--target", first, "--pid", "sh", "-c", "sh -c 'sleep 0.05' &"])
        robots.wait_for(lambda: len(children.read_text().split()) == 1, "an end of all orphans")
        os.kill(first, signal.SIGTERM)
        self.assertEqual(outer.wait(30 * PATIENCE), 143)


if __name__ == "__main__":
    unittest.main()
