#!/usr/bin/env bash
# Builds the fuzz targets of tests/fuzz with clang, runs each for SECONDS, and prints the number of executions and of
# findings (inputs that cause an error, in build/fuzz/findings), with which the exit code is 1. The fuzzer starts from the
# inputs in tests/fuzz/corpus/TARGET, which the tests run too, except slow-*, whose execution takes seconds; and from the
# files of examples/ and experiments/.
#
# Usage: scripts/fuzz.sh SECONDS [TARGET...]
#   PELAGE_FUZZ_JOBS=N: runs N targets at a time (default 2)
#   PELAGE_FUZZ_SEED=N: the seed of libFuzzer's random numbers (default 0: another seed in each run)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/fuzz
seconds=${1:-}
[[ $seconds =~ ^[1-9][0-9]{0,5}$ ]] || { echo "usage: scripts/fuzz.sh SECONDS [TARGET...]" >&2; exit 2; }
shift
targets=("$@")
if ((${#targets[@]} == 0)); then
  for folder in tests/fuzz/corpus/*/; do targets+=("$(basename "$folder")"); done
fi
for target in "${targets[@]}"; do
  [[ -d tests/fuzz/corpus/$target ]] || { echo "fuzz: no target $target; see tests/fuzz/corpus" >&2; exit 2; }
done
[[ -e $build/build.ninja ]] || cmake --preset fuzz >&2
cmake --build "$build" --parallel "$(nproc)" --target "${targets[@]/#/fuzz_}" >&2
mkdir -p "$build/findings" "$build/logs"

# Prints the dictionary of a target: the words of a file tests/fuzz/*.dict, and the words in quotation marks in the sources
# of the target's parser, alone, in quotation marks and in brackets.
# shellcheck disable=SC2317  # run_one calls this function
words_of() {
  local file=$1 sources=(/dev/null)
  case $1 in
    claims) file=toml sources=(harness/claims/claim_*.cpp) ;;
    experiment) file=toml sources=(harness/experiment/*.cpp) ;;
    journal) sources=(harness/record/*.cpp harness/measure/*.cpp) ;;
    models) file=toml sources=(harness/mesh/models.cpp) ;;
    scene | set) file=toml sources=(harness/scene/*.cpp) ;;
    tuning) file=toml sources=(harness/tuning/tuning.cpp) ;;
  esac
  [[ ! -e tests/fuzz/$file.dict ]] || cat "tests/fuzz/$file.dict"
  grep -ohE '"[A-Za-z_][A-Za-z0-9_.-]*"' "${sources[@]}" | tr -d '"' | sed 'p; s/\./\n/g' | grep . | sort -u |
    sed 's/.*/"&"\n"\\"&\\""\n"[&]"/'
}

# Runs one target. The new inputs that libFuzzer finds stay in build/fuzz/new, so a later run continues with them.
# shellcheck disable=SC2317  # xargs calls this function
run_one() {
  local build=$1 seconds=$2 target=$3 options=() log executions findings
  log=$build/logs/$target.log
  mkdir -p "$build/new/$target"
  rm -rf "$build/seeds/$target" && mkdir -p "$build/seeds/$target"
  find "tests/fuzz/corpus/$target" -type f -not -name 'slow-*' -exec cp -t "$build/seeds/$target" {} +
  case $target in
    scene) cp examples/*.toml "$build/seeds/$target" ;;
    experiment) cp experiments/silva2010-*.toml "$build/seeds/$target" ;;
    claims | models) cp "experiments/$target"*.toml "$build/seeds/$target" ;;
  esac
  words_of "$target" >"$build/seeds/$target.dict"
  [[ ! -s $build/seeds/$target.dict ]] || options+=("-dict=$build/seeds/$target.dict")  # an empty one is an error
  "$build/tests/fuzz/fuzz_$target" -seed="${PELAGE_FUZZ_SEED:-0}" -max_total_time="$seconds" -timeout=60 \
    -rss_limit_mb=2048 -max_len=8192 -print_final_stats=1 -artifact_prefix="$build/findings/$target-" \
    "${options[@]}" "$build/new/$target" "$build/seeds/$target" >"$log" 2>&1 </dev/null && findings=0 || findings=1
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  printf '%-12s %12s executions  %d findings\n' "$target" "${executions:-no}" "$findings"
  ((findings == 0)) || { grep -m1 -E 'ERROR: |runtime error|terminate called' "$log" || tail -n 5 "$log"; return 1; }
}
export -f words_of run_one
status=0
# shellcheck disable=SC2016  # the inner bash expands $@
printf '%s\n' "${targets[@]}" |
  xargs -P "${PELAGE_FUZZ_JOBS:-2}" -n 1 bash -c 'run_one "$@"' fuzz "$build" "$seconds" || status=1
((status == 0)) || echo "fuzz: there are findings; their inputs are in $build/findings, their logs in $build/logs"
exit "$status"
