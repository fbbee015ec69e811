#!/usr/bin/env python3
"""Writes one HTML page per paper with all its figures, from a run of the experiments of the collection figures.

usage: scripts/figure_sheets.py RUN OUT     RUN is the folder of `pelage run figures`, OUT a new folder
       scripts/figure_sheets.py --list      prints the cases and diagrams that the pages show

The script copies the pictures of the cases from RUN and draws the diagrams with `pelage diagram`. docs/experiments.md lists
the figures. The environment variable PELAGE can name another pelage program.
"""
import html
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIZE = "640x480"


def case(label, figure, name):
    """A picture of the run: case `name` of the experiment `figure`."""
    return {"label": label, "experiment": figure, "case": f"{name}-{SIZE}"}


def diagram(label, kind, figure, name, *options):
    """A diagram of the scene of a case."""
    return {**case(label, figure, name), "kind": kind, "options": list(options)}


S1, S3, S4, S6, S7, S8, S9, S10, S11, S12, S13 = (f"silva2010-fig{n:02d}" for n in (1, 3, 4, *range(6, 14)))
W1, W2, W4, W5, W6 = (f"wetfur2010-fig{n:02d}" for n in (1, 2, 4, 5, 6))
REST = ["--set", "dynamics.wind.strength=0"]  # a scene without its wind
# Few triangles and few layers, so that single lines can be seen.
SECTION = ["--model", "banisch-grass", "--set", "fur.layers=9", "--set", "fur.length=0.4"]
UPRIGHT = [*REST, "--set", "fur.comb=0"]
FORCE = ["--set", "fur.comb=0", "--set", "dynamics.wind.strength=0.2", "--set", "fur.layer_spacing=paper"]

ARROW = ["--line-width", "5"]

PAGES = {
    "silva2010": ("Curling and Clumping Fur Represented by Texture Layers (Silva et al. 2010)", [
        ("Figure 1", "One model with fur in four states.",
         [case("straight", S1, "straight"), case("curly", S1, "curly"),
          case("dry", S1, "dry"), case("wet, in clumps", S1, "wet")]),
        ("Figure 2", "Sections of the layers, and the curl. The blue lines are layers, and the orange lines strands, whose red "
         "points carry the layers. The red arrow is the mean displacement of the tips.",
         [diagram("upright fur, as in earlier methods", "layers", S6, "bent", *SECTION, *UPRIGHT),
          diagram("layers sheared in proportion to their height", "layers", S6, "sheared", *SECTION),
          diagram("virtual strands at rest", "layers", S6, "bent", *SECTION, *UPRIGHT, "--set", "fur.layer_spacing=paper"),
          diagram("virtual strands bent by a force", "layers", S6, "bent", *SECTION, *FORCE),
          diagram("curl of a strand, at three wetnesses", "curl", S7, "large")]),
        ("Figure 3", "From textures to fur.",
         [diagram("colour texture", "coat", S3, "c"),
          diagram("four slices of the fur texture, h = 1/8, 3/8, 5/8, 7/8, 64 x 64 texels of each, as square roots", "slices", S3, "c"),
          case("result", S3, "c")]),
        ("Figure 4", "Forces on the strands. The red arrow in (b) is the direction of the wind.",
         [diagram("one triangle; its strand is white", "lines", S4, "triangle", "--line-width", "4"),
          diagram("a square in the wind", "wind", S4, "wind", *ARROW)]),
        ("Figure 5", "The wetness mask, and a clump of radius r in section: each strand of the clump leans towards its centre c. At the "
         "height h, the displacement of the outermost strand is d (p is its point there), and that of its tip is \u03c1 r. "
         "In the mask, black is dry, and the brightness of the blue is the wetness; its hue tells clumps apart.",
         [diagram("mask with the triangles of the UV map", "mask", S9, "a"),
          diagram("section of a clump of Figure 9 (a)", "clump", S9, "a", "--set", "fur.layers=64")]),
        ("Figure 6", "Bent strands and sheared layers under the same kind of force. The red arrows are its direction.",
         [diagram("strands bend", "wind", S6, "bent", *ARROW),
          diagram("layers are sheared", "wind", S6, "sheared", *ARROW)]),
        ("Figure 7", "What the curl does to the fur.",
         [case("straight", S7, "straight"), case("wavy", S7, "wavy"),
          case("few large curls", S7, "large"), case("many small curls", S7, "small")]),
        ("Figure 8", "Dry fur and a mask give clumps.",
         [case("dry", S8, "dry"), diagram("mask", "mask", S8, "wet"), case("result", S8, "wet")]),
        ("Figure 9", "The shape of clumps. (b) and (d) show fewer clumps than (a) and (c).",
         [case("w = 0, from the side", S9, "a"), case("w = 0, from above", S9, "b"),
          case("w = 1, from the side", S9, "c"), case("w = 1, from above", S9, "d"),
          diagram("f(h) of Eq. 5", "shape", S9, "a"), diagram("section with w = 1", "clump", S9, "c")]),
        ("Figure 10", "Curly fur on two models.",
         [case("bunny", S10, "bunny"), case("teddy (stand-in)", S10, "teddy")]),
        ("Figure 11", "A dry and a wet bunny.",
         [case("dry", S11, "dry"), case("wet", S11, "wet"), diagram("mask of the dry bunny", "mask", S11, "dry"),
          diagram("mask of the wet bunny", "mask", S11, "wet")]),
        ("Figure 12", "Random droplets, and droplets in letters.",
         [case("dry cat", S12, "dry"), case("cat with droplets", S12, "droplets"),
          case("CGI10 in droplets", S12, "text"), diagram("mask of the letters", "mask", S12, "text")]),
        ("Figure 13", "Clumps from near, with 64 layers.", [case("wet bunny", S13, "near")]),
    ]),
    "wetfur2010": ("Real-Time Rendering of Wet Fur (Silva et al. 2010)", [
        ("Figure 1", "A dry and a soaking wet bunny.",
         [case("dry", W1, "dry"), case("wet", W1, "wet"), diagram("mask of the wet bunny", "mask", W1, "wet")]),
        ("Figure 2", "A wet blanket. (a) is a photograph of a blanket, which is left out.",
         [case("(b) drawn by the method", W2, "b")]),
        ("Figure 3", "The wetness mask, and a clump in section. p is a point of the outermost strand at the height h, d its displacement; that of the tip is \u03c1 r.",
         [diagram("mask with the triangles of the UV map", "mask", W4, "a"),
          diagram("section of a clump", "clump", W4, "a")]),
        ("Figure 4", "The shape of clumps. (b) and (d) show fewer clumps than (a) and (c).",
         [case("w = 0, from the side", W4, "a"), case("w = 0, from above", W4, "b"),
          case("w = 1, from the side", W4, "c"), case("w = 1, from above", W4, "d")]),
        ("Figure 5", "Dry fur and a mask give wet fur.",
         [case("fur", W5, "a"), diagram("mask", "mask", W5, "c"), case("result", W5, "c")]),
        ("Figure 6", "Wet and dry fur side by side, and letters.",
         [case("partly wet bunny", W6, "a"), case("border of wet and dry fur, on a square", W6, "b"),
          case("VCS 10 in droplets", W6, "c"), diagram("mask of the letters", "mask", W6, "c")]),
    ]),
}

TABLES = {"shape", "clump", "curl", "layers"}  # diagrams that are drawn as SVG
STYLE = """body { font: 15px/1.4 sans-serif; max-width: 1320px; margin: 2em auto; padding: 0 1em; color: #222 }
section { display: grid; gap: 12px; align-items: end }
figure { margin: 0 0 1em } figcaption { color: #555 }
figure img { display: block; width: 100%; max-height: 480px; object-fit: contain }"""


def draw(panel, run, out, stem):
    """Puts the panel's picture into `out`. Returns its file name."""
    if "kind" not in panel:
        source = Path(run) / panel["experiment"] / "images" / f"{panel['case']}.png"
        if not source.is_file():
            sys.exit(f"{source} is missing; draw it with: pelage run {panel['experiment']} -o ...")
        shutil.copy(source, out / f"{stem}.png")
        return f"{stem}.png"
    name = f"{stem}.{'svg' if panel['kind'] in TABLES else 'png'}"
    subprocess.run([os.environ.get("PELAGE", str(ROOT / "build/release/pelage")), "diagram", panel["kind"],
                    panel["experiment"], "--case", panel["case"], *panel["options"], "-o", str(out / name)], check=True)
    return name


def page(paper, title, figures, run, out):
    note = "Lengths in diagrams are in R, the radius of the model's bounding sphere. A click opens a picture in full size."
    body = [f"<!doctype html><meta charset=utf-8><title>{html.escape(title)}</title><style>{STYLE}</style>",
            f"<h1>{html.escape(title)}</h1><p>{note}</p>"]
    for figure, caption, panels in figures:
        columns = 3 if len(panels) in (3, 5, 6) else 2
        body.append(f"<h2>{figure}</h2><p>{html.escape(caption)}</p>"
                    f"<section style='grid-template-columns: repeat({columns}, 1fr)'>")
        for i, panel in enumerate(panels):
            stem = f"{paper}-{figure.lower().replace(' ', '-')}-{chr(ord('a') + i)}"
            label = html.escape(panel["label"])
            if len(panels) > 1:
                label = f"({chr(ord('a') + i)}) {label}"
            name = draw(panel, run, out, stem)
            body.append(f'<figure><a href="{name}"><img src="{name}" alt="{label}"></a>'
                        f"<figcaption>{label}</figcaption></figure>")
        body.append("</section>")
    (out / f"{paper}.html").write_text("\n".join(body) + "\n", encoding="utf-8")


def main():
    if sys.argv[1:] == ["--list"]:
        for _, figures in PAGES.values():
            for _, _, panels in figures:
                for panel in panels:
                    print(panel["experiment"], panel["case"], panel.get("kind", "picture"))
        return
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out = Path(sys.argv[2])
    out.mkdir(parents=True)
    for paper, (title, figures) in PAGES.items():
        page(paper, title, figures, sys.argv[1], out)
        print(out / f"{paper}.html")


if __name__ == "__main__":
    main()
