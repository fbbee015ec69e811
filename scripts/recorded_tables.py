"""Functions that read the tables of the recorded results in docs/."""
import csv
import math
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def table(name):
    """Returns the rows of a CSV file whose status is ok, with numbers where a cell is a number."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with (ROOT / "docs" / name).open(newline="", encoding="utf-8") as file:
        rows = [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]
    return [row for row in rows if row.get("status", "ok") == "ok"]


def mean(values):
    """Returns the geometric mean."""
    values = list(values)
    return math.exp(sum(map(math.log, values)) / len(values))


def median(values):
    values = sorted(values)
    return (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2


def by(rows, *keys):
    """Returns a dictionary from the values of `keys` to the rows with these values."""
    groups = defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in keys)].append(row)
    return groups


def ends(values, form):
    """Returns the smallest and the largest value as text."""
    values = list(values)
    return {"least": format(min(values), form), "most": format(max(values), form)}
