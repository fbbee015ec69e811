#!/usr/bin/env bash
# Runs a command with a Slurm cluster of one node on this machine: scripts/slurm_here.sh FOLDER COMMAND [ARGUMENT...].
# The script starts munged, slurmctld and slurmd with all their files in FOLDER, sets SLURM_CONF, runs the command and
# stops the three programs. It changes nothing outside FOLDER, and needs neither root nor systemd. The exit code is the
# exit code of COMMAND, or 77 if Slurm is not installed. The script needs the packages munge, slurm-client, slurmctld
# and slurmd.
#   SLURM_HERE_CPUS=N: the number of cores that the node offers (default: all)
set -euo pipefail
(($# >= 2)) || { sed -n '2s/^# *//p' "$0" >&2; exit 2; }
PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || { echo "slurm_here: $program is not installed" >&2; exit 77; }
done
mkdir -p "$1"
here=$(realpath "$1") host=$(hostname -s) user=$(id -un)
shift
export SLURM_CONF=$here/slurm.conf

mkdir -p "$here"/{state,spool,sock,munge}
# Only this user may read the key of munge.
chmod 755 "$here" "$here"/{state,spool,sock}
chmod 700 "$here/munge"
head -c 1024 /dev/urandom >"$here/munge/key"
chmod 600 "$here/munge/key"
# Prints a free port. A port is free if no program accepts a connection to it.
free_port() {
  local port
  while port=$((20000 + RANDOM % 10000)); do
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}
cat >"$SLURM_CONF" <<CONF
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=socket=$here/sock/munge.sock
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$here/jobcomp.txt
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
KillWait=5
SchedulerParameters=batch_sched_delay=0,sched_interval=2
StateSaveLocation=$here/state
SlurmdSpoolDir=$here/spool
SlurmctldPidFile=$here/sock/slurmctld.pid
SlurmdPidFile=$here/sock/slurmd.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdLogFile=$here/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=${SLURM_HERE_CPUS:-$(nproc)} State=UNKNOWN
PartitionName=bench Nodes=ALL Default=YES OverSubscribe=NO
CONF

# shellcheck disable=SC2317  # trap calls this function
stop() {
  local program pid i
  scancel --user "$user" 2>/dev/null || true
  for program in slurmd slurmctld munged; do
    pid=$(cat "$here/sock/$program.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || true
    for ((i = 0; i < 100; ++i)); do
      kill -0 "$pid" 2>/dev/null || break
      sleep 0.1
    done
  done
}
trap stop EXIT
# Without --force, munged refuses a socket in a folder that only this user can enter, such as a temporary folder. Here
# such a folder is sufficient, because all programs run as this user.
munged --force --key-file="$here/munge/key" --socket="$here/sock/munge.sock" --pid-file="$here/sock/munged.pid" \
  --log-file="$here/munge/munged.log" --seed-file="$here/munge/seed"
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for ((i = 0; ; ++i)); do
  [[ $(sinfo --noheader --format=%T 2>/dev/null) != idle ]] || break
  ((i < 300)) || { echo "slurm_here: the node is not idle after 30 s; see $here/slurmctld.log" >&2; exit 1; }
  sleep 0.1
done
code=0
"$@" || code=$?
exit "$code"
