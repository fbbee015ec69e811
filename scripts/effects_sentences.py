"""The sentences on the cost of effects and readings whose numbers scripts/figures.py checks.

Each entry of SENTENCES has a document, a text with places for numbers, and a function that computes the numbers from the
tables in docs/effects.
"""
from recorded_tables import table

EFFECTS = {
    "plain": "none (plain shells)",
    "curl": "curls",
    "clump": "clumps",
    "wet": "clumps, and the light of wet fur",
    "facing": "`blend.faces` \"back-then-front\"",
    "all": "curls, clumps and `blend.faces` \"back-then-front\"",
    "mask": "as wet fur, with a mask in every frame",
    "soaked": "soaked fur (`docs/soaked.md`)",
    "style": "curls, and all maps of the fur's shape (`docs/style.md`)",
    "contact": "a sphere and a capsule in the fur (`docs/contact.md`)",
}
SCENES = [(model, layers) for model in ("torus", "bunny", "lion") for layers in (16, 64)]

READINGS = {
    "faces": "`blend.faces` \"all\"",
    "depth": "`blend.order` \"depth\"",
    "scale": "`clump.scale` \"relative\"",
    "literal": "`clump.scale` \"literal\"",
    "distance": "`clump.scale` \"distance\"",
    "cells": "`clump.cells` \"separate\"",
    "printed-cells": "`clump.cells` \"literal\"",
    "tangent": "`shading.tangent` \"paper\"",
    "printed": "`shading.tangent` \"printed\"",
    "drawn": "`shading.tangent` \"drawn\"",
    "blend": "`wetness.blend` \"near\"",
    "seams": "`wetness.seams` \"cut\"",
    "spacing": "`fur.layer_spacing` \"uniform\"",
    "binding": "`fur.binding` \"separate\"",
    "frame": "`curl.frame` \"uv\"",
    "wrap": "`shading.wrap` 0",
}


def ratio(row, name):
    return {name: f"{row['baseline_ratio']:.2f}", f"{name}_low": f"{row['baseline_ratio_low']:.2f}",
            f"{name}_high": f"{row['baseline_ratio_high']:.2f}"}


def overheads():
    return {(row["reading"], row["model"], row["layers"]): row for row in table("effects/overheads.csv")}


def overhead(effect):
    rows = overheads()
    values = {}
    for model, layers in SCENES:
        values |= ratio(rows[effect, model, layers], f"{model}{layers}")
    return values


def overhead_line(effect):
    cells = " | ".join(f"{{{model}{layers}}} [{{{model}{layers}_low}}, {{{model}{layers}_high}}]" for model, layers in SCENES)
    return ("docs/performance.md", f"| {EFFECTS[effect]} | {cells} |", lambda: overhead(effect))


def reading(switch):
    [row] = [row for row in table("effects/readings.csv") if row["switch"] == switch and row["with"] == "default"]
    return {**ratio(row, "ratio"), "psnr": f"{row['baseline_psnr']:.1f}", "ssim": f"{row['baseline_ssim']:.3f}"}


def reading_line(switch):
    return ("docs/performance.md", f"| {READINGS[switch]} | {{ratio}} [{{ratio_low}}, {{ratio_high}}] | {{psnr}} | {{ssim}} |",
            lambda: reading(switch))


SENTENCES = [*(overhead_line(effect) for effect in EFFECTS), *(reading_line(switch) for switch in READINGS)]
