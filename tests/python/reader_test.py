#!/usr/bin/env python3
"""Tests the Python package pelage (python/pelage), which reads results as pandas data frames, and the code blocks of
docs/results.md.

usage: reader_test.py SOURCE PELAGE
SOURCE is the source tree, and PELAGE is the path of the program. The exit code is 77 if pandas is not installed.
"""
import io
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest
import zlib
from contextlib import redirect_stdout
from pathlib import Path

try:
    import pandas
except ImportError:
    print("pandas is not installed, so the Python package is not tested")
    sys.exit(77)

SOURCE, PELAGE = Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(SOURCE / "python"))
import pelage  # noqa: E402

RECORDED = SOURCE / "results"


def row(**changes):
    base = {"schema": 3, "run_id": "20261123T000000Z-1", "experiment": "own", "case": "torus-8-calm",
            "variant": "shells/tile", "axes": {"layers": 8, "mood": "calm", "curl.radius": "0.10"}, "overrides": {},
            "device": "a device", "repeat": 0, "status": "ok", "reason": "",
            "check": [{"against": "reference", "metric": "psnr", "value": "inf", "limit": 60, "sense": ">="}],
            "samples": {"frame": {"event_ms": [0.5] * 8, "wall_ms": [3.0, 1.0, 2.0, 4.0, 6.0, 5.0, 7.0, 100.0]},
                        "bin": {"event_ms": [0.5] * 8, "wall_ms": []}},
            "metrics": {"triangles": {"value": 12, "unit": "triangles"},
                        "ratio": {"value": 2, "unit": "times", "low": 1, "high": 3}},
            "build_ms": 1, "first_launch_ms": 1, "tuning": {}, "image_hash": "",
            "provenance": {"host": "here", "preset": "quick", "converged": True},
            "identity": {"scene": "0123456789abcdef"}}
    if "case" in changes:  # changes a time, because pelage regards rows with equal times as copies
        base["samples"]["frame"]["wall_ms"][-1] += zlib.crc32(changes["case"].encode()) % 1000 / 1000
    return {**base, **changes}


def line(values):
    body = json.dumps(values, separators=(",", ":"))[:-1]
    return f'{body},"crc":"{zlib.crc32(body.encode()):08x}"}}\n'


def failed(**changes):
    return row(status="error", reason="out of memory", samples={}, check=[], metrics={}, **changes)


class Reader(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pelage-reader-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def journal(self, text, name="own/a.jsonl"):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def refuses(self, pattern, *places):
        with self.assertRaisesRegex(pelage.ResultsError, pattern):
            pelage.read(*places)

    def test_several_places_are_arguments_or_a_list(self):
        first = self.journal(line(row()))
        second = self.journal(line(row(case="torus-16-calm")), "own/b.jsonl")
        for places in ([first, second], (str(first), str(second))):
            self.assertEqual(len(pelage.read(places)), 2)
            self.assertEqual(len(pelage.read(*places)), 2)

    def test_a_row_is_a_line_of_the_frame(self):
        self.journal(line(row()) + line(failed(case="torus-16-calm", axes={"layers": 16, "mood": "calm"})))
        frame = pelage.read(self.folder)
        self.assertEqual(len(frame), 2)
        good, bad = frame.iloc[0], frame.iloc[1]
        self.assertEqual((good.case, good.layers, good.mood, good["curl.radius"]), ("torus-8-calm", 8, "calm", 0.1))
        self.assertEqual((good.median_ms, good.samples, good.host, good.preset), (4.5, 8, "here", "quick"))
        self.assertEqual((good.low_ms, good.high_ms), (1, 100))  # the 95% interval of 8 samples is their range
        self.assertEqual((good["metric.ratio"], good["metric.ratio.low"], good["metric.ratio.high"]), (2, 1, 3))
        self.assertEqual((bad.status, bad.reason, bad.samples), ("error", "out of memory", 0))
        self.assertTrue(pandas.isna(bad.median_ms))

    def test_phases_and_samples(self):
        self.journal(line(row()))
        self.assertEqual(pelage.read(self.folder, phase="bin", clock="event").median_ms[0], 0.5)
        samples = pelage.read(self.folder, samples=True)
        self.assertEqual(list(samples.ms), row()["samples"]["frame"]["wall_ms"])
        for options in ({"phase": "nap"}, {"clock": "sun"}):
            with self.assertRaises(ValueError):
                pelage.read(self.folder, **options)

    def test_error_rows_are_replaced_and_copies_count_once(self):
        text = line(failed()) + line(row(run_id="20261123T000001Z-2"))
        self.journal(text)
        self.journal(text, "copy/a.jsonl")
        self.assertEqual(list(pelage.read(self.folder, self.folder).status), ["ok"])

    def test_a_truncated_last_line_is_left_out(self):
        self.journal(line(row()) + line(row(case="next"))[:-20])
        self.assertEqual(len(pelage.read(self.folder)), 1)

    def test_lines_may_end_as_in_windows(self):
        self.journal((line(row()) + line(row(case="next"))).replace("\n", "\r\n"))
        self.assertEqual(len(pelage.read(self.folder)), 2)

    def test_damage_is_an_error_that_names_the_line(self):
        damaged = {line(row()).replace("calm", "clam", 1): "checksum does not match",
                   "nonsense\n": "does not end with a checksum",
                   line(row()) + line(row()): "a.jsonl:2: damaged: second row of the case torus-8-calm",
                   line(row(schema=4)): "schema 4; this version of pelage reads schemas 1 to 3",
                   line(row(status="fine")): "unknown status 'fine'",
                   line(row(check=[])): "nothing was checked",
                   line(row(identity={"scene": "torus"})): "part scene is 'torus', not a hash",
                   line(row(image_hash="1")): "image_hash is '1', not a hash",
                   line(row(samples={})): "no times of frames",
                   line(row(samples={"frame": {"event_ms": [], "wall_ms": [1, 0]}})): "that is not above 0",
                   line(row(samples={"frame": {"event_ms": [], "wall_ms": [1, 2]}})): "only 2 timed frames",
                   line(row(samples={"frame": {"event_ms": [1] * 8, "wall_ms": [2] * 7}})): "but 7 timed frames",
                   line(row(samples={"frame": {"event_ms": [3] * 8, "wall_ms": [2] * 8},
                                     "bin": {"event_ms": [3] * 8, "wall_ms": []}})): "above its median wall time",
                   line(row(metrics={"covered_fragments": {"value": 9, "unit": "fragments"},
                                     "fragments_per_s": {"value": 9, "unit": "1/s"}})): "does not follow",
                   line(row(status="skipped")): "the status skipped, but it has times",
                   line(row(check=[{**row()["check"][0], "value": 50}])): "check psnr does not hold",
                   line({key: value for key, value in row().items() if key != "axes"}): "no field axes"}
        for text, pattern in damaged.items():
            self.refuses(pattern if ":2:" in pattern else "a.jsonl:1: damaged: .*" + pattern, self.journal(text))
        self.refuses("no such folder or file", self.folder / "none")
        (self.folder / "empty").mkdir()
        self.refuses("contains no results", self.folder / "empty")

    def test_a_ratio_has_one_direction_whatever_the_phase_is_called(self):
        def timed(schema, name, value, phase="nest"):
            base = row(schema=schema)
            base["samples"][phase] = {"event_ms": [], "wall_ms": [ms / 2 for ms in base["samples"]["frame"]["wall_ms"]]}
            return line({**base, "metrics": {name: {"value": value, "unit": "times"}}})
        for schema, name, value, phase in ((3, "nest_ratio", 0.5, "nest"), (3, "half_ratio", 0.5, "half"),
                                           (3, "frame_over_nest", 2, "nest"), (2, "nest_ratio", 0.5, "nest")):
            self.journal(timed(schema, name, value, phase))
            self.assertEqual(pelage.read(self.folder)[f"metric.{name}"][0], value)
            self.refuses("does not follow", self.journal(timed(schema, name, 1 / value, phase)))
        self.journal(timed(2, "half_ratio", 2, "half"))  # the name of schema 2
        self.assertEqual(pelage.read(self.folder)["metric.frame_over_half"][0], 2)
        self.refuses("does not follow", self.journal(timed(2, "half_ratio", 0.5, "half")))

    def test_contradicting_copies_are_an_error(self):
        self.journal(line(row()))
        self.journal(line(row(image_hash="0" * 16)), "other/a.jsonl")
        self.refuses("the two rows differ", self.folder)

    def test_all_recordings_are_read_as_export_writes_them(self):
        for place in sorted(path for path in RECORDED.iterdir() if path.is_dir() and list(path.glob("*.jsonl"))):
            exported = subprocess.run([PELAGE, "export", place], check=True, capture_output=True, text=True).stdout
            lines = pandas.read_csv(io.StringIO(exported), keep_default_na=False, na_values=[""])
            lines = lines[(lines.phase == "frame") & (lines.clock == "wall")].reset_index(drop=True)
            frame = pelage.read(place)
            self.assertEqual(list(frame.case), list(lines.case), place)
            self.assertEqual(list(frame.identity.fillna("")), list(lines.identity.fillna("")))
            for name in ("median_ms", "low_ms", "high_ms", "samples", "repeat", "metric.triangles"):
                if name in lines:
                    pandas.testing.assert_series_equal(frame[name], lines[name], check_dtype=False, rtol=1e-9)

    def test_a_new_run_has_the_identity_that_export_prints(self):
        self.journal(line(row()))
        exported = subprocess.run([PELAGE, "export", self.folder], check=True, capture_output=True, text=True).stdout
        self.assertEqual(pandas.read_csv(io.StringIO(exported)).identity[0], pelage.read(self.folder).identity[0])


class Document(unittest.TestCase):
    """Runs the code blocks of docs/results.md in a folder with the recorded results of Table 1."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pelage-document-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        shutil.copytree(RECORDED / "silva2010-table1", "table1")
        subprocess.run([PELAGE, "export", "table1", "--csv", "out.csv"], check=True)

    def blocks(self, language):
        return re.findall(f"```{language}\n(.*?)```", (SOURCE / "docs/results.md").read_text(), re.DOTALL)

    def rate(self):
        """Returns the mean over the processes of the frame rate of lion-16-1680x1050, cut off after two decimals."""
        rates = []
        for file in (SOURCE / "results/silva2010-table1").glob("*.jsonl"):
            for row in map(json.loads, file.read_text().splitlines()):
                if row["case"] == "lion-16-1680x1050":
                    rates.append(1000 / statistics.median(row["samples"]["frame"]["wall_ms"]))
        return f"{math.floor(100 * sum(rates) / len(rates)) / 100:.2f}"

    def test_python(self):
        blocks = self.blocks("python")
        self.assertGreaterEqual(len(blocks), 1)
        for block in blocks:
            said = io.StringIO()
            with redirect_stdout(said):
                exec(compile(block, "docs/results.md", "exec"), {})  # pylint: disable=exec-used
            self.assertIn("lion", said.getvalue())
            self.assertIn(self.rate(), said.getvalue())

    def test_r(self):
        blocks = self.blocks("r")
        self.assertEqual(len(blocks), 1)
        if not shutil.which("Rscript"):
            self.skipTest("R is not installed")
        Path("block.R").write_text(blocks[0])
        said = subprocess.run(["Rscript", "block.R"], check=True, capture_output=True, text=True).stdout
        self.assertIn("lion", said)
        self.assertIn(self.rate(), said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
