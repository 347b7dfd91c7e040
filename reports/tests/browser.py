"""A browser for the tests of pages: Chromium without a window, by Debian's python3-selenium."""

import base64
import json
import os
import pathlib
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
CHROMIUM, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
SKIPPED = 77  # the exit code of a test that cannot run here

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(SKIPPED)
for needed in (CHROMIUM, DRIVER):
    if not os.path.exists(needed):
        print(f"skipped: {needed} is not installed")
        sys.exit(SKIPPED)


class Nearmiss:
    """The command line of a build."""

    def __init__(self, build):
        self.program = build.resolve() / "reports" / "nearmiss"

    def __call__(self, *arguments, codes=(0,)):
        """Its standard output. Ends the test program, as skipped, where the build writes no pages."""
        ran = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, cwd=TOP)
        if ran.returncode == 2 and "this build writes no pages" in ran.stderr:
            print("skipped: " + ran.stderr.strip(), flush=True)
            os._exit(SKIPPED)
        if ran.returncode not in codes:
            raise AssertionError(f"nearmiss {arguments}: exit {ran.returncode}: {ran.stderr}")
        return ran.stdout


class Browser:
    def __init__(self, width=1280, height=800):
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        for argument in ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.resize(width, height)

    def resize(self, width, height):
        self.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def cdp(self, command, **arguments):
        return self.driver.execute_cdp_cmd(command, arguments)

    def open(self, page, address=""):
        """The page of a file, afresh, with what follows # in its address."""
        self.driver.get("about:blank")
        self.driver.get(pathlib.Path(page).resolve().as_uri() + (f"#{address}" if address else ""))

    def address(self):
        return self.driver.current_url.partition("#")[2]

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def keys(self, *keys):
        webdriver.ActionChains(self.driver).send_keys(*keys).perform()

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def named(self, selector, text):
        """The element with that text, as soon as it is drawn."""
        limit = 60
        drawn = lambda _: next((e for e in self.all(selector) if e.text == text), None)
        return WebDriverWait(self.driver, limit).until(drawn, f"no {selector} with the text {text}")

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def errors(self):
        """Without what the driver says about the tests' own reading of pixels."""
        return [e["message"] for e in self.driver.get_log("browser") if "GPU stall due to ReadPixels" not in e["message"]]

    def requests(self):
        """The addresses that the page asked for since the last call."""
        messages = [json.loads(e["message"])["message"] for e in self.driver.get_log("performance")]
        return [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]

    def foreign_requests(self, *others):
        """Those that are not of files or within the page. Fails where the page asked for nothing at all."""
        urls = self.requests()
        assert urls
        return [u for u in urls if not u.startswith(("file:", "data:", "about:", *others))]

    def screenshot(self, image="webp"):
        quality = {"quality": 88} if image == "webp" else {}
        return base64.b64decode(self.cdp("Page.captureScreenshot", format=image, **quality)["data"])

    def quit(self):
        self.driver.quit()
