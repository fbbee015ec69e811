#!/usr/bin/env python3
"""Draws the charts of the mass-spring experiments. The experiment's name in the table selects the chart.

usage: springs.py TABLE.csv OUT.svg [OUT.pdf ...]

TABLE.csv is the table that a report stores next to this program. The program needs only matplotlib.
"""
import csv
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Colour-blind readers can distinguish these colours of Okabe and Ito. The markers distinguish the lines in grey print.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7"]
MARKERS = ["o", "s", "^", "D"]
TOPOLOGIES = ["sticks", "prisms", "separable-sticks", "separable-prisms"]
SOLVERS = ["explicit-euler", "semi-implicit-euler", "rk4", "backward-euler"]


def value(row, key):
    return float(row[key]) if row.get(key) else None


def topology(row):
    return row["dynamics.topology"]


def solver(row):
    return row.get("dynamics.solver") or row["variant"]


def present(names, rows, of):
    return [n for n in names if any(of(r) == n for r in rows)]


def style(name, names):
    i = names.index(name)
    return {"color": COLOURS[i], "marker": MARKERS[i], "markersize": 4.5, "linewidth": 1.3}


def panels(count, width=2.9, height=3.2):
    figure, axes = plt.subplots(1, count, figsize=(width * count + 0.8, height), sharey=True, squeeze=False,
                                constrained_layout=True)
    for axis in axes[0]:
        axis.grid(True, which="major", color="0.88", linewidth=0.6)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    return figure, axes[0]


def legend(figure, axes):
    entries = {}
    for axis in axes:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    figure.legend(entries.values(), entries.keys(), loc="lower center",
                  ncol=3 if len(entries) > 4 else 4, frameon=False, bbox_to_anchor=(0.5, -0.13 if len(entries) < 5 else -0.22))


def frames(rows):
    """Returns the rows that have the status "ok" and contain wall times of whole frames."""
    return [r for r in rows if r["phase"] == "frame" and r["clock"] == "wall" and r["status"] == "ok"]


def pooled(rows):
    """Returns one row per case, phase and clock. Its time is the geometric mean of the processes' medians. Its interval contains
    the intervals of all processes."""
    groups = {}
    for r in rows:
        if r["median_ms"]:
            groups.setdefault((r["case"], r["variant"], r["phase"], r["clock"]), []).append(r)
    made = []
    for group in groups.values():
        times = [float(r["median_ms"]) for r in group]
        made.append({**group[0], "median_ms": math.prod(times) ** (1 / len(times)),
                     "low_ms": min(float(r["low_ms"]) for r in group), "high_ms": max(float(r["high_ms"]) for r in group)})
    return made


def update_time(rows):
    rows = pooled(rows)
    models = list(dict.fromkeys(r["model"] for r in sorted(rows, key=lambda r: -len(r["model"]))))
    models = [m for m in ["banisch-elephant", "banisch-dog", "banisch-grass"] if m in models] or models
    figure, axes = panels(len(models))
    simulated = {r["case"]: float(r["median_ms"]) for r in rows if r["phase"] == "simulate" and r["median_ms"]}
    solvers = present(SOLVERS, rows, solver)
    for axis, model in zip(axes, models):
        shown = [r for r in frames(rows) if r["model"] == model]
        for r in shown:
            i, j = TOPOLOGIES.index(topology(r)), solvers.index(solver(r))
            x = i + (j - (len(solvers) - 1) / 2) * 0.38
            whole, part = float(r["median_ms"]), simulated.get(r["case"], 0)
            colour = COLOURS[j]
            axis.bar(x, part, 0.34, color=colour, label=solver(r) + ", simulation")
            axis.bar(x, max(0, whole - part), 0.34, bottom=part, color=colour, alpha=0.35,
                     label=solver(r) + ", the rest of the frame")
            low, high = float(r["low_ms"]), float(r["high_ms"])
            axis.errorbar(x, whole, [[max(0, whole - low)], [max(0, high - whole)]], color="0.3", linewidth=0.8,
                          capsize=2)
            fps = value(r, "metric.paper_fps")
            if fps:
                axis.plot([i - 0.42, i + 0.42], [1000 / fps] * 2, color="0.2", linewidth=1, linestyle="--",
                          label="the paper's text, whole frame")
        axis.set_xticks(range(4), [t.replace("separable-", "separable\n") for t in TOPOLOGIES], fontsize=7.5)
        axis.set_title(model, fontsize=10)
    axes[0].set_ylabel("update time, ms")
    return figure, axes


def work_precision(rows):
    figure, axes = panels(4)
    solvers = present(SOLVERS, rows, solver)
    for axis, name in zip(axes, TOPOLOGIES):
        for s in solvers:
            line = sorted((r for r in frames(rows) if topology(r) == name and solver(r) == s and
                           value(r, "metric.error_rms")), key=lambda r: value(r, "metric.step_ms"))
            x, y = [float(r["median_ms"]) for r in line], [value(r, "metric.error_rms") for r in line]
            axis.plot(x, y, label=s, **style(s, SOLVERS))
            for r, a, b in zip(line, x, y):
                # Labels give the time step of the first and the last point of the line. Only the line of RK4 has
                # labels, because all solvers have the same time steps.
                if s == "rk4" and r in (line[0], line[-1]):
                    axis.annotate(f"{value(r, 'metric.step_ms'):.3g} ms", (a, b), xytext=(4, 4),
                                  textcoords="offset points", fontsize=6.5, color="0.35")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(name, fontsize=10)
        axis.set_xlabel("ms per simulated second")
    axes[0].set_ylabel("rms error after 1 s, of the fur's length")
    return figure, axes


def longest_step(rows):
    figure, axes = panels(4)
    for axis, name in zip(axes, TOPOLOGIES):
        for s in present(SOLVERS, rows, solver):
            line = sorted((float(r["reading"][1:]), value(r, "metric.longest_step_ms")) for r in frames(rows)
                          if topology(r) == name and solver(r) == s)
            axis.plot([a for a, _ in line], [b for _, b in line], label=s, **style(s, SOLVERS))
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(name, fontsize=10)
        axis.set_xlabel("stiffness of the sticks, N/m")
    axes[0].set_ylabel("longest stable step, ms")
    return figure, axes


def energy(rows):
    figure, axes = panels(4)
    mark = "metric.energy_uJ_at_"
    for axis, name in zip(axes, TOPOLOGIES):
        for s in present(SOLVERS, rows, solver):
            for r in frames(rows):
                if topology(r) == name and solver(r) == s:
                    line = sorted((float(k[len(mark):]), float(v)) for k, v in r.items() if k.startswith(mark) and v)
                    axis.plot([a for a, _ in line], [b for _, b in line], label=s, color=style(s, SOLVERS)["color"],
                              linewidth=1.1, linestyle="--" if s == "rk4" else "-")
        axis.set_title(name, fontsize=10)
        axis.set_xlabel("time, s")
        axis.set_yscale("log")
    axes[0].set_ylabel("energy of springs and masses, uJ")
    return figure, axes


def mesh_size(rows):
    solvers = present(SOLVERS, rows, solver)
    figure, axes = panels(len(solvers), width=3.8, height=3.8)
    for axis, s in zip(axes, solvers):
        for name in TOPOLOGIES:
            line = sorted((value(r, "metric.triangles"), float(r["median_ms"])) for r in frames(rows)
                          if topology(r) == name and solver(r) == s)
            axis.plot([a for a, _ in line], [b for _, b in line], label=name, **style(name, TOPOLOGIES))
        axis.axhline(1000 / 60, color="0.3", linewidth=0.9, linestyle="--")
        axis.annotate("a sixtieth of a second", (20, 1000 / 60), xytext=(0, 3), textcoords="offset points", fontsize=7.5,
                      color="0.3")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(s, fontsize=10)
        axis.set_xlabel("triangles")
    axes[0].set_ylabel("simulation of a sixtieth of a second, ms")
    return figure, axes


CHARTS = {"banisch2006-update-time": update_time, "banisch2006-work-precision": work_precision,
          "banisch2006-longest-step": longest_step, "banisch2006-energy": energy, "banisch2006-mesh-size": mesh_size}


def main(table, outputs):
    with open(table, newline="", encoding="utf-8") as file:
        rows = [r for r in csv.DictReader(file) if not r["overrides"]]
    plt.rcParams.update({"font.size": 9, "svg.hashsalt": "pelage", "svg.fonttype": "none", "pdf.fonttype": 42})
    figure, axes = CHARTS[rows[0]["experiment"]](rows)
    legend(figure, axes)
    figure.suptitle(rows[0]["device"], fontsize=9, color="0.35")
    for output in outputs:
        meta = {"Date": None} if output.endswith(".svg") else {"CreationDate": None} if output.endswith(".pdf") else {}
        figure.savefig(output, bbox_inches="tight", metadata=meta, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
