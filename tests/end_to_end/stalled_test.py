"""Programs of tests with threads, sockets or processes, each of their processes stopped now and then, as on a machine that
has no time for them: what a test finds must not depend on that."""
import pathlib
import random
import signal
import subprocess
import tempfile
import time
import unittest

from programs import BIN, PATIENCE, send

PROGRAMS = ("process", "proto", "service", "processes", "worker", "cli_dashboard", "track_live", "robot_zeromq",
            "robot_world", "robot_app")


def tree_of(pid):
    """The process and all that it has started and that is alive."""
    try:
        children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return []
    return [pid, *(one for child in map(int, children) for one in tree_of(child))]


class Stalled(unittest.TestCase):
    def end_of(self, program):
        """The exit code of a program whose processes are stopped, one after the other, and what it printed."""
        rng = random.Random(program)
        deadline = time.monotonic() + 300 * PATIENCE
        with tempfile.TemporaryFile("w+") as output:
            process = subprocess.Popen([BIN / f"{program}_test"], stdout=output, stderr=output, start_new_session=True)
            while process.poll() is None and time.monotonic() < deadline:
                stopped = rng.choice(tree_of(process.pid) or [process.pid])
                send(stopped, signal.SIGSTOP)
                time.sleep(rng.uniform(0.3, 0.8))
                send(stopped, signal.SIGCONT)
                time.sleep(rng.uniform(0, 0.3))
            if process.poll() is None:
                send(-process.pid, signal.SIGKILL)
            code = process.wait()
            output.seek(0)
            return code, output.read()

    def test_programs_end_well(self):
        for program in PROGRAMS:
            with self.subTest(program):
                code, output = self.end_of(program)
                self.assertEqual(code, 0, output)


if __name__ == "__main__":
    unittest.main()
