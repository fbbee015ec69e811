#!/usr/bin/env python3
"""Compares the frame times of two builds of pelage: an old and a new checkout, both built in build/release.

A cell is a model and a number of layers in the experiment silva2010-table1. Every round measures every cell. Two
processes of the old build and one process of the new build draw the frames of a cell in turns of 0.15 s. The second
process of the old build is a control: its frame times should equal those of the first process. The order of the
processes changes from round to round. scripts/turns.cpp makes the processes take turns.

  scripts/compare_builds.py OLD NEW -o FOLDER             20 rounds of 6 cells, about 20 minutes
  scripts/compare_builds.py OLD NEW -o FOLDER --rounds 0  prints the ratios of the rounds that FOLDER contains

The ratio of a round is (median frame time of the new build) / (geometric mean of the median frame times of both old
processes). The script prints the median of the ratios of all rounds, and a 95% confidence interval of this median.
"""
import argparse
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from pelage import median_interval  # noqa: E402

SIDES = ("old", "new", "control")
TURN_S = 0.15
PRESET = """
[preset.turns]
warm_up_s = 0.0
least = {frames}
most = {frames}
precision = 1.0
limit_s = 600.0
axes.reading = ["{reading}"]
"""


def build_shim(folder):
    shim = folder / "turns.so"
    subprocess.run(["g++", "-O2", "-std=c++20", "-shared", "-fPIC", "-o", shim,
                    Path(__file__).with_name("turns.cpp"), "-ldl"], check=True)
    return shim


def run_cell(trees, shim, scratch, order, cell, place):
    """Runs the three processes of one cell, in the order of their names `order`, at the same time. The process NAME
    writes its results to the folder `place`-NAME."""
    model, layers, size = cell
    shared = scratch / "shared"
    shared.write_bytes(bytes(64))
    running = []
    for number, side in enumerate(order):
        tree = trees["new" if side == "new" else "old"]
        folder = Path(f"{place}-{side}")
        experiment = scratch / ("new.toml" if side == "new" else "old.toml")
        command = [tree / "build/release/pelage", "run", experiment, "--preset", "turns", "--axis", f"model={model}",
                   "--axis", f"layers={layers}", "--axis", f"size={size}", "-o", folder]
        environment = dict(os.environ, PELAGE_DATA=str(tree), LD_PRELOAD=str(shim), TURN_FILE=str(shared),
                           TURN_ID=str(number), TURN_COUNT=str(len(order)), TURN_SECONDS=str(TURN_S))
        with open(f"{folder}.log", "w", encoding="utf-8") as log:
            running.append(subprocess.Popen(command, env=environment, stdout=log, stderr=log))
    if any([process.wait() for process in running]):
        sys.exit(f"compare_builds.py: a process failed; see {place}-*.log")


def frame_ms(folder):
    """Returns the median frame time in ms of the only row in the folder."""
    rows = [json.loads(line) for file in folder.rglob("*.jsonl") for line in file.read_text().splitlines()]
    if len(rows) != 1 or rows[0]["status"] != "ok":
        sys.exit(f"compare_builds.py: {folder}: there must be one row, and it must be ok")
    return statistics.median(rows[0]["samples"]["frame"]["wall_ms"])


def summary(logs):
    return [math.exp(x) for x in (statistics.median(logs), *median_interval(logs))]


def report(folder, cells):
    times = {}
    for path in folder.glob(f"*-{SIDES[1]}"):
        number, *cell = path.name.split("-")[:-1]
        group = [folder / "-".join([number, *cell, side]) for side in SIDES]
        if all(one.is_dir() for one in group):
            times[int(number), "-".join(cell)] = [math.log(frame_ms(one)) for one in group]
    names = ["-".join(cell) for cell in cells]
    rounds = [r for r in sorted({r for r, _ in times}) if all((r, name) in times for name in names)]
    if not rounds:
        sys.exit("compare_builds.py: no complete round")
    print(f"{len(rounds)} rounds; frame time new / old, and control / old")
    new = {name: [times[r, name][1] - (times[r, name][0] + times[r, name][2]) / 2 for r in rounds] for name in names}
    control = {name: [times[r, name][2] - times[r, name][0] for r in rounds] for name in names}
    for values in (new, control):
        values["geometric mean"] = [statistics.mean(values[name][i] for name in names) for i in range(len(rounds))]
    for name in [*names, "geometric mean"]:
        print("{:<20} {:.3f} [{:.3f}, {:.3f}]   {:.3f} [{:.3f}, {:.3f}]".format(
            name, *summary(new[name]), *summary(control[name])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Path, metavar="OLD")
    parser.add_argument("new", type=Path, metavar="NEW")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--frames", type=int, default=12, help="timed frames of each process and cell")
    parser.add_argument("--models", nargs="+", default=["torus", "bunny", "lion"])
    parser.add_argument("--layers", nargs="+", default=["16", "64"])
    parser.add_argument("--size", default="800x600")
    options = parser.parse_args()
    trees = {"old": options.old.resolve(), "new": options.new.resolve()}
    cells = [(model, layers, options.size) for model in options.models for layers in options.layers]
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch_name:
        scratch = Path(scratch_name)
        for side, tree in trees.items():
            text = (tree / "experiments/silva2010-table1.toml").read_text()
            reading = re.search(r'^reading = \["([^"]+)"', text, re.MULTILINE)[1]    # the tree's first reading
            (scratch / f"{side}.toml").write_text(text + PRESET.format(frames=options.frames, reading=reading))
        shim = build_shim(scratch) if options.rounds > 0 else None
        for number in range(options.rounds):
            order = [SIDES[(number + k) % 3] for k in range(3)]
            for cell in cells:
                run_cell(trees, shim, scratch, order, cell, options.output / "-".join([str(number), *cell]))
    report(options.output, cells)


if __name__ == "__main__":
    main()
