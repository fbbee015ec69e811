#!/usr/bin/env bash
# Draws the picture of README.md, docs/look/pelage.jpg: layers, strands, wet fur and grass.
#
# Usage: scripts/readme_picture.sh. The environment variable PELAGE can name another pelage program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pelage=${PELAGE:-build/release/pelage}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Every picture is drawn at twice the size, cut to its middle and halved, so that its edges are smooth.
oiiotool --create 1760x480 3 -d uint8 -o "$work/sheet.png"
x=0
add() { # SCENE CUT [OPTION...]
  "$pelage" render "$1" --size 1280x960 -o "$work/$1.png" "${@:3}"
  oiiotool "$work/$1.png" --ch R,G,B --cut "$2" --resize 440x480 -o "$work/cell.png"
  oiiotool "$work/cell.png" "$work/sheet.png" --paste "+$x+0" -o "$work/sheet.png"
  x=$((x + 440))
}
add wavy 880x960+200+0
add monster 880x960+200+0 --pipeline strands
add wet 880x960+200+0
add grass 880x960+200+0
oiiotool "$work/sheet.png" --eraseattrib ".*" --nosoftwareattrib --compression jpeg:90 -o docs/look/pelage.jpg
