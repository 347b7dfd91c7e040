#!/usr/bin/python3
"""Opens the page that `nearmiss render` writes in Chromium, and uses it as a person does.

  reports/tests/page_test.py --build FOLDER                      tests the page of a build
  reports/tests/page_test.py --build FOLDER --images docs/images  writes the pictures of the documentation instead

Exit code 77: Chromium, its driver or python3-selenium is not installed, or the build writes no pages.
"""

import argparse
import base64
import json
import pathlib
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True  # the source tree stays as it is
from browser import TOP, Browser, Nearmiss
from selenium.webdriver.common.keys import Keys

ARGUMENTS = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ARGUMENTS.add_argument("--build", type=pathlib.Path, required=True)
ARGUMENTS.add_argument("--images", type=pathlib.Path)
ARGUMENTS.add_argument("tests", nargs="*", metavar="TEST", help="only these: Page.test_sorts")
OPTIONS = ARGUMENTS.parse_args()
nearmiss = Nearmiss(OPTIONS.build)


def signature(report, number, file):
    """A row of triage.json for a report."""
    return {"id": f"{number:012x}", "query": report["query"], "subject": report["subject"]["name"],
            "version": report["subject"]["version"], "scalar": report["scalar"],
            "fault": ("false miss", "wrong time", "wrong normal")[number % 3], "member": "decision", "clause": "",
            "cause": {"kind": ("rounding", "absolute tolerance")[number % 2], "key": "", "text": "a cause of the test",
                      "evidence": [{"test": "at the scale 2^20", "result": "the same finding"}]},
            "regions": ["face"], "change": ("new", "known", "worse", "fixed")[number % 4], "decision": None,
            "severity": number % 97, "severity_text": "of the test", "count": 1 + number % 7, "findings": number,
            "ordinary_share": 0.25, "headline": f"{report['headline']} (row {number})", "above_epsilon": 2.0 ** (number % 50),
            "relative": 1e-6, "worst": file, "simplest": file, "reports": [file]}


def write_triage(folder, reports, rows):
    """A folder with triage.json: one file for each report, and so many rows."""
    files = []
    for i, report in enumerate(reports):
        files.append(f"{report['query']}-{i}.json")
        (folder / files[-1]).write_text(json.dumps(report))
    signatures = [signature(reports[i % len(reports)], i, files[i % len(reports)]) for i in range(rows)]
    changes = [s["change"] for s in signatures]
    totals = {"signatures": rows, "reports": len(reports), "findings": sum(s["findings"] for s in signatures), "reopened": 0}
    totals.update({c: changes.count(c) for c in ("new", "worse", "known", "fixed")})
    (folder / "triage.json").write_text(json.dumps(
        {"schema": 1, "environment": reports[0]["environment"], "sources": ["test"],
         "skipped": [{"file": "foreign.json", "why": "it is not a report"}], "signatures": signatures, "totals": totals}))


def reports_of_every_query():
    """A report of a stored case of each query, with a hit where the query has one."""
    cases = [sorted(folder.glob("*.json")) for folder in sorted((TOP / "corpus" / "seeds").iterdir())]
    with_hit = [next((f for f in files if not f.name.startswith(("apart", "miss", "outside"))), files[0]) for files in cases]
    return json.loads(nearmiss("replay", "--json", "-s", "collide-fast-double", *with_hit))


# How many pixels of the picture have a colour, and how many colours there are.
COUNT_PIXELS = """
const from = document.querySelector('.frame canvas'), to = document.createElement('canvas');
to.width = from.width; to.height = from.height;
const c = to.getContext('2d');
c.drawImage(from, 0, 0);
const p = c.getImageData(0, 0, to.width, to.height).data, colours = new Set();
let drawn = 0;
for (let i = 0; i < p.length; i += 4) if (p[i + 3] > 40) { ++drawn; colours.add((p[i] >> 5) * 64 + (p[i + 1] >> 5) * 8 + (p[i + 2] >> 5)); }
return [drawn, colours.size];
"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        folder = cls.folder = pathlib.Path(cls.kept.name)
        cls.reports = reports_of_every_query()
        write_triage(folder, cls.reports, len(cls.reports))
        nearmiss("render", folder, "--seconds", 20)
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.kept.cleanup()

    def setUp(self):
        self.browser.requests(), self.browser.errors()  # forgets those of the test before
        self.browser.open(self.folder / "index.html")
        self.browser.cdp("Emulation.setEmulatedMedia", features=[])

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def rows(self):
        return self.browser.run("return nearmiss.table.rows().length")

    def selected(self):
        return self.browser.run("return nearmiss.table.selected()")

    def test_draws_the_picture_of_every_query_at_every_zoom(self):
        self.assertGreaterEqual(len({r["query"] for r in self.reports}), 40)
        for i in range(len(self.reports)):
            query = self.browser.run("nearmiss.table.select(arguments[0]); return nearmiss.data.value(nearmiss.table.selected(), 'query')", i)
            for level in ("whole", "ulp"):
                self.browser.run("nearmiss.picture.level(arguments[0])", level)
                drawn, colours = self.browser.run(COUNT_PIXELS)
                self.assertGreater(drawn, 100, f"{query}, {level}")
                self.assertTrue(colours > 1 or level == "ulp", f"{query}, {level}")

    def test_draws_nothing_without_shapes(self):
        """The count of pixels tells a picture from none."""
        self.browser.run("const p = nearmiss.picture.current(); p.data.shapes = []; p.data.contacts = []; p.set(p.fit)")
        self.assertEqual(self.browser.run(COUNT_PIXELS)[0], 0)

    def test_moves_along_the_way(self):
        row = next(i for i, r in enumerate(self.reports) if r["query"] == "moving_sphere_box")
        self.browser.run("nearmiss.table.select(nearmiss.table.place(nearmiss.table.rows().find(r => nearmiss.data.value(r, 'query') === 'moving_sphere_box')))")
        self.assertEqual(self.reports[row]["query"], "moving_sphere_box")
        picture = lambda: self.browser.run("return document.querySelector('.frame canvas').toDataURL()")
        before = picture()
        self.browser.run("const t = document.querySelector('[aria-label=\"Time along the motion\"]'); t.value = 0; t.dispatchEvent(new Event('input'))")
        self.assertNotEqual(picture(), before)
        self.assertEqual(self.browser.run("return document.querySelector('.time').textContent"), "time 0")

    def test_stays_still_at_the_scale_of_an_ulp(self):
        """Shapes of the size 1 whose surface is moved by a 64th of an ulp, drawn so that this is a view unit."""
        shapes = {
            "sphere": {"corners": [[0.6, 0.8, 0]], "radius": 1, "distances": [0]},
            "capsule": {"corners": [[0.6, 0.8, -1], [0.6, 0.8, 1]], "radius": 1, "distances": [2 ** 0.5 - 1] * 2,
                        "axis": {"foot": [0.6, 0.8, 0], "along": [0, 0, 1], "from": -1, "to": 1, "distance": 0}},
            "box": {"corners": [[0.6, 0.8, 0]], "faces": [{"n": [s * x for x in n], "d": d} for n, ds in (
                ([-0.6, -0.8, 0], (0, 2)), ([0.8, -0.6, 0], (1, 1)), ([0, 0, 1], (1, 1))) for s, d in zip((1, -1), ds)]},
        }
        for kind, shape in shapes.items():
            for steps in (-1, 0, 1):
                # The distances of the drawn points along the normal: all of them one plane, as the scale is so small.
                heights = self.browser.run("""
                  const [shape, steps] = arguments, step = 2 ** -58, n = [0.6, 0.8, 0];
                  const points = nearmiss.shapes.draw(shape, n.map(x => x * steps * step), 1 / step).triangles;
                  const heights = [];
                  for (let i = 0; i < points.length; i += 3) heights.push(points[i] * n[0] + points[i + 1] * n[1]);
                  return heights;""", {"kind": kind, "name": kind, "moves": True, **shape}, steps)
                self.assertGreater(len(heights), 3)
                self.assertLess(max(abs(h - steps) for h in heights), 1e-6, kind)

    def test_filters(self):
        filter_ = self.browser.find("#filter")
        filter_.send_keys("query:ray_aabox")
        self.assertEqual(self.rows(), 1)
        filter_.clear()
        filter_.send_keys("No Such Word")
        self.assertEqual(self.rows(), 0)
        self.assertIn("No signature matches", self.browser.find("#table").text)
        filter_.clear()
        filter_.send_keys("false miss")
        self.assertEqual(self.rows(), sum(i % 3 == 0 for i in range(len(self.reports))))

    def test_shows_one_kind_of_change(self):
        self.browser.find("#changes button:nth-child(2)").click()
        self.assertEqual(self.rows(), sum(i % 4 == 0 for i in range(len(self.reports))))
        self.browser.find("#changes button:nth-child(1)").click()
        self.assertEqual(self.rows(), len(self.reports))

    def test_shows_regressions_first(self):
        changes = self.browser.run("return nearmiss.table.rows().map(r => nearmiss.data.value(r, 'change'))")
        self.assertEqual(changes, sorted(changes, key=["worse", "new", "known", "fixed"].index))
        regressions = sum(c in ("new", "worse") for c in changes)  # the subject is the library's own
        self.assertIn(f"{regressions} regressions", self.browser.find("#verdict").text)

    def test_sorts(self):
        values = lambda name: self.browser.run("return nearmiss.table.rows().map(r => nearmiss.data.value(r, arguments[0]))", name)
        ranked = values("severity")
        self.browser.find("[data-sort=severity]").click()
        self.assertEqual(values("severity"), sorted(ranked, reverse=True))
        self.browser.find("[data-sort=severity]").click()
        self.assertEqual(values("severity"), sorted(ranked))
        self.browser.find("[data-sort=severity]").click()
        self.assertEqual(values("severity"), ranked)
        self.browser.find("[data-sort=fault]").click()
        self.assertEqual(values("fault"), sorted(values("fault")))

    def test_obeys_keys(self):
        self.browser.find("#table").click()
        rows = self.browser.run("nearmiss.table.select(0); return nearmiss.table.rows()")
        self.browser.keys("j", "j", "k")
        self.assertEqual(self.selected(), rows[1])
        self.browser.keys(Keys.ENTER)
        self.assertEqual(self.browser.run("return document.activeElement.id"), "finding")
        self.browser.keys(Keys.ESCAPE)
        self.assertEqual(self.browser.run("return document.activeElement.id"), "table")
        self.browser.keys("/")
        self.assertEqual(self.browser.run("return document.activeElement.id"), "filter")
        self.browser.keys("jk", Keys.ESCAPE)
        self.assertEqual(self.browser.find("#filter").get_attribute("value"), "jk")
        self.browser.keys("?")
        self.assertTrue(self.browser.run("return document.getElementById('keys').open"))
        self.browser.keys(Keys.ESCAPE)
        self.assertFalse(self.browser.run("return document.getElementById('keys').open"))

    def test_keeps_the_selection_in_the_address(self):
        chosen = self.browser.run("nearmiss.table.select(3); return nearmiss.table.selected()")
        self.browser.driver.refresh()
        self.assertEqual(self.selected(), chosen)

    def test_copies_the_replay_command(self):
        replay = self.browser.run("return nearmiss.data.report(nearmiss.table.selected(), 'worst').report.replay")
        self.browser.find("[data-copy=replay]").click()
        filter_ = self.browser.find("#filter")
        filter_.send_keys(Keys.CONTROL, "v")
        self.assertEqual(filter_.get_attribute("value"), replay)

    def test_is_light_and_dark(self):
        paper = lambda: self.browser.run("return getComputedStyle(document.body).backgroundColor")
        media = lambda v: self.browser.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": v}])
        media("light")
        self.assertEqual(paper(), "rgb(255, 255, 255)")
        media("dark")
        dark = paper()
        self.assertNotEqual(dark, "rgb(255, 255, 255)")
        self.browser.find("#theme").click()
        self.assertEqual(paper(), "rgb(255, 255, 255)")
        self.browser.find("#theme").click()
        self.assertEqual(paper(), dark)
        self.browser.run("localStorage.clear()")

    def test_prints(self):
        before = self.browser.run("return document.querySelectorAll('.row').length")
        pdf = base64.b64decode(self.browser.cdp("Page.printToPDF", printBackground=True)["data"])
        self.assertTrue(pdf.startswith(b"%PDF"))
        self.assertGreater(len(pdf), 20_000)
        self.assertEqual(self.browser.run("return document.querySelectorAll('.row').length"), before)

    def test_names_what_can_be_used(self):
        nameless = self.browser.run("""
          return [...document.querySelectorAll('button, input, canvas, svg, [role=grid], article, dialog')]
            .filter(e => !(e.getAttribute('aria-label') || e.textContent.trim() || e.title)).map(e => e.outerHTML)""")
        self.assertEqual(nameless, [])

    def test_names_skipped_files(self):
        self.assertIn("foreign.json: it is not a report", self.browser.run("return document.getElementById('head').textContent"))

    def test_asks_no_network(self):
        self.browser.run("nearmiss.table.step(1)")
        self.assertEqual(self.browser.foreign_requests("blob:"), [])

    def test_takes_a_hundred_thousand_signatures(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write_triage(folder, self.reports, 100_000)
            begin = time.monotonic()
            nearmiss("render", folder, "--seconds", 0)
            wrote, size = time.monotonic() - begin, (folder / "index.html").stat().st_size
            self.assertLess(size, 20_000_000)
            begin = time.monotonic()
            self.browser.open(folder / "index.html")
            self.assertEqual(self.rows(), 100_000)
            opened = time.monotonic() - begin
            self.assertGreater(self.browser.run(COUNT_PIXELS)[0], 100)
            self.assertLess(self.browser.run("return document.querySelectorAll('.row').length"), 100)
            self.browser.run("nearmiss.table.select(99999)")
            self.assertTrue(self.browser.run("return document.getElementById(`row-${nearmiss.table.selected()}`) !== null"))
            begin = time.monotonic()
            self.browser.find("#filter").send_keys("r")
            filtered = time.monotonic() - begin
        print(f"\n100,000 signatures: {size / 1e6:.1f} MB, written in {wrote:.1f} s, opened in {opened:.1f} s, filtered in {filtered:.1f} s")

    def test_shows_the_answers_of_all_subjects(self):
        with tempfile.TemporaryDirectory() as name:
            nearmiss("run", "-q", "moving_sphere_box", "-q", "moving_point_sphere", "-s", "collide-fast-float", "-s", "collide-fast-double",
                     "--measure", "1e-9", "--cases", 500, "--seed", 1, "--out", f"{name}/run", codes=(0, 1))
            nearmiss("render", f"{name}/run", "--seconds", 0)
            self.browser.open(f"{name}/run/index.html", "subjects")
            self.assertTrue(self.browser.find("#subjects").is_displayed())
            shown = {cell.get_attribute("title").split(":")[0]: cell.text for cell in self.browser.all("#subjects td[title]")}
            tallies, total = json.loads(pathlib.Path(name, "run", "index.json").read_text())["tallies"], 0
            self.assertEqual(len(tallies), 4)
            for t in tallies:
                wrong = sum(t["verdicts"][v] for v in ("violates contract", "differs by more than the measure", "broke"))
                self.assertEqual(shown[f"{t['subject']}, {t['query']}"], f"{wrong:,}")
                total += wrong
            self.assertGreater(total, 0)
            self.browser.find("#subjects td button").click()
            self.assertTrue(self.browser.find("#findings").is_displayed())
            self.assertRegex(self.browser.find("#filter").get_attribute("value"), "^subject=[-a-z]+ query=moving_[a-z_]+$")
            self.assertGreater(self.rows(), 0)
            self.assertLess(self.rows(), self.browser.run("return nearmiss.data.count"))

    def test_shows_a_run_and_the_trend_of_several(self):
        with tempfile.TemporaryDirectory() as name:
            for seed in (1, 2):
                nearmiss("run", "-q", "moving_sphere_box", "-s", "collide-fast-float", "--measure", "1e-9", "--cases", 500,
                         "--seed", seed, "--out", f"{name}/night-{seed}", codes=(0, 1))
            nearmiss("render", name, "--seconds", 5)
            self.browser.open(f"{name}/index.html")
            self.assertGreater(self.rows(), 0)
            self.assertEqual(len(self.browser.all("#trend circle")), 2)
            self.assertGreater(len(self.browser.all(".plot")), 5)
            self.assertGreater(self.browser.run(COUNT_PIXELS)[0], 100)


def write_images(folder):
    """The pictures of docs/images, from findings of the libraries."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        nearmiss("run", "-s", "fcl", "-s", "bullet", "--cases", 5000, "--seed", 1, "--out", f"{name}/night", codes=(0, 1))
        nearmiss("render", f"{name}/night", "--seconds", 120)
        browser = Browser()
        browser.open(f"{name}/night/index.html")

        def select(subject, query, fault):
            browser.run("""
              const wanted = [...arguments], is = r => ['subject', 'query', 'fault'].every((c, i) => nearmiss.data.value(r, c) === wanted[i]);
              nearmiss.table.select(nearmiss.table.rows().findIndex(is));""", subject, query, fault)

        def keep(image):
            time.sleep(0.5)
            (folder / f"{image}.webp").write_bytes(browser.screenshot())
            print(f"{image}.webp: {(folder / (image + '.webp')).stat().st_size / 1000:.0f} kB")

        select("bullet", "box_box_penetration", "wrong normal")
        keep("page")
        select("fcl", "moving_sphere_box", "false miss")
        browser.run("nearmiss.picture.level('ulp')")
        browser.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        keep("page-ulp")
        browser.cdp("Emulation.setEmulatedMedia", features=[])
        browser.run("document.querySelector('.plots').parentElement.scrollIntoView()")
        keep("page-plots")
        browser.quit()


if __name__ == "__main__":
    if OPTIONS.images:
        write_images(OPTIONS.images)
        sys.exit(0)
    unittest.main(argv=[sys.argv[0], "-v", *OPTIONS.tests])
