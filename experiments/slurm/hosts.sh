#!/usr/bin/env bash
# Measures an experiment on a list of hosts with GNU parallel and ssh, one shard at a time on each host.
#   hosts.sh RESULTS HOSTS SHARDS EXPERIMENT [options of pelage run]   start a run, and wait for it
#   hosts.sh RESULTS HOSTS                                             run lost and failed shards again
# HOSTS is a file with one ssh host per line; the line ":" stands for this machine, without ssh. RESULTS, pelage and
# this folder must have the same paths on all hosts. If the hosts have equal hardware, give all of them one name with
# --host NAME. Without a common name, the report shows the rows of each host in a separate table. A shard is a part of
# the cases of an experiment.
set -euo pipefail
scripts=$(dirname "$(realpath "$0")")
# shellcheck source-path=SCRIPTDIR source=common.sh
source "$scripts/common.sh"
(($# == 2 || $# >= 4)) || { sed -n '3,4s/^# *//p' "$0" >&2; exit 2; }

results=$(realpath -m "$1") hosts=$2
[[ -r $hosts ]] || fail "$hosts: no such file of hosts"
(($# == 2)) || record "$results" "${@:3}"
load "$results"

missing=$(unfinished "$results")
[[ -n $missing ]] || { echo "hosts.sh: $results: all $shards shards are finished" >&2; exit 0; }
mkdir -p "$results/logs"
# --jobs 1 runs one shard at a time on each host, because two shards would slow each other down. The exit code of
# parallel is the number of failed shards.
parallel --sshloginfile "$hosts" --jobs 1 --joblog "$results/logs/parallel.log" --line-buffer --tag --quote \
  "$scripts/shard.sh" "$results" '{}' <<<"$missing"
