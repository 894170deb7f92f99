"""The manual as a site: it is built, no link of it leads nowhere, and a real browser opens it from the disk: search
finds, pictures are there, and nothing is asked of any host."""
import html.parser
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest
import urllib.parse

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
#: Where pictures of pages are left, to be looked at.
PICTURES = os.environ.get("SWARMSMITH_PICTURES")
sys.path[:0] = [str(SOURCE / "tests/dashboard"), str(SOURCE / "packaging"), str(SOURCE / "packaging/manual")]
import browser  # noqa: E402
import build as manual  # noqa: E402
import programs  # noqa: E402


class Links(html.parser.HTMLParser):
    """Anchors of a page, where its links lead, and what a browser loads for it."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.anchors.update(filter(None, (given.get("id"), given.get("name") if tag == "a" else None)))
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        elif tag in ("script", "img", "iframe", "source") and given.get("src"):
            self.loads.append(given["src"])
        elif tag == "link" and given.get("href") and given.get("rel") != "canonical":
            self.loads.append(given["href"])


def wrong_links(site):
    """(page, link) of what leads nowhere or is loaded from another host."""
    pages = {path: Links(path.read_text()) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        if path.name == "404.html":  # its links begin at the root of a server
            continue
        for link in [*page.links, *page.loads]:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loads or parts.scheme not in ("http", "https", "mailto"):
                    yield path.relative_to(site), link
                continue
            there = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not there.is_file():
                yield path.relative_to(site), link
            elif parts.fragment and there in pages:
                anchor = urllib.parse.unquote(parts.fragment)
                if anchor not in pages[there].anchors and anchor != "__tabbed":
                    yield path.relative_to(site), link


@unittest.skipUnless(shutil.which("mkdocs"), "mkdocs is not there; install mkdocs-material")
class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-manual-")
        cls.addClassCleanup(folder.cleanup)
        cls.site = pathlib.Path(folder.name) / "site"
        manual.build(BIN, cls.site)

    def test_no_link_leads_nowhere(self):
        self.assertGreater(len(list(self.site.rglob("*.html"))), 50)
        self.assertEqual([f"{page}: {link}" for page, link in wrong_links(self.site)], [])

    def test_no_style_sheet_loads_from_elsewhere(self):
        for path in self.site.rglob("*.css"):
            self.assertEqual(re.findall(r"url\(['\"]?(?:https?:)?//[^)]*\)|@import", path.read_text()), [], path)

    def test_every_page_of_docs_is_in_it(self):
        for path in (SOURCE / "docs").rglob("*.md"):
            place = path.relative_to(SOURCE / "docs").with_suffix(".html").as_posix().replace("README", "index")
            self.assertTrue((self.site / place).is_file(), place)

    def test_every_page_names_the_version(self):
        for path in self.site.rglob("*.html"):
            self.assertIn(f"Swarmsmith {programs.version(BIN)}", path.read_text(), path)

    def test_links_to_pages_have_their_titles(self):
        for path in self.site.rglob("*.html"):
            self.assertEqual(re.findall(r"<a [^>]*>[\w/.-]+\.md</a>", path.read_text()), [], path)

    def test_every_command_and_option_is_in_it(self):
        for program in programs.built(BIN):
            tells = programs.declared(BIN, program)
            text = (self.site / f"{program}.html").read_text()
            for command in tells["commands"]:
                for option in command["options"]:
                    self.assertIn(option["names"][-1], text)
                if command["name"]:
                    self.assertIn(f'id="{command["name"].replace(" ", "-")}"', text)

    def test_every_public_view_is_in_it(self):
        text = (self.site / "views.html").read_text()
        views = re.findall(r"^CREATE VIEW (v_\w+)", (SOURCE / "storage/schema/views.sql").read_text(), re.M)
        self.assertGreater(len(views), 20)
        for view in views:
            self.assertIn(f'id="{view}"', text)

    @unittest.skipUnless(browser.program(), "chromium-headless-shell is not there")
    def test_a_browser_reads_it_from_the_disk(self):
        chromium = browser.Browser()
        self.addCleanup(chromium.close)
        page = chromium.page()
        page.open((self.site / "index.html").as_uri())
        self.shot(page, "index")
        self.search(page, "elitist", "campaign-file.html")
        self.shot(page, "search")
        # From a page in a folder below, too.
        page.open((self.site / "decisions/index.html").as_uri())
        self.search(page, "v_leaderboard", "storage.html")
        for name in ("getting-started", "tutorial-mission", "tracking", "swarmsmith", "views", "command-line"):
            page.open((self.site / f"{name}.html").as_uri())
            self.shot(page, name)
            self.assertEqual(page.js("[...document.images].filter(i => i.loading !== 'lazy' && !i.naturalWidth)"
                                     ".map(i => i.src)"), [])
        page.open((self.site / "campaign-file.html").as_uri())
        self.shot(page, "campaign-file")
        self.assertEqual(page.js("[...document.querySelectorAll('td:first-child code')].filter(c => c.getClientRects().length > 1)"
                                 ".map(c => c.textContent)"), [], "keys are in one piece")
        page.viewport(390, 844)
        page.open((self.site / "tutorial-paper.html").as_uri())
        self.shot(page, "phone")
        self.assertLessEqual(page.js("document.documentElement.scrollWidth"), 390)
        self.assertEqual(page.errors(), [])
        self.assertEqual(page.hosts(), set())
        page = chromium.page()
        page.media(dark=True)
        page.open((self.site / "index.html").as_uri())
        self.shot(page, "dark")
        self.assertEqual(page.js("document.body.dataset.mdColorScheme"), "slate")

    def search(self, page, word, found):
        """Types a word into the search as a person does, and finds a page."""
        page.js("document.querySelector('#__search').click(); document.querySelector('input[name=query]').focus()")
        # What is typed before that, the theme may miss.
        page.wait("!/^Initializing/.test(document.querySelector('.md-search-result__meta').textContent.trim())", timeout=120)
        for letter in word:
            page.key(letter)
        # Each letter has its results.
        page.wait("[...document.querySelectorAll('.md-search-result__link')].some(a => a.pathname.endsWith('/%s'))" % found,
                  timeout=120)

    @staticmethod
    def shot(page, name):
        if PICTURES:
            pathlib.Path(PICTURES).mkdir(parents=True, exist_ok=True)
            page.shot(pathlib.Path(PICTURES) / f"{name}.png", whole=False)


class TheCheck(unittest.TestCase):
    def test_finds_what_is_wrong(self):
        with tempfile.TemporaryDirectory() as name:
            site = pathlib.Path(name)
            (site / "a.html").write_text('<p id="here"><a href="b.html#there">x</a><a href="#here">x</a>'
                                         '<a href="https://example.org/">x</a></p>')
            (site / "b.html").write_text('<a href="a.html#gone">x</a><a href="c.html">x</a><a href="a.html#here">x</a>'
                                         '<script src="https://example.org/x.js"></script><img src="p.png">')
            self.assertEqual([(str(page), link) for page, link in wrong_links(site)],
                             [("a.html", "b.html#there"), ("b.html", "a.html#gone"), ("b.html", "c.html"),
                              ("b.html", "https://example.org/x.js"), ("b.html", "p.png")])


if __name__ == "__main__":
    unittest.main()
