#!/usr/bin/env python3
"""Draws the frame time against layers, pixels and triangles. Fits a model to some cases and tests it on the others.

TABLE.csv is the table that a report stores next to this program. The program writes the fit next to the first output,
as a .txt file.
The model is this sum of costs with coefficients that are not negative:

    ms = a + b * triangles + c * triangles * layers + d * pixels + e * pixels * layers

The fit minimizes the squared relative errors. The intervals of the coefficients are percentiles over 1000 resamplings
of the cases. A case is larger if it has more than 64 layers, more pixels than 1680 x 1050, or more than a million
triangles. All other cases are smaller. The fit uses two thirds of the smaller cases. The remaining smaller cases and
all larger cases test the fit. Every number of triangles, every number of layers and every picture size of the smaller
cases occurs both in the fit and in the test. The program needs only matplotlib and numpy.
"""
import os
import sys

import matplotlib.pyplot as plt
import style
import numpy as np  # noqa: E402

COLOURS = {"pixels": ["#0072B2", "#D55E00", "#009E73", "#CC79A7"], "layers": ["#56B4E9", "#E69F00", "#882255", "#000000"]}
MARKERS = ["o", "^"]  # markers of the cases with the fewest and the most triangles
TERMS = [("frame", "ms", 1), ("triangle", "ns", 1e6), ("triangle and layer", "ns", 1e6), ("pixel", "ns", 1e6),
         ("pixel and layer", "ns", 1e6)]


def features(case):
    t, n, p = case["triangles"], case["layers"], case["pixels"]
    return np.array([1.0, t, t * n, p, p * n])


def fitted(cases):
    """Returns the fitted coefficients. Terms are removed, the most negative first, until no coefficient is negative.

    For this comparison, each coefficient is multiplied by the largest quotient of its term and the frame time.
    """
    rows = np.array([features(c) / c["ms"] for c in cases])
    kept = list(range(len(TERMS)))
    while kept:
        scale = np.abs(rows[:, kept]).max(axis=0)
        solution = np.linalg.lstsq(rows[:, kept] / scale, np.ones(len(cases)), rcond=None)[0] / scale
        if (solution >= 0).all():
            break
        kept.remove(kept[int(np.argmin(solution * scale))])
    result = np.zeros(len(TERMS))
    if kept:
        result[kept] = solution
    return result


def beyond(case):
    return case["layers"] > 64 or case["pixels"] > 1680 * 1050 or case["triangles"] > 1e6


def cases_of(rows):
    rows = [r for r in rows if r["median_ms"]]
    cases = [{"name": r["case"], "device": r["device"], "triangles": float(r["triangles"]), "layers": float(r["layers"]),
              "pixels": float(r["width"]) * float(r["height"]), "ms": float(r["median_ms"]),
              "low": float(r["median_ms_low"]), "high": float(r["median_ms_high"])} for r in rows]
    cases.sort(key=lambda c: c["name"])
    inside = [c for c in cases if not beyond(c)]
    axes = {key: sorted({c[key] for c in inside}) for key in ("triangles", "layers", "pixels")}
    for c in inside:
        c["use"] = "held out" if sum(values.index(c[key]) for key, values in axes.items()) % 3 == 2 else "fit"
    for c in cases:
        c.setdefault("use", "beyond")
    return cases


def report(cases, fit, samples):
    used = [c for c in cases if c["use"] == "fit"]
    lines = [f"{cases[0]['device']}: time of a frame, fitted to {len(used)} cases",
             "ms = frame + triangle T + triangle and layer T N + pixel P + pixel and layer P N, none negative"]
    low, high = np.percentile(samples, [2.5, 97.5], axis=0)
    for i, (name, unit, scale) in enumerate(TERMS):
        lines.append(f"  per {name:<20} {fit[i] * scale:10.3f} {unit}  (95%: {low[i] * scale:.3f} to {high[i] * scale:.3f})")
    for use, words in (("fit", "fitted"), ("held out", "held out"), ("beyond", "beyond the fit")):
        mine = [c for c in cases if c["use"] == use]
        if not mine:
            continue
        errors = np.array([features(c) @ fit / c["ms"] - 1 for c in mine])
        lines.append(f"{len(mine)} cases {words}: predicted / measured - 1 is {100 * np.median(np.abs(errors)):.0f}% in the "
                     f"middle, {100 * errors.min():+.0f}% to {100 * errors.max():+.0f}%")
    for c in cases:
        if c["use"] != "fit":
            band = np.percentile(samples @ features(c), [2.5, 97.5])
            lines.append(f"  {c['name']:<34} {c['ms']:9.1f} ms measured, {features(c) @ fit:9.1f} predicted "
                         f"({band[0]:.1f} to {band[1]:.1f}), {c['use']}")
    return "\n".join(lines) + "\n"


def amount(key, value):
    if key == "triangles":
        return f"{value / 1e3:.0f}k triangles" if value < 1e6 else f"{value / 1e6:.1f}M triangles"
    return f"{value / 1e6:.2g} Mpixel" if key == "pixels" else f"{value:.0f} layers"


def panel(axis, cases, fit, x, by, every):
    """Draws a panel with the abscissa x: colours by the quantity `by`, markers by the number of triangles."""
    values = sorted({c[by] for c in every})
    triangles = sorted({c["triangles"] for c in cases}) if x != "triangles" else []
    for value in values:
        colour = COLOURS[by][values.index(value) % len(COLOURS[by])]
        drawn = False
        for t in triangles or [None]:
            marker = MARKERS[triangles.index(t) % 2] if triangles else "s"
            mine = sorted((c for c in cases if c[by] == value and t in (None, c["triangles"])), key=lambda c: c[x])
            if len({c[x] for c in mine}) < 2:
                continue
            drawn = True
            grid = np.geomspace(mine[0][x], mine[-1][x], 60)
            axis.plot(grid, [features({**mine[0], x: g}) @ fit for g in grid], color=colour, linewidth=1)
            for c in mine:
                bar = axis.errorbar(c[x], c["ms"], yerr=[[max(0, c["ms"] - c["low"])], [max(0, c["high"] - c["ms"])]],
                                    color=colour, marker=marker, markersize=5, capsize=2, linestyle="none",
                                    markerfacecolor=colour if c["use"] == "fit" else "white")
                style.tell(bar[0], [f"{c['name']}: {c['ms']:.4g} ms [{c['low']:.4g}, {c['high']:.4g}]"])
        if drawn:
            axis.plot([], [], color=colour, label=amount(by, value))
    for t in triangles:
        axis.plot([], [], color="0.35", marker=MARKERS[triangles.index(t) % 2], markersize=5, linestyle="none",
                  label=amount("triangles", t))
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel(x if x != "triangles" else "triangles, 16 layers")
    axis.legend(frameon=False, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.18), ncol=2)
    style.open_axis(axis)


def main(rows, table, outputs):
    cases = cases_of(rows)
    used = [c for c in cases if c["use"] == "fit"]
    if len(used) < 2 * len(TERMS):
        sys.exit(f"{len(used)} cases are too few for a fit of {len(TERMS)} terms")
    fit = fitted(used)
    random = np.random.default_rng(1)
    samples = np.array([fitted([used[i] for i in random.integers(len(used), size=len(used))]) for _ in range(1000)])
    with open(os.path.splitext(outputs[0])[0] + ".txt", "w", encoding="utf-8") as file:
        file.write(report(cases, fit, samples))

    figure, axes = plt.subplots(1, 3, figsize=(10.2, 4.3), sharey=True, constrained_layout=True)
    several = [c for c in cases if c["layers"] > 16] or cases
    fewest, most = min(c["triangles"] for c in several), max(c["triangles"] for c in several)
    ends = [c for c in cases if c["triangles"] in (fewest, most)]
    panel(axes[0], [c for c in ends if c["pixels"] in (480000, 1764000)], fit, "layers", "pixels", cases)
    panel(axes[1], ends, fit, "pixels", "layers", cases)
    panel(axes[2], [c for c in cases if c["layers"] == 16], fit, "triangles", "pixels", cases)
    layers = sorted({int(c["layers"]) for c in cases})
    axes[0].set_xticks(layers, [str(n) for n in layers])
    axes[0].minorticks_off()
    axes[0].set_ylabel("frame time, ms")
    figure.suptitle(f"{cases[0]['device']}; lines: the fit; filled: fitted, open: left out of it", fontsize=9, color="0.35")
    return figure


if __name__ == "__main__":
    style.run(main, __doc__)
