"""A run that another laboratory made, filmed afterwards by the virtual camera at the instants at which a camera had recorded.

The camera's clock is CLOCK_MONOTONIC of this host, as `swarmsmith track record` writes it beside the frames.
"""
import csv
import threading
import time

from filmed_lab import FILM, must

RATE = 15


class Recorder:
    """Stands for `swarmsmith track record`: writes when frames are taken, while a run goes on; the pictures come later."""

    def __init__(self, video):
        self.times = video.with_suffix(".times.csv")
        self.part = self.times.with_name(self.times.name + ".part")
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.record)

    def __enter__(self):
        self.part.write_text("frame,time_s,clock_s\n")
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()
        self.part.rename(self.times)

    def record(self):
        first = time.monotonic()
        frame = 0
        with self.part.open("a") as out:
            while not self.over.wait(max(0, first + frame / RATE - time.monotonic())):
                now = time.monotonic()
                out.write(f"{frame},{now - first:.6f},{now:.6f}\n")
                out.flush()
                frame += 1


def recorded_at(video, start_clock_s, before_s, seconds):
    """The same of a run that needs no waiting: frames from so long before the start on."""
    first = start_clock_s - before_s
    rows = [f"{i},{i / RATE:.6f},{first + i / RATE:.6f}\n" for i in range(int(seconds * RATE) + 1)]
    video.with_suffix(".times.csv").write_text("frame,time_s,clock_s\n" + "".join(rows))


def film_trajectory(lab, video, trajectory, start_clock_s, mission, *wishes):
    """Renders what the camera would have seen of the trajectory (docs/trajectories.md), which begins at that clock."""
    must(FILM, "run", video.with_suffix(""), "--lab", lab, "--mission", mission, "--trajectory", trajectory,
         "--camera-clock", video.with_suffix(".times.csv"), "--start-clock", repr(start_clock_s), *wishes)


def write_robot_logs(folder, run, trajectory, machine, flavour, start_clock_s, seconds):
    """What nodes would have written of a trajectory with commands, as `swarmsmith evaluate --csv` records it."""
    with open(trajectory, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    robots = sorted({int(row["robot"]) for row in rows})
    for robot in robots:
        name = f"rvr{robot + 1}"
        lines = ["cycle,time_s,clock_s,late_ms,act,state,left_mps,right_mps,leds,"
                 + ",".join(f"prox{i}" for i in range(8)) + ",r,g,b,raw_r,raw_g,raw_b,neighbours,light,"
                 + ",".join(f"{what}_{feed}_ms" for what in ("age", "stamp")
                            for feed in ("proximity", "ground", "neighbours", "light")) + ",drawn,event"]
        for row in rows:
            if int(row["robot"]) != robot or int(row["cycle"]) == 0:
                continue
            at = int(row["cycle"]) / 10
            lines.append(f"{row['cycle']},{at},{start_clock_s + at:.6f},0.1,step,{row['state']},{row['cmd_left']},"
                         f"{row['cmd_right']},,{','.join(['inf'] * 8)},0,0,0,0,0,0,,,20,20,,,,,,,0,")
        (folder / f"{run}.{name}.log.csv").write_text("\n".join(lines) + "\n")
        (folder / f"{run}.{name}.toml").write_text(
            f'format = 1\nkind = "robot log"\nrun = "{run}"\nrobot = "{name}"\nrobot_index = {robot}\n'
            f'machine = "{machine}"\nmachine_digest = "aa"\nflavour = "{flavour}"\nturn_clock = "cycles"\nseed = 1\n'
            f'lock_step = false\nperiod_s = 0.1\nseconds = {seconds}\nmax_mps = 0.35\nprogram = "test"\nhost = "here"\n'
            f'scheduling = "none"\nstart_clock_s = {start_clock_s!r}\nstart_unix_s = 1764075000\n\n'
            f'[end]\nstate = "ended"\nverdict = "VALID"\nreasons = []\nstepped = {10 * seconds}\nheld = 0\nskipped = 0\n')
    return [f"rvr{robot + 1}" for robot in robots]
