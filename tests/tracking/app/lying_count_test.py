"""Counts films: those that lie are not VALID, and the cause is named; those that are only ugly are VALID, and right.
A film lies when its score would be wrong. A table of all is printed at the end."""
import json
import re
import unittest

from filmed_lab import BIN, BOARD, FILM, TRACK, FilmedLab, call, must
from lying_lab_test import pushed_aside, turned

REFILM = BIN / "refilm"
RATE = 15
SECONDS = 20
LAB = None
TABLE = []


def setUpModule():
    global LAB
    if not REFILM.exists():
        raise unittest.SkipTest("skipped: refilm is not built")
    LAB = FilmedLab()


def tearDownModule():
    print(f"\n{'film':34} {'verdict':9} {'score off':>9}  codes")
    for name, verdict, off, codes in TABLE:
        print(f"{name:34} {verdict:9} {off:>9}  {' '.join(sorted(codes))}")
    print(f"{len(TABLE)} films")


class Films(unittest.TestCase):
    def setUp(self):
        self.folder = LAB.folder / self.id().rsplit(".", 1)[-1]
        self.folder.mkdir()
        self.last_score = None
        self.last_text = ""

    def true_film(self, *wishes, name="true", lab=None):
        keep, LAB.lab = LAB.lab, lab or LAB.lab
        try:
            return LAB.film(name, "--robot-logs", *wishes, mission="grid_exploration", seconds=SECONDS)
        finally:
            LAB.lab = keep

    def answer(self, name, log, truth, lab=None):
        """Verdict and codes; a refusal is one, too."""
        done = call(TRACK, "score", "--run", log, "--arena", (lab or LAB.lab) / "arena.toml", "--json")
        self.assertIn(done.returncode, (0, 1, 2, 6), f"{name}: {done.stderr}")
        self.last_text = done.stdout + done.stderr
        if done.returncode in (1, 2):
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            verdict, score, codes = "REFUSED", None, set(re.findall(r"\b[EW]_[A-Z_]+", done.stderr))
        else:
            found = json.loads(done.stdout)
            verdict, score, codes = found["verdict"], found["score"], {issue["code"] for issue in found["issues"]}
        self.last_score = score
        off = f"{100 * (score / truth - 1):+.2f} %" if score is not None else "-"
        TABLE.append((name, verdict, off, codes))
        return verdict, codes

    def truth(self, log):
        return json.loads(log.with_suffix(".truth.json").read_text())["score"]

    def again(self, name, writer, rate, *frames, ending=".mkv", length=False, logs=False):
        """The log of the true film written again, without a sidecar. `length` says how long the camera ran."""
        log = self.true_film()
        film = self.folder / (name.replace(" ", "_").replace("%", "pc") + ending)
        must(REFILM, log.with_suffix(".mkv"), film, writer, rate, *frames)
        ran = (len(log.with_suffix(".times.csv").read_text().splitlines()) - 1) / RATE
        text = re.sub(r"^times = .*\n", "", log.read_text(), flags=re.M)
        text = re.sub(r"^file = .*$", f'file = "{film}"' + (f'\nlength = "{ran:.3f} s"' if length else ""), text,
                      flags=re.M)
        text = re.sub(r'^mission = "(.*\.toml)"$', rf'mission = "{log.parent}/\1"', text, flags=re.M)
        if logs:
            text = re.sub(r'^log = "', f'log = "{log.parent}/', text, flags=re.M)
        else:
            text = re.sub(r"\n\[\[robot\]\]\nname = .*\nlog = .*\n", "\n", text)
        changed = film.with_suffix(".toml")
        changed.write_text(text)
        return changed

    def assert_lie(self, name, log, *codes, truth=None, lab=None):
        """One of the codes names it."""
        with self.subTest(name):
            verdict, found = self.answer(name, log, truth or self.truth(self.true_film()), lab)
            self.assertNotEqual(verdict, "VALID", self.last_text)
            self.assertTrue(found & set(codes), f"{name}: {sorted(found)} and not {codes}")

    def assert_right(self, name, log, truth=None, lab=None, verdicts=("VALID",)):
        with self.subTest(name):
            truth = truth or self.truth(self.true_film())
            verdict, _ = self.answer(name, log, truth, lab)
            self.assertIn(verdict, verdicts, f"{name}: {self.last_text}")
            self.assertAlmostEqual(self.last_score, truth, delta=0.01 * abs(truth), msg=name)

    # 25 films that lie about time or pictures.

    def test_recorders_that_hang(self):
        for name, writer, ending, frames in (
                ("hangs to the end", "h264", ".mkv", ("0-150", "150*200")),
                ("hangs to the end, avi", "mjpeg", ".avi", ("0-150", "150*200")),
                ("hangs for 3 s", "h264", ".mkv", ("0-150", "150*45", "196-400")),
                ("last picture for 1 s", "opencv", ".mp4", ("0-303", "303*15")),
                ("last picture for 3 s", "h264", ".mkv", ("0-273", "273*45")),
                ("loop of two pictures", "h264", ".mkv", ("0-270", *["270", "271"] * 30))):
            self.assert_lie(name, self.again(name, writer, RATE, *frames, ending=ending, length=True),
                            "W_PICTURES_REPEATED", "E_VIDEO_TRUNCATED")

    def test_half_of_the_pictures(self):
        self.assert_lie("each picture held twice", self.again("held", "h264", RATE, "/2", length=True), "E_FRAME_RATE")

    def test_wrong_speeds(self):
        for percent, writer, ending, told in (
                (3, "h264", ".mkv", {"length": True}), (5, "mjpeg", ".avi", {"logs": True}),
                (10, "opencv", ".mp4", {}), (25, "h264", ".mkv", {"length": True}), (100, "opencv", ".avi", {}),
                (-33, "opencv", ".avi", {"length": True}), (-27, "h264", ".mkv", {"logs": True}),
                (47, "opencv", ".mp4", {"logs": True}), (-33, "mjpeg", ".avi", {})):
            name = f"speed {percent:+} % {writer}{ending} {''.join(told)}"
            codes = ["E_DURATION"] if "length" in told else ["E_FILM_SPEED"] if told else ["W_CLOCK_COUNTED"]
            self.assert_lie(name, self.again(name, writer, f"{RATE * (1 + percent / 100):.4f}", "*1", ending=ending,
                                             **told), *codes)

    def test_clocks_that_step(self):
        lost = [f"{i}-{i + 18}" for i in range(0, 400, 20)]
        for name, writer, ending, frames in (
                ("a twentieth lost, counted", "mjpeg", ".avi", lost),
                ("a second lost at once, counted", "h264", ".mkv", ("0-150", "166-400")),
                ("clock ahead by 0.5 s", "h264", ".mkv", ("*1", "@jitter:5", "@step:10.02:0.5")),
                ("clock ahead by 1.5 s", "h264", ".mkv", ("*1", "@jitter:5", "@step:12.02:1.5"))):
            self.assert_lie(name, self.again(name, writer, RATE, *frames, ending=ending), "E_CLOCK_STEP")

    def test_order_of_the_pictures(self):
        self.assert_lie("each two pictures exchanged", self.again("pairs", "h264", RATE, "%", length=True),
                        "E_TIMESTAMPS")
        self.assert_lie("runs backwards", self.again("back", "h264", RATE, "~", length=True), "E_TIMESTAMPS")

    def test_pictures_of_another_kind(self):
        for kind, codes in (("mirror", ("E_VIDEO_UNREADABLE",)),
                            ("letterbox", ("E_CAMERA_MOVED", "E_ROBOT_MISSING", "E_TAG_SIZE")),
                            ("crop", ("E_CAMERA_MOVED", "E_ROBOT_MISSING", "E_TAG_SIZE")),
                            ("half", ("E_CALIB_SIZE",))):
            self.assert_lie(kind, self.again(kind, "h264", RATE, "*1", f"@{kind}", length=True), *codes)

    # 15 laboratories that lie, or runs that were disturbed.

    def changed_lab(self, name, arena=None, **offsets):
        lab = LAB.copy_of_lab(f"{self.folder.name}/{name}").parent
        for robot, change in offsets.items():
            file = lab / f"{robot}.offset.toml"
            file.write_text(change(file.read_text()))
        if arena:
            (lab / "arena.toml").write_text(arena((lab / "arena.toml").read_text()))
        return lab

    def test_tags_that_sit_otherwise(self):
        log = self.true_film(name="long")
        truth = self.truth(log)

        def moved(ahead, aside):
            def change(text):
                from math import cos, sin
                number = lambda key: float(re.search(rf"^{key} = (\S+)", text, re.M).group(1))
                yaw = number("yaw_rad")
                for key, by in (("x", cos(yaw) * ahead + sin(yaw) * aside), ("y", cos(yaw) * aside - sin(yaw) * ahead)):
                    text = re.sub(rf"^{key} = \S+", f"{key} = {number(key) + by!r}", text, count=1, flags=re.M)
                return text
            return change

        for degrees in (90, -90, 180, 30):
            lab = self.changed_lab(f"turned{degrees}", rvr2=lambda text, by=degrees: turned(text, by))
            self.assert_lie(f"tag turned by {degrees} degrees", log, "E_TAG_TURNED", truth=truth, lab=lab)
        for ahead, aside in ((0.03, 0), (-0.03, 0), (0, 0.03), (0, -0.03)):
            lab = self.changed_lab(f"moved{ahead}{aside}", rvr1=moved(ahead, aside))
            self.assert_lie(f"tag moved by {1000 * ahead:g}, {1000 * aside:g} mm", log, "W_TAG_PLACE", truth=truth,
                            lab=lab)
        # The tags of two robots were exchanged: each file says how the other one's sits.
        texts = {robot: (LAB.lab / f"{robot}.offset.toml").read_text() for robot in ("rvr1", "rvr3")}

        def with_numbers_of(other):
            def change(text):
                for key in ("x", "y", "yaw_rad"):
                    value = re.search(rf"^{key} = (\S+)", texts[other], re.M).group(1)
                    text = re.sub(rf"^{key} = \S+", f"{key} = {value}", text, count=1, flags=re.M)
                return text
            return change
        lab = self.changed_lab("exchanged", rvr1=with_numbers_of("rvr3"), rvr3=with_numbers_of("rvr1"))
        self.assert_lie("tags exchanged", log, "E_TAG_TURNED", "W_TAG_PLACE", truth=truth, lab=lab)

    def test_heights_and_edges(self):
        def all_by(by, robots=(1, 2, 3), key="height"):
            def of_arena(text):
                head, *rest = text.split("[[robot]]")
                number = iter(range(1, 4))
                return head + "".join("[[robot]]" + (re.sub(rf"^{key} = (\S+)", lambda m: f"{key} = {float(m[1]) + by}",
                                                            part, flags=re.M) if next(number) in robots else part)
                                      for part in rest)

            def of_offset(text):
                name = "height_m" if key == "height" and "height_m" in text else key
                name = name if re.search(rf"^{name} = ", text, re.M) else f"{key}_m"
                return re.sub(rf"^{name} = (\S+)", lambda m: f"{name} = {float(m[1]) + by}", text, count=1, flags=re.M)
            return self.changed_lab(f"{key}{by}{len(robots)}", of_arena, **{f"rvr{i}": of_offset for i in robots})
        log = self.true_film()
        for name, lab in (("all heights 10 cm low", all_by(-0.1)), ("one height 4 cm low", all_by(-0.04, (1,))),
                          ("all edges 5 mm long", all_by(0.005, key="edge"))):
            self.assert_lie(name, log, "E_TAG_SIZE", "W_TAG_SIZE", lab=lab)

    def test_disturbed_runs(self):
        for name, wishes, codes in (
                ("camera bumped", ("--bump", "9"), ("E_CAMERA_MOVED",)),
                ("tag twice in the picture", ("--duplicate",), ("E_DUPLICATE_ID",)),
                ("tags swapped in the run", ("--swap", "9"), ("E_GAP", "E_DUPLICATE_ID", "E_TAG_TURNED")),
                ("robot hidden for 2 s", ("--arm", "1:8:10"), ("E_GAP",)),
                ("no picture for 1.5 s", ("--drop-from", "9:10.5"), ("E_GAP",))):
            log = self.true_film(*wishes, name=name.replace(" ", "_"))
            self.assert_lie(name, log, *codes, truth=self.truth(log))
        pushed = pushed_aside(self.true_film().with_name("true.trajectory.csv"), self.folder / "pushed.csv")
        log = LAB.film("pushed", "--trajectory", pushed, mission="grid_exploration", seconds=SECONDS)
        self.assert_lie("robot pushed", log, "E_PUSHED", "W_PUSHED", truth=self.truth(log))

    # 24 films that are only ugly.

    def test_ugly_films(self):
        for name, wishes in (("as it is", ()), ("stamps off by 8 ms", ("--jitter-ms", "8")),
                             ("dropped 3 %", ("--drop", "0.03")), ("noise of 6", ("--noise", "6")),
                             ("blurred", ("--blur", "1.2")), ("dim", ("--gain", "0.6", "--noise", "4")),
                             ("light from one side", ("--gradient", "0.5")), ("exposed 16 ms", ("--exposure-ms", "16")),
                             ("shadow for 0.4 s", ("--arm", "1:8:8.4")), ("10 frames/s", ("--fps", "10")),
                             ("25 frames/s", ("--fps", "25")), ("29.97 frames/s", ("--fps", "29.97")),
                             ("50 frames/s", ("--fps", "50")), ("60 frames/s", ("--fps", "60")),
                             ("motion JPEG", ("--form", "mjpg"))):
            log = self.true_film(*wishes, name=re.sub(r"[^a-z0-9]", "_", name))
            self.assert_right(name, log, truth=self.truth(log))

    def test_writers_of_the_truth(self):
        for name, writer, ending, told, frames in (
                ("OpenCV .mp4, length", "opencv", ".mp4", {"length": True}, ("*1",)),
                ("OpenCV .avi, logs", "opencv", ".avi", {"logs": True}, ("*1",)),
                ("JPEG .avi, length", "mjpeg", ".avi", {"length": True}, ("*1",)),
                ("constant .mkv, logs", "h264", ".mkv", {"logs": True}, ("*1",)),
                ("stamps of 5 ms in the .mkv", "h264", ".mkv", {}, ("*1", "@jitter:5"))):
            self.assert_right(name, self.again(name, writer, RATE, *frames, ending=ending, **told))
        # The recorder writes twice as many pictures as the camera takes: right, and said.
        self.assert_right("doubled to 30", self.again("twice", "h264", 2 * RATE, "*2", length=True),
                          verdicts=("DEGRADED",))

    def test_other_cameras(self):
        for name, words in (("narrow lens", ("--lens", "narrow")), ("fisheye", ("--lens", "fisheye")),
                            ("1280x720", ("--size", "1280x720"))):
            with self.subTest(name):
                lab = LAB.folder / f"lab_{name.replace(' ', '_')}"
                lens = "fisheye" if name == "fisheye" else "pinhole"
                size = [] if "--size" in words else ["--size", "960x540"]
                must(FILM, "lab", lab, *size, "--robots", "3", "--fps", "15", "--seed", "7", *words)
                must(TRACK, "calibrate", "camera", lab / "ceiling.board", "--board", BOARD, "--camera", "ceiling",
                     "--lens", lens, "-o", lab / "ceiling.camera.toml")
                arena = lab / "arena.toml"
                must(TRACK, "calibrate", "arena", lab / "ceiling.arena.mkv", "--arena", arena, "--camera", "ceiling")
                for robot in ("rvr1", "rvr2", "rvr3"):
                    must(TRACK, "calibrate", "robot", robot, "--arena", arena, "--camera", "ceiling", "--spin",
                         lab / f"{robot}.spin.mkv", "--straight", lab / f"{robot}.straight.mkv")
                log = self.true_film(name=f"of_{lab.name}", lab=lab)
                self.assert_right(name, log, truth=self.truth(log), lab=lab)


if __name__ == "__main__":
    unittest.main()
