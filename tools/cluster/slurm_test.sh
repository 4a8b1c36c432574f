#!/usr/bin/env bash
# Tests slurm_batch.sh with a slurmctld and two slurmd of its own on this machine, and ends them. Nothing outside a
# temporary folder is read or written. Each node is a process namespace with a host name, so that killing its first
# process ends all that runs on it, as a power cut does.
#
#   tools/cluster/slurm_test.sh [ROUNDS [PROGRAM]]
#
# In each of the rounds (50) it kills the submitting shell, the process of a model and a node, at random times. Then
# the merged manifest and the outputs must be those of one machine. Needs root and the packages of
# `tools/install_packages.sh cluster`; without, it ends with status 77.
set -u
rounds=${1:-50}
source "$(dirname "$0")/../steps.sh"
program=$(readlink -f "${2:-build/release/rimline}")
[ -x "$program" ] || stop "there is no program $program: build it, or name it as the second argument"

skip() {
    echo "SKIPPED: $1"
    exit 77
}
for tool in munged slurmctld slurmd sbatch unshare pgrep python3; do
    command -v "$tool" >/dev/null || skip "$tool is not installed: tools/install_packages.sh cluster"
done
[ "$(id -u)" -eq 0 ] || skip "slurmd needs root"
unshare --uts --pid --fork --mount-proc true 2>/dev/null || skip "this machine has no namespaces for nodes"

work=$(mktemp -d "${TMPDIR:-/tmp}/rimline-slurm.XXXXXX") || stop "cannot make a temporary folder"
node_process=()  # Of unshare; killing it kills its first process.
shell_process=
end_all() {
    {
        [ -z "$shell_process" ] || kill -9 -- "-$shell_process"
        kill -9 "${node_process[@]}" $(cat "$work"/slurmctld.pid "$work"/munged.pid)
        wait
    } 2>/dev/null
    rm -rf "$work"
}
trap end_all EXIT
trap 'exit 130' INT TERM HUP

fail() {
    echo "$script_name: $1" >&2
    for log in "$work"/*.log "$work"/round/slurm-*.log; do
        [ ! -s "$log" ] || { echo "== $log" && tail -n 15 "$log"; } >&2
    done
    exit 1
}

# The cluster.
read -r control_port port_1 port_2 < <(python3 -c '
import socket
sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(3)]
print(*(s.getsockname()[1] for s in sockets))')
export SLURM_CONF=$work/slurm.conf
cat >"$SLURM_CONF" <<END
ClusterName=rimline
SlurmctldHost=localhost
SlurmctldPort=$control_port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket,cred_expire=5
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
SlurmdTimeout=5
MessageTimeout=5
KillWait=2
NodeName=rimline1 NodeAddr=127.0.0.1 Port=$port_1 CPUs=1
NodeName=rimline2 NodeAddr=127.0.0.1 Port=$port_2 CPUs=1
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE
END
start_node() {
    unshare --uts --pid --fork --kill-child --mount-proc bash -c "hostname rimline$1 && exec slurmd -D" \
        >>"$work/slurmd$1.log" 2>&1 &
    node_process[$1]=$!
}
mkdir "$work/state"
head -c 1024 /dev/urandom >"$work/munge.key" && chmod 400 "$work/munge.key"
munged --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
    --log-file="$work/munged.log" --seed-file="$work/munge.seed" 2>/dev/null || fail "munged does not start"
slurmctld -i || fail "slurmctld does not start"
start_node 1
start_node 2
# until_true SECONDS WHAT COMMAND...
until_true() {
    local deadline=$((SECONDS + $1)) what=$2
    shift 2
    until "$@"; do
        [ $SECONDS -lt $deadline ] || fail "$what took too long"
        sleep 0.05
    done
}
are_idle() { [ "$(sinfo --noheader --Node --format=%t 2>/dev/null | sort -u)" = idle ]; }
until_true 60 "the start of the nodes" are_idle

# The batch: models that take up to a second.
for faces in 8000 {80000..520000..40000}; do
    echo "shape:knot:$faces"
done >"$work/list"
cd "$work" || exit
plain() { "$program" batch --threads 1 "$1" -o "$2" -- draw -o {out}/{stem}.svg; }
milliseconds() { date +%s%3N; }
start=$(milliseconds)
plain @list expected >/dev/null || fail "the batch on one machine fails"
model_ms=$((($(milliseconds) - start) / $(wc -l <list)))
export RIMLINE=$program RIMLINE_RETRIES=20
submit=("$OLDPWD/tools/cluster/slurm_batch.sh" 4 -- @list -o round -- draw -o {out}/{stem}.svg)
is_over() { [ -z "$(squeue --noheader --format=%i)" ]; }

# random_sleep MILLISECONDS: up to so many.
random_sleep() {
    local ms=$((RANDOM % ($1 + 1)))
    sleep "$(printf '%d.%03d' $((ms / 1000)) $((ms % 1000)))"
}

# The processes of models on a node, as the machine numbers them.
models_on() {
    local first
    first=$(pgrep -P "${node_process[$1]}") || return
    pgrep --ns "$first" --nslist pid -f '^rimline draw '
}
# Sets `node` and `model` to one of those that run, or `model` to nothing where the batch is over.
find_model() {
    for node in $(shuf -e 1 2); do
        model=$(models_on "$node" | shuf -n 1)
        [ -z "$model" ] || return 0
    done
    is_over
}

kill_shell() {
    setsid "${submit[@]}" >/dev/null 2>&1 &
    shell_process=$!
    random_sleep "$submit_ms"
    {
        kill -9 -- "-$shell_process" && shells=$((shells + 1))
        wait "$shell_process"
    } 2>/dev/null
    shell_process=
}
kill_model() {
    until_true 60 "a model's process" find_model
    [ -n "$model" ] || return 0
    random_sleep "$model_ms"
    kill -9 "$model" 2>/dev/null && models=$((models + 1))
}
kill_node() {
    until_true 60 "a node with a model" find_model
    [ -n "$model" ] || return 0
    random_sleep "$model_ms"
    {
        kill -9 "${node_process[$node]}"
        wait "${node_process[$node]}"
    } 2>/dev/null
    nodes=$((nodes + 1))
    start_node "$node"
}

# Without kills, which tells how long a submission takes.
start=$(milliseconds)
"${submit[@]}" >/dev/null || fail "sbatch fails"
submit_ms=$(($(milliseconds) - start))
until_true 180 "the batch" is_over
python3 "$OLDPWD/tests/tools/cluster/whole_once.py" round expected || fail "without kills: see above"

shells=0 models=0 nodes=0
# What is over before it is killed does not count.
while [ $nodes -lt "$rounds" ] || [ $shells -lt "$rounds" ] || [ $models -lt "$rounds" ]; do
    rm -rf round
    kill_shell
    "${submit[@]}" >/dev/null || fail "the second submission fails"
    [ "$(squeue --noheader --array --format=%i | wc -l)" -le 5 ] || fail "jobs are in the queue twice"
    kill_model
    kill_node
    until_true 180 "the batch" is_over
    python3 "$OLDPWD/tests/tools/cluster/whole_once.py" round expected || fail "after $nodes nodes: see above"
    echo "killed $shells submitting shells, $models models, $nodes nodes: nothing lost, doubled or cut"
done

# A task that is told to end gives up its models and starts again; a model that fails is tried so often and no more.
rm -rf round expected
echo 'f 1 2 3' >bad.obj
echo bad.obj >>list
plain @list expected >/dev/null 2>&1
export RIMLINE_RETRIES=2
"${submit[@]}" >/dev/null || fail "sbatch fails"
until_true 60 "a model's process" find_model
until_true 60 "a line" grep -qs . round/manifest.*-of-4.jsonl
scancel --batch --signal=TERM --state=RUNNING --user=root
until_true 180 "the batch" is_over
python3 "$OLDPWD/tests/tools/cluster/whole_once.py" round expected || fail "a task that was told to end: see above"
[ "$(cat round/manifest.*-of-4.jsonl | grep -c '"input":"bad.obj"')" -le 3 ] || fail "a failure is tried too often"

# Each task of the array tries its own failures again, and only itself.
rm -rf round
for number in {1..12}; do echo 'f 1 2 3' >"bad$number.obj"; done
RIMLINE_RETRIES=1 "$OLDPWD/tools/cluster/slurm_batch.sh" 4 -- bad{1..12}.obj -o round -- info >/dev/null ||
    fail "sbatch fails"
until_true 180 "the batch" is_over
tried=$(cat round/manifest.*-of-4.jsonl | grep -c '"status":"failed"')
[ "$tried" -eq 24 ] || fail "twelve models that fail were tried $tried times, not twice each"

# What was canceled stays so, and the same command goes on with it.
rm -rf round
"${submit[@]}" >/dev/null || fail "sbatch fails"
until_true 60 "a model's process" find_model
scancel --user=root
until_true 60 "the end of what was canceled" is_over
"${submit[@]}" >/dev/null || fail "sbatch fails"
until_true 180 "the batch" is_over
python3 "$OLDPWD/tests/tools/cluster/whole_once.py" round expected || fail "a batch that was canceled: see above"
