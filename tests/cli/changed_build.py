#!/usr/bin/env python3
"""Builds pelage with new and changed source files, without touching the source tree.

usage: changed_build.py SOURCE BUILD CHANGES

The folder CHANGES contains the new and changed files. A file's path relative to CHANGES is its path relative to SOURCE.
BUILD is a build folder of SOURCE. The script compiles the .cpp files of CHANGES with the compiler options of BUILD. It
links the program CHANGES/pelage from these object files and the libraries of BUILD. The linker finds the
object files before the libraries, so it uses the functions of the object files. A changed header may only add
declarations, because source files outside CHANGES are not compiled again.
"""
import json
import shlex
import subprocess
import sys
from pathlib import Path


def main(source, build, changes):
    commands = json.loads((build / "compile_commands.json").read_text())
    by_folder = {}
    for entry in commands:
        by_folder.setdefault(Path(entry["file"]).parent, entry)
    by_file = {entry["file"]: entry for entry in commands}
    objects = []
    for file in sorted(changes.rglob("*.cpp")):
        original = source / file.relative_to(changes)
        entry = by_file.get(str(original)) or by_folder[original.parent]
        words = shlex.split(entry["command"])
        out = file.with_suffix(".o")
        words[words.index("-o") + 1] = str(out)
        words[words.index("-c") + 1] = str(file)
        words.insert(1, f"-I{changes}")  # the compiler searches CHANGES before the source tree
        objects.append(str(out))
        if not out.exists() or out.stat().st_mtime < file.stat().st_mtime:
            subprocess.run(words, cwd=entry["directory"], check=True)
    link = subprocess.run(["ninja", "-C", build, "-t", "commands", "pelage"], check=True, capture_output=True, text=True)
    words = shlex.split(link.stdout.strip().split("\n")[-1])
    words = words[words.index("&&") + 1:]
    if "&&" in words:
        words = words[:words.index("&&")]
    out = words.index("-o") + 1
    words[out:out + 1] = [str(changes / "pelage"), *objects]
    subprocess.run(words, cwd=build, check=True)


if __name__ == "__main__":
    main(*(Path(path).resolve() for path in sys.argv[1:4]))
