#!/usr/bin/env bash
# Tests experiments/slurm with a real Slurm on this machine: scripts/slurm_check.sh FOLDER. The script runs 16 cases in
# an array of 4 tasks, kills one task and requeues it, deletes the results of another task and submits it again, merges
# the results of all tasks, and compares the rows with those of a single run. FOLDER must be empty or new. The exit code
# is 77 if Slurm is not installed. The environment variable PELAGE can name another pelage program.
set -euo pipefail
(($# == 1)) || { sed -n '2s/^# *//p' "$0" >&2; exit 2; }
mkdir -p "$1"
work=$(realpath "$1")
cd "$(dirname "$0")/.."
if [[ -z ${SLURM_CHECK_INSIDE:-} ]]; then
  [[ -z $(ls -A "$work") ]] || { echo "slurm_check: $work is not empty" >&2; exit 2; }
  SLURM_CHECK_INSIDE=yes exec scripts/slurm_here.sh "$work/slurm" "$PWD/scripts/slurm_check.sh" "$work"
fi

export PELAGE=${PELAGE:-build/release/pelage}
PELAGE=$(realpath "$PELAGE")
slurm=$PWD/experiments/slurm results=$work/results
arguments=(silva2010-table1 --preset smoke --axis 'layers=4,8,12,16,20,24,28,32')
say() { echo "-- $SECONDS s: $*"; }
fail() {
  echo "slurm_check: FAILED: $*" >&2
  tail -n 5 "$results"/logs/*.log >&2 || true
  exit 1
}
rows() { cat "$results/shard-$1"/silva2010-table1/*.jsonl 2>/dev/null | wc -l; }
# Waits until no task is left in the queue.
drained() {
  for ((i = 0; i < 3000; ++i)); do
    [[ -n $(squeue --noheader) ]] || return 0
    # Slurm delays a requeued task by up to two minutes. scontrol makes the task start now.
    squeue --noheader --array --states=PENDING --format='%i %r' | awk '$2 == "BeginTime" { print $1 }' |
      xargs -r -I '{}' scontrol update 'JobId={}' StartTime=now
    sleep 0.2
  done
  fail "the queue is not empty after 10 minutes"
}

say "an array of 4 tasks"
job=$("$slurm/submit.sh" "$results" 4 "${arguments[@]}")
say "kill shard 1 after its first row"
for ((i = 0; $(rows 1) == 0; ++i)); do
  ((i < 12000)) || fail "shard 1 has no row after 10 minutes"
  sleep 0.05
done
scancel --signal=KILL --batch "${job}_1"
for ((i = 0; i < 100; ++i)); do
  [[ $(squeue --noheader --array --format=%K) =~ (^|$'\n')1($|$'\n') ]] || break
  sleep 0.1
done
killed=$(rows 1)
((killed >= 1 && killed < 4)) || fail "shard 1 has $killed of 4 rows after it was killed"
say "requeue shard 1, which has $killed of 4 rows"
scontrol requeue "${job}_1"
drained
for i in 0 1 2 3; do (($(rows "$i") == 4)) || fail "shard $i has $(rows "$i") of 4 rows"; done

say "delete shard 2 and submit it again"
rm -r "$results/shard-2"
code=0
"$PELAGE" merge --dry-run "$work/none" "$results"/shard-* >"$work/missing.txt" 2>/dev/null || code=$?
((code == 4)) || fail "merge of 3 shards ends with exit code $code"
grep -qE $'\tshard 2/4: no rows$' "$work/missing.txt" || fail "merge does not name shard 2: $(cat "$work/missing.txt")"
(($(wc -l <"$work/missing.txt") == 1)) || fail "merge names other shards: $(cat "$work/missing.txt")"
"$slurm/submit.sh" "$results" 2>"$work/again.txt"
grep -q "submitted shards 2 of 4" "$work/again.txt" || fail "submit.sh: $(cat "$work/again.txt")"
"$slurm/submit.sh" "$results" 2>&1 | grep -q "nothing to submit" || fail "submit.sh submits a waiting shard twice"
drained
"$slurm/submit.sh" "$results" 2>&1 | grep -q "nothing to submit" || fail "submit.sh submits finished shards"

say "merge, and one run for comparison"
"$PELAGE" merge "$work/merged" "$results"/shard-* --expect "${arguments[@]}"
"$PELAGE" run "${arguments[@]}" --host here-bench -o "$work/single" 2>/dev/null >/dev/null
/usr/bin/python3 - "$work" "$killed" <<'PYTHON' || fail "the rows differ from those of a single run"
import collections, json, pathlib, sys

def rows(folder):
    files = sorted(pathlib.Path(sys.argv[1], folder).rglob("*.jsonl"))
    return files, [json.loads(line) for file in files for line in file.read_text().splitlines()]

def key(row):
    return (row["experiment"], row["case"], row["variant"], row["repeat"], row["device"], row["provenance"]["host"],
            json.dumps(row["overrides"], sort_keys=True))

merged_files, merged = rows("merged")
single_files, single = rows("single")
assert [f.name for f in merged_files] == [f.name for f in single_files], (merged_files, single_files)
assert len(single) == 16 and all(row["status"] == "ok" for row in single + merged)
assert collections.Counter(map(key, merged)) == collections.Counter(map(key, single)), "the keys differ"
of = {key(row): row for row in single}
for row in merged:
    for part in ("identity", "image_hash"):
        assert row[part] == of[key(row)][part], (row["case"], part)
shards = collections.defaultdict(collections.Counter)
for row in merged:
    shards[row["provenance"]["shard"]][row["run_id"]] += 1
assert sorted(shards) == ["0/4", "1/4", "2/4", "3/4"] and all(sum(s.values()) == 4 for s in shards.values()), shards
assert list(shards["1/4"].values()) == [int(sys.argv[2]), 4 - int(sys.argv[2])], shards["1/4"]
assert all(len(shards[i]) == 1 for i in ("0/4", "2/4", "3/4")), shards
pictures = [sorted(p.name for p in pathlib.Path(sys.argv[1], f).rglob("images/*.png")) for f in ("merged", "single")]
assert pictures[0] == pictures[1] and len(pictures[0]) == 16, pictures
PYTHON
"$PELAGE" run "${arguments[@]}" --host here-bench --resume "$work/merged" 2>&1 >/dev/null |
  grep -q "16 kept from the interrupted run" || fail "run --resume does not accept the merged folder"
echo "slurm_check: passed in $SECONDS s: 16 rows of 4 shards, one shard killed after $killed rows and requeued, one" \
  "deleted and submitted again; keys, identities and pictures equal those of a single run"
