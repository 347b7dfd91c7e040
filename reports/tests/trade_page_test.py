#!/usr/bin/python3
"""Opens the page that `nearmiss trade` writes in Chromium, and uses it as a person does.

  reports/tests/trade_page_test.py --build FOLDER
  reports/tests/trade_page_test.py --build FOLDER --trade DIR --images DIR   writes pictures of a measured trade instead

Exit code 77: Chromium, its driver or python3-selenium is not installed, or the build writes no pages.
"""

import argparse
import json
import pathlib
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the source tree stays as it is
from browser import Browser, Nearmiss

ARGUMENTS = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ARGUMENTS.add_argument("--build", type=pathlib.Path, required=True)
ARGUMENTS.add_argument("--trade", type=pathlib.Path)
ARGUMENTS.add_argument("--images", type=pathlib.Path)
ARGUMENTS.add_argument("tests", nargs="*", metavar="TEST", help="only these: TradePage.test_draws_the_profile")
OPTIONS = ARGUMENTS.parse_args()
nearmiss = Nearmiss(OPTIONS.build)
QUERIES = ["moving_sphere_box", "sphere_sphere_overlap", "closest_point_segment"]


class TradePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        queries = [word for query in QUERIES for word in ("--query", query)]
        subjects = [word for subject in ("collide-fast-float", "collide-fast-double", "collide-certified-double") for word in ("-s", subject)]
        nearmiss("trade", *queries, *subjects, "--cases", 80, "--repeats", 2, "--out", cls.folder)
        nearmiss("render", cls.folder)  # fails where the build writes no pages
        cls.trade = json.loads((cls.folder / "trade.json").read_text())
        cls.browser = Browser(1360, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.kept.cleanup()

    def setUp(self):
        self.browser.requests(), self.browser.errors()  # forgets those of the test before
        self.browser.open(self.folder / "trade.html")

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def all(self, selector):
        return self.browser.all(selector)

    def test_draws_each_subject_in_each_panel(self):
        self.assertEqual(len(self.all(".queries button")), len(QUERIES))
        charts = self.all(".charts svg")
        self.assertEqual(len(charts), 3)
        subjects = self.trade["queries"][0]["subjects"]
        self.assertEqual(len(charts[0].find_elements("css selector", ".point")), len(subjects))
        self.assertEqual(len(charts[0].find_elements("css selector", ".tolerance")), 1)
        self.assertEqual(len(charts[0].find_elements("css selector", ".band")), 1)
        self.assertEqual(len(self.all(".query tbody tr")), len(subjects))

    def test_places_a_slower_subject_further_right(self):
        places = self.browser.run("""
          return [...document.querySelectorAll('.charts svg:first-child .point')].map(p => [p.dataset.subject, p.getBoundingClientRect().left])""")
        cost = {s["subject"]: s["time"]["call"]["p50"] for s in self.trade["queries"][0]["subjects"]}
        by_place = [cost[name] for name, _ in sorted(places, key=lambda p: p[1])]
        self.assertEqual(by_place, sorted(by_place))

    def test_shows_the_chosen_query(self):
        button = self.all(".queries button")[1]
        button.click()
        name = self.trade["queries"][1]["query"]
        self.assertEqual(self.browser.find(".query h2").text, name)
        self.assertEqual(self.browser.address(), name)
        self.assertEqual(button.get_attribute("aria-pressed"), "true")

    def test_names_the_cheapest(self):
        best = self.trade["queries"][0]["cheapest"]
        headline = self.browser.find(".headline").text
        self.assertIn(best if best else "No subject", headline)

    def test_draws_the_stages_of_a_subject_that_has_them(self):
        for number, query in enumerate(self.trade["queries"]):
            self.all(".queries button")[number].click()
            stages = {s["subject"]: s["stages"] for s in query["subjects"] if s["stages"]}
            self.assertEqual(list(stages), ["collide-certified-double"])
            figure = self.browser.find(".stages[data-subject=collide-certified-double]")
            for bar, share in zip(figure.find_elements("css selector", ".bar-of-stages div"), (lambda s: s["calls"]["share"], lambda s: s["share_of_time"])):
                widths = [part.rect["width"] / bar.rect["width"] for part in bar.find_elements("css selector", ".stage")]
                self.assertEqual(len(widths), len(stages["collide-certified-double"]))
                for width, stage in zip(widths, stages["collide-certified-double"]):
                    self.assertAlmostEqual(width, share(stage), delta=0.005)

    def test_draws_the_profile(self):
        self.assertEqual(len(self.all(".curve")), len(self.trade["profile"]["curves"]))

    def test_is_light_and_dark(self):
        paper = lambda: self.browser.run("return getComputedStyle(document.body).backgroundColor")
        before = paper()
        self.all("#theme")[0].click()
        self.assertNotEqual(paper(), before)
        self.browser.run("localStorage.clear()")

    def test_asks_no_network(self):
        self.assertEqual(self.browser.foreign_requests(), [])

    def test_is_rendered_from_its_file(self):
        with tempfile.TemporaryDirectory() as name:
            (pathlib.Path(name) / "trade.json").write_text(json.dumps(self.trade))
            nearmiss("render", name)
            self.browser.open(pathlib.Path(name) / "trade.html")
            self.assertEqual(len(self.all(".queries button")), len(QUERIES))


class ViewOfATrade(unittest.TestCase):
    """The trade as a view of the page of a run."""

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        nearmiss("run", "-q", "moving_sphere_box", "-s", "collide-fast-float", "--measure", "1e-9", "--cases", 300,
                 "--out", cls.folder, codes=(0, 1))
        nearmiss("trade", "recorded", "-s", "collide-fast-float", "-s", "collide-certified-double", "--cases", 60, "--repeats", 1,
                 "--out", cls.folder / "trade")
        (cls.folder / "bad").mkdir()
        (cls.folder / "bad" / "trade.json").write_text("{}")
        nearmiss("render", cls.folder, "--seconds", 0)
        cls.trade = json.loads((cls.folder / "trade" / "trade.json").read_text())
        cls.browser = Browser(1360, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.kept.cleanup()

    def setUp(self):
        self.browser.requests(), self.browser.errors()
        self.browser.open(self.folder / "index.html")

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def view(self, name):
        return self.browser.named("#views button", name)

    def test_is_beside_the_findings(self):
        self.assertEqual([b.text for b in self.browser.all("#views button")], ["Findings", "Subjects", "Price: recorded"])
        self.assertTrue(self.browser.find("#findings").is_displayed())
        self.assertFalse(self.browser.find("#price").is_displayed())
        self.view("Price: recorded").click()
        self.assertFalse(self.browser.find("#findings").is_displayed())
        self.assertEqual(len(self.browser.all("#price .queries button")), len(self.trade["queries"]))
        self.assertEqual(len(self.browser.all("#price .charts svg")), 3)
        self.assertEqual(len(self.browser.all("#price .charts svg:first-child .point")), len(self.trade["queries"][0]["subjects"]))
        self.assertEqual(len(self.browser.all("#price .curve")), len(self.trade["profile"]["curves"]))
        self.assertTrue(self.browser.find("#price .headline").text)
        self.view("Findings").click()
        self.assertTrue(self.browser.find("#finding").is_displayed())

    def test_looks_as_on_its_own_page(self):
        drawn = "return [...document.querySelectorAll('.query svg')].map(e => e.outerHTML)"
        self.view("Price: recorded").click()
        here = self.browser.run(drawn)
        self.browser.open(self.folder / "trade" / "trade.html")
        self.assertEqual(here, self.browser.run(drawn))

    def test_has_an_address(self):
        query = self.trade["queries"][1]["query"]
        self.view("Price: recorded").click()
        self.browser.all("#price .queries button")[1].click()
        self.assertEqual(self.browser.address(), f"price/recorded/{query}")
        self.view("Findings").click()
        self.assertNotIn("price", self.browser.address())
        self.browser.open(self.folder / "index.html", f"price/recorded/{query}")
        self.assertEqual(self.browser.find("#price .query h2").text, query)

    def test_keys_act_on_the_shown_view(self):
        row = self.browser.run("return nearmiss.table.selected()")
        self.view("Price: recorded").click()
        self.browser.keys("j")
        self.assertEqual(self.browser.find("#price .query h2").text, self.trade["queries"][1]["query"])
        self.assertEqual(self.browser.run("return nearmiss.table.selected()"), row)

    def test_a_file_that_is_no_trade_is_named(self):
        self.assertIn("bad/trade.json: it is not a trade", self.browser.run("return document.getElementById('head').textContent"))

    def test_asks_no_network(self):
        self.view("Price: recorded").click()
        self.assertEqual(self.browser.foreign_requests("blob:"), [])


def write_images(trade, folder):
    """Pictures of the page of a trade, light and dark."""
    folder.mkdir(parents=True, exist_ok=True)
    browser = Browser(1360, 900)
    browser.open(trade / "trade.html")
    for theme in ("light", "dark"):
        browser.run("document.documentElement.dataset.theme = arguments[0]", theme)
        time.sleep(0.3)
        (folder / f"trade-{theme}.png").write_bytes(browser.screenshot("png"))
    browser.quit()


if __name__ == "__main__":
    if OPTIONS.images:
        write_images(OPTIONS.trade, OPTIONS.images)
        sys.exit(0)
    unittest.main(argv=[sys.argv[0], "-v", *OPTIONS.tests])
