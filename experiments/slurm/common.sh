# shellcheck shell=bash
# Functions of submit.sh and hosts.sh: they record the command of a run in RESULTS/command, and find the shards of this
# run that are not finished.

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
  # The dry run reports a mistake in the arguments now, so that not every shard reports it later. The dry run opens a
  # device. A login node may have no device (exit code 3); this is not a mistake.
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
  # shellcheck disable=SC2034  # submit.sh uses them
  program=${words[0]} folder=${words[1]} shards=${words[2]} arguments=("${words[@]:3}")
}

# unfinished RESULTS: prints the numbers of the shards that have no journal, and of the shards with cases without a row.
# A case that ended with an error counts as a case without a row. Call load first.
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
    # `pelage merge` prints one line per shard with missing rows: experiment, device, "shard 2/4: 5 of 8 cases". The
    # exit code is then 4.
    lines=$("$program" merge --dry-run "$results/merged" "${found[@]}" 2>"$results/merge.log") || code=$?
    ((code == 0 || code == 4)) || { cat "$results/merge.log" >&2; return "$code"; }
    mapfile -t -O "${#numbers[@]}" numbers < <(sed -n "s|.*\tshard \([0-9]*\)/$shards: .*|\1|p" <<<"$lines")
  fi
  ((${#numbers[@]} == 0)) || printf '%s\n' "${numbers[@]}" | sort -nu
}
