#!/usr/bin/env bash
# Records the results of this machine that results/ holds: runs all experiments whose rows the documents and the claims
# use, and then writes the rows, tables and plots in results/, the verdicts in results/claims.md, and the tables that
# scripts/recorded_tables.py writes. The machine must run nothing else. The script takes about four hours on two cores.
#
# Usage: scripts/record_all.sh FOLDER
# FOLDER receives the runs. If the script is stopped, the same command continues after the last complete part.
#   PELAGE=PROGRAM: the program to run (default build/release/pelage). Use an installed copy if the source tree changes
#                   during the recording, because a program in the build folder reads the kernels of the source tree.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
(($# == 1)) || { echo "usage: scripts/record_all.sh FOLDER" >&2; exit 2; }
export PELAGE=${PELAGE:-build/release/pelage}
runs=$1
mkdir -p "$runs"

# A part is a command whose results lie in the folder NAME of FOLDER. The file NAME.done says that the part is complete.
# A complete part is not run again. Usage: part NAME COMMAND...
part() {
  local name=$1
  shift
  [[ ! -e $runs/$name.done ]] || return 0
  echo "$(date +%H:%M:%S) $name" >&2
  rm -rf "${runs:?}/$name"
  "$@"
  touch "$runs/$name.done"
}

# Runs experiments into the folder of a part: measure NAME EXPERIMENT... OPTION...
# If the variable `under` is set, its value is a script that runs pelage.
# The exit code is 1 if a picture fails its check. The row of such a case has the status `failed-check`, and the claims
# do not use the row.
measure() {
  local name=$1 code=0
  shift
  "${under:-env}" "$PELAGE" run "$@" --anonymous -o "$runs/$name" >/dev/null || code=$?
  ((code <= 1))
}
record() { part "$1" measure "$@"; }

# Copies the rows of the folders RESULTS to results/, or to the folder $rows, and writes their tables and plots to the
# folder FOLDER, which it deletes first. Usage: publish FOLDER RESULTS...
publish() (
  tables=$1 rows_in=${rows:-results}
  shift
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  "$PELAGE" report "$@" -o "$work/report" 2>"$work/said" | sed 's/[[:blank:]]*$//' >"$work/report.txt"
  for folder in "$@"; do
    find "$folder" -name '*.jsonl' -printf '%h\n' | sort -u | while read -r place; do
      rm -rf "${rows_in:?}/$(basename "$place")"
    done
  done
  for folder in "$@"; do
    # Two folders RESULTS may contain .jsonl files of the same name, with rows of the same experiment and device. The
    # copies get different names, so that no file is overwritten.
    find "$folder" -name '*.jsonl' | sort | while read -r file; do
      place=$rows_in/$(basename "$(dirname "$file")")
      mkdir -p "$place"
      name=$(basename "$file" .jsonl) part=1
      while [[ -e $place/$name$([[ $part = 1 ]] || echo "-$part").jsonl ]]; do part=$((part + 1)); done
      cp "$file" "$place/$name$([[ $part = 1 ]] || echo "-$part").jsonl"
    done
  done
  rm -rf "$tables"
  mkdir -p "$tables"
  cp "$work"/report/plots/*.{svg,pdf} "$tables/"
  find "$work/report/tables" \( -name '*.csv' -o -name '*.txt' \) -exec cp {} "$tables/" \;
  rm -f "$tables/all-phases.csv" # not recorded, because it can be rebuilt from the rows
  sed 's/[[:blank:]]*$//' "$work/report/provenance.txt" >"$tables/provenance.txt"
  cp "$work/report.txt" "$tables/report.txt"
)

# Combines the pictures of the experiment shells-vs-strands in docs/look/same-coat.jpg. The columns of the sheet show
# 16 layers, 64 layers, strands, a quarter of the strands, and a ray-cast picture of the strands as cones. The rows show
# the three distances. Pictures of the row far are cut to their middle quarter and enlarged.
strands_sheet() (
  pictures=$runs/strands/shells-vs-strands/images
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  eye() { sed -n "/^\[distance\.$1\]/,/^camera\.eye/s/^camera\.eye = //p" experiments/shells-vs-strands.toml; }
  oiiotool --create 2000x900 3 -d uint8 -o "$work/sheet.png"
  y=0
  for distance in near middle far; do
    "$PELAGE" render same-coat --pipeline strands-raycast --set "camera.eye=$(eye "$distance")" -o "$work/$distance-rays.png"
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
)

# Experiments whose times decide claims run in three processes, so that the claims use the measured difference between
# processes.
part table1 scripts/record.sh --repeat 3
record wet wetfur2010-table1 --preset recorded --repeat 3
record water wetfur2010-water --repeat 3
record layers layers --repeat 3
record update-time banisch2006-{update-time,equal-steps,layers} --repeat 3
record earlier-methods banisch2006-earlier-methods --repeat 3
record topologies topology-table1 --repeat 3
record solvers topology-solvers
record substeps topology-solvers --axis dynamics.substeps=16 --filter \
  '^(bunny|elephant)-.*(sticks|prisms)(-16)?$|^(bunny|elephant)-(.*sticks|separable.*)-16-backward_euler'
record springs banisch2006-{work-precision,longest-step,energy,mesh-size,lean}
record studies topology-{steps,equal-error,jacobian,drift,parting,mesh-scaling}
record strands shells-vs-strands demoreuille2011-{lod,scaling,switches,full} --repeat 3
record ways strands-opengl-ways
for preset in quick beyond millions; do record "scaling-$preset" scaling --preset "$preset"; done
record rivals rivals --repeat 3
record strongest rivals-strongest
under=scripts/without_avx512.sh record avx2 rivals rivals-strongest
record rivals-tori rivals-tori --repeat 3
record rival-options rival-options
record overheads overheads --repeat 3
record self-shadow silva2010-self-shadow --repeat 3
record readings readings --preset paper
record depth readings --filter depth
part profile "$PELAGE" profile -o "$runs/profile"
part profile-strands "$PELAGE" profile demoreuille2011-scaling --filter '^bunny-(100000-800x600|1000000-1680x1050)-near$' -o "$runs/profile-strands"

publish results/tables/wet "$runs"/{wet,water}
publish results/tables/topology "$runs"/{update-time,earlier-methods,topologies,solvers,substeps,springs,studies}
publish results/tables/rivals "$runs"/{rivals,strongest,rivals-tori,rival-options}
rows=results/avx2 publish results/tables/rivals-avx2 "$runs/avx2"
publish results/tables/effects "$runs"/{overheads,self-shadow,readings,depth}
publish results/tables/strands "$runs"/{strands,ways}
strands_sheet
publish results/tables/scaling "$runs"/{layers,scaling-quick,scaling-beyond,scaling-millions}
for end in csv svg pdf; do cp "$runs/profile/profile.$end" "results/tables/profile/shells.$end"; done
for end in csv svg pdf; do cp "$runs/profile-strands/profile.$end" "results/tables/profile/strands.$end"; done
verdicts=$("$PELAGE" claims results --markdown)
head=$(sed '/^| claim /,$d' results/claims.md)
printf '%s\n\n%s\n' "$head" "$verdicts" >results/claims.md
scripts/recorded_tables.py
