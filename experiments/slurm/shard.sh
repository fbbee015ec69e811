#!/usr/bin/env bash
# Measures one shard of the run in RESULTS: shard.sh RESULTS [INDEX]. A shard is a part of the cases of an experiment.
# Without INDEX, the script runs as a task of a Slurm array, and the number of the task is the number of the shard.
# submit.sh and hosts.sh call this script.
#
# If Slurm requeues a task, the task continues its shard: --resume keeps the finished cases and runs the others.
#
# The #SBATCH lines set default options of sbatch; environment variables such as SBATCH_PARTITION or SBATCH_TIMELIMIT
# override them.
#SBATCH --job-name=pelage
#SBATCH --nodes=1
#SBATCH --ntasks=1
# No other job may use the node: other jobs would change the measured times.
#SBATCH --exclusive
# After a node failure or a preemption, Slurm starts the task again and appends to the same log.
#SBATCH --requeue
#SBATCH --open-mode=append
# On nodes with GPUs, remove one # of the line below, or set the environment variable SBATCH_GPUS_PER_TASK=1. Each shard
# then sees one GPU.
##SBATCH --gpus-per-task=1
# To run several shards on a node with several GPUs, also replace --exclusive above by --cpus-per-task=N, where N is the
# number of the node's cores divided by the number of its GPUs.
set -euo pipefail

results=$1 index=${2:-$SLURM_ARRAY_TASK_ID}
# submit.sh or hosts.sh wrote RESULTS/command; common.sh describes its format. This script does not source common.sh,
# because Slurm runs a copy of this script in another folder.
mapfile -t words <"$results/command"
program=${words[0]} folder=${words[1]} shards=${words[2]} arguments=("${words[@]:3}")

# All nodes of a partition get the same host name in the results. Their rows are then in one table, and a task that
# Slurm requeues on another node continues the same journal (file of result rows). If the nodes of a partition differ,
# choose equal nodes with SBATCH_CONSTRAINT. `pelage run` refuses to continue a journal if the node has another driver
# than the journal's rows. `pelage merge` refuses to merge rows from different CPUs.
host=()
if [[ -n ${SLURM_JOB_PARTITION:-} && " ${arguments[*]} " != *" --host"[\ =]* ]]; then
  host=(--host "${SLURM_CLUSTER_NAME:-slurm}-$SLURM_JOB_PARTITION")
fi
cd "$folder"
mkdir -p "$results/shard-$index"
echo "shard $index of $shards on $(hostname), $(date -u +%Y-%m-%dT%H:%M:%SZ)"
# With exec, pelage receives the signals of scancel directly. pelage then ends at once and loses only the case in
# progress.
exec "$program" run "${arguments[@]}" "${host[@]}" --shard "$index/$shards" --resume "$results/shard-$index"
