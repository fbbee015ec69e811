#!/usr/bin/env bash
# Records the results of this machine that results/ holds: runs all experiments whose rows the documents and the claims
# use, and then writes results/, docs/table1, docs/topology, docs/rivals, docs/scaling, docs/roofline, the table of
# README.md and the verdicts in docs/claims.md. The machine must run nothing else. It takes about two hours on two cores.
#
# Usage: scripts/record_all.sh FOLDER
# FOLDER receives the runs. If the script is stopped, the same command continues after the last complete part.
#   PELAGE=PROGRAM: the program to run (default build/release/pelage). Use an installed copy if the source tree changes
#                   during the recording, because a program in the build folder reads the kernels of the source tree.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
(($# == 1)) || { echo "usage: scripts/record_all.sh FOLDER" >&2; exit 2; }
export PELAGE=${PELAGE:-build/release/pelage}
runs=$1
mkdir -p "$runs"

# Runs a part once: part NAME COMMAND... The option -o of pelage run names the folder of the part.
part() {
  local name=$1
  shift
  [[ ! -e $runs/$name.done ]] || return 0
  echo "$(date +%H:%M:%S) $name" >&2
  rm -rf "${runs:?}/$name"
  "$@"
  touch "$runs/$name.done"
}

# Runs experiments into the folder of a part: measure NAME EXPERIMENT... OPTION...
# A picture that fails its check gives exit code 1. Its row says so, and the claims leave it out.
measure() {
  local name=$1 code=0
  shift
  "$PELAGE" run "$@" --anonymous -o "$runs/$name" >/dev/null || code=$?
  ((code <= 1))
}
record() { part "$1" measure "$@"; }

# Experiments whose times decide claims run in three processes, so that the claims use the measured difference between
# processes.
part table1 scripts/record.sh --repeat 3
record wet wetfur2010-table1 --repeat 3
record layers layers --repeat 3
record update-time banisch2006-{update-time,equal-steps} --repeat 3
record topologies topology-table1 --repeat 3
record solvers topology-solvers
record substeps topology-solvers --axis dynamics.substeps=16 --filter \
  '^(bunny|elephant)-.*(sticks|prisms)(-16)?$|^(bunny|elephant)-(.*sticks|separable.*)-16-backward_euler'
record springs banisch2006-{work-precision,longest-step,energy,mesh-size,lean}
record studies topology-{steps,equal-error,jacobian,drift,parting,mesh-scaling}
for preset in quick beyond millions; do record "scaling-$preset" scaling --preset "$preset"; done
record rivals rivals
record rivals-tori rivals --preset tori
record rival-options rival-options
part roofline "$PELAGE" roofline -o "$runs/roofline"

rm -rf results/wetfur2010-table1
cp -r "$runs/wet/wetfur2010-table1" results/
find results/wetfur2010-table1 -mindepth 1 ! -name '*.jsonl' -delete
scripts/record_report.sh docs/topology "$runs"/{update-time,topologies,solvers,substeps,springs,studies}
scripts/record_report.sh docs/rivals "$runs"/{rivals,rivals-tori,rival-options}
scripts/record_report.sh docs/scaling "$runs"/{layers,scaling-quick,scaling-beyond,scaling-millions}
cp "$runs"/roofline/roofline.{csv,svg,pdf} docs/roofline/
scripts/claims_table.py "$PELAGE"
