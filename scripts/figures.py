#!/usr/bin/env python3
"""Checks the measured figures in sentences of the documents, or writes them.

SENTENCES lists sentences with places for numbers, and a function that computes the numbers. The sentences on
mass-spring systems are in springs_sentences.py, those on effects and readings in effects_sentences.py and
pairs_sentences.py. The functions read the tables in docs/aa-test and those that scripts/record_all.sh wrote to docs/.
In a document, a line break may be anywhere in a sentence.

  scripts/figures.py           writes the numbers into the documents, after new rows were recorded
  scripts/figures.py --check   prints each sentence that a document does not contain with these numbers, and fails if
                               there is one. The test house.Figures runs this command.
"""
import json
import re
import sys

import effects_sentences
import pairs_sentences
import springs_sentences
from recorded_tables import ROOT, by, ends, mean, median, table

NUMBER = r"-?[0-9][0-9.,]*[0-9]|[0-9]|-"
LARGE = ("bunny", "elephant", "lion")  # the models of Table 1 with the most triangles


def cell(row):
    return f"{row['model']}, {row['layers']:.0f} layers, {row['size'].replace('x', ' x ')}"


def rivals():
    return table("rivals/rivals-ratio.csv")


def ratios_of(rows):
    """Returns the mean of the ratios to the OpenGL baseline, the lowest and the highest ratio and their cells."""
    rows = sorted(rows, key=lambda row: row["opengl_ratio"])
    return {"cells": len(rows), "mean": f"{mean(row['opengl_ratio'] for row in rows):.2f}",
            "least": f"{rows[0]['opengl_ratio']:.1f}", "least_cell": cell(rows[0]),
            "most": f"{rows[-1]['opengl_ratio']:.1f}", "most_cell": cell(rows[-1])}


def rival_ratios_of_large_models():
    rows = sorted((row for row in rivals() if row["model"] in LARGE), key=lambda row: row["opengl_ratio"])
    return {"least": f"{rows[0]['opengl_ratio']:.1f}", "low": f"{rows[0]['opengl_ratio_low']:.1f}",
            "high": f"{rows[0]['opengl_ratio_high']:.1f}", "cell": cell(rows[0]),
            "second": f"{rows[1]['opengl_ratio']:.1f}", "most": f"{rows[-1]['opengl_ratio']:.1f}"}


def rival_ratios_of_models():
    means = {model: mean(row["opengl_ratio"] for row in rows) for (model,), rows in by(rivals(), "model").items()}
    return {model: f"{means[model]:.1f}" for model in ("torus", "lion")}


def strongest():
    return table("rivals/rivals-strongest-ratio.csv")


def without_avx512():
    fastest = mean(row["opengl_ratio"] for row in table("rivals-avx2/rivals-strongest-ratio.csv"))
    return {**ratios_of(table("rivals-avx2/rivals-ratio.csv")), "fastest": f"{fastest:.2f}"}


def strongest_limits():
    ratio = mean(row["opengl_ratio"] for row in strongest())
    return {"mean": f"{ratio:.2f}", "less": f"{100 * (1 - ratio / 10):.0f}",
            "alone": f"{mean(row['opengl_ms'] / row['raster_ms'] for row in strongest()):.1f}"}


def interval_of_the_mean():
    """The 95% interval of the geometric mean of the ratios of Table 1, as the report states it."""
    text = (ROOT / "docs/rivals/rivals-ratio.txt").read_text(encoding="utf-8")
    [(low, high)] = re.findall(r"over 32 of 32 cells \(95% interval ([\d.]+) to ([\d.]+) over 3 separate runs\)", text)
    return {"low": low, "high": high}


def plain_shells():
    rows = table("rivals/rivals-tori-ratio.csv")
    places = by(rows, "model", "layers", "size", "reading")
    pairs = [(found, places[(*place[:3], "plain")][0]) for place, [found] in places.items() if place[3] == "default"]
    return {**ends((plain["opengl_ratio"] for _, plain in pairs), ".1f"),
            "opencl": f"{mean(coat['median_ms'] / plain['median_ms'] for coat, plain in pairs):.2f}",
            "opengl": f"{mean(coat['opengl_ms'] / plain['opengl_ms'] for coat, plain in pairs):.2f}", "cells": len(pairs)}


def options():
    """The time of a variant of the baseline divided by the time of the fastest one, as a mean over two cells."""
    by_fastest = {row["variant"]: row["by_fastest"] for row in table("rivals/rival-options.csv")}
    return {**ends(by_fastest.values(), ".2f"), "default": f"{by_fastest['opengl']:.2f}"}


AGREEMENTS = {
    "byte": "With `byte`, the PSNR against the reference is therefore only {few} dB with 16 layers and {many} dB with 64 layers",
    "rgba16f": "With rgba16f and 64 layers, the PSNR against the reference is {many} dB",
}


def agreement(variant):
    """The PSNR of a variant of the baseline against the reference, by number of layers."""
    [file] = (ROOT / "results/rival-options").glob("*.jsonl")
    values = {}
    for row in map(json.loads, file.read_text(encoding="utf-8").splitlines()):
        if row["variant"] == variant:
            [psnr] = [check["value"] for check in row["check"] if check["metric"] == "psnr"]
            values[{16: "few", 64: "many"}[row["axes"]["layers"]]] = f"{psnr:.0f}"
    return values


def layer_ratios(column, models=None):
    rows = [row for row in table("scaling/layers-ratios.csv") if row["layers"] == 64 and (not models or row["model"] in models)]
    return ends((row[column] for row in rows), ".2f")


def scaling_text(pattern):
    text = (ROOT / "docs/scaling/scaling.txt").read_text(encoding="utf-8")
    return [tuple(float(x) for x in found) if isinstance(found, tuple) else float(found) for found in re.findall(pattern, text)]


def held_out():
    [(middle, low, high)] = scaling_text(r"held out: predicted / measured - 1 is (\d+)% in the middle, (-?\d+)% to \+(\d+)%")
    return {"middle": f"{middle:.0f}", "most": f"{max(-low, high):.0f}"}


def largest_pictures():
    pairs = scaling_text(r"3840x2160 +([\d.]+) ms measured, +([\d.]+) predicted")
    return ends((100 * (1 - measured / predicted) for measured, predicted in pairs), ".0f")


def drawing_share(model):
    rows = [row for row in table("profile/shells.csv") if row["kernel"] == "tile_shells" and row["case"].startswith(model + "-")]
    return [100 * row["ms"] / row["frame_ms"] for row in rows]


def trials():
    verdicts = by(table("aa-test/trials.csv"), "side", "verdict")
    equal = sum(len(rows) for (side, _), rows in verdicts.items() if side == "equal")
    more = sum(len(rows) for (side, _), rows in verdicts.items() if side == "slower")
    wrong = sum(len(verdicts[("equal", verdict)]) for verdict in ("faster", "slower"))
    return {"wrong": wrong, "equal": equal, "slower": len(verdicts[("slower", "slower")]), "more": more}


VARIANTS = {"shells-16": "16 layers", "shells-64": "64 layers", "strands": "strands", "strands-quarter": "a quarter of the strands"}


def same_coat(variant):
    rows = {row["distance"]: row for row in table("strands/shells-vs-strands.csv") if row["variant"] == variant}
    columns = {"ms": "median_ms", "overdraw": "overdraw", "psnr": "raycast_coarse_psnr"}
    return {f"{name}_{distance}": f"{rows[distance][column]:.1f}" for name, column in columns.items() for distance in rows}


def same_coat_simulation():
    rows = table("strands/shells-vs-strands.csv")
    chains = [row for row in rows if row["variant"] == "strands"]
    layers = [row for row in rows if row["variant"].startswith("shells")]
    share = ends((100 * row["simulate_ms"] / row["median_ms"] for row in chains), ".1f")
    return {"chain": f"{median(row['simulate_ns_per_segment'] for row in chains):.1f}",
            "layer": f"{median(row['simulate_ns_per_segment'] for row in layers):.1f}", **share}


def strand_ratios():
    rows = [row for row in table("strands/demoreuille2011-scaling-ratio.csv") if row["distance"] == "near"]
    values = {count: ends((row["opengl_ratio"] for row in rows if row["count"] == float(count)), ".2f") for count in ("100000", "1000000")}
    return {"low": values["100000"]["least"], "high": values["100000"]["most"], "low_million": values["1000000"]["least"],
            "high_million": values["1000000"]["most"], "mean": f"{mean(row['opengl_ratio'] for row in rows):.2f}"}


WAYS = ["instanced-rgba32f", "instanced-rgba16f", "indexed-rgba32f", "indexed-rgba16f"]


def opengl_way(way):
    rows = {(row["count"], row["size"]): row["opengl_ms"] for row in table("strands/strands-opengl-ways-ratio.csv")
            if row["variant"] == way}
    return {f"{letter}{size[0]}": f"{rows[count, size]:.{1 if rows[count, size] < 100 else 0}f}" if (count, size) in rows else "-"
            for letter, count in {"a": 10000, "b": 100000, "c": 1000000}.items() for size in ("800x600", "1680x1050")}


def agreement_of_eight_bits():
    found = [re.search(r"opengl is ([0-9.]+)", row["reason"]) for row in table("strands/left-out.csv")
             if row["experiment"] == "strands-opengl-ways" and "rgba8" in row["case"]]
    return ends((float(match[1]) for match in found), ".1f")


def least_agreement_of_strands():
    [reason] = [row["reason"] for row in table("strands/left-out.csv")
                if row["experiment"] == "demoreuille2011-scaling" and "psnr against opengl" in row["reason"]]
    return {"psnr": f"{float(re.search(r'opengl is ([0-9.]+)', reason)[1]):.0f}"}


SENTENCES = [
    ("docs/strands.md", "With `rgba8`, the two pictures agree only to {least} to {most} dB, so these rows are not ok.",
     agreement_of_eight_bits),
    *(("docs/strands.md", f"| {way.replace('-', ', ')} | {{a8}}, {{a1}} | {{b8}}, {{b1}} | {{c8}}, {{c1}} |",
       lambda way=way: opengl_way(way)) for way in WAYS),
    ("docs/strands.md", "four times as far away is not ok, because the two pictures agree only to {psnr} dB.", least_agreement_of_strands),
    ("docs/strands.md", "if the model fills the picture, the ratio is {low} to {high} with 100,000 strands and {low_million} to "
     "{high_million} with a million strands; the geometric mean over 10,000, 100,000 and a million strands in both sizes is "
     "{mean}.", strand_ratios),
    *(("docs/strands.md", f"| {label} | {{ms_near}}, {{ms_middle}}, {{ms_far}} | {{overdraw_near}}, {{overdraw_middle}}, {{overdraw_far}} | "
       "{psnr_near}, {psnr_middle}, {psnr_far} |", lambda variant=variant: same_coat(variant)) for variant, label in VARIANTS.items()),
    ("docs/strands.md", "A simulated segment takes {chain} ns with two-segment chains and {layer} ns with the one-segment hairs of the "
     "layers (median over the rows), so the better simulation costs more, but {least}% to {most}% of a frame of strands.",
     same_coat_simulation),
    ("docs/results.md", "the test called {wrong} of {equal} pairs of equal sides different, and {slower} of {more} sides with 5% "
     "more work slower.", trials),
    ("docs/rival.md", "The geometric mean of the {cells} ratios (baseline time / OpenCL time) is {mean}.", lambda: ratios_of(rivals())),
    ("docs/rival.md", "The lowest ratio is {least} ({least_cell}). The highest ratio is {most} ({most_cell}).", lambda: ratios_of(rivals())),
    ("docs/rival.md", "Its 95% interval is {low} to {high}, from the means of the three processes.", interval_of_the_mean),
    ("docs/rival.md", "In {cells} of the cells, other programs used more than 10% of the processors' time while a process measured the "
     "cell.", lambda: {"cells": sum(row["contended"] > 0 for row in rivals())}),
    *(("docs/rival.md", text, lambda option=option: agreement(option)) for option, text in AGREEMENTS.items()),
    ("docs/rival.md", "The geometric mean of the {cells} ratios against this variant is {mean}. The lowest ratio is {least} "
     "({least_cell}), and the highest ratio is {most} ({most_cell}).", lambda: ratios_of(strongest())),
    ("docs/rival.md", "The geometric mean of the ratios against the default variant is {mean}. The lowest ratio of a cell is {least} "
     "({least_cell}), and the highest is {most} ({most_cell}). The geometric mean of the ratios against the fastest variant is "
     "{fastest}.", without_avx512),
    ("results/rasterizer-notes.md", "the geometric mean of the 32 ratios is {mean}.", strongest_limits),
    ("results/rasterizer-notes.md", "For a mean of 10, the frames would have to take {less}% less time.", strongest_limits),
    ("results/rasterizer-notes.md", "if all parts of a frame except the kernel `tile_shells` took no time, the mean would be {alone}.",
     strongest_limits),
    ("results/rasterizer-notes.md", "On the same CPU the rasterizer is {mean} times as fast as the baseline", lambda: ratios_of(rivals())),
    ("results/rasterizer-notes.md", "the ratios of single cells range from {least} to {most}.", lambda: ratios_of(rivals())),
    ("docs/rival.md", "The OpenCL pipeline draws them {least} to {most} times as fast as the OpenGL baseline. In the OpenCL pipeline "
     "a frame with curls and clumps takes {opencl} times as long as a frame of plain shells (geometric mean over {cells} cells).",
     plain_shells),
    ("docs/rival.md", "In the OpenGL baseline a frame with curls and clumps takes {opengl} times as long as a frame of plain shells.",
     plain_shells),
    ("docs/rival.md", "On bunny, elephant and lion, the lowest ratio is {least} (95% interval {low} to {high}; {cell}). In the "
     "other cells of these three models the ratio is {second} to {most}.", rival_ratios_of_large_models),
    ("docs/rival.md", "the geometric mean over the four cells of a model is {torus} for the torus and {lion} for the lion",
     rival_ratios_of_models),
    ("docs/rival.md", "The geometric mean of the two quotients is {least} to {most}; for our default variant (`opengl`) it is {default}.",
     options),
    ("docs/performance.md", "on the models of `silva2010-table1`, frames with twice as many layers take {least} to {most} times "
     "as long",
     lambda: layer_ratios("half_ratio")),
    ("docs/performance.md", "Frames with four times as many layers take {least} to {most} times as long",
     lambda: layer_ratios("quarter_ratio")),
    ("docs/performance.md", "on bunny, elephant and lion they take {least} to {most} times as long",
     lambda: layer_ratios("quarter_ratio", LARGE)),
    ("docs/performance.md", "In this experiment, frames with twice as many layers take {least} to {most} times as long.",
     lambda: ends(scaling_text(r"layers: .* ms, ([\d.]+) times"), ".2f")),
    ("docs/performance.md", "the median error of the predicted frame time is {middle}% and the largest error is {most}%",
     held_out),
    ("docs/performance.md", "Pictures of 3840 x 2160 pixels take {least} to {most}% less time than the linear model predicts",
     largest_pictures),
    ("docs/performance.md", "`tile_shells` takes {least}% of the frame time of the lion",
     lambda: ends(drawing_share("lion"), ".0f")),
    ("docs/performance.md", "and {least} to {most}% of the frame time of the torus",
     lambda: ends(drawing_share("torus"), ".0f")),
    *effects_sentences.SENTENCES,
    *pairs_sentences.SENTENCES,
    *springs_sentences.SENTENCES,
]


def pattern_of(template):
    """Returns a regular expression that matches the sentence with any numbers, broken into lines anywhere."""
    parts = re.split(r"(\{\w+\})", template)
    made = ""
    for part in parts:
        if re.fullmatch(r"\{\w*cell\}", part):
            made += f"(?P<{part[1:-1]}>[^()]+?)"
        elif re.fullmatch(r"\{\w+\}", part):
            made += f"(?P<{part[1:-1]}>{NUMBER})"
        else:
            made += r"\s+".join(re.escape(word) for word in re.split(r"\s+", part))
    return re.compile(made)


def checked(text, template, values):
    """Returns the text with the computed values in the sentence, and the faults."""
    found = list(pattern_of(template).finditer(text))
    if len(found) != 1:
        return text, [f"occurs {len(found)} times, must be once: {template}"]
    faults = []
    for name in sorted(found[0].groupdict(), key=found[0].start, reverse=True):
        here, wanted = found[0].group(name), str(values[name])
        if " ".join(here.split()) != wanted:
            faults.append(f"says {' '.join(here.split())} instead of {wanted}: {template}")
            text = text[:found[0].start(name)] + wanted + text[found[0].end(name):]
    return text, faults


def main():
    only_check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not only_check:
        sys.exit(__doc__)
    springs_sentences.check_words()
    failed = False
    documents = {}
    for name, template, compute in SENTENCES:
        text = documents.get(name) or (ROOT / name).read_text(encoding="utf-8")
        documents[name], faults = checked(text, template, compute())
        for fault in faults:
            missing = fault.startswith("occurs")
            failed = failed or only_check or missing
            print(f"{name}: {fault}" if only_check or missing else f"{name}: {fault.split(':')[0].replace('says', 'was')}")
    if not only_check:
        for name, text in documents.items():
            (ROOT / name).write_text(text, encoding="utf-8")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
