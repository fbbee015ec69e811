"""The style of all plots: colours, axes, and the files. plot.py, profile.py, scaling.py and section.py use it.

A plot program is called as PROGRAM TABLE.csv OUT.svg [OUT.pdf ...]. A report contains this file and the programs beside
their tables. They need only matplotlib.
"""
import csv
import sys
import xml.etree.ElementTree as ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Colour-blind readers can distinguish these colours of Okabe and Ito. The markers distinguish the lines in grey print.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<"]  # Eight markers and seven colours give 56 different series.
SVG = "http://www.w3.org/2000/svg"

# Without dates and random identifiers, equal tables give equal files. Text stays text.
plt.rcParams.update({"font.size": 9, "svg.hashsalt": "pelage", "svg.fonttype": "none", "pdf.fonttype": 42,
                     "hatch.linewidth": 0.5})
_texts = {}  # name of a line in the SVG file -> the texts of its points


def open_axis(axis, grid=True):
    """Removes the frame at the top and on the right, and draws a grid."""
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)
    if grid:
        axis.grid(True, which="major", color="0.87", linewidth=0.6)
        axis.set_axisbelow(True)


def tell(line, texts):
    """Gives the points of a line texts, which a browser shows when the pointer is over a point."""
    line.set_gid(f"points-{len(_texts)}")
    _texts[line.get_gid()] = texts


def _for_pages(file):
    """Adds the texts of points, and removes what an HTML page that contains the picture does not need."""
    for prefix, name in (("", SVG), ("xlink", "http://www.w3.org/1999/xlink")):
        ElementTree.register_namespace(prefix, name)
    tree = ElementTree.parse(file)
    for data in tree.findall(f"{{{SVG}}}metadata"):
        tree.getroot().remove(data)
    for group in tree.iter(f"{{{SVG}}}g"):
        for mark, text in zip(group.iter(f"{{{SVG}}}use"), _texts.get(group.get("id"), [])):
            ElementTree.SubElement(mark, f"{{{SVG}}}title").text = text
    tree.write(file, encoding="utf-8", xml_declaration=True)


def run(draw, usage):
    """Calls draw(rows, table, outputs) with the lines of the table, and writes the figure that it returns."""
    if len(sys.argv) < 3:
        sys.exit(usage)
    table, outputs = sys.argv[1], sys.argv[2:]
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    figure = draw(rows, table, outputs)
    for output in outputs:
        meta = {"Date": None} if output.endswith(".svg") else {"CreationDate": None} if output.endswith(".pdf") else {}
        figure.savefig(output, bbox_inches="tight", metadata=meta, dpi=150)
        if output.endswith(".svg"):
            _for_pages(output)
