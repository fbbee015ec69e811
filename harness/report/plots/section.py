#!/usr/bin/env python3
"""Draws a section of the fur, or the water over time. The first column of the table selects the drawing
(docs/experiments.md; docs/shells.md, section 10).

TABLE.csv is a table that `pelage diagram` or `pelage water` writes.
"""
import math

import matplotlib.pyplot as plt
import style


def grouped(rows, key):
    """Returns the rows of each value of the column `key`, in the order of the table."""
    groups = {}
    for row in rows:
        groups.setdefault(row[key], []).append(row)
    return groups


def column(rows, key):
    return [row[key] for row in rows]


def plain(axis, x, y, equal=True):
    axis.set_xlabel(x)
    axis.set_ylabel(y)
    style.open_axis(axis, grid=False)
    if equal:
        axis.set_aspect("equal")


def draw_shape(rows):
    figure, axis = plt.subplots(figsize=(3.6, 3.2), constrained_layout=True)
    for i, (w, line) in enumerate(grouped(rows, "w").items()):
        axis.plot(column(line, "f"), column(line, "h"), color=style.COLOURS[i % len(style.COLOURS)], label=f"w = {w:g}")
    plain(axis, "f(h), factor of the displacement", "h, height")
    axis.legend(frameon=False)
    return figure


def draw_clump(rows):
    figure, axis = plt.subplots(figsize=(5.2, 3.2), constrained_layout=True)
    for strand, line in grouped(rows, "strand").items():
        wet = line[0]["inside"] > 0
        colour = "black" if strand == 0 else "#D55E00" if wet else "0.6"
        axis.plot(column(line, "x"), column(line, "y"), color=colour, linewidth=1.6 if strand == 0 else 1.0)
    axis.axhline(0, color="0.3", linewidth=0.8)
    mark_clump(axis, rows)
    plain(axis, "distance from the clump's centre, R", "height over the surface, R")
    return figure


def arrow(axis, start, end, style="->", colour="black"):
    axis.annotate("", end, start, arrowprops={"arrowstyle": style, "color": colour, "shrinkA": 0, "shrinkB": 0})


def mark_clump(axis, rows):
    """Marks, as in the papers, the centre c and the radius r of the clump, and on its outermost strand a point p at the
    height h with its displacement d. The displacement of the tip is rho r."""
    wet = [row for row in rows if row["inside"] > 0]
    outermost = [row for row in wet if row["strand"] == max(row["strand"] for row in wet)]
    root, tip, p = outermost[0], outermost[-1], outermost[len(outermost) // 2]
    axis.plot([root["x"], root["x"]], [root["y"], tip["y"]], color="#D55E00", linewidth=0.8, linestyle="--")
    for at, name in ((tip, r"$\rho r$"), (p, "d")):
        arrow(axis, (root["x"], at["y"]), (at["x"], at["y"]))
        axis.annotate(name, ((at["x"] + root["x"]) / 2, at["y"]), xytext=(0, 3), textcoords="offset points", ha="center")
    axis.plot([p["x"]], [p["y"]], "o", color="black", markersize=3.5)
    axis.annotate("p", (p["x"], p["y"]), xytext=(-8, 2), textcoords="offset points", ha="center")
    right = 1.06 * root["x"]
    arrow(axis, (right, 0), (right, p["y"]), "<->")
    axis.annotate("h", (right, p["y"] / 2), xytext=(3, 0), textcoords="offset points", va="center")
    below = -0.08 * tip["y"]
    axis.set_ylim(bottom=2.2 * below, top=1.12 * tip["y"])
    arrow(axis, (0, below), (root["x"], below), "<->")
    axis.annotate("r", (root["x"] / 2, below), xytext=(0, -11), textcoords="offset points", ha="center")
    axis.annotate("c", (0, 0), xytext=(-7, -10), textcoords="offset points", ha="center")


def draw_curl(rows):
    lines = grouped(rows, "rho")
    figure, axes = plt.subplots(1, len(lines), figsize=(2.3 * len(lines), 3.4), sharex=True, sharey=True, squeeze=False,
                                subplot_kw={"projection": "3d"}, constrained_layout=True)
    reach = max(max(abs(row["x"]), abs(row["y"])) for row in rows) or 1.0
    top = max(row["z"] for row in rows)
    for axis, (rho, line) in zip(axes[0], lines.items()):
        axis.plot([0, 0], [0, 0], [0, top], color="0.6", linewidth=0.8, linestyle="--")
        axis.plot(column(line, "x"), column(line, "y"), column(line, "z"), color=style.COLOURS[0])
        axis.set_title(f"wetness {rho:g}", fontsize=10)
        axis.set_xlim(-reach, reach)
        axis.set_ylim(-reach, reach)
        axis.set_zlim(0, top)
        axis.set_box_aspect((2 * reach, 2 * reach, top))
        axis.set_xticks([])
        axis.set_yticks([])
        axis.set_zticks([])
        axis.view_init(elev=18)
    return figure


def draw_layers(rows):
    figure, axis = plt.subplots(figsize=(6.0, 3.6), constrained_layout=True)
    for layer, of_layer in grouped(rows, "layer").items():
        base = layer < 0
        for line in grouped(of_layer, "segment").values():
            axis.plot(column(line, "x"), column(line, "y"), color="black" if base else style.COLOURS[0],
                      linewidth=1.6 if base else 0.8, solid_capstyle="round")
    for line in grouped(rows, "segment").values():
        strand = [row for row in line if row["end"] == 0]
        axis.plot(column(strand, "x"), column(strand, "y"), color=style.COLOURS[1], linewidth=1.2)
        axis.plot(column(strand, "x"), column(strand, "y"), "o", color="#D00000", markersize=2.5)
    mark_displacement(axis, rows)
    plain(axis, "x, R", "y, R")
    return figure


def mark_displacement(axis, rows):
    """Draws a red arrow over the layers: the mean displacement of the tips from their roots along x, if there is one."""
    strands = [[row for row in line if row["end"] == 0] for line in grouped(rows, "segment").values()]
    shift = sum(strand[-1]["x"] - strand[0]["x"] for strand in strands) / len(strands)
    top, bottom = max(row["y"] for row in rows), min(row["y"] for row in rows)
    if abs(shift) < 0.02 * (top - bottom):
        return
    middle, above = sum(row["x"] for row in rows) / len(rows), top + 0.12 * (top - bottom)
    arrow(axis, (middle - shift / 2, above), (middle + shift / 2, above), colour="#D00000")
    axis.set_ylim(top=above + 0.08 * (top - bottom))


def draw_path(rows):
    """Draws the path of a tip, with lines from the root to places that are not near each other and the times at which the
    tip first was there, and the tip's distance from its position at rest."""
    figure, (path, time) = plt.subplots(1, 2, figsize=(7.2, 3.0), constrained_layout=True)
    path.plot(column(rows, "x"), column(rows, "y"), color=style.COLOURS[0], linewidth=1.0)
    reach, shown = 0.2 * max(math.hypot(row["x"], row["y"]) for row in rows), []
    for row in rows:
        if any(math.hypot(row["x"] - other["x"], row["y"] - other["y"]) < reach for other in shown):
            continue
        shown.append(row)
        path.plot([0, row["x"]], [0, row["y"]], color="0.7", linewidth=0.8)
        path.annotate(f"{row['t']:.3g} s", (row["x"], row["y"]), xytext=(2, 2), textcoords="offset points", fontsize=7)
    path.plot([rows[0]["rest_x"]], [rows[0]["rest_y"]], "o", color="#D00000", markersize=4, label="at rest")
    path.legend(frameon=False)
    plain(path, "x, R", "y, R")
    time.plot(column(rows, "t"), column(rows, "apart"), color=style.COLOURS[0])
    time.axhline(0.02, color="#D00000", linewidth=0.8, linestyle="--", label="2% of the length")
    time.legend(frameon=False)
    plain(time, "time, s", "distance from rest, lengths", equal=False)
    time.set_ylim(bottom=0)
    return figure


def draw_water(rows):
    figure, axis = plt.subplots(figsize=(4.8, 3.2), constrained_layout=True)
    parts = ["unsoaked", "held", "evaporated", "dripped"]
    axis.stackplot(column(rows, "time_s"), [column(rows, part) for part in parts], labels=parts,
                   colors=["#56B4E9", style.COLOURS[0], "#F0E442", style.COLOURS[1]])
    axis.plot(column(rows, "time_s"), column(rows, "fell"), color="black", linewidth=1.2, label="fell")
    plain(axis, "time, s", "water, R$^2$", equal=False)
    axis.set_xlim(rows[0]["time_s"], rows[-1]["time_s"])
    axis.set_ylim(bottom=0)
    handles, labels = axis.get_legend_handles_labels()
    axis.legend(handles[::-1], labels[::-1], frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


DRAWN = {"time_s": draw_water, "w": draw_shape, "strand": draw_clump, "rho": draw_curl, "segment": draw_layers,
         "t": draw_path}


def main(rows, table, outputs):
    rows = [{key: float(value) for key, value in row.items()} for row in rows]
    return DRAWN[next(iter(rows[0]))](rows)


if __name__ == "__main__":
    style.run(main, __doc__)
