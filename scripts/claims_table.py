#!/usr/bin/env python3
"""Writes the table in docs/claims.md that gives the verdict on each claim, from the recorded rows of results/.

Two HTML comments of the document enclose the table. Run the script after new rows were recorded, or after
experiments/claims.toml changed. The test cli.Claims fails if the table differs from the verdicts on these rows.

Usage: scripts/claims_table.py [PELAGE]
PELAGE is the path of the program pelage; the default is build/release/pelage.
"""
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- claims begin: scripts/claims_table.py writes what stands here -->\n", "<!-- claims end -->\n"


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/pelage")
    document = ROOT / "docs/claims.md"
    table = subprocess.run([program, "claims", str(ROOT / "results"), "--markdown"], check=True,
                           stdout=subprocess.PIPE, text=True).stdout
    text = document.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    document.write_text(before + BEGIN + table + END + after, encoding="utf-8")


if __name__ == "__main__":
    main()
