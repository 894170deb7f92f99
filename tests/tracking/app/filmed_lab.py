"""A filmed laboratory with calibrations, made once for each build and kept in its folder, and runs in it."""
import fcntl
import hashlib
import os
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
TRACK = BIN / "swarmsmith-track"
FILM = BIN / "film"
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))
BOARD = "charuco:9x6:0.04:0.03:4x4_50"


def call(program, *words, cwd=None, timeout=300, **more):
    """Runs a program to its end, output as text."""
    environment = {name: value for name, value in os.environ.items() if name != "SWARMSMITH_STORE"}
    return subprocess.run([str(program), *map(str, words)], capture_output=True, text=True,
                          errors="replace", timeout=timeout * PATIENCE, cwd=cwd, env=environment, check=False,
                          **more)


def must(program, *words):
    done = call(program, *words)
    if done.returncode != 0:
        raise RuntimeError(f"{program} {words}: exit code {done.returncode}\n{done.stderr}")
    return done


class FilmedLab:
    """Folder `lab` with arena.toml and its calibrations; clips are filmed when first asked for. Made in setUpModule, and
    gone with the module's tests."""
    WISHES = ()  # of `film lab`

    def __init__(self):
        if not (TRACK.exists() and FILM.exists()):
            raise unittest.SkipTest("skipped: swarmsmith-track or film is not built")
        self.temporary = tempfile.TemporaryDirectory(prefix="track-")
        unittest.addModuleCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)
        self.lab = self.folder / "lab"
        shutil.copytree(self.kept(), self.lab)

    def kept(self):
        """The lab that everybody copies."""
        key = hashlib.sha256(FILM.read_bytes() + TRACK.read_bytes()).hexdigest()[:24] + "".join(self.WISHES)
        cache = BIN.parent / "filmed_labs"
        cache.mkdir(exist_ok=True)
        with (cache / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not (cache / key).exists():
                with tempfile.TemporaryDirectory(dir=cache) as folder:
                    self.make(pathlib.Path(folder) / "lab").rename(cache / key)
        return cache / key

    @classmethod
    def make(cls, lab):
        must(FILM, "lab", lab, "--size", "960x540", "--robots", "3", "--fps", "15", *cls.WISHES)
        must(TRACK, "calibrate", "camera", lab / "ceiling.board", "--board", BOARD,
             "--camera", "ceiling", "-o", lab / "ceiling.camera.toml")
        arena = lab / "arena.toml"
        must(TRACK, "calibrate", "arena", lab / "ceiling.arena.mkv", "--arena", arena,
             "--camera", "ceiling")
        for robot in ("rvr1", "rvr2", "rvr3"):
            must(TRACK, "calibrate", "robot", robot, "--arena", arena, "--camera", "ceiling",
                 "--spin", lab / f"{robot}.spin.mkv", "--straight", lab / f"{robot}.straight.mkv")
        return lab

    def close(self):
        self.temporary.cleanup()

    def film(self, name, *wishes, mission="aggregation", machine="tA1", seconds=3, seed=3):
        """The path of the run log of a clip."""
        log = self.folder / "runs" / f"{name}.toml"
        if not log.exists():
            must(FILM, "run", self.folder / "runs" / name, "--lab", self.lab, "--mission", mission,
                 "--machine", machine, "--seed", seed, "--seconds", seconds, *wishes)
        return log

    def copy_of_lab(self, name, **changes):
        """A copy of the lab's files with texts replaced: file=(before, after), _ for `.`."""
        copy = self.folder / name
        copy.mkdir()
        for file in self.lab.glob("*.toml"):
            shutil.copy(file, copy)
        for file, pairs in changes.items():
            path = copy / file.replace("_", ".")
            text = path.read_text()
            for before, after in pairs:
                assert before in text, f"{path.name} has no {before!r}"
                text = text.replace(before, after, 1)
            path.write_text(text)
        return copy / "arena.toml"


def runs_in(store):
    """Name, measured verdict and score of the runs that a store holds; none without a store."""
    if not pathlib.Path(store).exists():
        return []
    with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as base:
        return base.execute(
            "SELECT name, measured_verdict, score FROM v_real_runs ORDER BY run").fetchall()
