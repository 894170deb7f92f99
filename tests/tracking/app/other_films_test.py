"""The same run, filmed by other cameras and packed by other programs: the score is that of the truth, or the refusal names
the cause. Made by ffmpeg; skipped where it is not."""
import json
import re
import shutil
import subprocess
import unittest

from filmed_lab import TRACK, FilmedLab, call

FFMPEG = shutil.which("ffmpeg")
RATE = 30
LAB = None


def setUpModule():
    global LAB
    if FFMPEG is None:
        raise unittest.SkipTest("skipped: ffmpeg is not installed")
    LAB = FilmedLab()


X264 = ("-c:v", "libx264", "-crf", "12", "-preset", "veryfast")
X265_10 = ("-c:v", "libx265", "-crf", "12", "-preset", "ultrafast", "-pix_fmt", "yuv420p10le", "-x265-params",
           "log-level=none", "-tag:v", "hvc1")
SILENCE = ("-f", "lavfi", "-i", "anullsrc=r=8000:cl=mono", "-shortest")
OTHER = ("-f", "lavfi", "-i", "testsrc=size=320x180:rate=30", "-shortest")
LARGE = ("-f", "lavfi", "-i", "testsrc=size=1920x1080:rate=30", "-shortest")


class OtherFilms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = LAB.folder / "others"
        cls.folder.mkdir()
        cls.log = LAB.film("true", "--fps", RATE, mission="grid_exploration", seconds=6)
        cls.film = next(cls.log.parent.glob("true.m*v"))
        cls.truth = json.loads(cls.log.with_suffix(".truth.json").read_text())["score"]
        cls.frames = json.loads(call(TRACK, "detect", cls.film, "--json").stdout)["frames"]

    def made(self, name, *words):
        """Another film of the true one."""
        film = self.folder / name
        done = subprocess.run([FFMPEG, "-v", "error", "-y", "-i", str(self.film), *words, str(film)],
                              capture_output=True, text=True, check=False, timeout=300)
        self.assertEqual(done.returncode, 0, f"{name}: {done.stderr}")
        return film

    def score(self, film, length=None, arena=None):
        text = re.sub(r'^times = .*\n', "", self.log.read_text(), flags=re.M)
        text = re.sub(r'^file = .*$', f'file = "{film}"\nlength = "{length or self.frames / RATE} s"', text, flags=re.M)
        text = re.sub(r'^mission = "(.*\.toml)"$', rf'mission = "{self.log.parent}/\1"', text, flags=re.M)
        text = re.sub(r'\n\[\[robot\]\]\nname = .*\nlog = .*\n', "\n", text)
        changed = film.with_suffix(".toml")
        changed.write_text(text)
        return call(TRACK, "score", "--run", changed, "--arena", arena or LAB.lab / "arena.toml", "--json")

    def assert_right(self, film, **more):
        done = self.score(film, **more)
        self.assertEqual(done.returncode, 0, f"{film.name}: {done.stdout}{done.stderr}")
        answer = json.loads(done.stdout)
        self.assertIn(answer["verdict"], ("VALID", "DEGRADED"), f"{film.name}: {done.stdout}")
        self.assertAlmostEqual(answer["score"], self.truth, delta=abs(0.015 * self.truth), msg=film.name)
        return answer

    def assert_not_valid(self, film, *wanted, **more):
        done = self.score(film, **more)
        said = done.stdout + done.stderr
        self.assertIn(done.returncode, (0, 1, 2, 6), said)
        if done.returncode in (0, 6):
            self.assertNotEqual(json.loads(done.stdout)["verdict"], "VALID", film.name)
        for part in wanted:
            self.assertRegex(said, part, film.name)

    def detected(self, film):
        done = call(TRACK, "detect", film, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_other_packings_are_right(self):
        for name, words in (("same.mkv", ("-c", "copy")), ("parts.mp4", ("-c", "copy", "-movflags",
                                                                          "frag_keyframe+empty_moov")),
                            ("audio.mov", (*SILENCE, "-map", "1:a", "-map", "0:v", *X264)),
                            ("second.mkv", (*OTHER, "-map", "0:v", "-map", "1:v", *X264)),
                            ("large.mp4", (*LARGE, "-map", "0:v", "-map", "1:v", *X264)),
                            ("behind.ts", (*X264, "-bf", "2"))):
            self.assert_right(self.made(name, *words))

    def test_pictures_of_other_kinds_are_right(self):
        for name, words in (("deep.mp4", X265_10), ("deep.mkv", X265_10),
                            ("stretched.mp4", ("-vf", "setsar=4/3", *X264)),
                            # The film says that a border is to be cut off, on its left, too.
                            ("border.mp4", ("-vf", "pad=iw+64:ih+32:32:16", *X264, "-bsf:v",
                                            "h264_metadata=crop_left=32:crop_right=32:crop_top=16:crop_bottom=20"))):
            self.assert_right(self.made(name, *words))

    def test_phones(self):
        clock = ("-vsync", "vfr", "-enc_time_base", "1:90000", "-video_track_timescale", "90000", *X264)
        for turn in (90, 180, 270):
            self.assert_right(self.made(f"turn{turn}.mp4", "-metadata:s:v", f"rotate={turn}", "-c", "copy"))
        answer = self.assert_right(self.made("uneven.mp4", "-vf", "setpts=PTS+0.006/TB*sin(37*N)", *clock))
        self.assertEqual(answer["verdict"], "VALID")
        self.assert_right(self.made("dropped.mp4", "-vf",
                                    r"select=not(eq(mod(n\,11)\,7)),setpts=PTS+0.004/TB*sin(37*N)", *clock))

    def test_turned_by_a_program(self):
        self.assert_not_valid(self.made("over.mp4", "-vf", "hflip,vflip", *X264), "E_CAMERA_MOVED",
                              "turned by 180 degrees")
        self.assert_not_valid(self.made("quarter.mp4", "-vf", "transpose=1", *X264), "E_CALIB_SIZE",
                              "turned by a quarter")
        self.assert_not_valid(self.made("cut.mp4", "-vf", "crop=iw-64:ih-32", *X264), "E_CALIB_SIZE", "896x508")

    def test_interlaced(self):
        film = self.made("woven.mkv", "-vf", "tinterlace=interleave_top", "-flags", "+ilme+ildct", "-x264opts", "tff=1",
                         *X264)
        self.assert_not_valid(film, "it is interlaced")
        self.assertRegex(self.detected(film)["notes"][0], "interlaced")

    def test_another_track_first(self):
        film = self.made("first.mp4", *OTHER, "-map", "1:v", "-map", "0:v", *X264)
        self.assert_not_valid(film, "E_CALIB_SIZE", "it has 2 video tracks, and number 0 is read")
        self.assertRegex(self.detected(film)["notes"][0], "2 video tracks")

    def test_another_family(self):
        done = call(TRACK, "detect", self.film, "--family", "tag25h9", "--json")
        self.assertRegex(json.loads(done.stdout)["notes"][-1], "tag36h11 are seen")
        arena = LAB.copy_of_lab("family", arena_toml=[('family = "tag36h11"', 'family = "tagStandard41h12"')])
        self.assert_not_valid(self.made("family.mkv", "-c", "copy"), "tag36h11", arena=arena)


if __name__ == "__main__":
    unittest.main()
