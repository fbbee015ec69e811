#!/usr/bin/env python3
"""Draws one column of a table of results against another column, as a JSON description states.

`pelage report` writes this program, the table (TABLE.csv) and the description (TABLE.json) into one folder. The program
needs only matplotlib. If all values of x are numbers, it draws lines; otherwise it draws points. A picture size
such as 800x600 counts as a number, its number of pixels. The error bars are the 95% intervals.
"""
import itertools
import json
import math
import re
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import style

MOST_COLUMNS = 4  # This is the largest number of panels side by side.
MOST_LEGEND = 24  # This is the largest number of series in the legend.


def number(text):
    """Returns the number in the text. Returns the number of pixels for a picture size, and None for other texts."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        size = re.fullmatch(r"(\d+)x(\d+)", text or "")
        return float(size[1]) * float(size[2]) if size else None
    return value if math.isfinite(value) else None


def natural(text):
    value = number(text)
    if value is not None:
        return (0, value, [])
    return (1, 0.0, [(0, int(p), "") if p.isdigit() else (1, 0, p) for p in re.split(r"(\d+)", text) if p])


class Keys:
    """Sorts and labels the values of the table's columns."""

    def __init__(self, description, rows):
        self.order, self.labels = description["order"], description["labels"]
        # The usual reading needs no label, unless another reading stands beside it.
        one_reading = len({r.get("reading") for r in rows}) < 2
        self.unlabelled = ("default", "paper") if one_reading else ()

    def place(self, column, value):
        order = self.order.get(column, [])
        return (order.index(value) if value in order else len(order), natural(value))

    def combinations(self, rows, columns):
        found = {tuple(r[c] for c in columns) for r in rows}
        return sorted(found, key=lambda values: [self.place(c, v) for c, v in zip(columns, values)])

    def text(self, columns, values):
        parts = [self.labels.get(c, "{}").replace("{}", re.sub(r"^(\d+)x(\d+)$", "\\1 × \\2", v))
                 for c, v in zip(columns, values) if not (c == "reading" and v in self.unlabelled)]
        return ", ".join(p for p in parts if p)


def bars(rows, value, low, high):
    """Returns the lengths of the error bars below and above the values, or None if there are no intervals."""
    if not low:
        return None
    below = [max(0.0, v - (number(r[low]) if number(r[low]) is not None else v)) for v, r in zip(value, rows)]
    above = [max(0.0, (number(r[high]) if number(r[high]) is not None else v) - v) for v, r in zip(value, rows)]
    return [below, above]


def point_text(r, line, x, y, low, high, d):
    """Returns the text that a browser shows for a point: the line, the value with its interval, and x."""
    limits = [number(r[c]) if c in r else None for c in (low, high)]
    interval = " [{:.4g}, {:.4g}]".format(*limits) if None not in limits else ""
    return "\n".join(p for p in (line, f"{d['y_label']}: {number(r[y]):.4g}{interval}", f"{d['x_label']}: {r[x]}") if p)


def draw_published(axis, rows, x_of, d, look):
    """Draws the numbers of the paper. If a number is only a lower limit, draws an arrow that points up from it."""
    column = d["published"]["column"]
    have = [r for r in rows if number(r[column]) is not None]
    known = [r for r in have if number(r[column + "_high"]) is not None or number(r[column + "_low"]) is None]
    handle = None
    if known:
        y = [number(r[column]) for r in known]
        handle = axis.errorbar([x_of(r) for r in known], y, yerr=bars(known, y, column + "_low", column + "_high"),
                               **{"markerfacecolor": "white", "linewidth": 0.9, "linestyle": "--"} | look)
        style.tell(handle[0], [point_text(r, d["published"]["label"], d["x"], column, column + "_low", column + "_high", d)
                               for r in known])
    for r in have:
        if r not in known:
            x, y = x_of(r), number(r[column])
            axis.annotate("", (x, y * 2), (x, y),
                          arrowprops={"arrowstyle": "->", "color": look["color"], "linestyle": "--"})
            [mark] = axis.plot(x, y, linestyle="none", markerfacecolor="white",
                               **{k: v for k, v in look.items() if k not in ("capsize", "linestyle")})
            label = f"{d['published']['label']}, at least"
            style.tell(mark, [point_text(r, label, d["x"], column, column + "_low", column + "_high", d)])
            axis.plot(x, y * 2.2, alpha=0)  # invisible; extends the axis, so that the arrow fits
    return handle


def least_step(rows, d):
    """Returns the smallest distance between two values of x on its scale; 0 if x has only one value."""
    values = sorted({number(r[d["x"]]) for r in rows if number(r[d["x"]]) is not None})
    if d["x_scale"] == "log":
        values = [math.log(v) for v in values if v > 0]
    return min((b - a for a, b in zip(values, values[1:])), default=0)


def draw_panel(axis, rows, series, categories, keys, d):
    """Draws the series of one panel. Returns a map from the labels of the legend to the drawn artists."""
    handles = {}
    # Error bars at the same x would cover each other. They are therefore drawn beside each other, 4% of the smallest
    # distance between two values of x apart, and less if there are more than four series.
    beside = 0 if categories or not d["low"] else 0.04 * least_step(rows, d) / max(1, len(series) / 4)
    for i, values in enumerate(series):
        colour, marker = style.COLOURS[i % len(style.COLOURS)], style.MARKERS[i % len(style.MARKERS)]
        look = {"color": colour, "marker": marker, "markersize": 4.5, "capsize": 2}
        # The length of a bar is its number only on a linear axis. A bar has the series' colour; its top carries the interval.
        as_bars = d.get("bars", False) and bool(categories) and d["y_scale"] == "linear"
        if as_bars:
            look |= {"color": "black", "marker": "_"}
        mine = [r for r in rows if tuple(r[c] for c in d["series"]) == values]
        if categories:
            shift = 0.7 / max(1, len(series)) * (i - (len(series) - 1) / 2)

            def x_of(r, shift=shift):
                return categories.index(r[d["x"]]) + shift
        else:
            mine = sorted((r for r in mine if number(r[d["x"]]) is not None), key=lambda r: number(r[d["x"]]))

            def x_of(r, shift=beside * (i - (len(series) - 1) / 2)):
                x = number(r[d["x"]])
                return x * math.exp(shift) if d["x_scale"] == "log" else x + shift
        have = [r for r in mine if number(r[d["y"]]) is not None]
        y = [number(r[d["y"]]) for r in have]
        label = keys.text(d["series"], values)
        ours = ", ".join(p for p in ("ours" if "published" in d else "", label) if p)
        if have:
            # If several points have the same x (models with equal numbers of triangles), no line joins the points.
            joined = not categories and len({x_of(r) for r in have}) == len(have)
            if as_bars:
                handles[ours] = axis.bar([x_of(r) for r in have], y, 0.7 / len(series), color=colour)
            drawn = axis.errorbar([x_of(r) for r in have], y, yerr=bars(have, y, d["low"], d["high"]),
                                  linewidth=1.3, elinewidth=1, linestyle="-" if joined else "none", **look)
            handles.setdefault(ours, drawn)
            style.tell(drawn[0], [point_text(r, ours, d["x"], d["y"], d["low"], d["high"], d) for r in have])
        if "published" in d:
            handle = draw_published(axis, mine, x_of, d, look | {"marker": "D", "linestyle": "none"} if as_bars else look)
            if handle:
                name = d["published"]["label"]
                handles[f"{name}, {label}" if label and not as_bars else name] = handle
    return handles


def decorate(axis, title, categories, values, d):
    """Sets the scales, ticks and title of a panel. If x is numeric, `values` contains its values."""
    axis.set_yscale(d["y_scale"])
    if categories:
        room = 40 / len(categories)  # the letters of a label that does not touch its neighbours
        turned = len(categories) > 4 or any(len(a + b) / 2 > room for a, b in itertools.pairwise(categories))
        axis.set_xticks(range(len(categories)), categories, rotation=30 if turned else 0,
                        ha="right" if turned else "center", rotation_mode="anchor" if turned else None)
        axis.set_xlim(-0.6, len(categories) - 0.4)
    else:
        axis.set_xscale(d["x_scale"])
        if d["x_scale"] == "linear":
            axis.xaxis.set_major_locator(matplotlib.ticker.FixedLocator(values) if 1 < len(values) <= 5 else
                                         matplotlib.ticker.MaxNLocator(5))
            axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:.10g}"))
    if "guide" in d:
        axis.axhline(d["guide"], color="0.4", linewidth=0.8)
    for limit in d.get("limits", []):
        axis.axhline(limit, color="0.4", linewidth=0.8, linestyle=":")
    axis.set_title(title, fontsize=9)
    axis.grid(True, which="minor", color="0.93", linewidth=0.4)
    style.open_axis(axis)


def from_zero(axis, rows, d):
    """Starts a linear vertical axis at 0 if no number is negative, so that differences do not look larger than they are."""
    if d.get("limits"):
        return  # likenesses such as 0.93 and 0.99 differ little from each other, but not from their limits
    columns = [c for c in (d["y"], d["low"], d["high"]) if c]
    values = [number(r[c]) for r in rows for c in columns if number(r[c]) is not None]
    if d["y_scale"] == "linear" and values and min(values) >= 0:
        axis.set_ylim(bottom=0)


def plain_ticks(axis, numbers):
    """Labels logarithmic axes that span at most three decades with plain numbers such as 500; a horizontal axis with
    at most six values, the list `numbers`, with these."""
    for ticks, scale, limits in ((axis.xaxis, axis.get_xscale(), axis.get_xlim()),
                                 (axis.yaxis, axis.get_yscale(), axis.get_ylim())):
        if scale != "log" or limits[0] <= 0 or limits[1] / limits[0] > 1000:
            continue
        if ticks is axis.xaxis and 1 < len(numbers) <= 6:
            ticks.set_major_locator(matplotlib.ticker.FixedLocator(numbers))
            ticks.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:.10g}"))
            ticks.set_minor_locator(matplotlib.ticker.NullLocator())
            continue
        steps = (1, 2, 5) if limits[1] / limits[0] < 100 else (1, 3)
        ticks.set_major_locator(matplotlib.ticker.LogLocator(subs=steps))
        ticks.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:.10g}"))
        ticks.set_minor_formatter(matplotlib.ticker.NullFormatter())


def main(rows, table, outputs):
    d = json.loads(Path(table).with_suffix(".json").read_text(encoding="utf-8"))
    keys = Keys(d, rows)
    panels = keys.combinations(rows, d["panels"]) or [()]
    series = keys.combinations(rows, d["series"]) or [()]
    numeric = all(number(r[d["x"]]) is not None for r in rows if r[d["x"]])
    numbers = sorted({number(r[d["x"]]) for r in rows if r[d["x"]]}) if numeric else []
    in_order = list(dict.fromkeys(r[d["x"]] for r in rows))
    categories = [] if numeric else sorted(in_order, key=lambda v: (keys.place(d["x"], v)[0], in_order.index(v)))

    across = min(MOST_COLUMNS, len(panels))
    down = math.ceil(len(panels) / across)
    width = max(3.0, 0.45 * len(categories) * max(1, len(series) / 4) + 1) if categories else 3.2
    figure, axes = plt.subplots(down, across, figsize=(min(width, 7) * across + 0.8, 3.0 * down + 0.6), sharex=not categories,
                                sharey=True, squeeze=False, constrained_layout=True)
    handles = {}
    for axis, values in itertools.zip_longest(axes.flat, panels):
        if values is None:
            axis.set_visible(False)
            continue
        mine = [r for r in rows if tuple(r[c] for c in d["panels"]) == values]
        for label, handle in draw_panel(axis, mine, series, categories, keys, d).items():
            handles.setdefault(label, handle)
        decorate(axis, keys.text(d["panels"], values), categories, numbers, d)
    from_zero(axes[0][0], rows, d)
    plain_ticks(axes[0][0], numbers)
    for i, row in enumerate(axes):
        row[0].set_ylabel(d["y_label"])
        for j, axis in enumerate(row):
            if not categories and (i + 1) * across + j >= len(panels):
                axis.set_xlabel(d["x_label"])
                axis.tick_params(labelbottom=True)
    if any(handles):
        shown = dict(itertools.islice(handles.items(), MOST_LEGEND))
        figure.legend(shown.values(), shown.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0),
                      ncol=min(len(shown), 2 * across, 4), frameon=False)
    if d["note"]:
        figure.suptitle(d["note"], fontsize=8, color="0.35")
    return figure


if __name__ == "__main__":
    style.run(main, __doc__)
