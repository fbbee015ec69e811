#!/usr/bin/env python3
"""Draws a ratio of frame times for each model, number of layers and picture size.

The ratio is the time of the paper's OpenGL pipeline, divided by the time of our OpenCL pipeline.

usage: rivals.py TABLE.csv OUT.svg [OUT.pdf ...]

TABLE.csv is the table that a report stores next to this program. The program needs only matplotlib.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Colour-blind readers can distinguish these colours of Okabe and Ito. The markers distinguish the lines in grey print.
COLOURS = ["#0072B2", "#D55E00", "#56B4E9", "#E69F00"]
MARKERS = ["o", "s", "^", "D"]


def leading(text):
    digits = "".join(c if c.isdigit() else " " for c in text).split()
    return int(digits[0]) if digits else 0


def main(table, outputs):
    with open(table, newline="", encoding="utf-8") as file:
        rows = [r for r in csv.DictReader(file) if r["ratio"]]
    readings = list(dict.fromkeys(r["reading"] for r in rows))
    series = sorted({(r["layers"], r["size"]) for r in rows}, key=lambda p: (leading(p[0]), leading(p[1])))
    models = list(dict.fromkeys(r["model"] for r in sorted(rows, key=lambda r: float(r["triangles"]))))

    plt.rcParams.update({"font.size": 9, "svg.hashsalt": "pelage", "svg.fonttype": "none", "pdf.fonttype": 42})
    panels = max(1, len(readings))
    figure, axes = plt.subplots(1, panels, figsize=((0.55 * len(models) + 1.6) * panels, 3.4), sharey=True,
                                squeeze=False, constrained_layout=True)
    for axis, reading in zip(axes[0], readings):
        for i, (layers, size) in enumerate(series):
            have = [r for r in rows if (r["reading"], r["layers"], r["size"]) == (reading, layers, size)]
            shift = 0.14 * (i - (len(series) - 1) / 2)
            value = [float(r["ratio"]) for r in have]
            low = [v - float(r["ratio_low"]) for v, r in zip(value, have)]
            high = [float(r["ratio_high"]) - v for v, r in zip(value, have)]
            axis.errorbar([models.index(r["model"]) + shift for r in have], value, yerr=[low, high], linestyle="none",
                          color=COLOURS[i % 4], marker=MARKERS[i % 4], markersize=4.5, elinewidth=1, capsize=2,
                          label=f"{layers} layers, {size.replace('x', ' × ')}")
        axis.axhline(1, color="0.4", linewidth=0.8)
        axis.set_yscale("log")
        axis.set_yticks([1, 2, 3, 5, 10, 20])
        axis.set_yticklabels(["1", "2", "3", "5", "10", "20"])
        axis.minorticks_off()
        axis.set_xticks(range(len(models)))
        axis.set_xticklabels(models, rotation=30, ha="right")
        axis.set_title("" if reading == "default" else reading, fontsize=9)
        axis.grid(True, axis="y", color="0.88", linewidth=0.6)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    axes[0][0].set_ylabel("times as fast as the paper's pipeline")
    if series:
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower center", ncol=2, frameon=False, bbox_to_anchor=(0.5, -0.16))
    if rows:
        figure.suptitle(f"{rows[0]['device']} against {rows[0]['renderer'].split(' (')[0]}", fontsize=8, color="0.35")
    for output in outputs:
        meta = {"Date": None} if output.endswith(".svg") else {"CreationDate": None} if output.endswith(".pdf") else {}
        figure.savefig(output, bbox_inches="tight", metadata=meta, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
