"""One turn of the closed loop: film, calibrate, track, compare with the truth."""
import csv
import json
import math
import pathlib
import sqlite3
import subprocess
import time
import tomllib

SYSTEMATIC_M = 0.001  # of a centre, by survey, height and lens, beside the noise that a run shows
INVALID_RUN = 6  # exit code of a run that was stored as INVALID


class Refused(Exception):
    """A program said no."""


class Programs:
    """The programs of a build, run one after the other."""

    def __init__(self, folder, say=lambda line: None):
        self.folder = pathlib.Path(folder)
        self.say = say
        self.seconds = {}  # by what was done, wall clock

    def missing(self):
        wanted = ("film", "swarmsmith-track")
        return [name for name in wanted if not (self.folder / name).exists()]

    def call(self, what, program, *words, accepted=(0,)):
        started = time.monotonic()
        done = subprocess.run([str(self.folder / program), *map(str, words)], text=True,
                              capture_output=True, check=False)
        self.seconds[what] = self.seconds.get(what, 0) + time.monotonic() - started
        self.say(f"$ {program} {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
        if done.returncode not in accepted:
            raise Refused(f"{program} {' '.join(map(str, words))}\n"
                          f"exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done


def clip_of(folder, stem):
    """The video of a stem, whatever its form."""
    for ending in (".mkv", ".avi", ""):
        path = folder / (stem + ending)
        if path.exists():
            return path
    raise FileNotFoundError(f"{folder / stem}: no clip")


class Lab:
    """A filmed laboratory with the calibrations that the program made of its clips. One that is there is taken."""

    def __init__(self, programs, folder, *wishes):
        self.programs = programs
        self.folder = pathlib.Path(folder)
        self.arena = self.folder / "arena.toml"
        if not (self.folder / "truth.json").exists():
            programs.call("film", "film", "lab", self.folder, *wishes)
        self.truth = json.loads((self.folder / "truth.json").read_text())

    def calibrate(self):
        track = "swarmsmith-track"
        for camera in self.truth["cameras"]:
            name = camera["name"]
            self.programs.call("calibrate", track, "calibrate", "camera",
                               self.folder / f"{name}.board", "--board", self.truth["board"], "--camera", name,
                               "--lens", camera["lens"],
                               "-o", self.folder / f"{name}.camera.toml")
            self.programs.call("calibrate", track, "calibrate", "arena",
                               clip_of(self.folder, f"{name}.arena"), "--arena", self.arena,
                               "--camera", name)
        first = self.truth["cameras"][0]["name"]
        for robot in self.truth["robots"]:
            name = robot["name"]
            self.programs.call("calibrate", track, "calibrate", "robot", name,
                               "--arena", self.arena, "--camera", first,
                               "--spin", clip_of(self.folder, f"{name}.spin"),
                               "--straight", clip_of(self.folder, f"{name}.straight"))

    def calibration_errors(self):
        """Differences from the truth, each as (what, number, limit)."""
        for camera in self.truth["cameras"]:
            name = camera["name"]
            model = tomllib.loads((self.folder / f"{name}.camera.toml").read_text())["model"]
            yield (f"{name}: focal length, per mille",
                   1000 * abs(model["fx"] / camera["fx"] - 1), 2)
            place = tomllib.loads((self.folder / f"{name}.place.toml").read_text())
            rotation, moved = place["rotation"], place["translation"]
            centre = [-sum(rotation[3 * row + i] * moved[row] for row in range(3))
                      for i in range(3)]
            yield f"{name}: place, mm", 1000 * math.dist(centre, camera["centre"]), 15
        for robot in self.truth["robots"]:
            name = robot["name"]
            found = tomllib.loads((self.folder / f"{name}.offset.toml").read_text())
            yield f"{name}: offset x, mm", 1000 * abs(found["x"] - robot["x"]), 0.5
            yield f"{name}: offset y, mm", 1000 * abs(found["y"] - robot["y"]), 0.5
            yield (f"{name}: yaw, deg",
                   abs(math.degrees(angle_between(found["yaw_rad"], robot["yaw"]))), 0.3)

    def arena_without_corrections(self, height):
        """As the thesis did it: tags are taken for centres; with `height`, on the floor, too."""
        lines = []
        for line in self.arena.read_text().splitlines():
            if line.startswith("offset ="):
                continue
            if height and line.startswith("height = 0"):
                line = "height = 0.001"
            lines.append(line)
        file = self.folder / ("arena.floor.toml" if height else "arena.centre.toml")
        file.write_text("\n".join(lines) + "\n")
        return file


def angle_between(a, b):
    return math.remainder(a - b, 2 * math.pi)


def trajectory_of(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return {(int(row["cycle"]), int(row["robot"])):
                (float(row["x"]), float(row["y"]), float(row["theta"]))
                for row in csv.DictReader(stream)}


class Outcome:
    """What was measured of a run, beside what is true."""

    def __init__(self, truth, trajectory, store, run_name):
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as base:
            row = base.execute("SELECT id, score, measured_verdict FROM v_real_runs WHERE name = ?",
                               (run_name,)).fetchone()
            self.id, self.score, self.verdict = row
            poses = base.execute("SELECT cycle, robot, x, y, theta FROM v_real_cycles WHERE id = ?",
                                 (self.id,)).fetchall()
            self.sigmas = [sigma or 0 for sigma, in base.execute(
                "SELECT sigma_m FROM v_real_robots WHERE id = ? ORDER BY robot", (self.id,))]
            self.found = base.execute(
                "SELECT sum(measured) * 1.0 / sum(measured + interpolated + degraded + missing) "
                "FROM v_real_robots WHERE id = ?", (self.id,)).fetchone()[0]
            self.reasons = base.execute(
                "SELECT reasons FROM v_real_scores WHERE id = ? ORDER BY scoring DESC LIMIT 1",
                (self.id,)).fetchone()[0]
            self.latencies = base.execute(
                "SELECT name, latency_s, latency_error_s, latency_reason FROM v_real_logs WHERE id = ? ORDER BY robot",
                (self.id,)).fetchall()
        self.truth = truth
        true_poses = trajectory_of(trajectory)
        squares = turns = 0.0
        self.worst_mm = 0.0
        for cycle, robot, x, y, theta in poses:
            true = true_poses[(cycle, robot)]
            off = 1000 * math.hypot(x - true[0], y - true[1])
            squares += off * off
            turns += math.degrees(angle_between(theta, true[2])) ** 2
            self.worst_mm = max(self.worst_mm, off)
        if len(poses) != len(true_poses):
            raise AssertionError(f"{run_name}: {len(poses)} poses, {len(true_poses)} are true")
        self.rms_mm = math.sqrt(squares / len(poses))
        self.heading_deg = math.sqrt(turns / len(poses))

    def is_grid(self):
        return self.truth["mission"].startswith("grid")

    def score_error(self):
        """Relative to the truth, where scores are continuous; else the difference."""
        difference = self.score - self.truth["score"]
        return difference / abs(self.truth["score"]) if self.is_grid() else difference

    def latency_ms(self):
        """The worst difference of a robot's latency from the truth; none where it cannot be told, or varies."""
        if self.truth["latency_s"] is None:
            return None
        off = [1000 * (found - self.truth["latency_s"]) for _, found, _, _ in self.latencies if found is not None]
        return max(off, key=abs) if off else None

    def too_close(self):
        """Robots whose true end is so near to another score that neither can be preferred."""
        return [robot for robot, (border, sigma) in
                enumerate(zip(self.truth["borders"], self.sigmas))
                if border < 3 * max(sigma, SYSTEMATIC_M)]

    def score_is_right(self):
        if self.is_grid():
            return abs(self.score_error()) <= 0.01
        return self.score == self.truth["score"] or bool(self.too_close())


class Run:
    """A simulated run, filmed in a lab."""

    def __init__(self, lab, name, *wishes):
        self.lab = lab
        self.name = name
        stem = lab.folder / name
        lab.programs.call("film", "film", "run", stem, "--lab", lab.folder, *wishes)
        self.log = stem.with_suffix(".toml")
        self.trajectory = lab.folder / f"{name}.trajectory.csv"
        self.truth = json.loads((lab.folder / f"{name}.truth.json").read_text())

    def score(self, *words, arena=None, label=""):
        """Tracks and scores into a store of its own; what came of it."""
        store = self.lab.folder / f"{self.name}{label}.db"
        store.unlink(missing_ok=True)
        self.lab.programs.call("track", "swarmsmith-track", "score", "--arena",
                               arena or self.lab.arena, "--run", self.log, "--into", store, *words,
                               accepted=(0, INVALID_RUN))
        return Outcome(self.truth, self.trajectory, store, self.name)

    def remove_videos(self):
        for file in self.lab.folder.glob(f"{self.name}*"):
            if file.suffix in (".mkv", ".avi", ".db"):
                file.unlink()
