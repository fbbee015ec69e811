#!/usr/bin/env python3
"""Draws the share of each phase in the time of a frame. TABLE.csv is the table that `pelage profile` writes."""
import matplotlib.pyplot as plt
import style

# In grey print, hatchings distinguish the phases.
PHASES = ["simulate", "transform", "shadow", "skin", "keys", "sort", "bin", "raster"]
HATCHES = ["", "///", "\\\\\\", "+++", "---", "|||", "...", ""]
FILLS = {"simulate": "#009E73", "transform": "#56B4E9", "shadow": "#CC79A7", "skin": "#D55E00", "keys": "#0072B2",
         "sort": "#F0E442", "bin": "#E69F00", "raster": "#B8B8B8", "between": "white"}


def main(rows, table, outputs):
    cases = list(dict.fromkeys(r["case"] for r in rows))
    figure, bars = plt.subplots(figsize=(5, 3.9), constrained_layout=True)
    figure.suptitle(rows[0]["device"], fontsize=9, color="0.35")
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
    style.open_axis(bars, grid=False)
    return figure


if __name__ == "__main__":
    style.run(main, __doc__)
