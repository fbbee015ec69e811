#!/usr/bin/env python3
"""Draws the time of each kernel of a frame, and a roofline plot from the device's measured peak rates.

usage: roofline.py TABLE.csv OUT.svg [OUT.pdf ...]

TABLE.csv is the table that a report stores next to this program. The program needs only matplotlib.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.transforms import Bbox  # noqa: E402

# Colour-blind readers can distinguish these colours of Okabe and Ito. In grey print, markers distinguish the cases, and
# hatchings distinguish the phases.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
MARKERS = ["o", "s", "^", "D", "v", "P"]
PHASES = ["simulate", "transform", "shadow", "skin", "keys", "sort", "bin", "raster"]
HATCHES = ["", "///", "\\\\\\", "+++", "---", "|||", "...", ""]
FILLS = {"simulate": "#009E73", "transform": "#56B4E9", "shadow": "#CC79A7", "skin": "#D55E00", "keys": "#0072B2",
         "sort": "#F0E442", "bin": "#E69F00", "raster": "#B8B8B8", "between": "white"}


def name_kernels(figure, roof, rows, line):
    """Writes the name of each kernel next to one of its points: below the lowest point, or at another place where the name
    covers neither a point nor another name nor the roofline. line: two points of its sloping part."""
    figure.canvas.draw()
    place = lambda r: (float(r["operations_per_byte"]), float(r["gflop_s"]))
    taken = [Bbox.from_bounds(x - 4, y - 4, 8, 8) for x, y in (roof.transData.transform(place(r)) for r in rows)]
    (x0, y0), (x1, y1) = (roof.transData.transform(point) for point in line)
    taken += [Bbox.from_bounds(x0 + k / 50 * (x1 - x0) - 1, y0 + k / 50 * (y1 - y0) - 1, 2, 2) for k in range(51)]
    for kernel in sorted({r["kernel"] for r in rows}):
        own = sorted((place(r) for r in rows if r["kernel"] == kernel), key=lambda p: p[1])
        tries = [(own[0], (0, -13), "center"), (own[-1], (0, 6), "center"), (own[0], (7, -3), "left"), (own[0], (-7, -3), "right"),
                 (own[-1], (7, -3), "left"), (own[-1], (-7, -3), "right"), (own[0], (0, -24), "center"), (own[0], (0, -35), "center"), (own[0], (0, -46), "center"),
                 (own[-1], (0, 17), "center")]
        for last, (point, offset, side) in zip([False] * (len(tries) - 1) + [True], tries):
            name = roof.annotate(kernel, point, xytext=offset, textcoords="offset points", fontsize=8, ha=side, color="0.25")
            box = name.get_window_extent()
            if last or not any(box.overlaps(other) for other in taken):
                taken.append(box)
                break
            name.remove()


def main(table, outputs):
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    phases_of = {kernel: {r["phase"] for r in rows if r["kernel"] == kernel} for kernel in {r["kernel"] for r in rows}}
    for r in rows:
        if len(phases_of[r["kernel"]]) > 1:
            r["kernel"] = f'{r["kernel"]}, {r["phase"]}'
    cases = list(dict.fromkeys(r["case"] for r in rows))
    bandwidth, peak = float(rows[0]["peak_gb_s"]), float(rows[0]["peak_gflop_s"])

    plt.rcParams.update({"font.size": 9, "svg.hashsalt": "pelage", "svg.fonttype": "none", "pdf.fonttype": 42,
                         "hatch.linewidth": 0.5})
    figure, (bars, roof) = plt.subplots(1, 2, figsize=(9.6, 3.9), constrained_layout=True,
                                        gridspec_kw={"width_ratios": [1, 1.25]})

    for y, case in enumerate(cases):
        mine = [r for r in rows if r["case"] == case]
        whole, left = float(mine[0]["frame_ms"]), 0.0
        phases = [phase for phase in PHASES if any(r["phase"] == phase for r in rows)]
        phases += sorted({r["phase"] for r in rows} - set(PHASES))
        for phase in phases:
            share = 100 * sum(float(r["ms"]) for r in mine if r["phase"] == phase) / whole
            bars.barh(y, share, left=left, color=FILLS.get(phase, "#CC79A7"), edgecolor="0.25", linewidth=0.5,
                      hatch=HATCHES[PHASES.index(phase)] if phase in PHASES else "xx",
                      label=phase if y == 0 else None)
            if share > 6:
                bars.text(left + share / 2, y, f"{share:.0f}%", ha="center", va="center", fontsize=8,
                          bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.75})
            left += share
        bars.barh(y, max(0, 100 - left), left=left, color="white", edgecolor="0.25", linewidth=0.5,
                  label="between kernels" if y == 0 else None)
    bars.set_yticks(range(len(cases)), [f"{c}\n{float(next(r for r in rows if r['case'] == c)['frame_ms']):.1f} ms"
                                        for c in cases])
    bars.invert_yaxis()
    bars.set_xlim(0, 100)
    bars.set_xlabel("share of the frame's time, %")
    bars.legend(loc="upper center", bbox_to_anchor=(0.42, 1.16), ncol=5, frameon=False, fontsize=8, handlelength=1.2,
                columnspacing=0.9, handletextpad=0.4)

    counted = [r for r in rows if float(r["operations"]) > 0 and float(r["ms"]) > 0]
    x = [float(r["operations_per_byte"]) for r in counted]
    y = [float(r["gflop_s"]) for r in counted]
    low, high = min(x + [peak / bandwidth]) / 4, max(x + [peak / bandwidth]) * 4
    ridge = peak / bandwidth
    roof.plot([low, ridge, high], [low * bandwidth, peak, peak], color="0.15", linewidth=1.6)
    roof.annotate(f"{peak:.0f} GFLOP/s, fma", (high, peak), xytext=(-3, 4), textcoords="offset points", ha="right",
                  va="bottom", fontsize=8)
    floor = min(y + [low * bandwidth]) / 3
    for i, case in enumerate(cases):
        for r in (r for r in counted if r["case"] == case):
            roof.plot(float(r["operations_per_byte"]), float(r["gflop_s"]), marker=MARKERS[i % 6],
                      color=COLOURS[i % 6], markersize=6, markeredgecolor="white", markeredgewidth=0.6,
                      linestyle="none", zorder=3)
    roof.set_xscale("log")
    roof.set_yscale("log")
    roof.set_xlim(low / 1.5, high)
    roof.set_ylim(floor, peak * 2.5)
    name_kernels(figure, roof, counted, [(low, low * bandwidth), (ridge, peak)])
    # The label is parallel to the bandwidth line. The angle of this line depends on the axis limits and the shape of
    # the panel.
    figure.canvas.draw()
    a = roof.transData.transform((low, low * bandwidth))
    b = roof.transData.transform((ridge, peak))
    from math import atan2, degrees
    roof.annotate(f"{bandwidth:.0f} GB/s, triad", ((low * ridge) ** 0.5, (low * bandwidth * peak) ** 0.5), xytext=(-7, 6),
                  textcoords="offset points", rotation=degrees(atan2(b[1] - a[1], b[0] - a[0])), rotation_mode="anchor",
                  ha="center", va="bottom", fontsize=8)
    roof.set_xlabel("floating-point operations per byte of buffers")
    roof.set_ylabel("GFLOP/s")
    roof.grid(True, which="major", color="0.88", linewidth=0.6)
    for axis in (bars, roof):
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    roof.legend([Line2D([], [], marker=MARKERS[i % 6], color=COLOURS[i % 6], linestyle="none", markersize=6)
                 for i in range(len(cases))], cases, frameon=False, fontsize=8, loc="upper center",
                bbox_to_anchor=(0.5, -0.16), ncol=2)
    figure.suptitle(rows[0]["device"], fontsize=9, color="0.35")
    for output in outputs:
        meta = {"Date": None} if output.endswith(".svg") else {"CreationDate": None} if output.endswith(".pdf") else {}
        figure.savefig(output, bbox_inches="tight", metadata=meta, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
