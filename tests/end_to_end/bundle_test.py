"""The worker with loader and libraries of its own, where there is nothing else; --ship is in tests/slurm."""
import os
import pathlib
import platform
import re
import shutil
import subprocess
import tempfile
import unittest

import robots
from programs import BIN, PATIENCE, SWARMSMITH, ProgramTest, call, ended_well

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])


def why_not():
    if not (BIN / "swarmsmith-launcher").exists():
        return "skipped: the launcher of bundles is not built; under sanitizers there is none"
    return None


def pack(folder, architecture=platform.machine(), build=BIN.parent, kinds=("swarmsmith-worker",), **environment):
    """The archive of a build's worker, packed quickly; or those of the kinds of packaging/bundle."""
    subprocess.run([SOURCE / "packaging/bundle", architecture, build, folder, "0", *kinds], check=True, capture_output=True,
                   env={**os.environ, **environment})
    return next(pathlib.Path(folder).glob(f"*-{architecture}.tar.xz"))


def unpacked(archive, folder):
    subprocess.run(["tar", "-xf", archive, "-C", folder], check=True)
    return pathlib.Path(folder) / archive.name.removesuffix(".tar.xz")


def in_root(root, *words):
    """A command line that runs in `root`."""
    mine = [] if os.geteuid() == 0 else ["--map-root-user"]
    return ["unshare", *mine, "--root", root, "--wd", "/", *words]


def why_no_root():
    done = subprocess.run(in_root("/", "true"), capture_output=True, text=True)
    return None if done.returncode == 0 else "skipped: no other root here: " + done.stderr.strip()


def serve(test, store, *words):
    """A coordinator on loopback; itself and its port."""
    process = robots.Process(test, [SWARMSMITH, "serve", test.file, "--store", store, "--bind", "127.0.0.1:0", "--http", "none",
                                    *words])
    file = pathlib.Path(f"{store}.coordinator")
    robots.wait_for(lambda: file.exists() or process.process.poll() is not None, str(file))
    test.assertTrue(file.exists(), process.said())
    return process, re.search(r"tcp://127\.0\.0\.1:(\d+)", file.read_text()).group(1)


@unittest.skipIf(why_not(), why_not() or "")
class Bundled(ProgramTest):
    """Tests with a bundle of this build, unpacked."""
    budget = 1500

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-bundle-")
        cls.addClassCleanup(folder.cleanup)
        cls.place = pathlib.Path(folder.name)
        cls.archive = pack(cls.place)
        cls.bundle = unpacked(cls.archive, cls.place)

    def takes_part_in(self, root):
        """A campaign over CURVE, whose one worker runs in `root` and finds its coordinator by name."""
        keys = self.folder / "keys"
        self.assertEqual(call("keygen", keys).returncode, 0)
        shutil.copytree(self.bundle, root / "bundle")
        shutil.copy(keys / "worker.key", root)
        (root / "etc").mkdir(exist_ok=True)
        (root / "etc/hosts").write_text("127.0.0.1 coordinator.example\n")
        (root / "etc/ld.so.preload").write_text("/of/another/libc.so\n")
        store = self.folder / "there.db"
        coordinator, port = serve(self, store, "--keys", keys)
        worker = robots.Process(self, in_root(
            root, "/bundle/swarmsmith-worker", "--connect", f"tcp://coordinator.example:{port}", "--key", "/worker.key",
            "--slots", "1"))
        robots.wait_for(lambda: self.query(store, "SELECT count(*) AS n FROM worker")[0]["n"], "the worker")
        # What looks for programs beside its own (base/program_path) finds them, and people find it by its name.
        process = pathlib.Path(f"/proc/{worker.process.pid}")
        self.assertEqual(os.readlink(process / "exe"), str(root / "bundle/lib/ld.so"))
        self.assertEqual((process / "comm").read_text(), "swarmsmith-work\n")
        self.assertEqual(coordinator.end(), 0, coordinator.said() + worker.said())
        self.assertEqual(worker.end(), 0, worker.said())
        self.assertNotIn("ld.so", worker.said())
        local = self.folder / "local.db"
        ended_well(self.run_campaign(local, "--workers", "2"))
        self.assertEqual(self.digest(store), self.digest(local))
        rows = self.query(store, "SELECT client, done > 500 AS worked FROM worker")
        self.assertEqual(rows, [{"client": "worker", "worked": 1}])


class Bundle(Bundled):
    def version(self, *words, **keywords):
        done = subprocess.run(words, capture_output=True, text=True, timeout=60 * PATIENCE, **keywords)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.strip()

    def test_in_an_empty_root_over_curve_by_name(self):
        if why := why_no_root():
            self.skipTest(why)
        root = self.folder / "root"
        root.mkdir()
        self.takes_part_in(root)
        self.assertEqual(sorted(entry.name for entry in root.iterdir()), ["bundle", "etc", "worker.key"])

    def test_from_wherever_it_is_called(self):
        version = self.version(BIN / "swarmsmith-worker", "--version")
        program = self.bundle / "swarmsmith-worker"
        link = self.folder / "a link"
        link.symlink_to(program)
        for words in ([program], [link]):
            self.assertEqual(self.version(*words, "--version"), version)
        self.assertEqual(self.version("./swarmsmith-worker", "--version", cwd=self.bundle), version)
        self.assertEqual(self.version("sh", "-c", "swarmsmith-worker --version", cwd="/",
                                      env={"PATH": f"{self.bundle}:{os.environ['PATH']}"}), version)
        # Libraries of this system have no business in it.
        self.assertEqual(self.version(program, "--version", env={"LD_PRELOAD": "/nowhere.so", "LD_AUDIT": "/nowhere.so",
                                                                 "LD_LIBRARY_PATH": "/usr/lib"}), version)
        done = subprocess.run([program, "--connect", "nowhere"], capture_output=True, text=True, timeout=60 * PATIENCE)
        self.assertEqual(done.returncode, 2)
        self.assertIn("invalid address", done.stderr)
        moved = self.folder / "moved"
        shutil.copytree(self.bundle, moved)
        (moved / "lib/ld.so").unlink()
        done = subprocess.run([moved / "swarmsmith-worker"], capture_output=True, text=True, timeout=60 * PATIENCE)
        self.assertEqual(done.returncode, 127)
        self.assertIn(f"cannot start {moved}/lib/ld.so: No such file", done.stderr)

    def test_all_that_it_needs_is_in_it_with_its_licence(self):
        subprocess.run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=self.bundle, check=True)
        listed = {line.split("  ")[1] for line in (self.bundle / "SHA256SUMS").read_text().splitlines()}
        files = {str(path.relative_to(self.bundle)) for path in self.bundle.rglob("*") if path.is_file()}
        self.assertEqual(files - listed, {"SHA256SUMS"})
        needed = self.version(self.bundle / "lib/ld.so", "--inhibit-cache", "--library-path", self.bundle / "lib", "--list",
                              self.bundle / "lib/swarmsmith-worker")
        places = re.findall(r"=> (\S+)", needed)
        self.assertGreater(len(places), 20)
        self.assertEqual([place for place in places if not place.startswith(str(self.bundle))], [])
        self.assertEqual(len([name for name in files if name.startswith("lib/")]), len(places) + 1)  # and the loader
        # A licence of every package that a library or a header comes from.
        licences = {path.name for path in (self.bundle / "licences").iterdir()}
        self.assertLessEqual({"swarmsmith", "libc6", "libzmq5", "libstdc++6", "libcli11-dev"}, licences)
        self.assertIn("  zeromq3 ", (self.bundle / "README").read_text())

    def test_the_same_build_gives_the_same_bytes(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        old = os.umask(0o077)
        self.addCleanup(os.umask, old)
        again = pack(elsewhere, TMPDIR=str(elsewhere), LC_ALL="C.UTF-8", TZ="Asia/Tokyo", XZ_OPT="-9")
        self.assertEqual(again.read_bytes(), self.archive.read_bytes())


class OlderDebian(Bundled):
    def test_takes_part_over_curve_by_name(self):
        if os.geteuid() != 0 or not shutil.which("debootstrap"):
            self.skipTest("a Debian 11 is made by root with debootstrap")
        root = self.folder / "root"
        done = subprocess.run(["debootstrap", "--variant=minbase", "bullseye", root], capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest(f"debootstrap could not make a root; is there a network? {done.stdout[-300:]}{done.stderr}")
        libc = subprocess.run(in_root(root, "ldd", "--version"), capture_output=True, text=True, check=True).stdout
        self.assertIn("2.31", libc.split("\n")[0])
        # A program of this system does not start there.
        shutil.copy(BIN / "swarmsmith-worker", root)
        self.assertNotEqual(subprocess.run(in_root(root, "/swarmsmith-worker", "--version"), capture_output=True).returncode, 0)
        self.takes_part_in(root)


if __name__ == "__main__":
    unittest.main()
