#!/usr/bin/env python3
"""Writes the film strip of the example scene monster.toml: python3 scripts/film_strip.py examples/monster-film.png

A film strip (docs/strands.md) is a picture with 8 columns from root to tip and one row per frame. Red is the
luminance and green the gloss, where 128 means 1. Blue is the transparency. The same arguments give the same
file."""
import random
import struct
import sys
import zlib

COLUMNS, FRAMES = 8, 24


def frame(draw):
    """Returns the (red, green, blue) bytes of one frame. `draw` is the generator of random numbers."""
    brightness, gloss = draw.uniform(0.8, 1.2), draw.choice([0.3, 0.6, 1.0, 1.9])
    band = draw.random() < 0.4  # a strand with a dark band, as guard hairs have
    middle = draw.uniform(0.45, 0.75)
    pixels = []
    for column in range(COLUMNS):
        t = column / (COLUMNS - 1)
        light = brightness * (0.6 + 0.5 * t)
        if band and abs(t - middle) < 0.12:
            light *= 0.55
        clear = 0.35 * t * t * draw.uniform(0.5, 1)
        values = (128 * light, 128 * gloss * (0.4 + 0.6 * t), 255 * clear)
        pixels.append(tuple(min(255, max(0, round(v))) for v in values))
    return pixels


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(rows):
    """Returns the bytes of a PNG file with 8 bits per channel. `rows` are lists of (red, green, blue)."""
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    lines = b"".join(b"\0" + bytes(v for pixel in row for v in pixel) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) +
            chunk(b"IEND", b""))


def main():
    draw = random.Random(5)
    with open(sys.argv[1], "wb") as file:
        file.write(png([frame(draw) for _ in range(FRAMES)]))


if __name__ == "__main__":
    main()
