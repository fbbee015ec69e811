#!/usr/bin/env python3
"""Tests the page of `pelage report` in headless Chromium.

usage: browser_test.py SOURCE PELAGE

SOURCE is the source tree, and PELAGE is the path of the program. Exits with 77 if Chromium, its driver, Selenium or
matplotlib is missing.
"""
import importlib.util
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError:
    print("Selenium is not installed (Debian: python3-selenium), so the page is not tested in a browser")
    sys.exit(77)

SOURCE, PELAGE = Path(sys.argv[1]), sys.argv[2]
HOSTILE = "</script><img src=x onerror=document.title='broken'>\"'<!--"
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-dev-shm-usage",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
         "--disable-default-apps", "--disable-extensions", "--no-default-browser-check"]
WAIT_S = 60  # timeout, in case the page does not respond


def missing():
    """Returns the reason why the test cannot run, or "" if it can run."""
    for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
        if not shutil.which(program):
            return f"{program} is not installed (Debian: {package})"
    if importlib.util.find_spec("matplotlib") is None:
        return "matplotlib is not installed (Debian: python3-matplotlib)"
    return ""


def png(path, width, height, shade):
    """Writes a PNG picture with a colour gradient. `shade` is the blue value of all pixels."""
    import matplotlib.image  # pylint: disable=import-outside-toplevel; missing() looks for matplotlib first
    import numpy  # pylint: disable=import-outside-toplevel
    pixels = [[(255 * x // width, 255 * y // height, shade) for x in range(width)] for y in range(height)]
    path.parent.mkdir(parents=True, exist_ok=True)
    matplotlib.image.imsave(path, numpy.array(pixels, numpy.uint8))


def line(row):
    body = json.dumps(row, separators=(",", ":"))[:-1]
    return f'{body},"crc":"{zlib.crc32(body.encode()):08x}"}}\n'


def rows():
    """Yields the rows of an experiment with three numbers of layers, two variants and two models. The name of one model is
    HTML code that would change the page if it were not escaped."""
    for variant in ("plain", "curly"):
        for layers in (9, 16, 100):
            for model in ("torus", HOSTILE):
                # The rows of the two models have different times, because pelage rejects two rows with equal times.
                factor = (2 if variant == "curly" else 1) * (1 if model == "torus" else 1.001)
                times = [layers * (1 + 0.01 * i) * factor for i in range(8)]
                yield {"schema": 2, "run_id": "20261123T000000Z-1", "experiment": "own",
                       "case": f"{'torus' if model == 'torus' else HOSTILE}-{layers}-{variant}", "variant": variant,
                       "axes": {"layers": layers, "model": model, "variant": variant}, "overrides": {}, "device": "a device",
                       "identity": {"scene": "0123456789abcdef"}, "repeat": 0, "status": "ok", "reason": "",
                       "check": [{"against": "reference", "metric": "psnr", "value": 80.5, "limit": 60.0, "sense": ">="}],
                       "samples": {"frame": {"event_ms": [], "wall_ms": times}}, "metrics": {}, "build_ms": 1,
                       "first_launch_ms": 1, "tuning": {}, "image_hash": "",
                       "provenance": {"host": "here", "cpu": "a processor of 1979", "converged": True, "title": HOSTILE,
                                      "view": {"x": "layers", "series": ["variant"], "panels": ["model"]}}}


def write_report(folder):
    """Writes a report of two experiments: the experiment of rows(), with pictures of two variants, and a recorded experiment
    of the folder results/. Returns the path of the report's page."""
    own = folder / "results" / "own"
    own.mkdir(parents=True)
    (own / "a.jsonl").write_text("".join(map(line, rows())))
    for shade, variant in ((40, "plain"), (220, "curly")):
        for layers in (9, 16):
            png(own / "images" / f"torus-{layers}-{variant}.png", 320, 200, shade)
    shutil.copytree(SOURCE / "results" / "silva2010-table1", folder / "results" / "silva2010-table1")
    run = subprocess.run([PELAGE, "report", folder / "results", "-o", folder / "report"], capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(run.stderr)
    return folder / "report" / "index.html"


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="pelage-browser-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        # The browser opens a copy in another folder, so that the page cannot use the other files of the report.
        page = cls.folder / "alone" / "page.html"
        page.parent.mkdir()
        shutil.copy(write_report(cls.folder), page)
        cls.url = page.as_uri()
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in (*FLAGS, f"--user-data-dir={cls.folder / 'profile'}"):
            options.add_argument(flag)
        cls.downloads = cls.folder / "downloads"
        options.add_experimental_option("prefs", {"download.default_directory": str(cls.downloads)})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.show()

    def tearDown(self):
        """Checks that the test caused no warnings or errors on the console and no network requests."""
        messages = [entry for entry in self.browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        self.assertEqual(messages, [])
        urls = []
        for entry in self.browser.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                urls.append(message["params"]["request"]["url"])
        self.assertIn(self.url, [url.partition("#")[0] for url in urls], "the log has the page itself")
        self.assertEqual([url for url in urls if not url.startswith(("data:", "blob:", self.url))], [])

    def show(self, width=1280, height=900, scheme="light"):
        self.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.browser.get("about:blank")
        for log in ("browser", "performance"):
            self.browser.get_log(log)
        self.browser.get(self.url)

    def command(self, name, **arguments):
        return self.browser.execute_cdp_cmd(name, arguments)

    def run_script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def one(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def every(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def wait(self, condition, reason):
        return WebDriverWait(self.browser, WAIT_S).until(lambda _: condition(), reason)

    def points(self):
        """Returns the points of the first plot."""
        figure = self.one("figure.plot")
        self.run_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", figure)
        return self.run_script("return [...arguments[0].querySelectorAll('use')].filter(u => u.querySelector('title'))", figure)

    def test_hostile_names_are_text(self):
        self.assertRegex(self.browser.title, "^Results of [0-9]+ experiments$")
        self.assertEqual(self.every("img[src=x]"), [])
        self.assertIn(HOSTILE, self.run_script("return document.querySelector('main').textContent"))
        self.one("#filter").send_keys("onerror")
        line = next(r for r in self.every("#rows tbody tr") if r.is_displayed())
        line.click()
        self.assertIn(HOSTILE, self.run_script("return document.getElementById('details').textContent"))
        self.assertEqual(self.every("img[src=x]"), [])

    def test_contents_lead_to_every_section(self):
        links = self.every("#contents a")
        self.assertGreater(len(links), 7)
        for link in links:
            self.assertTrue(self.every(link.get_attribute("href").partition("#")[2].join(("#", ""))))

    def test_sorting(self):
        head = next(h for h in self.every("#rows thead th") if "time, ms" in h.text)
        button, column = head.find_element(By.TAG_NAME, "button"), 4

        def values():
            texts = self.run_script("return [...document.querySelectorAll('#rows tbody tr')].map("
                                    "r => r.cells[arguments[0]].dataset.sort ?? '')", column)
            return [float(t) for t in texts if t]

        button.click()
        self.assertEqual(values(), sorted(values()))
        self.assertEqual(head.get_attribute("aria-sort"), "ascending")
        button.send_keys(Keys.ENTER)  # by the keyboard
        self.assertEqual(values(), sorted(values(), reverse=True))
        self.assertEqual(head.get_attribute("aria-sort"), "descending")

    def test_every_table_can_be_sorted(self):
        self.assertEqual(self.run_script(
            "return [...document.querySelectorAll('main table')].filter(t => "
            "t.tHead.rows[t.tHead.rows.length - 1].querySelectorAll('button.sort').length < 2).length"), 0)

    def test_filter(self):
        self.one("#filter").send_keys("own curly 100")
        shown = [r for r in self.every("#rows tbody tr") if r.is_displayed()]
        self.assertEqual(len(shown), 2)
        self.assertRegex(self.one("#shown").text, r"^2 of \d+ rows$")

    def test_hover_shows_a_value(self):
        point = self.points()[0]
        text = self.run_script(
            "const b = arguments[0].getBoundingClientRect(), x = b.left + b.width / 2, y = b.top + b.height / 2;"
            "return document.elementFromPoint(x, y).closest('use').textContent", point)
        self.assertRegex(text, r": [-0-9.e+]+ \[[-0-9.e+]+, [-0-9.e+]+\]")

    def test_every_plot_has_points(self):
        counts = self.run_script("return [...document.querySelectorAll('figure.plot svg')].map("
                                 "s => [s.querySelectorAll('use title').length, s.getBoundingClientRect().height])")
        self.assertGreaterEqual(len(counts), 2)
        for points, height in counts:
            self.assertGreater(points, 1)
            self.assertGreater(height, 100)

    def test_a_print_shows_every_column(self):
        self.command("Page.printToPDF")
        self.command("Emulation.setEmulatedMedia", media="print")
        hidden = self.run_script("return [...document.querySelectorAll('td, th')].filter(c => c.innerText.trim() === ''"
                                 " && c.textContent.trim() !== '').length")
        self.command("Emulation.setEmulatedMedia", media="")
        self.assertEqual(hidden, 0)

    def test_a_row_shows_its_provenance_and_samples(self):
        self.one("#filter").send_keys("own torus-9-plain")
        line = next(r for r in self.every("#rows tbody tr") if r.is_displayed())
        line.find_element(By.CSS_SELECTOR, "button.open").send_keys(Keys.ENTER)
        text = self.one("#details").text
        self.assertIn("a processor of 1979", text)
        self.assertIn("9 9.09 9.18", text)
        self.browser.switch_to.active_element.send_keys(Keys.ESCAPE)
        self.wait(lambda: not self.one("#details").is_displayed(), "the dialog is closed")

    def test_a_line_of_a_cross_table_shows_its_cases(self):
        cell = self.one("section td[data-cell]")
        self.run_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", cell)
        cell.click()
        details = self.one("#details")
        self.assertIn("Provenance", details.text)
        tabs = details.find_elements(By.CSS_SELECTOR, ".tabs button")
        self.assertGreater(len(tabs), 1)
        case = details.find_element(By.TAG_NAME, "h3").text
        tabs[-1].click()
        self.assertNotEqual(details.find_element(By.TAG_NAME, "h3").text, case)

    def test_the_csv_of_a_plot(self):
        self.command("Page.setDownloadBehavior", behavior="allow", downloadPath=str(self.downloads))
        button = self.one("figure.plot").find_element(By.TAG_NAME, "button")
        self.run_script("arguments[0].click()", button)
        name = button.get_attribute("data-file")
        self.wait(lambda: (self.downloads / name).exists(), "the file is saved")
        text = (self.downloads / name).read_text(encoding="utf-8")
        self.assertEqual(text, (self.folder / "report" / "tables" / name).read_text(encoding="utf-8"))

    def test_the_wipe_compares_two_variants_of_a_case(self):
        left, right = (Select(s).first_selected_option.text for s in self.every("#wipe select"))
        self.assertEqual(left.replace("plain", "curly"), right.replace("plain", "curly"))
        self.assertNotEqual(left, right)
        slider = self.one("#wipe input")

        def edge():
            return self.run_script("return document.querySelector('#wipe .upper').style.clipPath")

        self.assertIn("50%", edge())
        slider.send_keys(Keys.HOME)
        self.assertRegex(edge(), r"(0px|0%)\)$")
        slider.send_keys(Keys.END)
        self.assertIn("100%", edge())
        Select(self.every("#wipe select")[1]).select_by_index(0)
        self.assertIn("data:image/webp", self.one("#wipe .upper").get_attribute("src"))
        self.assertTrue(self.run_script("return [...document.images].every(i => !i.src || i.naturalWidth > 0)"))

    def test_dark_and_light(self):
        def colours():
            body = self.run_script("const s = getComputedStyle(document.body); return [s.color, s.backgroundColor]")
            return [sum(map(int, re.findall(r"\d+", c)[:3])) for c in body]

        text, back = colours()
        self.assertGreater(back, text + 400)
        self.show(scheme="dark")
        plot = self.one("figure.plot > svg")
        self.assertIn("invert", plot.value_of_css_property("filter"), "a dark page inverts its plots")
        text, back = colours()
        self.assertGreater(text, back + 400)

    def test_a_phone_needs_no_horizontal_scrolling(self):
        self.show(width=390, height=844)
        widths = "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        scroll, client = self.run_script(widths)
        self.assertEqual(client, 390)
        self.assertLessEqual(scroll, client)
        self.run_script("document.querySelector('#rows tr.opens').click()")
        box = self.run_script("const d = document.getElementById('details'); return [d.scrollWidth, d.clientWidth, innerWidth]")
        self.assertLessEqual(box[0], box[1])
        self.assertLessEqual(box[1], box[2])


if __name__ == "__main__":
    reason = missing()
    if reason:
        print(f"{reason}, so the page is not tested in a browser")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
