#!/usr/bin/python3
"""Opens the page that `nearmiss trade` writes in Chromium, and uses it as a person does.

  reports/tests/trade_page_test.py --build FOLDER
  reports/tests/trade_page_test.py --build FOLDER --trade DIR --images DIR   writes pictures of a measured trade instead

Exit code 77: Chromium, its driver or python3-selenium is not installed, or the build writes no pages.
"""

import argparse
import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
CHROMIUM, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(77)
for program in (CHROMIUM, DRIVER):
    if not os.path.exists(program):
        print(f"skipped: {program} is not installed")
        sys.exit(77)

ARGUMENTS = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ARGUMENTS.add_argument("--build", type=pathlib.Path, required=True)
ARGUMENTS.add_argument("--trade", type=pathlib.Path)
ARGUMENTS.add_argument("--images", type=pathlib.Path)
OPTIONS = ARGUMENTS.parse_args()
PROGRAM = OPTIONS.build / "reports" / "nearmiss"
QUERIES = ["moving_sphere_box", "sphere_sphere_overlap", "closest_point_segment"]


def new_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(DRIVER), options=options)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 1360, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    return driver


class TradePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        queries = [word for query in QUERIES for word in ("--query", query)]
        subjects = [word for subject in ("collide-fast-float", "collide-fast-double", "collide-certified-double") for word in ("-s", subject)]
        ran = subprocess.run([PROGRAM, "trade", *queries, *subjects, "--cases", "80", "--repeats", "2", "--out", cls.folder],
                             capture_output=True, text=True, cwd=TOP)
        assert ran.returncode == 0, ran.stderr
        if not (cls.folder / "trade.html").exists():
            print("skipped: this build writes no pages")
            os._exit(77)
        cls.trade = json.loads((cls.folder / "trade.json").read_text())
        cls.browser = new_browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.kept.cleanup()

    def setUp(self):
        self.browser.get_log("browser"), self.browser.get_log("performance")
        self.browser.get((self.folder / "trade.html").resolve().as_uri())

    def tearDown(self):
        self.assertEqual([e["message"] for e in self.browser.get_log("browser")], [])

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def test_draws_each_subject_in_each_panel(self):
        self.assertEqual(len(self.all("#queries button")), len(QUERIES))
        charts = self.all(".charts svg")
        self.assertEqual(len(charts), 3)
        subjects = self.trade["queries"][0]["subjects"]
        self.assertEqual(len(charts[0].find_elements(By.CSS_SELECTOR, ".point")), len(subjects))
        self.assertEqual(len(charts[0].find_elements(By.CSS_SELECTOR, ".tolerance")), 1)
        self.assertEqual(len(charts[0].find_elements(By.CSS_SELECTOR, ".band")), 1)
        self.assertEqual(len(self.all("#query tbody tr")), len(subjects))

    def test_places_a_slower_subject_further_right(self):
        places = self.browser.execute_script("""
          return [...document.querySelectorAll('.charts svg:first-child .point')].map(p => [p.dataset.subject, p.getBoundingClientRect().left])""")
        cost = {s["subject"]: s["time"]["call"]["p50"] for s in self.trade["queries"][0]["subjects"]}
        by_place = [cost[name] for name, _ in sorted(places, key=lambda p: p[1])]
        self.assertEqual(by_place, sorted(by_place))

    def test_shows_the_chosen_query(self):
        button = self.all("#queries button")[1]
        button.click()
        name = self.trade["queries"][1]["query"]
        self.assertEqual(self.browser.find_element(By.CSS_SELECTOR, "#query h2").text, name)
        self.assertTrue(self.browser.current_url.endswith("#" + name))
        self.assertEqual(button.get_attribute("aria-pressed"), "true")

    def test_names_the_cheapest(self):
        best = self.trade["queries"][0]["cheapest"]
        headline = self.browser.find_element(By.CSS_SELECTOR, ".headline").text
        self.assertIn(best if best else "No subject", headline)

    def test_draws_the_profile(self):
        self.assertEqual(len(self.all(".curve")), len(self.trade["profile"]["curves"]))

    def test_is_light_and_dark(self):
        paper = lambda: self.browser.execute_script("return getComputedStyle(document.body).backgroundColor")
        before = paper()
        self.all("#theme")[0].click()
        self.assertNotEqual(paper(), before)
        self.browser.execute_script("localStorage.clear()")

    def test_asks_no_network(self):
        messages = [json.loads(e["message"])["message"] for e in self.browser.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        self.assertTrue(urls)
        self.assertEqual([u for u in urls if not u.startswith(("file:", "data:"))], [])

    def test_is_rendered_from_its_file(self):
        with tempfile.TemporaryDirectory() as name:
            (pathlib.Path(name) / "trade.json").write_text(json.dumps(self.trade))
            ran = subprocess.run([PROGRAM, "render", name], capture_output=True, text=True)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.browser.get((pathlib.Path(name) / "trade.html").resolve().as_uri())
            self.assertEqual(len(self.all("#queries button")), len(QUERIES))

    def test_is_linked_from_the_page_of_a_run(self):
        with tempfile.TemporaryDirectory() as name:
            subprocess.run([PROGRAM, "run", "-q", "moving_sphere_box", "-s", "collide-fast-float", "--measure", "1e-9", "--cases", "300",
                            "--out", name], capture_output=True, text=True, cwd=TOP)
            (pathlib.Path(name) / "trade.json").write_text(json.dumps(self.trade))
            ran = subprocess.run([PROGRAM, "render", name, "--seconds", "0"], capture_output=True, text=True)
            if "this build writes no pages" in ran.stderr:
                self.skipTest(ran.stderr.strip())
            self.assertEqual(ran.returncode, 0, ran.stderr)
            page = (pathlib.Path(name) / "index.html").read_text()
            self.assertIn('"trades":["trade.html"]', page)
            self.assertTrue((pathlib.Path(name) / "trade.html").exists())


def write_images(trade, folder):
    """Pictures of the page of a trade, light and dark."""
    folder.mkdir(parents=True, exist_ok=True)
    browser = new_browser()
    browser.get((trade / "trade.html").resolve().as_uri())
    for theme in ("light", "dark"):
        browser.execute_script("document.documentElement.dataset.theme = arguments[0]", theme)
        time.sleep(0.3)
        image = browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]
        (folder / f"trade-{theme}.png").write_bytes(base64.b64decode(image))
    browser.quit()


if __name__ == "__main__":
    if OPTIONS.images:
        write_images(OPTIONS.trade, OPTIONS.images)
        sys.exit(0)
    unittest.main(argv=[sys.argv[0], "-v"])
