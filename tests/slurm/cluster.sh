#!/bin/bash
# A Slurm of two simulated nodes on this machine, with all that it has in one folder. Root only. Usage:
#   cluster.sh start FOLDER [CORES]   CORES of each node, 1 by default; prints the line that makes sbatch and squeue use it
#   cluster.sh lose FOLDER NODE       ends a node, a or b, with all that runs on it, as a power cut does
#   cluster.sh stop FOLDER
set -euo pipefail
command=$1 folder=$(realpath -m "$2")
PATH=$PATH:/usr/sbin
export SLURM_CONF=$folder/slurm.conf

# A port that nothing listens on, from a number on.
free_port() {
  local port=$1
  while ss -Hltn "sport = :$port" | grep -q .; do port=$((port + 1)); done
  echo "$port"
}

write_configuration() {
  local cores=$1 port
  port=$(free_port $((20000 + $$ % 10000)))
  cat >"$SLURM_CONF" <<END
ClusterName=talus
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/munge/socket,cred_expire=5
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=1
SlurmdTimeout=10
ReturnToService=2
KillWait=1
SlurmdParameters=config_overrides
NodeName=a NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$(free_port $((port + 1))) CPUs=$cores
NodeName=b NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$(free_port $((port + 101))) CPUs=$cores
PartitionName=all Nodes=a,b Default=YES MaxTime=60
END
}

# Waits until a shell command succeeds.
await() {
  for _ in $(seq 300); do
    eval "$1" >/dev/null 2>&1 && return
    sleep 0.1
  done
  echo "cluster.sh: after 30 s still not: $1" >&2
  tail -n 20 "$folder"/*.log >&2
  return 1
}

start() {
  mkdir -p "$folder/munge" "$folder/state"
  head -c 128 /dev/urandom >"$folder/munge/key"
  chmod 600 "$folder/munge/key"
  write_configuration "${1:-1}"
  local in=$folder/munge
  munged --force --key-file="$in/key" --socket="$in/socket" --pid-file="$in/pid" --log-file="$in/log" --seed-file="$in/seed"
  slurmctld
  slurmd -N a
  slurmd -N b
  await "[[ \$(sinfo --noheader --Node --states=idle | wc -l) == 2 ]]"
  echo "export SLURM_CONF=$SLURM_CONF"
}

# A process and all below it.
family() {
  local child
  echo "$1"
  for child in $(pgrep -P "$1"); do family "$child"; done
}

# Without a word to the controller. What a node runs is below a process of its own, which has the node's script below it.
lose() {
  local script parent
  kill -KILL "$(cat "$folder/slurmd.$1.pid")" 2>/dev/null || true
  for script in $(pgrep -f "$folder/spool.$1/job"); do
    parent=$(ps -o ppid= -p "$script") || continue
    # shellcheck disable=SC2046,SC2086  # a word for each process
    kill -KILL $(family $parent) 2>/dev/null || true
  done
}

stop() {
  lose a
  lose b
  kill "$(cat "$folder/slurmctld.pid")" "$(cat "$folder/munge/pid")" 2>/dev/null || true
  await "! pgrep -F '$folder/slurmctld.pid' && ! pgrep -F '$folder/munge/pid'"
}

case $command in
  start) start "${3:-1}" ;;
  lose) lose "$3" ;;
  stop) stop ;;
esac
