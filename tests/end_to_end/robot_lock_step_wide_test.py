"""Runs of robots' nodes over a real ROS master have the scores and last states of `evaluate`: every mission under every
flavour and profile at full length, and swarms of 1 to 10 robots."""
import itertools
import unittest

from robot_lock_step_test import MACHINES, NO_ROS, LockStep, mission_of
from robots import Master

MISSIONS = ("aggregation", "grid_exploration", "color_selection")
PROFILES = ("argos3", "rvr", "pseudo-reality", "thesis-robots")


@unittest.skipIf(NO_ROS, NO_ROS or "")
class Wide(LockStep):
    def test_every_mission_flavour_and_profile(self):
        master = Master(self, self.folder)
        for seed, (mission, flavour, profile) in enumerate(itertools.product(MISSIONS, MACHINES, PROFILES), 1):
            # 800 control cycles a second take as many rounds: a tenth of the mission.
            file = mission_of(self.folder, mission, seconds=12) if profile == "thesis-robots" else mission
            with self.subTest(mission=mission, flavour=flavour, profile=profile):
                self.compared(master, file, flavour, profile, seed)

    def test_swarms_of_one_to_ten(self):
        master = Master(self, self.folder)
        for count in range(1, 11):
            with self.subTest(robots=count):
                self.compared(master, mission_of(self.folder, "aggregation", count), "watermelon", "rvr", count, count=count)


if __name__ == "__main__":
    unittest.main()
