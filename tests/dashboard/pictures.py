"""Makes the pictures of docs/dashboard.md anew: the pages of a small campaign, as the tests look at them.

Usage: pictures.py FOLDER, with SWARMSMITH_BIN as in the tests.
"""
import pathlib
import shutil
import sys
import unittest

from dashboards import TWO_MISSIONS, DashboardTest, add_real_run, campaign_text, finished_store, query, shared_folder
from pages_test import pages_of

#: Name of the file, page of `pages_of`, dark, height in pixels.
PICTURES = (("campaigns", "campaigns", False, 900), ("race", "race", True, 1000), ("run", "run", False, 830),
            ("runs", "runs beside each other", True, 1000), ("space", "space", False, 1000), ("results", "results", False, 900))


class Pictures(DashboardTest):
    def test_pictures(self):
        store = shared_folder() / "demo.db"
        shutil.copy(finished_store(), store)
        add_real_run(store, "c%d" % query(store, "SELECT best_candidate AS best FROM v_designs WHERE design = 1")[0]["best"])
        serving = self.dashboard(store)
        pages = {name: rest for name, *rest in pages_of(store)}
        for name, page_name, dark, height in PICTURES:
            page = self.page(serving, *pages[page_name], width=1280, dark=dark)
            page.viewport(1280, height)
            page.wait("!document.querySelector('.waiting')")
            page.shot(str(FOLDER / f"dashboard-{name}.webp"), whole=False)
            page.close()

    def test_picture_of_the_fleet_while_it_works(self):
        file = shared_folder() / "working.toml"
        file.write_text(campaign_text(100_000, seed=7, tests=20) + TWO_MISSIONS)
        serving = self.start_serving("run", file, "--store", shared_folder() / "working.db", "--workers", "2", "--http", "127.0.0.1:*")
        page = self.page(serving, "#/fleet", "document.querySelector('canvas')", width=1280)
        page.viewport(1280, 760)
        # Half a minute of its history.
        page.wait(r"/up for([3-5]\d\D|\d+\Dmin)/.test(document.querySelector('main').textContent)", timeout=120)
        page.shot(str(FOLDER / "dashboard-fleet.webp"), whole=False)


if __name__ == "__main__":
    FOLDER = pathlib.Path(sys.argv.pop(1))
    unittest.main()
