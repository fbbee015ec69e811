#!/usr/bin/env bash
# Measures an experiment in a Slurm job array. Each task measures one shard, which is a part of the cases.
#   submit.sh RESULTS SHARDS EXPERIMENT [options of pelage run]   start a run
#   submit.sh RESULTS                                             submit lost and failed shards again
# RESULTS must be on a file system that all nodes share. Shard i writes into RESULTS/shard-i, and its log is
# RESULTS/logs/JOB_i.log. The environment variable PELAGE names the pelage program. sbatch reads its own variables, such
# as SBATCH_PARTITION, SBATCH_TIMELIMIT, SBATCH_CONSTRAINT and SBATCH_GPUS_PER_TASK. shard.sh contains --exclusive and
# the other default options of sbatch.
set -euo pipefail
scripts=$(dirname "$(realpath "$0")")
# shellcheck source-path=SCRIPTDIR source=common.sh
source "$scripts/common.sh"
(($# == 1 || $# >= 3)) || { sed -n '3,4s/^# *//p' "$0" >&2; exit 2; }

results=$(realpath -m "$1")
(($# == 1)) || record "$results" "${@:2}"
load "$results"

# All jobs of this run have the same name, by which squeue finds the tasks that wait or run.
name=pelage-$(cksum <<<"$results" | cut -d ' ' -f 1)
busy=$(squeue --noheader --array --me --name="$name" --format=%K)
missing=$(unfinished "$results")
tasks=$(grep -vxF "${busy:-none}" <<<"$missing" | grep . | paste -sd , || true)
if [[ -z $tasks ]]; then
  waiting=$(grep -c . <<<"$busy" || true)
  echo "submit.sh: $results: nothing to submit; $waiting of $shards shards are waiting or running, the others are" \
    "finished" >&2
  exit 0
fi
mkdir -p "$results/logs"
sbatch --parsable --job-name="$name" --array="$tasks" --chdir="$folder" \
  --output="$results/logs/%A_%a.log" "$scripts/shard.sh" "$results"
echo "submit.sh: submitted shards $tasks of $shards" >&2
