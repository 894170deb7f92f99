"""Each row of the table of bad input (tracking facts, section 10) with a real file: its message,
its exit code, and that nothing, or a run marked INVALID, is in the store."""
import fcntl
import hashlib
import json
import os
import re
import shutil
import sqlite3
import struct
import subprocess
import unittest
import zlib

from filmed_lab import TRACK, FilmedLab, call, runs_in

LAB = None


def setUpModule():
    global LAB
    LAB = FilmedLab()


def write_gray_png(path, width, height, level):
    """An even picture, by hand: the standard library writes none."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = (b"\0" + bytes([level]) * width) * height
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class BadInput(unittest.TestCase):
    def setUp(self):
        self.folder = LAB.folder / self.id().rsplit(".", 1)[-1]
        self.folder.mkdir()
        self.store = self.folder / "runs.db"

    def score(self, log, *words, arena=None):
        return call(TRACK, "score", "--run", log, "--arena", arena or LAB.lab / "arena.toml",
                    "--into", self.store, *words)

    def assert_refused(self, done, code, *wanted, exit_code=1):
        """One line says it, with its parts; nothing is stored."""
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        lines = [line for line in done.stderr.splitlines() if code in line]
        self.assertTrue(lines, f"no {code} in: {done.stderr}")
        for part in wanted:
            self.assertTrue(any(re.search(part, line) for line in lines),
                            f"no {part!r} in {lines}")
        self.assertEqual(runs_in(self.store), [])
        self.assertFalse(self.store.exists())

    def assert_stored_as(self, done, verdict, code, *wanted):
        self.assertEqual(done.returncode, 6 if verdict == "INVALID" else 0,
                         done.stdout + done.stderr)
        lines = [line for line in done.stdout.splitlines() if code in line]
        self.assertTrue(lines, f"no {code} in: {done.stdout}")
        for part in wanted:
            self.assertTrue(any(re.search(part, line) for line in lines),
                            f"no {part!r} in {lines}")
        self.assertEqual([run[1] for run in runs_in(self.store)], [verdict])

    def changed_log(self, log, *pairs, times=None):
        """A copy of a run log, and of its sidecar with `times` applied to its lines."""
        text = log.read_text()
        for before, after in pairs:
            self.assertIn(before, text)
            text = text.replace(before, after)
        video = re.search(r'^file = "(.*)"$', text, re.M)
        if video:
            text = text.replace(video.group(0), f'file = "{log.parent / video.group(1)}"')
        mission = re.search(r'^mission = "(.*\.toml)"$', text, re.M)
        if mission:
            text = text.replace(mission.group(0), f'mission = "{log.parent / mission.group(1)}"')
        sidecar = re.search(r'^times = "(.*)"$', text, re.M)
        if sidecar:
            lines = (log.parent / sidecar.group(1)).read_text().splitlines()
            path = self.folder / "changed.times.csv"
            path.write_text("\n".join(times(lines) if times else lines) + "\n")
            text = text.replace(sidecar.group(0), f'times = "{path}"')
        copy = self.folder / "changed.toml"
        copy.write_text(text)
        return copy

    # Videos

    def test_outputs_never_destroy_inputs(self):
        log = LAB.film("good")
        video = log.parent / "good.mkv"
        sidecar = log.parent / "good.times.csv"
        arena = LAB.lab / "arena.toml"
        before = {file: file.read_bytes() for file in (log, video, sidecar, arena)}
        notes = self.folder / "notes.txt"
        notes.write_text("of a person")
        for words in (("--csv", video), ("--csv", sidecar), ("--report", arena), ("--report", log),
                      ("--csv", notes), ("--report", notes)):
            done = call(TRACK, "score", "--run", log, "--arena", arena, *words)
            self.assertIn(done.returncode, (1, 2), f"{words}: {done.stdout}")
            self.assertRegex(done.stderr, "would be (lost|overwritten)|(is there already|already exists) and is")
        for words in (("--csv", arena), ("--report", video)):
            done = call(TRACK, "score", "--run", self.folder / "gone.toml", "--arena", arena, *words,
                        "--csv" if words[0] == "--report" else "--report", words[1])
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("--report: names the same file as --csv", done.stderr)
        done = call(TRACK, "calibrate", "camera", self.folder / "gone.mkv", "--board",
                    "chessboard:7x5:0.03", "-o", self.folder / "new", "--map", self.folder / "./new")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--map: names the same file as --output", done.stderr)
        for command in (("overlay", video, "--arena", arena, "--run", log, "-o", video),
                        ("calibrate", "arena", LAB.lab / "ceiling.arena.mkv", "--arena", arena,
                         "-o", arena),
                        ("calibrate", "arena", "--again", "--arena", arena,
                         "-o", LAB.lab / "ceiling.camera.toml")):
            done = call(TRACK, *command)
            self.assertIn(done.returncode, (1, 2), f"{command}: {done.stdout}")
            self.assertIn("would be lost", done.stderr)
        self.assertEqual(before, {file: file.read_bytes() for file in before})
        self.assertEqual(notes.read_text(), "of a person")

    def test_calibrations_and_overlays_overwrite_nothing_else(self):
        """Files that the command does not read; a calibration of the same kind is replaced."""
        log = LAB.film("good")
        copy = LAB.copy_of_lab(f"{self.folder.name}/lab")
        other = copy.with_name("other.toml")
        other.write_text(copy.read_text())
        film = self.folder / "film.mkv"
        shutil.copy(log.parent / "good.mkv", film)
        notes = self.folder / "pictures"
        notes.mkdir()
        (notes / "000001.png").write_bytes(b"of a person")
        drawn = ("overlay", log.parent / "good.mkv", "--arena", copy, "--run", log)
        again = ("calibrate", "arena", "--again", "--arena", copy)
        spin = ("calibrate", "robot", "rvr1", "--spin", LAB.lab / "rvr1.spin.mkv", "--arena", copy)
        before = {file: file.read_bytes() for file in (*copy.parent.iterdir(), film, notes / "000001.png")}
        for command in ((*drawn, "-o", film), (*drawn, "-o", notes), (*drawn, "-o", f"{notes}/"),
                        (*drawn, "--at", "1", "-o", notes / "000001.png"), (*again, "-o", other), (*again, "-o", log),
                        (*spin, "-o", copy.with_name("rvr2.offset.toml")), (*spin, "-o", other)):
            done = call(TRACK, *command)
            self.assertEqual(done.returncode, 2, f"{command}: {done.stdout}")
            self.assertIn("already exists", done.stderr)
        self.assertEqual(before, {file: file.read_bytes() for file in before})
        place = self.folder / "place.toml"
        for _ in range(2):
            done = call(TRACK, *again, "-o", place)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_files_to_write_are_tried_before_the_work(self):
        log = LAB.film("good")
        arena = LAB.lab / "arena.toml"
        missing = self.folder / "missing"
        for words in (("score", "--run", log, "--arena", arena, "--into", self.store, "--csv", missing / "a.csv"),
                      ("score", "--run", log, "--arena", arena, "--into", self.store, "--report", missing / "a.html"),
                      ("detect", log.parent / "good.mkv", "--csv", missing / "a.csv"),
                      ("calibrate", "arena", "--again", "--arena", arena, "-o", missing / "a.toml"),
                      ("overlay", log.parent / "good.mkv", "--run", log, "--arena", arena, "-o", missing / "a.mkv"),
                      ("report", "r1", "--store", self.store, "-o", missing / "a.html")):
            done = call(TRACK, *words)
            self.assertEqual(done.returncode, 1, f"{words}: {done.stdout}")
            self.assertIn(f"there is no folder {missing}", done.stderr)
        self.assertFalse(self.store.exists())

    def test_a_link_that_leads_nowhere_is_followed(self):
        link = self.folder / "link.csv"
        link.symlink_to("target.csv")
        done = call(TRACK, "score", "--run", LAB.film("good"), "--arena", LAB.lab / "arena.toml",
                    "--csv", link)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(link.is_symlink())
        head = (self.folder / "target.csv").read_text().splitlines()[0]
        self.assertEqual(head, "cycle,time_s,robot,x,y,theta,kind,sigma_m,sigma_rad")

    def test_a_start_beyond_the_end_names_the_files_span(self):
        log = self.changed_log(LAB.film("good"), ('start = "1.2 s"', 'start = "200 s"'))
        self.assert_refused(self.score(log), "E_VIDEO_TRUNCATED",
                            r"the video goes from 0\.00 s to \d\.\d+ s, and the run begins at 200\.00 s")

    def test_hidden_floor_tags_degrade_the_verdict(self):
        done = self.score(LAB.film("hidden", "--hide-floor-tags", *range(101, 106)))
        self.assert_stored_as(done, "DEGRADED", "W_CAMERA_UNCHECKED", "only one of its floor tags")

    def test_a_bump_is_seen_by_one_floor_tag_as_well(self):
        done = self.score(LAB.film("hidden-bump", "--bump", "1", "--hide-floor-tags", *range(101, 106)))
        self.assert_stored_as(done, "INVALID", "E_CAMERA_MOVED", r"moved between -?0\.\d+ s and [12]\.\d+ s")

    def test_a_survey_that_changed_degrades_the_verdict(self):
        arena = LAB.copy_of_lab("resurveyed", arena_toml=[("x = 1.0430", "x = 1.0930")])
        done = self.score(LAB.film("good"), arena=arena)
        self.assert_stored_as(done, "DEGRADED", "W_SURVEY_CHANGED", "100 by 50.00 mm")

    def test_a_place_that_was_edited_is_no_place(self):
        text = (LAB.lab / "ceiling.place.toml").read_text()
        line = re.search(r"translation *= *\[([^,]+),", text)
        moved = line.group(0).replace(line.group(1), f" {float(line.group(1)) + 0.02}")
        arena = LAB.copy_of_lab("edited", ceiling_place_toml=[(line.group(0), moved)])
        done = self.score(LAB.film("good"), arena=arena)
        self.assert_stored_as(done, "INVALID", "E_EXTRINSICS", "was the file edited")

    def test_video_that_is_not_there(self):
        log = self.changed_log(LAB.film("good"), ("good.mkv", "gone.mkv"))
        self.assert_refused(self.score(log), "E_VIDEO_UNREADABLE", r"gone\.mkv")

    def test_video_that_is_none(self):
        for name, content in (("text.mkv", b"this is not a video\n" * 100), ("empty.mkv", b"")):
            (self.folder / name).write_bytes(content)
            done = self.score(LAB.film("good"), self.folder / name)
            self.assert_refused(done, "E_VIDEO_UNREADABLE", re.escape(name))

    def test_video_without_frames(self):
        whole = (LAB.film("good").parent / "good.mkv").read_bytes()
        (self.folder / "head.mkv").write_bytes(whole[:600])
        done = self.score(LAB.film("good"), self.folder / "head.mkv")
        self.assert_refused(done, "E_VIDEO_UNREADABLE", r"head\.mkv")

    def test_video_that_stops_early(self):
        log = LAB.film("untimed", "--no-sidecar")
        whole = (log.parent / "untimed.mkv").read_bytes()
        (self.folder / "cut.mkv").write_bytes(whole[:len(whole) * 6 // 10])
        done = self.score(log, self.folder / "cut.mkv")
        self.assert_stored_as(done, "INVALID", "E_VIDEO_TRUNCATED", r"\d")

    def test_calibration_of_another_size(self):
        pictures = self.folder / "pictures"
        pictures.mkdir()
        for number in range(20):
            write_gray_png(pictures / f"{number:03}.png", 640, 360, 90)
        times = self.folder / "t.csv"
        times.write_text("frame,time_s\n" + "".join(f"{i},{i / 15}\n" for i in range(20)))
        done = self.score(LAB.film("good"), pictures, "--times", times)
        self.assert_refused(done, "E_CALIB_SIZE", "960x540", "640x360")

    # Calibrations

    def test_calibration_that_is_no_good(self):
        for number, (before, after, wanted) in enumerate((
                (r"rms_px = ", "rms_px = 0.9 #", r"0\.900 px, limit 0\.28 px"),
                (r"views = ", "views = 8 #", "8 usable views.* 10"),
                (r"distortion = [", "distortion = [-2, 0, 0, 0, 0] #", "folds"))):
            arena = LAB.copy_of_lab(f"{self.folder.name}/{number}",
                                    ceiling_camera_toml=[(before, after)])
            done = self.score(LAB.film("good"), arena=arena)
            self.assert_refused(done, "E_CALIB_QUALITY", r"ceiling\.camera\.toml", wanted)

    def test_place_that_is_older_than_the_camera_model(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/later",
                                ceiling_camera_toml=[('made = "2026', 'made = "2036')])
        done = self.score(LAB.film("good"), arena=arena)
        self.assert_refused(done, "E_CALIB_QUALITY", r"ceiling\.place\.toml", "calibrate arena")

    def test_too_few_reference_tags(self):
        text = (LAB.lab / "arena.toml").read_text()
        parts = re.split(r"(?=\[\[reference\]\])", text)
        rest = re.search(r"\[\[robot\]\].*", text, re.S).group(0)
        arena = self.folder / "arena.toml"
        arena.write_text("".join(parts[:4]).split("[[robot]]")[0] + rest)
        shutil.copy(LAB.lab / "ceiling.camera.toml", self.folder)
        done = call(TRACK, "calibrate", "arena", LAB.lab / "ceiling.arena.mkv", "--arena", arena,
                    "--camera", "ceiling")
        self.assert_refused(done, "E_REF_TAGS", "at least 4")
        self.assertFalse((self.folder / "ceiling.place.toml").exists())

    def test_reference_tag_that_lies_elsewhere(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/moved",
                                arena_toml=[("x = -0.7640", "x = -0.7340")])
        (arena.parent / "ceiling.place.toml").unlink()
        done = call(TRACK, "calibrate", "arena", LAB.lab / "ceiling.arena.mkv", "--arena", arena,
                    "--camera", "ceiling")
        self.assert_refused(done, "E_EXTRINSICS", "tag 102", "mm")
        self.assertFalse((arena.parent / "ceiling.place.toml").exists())

    def test_spin_that_is_none(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/spin")
        (arena.parent / "rvr1.offset.toml").unlink()
        done = call(TRACK, "calibrate", "robot", "rvr1", "--arena", arena, "--camera", "ceiling",
                    "--spin", LAB.lab / "rvr1.straight.mkv")
        self.assert_refused(done, "E_SPIN_QUALITY", r"at least 300")
        self.assertFalse((arena.parent / "rvr1.offset.toml").exists())

    def test_new_arena_has_its_floor_tags_where_the_survey_form_has_them(self):
        call(TRACK, "init", self.folder / "new")
        form = self.folder / "form.svg"
        call(TRACK, "print", "survey", "--ids", "100-105", "--edge", "0.10", "-o", form)
        proposed = re.findall(r">(-?\d\.\d{3}), (-?\d\.\d{3})<", form.read_text())
        text = (self.folder / "new" / "arena.toml").read_text()
        places = re.findall(r"^\[\[reference\]\]\ntag = \d+\nx = (\S+)\ny = (\S+)", text, re.M)
        self.assertEqual([tuple(map(float, place)) for place in places],
                         [tuple(map(float, place)) for place in proposed])
        self.assertEqual(len(places), 6)

    # Runs

    def test_camera_that_moved(self):
        done = self.score(LAB.film("bump", "--bump", "5", seconds=9))
        self.assert_stored_as(done, "INVALID", "E_CAMERA_MOVED", "px")

    def test_robot_that_is_never_seen(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/other",
                                arena_toml=[("tag = 1\n", "tag = 7\n")],
                                rvr1_offset_toml=[("tag = 1\n", "tag = 7\n")])
        self.assert_refused(self.score(LAB.film("good"), arena=arena), "E_ROBOT_MISSING", "rvr1")

    def test_robots_that_are_lost(self):
        done = self.score(LAB.film("gap", "--drop-from", "0.8:2.2"))
        self.assert_stored_as(done, "INVALID", "E_GAP", "rvr1", r"0\.\d.* 2\.\d")

    def test_tag_that_is_on_two_robots(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/twice",
                                arena_toml=[("tag = 2\n", "tag = 1\n")])
        self.assert_refused(self.score(LAB.film("good"), arena=arena), "E_DUPLICATE_ID", "tag 1",
                            "rvr1.*rvr2", exit_code=2)

    def test_tag_that_is_there_twice(self):
        log = LAB.film("twin", "--duplicate")
        done = self.score(log)
        # The one that goes on with the track is used, the other counted.
        self.assert_stored_as(done, "VALID", "W_OUTLIERS", "rvr1", "[1-9] as bad fits")
        truth = json.loads(log.with_suffix(".truth.json").read_text())
        self.assertEqual(runs_in(self.store)[0][2], truth["score"])

    def test_tag_of_another_size(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/size",
                                arena_toml=[("tag = 1\nedge = 0.1", "tag = 1\nedge = 0.11")],
                                rvr1_offset_toml=[("edge = 0.1\n", "edge = 0.11\n")])
        done = self.score(LAB.film("good"), arena=arena)
        self.assertIn("E_TAG_SIZE", done.stdout + done.stderr)
        self.assertIn(done.returncode, (1, 6))

    def test_robot_without_offset(self):
        arena = LAB.copy_of_lab(f"{self.folder.name}/without")
        (arena.parent / "rvr2.offset.toml").unlink()
        self.assert_refused(self.score(LAB.film("good"), arena=arena), "E_NO_OFFSET", "rvr2",
                            "accept-tag-as-centre")
        done = self.score(LAB.film("good"), "--accept-tag-as-centre", arena=arena)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("BIASED", done.stdout)

    def test_frames_that_were_dropped(self):
        done = self.score(LAB.film("drops", "--drop", "0.15"))
        self.assertIn(done.returncode, (0, 6), done.stderr)
        self.assertIn("W_FRAMES_DROPPED", done.stdout)

    def test_times_that_go_back(self):
        def swapped(lines):
            frame, _ = lines[11].split(",")
            return lines[:11] + [f"{frame},0.01"] + lines[12:]
        log = self.changed_log(LAB.film("good"), times=swapped)
        self.assert_refused(self.score(log), "E_TIMESTAMPS", "10|12")

    def test_frames_that_come_too_seldom(self):
        done = self.score(LAB.film("slow", "--fps", "6"))
        self.assert_stored_as(done, "INVALID", "E_FRAME_RATE", "10")

    def test_sidecar_of_another_video(self):
        for times in (lambda lines: lines[:-3], lambda lines: lines + ["99,99.0"]):
            log = self.changed_log(LAB.film("good"), times=times)
            done = self.score(log)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertRegex(done.stderr, "E_SIDECAR_MISMATCH|E_TIMESTAMPS")
            self.assertFalse(self.store.exists())

    def test_patches_that_are_not_given(self):
        log = LAB.film("colors", mission="color_selection")
        text = re.sub(r"\n\[\[patch\]\].*", "", log.read_text(), flags=re.S)
        silent = log.with_name("silent.toml")
        silent.write_text(text)
        self.assert_refused(self.score(silent), "E_LAYOUT_MISSING", r"\[\[patch\]\].*measured")

    def test_patches_that_are_measured(self):
        for seed in (3, 5):
            log = LAB.film(f"free{seed}", mission="color_selection", seed=seed)
            said = call(TRACK, "score", "--run", log, "--arena", LAB.lab / "arena.toml", "--json")
            measured = self.score(log, "--patches", "measured", "--json")
            self.assertEqual(measured.returncode, said.returncode, measured.stderr)
            self.assertEqual(json.loads(measured.stdout)["score"], json.loads(said.stdout)["score"])

    def test_patches_that_were_measured_are_kept_for_a_log_without_patches(self):
        log = LAB.film("free3", mission="color_selection", seed=3)
        text = re.sub(r"\n\[\[patch\]\].*", "", log.read_text(), flags=re.S)
        silent = log.with_name("silent_free3.toml")
        silent.write_text(re.sub(r"^(recorded|name) = .*\n", "", text, flags=re.M).replace("start = ", 'name = "free3"\nstart = '))
        measured = self.score(silent, "--patches", "measured", "--recorded", "2026-11-21", "--json")
        self.assertIn(measured.returncode, (0, 6), measured.stderr)
        again = call(TRACK, "rescore", "r1", "--store", self.store, "--run", silent, "--json")
        self.assertEqual(again.returncode, measured.returncode, again.stderr)
        self.assertEqual(json.loads(again.stdout)["score"], json.loads(measured.stdout)["score"])
        with sqlite3.connect(f"file:{self.store}?mode=ro", uri=True) as base:
            self.assertEqual(base.execute("SELECT recorded FROM v_real_runs").fetchall(), [("2026-11-21",)])

    def test_settings_that_cannot_be(self):
        for number, (before, after, wanted) in enumerate((
                ("x = 1.0430", "x = nan", r"`x` must be from -100 to 100, not nan"),
                ("edge = 0.1\n", "edge = -0.1\n", r"`edge` must be from 0\.005 to 2.* -0\.1"),
                ("height = 0.2", "height = 2.9", r"`height` must be below.*2\.9"),
                ("family =", "familie =", "did you mean \"family\""))):
            arena = LAB.copy_of_lab(f"{self.folder.name}/{number}", arena_toml=[(before, after)])
            self.assert_refused(self.score(LAB.film("good"), arena=arena), "E_CONFIG", wanted,
                                r"arena\.toml:\d+:\d+", exit_code=2)

    def test_source_that_is_a_profile_of_the_simulator(self):
        text = LAB.film("good").read_text()
        source = re.search(r"^source = .*$", text, re.M)
        for profile in ("rvr", "argos3"):
            log = (self.changed_log(LAB.film("good"), (source[0], f'source = "{profile}"')) if source else
                   self.changed_log(LAB.film("good"), ('start = ', f'source = "{profile}"\nstart = ')))
            self.assert_refused(self.score(log), "E_CONFIG", f'`source` is "{profile}", which is a profile', exit_code=2)
        self.assertEqual(self.score(LAB.film("good")).returncode, 0)
        again = call(TRACK, "rescore", "r1", "--store", self.store, "--run", log)
        self.assertEqual(again.returncode, 2, again.stdout)
        self.assertIn("is a profile of the simulator", again.stderr)

    def test_points_and_robots_that_the_run_does_not_have(self):
        def point(time, robot="rvr1"):
            return f'[[point]]\nrobot = "{robot}"\ntime = "{time} s"\nu = 400\nv = 300\nwho = "A"\n'
        three = 'robots = ["rvr1", "rvr2", "rvr3"]\n'
        for robots, sections, wanted in (
                (three, point(-0.5), r'\[\[point\]\] of "rvr1" is at -0\.50 s, but the run goes from 0 s to'),
                (three, point(500), r'is at 500\.00 s, but the run goes'),
                ('robots = ["rvr1", "rvr2"]\n', point(1, "rvr3"), r'`robots` leaves out "rvr3"; it has: rvr1, rvr2'),
                ('robots = ["rvr1", "rvr2"]\n', '[[robot]]\nname = "rvr3"\nverdict = "VALID"\n',
                 r'`robots` leaves out "rvr3"; .* take out its \[\[robot\]\]'),
                ('robots = ["rvr1", "rvr2", "rvr3", "rvr2"]\n', "", r'`robots` has "rvr2" twice')):
            log = self.changed_log(LAB.film("good"))
            text = re.sub(r"^robots = .*\n", "", log.read_text(), flags=re.M)
            log.write_text(text.replace("start = ", robots + "start = ", 1) + "\n" + sections)
            self.assert_refused(self.score(log), "E_CONFIG", wanted, exit_code=2)

    def test_run_without_a_begin(self):
        log = self.changed_log(LAB.film("good"), ('start = "1.2 s"\n', ""))
        self.assert_refused(self.score(log), "E_CONFIG", "the start of the run is unknown", exit_code=2)

    def test_a_floor_tag_that_shall_start_the_run(self):
        log = self.changed_log(LAB.film("good"), ('start = "1.2 s"', 'sync = { tag = 100, when = "hidden" }'))
        self.assert_refused(self.score(log), "E_CONFIG", "tag 100 .*floor tag", exit_code=2)
        done = self.score(LAB.film("good"), "--sync-shown", "101")
        self.assert_refused(done, "E_CONFIG", "tag 101 .*floor tag", exit_code=2)

    def test_same_run_twice(self):
        first = self.score(LAB.film("good"))
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertIn("Stored as r1", first.stdout)
        again = self.score(LAB.film("good"))
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("already stored, as r1", again.stdout)
        self.assertEqual(len(runs_in(self.store)), 1)
        without_d4 = self.score(LAB.film("good"), "--design", "d4")
        self.assertEqual(without_d4.returncode, 4, without_d4.stderr)
        self.assertIn("no design d4", without_d4.stderr)

    def test_same_film_with_another_start_is_the_same_run(self):
        good = LAB.film("good")
        self.assertEqual(self.score(good).returncode, 0)
        for start in ("1.5 s", "0.9"):
            other = self.score(good, "--start", start)
            self.assertEqual(other.returncode, 3, other.stdout + other.stderr)
            self.assertRegex(other.stderr, r"good\.mkv: r1 is of this film from 1\.20 s to 4\.20 s, and this run would be "
                                           r"of it from .* it would count twice.*track rescore r1 --start")
        self.assertEqual(len(runs_in(self.store)), 1)
        again = call(TRACK, "rescore", "r1", "--store", self.store, "--start", "1.5 s")
        self.assertEqual(again.returncode, 0, again.stderr)
        with sqlite3.connect(f"file:{self.store}?mode=ro", uri=True) as base:
            self.assertEqual(base.execute("SELECT scorings FROM v_real_runs").fetchall(), [(2,)])
        known = self.score(good, "--start", "1.5 s")
        self.assertEqual(known.returncode, 0, known.stderr)
        self.assertIn("already stored, as r1", known.stdout)
        self.assertEqual(self.score(good).returncode, 3)
        for words in (("--start", "soon"), ("--start", "1", "--sync-hidden", "99")):
            done = call(TRACK, "rescore", "r1", "--store", self.store, *words)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("--start: E_CONFIG", done.stderr)
        several = call(TRACK, "rescore", "r1", "r1", "--store", self.store, "--start", "1.2")
        self.assertEqual(several.returncode, 2, several.stdout)
        self.assertIn("name one RUN", several.stderr)

    def test_same_film_with_almost_the_same_start_is_the_same_run(self):
        good = LAB.film("good")
        self.assertEqual(self.score(good, "--start", "1.2004 s").returncode, 0)
        other = self.score(good, "--start", "1.2006 s")
        self.assertEqual(other.returncode, 3, other.stdout + other.stderr)
        self.assertIn("it would count twice", other.stderr)
        self.assertEqual(len(runs_in(self.store)), 1)

    def test_same_film_without_its_second_camera_is_the_same_run(self):
        good = LAB.film("good")
        text = (LAB.lab / "arena.toml").read_text()
        camera = re.search(r"\[\[camera\]\].*?(?=\[\[)", text, re.S)[0]
        arena = LAB.copy_of_lab(f"{self.folder.name}/lab", arena_toml=[
            (camera, camera + camera.replace('"ceiling', '"beside'))])
        lens = (arena.parent / "ceiling.camera.toml").read_bytes()
        (arena.parent / "beside.camera.toml").write_bytes(lens + b"# beside\n")
        place = (arena.parent / "ceiling.place.toml").read_text()
        (arena.parent / "beside.place.toml").write_text(place.replace(
            hashlib.sha256(lens).hexdigest(), hashlib.sha256(lens + b"# beside\n").hexdigest()))
        log = self.changed_log(good)
        one = log.read_text()
        video = re.search(r"\[\[video\]\]\n(?:.+\n)+", one)[0]
        log.write_text(one.replace(video, video + "\n" + video.replace("ceiling", "beside")))
        both = self.score(log, arena=arena)
        self.assertEqual(both.returncode, 0, both.stdout + both.stderr)
        log.write_text(one)
        alone = self.score(log, arena=arena)
        self.assertEqual(alone.returncode, 3, alone.stdout + alone.stderr)
        self.assertRegex(alone.stderr, "r1 is of this film .* it would count twice.*with the start and the videos of r1")
        self.assertEqual(len(runs_in(self.store)), 1)

    def test_a_film_of_two_runs_has_two(self):
        good = LAB.film("good")
        mission = (good.parent / "good.mission.toml").read_text()
        short = self.folder / "short.toml"
        short.write_text(re.sub(r"^(duration|cycles) = .*$", 'duration = "1 s"', mission, flags=re.M))
        for number, start in enumerate(("1.2 s", "2.5 s")):
            done = self.score(good, "--mission", short, "--start", start)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual("note: r1 is of the same film, from 1.20 s to 2.20 s" in done.stderr, number == 1, done.stderr)
        self.assertEqual(len(runs_in(self.store)), 2)
        wrong = call(TRACK, "rescore", "r2", "--store", self.store, "--start", "2 s")
        self.assertEqual(wrong.returncode, 3, wrong.stdout)
        self.assertIn("r1 is of this film", wrong.stderr)

    def test_names_of_films_that_are_no_names(self):
        good = LAB.film("good")
        words = ("--arena", LAB.lab / "arena.toml", "--mission", good.parent / "good.mission.toml", "--start", "1.2",
                 "--into", self.store)
        for number, (name, wanted) in enumerate((("my run (2)", "my_run_2_"), ('a"b\'c', "a_b_c"), ("a\nb", "a_b"),
                                                 ("x" * 240, "x" * 240), ("-x", "-x"))):
            folder = self.folder / str(number)
            folder.mkdir()
            film = folder / f"{name}.mkv"
            shutil.copy(good.parent / "good.mkv", film)
            shutil.copy(good.parent / "good.times.csv", folder / f"{name}.times.csv")
            self.store.unlink(missing_ok=True)
            done = call(TRACK, "score", film, *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual([run[0] for run in runs_in(self.store)], [wanted])
            for command in (("rescore", "r1"), ("report", "r1", "-o", folder / "r1.html")):
                again = call(TRACK, *command, "--store", self.store)
                self.assertEqual(again.returncode, 0, again.stderr)
        before = runs_in(self.store)
        film = os.path.join(os.fsencode(self.folder), b"a\xffb.mkv")
        shutil.copy(good.parent / "good.mkv", film)
        done = subprocess.run([os.fsencode(TRACK), b"score", film, *(os.fsencode(str(word)) for word in words)],
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(b"is not UTF-8", done.stderr)
        self.assertEqual(runs_in(self.store), before)

    def test_cameras_that_cannot_be(self):
        for number, (change, code, wanted, exit_code) in enumerate((
                (('readout = "0 ms"', 'readout = "500 ms"'), "E_CONFIG", r"`readout` of camera \"ceiling\" is 500\.0 ms", 2),
                (("height = [1.5, 4.5]", "height = [3.5, 4.5]"), "E_EXTRINSICS", r"hangs at 2\..* `height` of arena\.toml", 1),
                (("height = [1.5, 4.5]", "height = [0, 4.5]"), "E_CONFIG", r"arena\.toml:\d+:\d+: .*`height`", 2),
                (("height = [1.5, 4.5]", "height = [nan, 4.5]"), "E_CONFIG", r"arena\.toml:\d+:\d+: .*`height`", 2),
                (("height = [1.5, 4.5]", "height = [1.5, 1e9]"), "E_CONFIG", r"arena\.toml:\d+:\d+: .*`height`", 2))):
            arena = LAB.copy_of_lab(f"{self.folder.name}/{number}", arena_toml=[change])
            self.assert_refused(self.score(LAB.film("good"), arena=arena), code, wanted, exit_code=exit_code)

    def test_what_the_arena_says_of_a_shutter_is_corrected_by_rescoring(self):
        def times():
            with sqlite3.connect(f"file:{self.store}?mode=ro", uri=True) as base:
                return [time for time, in base.execute("SELECT time_s FROM v_real_samples ORDER BY run, number")]
        self.assertEqual(self.score(LAB.film("good")).returncode, 0)
        before = times()
        arena = LAB.copy_of_lab(f"{self.folder.name}/shutter", arena_toml=[('readout = "0 ms"', 'readout = "20 ms"')])
        again = call(TRACK, "rescore", "r1", "--store", self.store, "--arena", arena)
        self.assertIn(again.returncode, (0, 6), again.stderr)
        later = [now - then for now, then in zip(times(), before, strict=True)]
        self.assertTrue(all(0 < late < 0.02 for late in later))
        self.assertGreater(max(later) - min(later), 0.002)
        once_more = call(TRACK, "rescore", "r1", "--store", self.store)
        self.assertEqual(once_more.returncode, again.returncode, once_more.stderr)
        self.assertEqual([now - then for now, then in zip(times(), before, strict=True)], later)

    def test_robots_that_are_larger_in_the_mission(self):
        good = LAB.film("good")
        mission = self.folder / "large.toml"
        text = (good.parent / "good.mission.toml").read_text()
        self.assertIn("length = 0.286, width = 0.286", text)
        mission.write_text(text.replace("length = 0.286, width = 0.286", "length = 0.7, width = 0.7"))
        done = self.score(good, "--mission", mission)
        self.assert_stored_as(done, "DEGRADED", "W_BODIES_OVERLAP", "mm inside", "mission's robot larger")

    def test_same_run_with_another_calibration(self):
        self.score(LAB.film("good"))
        before = runs_in(self.store)
        arena = LAB.copy_of_lab(f"{self.folder.name}/mended",
                                rvr1_offset_toml=[("x = 0.07", "x = 0.06")])
        done = self.score(LAB.film("good"), arena=arena)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("rescore", done.stderr)
        self.assertEqual(runs_in(self.store), before)
        again = call(TRACK, "rescore", "r1", "--store", self.store, "--arena", arena)
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_store_that_another_program_writes(self):
        self.score(LAB.film("good"))
        with open(f"{self.store}.lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            lock.write("pid=4711 host=elsewhere\n")
            lock.flush()
            for words in (["score", "--run", LAB.film("good"), "--arena", LAB.lab / "arena.toml",
                           "--into", self.store],
                          ["rescore", "r1", "--store", self.store],
                          ["override", "r1", "--store", self.store, "--verdict", "valid", "--who",
                           "M. Muster", "--reason", "seen"]):
                done = call(TRACK, *words)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn("pid=4711 host=elsewhere", done.stderr)

    def test_score_again_and_override(self):
        self.score(LAB.film("good"))
        before = runs_in(self.store)
        again = call(TRACK, "rescore", "r1", "--store", self.store)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(runs_in(self.store), before)
        blank = call(TRACK, "override", "r1", "--store", self.store, "--verdict", "invalid",
                     "--who", " ", "--reason", "pushed")
        self.assertEqual(blank.returncode, 2, blank.stdout)
        word = call(TRACK, "override", "r1", "--store", self.store, "--verdict", "invalid",
                    "--who", "M. Muster", "--reason", "robot pushed by hand")
        self.assertEqual(word.returncode, 0, word.stderr)
        self.assertEqual(runs_in(self.store), before)
        # The same again is what that person saw: all that say a verdict say that one.
        again = call(TRACK, "rescore", "r1", "--store", self.store, "--json")
        self.assertEqual(again.returncode, 6, again.stderr)
        said = json.loads(again.stdout)
        self.assertEqual((said["before"]["verdict"], said["verdict"], said["measured_verdict"]),
                         ("INVALID", "INVALID", before[0][1]))
        # Other inputs are another scoring.
        arena = LAB.copy_of_lab(f"{self.folder.name}/mended",
                                rvr1_offset_toml=[("x = 0.07", "x = 0.0701")])
        other = call(TRACK, "rescore", "r1", "--store", self.store, "--arena", arena)
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertIn("r1 was: score", other.stdout)
        self.assertIn("The verdict INVALID by M. Muster no longer counts", other.stderr)
        self.assertIn("swarmsmith track override r1", other.stderr)
        report = json.loads(call(TRACK, "report", "r1", "--store", self.store, "--json").stdout)
        self.assertEqual(report["verdict"], report["measured_verdict"])
        self.assertNotEqual(report["verdict"], "INVALID")
        self.assertFalse(report["overrides"][0]["counts"])


if __name__ == "__main__":
    unittest.main()
