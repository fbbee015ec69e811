"""The sentences on pairs of readings whose numbers scripts/figures.py checks.

The rows are those of the experiment readings with the preset paper (docs/effects/readings.csv): each case changes one key
of the default scene, or two keys. The two cases that change the same two keys draw the same picture.
"""
import math
import tomllib

from effects_sentences import READINGS
from recorded_tables import ROOT, mean, median, table

NEAR = 0.05  # "within 5%" in the document


def key_of(reading):
    """Returns the scene's key that a value of the axis `switch` changes."""
    with (ROOT / "experiments/readings.toml").open("rb") as file:
        [(table_name, entry)] = tomllib.load(file)["switch"][reading].items()
    return f"{table_name}.{next(iter(entry))}"


def error(rows):
    """Returns the mean squared difference from the default scene's picture, relative to white."""
    return sum(10 ** (-row["baseline_psnr"] / 10) for row in rows) / len(rows)


def time(rows):
    return mean(row["baseline_ratio"] for row in rows)


def cases():
    """Returns the rows that change a set of readings, by this set."""
    changed = {}
    for row in table("effects/readings.csv"):
        readings = frozenset({row["switch"], row["with"]} - {"default", "depth"})
        if row["switch"] != "depth" and readings:
            changed.setdefault(readings, []).append(row)
    return changed


def pairs():
    """Returns the pairs of readings that change two different keys: the readings, the rows of the pair and of each one."""
    keys = {reading: key_of(reading) for reading in READINGS}
    every = cases()
    for readings, rows in every.items():
        if len(readings) == 2 and len({keys[reading] for reading in readings}) == 2:
            first, second = sorted(readings, key=list(READINGS).index)
            yield f"{READINGS[first]} and {READINGS[second]}", rows, every[frozenset({first})], every[frozenset({second})]


def times_of_pairs():
    found = sorted((time(both) / (time(first) * time(second)), names) for names, both, first, second in pairs())
    near = sum(abs(value - 1) <= NEAR for value, _ in found)
    return {"pairs": len(found), "near": near, "least": f"{found[0][0]:.2f}", "least_cell": found[0][1],
            "most": f"{found[-1][0]:.2f}", "most_cell": found[-1][1]}


def orders_of_pairs():
    """How far the ratios of two cases with the same picture are apart, in percent."""
    apart = [100 * abs(math.expm1(math.log(rows[0]["baseline_ratio"] / rows[1]["baseline_ratio"])))
             for _, rows, _, _ in pairs() if len(rows) == 2]
    return {"middle": f"{median(apart):.1f}", "most": f"{max(apart):.0f}"}


def errors_of_pairs():
    found = sorted((error(both) / (error(first) + error(second)), names) for names, both, first, second in pairs())
    return {"middle": f"{median(value for value, _ in found):.2f}", "least": f"{found[0][0]:.2f}", "least_cell": found[0][1],
            "most": f"{found[-1][0]:.2f}", "most_cell": found[-1][1]}


SENTENCES = [
    ("docs/performance.md", "Of the {pairs} pairs, {near} take within 5% of the product of the two single ratios. The smallest "
     "quotient of a pair's ratio and this product is {least} ({least_cell}), and the largest is {most} ({most_cell}).", times_of_pairs),
    ("docs/performance.md", "Two cases that change the same two keys draw the same picture, and their ratios differ by {middle}% (median) "
     "and at most {most}%.", orders_of_pairs),
    ("docs/performance.md", "The mean squared difference of a pair's picture from the default picture is {middle} times the sum of those of "
     "its two readings (median); the smallest factor is {least} ({least_cell}), and the largest is {most} ({most_cell}).",
     errors_of_pairs),
]
