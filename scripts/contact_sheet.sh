#!/bin/sh
# Draws seven scenes of examples/ at 800 x 600 and combines the pictures in docs/look/contact_sheet.jpg. Each scene is
# drawn twice: with 64 layers, and with 16 layers and four sub-steps. The upper two rows of the sheet show the scenes
# straight, wavy, large-curls and small-curls. The lower two rows show the scenes dry, wet and grass. The fur has 64
# layers in rows 1 and 3, and 16 layers in rows 2 and 4.
#
# Usage: scripts/contact_sheet.sh [options of pelage render]. The environment variable PELAGE can name another
# pelage binary.
set -eu
cd "$(dirname "$0")/.."
pelage=${PELAGE:-build/release/pelage}
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT

looks="straight wavy large-curls small-curls dry wet grass"
for layers in 64 16; do
  for look in $looks; do
    set_few=
    # With 16 layers, each fragment takes four samples between its layer and the layer below. If curls are
    # wide or blades are strongly bent, a strand moves too far sideways from one layer to the next, even with four
    # samples. Further options therefore make the curls narrower and the blades straighter.
    [ "$layers" = 16 ] && set_few="--set fur.substeps=4"
    [ "$layers $look" = "16 grass" ] && set_few="$set_few --set fur.sweep=0.25 --set fur.bend=12"
    [ "$layers $look" = "16 large-curls" ] && set_few="$set_few --set curl.radius=0.032 --set curl.turns=1.1"
    # shellcheck disable=SC2086
    "$pelage" render "examples/$look.toml" --size 800x600 --set fur.layers=$layers $set_few \
      -o "$pictures/$layers-$look.png" "$@"
  done
done

# Each row of the sheet is 2000 pixels wide. The pictures of straight, wavy, large-curls and small-curls are cut to a
# width of 500 pixels, and those of dry and wet to 600 pixels. The picture of grass keeps its width of 800 pixels.
cut() { oiiotool "$pictures/$1.png" --cut "$2" -o "$pictures/$1-cut.png"; }
place() { oiiotool "$pictures/$1-cut.png" "$pictures/sheet.png" --paste "$2" -o "$pictures/sheet.png"; }
oiiotool --create 2000x2320 3 -d uint8 -o "$pictures/sheet.png"
y=0
for layers in 64 16; do
  x=0
  for look in straight wavy large-curls small-curls; do
    cut $layers-$look 500x580+150+10
    place $layers-$look +$x+$y
    x=$((x + 500))
  done
  cut $layers-dry 600x580+100+10
  cut $layers-wet 600x580+100+10
  cut $layers-grass 800x580+0+10
  place $layers-dry +0+$((y + 1160))
  place $layers-wet +600+$((y + 1160))
  place $layers-grass +1200+$((y + 1160))
  y=$((y + 580))
done
oiiotool "$pictures/sheet.png" --eraseattrib ".*" --nosoftwareattrib --compression jpeg:88 -o docs/look/contact_sheet.jpg
