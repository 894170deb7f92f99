"""A run that was recorded by `rosbag record` is the run of its film: the same poses, score and verdict."""
import json
import re
import unittest

from filmed_lab import BIN, TRACK, FilmedLab, call, must, runs_in

BAG_OF_VIDEO = BIN / "bag_of_video"
TOPIC = "/ceiling/image_raw"
BEGIN = 1_732_391_823_000_000_000  # nanoseconds since 1970
LAB = None


def setUpModule():
    global LAB
    if not BAG_OF_VIDEO.exists():
        raise unittest.SkipTest("skipped: bag_of_video is not built")
    LAB = FilmedLab()


class Bag(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = LAB.folder / "bags"
        cls.folder.mkdir()
        log = LAB.film("run")
        cls.video = log.parent / "run.mkv"
        sidecar = log.parent / "run.times.csv"
        cls.bag = cls.folder / "run.bag"
        # The film with the times that the bag has: since 1970.
        cls.times = cls.folder / "since1970.csv"
        cls.times.write_text(must(BAG_OF_VIDEO, cls.video, cls.bag, TOPIC, BEGIN, sidecar).stdout)
        first = float(sidecar.read_text().splitlines()[1].split(",")[1])
        text = log.read_text()
        start = re.search(r'^start = "([0-9.]+) s"$', text, re.M)
        text = text.replace(start.group(0), f'start = "{BEGIN / 1e9 + float(start.group(1)) - first:.6f} s"')
        text = re.sub(r'^times = ".*"\n', "", text, flags=re.M)
        text = re.sub(r'^mission = "(.*\.toml)"$', rf'mission = "{log.parent}/\1"', text, flags=re.M)
        cls.log = text
        cls.file = re.search(r'^file = ".*"$', text, re.M).group(0)

    def score(self, name, source, *words):
        log = self.folder / f"{name}.toml"
        log.write_text(self.log.replace(self.file, f'file = "{source}"'))
        poses = self.folder / f"{name}.csv"
        done = call(TRACK, "score", "--run", log, "--arena", LAB.lab / "arena.toml", "--csv", poses, "--json",
                    *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        return poses.read_text(), answer["score"], answer["verdict"]

    def test_gives_the_poses_of_its_film(self):
        film = self.score("film", self.video, "--times", self.times)
        store = self.folder / "runs.db"
        self.assertEqual(self.score("bag", self.bag, "--into", store), film)
        # From the log's folder, with its topic; and drawn again from the store.
        self.assertEqual(self.score("topic", f"run.bag:{TOPIC}", "--into", store), film)
        self.assertEqual(len(runs_in(store)), 2)
        for run in ("r1", "r2"):
            picture = self.folder / f"{run}.png"
            done = call(TRACK, "overlay", run, "--store", store, "--at", "1", "-o", picture, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "r1.png").read_bytes(), (self.folder / "r2.png").read_bytes())

    def test_every_command_takes_one(self):
        seen = [json.loads(must(TRACK, "detect", source, "--json").stdout) for source in (self.video, self.bag)]
        self.assertEqual(seen[0], seen[1])
        done = call(TRACK, "detect", f"{self.bag}:/door")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"E_CONFIG: the bag has no topic /door; name one, like {self.bag}:{TOPIC}", done.stderr)

        empty = self.folder / "empty.bag"
        must(BAG_OF_VIDEO, LAB.lab / "ceiling.arena.mkv", empty, TOPIC, BEGIN)
        places = [self.folder / "film.place.toml", self.folder / "bag.place.toml"]
        for source, place in zip((LAB.lab / "ceiling.arena.mkv", empty), places):
            must(TRACK, "calibrate", "arena", source, "--arena", LAB.lab / "arena.toml", "-o", place)
        texts = [[line for line in place.read_text().splitlines() if not re.match("made|pictures|source", line)]
                 for place in places]
        self.assertEqual(texts[0], texts[1])

        recorded = self.folder / "recorded.mkv"
        must(TRACK, "record", self.bag, recorded, "--codec", "ffv1")
        again = json.loads(must(TRACK, "detect", recorded, "--json").stdout)
        self.assertEqual(again["frames"], seen[0]["frames"])
        done = call(TRACK, "detect", f"{self.bag}:{TOPIC}", "--csv", self.bag)
        self.assertIn(done.returncode, (1, 2))
        self.assertIn("would be lost", done.stderr)
        self.assertEqual(self.bag.read_bytes()[:7], b"#ROSBAG")


if __name__ == "__main__":
    unittest.main()
