#!/usr/bin/env bash
# Keeps what a machine found of the mass-spring topologies: rows under results/, and their report's tables, charts and
# claims under docs/topology/. Usage: scripts/record_topologies.sh RESULTS..., folders that these commands wrote, about 40
# minutes on two cores; an earlier recording is replaced:
#   pelage run topology-table1 topology-solvers --anonymous -o RESULTS
#   pelage run topology-solvers --anonymous --axis dynamics.substeps=16 -o RESULTS16 --filter \
#     '^(bunny|elephant)-.*(sticks|prisms)(-16)?$|^(bunny|elephant)-(.*sticks|separable.*)-16-backward_euler'
#   pelage run banisch2006-{update-time,work-precision,longest-step,energy,mesh-size} --anonymous -o RESULTS
set -euo pipefail
cd "$(dirname "$0")/.."
(($# > 0)) || { sed -n 's/^# //p' "$0" | head -3 >&2; exit 2; }
pelage=${PELAGE:-build/release/pelage}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$pelage" report "$@" -o "$work/report" 2>"$work/said" | sed 's/[[:blank:]]*$//' >"$work/report.txt"
for folder in "$@"; do
  find "$folder" -name '*.jsonl' -printf '%h\n' | sort -u | while read -r place; do
    rm -rf "results/$(basename "$place")"
  done
done
for folder in "$@"; do
  # The same experiment may have been run in parts: one file each.
  find "$folder" -name '*.jsonl' | sort | while read -r rows; do
    place=results/$(basename "$(dirname "$rows")")
    mkdir -p "$place"
    name=$(basename "$rows" .jsonl) part=1
    while [[ -e $place/$name$([[ $part = 1 ]] || echo "-$part").jsonl ]]; do part=$((part + 1)); done
    cp "$rows" "$place/$name$([[ $part = 1 ]] || echo "-$part").jsonl"
  done
done
rm -rf docs/topology
mkdir -p docs/topology
cp "$work"/report/plots/*.{svg,pdf} docs/topology/
cp "$work"/report/tables/*.csv docs/topology/
rm -f docs/topology/all-phases.csv # in the rows, and made anew by any report
sed 's/[[:blank:]]*$//' "$work/report/provenance.txt" >docs/topology/provenance.txt
cp "$work/report.txt" docs/topology/report.txt
