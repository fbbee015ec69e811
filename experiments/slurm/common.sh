# shellcheck shell=bash
# Functions for submit.sh and hosts.sh. They record the command of a run in RESULTS/command, and find the unfinished
# shards of the run. A shard is a part of the cases of an experiment.

fail() { echo "${0##*/}: $*" >&2; exit 2; }

# record RESULTS SHARDS ARGUMENT...: writes RESULTS/command, one word per line: the program, the working folder, the
# number of shards, and the arguments of `pelage run`. All shards run this command, including shards that are submitted
# again later.
record() {
  local results=$1 shards=$2 program
  shift 2
  [[ $shards =~ ^[1-9][0-9]{0,4}$ ]] || fail "'$shards' is not a number of shards from 1 to 99999"
  [[ ! -e $results/command ]] ||
    fail "$results: contains a run; without further arguments this script submits its unfinished shards again"
  program=$(command -v "${PELAGE:-pelage}") || fail "${PELAGE:-pelage}: no such program; set PELAGE to the binary"
  program=$(realpath "$program")
  # The dry run finds mistakes in the arguments before any shard starts. The dry run opens an OpenCL device. A login
  # node may have no OpenCL device. The dry run then exits with code 3, which is not an error here.
  local code=0 message
  message=$("$program" run "$@" --shard "0/$shards" --dry-run 2>&1 >/dev/null) || code=$?
  ((code == 0 || code == 3)) || { echo "$message" >&2; exit "$code"; }
  mkdir -p "$results"
  printf '%s\n' "$program" "$PWD" "$shards" "$@" >"$results/command"
}

# load RESULTS: sets the variables program, folder, shards and arguments from RESULTS/command.
load() {
  [[ -r $1/command ]] || fail "$1: contains no run; give also the number of shards and an experiment"
  local words
  mapfile -t words <"$1/command"
  # shellcheck disable=SC2034  # submit.sh uses these variables
  program=${words[0]} folder=${words[1]} shards=${words[2]} arguments=("${words[@]:3}")
}

# unfinished RESULTS: prints the numbers of the unfinished shards. A shard is unfinished if it has no journal (file of
# result rows), or if the row of one of its cases is missing or has the status `error`. Call load first.
unfinished() {
  local results=$1 i found=() numbers=() lines code=0
  for ((i = 0; i < shards; ++i)); do
    if [[ -n $(find "$results/shard-$i" -name '*.jsonl' -print -quit 2>/dev/null) ]]; then
      found+=("$results/shard-$i")
    else
      numbers+=("$i")
    fi
  done
  if ((${#found[@]} > 0)); then
    # If rows are missing, `pelage merge` exits with code 4. The command prints one line for each unfinished shard, with
    # the experiment, the device and a text such as "shard 2/4: 5 of 8 cases".
    lines=$("$program" merge --dry-run "$results/merged" "${found[@]}" 2>"$results/merge.log") || code=$?
    ((code == 0 || code == 4)) || { cat "$results/merge.log" >&2; return "$code"; }
    mapfile -t -O "${#numbers[@]}" numbers < <(sed -n "s|.*\tshard \([0-9]*\)/$shards: .*|\1|p" <<<"$lines")
  fi
  ((${#numbers[@]} == 0)) || printf '%s\n' "${numbers[@]}" | sort -nu
}
