#!/usr/bin/env bash
# Runs pelage's checks and timings on a machine with a GPU, and stores the results in one folder with their provenance.
# Usage: scripts/gpu_check.sh FOLDER [DEVICE [PRESET]]. DEVICE is a value of --device (default: the first GPU).
# PRESET is the value of --preset (default: quick). The variable PELAGE can name another binary. The script installs
# nothing and changes no device settings. If a step fails, the next steps still run. The last line names failed steps.
set -uo pipefail
cd "$(dirname "$0")/.." || exit
if (($# < 1 || $# > 3)); then
  sed -n 's/^# //p' "$0" | sed -n 2,4p >&2
  exit 2
fi
out=$1 device=${2:-} preset=${3:-quick}
pelage=${PELAGE:-build/release/pelage}
[[ -x $pelage ]] || { echo "gpu_check: there is no $pelage; build it, or set PELAGE to another binary" >&2; exit 2; }
mkdir -p "$out"
if [[ -n $(ls -A "$out") ]]; then
  echo "gpu_check: $out is not empty" >&2
  exit 2
fi
on=()
[[ -z $device ]] || on=(--device "$device")

failed=()
# Runs one step: step NAME COMMAND... Stores the command's standard output as NAME.txt, its standard error as NAME.err.
step() {
  local name=$1 from=$SECONDS
  shift
  echo "-- $name: $*"
  if "$@" >"$out/$name.txt" 2>"$out/$name.err"; then
    echo "   done in $((SECONDS - from)) s"
  else
    failed+=("$name")
    echo "   FAILED, see $out/$name.txt and .err"
    tail -n 3 "$out/$name.err" | sed 's/^/   /'
  fi
}

{
  date -u +%Y-%m-%dT%H:%M:%SZ
  uname -srm
  "$pelage" --version
  git rev-parse HEAD 2>/dev/null
  git status --short 2>/dev/null
  nvidia-smi 2>/dev/null
} >"$out/provenance.txt"

# Every step draws first with the device's own default mapping. The steps that decide whether the device is usable come
# first, the longest steps last, so that a run that is ended early has shown most.
step devices "$pelage" devices --measure
step check-torus "$pelage" check --filter '^torus' "${on[@]}"
timed() {
  local name=$1
  shift
  step "$name" "$pelage" run "$@" --anonymous "${on[@]}" -o "$out/$name"
  step "report-$name" "$pelage" report "$out/$name" -o "$out/report-$name"
}
timed table1 silva2010-table1 --preset "$preset"
timed rivals rivals --preset "$preset"
step check "$pelage" check "${on[@]}"
timed table1-pixel silva2010-table1 --preset "$preset" --mapping pixel
step mappings "$pelage" compare "$out/table1" "$out/table1-pixel" --by variant

if ((${#failed[@]})); then
  echo "gpu_check: FAILED: ${failed[*]}"
  exit 1
fi
echo "gpu_check: all steps passed; results in $out"
