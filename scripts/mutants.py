#!/usr/bin/python3
"""Applies deliberate mistakes (mutants) to the sources one by one and runs the tests that must detect them.

    scripts/mutants.py [--data FILE] [--build FOLDER] [--jobs N] [--check] [NAME ...]

FILE is tests/mutants/survivors.toml by default. The heading of a mutant, such as [test_mesh."Rotate.*".rotation-order],
has the name of a test program, a GoogleTest filter and the mutant's name. Its `original` is a text that occurs exactly
once in the tracked files of harness/ and kernels/; differences in white space are ignored. The program replaces this text
by `replacement`. Then the tests that match the filter must fail. `why` describes the effect of the mistake.

The tests of a mutant must pass without the mutant. Mutants of kernels need no build, because kernels are compiled when
a test runs. The program restores every file at the end, also after Ctrl-C. Do not commit while the program runs. When
it has ended, build pelage again, because the test programs may still contain the last mutant. The exit status is 0 if
all mutants are detected, 1 if some mutants are not detected or cannot be run, and 2 for an error in the data file or in
the command line.
"""
import argparse
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEYS = {"original", "replacement", "why"}
TEST_LIMIT_S = 600  # A test that takes longer with a mutant counts as failed, so it detects the mutant.


class Mistake(Exception):
    """An error in the data file or the command line. The message is one line."""


def tables(value, file):
    if not isinstance(value, dict) or not all(isinstance(table, dict) for table in value.values()):
        raise Mistake(f"{file}: a heading has a test program, a filter and a name")
    return value.items()


def read_data(file):
    try:
        programs = tomllib.loads(file.read_text())
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise Mistake(f"{file}: {error}") from error
    mutants = {}
    for target, filters in programs.items():
        if not target.startswith("test_"):
            raise Mistake(f"{file}: {target}: a heading begins with the name of a test program")
        for tests, entries in tables(filters, file):
            for name, mutant in tables(entries, file):
                if unknown := mutant.keys() - KEYS:
                    raise Mistake(f"{file}: {name}: unknown key {', '.join(sorted(unknown))}")
                if missing := KEYS - mutant.keys():
                    raise Mistake(f"{file}: {name}: no {', '.join(sorted(missing))}")
                if name in mutants:
                    raise Mistake(f"{file}: {name}: twice")
                mutants[name] = {"name": name, "target": target, "filter": tests, **mutant}
    return list(mutants.values())


def tracked_sources():
    listed = subprocess.run(["git", "ls-files", "-z", "harness", "kernels"], cwd=ROOT, check=True, stdout=subprocess.PIPE)
    files = [ROOT / name for name in listed.stdout.decode().split("\0") if name]
    return {file: file.read_text() for file in files if file.is_file()}


def find(mutant, sources):
    """Returns (file, begin, end): the file that contains the mutant's original text, and the text's position in it."""
    pattern = re.compile(r"\s+".join(re.escape(word) for word in mutant["original"].split()))
    places = [(file, m.start(), m.end()) for file, text in sources.items() for m in pattern.finditer(text)]
    if len(places) != 1:
        files = ", ".join(str(file.relative_to(ROOT)) for file, _, _ in places[:3])
        raise Mistake(f"{mutant['name']}: its original text occurs {len(places)} times, must be once"
                      + (f": {files}" if files else "; the code changed: follow it in the data file"))
    return places[0]


@contextlib.contextmanager
def planted(file, begin, end, replacement, built):
    """Inserts the mutant into the file for the duration of a with statement, and restores the file afterwards."""
    text, times = file.read_text(), file.stat()
    try:
        file.write_text(text[:begin] + replacement + text[end:])
        yield
    finally:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)  # a second Ctrl-C must not interrupt the restoration
        file.write_text(text)
        # After a build, the restored file must be newer than the object files, so that the next build compiles the
        # file. Without a build, the file gets its old modification time, so that the next build does not compile the
        # file.
        if not built:
            os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))
        take_signals()


def build(folder, jobs, target):
    """Builds the target. If the build fails, returns the end of its output, otherwise ""."""
    run = subprocess.run(["cmake", "--build", folder, "--parallel", str(jobs), "--target", target],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return "" if run.returncode == 0 else run.stdout[-2000:]


def run_tests(folder, mutant):
    """Runs the mutant's tests. Returns (true if all passed, number of tests, seconds)."""
    program = pathlib.Path(folder) / "tests" / mutant["target"]
    begin = time.monotonic()
    try:
        run = subprocess.run([program, f"--gtest_filter={mutant['filter']}"], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, errors="replace", timeout=TEST_LIMIT_S)
    except subprocess.TimeoutExpired:
        return False, 1, time.monotonic() - begin
    ran = re.search(r"Running (\d+) tests?", run.stdout)
    return run.returncode == 0, int(ran[1]) if ran else 0, time.monotonic() - begin


def verdict(folder, jobs, mutant, place):
    file, begin, end = place
    kernel = file.is_relative_to(ROOT / "kernels")
    if fault := build(folder, jobs, mutant["target"]):
        return "does not build without the mutant\n" + fault
    passed, ran, _ = run_tests(folder, mutant)
    if ran == 0:
        return f"no test matches {mutant['filter']}"
    if not passed:
        return f"{mutant['filter']} fails without the mutant"
    with planted(file, begin, end, mutant["replacement"], not kernel):
        if not kernel and (fault := build(folder, jobs, mutant["target"])):
            return "the mutant does not build\n" + fault
        passed, _, seconds = run_tests(folder, mutant)
    return "SURVIVED" if passed else f"killed in {seconds:.1f} s"


def take_signals():
    def interrupted(number, _):
        raise KeyboardInterrupt(number)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, interrupted)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", nargs="*", help="names of the mutants to apply (default: all)")
    parser.add_argument("--data", type=pathlib.Path, default=ROOT / "tests/mutants/survivors.toml")
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="a configured build folder")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--check", action="store_true", help="only look for the original texts; applies nothing")
    options = parser.parse_args()
    take_signals()

    mutants = read_data(options.data)
    known = {mutant["name"] for mutant in mutants}
    if unknown := [name for name in options.name if name not in known]:
        raise Mistake(f"no mutant is named {', '.join(unknown)}: {', '.join(sorted(known))}")
    bad = killed = 0
    for mutant in mutants:
        if options.name and mutant["name"] not in options.name:
            continue
        try:
            place = find(mutant, tracked_sources())
            if options.check:
                said = "found in " + str(place[0].relative_to(ROOT))
            else:
                said = verdict(options.build, options.jobs, mutant, place)
        except Mistake as mistake:
            said = "not applied: " + str(mistake)
        if said.startswith("killed"):
            killed += 1
        elif not said.startswith("found"):
            bad += 1
        print(f"{mutant['name']}: {said}", flush=True)
    if not options.check:
        print(f"{killed} killed, {bad} not killed")
    return 1 if bad else 0


def run(main):
    """Exits with the status of main(), or with that of the Mistake or the interruption that ends it."""
    try:
        sys.exit(main())
    except Mistake as mistake:
        print(f"{pathlib.Path(sys.argv[0]).name}: {mistake}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("interrupted; every file is as it was", file=sys.stderr)
        sys.exit(130)


if __name__ == "__main__":
    run(main)
