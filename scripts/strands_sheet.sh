#!/usr/bin/env bash
# Combines the pictures of a run of the experiment shells-vs-strands in docs/look/same-coat.jpg. The columns of the sheet
# show 16 layers, 64 layers, strands, a quarter of the strands, and a ray-cast picture of the strands as cones, which the
# script draws. The rows show the three distances. Pictures of the row far are cut to their middle quarter and enlarged.
#
# Usage: scripts/strands_sheet.sh RUN. RUN is the folder of the run. The environment variable PELAGE can name another
# pelage program.
set -euo pipefail
(($# == 1)) || { echo "usage: scripts/strands_sheet.sh RUN" >&2; exit 2; }
pictures=$(realpath "$1")/shells-vs-strands/images
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pelage=${PELAGE:-build/release/pelage}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

eye() { sed -n "/^\[distance\.$1\]/,/^camera\.eye/s/^camera\.eye = //p" experiments/shells-vs-strands.toml; }

oiiotool --create 2000x900 3 -d uint8 -o "$work/sheet.png"
y=0
for distance in near middle far; do
  "$pelage" render same-coat --pipeline strands-raycast --set "camera.eye=$(eye "$distance")" -o "$work/$distance-rays.png"
  cut=()
  [[ $distance == far ]] && cut=(--cut 200x150+300+225)
  x=0
  # The name of a picture contains the variant, but not shells-16, the first one.
  for picture in "$pictures/bunny-$distance.png" "$pictures/bunny-$distance"-{shells_64,strands,strands_quarter}.png \
    "$work/$distance-rays.png"; do
    oiiotool "$picture" --ch R,G,B "${cut[@]}" --resize 400x300 -o "$work/cell.png"
    oiiotool "$work/cell.png" "$work/sheet.png" --paste "+$x+$y" -o "$work/sheet.png"
    x=$((x + 400))
  done
  y=$((y + 300))
done
oiiotool "$work/sheet.png" --eraseattrib ".*" --nosoftwareattrib --compression jpeg:88 -o docs/look/same-coat.jpg
