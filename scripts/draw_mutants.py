#!/usr/bin/python3
"""Draws random mistakes (mutants) in the sources of some folders, and runs the tests that should detect them.

    scripts/draw_mutants.py [--count N] [--seed TEXT] [--folder NAME]... [--build FOLDER] [--jobs N] [--list]

A mutant changes one operator, number or keyword of one line of harness/NAME/. The seed is HEAD's hash by default, so
that nobody chooses the mutants. Each mutant is built and run against the tests of its own folder and then of those that
use it, without those of the label "full", until a test fails. A mutant that does not compile is drawn again. The last
lines list the survivors. The exit status is 0 if at least 90% of the mutants are killed, else 1. mutants.py says how
files are restored.
"""
import argparse
import os
import pathlib
import random
import re
import subprocess
import sys

from mutants import ROOT, Mistake, build, planted, run, take_signals

# The suites of each folder: its own first, then those of the folders that use it.
TESTS = {
    "record": ["record", "experiment", "measure", "claims", "report", "planted", "cli"],
    "claims": ["claims", "report", "cli"],
    "report": ["report", "page", "cli"],
    "measure": ["measure", "record", "subjects", "report", "cli"],
    "experiment": ["experiment", "measure", "claims", "subjects", "report", "cli"],
    "mesh": ["mesh", "prepare", "cli"],
}
# Patterns and what replaces them (None: the number plus one). The spaces around operators leave out templates.
CHANGES = [
    (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "),
    (r" && ", " || "), (r" \|\| ", " && "), (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "),
    (r" \+= ", " -= "), (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"\bcontinue;", ";"), (r"\bbreak;", ";"),
    (r"(?<=[(, ])!(?=[a-z(])", ""), (r"(?<=[ (\[])\d+(?=[ ;,)\]])", None),
]


def candidates(folder):
    """Yields (file, begin, end, replacement) for every possible mutant of a folder."""
    for file in sorted((ROOT / "harness" / folder).rglob("*.?pp")):
        offset = 0
        for line in file.read_text().splitlines(keepends=True):
            code = line.split("//")[0]
            if not code.lstrip().startswith(("#", "using ", "template")):
                blank = re.sub(r'"(\\.|[^"\\])*"', lambda m: "\0" * len(m[0]), code)  # string literals do not change
                for pattern, new in CHANGES:
                    for match in re.finditer(pattern, blank):
                        yield (file, offset + match.start(), offset + match.end(),
                               str(int(match[0]) + 1) if new is None else new)
            offset += len(line)


def killer_of(options, folder, mutant):
    """Returns the suite that kills the mutant, "" if none does, or None if the mutant does not compile."""
    with planted(*mutant, True):
        for suite in TESTS[folder]:
            if build(options.build, options.jobs, f"test_{suite}"):
                return None
            tests = subprocess.run(["ctest", "--test-dir", options.build, "--tests-regex", rf"^{suite}\.",
                                    "--label-exclude", "full", "--parallel", str(options.jobs), "--timeout", "600",
                                    "--stop-on-failure", "--no-tests=error"], capture_output=True, text=True)
            if "No tests were found" in tests.stdout + tests.stderr:
                raise Mistake(f"{suite}: no such test")
            if tests.returncode:
                return suite
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", help="default: the hash of HEAD")
    parser.add_argument("--folder", action="append", choices=sorted(TESTS))
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="a configured build folder")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true", help="only print the mutants")
    options = parser.parse_args()
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    chance = random.Random(options.seed or head.stdout.strip())
    take_signals()
    pool = {folder: list(candidates(folder)) for folder in options.folder or TESTS}
    survivors, done = [], 0
    while done < options.count and any(pool.values()):
        folder = chance.choice([folder for folder, left in pool.items() if left])
        file, begin, end, new = mutant = pool[folder].pop(chance.randrange(len(pool[folder])))
        text = file.read_text()
        line = text[text.rfind("\n", 0, begin) + 1:text.find("\n", end)].strip()
        place = f"{file.relative_to(ROOT)}:{text.count(chr(10), 0, begin) + 1}"
        name = f"{place}: '{text[begin:end]}' -> '{new}' in '{line}'"
        killer = "listed" if options.list else killer_of(options, folder, mutant)
        if killer is None:
            continue
        done += 1
        print(name if options.list else f"{name}: {'killed by ' + killer if killer else 'SURVIVED'}", flush=True)
        if not killer:
            survivors.append(name)
    if not options.list:
        print(f"\n{done - len(survivors)} of {done} killed; survivors:", *survivors, sep="\n  ")
    return 0 if 10 * len(survivors) <= done else 1


if __name__ == "__main__":
    run(main)
