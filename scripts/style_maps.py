#!/usr/bin/env python3
"""Writes the maps of the example scene style.toml: python3 scripts/style_maps.py examples

The maps (docs/shells.md, section 8) are grey pictures in the UV space of the torus, where u runs around the axis and v around the
tube. They repeat in u and v. The same arguments give the same files."""
import math
import pathlib
import sys

from film_strip import png

WIDTH, HEIGHT = 96, 48


def smoothstep(low, high, x):
    t = min(1, max(0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def length(u, v):
    """A mane: long fur along three bands that wind around the tube, short fur between them."""
    return 0.3 + 0.7 * smoothstep(-0.2, 0.7, math.cos(2 * math.pi * (3 * u + v)))


def curls(u, v):
    """Curls in the long fur only."""
    return smoothstep(0.3, 1.0, length(u, v))


def turns(u, _):
    """Tight curls on one side of the torus, loose curls on the other."""
    return 0.35 + 0.65 * (0.5 + 0.5 * math.cos(2 * math.pi * u))


def density(u, v):
    """Round thin patches in the short fur."""
    patch = math.cos(2 * math.pi * (3 * u + v + 0.5)) + 0.6 * math.cos(2 * math.pi * (2 * v - 3 * u))
    return 1 - 0.85 * smoothstep(0.6, 1.2, patch)


def comb(u, v):
    """Short fur lies flat, long fur stands."""
    return 1 - 0.7 * curls(u, v)


def main():
    folder = pathlib.Path(sys.argv[1])
    for name, value in (("length", length), ("curls", curls), ("turns", turns), ("density", density), ("comb", comb)):
        rows = []
        for y in range(HEIGHT):
            v = 1 - (y + 0.5) / HEIGHT
            grey = [round(255 * value((x + 0.5) / WIDTH, v)) for x in range(WIDTH)]
            rows.append([(g, g, g) for g in grey])
        (folder / f"style-{name}.png").write_bytes(png(rows))


if __name__ == "__main__":
    main()
