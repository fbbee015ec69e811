#!/usr/bin/env bash
# Records results of a machine: copies the rows to results/ and writes tables, charts and claims to FOLDER, such as
# results/tables/rivals.
# Usage: scripts/record_report.sh FOLDER RESULTS... Each RESULTS is a folder that `pelage run` wrote.
# The script first deletes FOLDER. The environment variable ROWS can name another folder than results/ for the rows.
#
# scripts/record_all.sh contains the commands that recorded results/, and calls this script.
set -euo pipefail
cd "$(dirname "$0")/.."
(($# > 1)) || { sed -n 's/^# //p' "$0" | head -3 >&2; exit 2; }
pelage=${PELAGE:-build/release/pelage}
tables=$1
rows_in=${ROWS:-results}
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$pelage" report "$@" -o "$work/report" 2>"$work/said" | sed 's/[[:blank:]]*$//' >"$work/report.txt"
for folder in "$@"; do
  find "$folder" -name '*.jsonl' -printf '%h\n' | sort -u | while read -r place; do
    rm -rf "${rows_in:?}/$(basename "$place")"
  done
done
for folder in "$@"; do
  # Two folders RESULTS may contain .jsonl files of the same name, with rows of the same experiment and device. The
  # script gives the copies different names, so that it overwrites no file.
  find "$folder" -name '*.jsonl' | sort | while read -r rows; do
    place=$rows_in/$(basename "$(dirname "$rows")")
    mkdir -p "$place"
    name=$(basename "$rows" .jsonl) part=1
    while [[ -e $place/$name$([[ $part = 1 ]] || echo "-$part").jsonl ]]; do part=$((part + 1)); done
    cp "$rows" "$place/$name$([[ $part = 1 ]] || echo "-$part").jsonl"
  done
done
rm -rf "$tables"
mkdir -p "$tables"
cp "$work"/report/plots/*.{svg,pdf} "$tables/"
find "$work/report/tables" \( -name '*.csv' -o -name '*.txt' \) -exec cp {} "$tables/" \;
rm -f "$tables/all-phases.csv" # not recorded, because it can be rebuilt from the rows
sed 's/[[:blank:]]*$//' "$work/report/provenance.txt" >"$tables/provenance.txt"
cp "$work/report.txt" "$tables/report.txt"
