"""Calibrations by the program, from pictures and videos of a rendered laboratory whose truth is
known (the program film)."""
import json
import math
import pathlib
import re
import resource
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

from programs import BIN, PATIENCE, ended_well

BOARD = "charuco:9x6:0.04:0.03:4x4_50"


def track(*words, cwd=None, **more):
    return subprocess.run([BIN / "swarmsmith-track", *map(str, words)], capture_output=True,
                          text=True, timeout=120 * PATIENCE, cwd=cwd, **more)


class Rendered:
    """The laboratory, rendered and calibrated once for all tests."""
    folder = root = truth = camera = place = offset = None


def answer(*words):
    run = track(*words, "--json", cwd=Rendered.root)
    if run.returncode != 0:
        raise AssertionError(run.stderr)
    return json.loads(run.stdout)


def setUpModule():
    Rendered.folder = tempfile.TemporaryDirectory()
    Rendered.root = pathlib.Path(Rendered.folder.name) / "lab"
    subprocess.run([BIN / "film", "lab", Rendered.root, "--robots", "1", "--size", "960x540",
                    "--form", "mjpg"], check=True, timeout=300 * PATIENCE)
    Rendered.truth = json.loads((Rendered.root / "truth.json").read_text())
    Rendered.camera = answer("calibrate", "camera", "ceiling.board", "--board", BOARD, "--map",
                             "map.svg", "--arena", "arena.toml")
    Rendered.place = answer("calibrate", "arena", "ceiling.arena.avi", "--arena", "arena.toml")
    Rendered.offset = answer("calibrate", "robot", "rvr1", "--spin", "rvr1.spin.avi",
                             "--straight", "rvr1.straight.avi", "--arena", "arena.toml")


def tearDownModule():
    Rendered.folder.cleanup()


class Laboratory(unittest.TestCase):
    """Each test has its own copy of the files, without what is big."""

    @property
    def root(self):
        return Rendered.root

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.copy = pathlib.Path(temporary.name)
        for file in self.root.glob("*.toml"):
            shutil.copy(file, self.copy)
        self.arena = self.copy / "arena.toml"

    def replace(self, file, old, new):
        path = self.copy / file
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))

    def refused(self, code, words, *texts):
        """The command fails, says so in these words, and every file stays as it was."""
        before = {file: file.read_bytes() for file in self.copy.iterdir()}
        run = track(*words, cwd=self.copy)
        self.assertEqual(run.returncode, code, run.stderr)
        for text in texts:
            self.assertIn(text, run.stderr)
        self.assertEqual(before, {file: file.read_bytes() for file in self.copy.iterdir()})


class Truth(Laboratory):
    def test_the_lens_is_that_of_the_camera(self):
        true = Rendered.truth["cameras"][0]
        self.assertLess(Rendered.camera["rms_px"], 0.12)
        for key in ("fx", "fy"):
            self.assertLess(abs(Rendered.camera[key] / true[key] - 1), 0.002, key)
        for key in ("cx", "cy"):
            self.assertLess(abs(Rendered.camera[key] - true[key]), 0.8, key)
        self.assertGreaterEqual(Rendered.camera["views_used"], 18)
        self.assertGreater(min(Rendered.camera["ninths"]), 0)
        self.assertTrue(Rendered.camera["views"][0]["name"].endswith("view00.png"))
        self.assertIn("</svg>", (self.root / "map.svg").read_text())

    def test_the_camera_hangs_where_it_hangs(self):
        for found, true in zip(Rendered.place["camera"], Rendered.truth["cameras"][0]["centre"]):
            self.assertLess(abs(found - true), 0.006)
        self.assertLess(Rendered.place["rms_px"], 0.25)
        self.assertEqual(len(Rendered.place["tags"]), 6)

    def test_the_tag_sits_where_it_sits(self):
        true = Rendered.truth["robots"][0]
        self.assertLess(abs(Rendered.offset["x_m"] - true["x"]), 0.0005)
        self.assertLess(abs(Rendered.offset["y_m"] - true["y"]), 0.0005)
        self.assertLess(abs(Rendered.offset["yaw_rad"] - true["yaw"]), math.radians(0.5))

    def test_the_arena_is_ready_then(self):
        run = ended_well(track("check", "arena.toml", "--json", cwd=self.root))
        self.assertTrue(json.loads(run.stdout)["ready"])


class Live(Laboratory):
    def test_the_preview_says_what_the_board_covers_so_far(self):
        # Pictures come at the pace of a video; how many of them are dropped is the machine's.
        run = ended_well(track("live", "--arena", self.arena, "--camera", self.root / "ceiling.board",
                               "--board", BOARD, "--port", "0"))
        said = re.search(r"board: (\d+) views?, (\d) of 9 ninths, (\d+) % of the frame", run.stderr)
        self.assertIsNotNone(said, run.stderr)
        views, ninths, share = map(int, said.groups())
        self.assertGreater(views, 0)
        self.assertGreater(ninths, 0)
        self.assertGreater(share, 0)

    def test_a_board_that_is_none(self):
        self.refused(2, ["live", "--arena", self.arena, "--camera", self.root / "ceiling.board",
                         "--board", "chess", "--port", "0", "--record", self.copy / "x.mkv"], "board")

    def test_a_recording_leaves_out_pictures_within_a_millisecond(self):
        pictures = self.copy / "pictures"
        pictures.mkdir()
        for number, micros in enumerate((0, 100_000, 100_300, 200_000, 300_000)):
            write_picture(pictures / f"{1_700_000_000_000_000 + micros}.png", [], [])
        ended_well(track("live", "--arena", self.arena, "--camera", pictures, "--port", "0",
                         "--record", self.copy / "x.mkv"))
        rows = (self.copy / "x.times.csv").read_text().splitlines()
        self.assertEqual(rows, ["frame,time_s", "0,0.000000", "1,0.100000", "2,0.200000", "3,0.300000"])

    def test_a_recording_without_a_frame_leaves_no_file(self):
        def no_room():
            resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))
        run = track("live", "--arena", self.arena, "--camera", self.root / "ceiling.board", "--port", "0",
                    "--record", self.copy / "x.mkv", restore_signals=False,  # Python ignores SIGXFSZ
                    preexec_fn=no_room)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("x.mkv: cannot be written: File too large", run.stderr)
        self.assertEqual(list(self.copy.glob("x.*")), [])

    def test_a_place_of_another_lens_is_not_used(self):
        self.replace("ceiling.camera.toml", 'made = "2026', 'made = "2036')
        run = ended_well(track("live", "--arena", self.arena, "--camera", self.root / "rvr1.spin.avi", "--port", "0"))
        self.assertRegex(run.stderr, r"note: .*ceiling\.place\.toml: .*another calibration than ceiling\.camera\.toml")


def cells_of_tag(folder, tag):
    """The tag's 8 x 8 cells, True where black, from the sheet that is printed."""
    sheet = folder / f"tag{tag}.svg"
    run = track("print", "tags", "--ids", tag, "--edge", "0.10", "-o", sheet)
    assert run.returncode == 0, run.stderr
    # Rows of strokes: "M x y", "m dx dy", "h length", in mm of a sheet.
    path = next(text for text in re.findall(r'd="(M[^"]*h[^"]*)"', sheet.read_text()))
    edge, left, cells = 12.5, None, [[False] * 8 for _ in range(8)]
    x = y = top = 0.0
    for word, numbers in re.findall(r"([Mmh])([^Mmh]*)", path):
        values = [float(number) for number in re.findall(r"-?[0-9.]+", numbers)]
        if word == "h":
            for k in range(round(values[0] / edge)):
                cells[round((y - top) / edge)][round((x - left) / edge) + k] = True
            x += values[0]
            continue
        x, y = (values[0], values[1]) if word == "M" else (x + values[0], y + values[1])
        if left is None:
            left, top = x, y
    return cells


def write_picture(file, cells, places, mirrored=False, size=(960, 540), cell=6):
    """A grey PNG with one tag at each of the places, upright."""
    rows = [bytearray(b"\xc0" * size[0]) for _ in range(size[1])]
    for left, top in places:
        for y in range(-cell, 9 * cell):
            for x in range(-cell, 9 * cell):
                inside = 0 <= x < 8 * cell and 0 <= y < 8 * cell
                black = inside and cells[y // cell][x // cell]
                rows[top + y][left + x] = 0x10 if black else 0xf0
    lines = b"".join(b"\0" + (row[::-1] if mirrored else row) for row in rows)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    file.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", *size, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


class Pictures(Laboratory):
    """What people put before the camera, and the advice that they get."""
    places = [(90 + 200 * column, 60 + 160 * row) for row in range(3) for column in range(4)]

    def test_twelve_floor_tags_of_one_number(self):
        pictures = pathlib.Path(tempfile.mkdtemp(dir=self.copy.parent))
        self.addCleanup(shutil.rmtree, pictures)
        cells = cells_of_tag(pictures, 100)
        write_picture(pictures / "same.png", cells, self.places)
        self.refused(1, ["calibrate", "arena", pictures / "same.png", "--arena", self.arena],
                     "tag 100 is in the picture 12 times, but each floor tag needs its own number")
        seen = json.loads(track("detect", pictures / "same.png", "--json").stdout)
        self.assertEqual([(tag["tag"], tag["twice"]) for tag in seen["tags"]], [(100, 1)])

    def test_a_mirrored_picture(self):
        pictures = pathlib.Path(tempfile.mkdtemp(dir=self.copy.parent))
        self.addCleanup(shutil.rmtree, pictures)
        cells = cells_of_tag(pictures, 100)
        write_picture(pictures / "mirrored.png", cells, self.places[:3], mirrored=True)
        self.refused(1, ["calibrate", "arena", pictures / "mirrored.png", "--arena", self.arena],
                     "mirror")
        run = track("detect", pictures / "mirrored.png", "--json")
        self.assertEqual(json.loads(run.stdout)["tags"], [])
        self.assertTrue(json.loads(run.stdout)["mirrored"])


class Cameras(Laboratory):
    def calibrate(self, *pictures, board=BOARD):
        return ["calibrate", "camera", *pictures, "--board", board, "-o", "new.toml"]

    def test_eight_pictures_are_too_few(self):
        pictures = sorted((self.root / "ceiling.board").iterdir())[:8]
        self.refused(1, self.calibrate(*pictures), "E_CALIB_QUALITY: 8 usable views",
                     "at least 10")

    def test_another_board_is_not_there(self):
        self.refused(1, self.calibrate(self.root / "ceiling.board",
                                       board="charuco:9x6:0.04:0.03:6x6_250"),
                     "the board is in 0 of 22 pictures", "E_CALIB_QUALITY: only 0 views")

    def test_a_wrong_square_shows_nowhere_but_a_wrong_shape_does(self):
        # Squares of another size only scale the world before the camera: f stays the same.
        pictures = self.root / "ceiling.board"
        run = ended_well(track(*self.calibrate(pictures, board="charuco:9x6:0.08:0.06:4x4_50"), "--json",
                               cwd=self.copy))
        self.assertLess(abs(json.loads(run.stdout)["fx"] / Rendered.camera["fx"] - 1), 0.001)
        self.refused(1, self.calibrate(pictures, board="charuco:6x9:0.04:0.03:4x4_50"),
                     "E_CALIB_QUALITY")

    def test_a_video_without_a_board(self):
        self.refused(1, self.calibrate(self.root / "ceiling.arena.avi"), "E_CALIB_QUALITY")

    def test_a_place_of_the_last_lens_is_to_be_found_again(self):
        run = ended_well(track("calibrate", "camera", self.root / "ceiling.board", "--board", BOARD,
                               "--arena", "arena.toml", cwd=self.copy))
        self.assertIn("Corners in each ninth", run.stdout)
        self.assertIn("calibrate arena --again --arena arena.toml", run.stderr)

    def test_wrong_words(self):
        self.refused(2, [*self.calibrate("x.png"), "--arena", "arena.toml", "--camera", "floor"],
                     "no camera \"floor\"")
        self.refused(2, self.calibrate("x.png", board="charuco:9x6"), "E_CONFIG", "charuco:11x8")
        self.refused(1, self.calibrate("nowhere.avi"), "E_VIDEO_UNREADABLE", "nowhere.avi")


class Arenas(Laboratory):
    def calibrate(self):
        return ["calibrate", "arena", self.root / "ceiling.arena.avi", "--arena", "arena.toml"]

    AGAIN = ["calibrate", "arena", "--again", "--arena", "arena.toml"]

    def test_tags_that_are_not_there_are_named(self):
        for tag in (100, 102, 104):
            self.replace("arena.toml", f"tag = {tag}", f"tag = {tag + 100}")
        self.refused(1, self.calibrate(), "E_REF_TAGS", "seen: 101, 103, 105",
                     "missing: 200, 202, 204")

    def test_a_wrong_survey_is_named_and_mended_without_the_video(self):
        good = self.arena.read_text()
        head, tail = good.split("tag = 103\nx = ")
        x = float(tail.split("\n")[0])
        self.arena.write_text(f"{head}tag = 103\nx = {x + 0.03:.4f}\n" + tail.split("\n", 1)[1])
        for words in (self.calibrate(), self.AGAIN):
            self.refused(1, words, "E_EXTRINSICS", "worst is tag 103")
        self.arena.write_text(good)
        before = (self.copy / "ceiling.place.toml").read_text()
        ended_well(track(*self.AGAIN, cwd=self.copy))
        after = (self.copy / "ceiling.place.toml").read_text()
        without_date = lambda text: [line for line in text.splitlines() if "made" not in line]
        self.assertEqual(without_date(before), without_date(after))

    def test_a_film_in_chapters_counts_as_long_as_another(self):
        pictures = pathlib.Path(tempfile.mkdtemp(dir=self.copy.parent))
        self.addCleanup(shutil.rmtree, pictures)
        # A sheet that someone carries through the picture for a second.
        cells = cells_of_tag(pictures, 100)
        for name, places, count in (("1", [(90, 60), (290, 60)], 25), ("2", [(90, 60)], 180)):
            folder = pictures / name
            folder.mkdir()
            write_picture(folder / "0.png", cells, places)
            for number in range(1, count):
                (folder / f"{number}.png").symlink_to("0.png")
            ended_well(track("record", folder, pictures / f"{name}.mkv", "--rate", "25"))
            shutil.rmtree(folder)
        for other in (*pictures.glob("*.csv"), *pictures.glob("*.svg")):
            other.unlink()
        self.refused(1, ["calibrate", "arena", pictures, "--arena", self.arena], "E_REF_TAGS", "seen: 100", "missing: 101")

    def test_another_size(self):
        for old, new in (("width = 960", "width = 1280"), ("height = 540", "height = 720"),
                         ("cx = ", "cx = 640 #"), ("cy = ", "cy = 360 #")):
            self.replace("ceiling.camera.toml", old, new)
        self.refused(1, self.calibrate(), "E_CALIB_SIZE", "calibration 1280x720, video 960x540")

    def test_a_camera_out_of_its_range(self):
        self.replace("arena.toml", "height = [1.5, 4.5]", "height = [3.0, 4.5]")
        self.refused(1, self.calibrate(), "E_EXTRINSICS", "allowed is 3 to 4.5 m")

    def test_without_a_lens_or_a_place(self):
        (self.copy / "ceiling.place.toml").unlink()
        self.refused(2, self.AGAIN, "E_CONFIG", "--again needs an earlier calibration")
        (self.copy / "ceiling.camera.toml").unlink()
        self.refused(2, self.calibrate(), "E_CONFIG", "not calibrated yet")
        self.refused(2, ["calibrate", "arena", "--arena", "arena.toml"], "--again")
        self.refused(2, [*self.calibrate(), "--camera", "sealing"], "no camera \"sealing\"",
                     "did you mean \"ceiling\"")


class Robots(Laboratory):
    def calibrate(self, name="rvr1", spin="rvr1.spin.avi"):
        return ["calibrate", "robot", name, "--spin", self.root / spin, "--arena", "arena.toml"]

    def test_a_straight_run_is_no_spin(self):
        self.refused(1, self.calibrate(spin="rvr1.straight.avi"), "E_SPIN_QUALITY",
                     "at least 300")

    def test_a_spin_is_no_straight_run(self):
        self.refused(1, [*self.calibrate(), "--straight", self.root / "rvr1.spin.avi"],
                     "E_SPIN_QUALITY", "straight run is 0.0")

    def test_a_tag_of_another_size(self):
        self.replace("arena.toml", "edge = 0.1\nheight", "edge = 0.12\nheight")
        self.refused(1, self.calibrate(), "E_TAG_SIZE", "120.0 mm are declared")

    def test_a_tag_that_is_never_seen(self):
        self.replace("arena.toml", "tag = 1\n", "tag = 7\n")
        self.refused(1, self.calibrate(), "E_ROBOT_MISSING", "tag 7")

    def test_a_place_of_another_lens(self):
        self.replace("ceiling.camera.toml", 'made = "2026', 'made = "2036')
        self.refused(1, self.calibrate(), "E_CALIB_QUALITY", "ceiling.place.toml",
                     "was found with another calibration than ceiling.camera.toml")

    def test_a_tag_outside_of_the_body(self):
        self.refused(1, [*self.calibrate(), "--kind", "epuck"], "E_SPIN_QUALITY",
                     "more than the robot's radius of 35.00 mm")

    def test_wrong_words(self):
        self.refused(2, [*self.calibrate(), "--kind", "epuk"], "robot `epuk`", "epuck")
        self.refused(2, self.calibrate(name="rvr9"), "no robot \"rvr9\"", "it has: rvr1")
        self.refused(2, [*self.calibrate(), "--reverse"], "--straight")
        (self.copy / "ceiling.place.toml").unlink()
        self.refused(2, self.calibrate(), "E_CONFIG", "calibrate arena")


if __name__ == "__main__":
    unittest.main()
