"""Debian packages: they are made of the programs that are built, twice with the same bytes, and live in a bare Debian:
installed, upgraded, used and removed, as root in a folder of its own. SWARMSMITH_BARE_ROOT names a bare root that is
copied; without it debootstrap makes one."""
import contextlib
import filecmp
import functools
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
sys.path[:0] = [str(SOURCE / "packaging"), str(SOURCE / "tests/docs")]
import command_blocks  # noqa: E402
import programs  # noqa: E402

TOOLS = ("dh", "dpkg-deb", "fakeroot", "lintian", "mkdocs")
MISSING = [tool for tool in TOOLS if not shutil.which(tool)]
NAMES = ("swarmsmith", "swarmsmith-doc", "swarmsmith-robot", "swarmsmith-track")
EXAMPLES = "usr/share/doc/swarmsmith/examples"


def run(*words, **keywords):
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          stdin=subprocess.DEVNULL, timeout=1800, **keywords)
    if done.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, words))}: exit code {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def copy_of_sources(folder):
    """The files of the repository that packages are made of, and nothing of what was built from them."""
    tree = folder / "tree"
    shutil.copytree(SOURCE, tree, symlinks=True, ignore=lambda place, names: [
        name for name in names if name == "__pycache__" or (place == str(SOURCE) and name.startswith((".git", "build")))])
    return tree


def make_packages(folder, umask=0o022, changed_at=None, **environment):
    """Packages of the programs in BIN, made in `folder` of files that were changed at a time; where they are."""
    tree = copy_of_sources(folder)
    if changed_at is not None:
        for path in tree.rglob("*"):
            os.utime(path, (changed_at, changed_at), follow_symlinks=False)
    (folder / "built").mkdir()
    (folder / "built/bin").symlink_to(BIN)
    environment = {**os.environ, "SOURCE_DATE_EPOCH": "1750000000", **environment}
    run("packaging/package", folder / "built", cwd=tree, env=environment, umask=umask)
    return folder / "built/packages"


@functools.cache
def made():
    """Packages for all tests of this program."""
    folder = tempfile.TemporaryDirectory(prefix="swarmsmith-packages-")
    unittest.addModuleCleanup(folder.cleanup)
    return make_packages(pathlib.Path(folder.name))


@unittest.skipIf(MISSING, f"not there: {', '.join(MISSING)}; ./dev package installs them")
class Packages(unittest.TestCase):
    def test_are_the_same_bytes_for_everybody(self):
        """Another folder, user's mask, home, language, time zone, number of processors, and files from before the release.
        Their programs are compiled once here; that no path of theirs is in them is asked below."""
        with tempfile.TemporaryDirectory(prefix="other-") as name:
            home = pathlib.Path(name) / "home"
            home.mkdir()
            again = make_packages(pathlib.Path(name), umask=0o077, changed_at=10**9, HOME=str(home), USER="nobody",
                                  LC_ALL="C", LANG="de_DE", TZ="Asia/Tokyo", DEB_BUILD_OPTIONS="parallel=7", XZ_DEFAULTS="-T0",
                                  TAR_OPTIONS="--sort=none")
            names = sorted(path.name for path in made().iterdir())
            self.assertEqual(len(names), len(NAMES), names)
            self.assertEqual(names, sorted(path.name for path in again.iterdir()))
            _, different, wrong = filecmp.cmpfiles(made(), again, names, shallow=False)
            self.assertEqual((different, wrong), ([], []))

    def test_have_programs_without_a_path_of_the_build(self):
        for program in programs.built(BIN):
            data = (BIN / program).read_bytes()
            for path in {str(SOURCE), str(BIN.parent)}:
                self.assertIsNone(re.search(rb"(?<![\w.-])" + re.escape(path).encode() + b"/", data), (program, path))

    def test_have_the_version_of_the_project(self):
        version = re.search(r"^project\(swarmsmith VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
        self.assertEqual({path.name.split("_")[0]: path.name.split("_")[1] for path in made().iterdir()},
                         {name: version for name in NAMES})
        for program in programs.PROGRAMS:
            self.assertRegex(run(BIN / program, "--version"), rf"(?:^| ){re.escape(version)}\b", program)


def why_no_root():
    if os.geteuid() != 0:
        return "a root of its own needs root"
    if not os.environ.get("SWARMSMITH_BARE_ROOT") and not shutil.which("debootstrap"):
        return "debootstrap is not there"
    return ""


class Root:
    """A bare Debian 12 in a folder."""

    def __init__(self, folder):
        self.folder = folder
        ready = os.environ.get("SWARMSMITH_BARE_ROOT")
        if ready:
            run("cp", "-a", ready, folder)
        else:
            try:
                run("debootstrap", "--variant=minbase", "bookworm", folder)
            except AssertionError as failure:
                raise unittest.SkipTest(f"debootstrap could not make a root; is there a network? {failure}") from None
        for place in ("etc/resolv.conf", "etc/apt/sources.list.d", "etc/apt/apt.conf.d", "etc/apt/keyrings"):
            if pathlib.Path("/", place).exists():
                run("cp", "-rLT", f"/{place}", folder / place)
        if (folder / "etc/apt/sources.list.d").exists() and any((folder / "etc/apt/sources.list.d").iterdir()):
            (folder / "etc/apt/sources.list").unlink(missing_ok=True)
        self.call("apt-get", "update", "-q")

    def call(self, *words, network=True):
        """A command in it. Its processes end with it, and no mount of it is seen outside."""
        alone = ["unshare", "--mount", "--pid", "--fork", "--kill-child"] + ([] if network else ["--net"])
        begin = 'mount -t proc proc "$0/proc"; mount -t tmpfs shm "$0/dev/shm"; ' + ("" if network else "ip link set lo up; ")
        return run(*alone, "sh", "-ec", begin + 'exec chroot "$0" "$@"', self.folder, *words,
                   env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
                        "DEBIAN_FRONTEND": "noninteractive", "SYSTEMD_OFFLINE": "1"})

    def shell(self, script, **keywords):
        return self.call("bash", "-ec", script, **keywords)

    def install(self, *what):
        self.call("apt-get", "install", "-q", "-y", *what)

    def files(self):
        """All files and folders, but for what dpkg and its helpers keep of packages in general, and what systemd, dbus and
        adduser leave, which come with libraries that ours need."""
        kept = re.compile(r"var/(?:lib/(?:dpkg|apt|systemd|private)|cache|log|backups)\b|etc/ld\.so\.cache$|tmp/|root/|run/|"
                          r"etc/(?:machine-id|mtab|g?shadow-)$")
        found = set()
        for place, folders, files in os.walk(self.folder):
            inside = os.path.relpath(place, self.folder)
            found.update(os.path.normpath(os.path.join(inside, name)) for name in folders + files)
        return {name for name in found if not kept.match(name)}


def older(packages, folder):
    """The same as version 0.0.1, with a file that later ones do not have."""
    folder.mkdir()
    for path in sorted(packages.iterdir()):
        tree = folder / path.stem
        run("dpkg-deb", "-R", path, tree)
        control = tree / "DEBIAN/control"
        control.write_text(re.sub(r"^Version: .*", "Version: 0.0.1", re.sub(r"\(= [^)]*\)", "(= 0.0.1)", control.read_text()),
                                  flags=re.M))
        name = path.name.split("_")[0]
        (tree / "usr/share/doc" / name / "gone").write_text("x\n")
        run("dpkg-deb", "--root-owner-group", "-Znone", "-b", tree, folder / re.sub("_.*_", "_0.0.1_", path.name))
        shutil.rmtree(tree)


@unittest.skipIf(MISSING, f"not there: {', '.join(MISSING)}; ./dev package installs them")
@unittest.skipIf(why_no_root(), why_no_root())
class BareDebian(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-bare-")
        cls.addClassCleanup(folder.cleanup)
        cls.root = Root(pathlib.Path(folder.name) / "root")
        shutil.copytree(made(), cls.root.folder / "root/new")
        older(made(), cls.root.folder / "root/old")

    def test_from_installation_to_removal(self):
        before = self.root.files()
        self.first_result()
        self.upgrade()
        self.remove()
        self.assertEqual(sorted(self.root.files() - before), [])
        self.install_all("new")
        self.pages_and_completion()
        self.examples()
        self.units()
        self.manual()
        self.remove()
        self.assertEqual([name for name in sorted(self.root.files()) if "swarmsmith" in name], [])

    def install_all(self, folder):
        self.root.install(*(f"/root/{folder}/{path.name}" for path in sorted((self.root.folder / "root" / folder).iterdir())))

    def remove(self):
        """With what came for them, also where something that was there before would like to have it."""
        self.root.shell(f"apt-get purge -q -y {' '.join(NAMES)}; apt-get autoremove -q -y --purge "
                        "-o APT::AutoRemove::RecommendsImportant=false -o APT::AutoRemove::SuggestsImportant=false")

    def first_result(self):
        """From a bare system to the first designed machine in a minute; fetching packages is the network's time."""
        begin = time.monotonic()
        self.root.call("sh", "-c", "apt-get install -q -y --download-only /root/new/swarmsmith_*.deb")
        fetched = time.monotonic()
        self.root.call("sh", "-c", "apt-get install -q -y /root/new/swarmsmith_*.deb")
        installed = time.monotonic()
        said = self.root.shell("cd /root && swarmsmith run")
        ended = time.monotonic()
        self.assertRegex(said, r"d1  color_selection, watermelon, repetition 1: finished after \d+ experiments")
        print(f"\nfetched in {fetched - begin:.1f} s, installed in {installed - fetched:.1f} s, first result "
              f"{ended - installed:.1f} s later", flush=True)
        self.assertLess(ended - fetched, 60)
        self.root.shell("rm /root/demo.db*; apt-get purge -q -y swarmsmith")

    def upgrade(self):
        self.install_all("old")
        self.assertIn("0.0.1", self.root.call("dpkg-query", "-W", "swarmsmith-robot"))
        self.root.shell("cd /root && swarmsmith run --budget 1500")
        self.install_all("new")
        for name in NAMES:
            self.assertNotIn("0.0.1", self.root.call("dpkg-query", "-W", name))
            self.assertFalse((self.root.folder / "usr/share/doc" / name / "gone").exists(), name)
        self.assertIn("watermelon", self.root.shell("cd /root && swarmsmith status demo.db && swarmsmith verify demo.db"))

    def pages_and_completion(self):
        self.root.install("man-db", "bash-completion")
        for page in ("swarmsmith", "swarmsmith-run", "swarmsmith-worker", "swarmsmith-track-score", "swarmsmith-robot-start"):
            self.assertIn("SYNOPSIS", self.root.call("man", page), page)
        # As a shell with bash-completion finds it at the first Tab, and what it then offers.
        offers = ("source /usr/share/bash-completion/bash_completion; _completion_loader {0} || [ $? = 124 ]; "
                  "complete -p {0}; COMP_WORDS=({0} {1}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _swarmsmith_complete; "
                  "echo \"${{COMPREPLY[@]}}\"")
        for program, words, offered in (("swarmsmith", "ver", "verify version"), ("swarmsmith-track", "calibrate ''", "camera"),
                                        ("swarmsmith-robot", "start --design d", "d1"), ("swarmsmith-worker", "--conn", "--connect")):
            self.assertIn(offered, self.root.shell("cd /root; " + offers.format(program, words)), program)
        for name in programs.PROGRAMS:
            for place in ("zsh/vendor-completions/_{}", "fish/vendor_completions.d/{}.fish"):
                self.assertTrue((self.root.folder / "usr/share" / place.format(name)).is_file(), name)

    def examples(self):
        there = self.root.folder / EXAMPLES
        mine = sorted(path.relative_to(SOURCE / "examples") for path in (SOURCE / "examples").rglob("*") if path.is_file())
        self.assertGreater(len(mine), 20)
        for path in mine:
            self.assertEqual((there / path).read_bytes(), (SOURCE / "examples" / path).read_bytes(), path)
            self.assertEqual(os.access(there / path, os.X_OK), os.access(SOURCE / "examples" / path, os.X_OK), path)
        self.root.shell(f"cd /{EXAMPLES}; grep -l '^[[]race]' *.toml */*.toml | xargs -n 1 swarmsmith check")

    def units(self):
        """What docs/cluster.md says, line by line, and then what systemd, which does not run in a folder, would do."""
        self.root.install("systemd", "adduser")
        text = (SOURCE / "docs/cluster.md").read_text()
        coordinator, worker = (block.text.replace("enable --now", "enable") for block in command_blocks.blocks_of(text)
                               if "packages_test.py" in block.reason)
        # The worker's host first: nothing of the other one is there yet, its key neither.
        self.root.shell(f"cd /root; touch worker.key; {worker.replace('10.0.0.7', '127.0.0.1')}\n"
                        f"cp /{EXAMPLES}/color_selection.toml thesis.toml; {coordinator}\n"
                        "install -o swarmsmith -m 600 /etc/swarmsmith/keys/worker.key /etc/swarmsmith/worker.key")
        services = [f"/etc/systemd/system/swarmsmith-{name}.service" for name in ("coordinator", "worker")]
        self.assertNotIn("swarmsmith", self.root.call("systemd-analyze", "verify", *services))
        starts = [re.search(r"^ExecStart=(.*)$", (self.root.folder / unit[1:]).read_text(), re.M)[1] for unit in services]
        said = self.root.shell("install -d -o swarmsmith -g swarmsmith /var/lib/swarmsmith /run/swarmsmith\n"
                               f"runuser -u swarmsmith -- {starts[1]} & runuser -u swarmsmith -- {starts[0]} --budget 1500\n"
                               "wait", network=False)
        self.assertIn("finished after", said)
        self.root.shell("systemctl disable swarmsmith-coordinator swarmsmith-worker\n"
                        f"rm -r {' '.join(services)} /etc/swarmsmith /var/lib/swarmsmith /run/swarmsmith; deluser swarmsmith")

    def manual(self):
        """The site is the one that manual_test opens in a browser."""
        there, made_here = self.root.folder / "usr/share/doc/swarmsmith-doc/html", made().parent / "manual"
        compared = filecmp.dircmp(there, made_here)
        pending = [compared]
        while pending:
            one = pending.pop()
            self.assertEqual((one.left_only, one.right_only, one.diff_files), ([], [], []), one.left)
            pending += one.subdirs.values()
        self.assertGreater(len(list(there.rglob("*.html"))), 50)


if __name__ == "__main__":
    unittest.main()
