#!/usr/bin/env python3
"""Builds pelage with new and changed source files, without touching the source tree.

usage: changed_build.py SOURCE BUILD CHANGES

The folder CHANGES contains the new and changed files. A file's path relative to CHANGES is its path relative to SOURCE.
BUILD is a build folder of SOURCE. The script compiles the .cpp files of CHANGES with the compiler options of BUILD. If
BUILD compiles a changed file together with other files as one unit, the script compiles this unit with the changed
file. It links the program CHANGES/pelage from these object files and the libraries of BUILD. The linker finds the
object files before the libraries, so it uses the functions of the object files. A changed header may only add
declarations, because source files outside CHANGES are not compiled again.
"""
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path


def units_of(build):
    """Maps each source file to the entry of compile_commands.json that compiles it, alone or in a unit."""
    units = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = Path(entry["file"])
        if file.parent.name == "Unity":
            for included in re.findall(r'#include "(.*)"', file.read_text()):
                units[included] = entry
        else:
            units[str(file)] = entry
    return units


def main(source, build, changes):
    units = units_of(build)
    by_folder = {}
    for file, entry in units.items():
        by_folder.setdefault(Path(file).parent, entry)
    texts, options = {}, {}  # by object file: the text to compile, and the entry with the options
    for file in sorted(changes.rglob("*.cpp")):
        original = source / file.relative_to(changes)
        entry = units.get(str(original))
        if entry is None or entry["file"] == str(original):
            out, text = file.with_suffix(".o"), f'#include "{file}"\n'
        else:
            name = "_".join(Path(entry["file"]).relative_to(build).with_suffix(".o").parts)
            out = changes / name
            text = texts.get(out, Path(entry["file"]).read_text()).replace(f'"{original}"', f'"{file}"')
        texts[out], options[out] = text, entry or next(by_folder[p] for p in original.parents if p in by_folder)
    for out, text in texts.items():
        unit = out.with_suffix(".cxx")
        inputs = [file for file in changes.rglob("*.cpp") if f'"{file}"' in text]
        if out.exists() and unit.read_text() == text and all(
                out.stat().st_mtime >= file.stat().st_mtime for file in inputs):
            continue
        unit.write_text(text)
        words = shlex.split(options[out]["command"])
        words[words.index("-o") + 1] = str(out)
        words[words.index("-c") + 1] = str(unit)
        words.insert(1, f"-I{changes}")  # the compiler searches CHANGES before the source tree
        subprocess.run(words, cwd=options[out]["directory"], check=True)
    objects = [str(out) for out in texts]
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
