"""`swarmsmith track overlay` and `swarmsmith track live` on a filmed run of two seconds, with lens
and offsets that are true of its virtual laboratory."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import urllib.error
import urllib.request

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))  # see programs.py
TRACK, FILM = str(BIN / "swarmsmith-track"), str(BIN / "film")
MACHINE = "--nstates 1 --s0 0 --rwm0 20"
PNG = b"\x89PNG\r\n\x1a\n"

CAMERA = """format = 1
kind = "camera"
made = "2026-11-21T12:00:00Z"
board = "none: the truth"
views = 20
views_dropped = 0
rms_px = 0.05
worst_view_px = 0.08
coverage = 0.9
focal_sigma_px = 0.1

[model]
width = {width}
height = {height}
lens = "pinhole"
fx = {fx!r}
fy = {fy!r}
cx = {cx!r}
cy = {cy!r}
distortion = {distortion}
"""
OFFSET = """format = 1
kind = "offset"
made = "2026-11-21T12:00:00Z"
robot = "{name}"
tag = {tag}
edge = {edge!r}
height = {height!r}
x = {x!r}
y = {y!r}
has_yaw = true
yaw_rad = {yaw!r}
rms_m = 0.0002
sigma_x_m = 0.0001
sigma_y_m = 0.0001
drift_m_s = 0.001
turned_rad = 13.0
samples = 120
"""


def write_calibrations(lab):
    truth = json.loads((lab / "truth.json").read_text())
    width, height = truth["size"]
    for camera in truth["cameras"]:
        (lab / f"{camera['name']}.camera.toml").write_text(
            CAMERA.format(width=width, height=height, **camera))
    for robot in truth["robots"]:
        (lab / f"{robot['name']}.offset.toml").write_text(OFFSET.format(**robot))


def track(*words, cwd, timeout=200):
    return subprocess.run([TRACK, *map(str, words)], capture_output=True, text=True,
                          errors="replace", timeout=timeout * PATIENCE, cwd=cwd)


class OverlayAndLive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="swarmsmith-overlay-")
        cls.lab = pathlib.Path(cls.folder.name) / "lab"
        for words in (["lab", cls.lab, "--views", "1", "--form", "h264", "--seed", "3"],
                      ["run", cls.lab / "run01", "--lab", cls.lab, "--mission", "aggregation", "--machine",
                       MACHINE, "--seconds", "2", "--fps", "10", "--before", "0.5", "--after", "0.5",
                       "--form", "h264", "--seed", "3"]):
            done = subprocess.run([FILM, *map(str, words)], capture_output=True, text=True,
                                  timeout=300 * PATIENCE)
            assert done.returncode == 0, done.stderr
        write_calibrations(cls.lab)
        placed = track("calibrate", "arena", "ceiling.arena.mkv", "--arena", "arena.toml",
                       cwd=cls.lab)
        assert placed.returncode == 0, placed.stderr
        cls.video = next(f.name for f in cls.lab.iterdir()
                         if re.fullmatch(r"run01\.(mkv|mp4)", f.name))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def words(self, *more):
        return ["overlay", self.video, "--arena", "arena.toml", "--run", "run01.toml", *more]

    def test_a_video_of_all_frames_about_the_run(self):
        done = track(*self.words("-o", "over.mp4", "--json"), cwd=self.lab)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreaterEqual(json.loads(done.stdout)["frames"], 25)
        # It is a video that can be read.
        again = track("record", "over.mp4", "again.mkv", "--json", cwd=self.lab)
        self.assertEqual(json.loads(again.stdout)["frames"], json.loads(done.stdout)["frames"])

    def test_one_picture_of_a_stored_run_is_that_of_its_video(self):
        done = track(*self.words("--at", "1.5", "-o", "video.png"), cwd=self.lab)
        self.assertEqual(done.returncode, 0, done.stderr)
        scored = track("score", self.video, "--arena", "arena.toml", "--run", "run01.toml",
                       "--into", "runs.db", cwd=self.lab)
        self.assertIn(scored.returncode, (0, 6), scored.stderr)
        stored = track("overlay", "r1", "--store", "runs.db", "--at", "1.5 s", "-o", "stored.png",
                       cwd=self.lab)
        self.assertEqual(stored.returncode, 0, stored.stderr)
        picture = (self.lab / "video.png").read_bytes()
        self.assertTrue(picture.startswith(PNG))
        # Stores keep corners to a thousandth of a pixel, so that single bytes may differ.
        self.assertAlmostEqual((self.lab / "stored.png").stat().st_size, len(picture),
                               delta=len(picture) / 50)

    def test_what_cannot_be_drawn_says_what_to_do(self):
        shutil.copy(self.lab / "ceiling.arena.mkv", self.lab / "other.mkv")
        track("score", self.video, "--arena", "arena.toml", "--run", "run01.toml", "--into",
              "runs.db", cwd=self.lab)
        for words, code, said in (
                ([self.video, "-o", "x.mp4"], 2, "--arena"),
                (["r1", "-o", "x.mp4"], 2, "SWARMSMITH_STORE"),
                (["r9", "--store", "runs.db", "-o", "x.mp4"], 4, "no real run r9"),
                (["r1", "--store", "runs.db", "--video", "other.mkv", "-o", "x.mp4"], 1,
                 "not the video"),
                (["r1", "--store", "runs.db", "--at", "soon", "-o", "x.png"], 2, "--at"),
                (["r1", "--store", "runs.db", "--at", "99", "-o", "x.png"], 2,
                 "no frame there: it shows the run from -0.5"),
                (["r1", "--store", "runs.db", "--at=-0.7", "-o", "x.png"], 2,
                 "no frame there: it shows the run from -0.5"),
                (["r1", "--store", "runs.db", "--at", "5 m", "-o", "x.png"], 2, "--at"),
                (["r1", "--store", "runs.db", "--camera", "west", "-o", "x.mp4"], 2, "west")):
            done = track("overlay", *words, cwd=self.lab)
            self.assertEqual(done.returncode, code, (words, done.stderr))
            self.assertIn(said, done.stderr)
        self.assertFalse((self.lab / "x.mp4").exists())
        self.assertFalse((self.lab / "x.png").exists())

    def test_a_preview_while_it_plays_and_delays_at_its_end(self):
        live = subprocess.Popen([TRACK, "live", "--arena", "arena.toml", "--camera", self.video,
                                 "--mission", "aggregation", "--port", "0", "--record", "seen.mkv",
                                 "--json"], cwd=self.lab, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)
        try:
            address = re.search(r"http://127\.0\.0\.1:\d+/", live.stderr.readline()).group()
            state = self.state_with_robots(address)
            self.assertEqual([robot["name"] for robot in state["robots"]], ["rvr1", "rvr2", "rvr3"])
            self.assertEqual(state["references"], 6)
            for robot in state["robots"]:
                self.assertLess(abs(robot["x"]), 1.3)
            said, _ = live.communicate(timeout=120 * PATIENCE)
        finally:
            live.kill()
            live.wait()
        result = json.loads(said)
        self.assertEqual(live.returncode, 0)
        self.assertGreaterEqual(result["frames"] + result["dropped"], 25)
        self.assertGreater(result["delay_ms"]["median"], 0)
        rows = (self.lab / "seen.times.csv").read_text().splitlines()
        self.assertEqual(len(rows), 1 + result["frames"] + result["dropped"])
        again = track("record", "seen.mkv", "copy.mkv", "--json", cwd=self.lab)
        self.assertEqual(json.loads(again.stdout)["frames"], result["frames"] + result["dropped"])

    def state_with_robots(self, address):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            try:
                with urllib.request.urlopen(address + "state.json", timeout=10) as answer:
                    state = json.load(answer)
                if all("x" in robot for robot in state["robots"]):
                    return state
            except urllib.error.HTTPError:
                pass  # No frame came yet.
            time.sleep(0.02)
        self.fail("no state with all robots")

    def test_ctrl_c_ends_it_well(self):
        live = subprocess.Popen([TRACK, "live", "--arena", "arena.toml", "--camera", self.video,
                                 "--port", "0"], cwd=self.lab, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)
        try:
            live.stderr.readline()
            live.send_signal(signal.SIGINT)
            said, _ = live.communicate(timeout=60 * PATIENCE)
        finally:
            live.kill()
            live.wait()
        self.assertEqual(live.returncode, 0)
        self.assertRegex(said, r"frames?, ")

    def test_wrong_words_are_named(self):
        for words, code, said in (
                (["--arena", "arena.toml", "--camera", "nothing.mp4"], 1, "E_VIDEO_UNREADABLE"),
                (["--arena", "none.toml", "--camera", self.video], 2, "none.toml"),
                (["--arena", "arena.toml", "--camera", self.video, "--view", "west"], 2, "ceiling"),
                (["--arena", "arena.toml", "--camera", self.video, "--mission", "chess"], 2,
                 "chess")):
            done = track("live", "--port", "0", *words, cwd=self.lab)
            self.assertEqual(done.returncode, code, (words, done.stderr))
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
