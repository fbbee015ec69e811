#!/usr/bin/env python3
"""Writes the tables that documents show of the recorded results, from the CSV files in results/tables.

  scripts/recorded_tables.py           writes results/README.md and the frame rates in README.md
  scripts/recorded_tables.py --check   writes nothing; prints what differs and fails if anything does. The test
                                       house.Figures runs this command.
"""
import csv
import json
import math
import re
import statistics
import sys
import tomllib
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "results/README.md"
README = ROOT / "README.md"
BEGIN, END = "<!-- frame rates begin: scripts/recorded_tables.py writes them -->\n", "<!-- frame rates end -->\n"
MODELS = ("torus", "bunny", "elephant", "lion")  # in README.md
SCENES = [(model, layers) for model in ("torus", "bunny", "lion") for layers in (16, 64)]
TOPOLOGIES = ("sticks", "prisms", "separable-sticks", "separable-prisms")
SOLVERS = ("explicit-euler", "semi-implicit-euler", "rk4", "backward-euler")
# The baselines of the mass-spring solvers: a column, and whether the column contains a baseline of this name.
BASELINES = {
    "serial, -O3": lambda name: name == "serial-o3",
    "serial, fast": lambda name: name == "serial-fast",
    "two threads, fast": lambda name: name == "parallel-fast-2",
    "serial, -O3, double": lambda name: name == "serial-o3-double",
    "serial, fast, double": lambda name: name == "serial-fast-double",
    "Eigen": lambda name: name.startswith("eigen") and name.endswith("-1"),
    "Eigen, two threads": lambda name: name.startswith("eigen") and name.endswith("-2"),
}


def table(name):
    """Returns the rows of a CSV file whose status is ok, with numbers where a cell is a number."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with (ROOT / "results/tables" / name).open(newline="", encoding="utf-8") as file:
        rows = [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]
    return [row for row in rows if row.get("status", "ok") == "ok"]


def either(*names):
    """Returns the rows of the first of these CSV files that exists: an experiment may be recorded on the second machine."""
    return table(next(name for name in names if (ROOT / "results/tables" / name).exists()))


def decibels(psnr, digits):
    return "equal" if math.isinf(psnr) else f"{psnr:.{digits}f}"


def mean(values):
    """Returns the geometric mean."""
    return math.exp(statistics.fmean(map(math.log, values)))


def by(rows, *keys):
    """Returns a dictionary from the values of `keys` to the rows with these values."""
    groups = defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in keys)].append(row)
    return groups


def span(values, form):
    """Returns the smallest and the largest value as text."""
    values = list(values)
    form = form if callable(form) else lambda value, form=form: format(value, form)
    least, most = form(min(values)), form(max(values))
    return least if least == most else f"{least} to {most}"


def interval(row, name):
    return f"{row[name]:.2f} [{row[name + '_low']:.2f}, {row[name + '_high']:.2f}]"


def markdown(columns, rows):
    lines = [columns, ["---"] * len(columns), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def three(value):
    """Returns a number with three significant digits, without an exponent."""
    return f"{value:#.3g}".rstrip(".") if value < 999.5 else f"{value:.0f}"


def published(row):
    sign = row["paper_relation"].strip("'=")
    return f"{sign} {row['paper_fps']:.0f}".strip()


def cells(name):
    """Yields the cells of a Table 1: the row of the reading `paper` and that of the reading `pelage`."""
    ours = by(table(f"{name}-pelage.csv"), "model", "layers", "size")
    for key, [printed] in by(table(f"{name}.csv"), "model", "layers", "size").items():
        yield printed, ours[key][0]


def table1():
    separate = next(row for row in table("effects/readings.csv")
                    if (row["switch"], row["with"]) == ("binding", "default"))
    own_strands = (" Both draw the mean strand of the triangles around a vertex. A strand for each triangle, as the paper has "
                   f"it, takes {separate['frame_over_baseline']:.2f} times as long (reading `pelage`, section \"Readings\").")
    for title, name, paper in (
            ("Table 1 of Curling and Clumping Fur", "table1/silva2010-table1", "*Curling and Clumping Fur*"),
            ("Table 1 of Real-Time Rendering of Wet Fur", "wet/wetfur2010-table1", "*Real-Time Rendering of Wet Fur*")):
        found = list(cells(name))
        yield title, (
            f"The columns \"paper\" are the numbers that {paper} prints, for a GeForce 8800 GTS. The others are our "
            "kernels' in the readings `paper` and `pelage`: frames per second, wall time and processor time of a frame."
            + (own_strands if "Curling" in title else "")
        ), markdown(
            ["model", "triangles", "layers", "size", "paper, fps", "reading `paper`, fps", "reading `pelage`, fps",
             "`paper`, ms", "`paper`, processor ms", "`pelage`, ms", "`pelage`, processor ms"],
            [[printed["model"], f"{printed['triangles']:.0f}", f"{printed['layers']:.0f}", printed["size"], published(printed),
              three(printed["fps"]), three(ours["fps"]), *(three(row[key]) for row in (printed, ours) for key in ("median_ms", "cpu_ms"))]
             for printed, ours in found])
        yield None, (
            f"A frame of the reading `pelage` takes {mean(ours['median_ms'] / printed['median_ms'] for printed, ours in found):.2f} "
            f"times as long as a frame of the reading `paper` (geometric mean of the {len(found)} cells, "
            f"{span((ours['median_ms'] / printed['median_ms'] for printed, ours in found), '.2f')})."), ""


def processor(row):
    """Returns the processor that recorded the row, without PoCL's name for its instructions and the maker's marks."""
    return row["device"].rsplit("-", 1)[1].replace("(R)", "").replace(" Processor", "").strip()


def ratio_row(label, rows):
    rows = sorted(rows, key=lambda row: row["opengl_ratio"])

    def cell(row):
        units = {"layers": "{:.0f} layers", "count": "{:.0f} strands", "distance": "{}"}
        places = [unit.format(row[key]) for key, unit in units.items() if row.get(key, "") != ""]
        return f"{row['opengl_ratio']:.1f} ({', '.join([row['model'], *places, row['size']])})"
    return [label, processor(rows[0]), len(rows), f"{mean(row['opengl_ratio'] for row in rows):.2f}", cell(rows[0]), cell(rows[-1])]


def opengl():
    hidden, strongest = "without AVX-512", "strongest variant of the baseline"
    rows, intervals = [], []
    for label, name in (
            ("Table 1", "rivals/rivals"), (f"Table 1, {strongest}", "rivals/rivals-strongest"),
            ("Table 1", "xeon/rivals"), (f"Table 1, {strongest}", "xeon/rivals-strongest"),
            (f"Table 1, {hidden}", "rivals-avx2/rivals"), (f"Table 1, {hidden}, {strongest}", "rivals-avx2/rivals-strongest")):
        if not (ROOT / f"results/tables/{name}-ratio.csv").exists():
            continue
        found = table(f"{name}-ratio.csv")    # rows that were recorded before the readings existed are of the reading `pelage`
        rows.append((label + ("" if found[0].get("reading") == "paper" else ", reading `pelage`"), found))
        interval_of = re.search(r"over 32 of 32 cells \(95% interval ([\d.]+) to ([\d.]+) over (\d+) separate runs\)",
                                (ROOT / f"results/tables/{name}-ratio.txt").read_text(encoding="utf-8"))
        if interval_of:
            intervals.append(f"{label} on the {processor(found[0])}: {interval_of[1]} to {interval_of[2]} ({interval_of[3]} processes)")
    tori = by(table("rivals/rivals-tori-ratio.csv"), "reading", "effects")
    rows += [("two tori, curls and clumps", tori["paper", "all"]), ("two tori, plain shells", tori["paper", "none"]),
             ("two tori, curls and clumps, reading `pelage`", tori["pelage", "all"]),
             ("two tori, plain shells, reading `pelage`", tori["pelage", "none"]),
             ("strands", table("strands/demoreuille2011-scaling-ratio.csv")),
             ("a monster, all of D's pipeline", [row for row in either("strands/demoreuille2011-full-ratio.csv",
                                                                   "xeon/demoreuille2011-full-ratio.csv")
                                                  if row["opengl_ratio"] != ""])]
    yield "OpenGL baseline", (
        "Frame time of the OpenGL baseline (llvmpipe on the same processor) / frame time of our kernels "
        "(`docs/baselines.md`), in the reading `paper` unless a line names another."), markdown(
        ["scene", "processor", "cells", "geometric mean", "lowest ratio", "highest ratio"], [ratio_row(*row) for row in rows])
    yield None, f"95% intervals of the means: {'; '.join(intervals)}. One process recorded each of the other lines of Table 1.", ""
    yield None, "Geometric mean of the ratio by model (first line):", markdown(["model", "ratio"], [
        [model, f"{mean(row['opengl_ratio'] for row in some):.1f}"]
        for (model,), some in by(rows[0][1], "model").items()])


def options():
    [file] = (ROOT / "results/rival-options").glob("*.jsonl")
    psnr = {}
    for row in map(json.loads, file.read_text(encoding="utf-8").splitlines()):
        for check in row["check"]:
            if check["metric"] == "psnr":
                psnr[row["variant"], row["axes"]["layers"]] = f"{check['value']:.0f}"
    times = {name: f"{some[0]['by_fastest']:.2f}" + (f" ({some[0]['layers']:.0f} layers only)" if len(some) == 1 else "")
             for (name,), some in by(table("rivals/rival-options.csv"), "variant").items()}
    # The rows also hold variants that pelage can no longer draw.
    names = tomllib.loads((ROOT / "experiments/rival-options.toml").read_text(encoding="utf-8"))["axes"]["variant"]
    names.sort(key=lambda name: (times.get(name, "9"), name))
    yield "Variants of the OpenGL baseline", (
        "Time: frame time / frame time of the fastest variant that is ok. 16 and 64 layers: PSNR (dB) against the "
        "reference (experiment rival-options)."), markdown(
        ["variant", "time", "16 layers", "64 layers"],
        [[name, times.get(name, "picture differs"), psnr.get((name, 16), ""), psnr.get((name, 64), "")] for name in names])


def wall_ratios(row, fits):
    return [value for key, value in row.items() if key.endswith("_ratio") and not key.endswith("_processor_ratio")
            and value != "" and fits(key.removesuffix("_ratio"))]


def springs():
    rows = table("topology/topology-steps.csv")
    lines = []
    for (model,), some in by(rows, "model").items():
        cells = [[ratio for row in some for ratio in wall_ratios(row, fits)] for fits in BASELINES.values()]
        lines.append([f"{model}, all", "all"] + [span(found, three) if found else "" for found in cells])
    for row in sorted((row for row in rows if row["model"] == "bunny"), key=lambda row: SOLVERS.index(row["variant"])):
        cells = [wall_ratios(row, fits) for fits in BASELINES.values()]
        lines.append([f"bunny, {row['dynamics.topology']}", f"{row['variant']}, {row['substeps']:.0f} steps"]
                     + [three(min(found)) if found else "" for found in cells])
    yield "Mass-spring baselines", (
        "Time of a baseline / time of our kernels for the time steps of one frame (experiment topology-steps). Of "
        "Eigen's solvers the fastest counts."), markdown(
        ["model, topology", "solver", *BASELINES], lines)


def networks():
    cells = by(table("topology/topology-table1.csv"), "dynamics.topology")
    silva = {(row["model"], row["layers"], row["size"]): row["median_ms"] for row in cells["silva",]}
    steps = by(table("topology/banisch2006-longest-step.csv"), "dynamics.topology", "dynamics.solver", "reading")
    yield "Mass-spring topologies", (
        "The 32 cells of Table 1 (experiment topology-table1). Last four columns: longest stable time step in ms "
        "(experiment banisch2006-longest-step)."), markdown(
        ["topology", "simulation (ms)", "largest share of the frame", "frame time / frame with S's strands",
         *(f"{solver}, {reading[1:]} N/m" for solver in ("explicit-euler", "backward-euler") for reading in ("k10", "k1000"))],
        [[kind, span((row["simulate_ms"] for row in rows), ".2f"),
          f"{100 * max(row['simulate_ms'] / row['median_ms'] for row in rows):.1f}%",
          f"{mean(row['median_ms'] / silva[row['model'], row['layers'], row['size']] for row in rows):.2f}",
          *(span((row["longest_step_ms"] for row in steps.get((kind, solver, reading), [])), three)
            if (kind, solver, reading) in steps else ""
            for solver in ("explicit-euler", "backward-euler") for reading in ("k10", "k1000"))]
         for (kind,), rows in cells.items()])
    yield "Solvers at equal error", (
        "Time / time of semi-implicit Euler, by topology and permitted rms error in fur lengths (experiment "
        "topology-equal-error)."), markdown(
        ["topology", "error", "explicit-euler", "rk4", "backward-euler"],
        [[row["dynamics.topology"], f"{row['dynamics.tolerance']:g}",
          *(interval(row, solver + "_ratio") for solver in ("explicit-euler", "rk4", "backward-euler"))]
         for row in table("topology/topology-equal-error.csv")])
    yield "Full and pruned Jacobian", (
        "Error of backward Euler in fur lengths (experiment topology-jacobian)."), markdown(
        ["topology", "time step (ms)", "full, rms", "pruned, rms", "full, p99", "pruned, p99"],
        [[row["dynamics.topology"], f"{row['step_ms']:.3g}", *(f"{row[key]:.2g}" for key in (
            "full_error_rms", "pruned_error_rms", "full_error_p99", "pruned_error_p99"))]
         for row in table("topology/topology-jacobian.csv")])
    yield "Gaps", (
        "Median gap between the tops of the separate sticks at one vertex, in fur lengths (experiment "
        "topology-parting)."), markdown(
        ["topology", "gusts at", "gap"], [[row["dynamics.topology"], row["dynamics.wind.gust_at"], f"{row['gap_median']:.2f}"]
                                          for row in table("topology/topology-parting.csv")])
    yield "Iterations", (
        "Iterations of conjugate gradients over nine models, by the constants of the springs (experiment "
        "topology-mesh-scaling)."), markdown(
        ["constants", "iterations"], [[reading, span((row["iterations"] for row in rows), ".0f")]
                                      for (reading,), rows in by(table("topology/topology-mesh-scaling.csv"), "reading").items()])


def reading(switch):
    """Returns the scene key, with its value, that a value of the axis `switch` changes."""
    with (ROOT / "experiments/readings.toml").open("rb") as file:
        switches = tomllib.load(file)["switch"]
    if switch not in switches:    # recorded before the key had another meaning
        return f"`{switch}` (removed)"
    keys = [f"{group}.{key} = {json.dumps(value)}" for group, values in switches[switch].items() for key, value in values.items()]
    return f"`{', '.join(keys)}`"


def effects():
    recorded = table("effects/overheads.csv")
    processes = span((row["processes"] for row in recorded), ".0f")
    rows = by(recorded, "reading", "effect", "model", "layers")
    kinds = list(dict.fromkeys(key[1] for key in rows))
    for which in ("paper", "pelage"):
        yield f"Effects in the reading `{which}`", (
            "Frame time with an effect / frame time of plain shells at 800x600 (experiment overheads; separate processes "
            f"for each cell: {processes})."), markdown(
            ["effect"] + [f"{model}, {layers} layers" for model, layers in SCENES],
            [[kind] + [interval(rows[which, kind, model, layers][0], "frame_over_baseline") for model, layers in SCENES]
             for kind in kinds])
    yield "Readings", (
        "Frame time with another reading of the papers / frame time with the default, and the two pictures "
        "compared (experiment readings)."), markdown(
        ["reading", "time", "PSNR (dB)", "SSIM"],
        [[reading(row["switch"]), interval(row, "frame_over_baseline"), decibels(row["baseline_psnr"], 1), f"{row['baseline_ssim']:.3f}"]
         for row in table("effects/readings.csv") if row["with"] == "default" and row["switch"] != "default"])


def scaling():
    rows = [row for row in table("scaling/layers-ratios.csv") if row["layers"] == 64]
    yield "Layers and scaling", (
        "Frame time with 64 layers / frame time with fewer, drawn in turns (experiment layers), and the model "
        "that `pelage report` fits to the experiment scaling."), markdown(
        ["divisor", "ratio"], [["32 layers", span((row["frame_over_half"] for row in rows), ".2f")],
                               ["16 layers", span((row["frame_over_quarter"] for row in rows), ".2f")]])
    text = (ROOT / "results/tables/scaling/frame-time-model.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if re.search(r"^(  per|\d+ cases|ms =|Most memory)", line)]
    yield None, "", "```\n" + "\n".join(lines) + "\n```\n"
    shares = by((row for row in table("profile/shells.csv") if row["kernel"] == "tile_shells"), "case")
    yield "The kernel `tile_shells`", (
        "Share of the frame time (`pelage profile`)."), markdown(
        ["case", "share"], [[case, f"{100 * row['ms'] / row['frame_ms']:.0f}%"] for (case,), [row] in shares.items()])


def strands():
    coats = either("strands/shells-vs-strands.csv", "xeon/shells-vs-strands.csv")
    yield "One coat as layers and as strands", (
        f"Experiment shells-vs-strands, {processor(coats[0])}; the rays are a ray-cast picture of the strands. strands-shaded "
        "has D's fill and rim lights, shadow and film, and so have its rays; the others have the key light alone."), markdown(
        ["variant", "distance", "frame (ms)", "overdraw", "PSNR to rays (dB)", "simulation (ns a segment)"],
        [[row["variant"], row["distance"], *(f"{row[key]:.1f}" for key in (
            "median_ms", "overdraw", "raycast_coarse_psnr", "simulate_ns_per_segment"))]
         for row in coats])
    yield "Ways to draw strands with OpenGL", (
        "Frame time of the baseline in ms (experiment strands-opengl-ways)."), markdown(
        ["way", "strands", "size", "time"], [[row["variant"], f"{row['count']:.0f}", row["size"], three(row['opengl_ms'])]
                                             for row in table("strands/strands-opengl-ways-ratio.csv")])


def switches():
    recorded = either("strands/demoreuille2011-switches.csv", "xeon/demoreuille2011-switches.csv")
    rows = by(recorded, "switch", "distance")
    places = list(dict.fromkeys(distance for _, distance in rows))
    kinds = [kind for kind in dict.fromkeys(kind for kind, _ in rows) if kind != "paper"]
    yield "Strands that face away, and segments of strands", (
        "Frame time / frame time with strands that face away sorted to the end and left out there, and 7 segments for each "
        f"strand (experiment demoreuille2011-switches, {processor(recorded[0])}); in round brackets the PSNR of the two pictures in dB."), markdown(
        ["switch", *places],
        [[kind, *(f"{interval(row, 'frame_over_baseline')} ({decibels(row['baseline_psnr'], 0)})" for [row] in
                  (rows[kind, place] for place in places))] for kind in kinds])


def trials():
    verdicts = by(table("aa-test/trials.csv"), "side", "verdict")
    sides = {side: sum(len(rows) for (s, _), rows in verdicts.items() if s == side) for side in ("equal", "slower")}
    wrong = sum(len(verdicts["equal", verdict]) for verdict in ("faster", "slower"))
    yield "Verdicts of `pelage compare`", "Comparisons by `scripts/aa_test.py` of two sides with equal work, or with 6% more in one.", markdown(
        ["sides", "comparisons", "called different"],
        [["equal", sides["equal"], wrong], ["6% more work", sides["slower"], len(verdicts["slower", "slower"])]])


INTRODUCTION = """# Recorded results

A virtual machine with two cores and no GPU recorded these results (PoCL, and llvmpipe for OpenGL). The processor is an
AMD EPYC unless a table names another. `scripts/record_all.sh` records all results again; `results/xeon` has rows of a
second machine. Each experiment has a folder with its rows. `results/tables` holds
the tables and plots that `pelage report` made of them, from which `scripts/recorded_tables.py` writes this page (a
test compares both). [claims.md](claims.md) has the verdicts on the papers' claims, [notes.md](notes.md) what was tried
to make the kernels faster. Numbers in square brackets are 95% intervals. [The glossary](../docs/glossary.md) defines
the terms.
"""


def page():
    text = INTRODUCTION
    for section in (table1, opengl, options, strands, switches, springs, networks, effects, scaling, trials):
        for title, sentence, body in section():
            text += "".join(f"\n{part}\n" if part != body else f"\n{part}" for part in (
                f"## {title}" if title else "", sentence, body) if part)
    return text


def frame_rates():
    lines = []
    for (model,), found in by([printed | {"ours": ours} for printed, ours in cells("table1/silva2010-table1")
                               if printed["size"] == "800x600"], "model").items():
        if model not in MODELS:
            continue
        found.sort(key=lambda row: row["layers"])
        cost = mean(row["ours"]["median_ms"] / row["median_ms"] for row in found)
        lines.append([f"{model}, {found[0]['triangles']:.0f} triangles",
                      *(text for row in found for text in (published(row), three(row["fps"]))), f"{cost:.2f}"])
    return "\n" + markdown(["model"] + [f"{layers} layers, {who}" for layers in (16, 64) for who in ("paper", "ours")]
                           + ["`pelage` / ours, time"], lines) + "\n"


def replaced(text, begin, end, inner):
    before, rest = text.split(begin)
    return before + begin + inner + end + rest.split(end)[1]


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    wanted = {PAGE: page(), README: replaced(README.read_text(encoding="utf-8"), BEGIN, END, frame_rates())}
    stale = [path for path, text in wanted.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    if not sys.argv[1:]:
        for path in stale:
            path.write_text(wanted[path], encoding="utf-8")
    elif stale:
        sys.exit("\n".join(f"{path.relative_to(ROOT)} differs from results/tables: run scripts/recorded_tables.py"
                           for path in stale))


if __name__ == "__main__":
    main()
