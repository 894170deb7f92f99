"""`swarmsmith track record`: from folders, videos and a camera on the network; cut off, out of disk."""
import http.server
import json
import pathlib
import resource
import signal
import subprocess
import tempfile
import threading
import unittest

from programs import BIN, ended_well, wait_for

TRACK = str(BIN / "swarmsmith-track")
WIDTH, HEIGHT = 160, 120


def image(number):
    """A picture that moves, as PGM."""
    rows = bytes((x + 3 * y + 5 * number) % 256 for y in range(HEIGHT) for x in range(WIDTH))
    return b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + rows


class Camera(http.server.ThreadingHTTPServer):
    """A network camera: motion JPEG over HTTP, `frames` pictures at 20 a second; then it hangs up, or
    says nothing any more."""

    def __init__(self, jpegs, frames, falls_silent=False):
        super().__init__(("127.0.0.1", 0), Stream)
        self.jpegs, self.frames, self.falls_silent = jpegs, frames, falls_silent
        self.over = threading.Event()
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def word(self):
        return f"http://127.0.0.1:{self.server_port}/video.mjpg"

    def __exit__(self, *_):
        self.over.set()
        self.shutdown()
        self.server_close()


class Stream(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        self.end_headers()
        try:
            for i in range(self.server.frames):
                jpeg = self.server.jpegs[i % len(self.server.jpegs)]
                self.wfile.write(b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n"
                                 % len(jpeg) + jpeg + b"\r\n")
                self.wfile.flush()
                if self.server.over.wait(0.05):
                    return
            if self.server.falls_silent:
                self.server.over.wait(60)
        except (BrokenPipeError, ConnectionResetError):
            pass

    def log_message(self, *_):
        pass


class TrackRecord(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def images(self, count):
        folder = self.folder / "images"
        folder.mkdir()
        for i in range(count):
            (folder / f"shot{i}.pgm").write_bytes(image(i))
        return folder

    def record(self, *arguments, **options):
        return subprocess.run([TRACK, "record", *map(str, arguments)], capture_output=True,
                              text=True, timeout=120, cwd=self.folder, **options)

    def start(self, *arguments):
        return subprocess.Popen([TRACK, "record", *map(str, arguments)], cwd=self.folder,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def recorded(self, *arguments, **options):
        done = ended_well(self.record(*arguments, "--json", **options))
        return json.loads(done.stdout)

    def times(self, name):
        """The rows of a sidecar."""
        return (self.folder / name).read_text().splitlines()[1:]

    def frames_in(self, name):
        """How many frames can be read back from a video."""
        copy = self.folder / ("copy-of-" + name)
        copy.unlink(missing_ok=True)
        return self.recorded(name, copy.name)["frames"]

    def test_a_folder_becomes_a_video_with_times(self):
        answer = self.recorded(self.images(30), "run.mkv", "--rate", "20")
        self.assertEqual((answer["frames"], answer["dropped"]), (30, 0))
        self.assertEqual(self.times("run.times.csv"), [f"{i},{i / 20:.6f}" for i in range(30)])
        self.assertEqual(self.frames_in("run.mkv"), 30)
        self.assertFalse((self.folder / "run.times.csv.part").exists())
        # By the video's own times now, and only a second of them.
        self.assertEqual(self.recorded("run.mkv", "second.mkv", "--seconds", "1")["frames"], 20)

    def test_times_of_a_sidecar_come_first(self):
        times = [round(0.1 * i + 0.03 * (i % 2), 6) for i in range(12)]
        rows = [f"{i},{time + 5:.6f}" for i, time in enumerate(times)]
        expected = [f"{i},{time:.6f}" for i, time in enumerate(times)]
        images = self.images(12)
        (self.folder / "images.times.csv").write_text("\n".join(["frame,time_s", *rows]) + "\n")
        for number, folder in enumerate((images, f"{images}/")):
            self.recorded(folder, f"folder{number}.mkv", "--rate", "20")
            self.assertEqual(self.times(f"folder{number}.times.csv"), expected)
        # A video whose own times are others.
        (self.folder / "images.times.csv").unlink()
        self.recorded(images, "even.mkv", "--rate", "20")
        (self.folder / "even.times.csv").write_text("\n".join(["frame,time_s", *rows]) + "\n")
        self.recorded("even.mkv", "copy.mkv")
        self.assertEqual(self.times("copy.times.csv"), expected)
        (self.folder / "even.times.csv").write_text("\n".join(["frame,time_s", *rows[:-2]]) + "\n")
        done = self.record("even.mkv", "short.mkv")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("E_SIDECAR_MISMATCH", done.stderr)

    def test_what_was_recorded_survives_a_kill(self):
        recorder = self.start(self.images(400), "run.mkv", "--rate", "40", "--realtime")
        part = self.folder / "run.times.csv.part"
        wait_for(lambda: part.exists() and len(self.times(part.name)) > 117, "117 frames")
        recorder.send_signal(signal.SIGKILL)
        recorder.communicate(timeout=30)
        taken = len(self.times(part.name))
        self.assertLess(taken, 400)
        frames = self.frames_in("run.mkv")
        # Half a second at 40 a second, and the frame in the encoder.
        self.assertGreaterEqual(frames, taken - 22)
        self.assertLessEqual(frames, taken + 1)
        self.assertFalse((self.folder / "run.times.csv").exists(),
                         "a sidecar of another length must not be taken for the video's")
        times = self.times("copy-of-run.times.csv")
        self.assertEqual(times, [f"{i},{i / 40:.6f}" for i in range(frames)])

    def test_ctrl_c_ends_it_well(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            name = f"run{int(number)}"
            folder = self.folder / "images"
            recorder = self.start(folder if folder.exists() else self.images(400), name + ".mkv",
                                  "--rate", "20", "--realtime")
            part = self.folder / (name + ".times.csv.part")
            wait_for(lambda: part.exists() and len(self.times(part.name)) > 10, "10 frames")
            recorder.send_signal(number)
            out, err = recorder.communicate(timeout=30)
            self.assertEqual(recorder.returncode, 0, err)
            rows = len(self.times(name + ".times.csv"))
            self.assertLess(rows, 400)
            self.assertIn(f"{rows} frames", out)
            self.assertEqual(self.frames_in(name + ".mkv"), rows)

    def test_a_full_disk_is_said_and_costs_nothing_written(self):
        limit = 300_000
        done = self.record(self.images(200), "run.mkv", "--rate", "20", "--codec", "mjpeg",
                           restore_signals=False,  # Python ignores SIGXFSZ
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                 (limit, limit)))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"run\.mkv: cannot be written: File too large; run\.mkv has")
        size = (self.folder / "run.mkv").stat().st_size
        self.assertGreater(size, limit / 2)
        frames = self.frames_in("run.mkv")
        self.assertGreater(frames, 5)
        self.assertLess(frames, 200)

    def jpegs(self):
        """As a camera makes them: cut out of a recording."""
        self.recorded(self.images(20), "jpegs.mkv", "--rate", "20", "--codec", "mjpeg")
        rest = (self.folder / "jpegs.mkv").read_bytes()
        found = []
        while (begin := rest.find(b"\xff\xd8\xff")) >= 0:
            end = rest.index(b"\xff\xd9", begin) + 2
            found.append(rest[begin:end])
            rest = rest[end:]
        self.assertEqual(len(found), 20)
        return found

    def test_a_camera_on_the_network(self):
        with Camera(self.jpegs(), 1000) as camera:
            answer = self.recorded(camera.word(), "run.mkv", "--seconds", "2")
        rows = [row.split(",") for row in self.times("run.times.csv")]
        self.assertEqual(answer["frames"], len(rows))
        # At most 20 a second; a busy machine may lose some.
        self.assertGreater(len(rows), 15)
        self.assertLess(len(rows), 50)
        clocks = [float(row[2]) for row in rows]
        self.assertAlmostEqual(clocks[-1] - clocks[0], float(rows[-1][1]), places=5)
        self.assertEqual(self.frames_in("run.mkv"), len(rows))

    def test_a_camera_that_hangs_up_or_falls_silent(self):
        jpegs = self.jpegs()
        with Camera(jpegs, 30) as camera:
            answer = self.recorded(camera.word(), "short.mkv", "--seconds", "60")
        self.assertGreater(answer["frames"], 10)
        with Camera(jpegs, 30, falls_silent=True) as camera:
            done = self.record(camera.word(), "silent.mkv", "--seconds", "60")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no picture came for 5 s", done.stderr)
        self.assertEqual(self.frames_in("silent.mkv"), len(self.times("silent.times.csv")))

    def test_refusals(self):
        images = self.images(3)
        (self.folder / "old.mkv").write_bytes(b"precious")
        for code, words, says in [
                (2, (images, "run.mp4", "--rate", "20"), ".mkv"),
                (2, (images, "old.mkv", "--rate", "20"), "never overwrites"),
                (2, (images, "run.mkv", "--rate", "fast"), "`fast` is not a positive number"),
                (2, (images, "run.mkv", "--seconds", "-1"), "`-1` is not a positive number"),
                (2, (images, "run.mkv", "--codec", "ffv1", "--quality", "50"), "has no quality"),
                (2, ("camera:first", "run.mkv"), "camera:0:1920x1080@30"),
                (1, (images, "run.mkv"), "--rate"),
                (1, ("none.mp4", "run.mkv"), "No such file"),
                (1, (images, "nowhere/run.mkv", "--rate", "20"), "No such file")]:
            with self.subTest(words=words):
                done = self.record(*words)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(says, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertFalse((self.folder / "run.mkv").exists())
        self.assertEqual((self.folder / "old.mkv").read_bytes(), b"precious")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["images", "old.mkv"])


if __name__ == "__main__":
    unittest.main()
