#!/usr/bin/env bash
# Times the cases of Table 1 of Silva et al. 2010 on this machine. The script then overwrites three things with the
# new results: the recorded rows in results/silva2010-table1/, the folder results/tables/table1/, and the tables that
# scripts/recorded_tables.py writes. Usage: scripts/record.sh [options of pelage run].
set -euo pipefail
cd "$(dirname "$0")/.."
command -v oiiotool >/dev/null || { echo "record.sh: oiiotool was not found; it makes the sheet of models: install openimageio-tools" >&2; exit 2; }
pelage=${PELAGE:-build/release/pelage}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$pelage" run silva2010-table1 --preset recorded --anonymous -o "$work/run" "$@" >"$work/folder"
mkdir -p results/silva2010-table1
cp "$work"/run/silva2010-table1/*.jsonl results/silva2010-table1/
"$pelage" report "$work/run" -o "$work/report" | sed 's/[[:blank:]]*$//' >"$work/table"
rm -rf results/tables/table1
mkdir -p results/tables/table1
cp "$work"/report/tables/silva2010-table1*.{csv,tex} "$work"/report/plots/silva2010-table1*-frame-time.{svg,pdf,csv,json} \
   results/tables/table1/
sed 's/[[:blank:]]*$//' "$work/report/provenance.txt" >results/tables/table1/provenance.txt

# Combines the pictures of the eight models in two rows of four.
models="torus pear hippo cow horse bunny elephant lion"
oiiotool --create 1600x600 3 -d uint8 -o "$work/sheet.png"
i=0
for model in $models; do
  oiiotool "$work/run/silva2010-table1/images/$model-64-800x600.png" --resize 400x300 -o "$work/one.png"
  # shellcheck disable=SC2017
  oiiotool "$work/one.png" "$work/sheet.png" --paste "+$((i % 4 * 400))+$((i / 4 * 300))" -o "$work/sheet.png"
  i=$((i + 1))
done
oiiotool "$work/sheet.png" --eraseattrib ".*" --nosoftwareattrib --compression jpeg:88 -o results/tables/table1/models.jpg

# Computes the covered fragments per second of every case from the recorded rows.
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
         $at["status"] == "ok" && $at["median_ms"] > 0 {
           rate = $at["covered_fragments"] / $at["median_ms"] * 1e-6
           if (!n || rate < low) low = rate; if (rate > high) high = rate; sum += log(rate); ++n }
         END { printf "%d cells; covered fragments (of all layers, visible or not) per second: %.3f to %.3f G, geometric mean %.3f G.\n", n, low, high, exp(sum / n) }' \
  results/tables/table1/silva2010-table1.csv >"$work/rate"
{ cat "$work/table"; echo; cat "$work/rate"; } >results/tables/table1/report.txt
scripts/recorded_tables.py
