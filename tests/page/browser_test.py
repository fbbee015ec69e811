#!/usr/bin/env python3
"""Tests the page of `pelage report` in headless Chromium.

usage: browser_test.py SOURCE PELAGE

SOURCE is the source tree, and PELAGE is the path of the program. Exits with 77 if Chromium, its driver, Selenium or
Chart.js is missing.
"""
import json
import os
import re
import shutil
import struct
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
    if not Path("/usr/share/javascript/chart.js/chart.min.js").exists():
        return "Chart.js is not installed (Debian: libjs-chart.js)"
    return ""


def png(path, width, height, shade):
    """Writes a PNG picture with a colour gradient. `shade` is the blue value of all pixels."""
    lines = b"".join(b"\0" + bytes(v for x in range(width) for v in (255 * x // width, 255 * y // height, shade))
                     for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


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


def narrow_rows():
    """Yields rows whose times, 48 to 57 ms, lie between two numbers of the series 1, 2, 5, 10, 20, 50, 100, and for which
    the experiment requires logarithmic axes."""
    for row in rows():
        if row["axes"]["model"] == "torus" and row["variant"] == "plain":
            first = 48 + 2 * [9, 16, 100].index(row["axes"]["layers"])
            yield {**row, "experiment": "zz-narrow", "samples": {"frame": {"event_ms": [], "wall_ms": [
                first + 0.7 * i for i in range(8)]}}, "provenance": {**row["provenance"], "title": "narrow", "view": {
                    "x": "layers", "x_scale": "log", "y_scale": "log"}}}


def write_report(folder):
    """Writes a report of four experiments: the experiment of rows(), with pictures of two variants, that of narrow_rows(),
    and two recorded experiments of the folder results/. Returns the path of the report's page."""
    own = folder / "results" / "own"
    own.mkdir(parents=True)
    (own / "a.jsonl").write_text("".join(map(line, rows())))
    (folder / "results" / "zz-narrow").mkdir()
    (folder / "results" / "zz-narrow" / "a.jsonl").write_text("".join(map(line, narrow_rows())))
    for shade, variant in ((40, "plain"), (220, "curly")):
        for layers in (9, 16):
            png(own / "images" / f"torus-{layers}-{variant}.png", 320, 200, shade)
    for name in ("silva2010-table1", "banisch2006-mesh-size"):
        shutil.copytree(SOURCE / "results" / name, folder / "results" / name)
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

    def chart(self, index=0):
        """Scrolls to a chart, waits until the chart is drawn, and returns its element."""
        figure = self.every("figure.chart")[index]
        self.run_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", figure)
        self.wait(lambda: self.run_script("return !!arguments[0].charts", figure), "the chart is drawn")
        return figure

    def test_every_axis_of_numbers_has_two_ticks(self):
        kinds = set()
        for index in range(len(self.every("figure.chart"))):
            axes = self.run_script(
                "return arguments[0].charts.flatMap(c => ['x', 'y'].map(k => [c.scales[k].type, c.scales[k].min, "
                "c.scales[k].max, c.scales[k].ticks.map(t => t.value)]))", self.chart(index))
            for kind, least, most, ticks in axes:
                kinds.add(kind)
                if kind == "logarithmic":
                    self.assertGreaterEqual(sum(least <= tick <= most for tick in ticks), 2, (least, most, ticks))
        self.assertIn("logarithmic", kinds)

    def test_hostile_names_are_text(self):
        self.assertEqual(self.browser.title, "pelage: results")
        self.assertEqual(self.every("img[src=x]"), [])
        self.assertIn(HOSTILE, self.run_script("return document.querySelector('main').textContent"))
        self.one("#filter").send_keys("onerror")
        line = next(r for r in self.every("#rows tbody tr") if r.is_displayed())
        line.click()
        self.assertIn(HOSTILE, self.run_script("return document.getElementById('details').textContent"))
        self.assertEqual(self.every("img[src=x]"), [])

    def test_contents_lead_to_every_section(self):
        links = self.every("#contents a")
        self.assertGreater(len(links), 8)
        for link in links:
            self.assertTrue(self.every(link.get_attribute("href").partition("#")[2].join(("#", ""))))

    def test_sorting(self):
        head = next(h for h in self.every("#rows thead th") if "frame, ms" in h.text)
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
        figure = self.chart()
        spot = self.run_script(
            "const c = arguments[0].charts[0], p = c.getDatasetMeta(0).data[0], b = c.canvas.getBoundingClientRect();"
            "return [b.left + p.x, b.top + p.y]", figure)
        values = self.run_script("return arguments[0].charts[0].data.datasets.flatMap(d => d.data.map(p => p.y))", figure)
        self.command("Input.dispatchMouseEvent", type="mouseMoved", x=spot[0] + 1, y=spot[1] + 1)
        text = self.wait(lambda: self.run_script(
            "const t = arguments[0].charts[0].tooltip; return t.opacity > 0 && t.body ? t.body[0].lines.join('|') : ''",
            figure), "the value is shown")
        number = float(re.search(r": (?:at least )?([-0-9.e+]+)", text)[1])
        self.assertTrue(any(abs(number - value) <= 0.01 * abs(value) for value in values), f"{number} is a value of the plot")

    def test_every_chart_is_drawn(self):
        figures = self.every("figure.chart")
        self.assertGreaterEqual(len(figures), 3)
        for i in range(len(figures)):
            figure = self.chart(i)
            self.assertGreater(self.run_script(
                "return arguments[0].charts.reduce((n, c) => n + c.data.datasets.reduce((m, d) => m + d.data.length, 0), 0)",
                figure), 1)

    def test_a_print_shows_every_chart_and_every_column(self):
        self.show(height=300)
        self.assertIn(False, self.run_script("return [...document.querySelectorAll('figure.chart')].map(f => !!f.charts)"))
        self.command("Page.printToPDF")
        self.assertNotIn(False, self.run_script("return [...document.querySelectorAll('figure.chart')].map(f => !!f.charts)"))
        self.command("Emulation.setEmulatedMedia", media="print")
        hidden = self.run_script("return [...document.querySelectorAll('td, th')].filter(c => c.innerText.trim() === ''"
                                 " && c.textContent.trim() !== '').length")
        self.command("Emulation.setEmulatedMedia", media="")
        self.assertEqual(hidden, 0)

    def test_a_click_on_a_point_opens_its_row(self):
        figure = self.chart()
        spot = self.run_script(
            "const c = arguments[0].charts[0], p = c.getDatasetMeta(0).data[0], b = c.canvas.getBoundingClientRect();"
            "return [b.left + p.x, b.top + p.y]", figure)
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.command("Input.dispatchMouseEvent", type=kind, x=spot[0], y=spot[1], button="left", clickCount=1)
        self.wait(lambda: self.one("#details").is_displayed(), "the details are shown")

    def test_a_line_of_the_legend_can_be_hidden(self):
        figure = next(self.chart(i) for i in range(len(self.every("figure.chart")))
                      if self.chart(i).find_elements(By.CSS_SELECTOR, ".legend button"))
        button = figure.find_element(By.CSS_SELECTOR, ".legend button")
        self.run_script("arguments[0].click()", button)
        self.assertEqual(button.get_attribute("aria-pressed"), "false")
        self.assertFalse(self.run_script("return arguments[0].charts[0].isDatasetVisible(0)", figure))

    def test_a_row_shows_its_provenance_and_samples(self):
        self.one("#filter").send_keys("own torus-9-plain")
        line = next(r for r in self.every("#rows tbody tr") if r.is_displayed())
        line.find_element(By.CSS_SELECTOR, "button.open").send_keys(Keys.ENTER)
        text = self.one("#details").text
        self.assertIn("a processor of 1979", text)
        self.assertIn("9 9.09 9.18", text)
        self.assertTrue(self.every("#details canvas"))
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
        figure = self.chart()
        self.command("Page.setDownloadBehavior", behavior="allow", downloadPath=str(self.downloads))
        button = next(b for b in figure.find_elements(By.TAG_NAME, "button") if "CSV" in b.text)
        button.click()
        self.wait(lambda: list(self.downloads.glob("*.csv")), "the file is saved")
        saved = next(self.downloads.glob("*.csv")).read_text(encoding="utf-8")
        shown = self.run_script("return arguments[0].querySelector('pre').textContent", figure)
        self.assertEqual(saved, shown)
        self.assertTrue(saved.startswith("panel,line,kind,x,y,low,high,case\n"))
        points = self.run_script("return arguments[0].charts.reduce((n, c) => n + c.data.datasets.reduce("
                                 "(m, d) => m + d.data.length, 0), 0)", figure)
        self.assertEqual(len(saved.splitlines()), points + 1 + saved.count("\n\n"))

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
        text, back = colours()
        self.assertGreater(text, back + 400)
        axis = self.run_script("return arguments[0].charts[0].options.scales.x.ticks.color", self.chart())
        self.assertEqual(axis, self.run_script("return getComputedStyle(document.documentElement).getPropertyValue('--soft').trim()"))

    def test_a_phone_needs_no_horizontal_scrolling(self):
        self.show(width=390, height=844)
        for i in range(len(self.every("figure.chart"))):
            self.chart(i)
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
    os.environ.pop("PELAGE_JAVASCRIPT", None)
    unittest.main(argv=sys.argv[:1])
