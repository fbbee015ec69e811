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


def case(figure, name):
    """A picture of the run: case `name` of the experiment `figure`."""
    return {"label": "", "experiment": figure, "case": f"{name}-{SIZE}"}


def diagram(kind, figure, name, *options):
    """A diagram of the scene of a case."""
    return {**case(figure, name), "kind": kind, "options": list(options)}


def labelled(label, panel):
    return {**panel, "label": label}


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
         [labelled("straight", case(S1, "straight")), labelled("curly", case(S1, "curly")),
          labelled("dry", case(S1, "dry")), labelled("wet, in clumps", case(S1, "wet"))]),
        ("Figure 2", "Sections of the layers, and the curl. The blue lines are layers, and the orange lines strands, whose red "
         "points carry the layers. The red arrow is the mean displacement of the tips.",
         [labelled("upright fur, as in earlier methods", diagram("layers", S6, "bent", *SECTION, *UPRIGHT)),
          labelled("layers sheared in proportion to their height", diagram("layers", S6, "sheared", *SECTION)),
          labelled("virtual strands at rest", diagram("layers", S6, "bent", *SECTION, *UPRIGHT, "--set", "fur.layer_spacing=paper")),
          labelled("virtual strands bent by a force", diagram("layers", S6, "bent", *SECTION, *FORCE)),
          labelled("curl of a strand, at three wetnesses", diagram("curl", S7, "large"))]),
        ("Figure 3", "From textures to fur.",
         [labelled("colour texture", diagram("coat", S3, "c")),
          labelled("four slices of the fur texture, h = 1/8, 3/8, 5/8, 7/8, 64 x 64 texels of each, as square roots", diagram("slices", S3, "c")),
          labelled("result", case(S3, "c"))]),
        ("Figure 4", "Forces on the strands. The red arrow in (b) is the direction of the wind.",
         [labelled("one triangle; its strand is white", diagram("lines", S4, "triangle", "--line-width", "4")),
          labelled("a square in the wind", diagram("wind", S4, "wind", *ARROW))]),
        ("Figure 5", "The wetness mask, and a clump of radius r in section: each strand of the clump leans towards its centre c. At the "
         "height h, the displacement of the outermost strand is d (p is its point there), and that of its tip is \u03c1 r. "
         "In the mask, black is dry, and the brightness of the blue is the wetness; its hue tells clumps apart.",
         [labelled("mask with the triangles of the UV map", diagram("mask", S9, "a")),
          labelled("section of a clump of Figure 9 (a)", diagram("clump", S9, "a", "--set", "fur.layers=64"))]),
        ("Figure 6", "Bent strands and sheared layers under the same kind of force. The red arrows are its direction.",
         [labelled("strands bend", diagram("wind", S6, "bent", *ARROW)),
          labelled("layers are sheared", diagram("wind", S6, "sheared", *ARROW))]),
        ("Figure 7", "What the curl does to the fur.",
         [labelled("straight", case(S7, "straight")), labelled("wavy", case(S7, "wavy")),
          labelled("few large curls", case(S7, "large")), labelled("many small curls", case(S7, "small"))]),
        ("Figure 8", "Dry fur and a mask give clumps.",
         [labelled("dry", case(S8, "dry")), labelled("mask", diagram("mask", S8, "wet")),
          labelled("result", case(S8, "wet"))]),
        ("Figure 9", "The shape of clumps. (b) and (d) show fewer clumps than (a) and (c).",
         [labelled("w = 0, from the side", case(S9, "a")), labelled("w = 0, from above", case(S9, "b")),
          labelled("w = 1, from the side", case(S9, "c")), labelled("w = 1, from above", case(S9, "d")),
          labelled("f(h) of Eq. 5", diagram("shape", S9, "a")),
          labelled("section with w = 1", diagram("clump", S9, "c"))]),
        ("Figure 10", "Curly fur on two models.",
         [labelled("bunny", case(S10, "bunny")), labelled("teddy (stand-in)", case(S10, "teddy"))]),
        ("Figure 11", "A dry and a wet bunny.",
         [labelled("dry", case(S11, "dry")), labelled("wet", case(S11, "wet")),
          labelled("mask of the dry bunny", diagram("mask", S11, "dry")),
          labelled("mask of the wet bunny", diagram("mask", S11, "wet"))]),
        ("Figure 12", "Random droplets, and droplets in letters.",
         [labelled("dry cat", case(S12, "dry")), labelled("cat with droplets", case(S12, "droplets")),
          labelled("CGI10 in droplets", case(S12, "text")), labelled("mask of the letters", diagram("mask", S12, "text"))]),
        ("Figure 13", "Clumps from near, with 64 layers.", [labelled("wet bunny", case(S13, "near"))]),
    ]),
    "wetfur2010": ("Real-Time Rendering of Wet Fur (Silva et al. 2010)", [
        ("Figure 1", "A dry and a soaking wet bunny.",
         [labelled("dry", case(W1, "dry")), labelled("wet", case(W1, "wet")),
          labelled("mask of the wet bunny", diagram("mask", W1, "wet"))]),
        ("Figure 2", "A wet blanket. (a) is a photograph of a blanket, which is left out.",
         [labelled("(b) drawn by the method", case(W2, "b"))]),
        ("Figure 3", "The wetness mask, and a clump in section. p is a point of the outermost strand at the height h, d its displacement; that of the tip is \u03c1 r.",
         [labelled("mask with the triangles of the UV map", diagram("mask", W4, "a")),
          labelled("section of a clump", diagram("clump", W4, "a"))]),
        ("Figure 4", "The shape of clumps. (b) and (d) show fewer clumps than (a) and (c).",
         [labelled("w = 0, from the side", case(W4, "a")), labelled("w = 0, from above", case(W4, "b")),
          labelled("w = 1, from the side", case(W4, "c")), labelled("w = 1, from above", case(W4, "d"))]),
        ("Figure 5", "Dry fur and a mask give wet fur.",
         [labelled("fur", case(W5, "a")), labelled("mask", diagram("mask", W5, "c")),
          labelled("result", case(W5, "c"))]),
        ("Figure 6", "Wet and dry fur side by side, and letters.",
         [labelled("partly wet bunny", case(W6, "a")), labelled("border of wet and dry fur, on a square", case(W6, "b")),
          labelled("VCS 10 in droplets", case(W6, "c")), labelled("mask of the letters", diagram("mask", W6, "c"))]),
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
