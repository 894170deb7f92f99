"""Films that lie about time are not VALID, and say why; films that are only ugly are right, and not refused."""
import json
import re
import unittest

from filmed_lab import BIN, TRACK, FilmedLab, call, must

REFILM = BIN / "refilm"
RATE = 15
SECONDS = 20
LAB = None


def setUpModule():
    global LAB
    if not REFILM.exists():
        raise unittest.SkipTest("skipped: refilm is not built")
    LAB = FilmedLab()


class LyingFilms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = LAB.folder / "lies"
        cls.folder.mkdir()

    def film(self, *wishes, name="true", seconds=SECONDS):
        return LAB.film(name, "--robot-logs", *wishes, mission="grid_exploration", seconds=seconds)

    def truth(self, log):
        return json.loads(log.with_suffix(".truth.json").read_text())["score"]

    def score(self, name, writer, rate, *frames, ending=".mkv", length=None, logs=False, of=None):
        """Its answer, of the true film written again without a sidecar."""
        log = of or self.film()
        film = self.folder / (name + ending)
        must(REFILM, next(log.parent.glob(log.stem + ".m*v")), film, writer, rate, *frames)
        text = re.sub(r'^times = .*\n', "", log.read_text(), flags=re.M)
        text = re.sub(r'^file = .*$', f'file = "{film}"' + (f'\nlength = "{length} s"' if length else ""), text,
                      flags=re.M)
        text = re.sub(r'^mission = "(.*\.toml)"$', rf'mission = "{log.parent}/\1"', text, flags=re.M)
        if logs:
            text = re.sub(r'^log = "', f'log = "{log.parent}/', text, flags=re.M)
        else:
            text = re.sub(r'\n\[\[robot\]\]\nname = .*\nlog = .*\n', "\n", text)
        changed = self.folder / f"{name}.toml"
        changed.write_text(text)
        done = call(TRACK, "score", "--run", changed, "--arena", LAB.lab / "arena.toml", "--json")
        self.assertIn(done.returncode, (0, 6), done.stderr)
        answer = json.loads(done.stdout)
        answer["codes"] = {issue["code"] for issue in answer["issues"]} if "issues" in answer else done.stdout
        return answer

    def frames(self):
        return int((1.2 + SECONDS + 1) * RATE)

    def assert_lies(self, answer, code, verdict=None):
        self.assertNotEqual(answer["verdict"], "VALID")
        if verdict:
            self.assertEqual(answer["verdict"], verdict, answer["codes"])
        self.assertIn(code, answer["codes"])

    def length(self):
        """Of the true film."""
        log = self.film()
        frames = json.loads(must(TRACK, "detect", next(log.parent.glob(log.stem + ".m*v")), "--json").stdout)["frames"]
        return frames / RATE

    def test_true_film_is_right_and_a_stopwatch_makes_it_valid(self):
        answer = self.score("same", "h264", RATE, "*1")
        self.assert_lies(answer, "W_CLOCK_COUNTED", "DEGRADED")
        answer = self.score("timed", "h264", RATE, "*1", length=self.length())
        self.assertEqual(answer["verdict"], "VALID", answer["codes"])
        self.assertAlmostEqual(answer["score"], self.truth(self.film()), delta=abs(0.01 * self.truth(self.film())))
        answer = self.score("logged", "h264", RATE, "*1", logs=True)
        self.assertEqual(answer["verdict"], "VALID", answer["codes"])

    def test_recorder_that_hangs(self):
        for name, writer, frames in (("end", "h264", ("0-150", "150*200")), ("endmj", "mjpeg", ("0-150", "150*200")),
                                     ("middle", "h264", ("0-150", "150*40", "191-400"))):
            answer = self.score(name, writer, RATE, *frames, length=self.length() if name == "middle" else None)
            self.assert_lies(answer, "W_PICTURES_REPEATED", "INVALID")

    def test_few_pictures_held(self):
        answer = self.score("held", "h264", RATE, "/2", length=self.length())
        self.assert_lies(answer, "E_FRAME_RATE", "INVALID")

    def test_pictures_twice(self):
        answer = self.score("twice", "h264", 2 * RATE, "*2", length=self.length())
        self.assert_lies(answer, "W_PICTURES_REPEATED", "DEGRADED")
        self.assertAlmostEqual(answer["score"], self.truth(self.film()), delta=abs(0.01 * self.truth(self.film())))

    def test_wrong_speeds_by_three_writers(self):
        for writer, ending in (("opencv", ".avi"), ("h264", ".mkv"), ("mjpeg", ".avi"), ("opencv", ".mp4")):
            for rate in (10, 11, 22):
                name = f"speed{writer}{ending[1:]}{rate}"
                answer = self.score(name, writer, rate, "*1", ending=ending)
                self.assertNotEqual(answer["verdict"], "VALID", name)
                answer = self.score(name, writer, rate, "*1", ending=ending, length=self.length())
                self.assert_lies(answer, "E_DURATION", "INVALID")
                answer = self.score(name, writer, rate, "*1", ending=ending, logs=True)
                self.assert_lies(answer, "E_FILM_SPEED", "INVALID")

    def test_frames_that_a_counting_recorder_lost(self):
        # A twentieth, and a second at once.
        spread = [word for i in range(0, 400, 20) for word in (f"{i}-{i + 18}",)]
        self.assert_lies(self.score("lost", "mjpeg", RATE, *spread, ending=".avi"), "E_CLOCK_STEP", "INVALID")
        self.assert_lies(self.score("jump", "h264", RATE, "0-150", "166-400"), "E_CLOCK_STEP", "INVALID")

    def test_ugly_films_are_right(self):
        for name, wishes in (("jitter", ("--jitter-ms", "8")), ("dropped", ("--drop", "0.03")),
                             ("noisy", ("--noise", "6")), ("blurred", ("--blur", "1.2")),
                             ("dim", ("--gain", "0.6", "--noise", "4")), ("slow", ("--fps", "10")),
                             ("fast", ("--fps", "30"))):
            log = self.film(*wishes, name=name)
            done = call(TRACK, "score", "--run", log, "--arena", LAB.lab / "arena.toml", "--json")
            self.assertEqual(done.returncode, 0, f"{name}: {done.stdout}")
            answer = json.loads(done.stdout)
            self.assertEqual(answer["verdict"], "VALID", f"{name}: {done.stdout}")
            truth = self.truth(log)
            self.assertAlmostEqual(answer["score"], truth, delta=abs(0.015 * truth), msg=name)


if __name__ == "__main__":
    unittest.main()
