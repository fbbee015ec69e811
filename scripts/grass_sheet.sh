#!/bin/sh
# Draws Figures 2, 6, 7, 8, 12 and 13 of Banisch and Wuethrich 2006 from the scenes of examples/ and combines them in
# docs/look/banisch2006.jpg. Each picture has 400 x 300 pixels.
#
#   Figure 2: (a) structure, (b) colour, (c) self-shadow, (d) diffuse shading.
#   Figure 6: (a) linear and (b) bent layers, after 2 s of simulation.
#   Figure 7: (a) without the return force, after 2 s of simulation; (b) with the return force, after 3 s.
#   Figure 8: (a) elephant, (b) dog, (c) grass. Figure 12: parted grass.
#   Figure 13: waving grass in steps of 0.2 s.
#
# The script also draws six frames of examples/grass-closing.toml as docs/look/grass-closing.jpg, Figures 3 to 5 (the
# mass-spring topologies on the square model banisch-grass) as docs/look/topologies.svg, and each model of Figure 8 in
# both readings, the paper's on the left, as docs/look/banisch2006-elephant.jpg, -dog.jpg and -grass.jpg.
# Usage: scripts/grass_sheet.sh [options of pelage render]. The environment variable PELAGE can name another pelage
# binary.
set -eu
cd "$(dirname "$0")/.."
pelage=${PELAGE:-build/release/pelage}
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT

# Draws the scene examples/SCENE.toml to the file PICTURE.png. Usage: draw PICTURE SCENE [options of pelage render]
draw() {
  picture=$1 scene=$2
  shift 2
  "$pelage" render "examples/$scene.toml" --size 400x300 -o "$pictures/$picture.png" "$@"
}

# Picture 04 is the lit elephant. Picture 03 has no light source. Picture 02 has neither light source nor self-shadow.
# Picture 01 has neither light source, self-shadow nor colour.
dark='shading.light=[{direction=[0.0,1.0,0.0],intensity=0.0}]'
draw 01 elephant --set "$dark" --set shading.ambient=0.9 --set shading.occlusion=0 --set coat.pattern=plain --set 'coat.colour=[1.0,1.0,1.0]' \
  "$@"
draw 02 elephant --set "$dark" --set shading.ambient=0.9 --set shading.occlusion=0 "$@"
draw 03 elephant --set "$dark" --set shading.ambient=0.9 "$@"
draw 04 elephant "$@"
draw 05 grass-return --set dynamics.bend=linear "$@"
draw 06 grass-return "$@"
draw 07 grass-return --set dynamics.springs.return_weight=0 "$@"
draw 08 grass-return --set dynamics.time=3 "$@"
draw 09 elephant "$@"
draw_dog() {
  picture=$1
  shift
  draw "$picture" elephant --model banisch-dog --set fur.layers=12 --set 'camera.direction=[1.3,0.8,2.35]' \
    --set 'shading.light=[{direction=[0.35,1.0,0.8],intensity=0.85}]' "$@"
}
draw_dog 10 "$@"
draw 11 grass-waving --set dynamics.wind.strength=0 "$@"
draw 12 grass-parting "$@"
number=12
for time in 0.2 0.4 0.6 0.8 1.0 1.2 1.4 1.6; do
  number=$((number + 1))
  draw $number grass-waving --set dynamics.time=$time "$@"
done

# Usage: sheet FILE.jpg COLUMNSxROWS PICTURE.png ...
sheet() {
  file=$1 shape=$2
  shift 2
  oiiotool "$@" --mosaic "$shape" --eraseattrib ".*" --nosoftwareattrib --compression jpeg:88 -o "docs/look/$file"
}

for reading in paper pelage; do
  draw elephant-$reading elephant --reading $reading "$@"
  draw_dog dog-$reading --reading $reading "$@"
  draw grass-$reading grass-waving --set dynamics.wind.strength=0 --reading $reading "$@"
done
for model in elephant dog grass; do
  sheet banisch2006-$model.jpg 2x1 "$pictures/$model-paper.png" "$pictures/$model-pelage.png"
done
# shellcheck disable=SC2046
sheet banisch2006.jpg 4x5 $(printf "$pictures/%s.png " $(seq -w 20))
for time in 0 0.3 0.7 1.1 1.5 4; do
  draw "closing-$time" grass-closing --set dynamics.time=$time "$@"
done
# shellcheck disable=SC2046
oiiotool $(printf "$pictures/closing-%s.png " 0 0.3 0.7 1.1 1.5 4) --mosaic 3x2 \
  --resize 960x480 --eraseattrib ".*" --nosoftwareattrib --compression jpeg:88 -o docs/look/grass-closing.jpg
"$pelage" topology banisch-grass --length 0.4 --draw docs/look/topologies.svg >/dev/null
