#!/usr/bin/env python3
"""Counts how often `pelage compare` gives a wrong verdict on this machine.

Each trial compares two sets of results whose true difference is known. The processes of both sets take turns. In half
of the trials both sets draw the same scene, so each verdict but "same" and "undecided" is wrong. In the others the
second set draws one layer more (16 and 17 layers), so the verdict should be "slower".

  scripts/aa_test.py                                  40 trials of 2 x 12 processes, about 20 minutes
  scripts/aa_test.py --trials 200 --csv trials.csv    one line per trial
"""
import argparse
import csv
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PRESET = """
[preset.aa]
warm_up_s = 0.0
least = 20
most = 20
precision = 1.0
limit_s = 600.0
axes.reading = ["paper"]
"""


def run_trial(options, experiment, folder, order, layers):
    """Runs the processes of both sides in turns, and returns what `pelage compare` prints for them."""
    for number in range(options.rounds):
        sides = [("a", 16), ("b", layers)]
        order.shuffle(sides)
        for side, count in sides:
            command = [options.pelage, "run", experiment, "--preset", "aa", "--axis", f"model={options.model}", "--axis",
                       f"layers={count}", "--axis", f"size={options.size}", "-o", folder / side / str(number)]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    # The sides differ only in the number of layers, so that --by pairs them.
    sets = [folder / "a", folder / "b"] + (["--by", "axes.layers"] if layers != 16 else [])
    text = subprocess.run([options.pelage, "compare", *sets, "--threshold", "0", "--alpha", "2%", "--json"], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    return json.loads(text)[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--rounds", type=int, default=12, help="processes of each side in a trial, at least 3")
    parser.add_argument("--model", default="torus")
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--pelage", type=Path, default=ROOT / "build/release/pelage")
    parser.add_argument("--csv", type=Path, help="write one line per trial into this file")
    options = parser.parse_args()
    order, lines = random.Random(1), []
    with tempfile.TemporaryDirectory() as name:
        experiment = Path(name) / "aa.toml"
        experiment.write_text((ROOT / "experiments/silva2010-table1.toml").read_text() + PRESET)
        for number in range(options.trials):
            side, layers = ("equal", 16) if number % 2 == 0 else ("slower", 17)
            found = run_trial(options, experiment, Path(name) / str(number), order, layers)
            lines.append([side, found["change"], found["low"], found["high"], found["p"], int(found["paired"]),
                          found["verdict"]])
            print(f"{number + 1}/{options.trials} {side}: {found['change']:+.2%} {found['verdict']}", file=sys.stderr)
    verdicts = {side: [line[-1] for line in lines if line[0] == side] for side in ("equal", "slower")}
    wrong = sum(verdict in ("faster", "slower") for verdict in verdicts["equal"])
    print(f"equal sides wrongly called different: {wrong} of {len(verdicts['equal'])}")
    print(f"17 layers called slower than 16: {verdicts['slower'].count('slower')} of {len(verdicts['slower'])}")
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([["side", "change", "low", "high", "p", "paired", "verdict"], *lines])


if __name__ == "__main__":
    main()
