#!/usr/bin/env bash
# Measures one shard of the run in RESULTS: shard.sh RESULTS [INDEX]. Without INDEX the script is a task of a Slurm
# array, and the number of the task is the number of the shard. submit.sh and hosts.sh call this script.
#
# A requeued task continues the shard: --resume keeps the finished cases, and runs the others.
#
# #SBATCH lines set the defaults of sbatch; variables such as SBATCH_PARTITION or SBATCH_TIMELIMIT override them.
#SBATCH --job-name=pelage
#SBATCH --nodes=1
#SBATCH --ntasks=1
# No other job may use the node: other jobs would change the measured times.
#SBATCH --exclusive
# Slurm starts the task again after a failure of the node or a preemption, and keeps the first part of the log.
#SBATCH --requeue
#SBATCH --open-mode=append
# On nodes with GPUs remove one # in the next line, or set SBATCH_GPUS_PER_TASK=1. Each shard then sees one GPU. To run
# several shards on a node with several GPUs, replace --exclusive above by --cpus-per-task=N, with N = cores / GPUs.
##SBATCH --gpus-per-task=1
set -euo pipefail

results=$1 index=${2:-$SLURM_ARRAY_TASK_ID}
# submit.sh or hosts.sh wrote this file; common.sh describes it. This script does not source common.sh, because Slurm
# runs a copy of this script in another folder.
mapfile -t words <"$results/command"
program=${words[0]} folder=${words[1]} shards=${words[2]} arguments=("${words[@]:3}")

# The nodes of a partition count as one host: their rows are in one table, and a task that is requeued on another node
# continues the same journal. If the nodes of a partition differ, choose equal nodes with SBATCH_CONSTRAINT. pelage
# refuses to continue a journal with another driver, and pelage merge refuses rows of different CPUs.
host=()
if [[ -n ${SLURM_JOB_PARTITION:-} && " ${arguments[*]} " != *" --host"[\ =]* ]]; then
  host=(--host "${SLURM_CLUSTER_NAME:-slurm}-$SLURM_JOB_PARTITION")
fi
cd "$folder"
mkdir -p "$results/shard-$index"
echo "shard $index of $shards on $(hostname), $(date -u +%Y-%m-%dT%H:%M:%SZ)"
# With exec, pelage receives the signals of scancel directly. It then ends at once and loses only the case in progress.
exec "$program" run "${arguments[@]}" "${host[@]}" --shard "$index/$shards" --resume "$results/shard-$index"
