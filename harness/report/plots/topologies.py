#!/usr/bin/env python3
"""Draws the simulation and frame times of each mass-spring topology against the number of triangles (log-log).

usage: topologies.py TABLE.csv OUT.svg [OUT.pdf ...]

TABLE.csv is the table that a report stores next to this program. The program needs only matplotlib.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Colour-blind readers can distinguish these colours of Okabe and Ito. The markers distinguish the lines in grey print.
COLOURS = ["#000000", "#0072B2", "#D55E00", "#56B4E9", "#E69F00"]
MARKERS = ["o", "s", "^", "D", "v"]


def leading(text):
    digits = "".join(c if c.isdigit() else " " for c in text).split()
    return int(digits[0]) if digits else 0


def main(table, outputs):
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    topologies = list(dict.fromkeys(r["topology"] for r in rows))
    panels = sorted({(r["layers"], r["size"]) for r in rows}, key=lambda p: (leading(p[0]), leading(p[1])))

    plt.rcParams.update({"font.size": 9, "svg.hashsalt": "pelage", "svg.fonttype": "none", "pdf.fonttype": 42})
    width = max(1, len(panels))
    figure, axes = plt.subplots(2, width, figsize=(2.6 * width + 1.4, 5.6), sharex=True, sharey="row", squeeze=False,
                                constrained_layout=True)
    drawn = {}
    for column, (layers, size) in enumerate(panels):
        for i, topology in enumerate(topologies):
            cell = sorted((r for r in rows if (r["layers"], r["size"], r["topology"]) == (layers, size, topology)
                           and r["median_ms"]), key=lambda r: float(r["triangles"]))
            for line, key in enumerate(["median_ms", "simulate_ms"]):
                have = [r for r in cell if r[key]]
                if have:
                    drawn[topology], = axes[line][column].plot(
                        [float(r["triangles"]) for r in have], [float(r[key]) for r in have], color=COLOURS[i % 5],
                        marker=MARKERS[i % 5], markersize=4.5, linewidth=1.2)
        axes[0][column].set_title(f"{layers} layers, {size.replace('x', ' × ')}", fontsize=9)
        axes[1][column].set_xlabel("triangles")
        for axis in axes[:, column]:
            axis.set_xscale("log")
            axis.set_yscale("log")
            axis.grid(True, which="major", color="0.85", linewidth=0.6)
            axis.grid(True, which="minor", color="0.93", linewidth=0.4)
            for side in ("top", "right"):
                axis.spines[side].set_visible(False)
    axes[0][0].set_ylabel("frame, ms")
    axes[1][0].set_ylabel("simulation, ms")
    if drawn:
        figure.legend(drawn.values(), drawn.keys(), loc="lower center",
                      ncol=len(drawn), frameon=False, bbox_to_anchor=(0.5, -0.06))
    if rows and rows[0]["device"]:
        figure.suptitle(rows[0]["device"], fontsize=9, color="0.35")
    for output in outputs:
        meta = {"Date": None} if output.endswith(".svg") else {"CreationDate": None} if output.endswith(".pdf") else {}
        figure.savefig(output, bbox_inches="tight", metadata=meta, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
