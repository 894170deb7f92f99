"""A campaign on a disk that fills up waits for room, and then ends as if nothing had been."""
import os
import subprocess
import time
import unittest

from programs import ProgramTest, call, start
import programs


class DiskFull(ProgramTest):
    budget = 3000

    def mount(self):
        """A tmpfs of 700 KiB in the test's own folder; skips where one cannot be mounted."""
        disk = self.folder / "disk"
        disk.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=700k", "tmpfs", str(disk)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest("skipped: mounting a tmpfs needs root: " + done.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "-l", str(disk)])
        return disk

    def test_a_full_disk_pauses_the_campaign_and_room_lets_it_go_on(self):
        undisturbed = self.folder / "undisturbed.db"
        done = self.run_campaign(undisturbed)
        self.assertEqual(done.returncode, 0, done.stderr)

        disk = self.mount()
        store = disk / "campaign.db"
        log = (self.folder / "log").open("w+")
        process = subprocess.Popen(
            [programs.SWARMSMITH, "run", str(self.file), "--store", str(store), "--no-dashboard"],
            stdout=subprocess.DEVNULL, stderr=log, start_new_session=True)
        self.addCleanup(self._end, process)
        deadline = time.monotonic() + 90
        while "full" not in (self.folder / "log").read_text():
            self.assertIsNone(process.poll(), "it ended on a full disk")
            self.assertLess(time.monotonic(), deadline, "it never said that the disk is full")
            time.sleep(0.05)
        subprocess.run(["mount", "-o", "remount,size=64m", str(disk)], check=True)
        self.assertEqual(process.wait(timeout=240), 0, (self.folder / "log").read_text())
        self.assert_clean(store)
        self.assertEqual(self.digest(store), self.digest(undisturbed))


if __name__ == "__main__":
    unittest.main()
