#!/usr/bin/env python3
"""Draws our frame times and the paper's against the number of triangles (log-log), with a panel per number of layers.

usage: frame_time.py TABLE.csv OUT.svg [OUT.pdf ...]

TABLE.csv is the table that a report stores next to this program. The program needs only matplotlib.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Colour-blind readers can distinguish these colours of Okabe and Ito. The markers distinguish the lines in grey print.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7"]
MARKERS = ["o", "s", "^", "D"]


def number(text):
    return float(text) if text else None


def leading(text):
    digits = "".join(c if c.isdigit() else " " for c in text).split()
    return int(digits[0]) if digits else 0


def main(table, outputs):
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    layers = sorted({r["layers"] for r in rows}, key=leading)
    sizes = sorted({r["size"] for r in rows}, key=leading)

    plt.rcParams.update({"font.size": 9, "svg.hashsalt": "pelage", "svg.fonttype": "none", "pdf.fonttype": 42})
    figure, axes = plt.subplots(1, max(1, len(layers)), figsize=(3.6 * max(1, len(layers)) + 1.2, 4.2),
                                sharex=True, sharey=True, squeeze=False, constrained_layout=True)
    drawn = {}
    top = max([number(r["median_ms_high"]) or 0 for r in rows] +
              [2200 for r in rows if r["paper_relation"] == "<"], default=0)
    for axis, layer in zip(axes[0], layers):
        for i, size in enumerate(sizes):
            colour, marker = COLOURS[i % 4], MARKERS[i % 4]
            cell = sorted((r for r in rows if r["layers"] == layer and r["size"] == size and r["triangles"]),
                          key=lambda r: float(r["triangles"]))
            ours = [r for r in cell if number(r["median_ms"])]
            x = [float(r["triangles"]) for r in ours]
            y = [float(r["median_ms"]) for r in ours]
            error = [[max(0, m - float(r["median_ms_low"])) for m, r in zip(y, ours)],
                     [max(0, float(r["median_ms_high"]) - m) for m, r in zip(y, ours)]]
            if ours:
                drawn["ours, " + size.replace("x", " × ")] = axis.errorbar(
                    x, y, yerr=error, color=colour, marker=marker, markersize=5, linewidth=1.4, capsize=2)
            paper = [r for r in cell if number(r["paper_fps"]) and r["paper_relation"] != "<"]
            if paper:
                # A published whole number of frames per second represents all values that round to it. The error bars
                # show this range.
                y = [1000 / float(r["paper_fps"]) for r in paper]
                error = [[m - 1000 / (number(r["paper_fps_high"]) or 1000 / m) for m, r in zip(y, paper)],
                         [1000 / (number(r["paper_fps_low"]) or 1000 / m) - m for m, r in zip(y, paper)]]
                drawn["paper, " + size.replace("x", " × ")] = axis.errorbar(
                    [float(r["triangles"]) for r in paper], y, yerr=error, color=colour, marker=marker,
                    markersize=5, markerfacecolor="white", linewidth=0.9, linestyle="--", capsize=2)
            # A published "< 1 fps" gives only a lower bound of the frame time, drawn as an arrow.
            bounds = [r for r in cell if number(r["paper_fps"]) and r["paper_relation"] == "<"]
            for r in bounds:
                bound = 1000 / float(r["paper_fps"])
                axis.annotate("", (float(r["triangles"]), bound * 2), (float(r["triangles"]), bound),
                              arrowprops={"arrowstyle": "->", "color": colour, "linestyle": "--"})
                axis.plot(float(r["triangles"]), bound, color=colour, marker=marker, markersize=5,
                          markerfacecolor="white", linestyle="none")
            if bounds:
                axis.annotate("paper: < 1 fps", (float(bounds[0]["triangles"]), 2000), xytext=(-6, 0),
                              textcoords="offset points", ha="right", va="center", fontsize=8, color="0.35")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(layer + " layers", fontsize=10)
        axis.set_xlabel("triangles")
        axis.grid(True, which="major", color="0.85", linewidth=0.6)
        axis.grid(True, which="minor", color="0.93", linewidth=0.4)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    if top > axes[0][0].get_ylim()[1]:
        axes[0][0].set_ylim(top=1.3 * top)
    axes[0][0].set_ylabel("frame time, ms")
    if drawn:
        figure.legend(drawn.values(), drawn.keys(), loc="lower center",
                      ncol=max(2, len(drawn) // 2 if len(drawn) > 4 else len(drawn)), frameon=False,
                      bbox_to_anchor=(0.5, -0.1))
    device = rows[0]["device"] if rows else ""
    if device:
        figure.suptitle(device, fontsize=9, color="0.35")
    for output in outputs:
        meta = {"Date": None} if output.endswith(".svg") else {"CreationDate": None} if output.endswith(".pdf") else {}
        figure.savefig(output, bbox_inches="tight", metadata=meta, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
