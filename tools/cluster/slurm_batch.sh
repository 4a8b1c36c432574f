#!/usr/bin/env bash
# Runs `rimline batch` on a Slurm cluster: a job array with one task a shard, and a job that merges the manifests
# when all tasks have ended. Prints the ids of both.
#
#   tools/cluster/slurm_batch.sh SHARDS [SBATCH OPTION...] -- MODELS... [BATCH OPTION...] -- SUBCOMMAND...
#   tools/cluster/slurm_batch.sh 64 --time=2:00:00 --cpus-per-task=8 -- models -o out -- views -k 4 -o {out}/{path}
#
# SHARDS may limit the tasks at a time: 64%8. Nodes share this folder, the models, the outputs and the program, which
# is $RIMLINE, else `rimline` of the PATH. Logs are in the folder of -o. Slurm starts a task again
#
#   - when its node failed, or another job took its place;
#   - when its time ended, if it tried models in that time that were not tried before;
#   - when models failed, up to $RIMLINE_RETRIES times (2). Only these models are tried again.
#
# The same command again submits only what is not in the queue.
set -u

stop() {
    echo "slurm_batch.sh: $1" >&2
    exit "${2:-1}"
}

# The id of this user's job with this name that has not ended. Empty if there is none.
queued() {
    local ids
    ids=$(squeue --noheader --user="$(id -un)" --name="$1" --format=%F) || stop "squeue failed"
    echo "${ids%%$'\n'*}"
}

submit() {
    local usage="usage: slurm_batch.sh SHARDS [SBATCH OPTION...] -- MODELS... [BATCH OPTION...] -- SUBCOMMAND..."
    [[ "${1:-}" =~ ^([1-9][0-9]*)(%[1-9][0-9]*)?$ ]] || stop "$usage" 2
    local shards=${BASH_REMATCH[1]} array=1-$1
    shift
    local options=()
    while [ $# -gt 0 ] && [ "$1" != -- ]; do
        case "$1" in
            -J* | --job-name* | -a* | --array*) stop "$1: this script names its jobs and makes the array" 2 ;;
        esac
        options+=("$1")
        shift
    done
    [ $# -gt 1 ] || stop "$usage" 2
    shift

    local program
    program=$(command -v "${RIMLINE:-rimline}") ||
        stop "there is no program ${RIMLINE:-rimline}: name it with RIMLINE="
    program=$(readlink -f "$program")

    local folder=batch has_threads= has_subcommand= before= word
    for word in "$@"; do
        case "$before" in -o | --output) folder=$word ;; esac
        case "$word" in
            --output=*) folder=${word#--output=} ;;
            -o?*) folder=${word#-o} ;;
            --threads*) has_threads=1 ;;
            --) has_subcommand=1 && break ;;
        esac
        before=$word
    done
    [ -n "$has_subcommand" ] || stop "$usage" 2
    mkdir -p "$folder" || stop "cannot make the folder $folder"

    local name array_id merge_id logs=${folder//%/%%}  # In names of logs, % begins a pattern.
    name=rimline-$(printf '%s\n' "$PWD" "$shards" "$@" | cksum | cut -d ' ' -f 1)
    array_id=$(queued "$name") || exit
    if [ -z "$array_id" ]; then
        # A log holds all starts of its task. The signal comes a minute before the time ends.
        array_id=$(sbatch --parsable --requeue --signal=B:TERM@60 \
            --open-mode=append --output="$logs/slurm-%A_%a.log" "${options[@]}" \
            --job-name="$name" --array="$array" "$0" \
            run-shard "$program" "$folder" "$shards" "${RIMLINE_RETRIES:-2}" "$has_threads" "$@") ||
            stop "sbatch failed"
        array_id=${array_id%%;*}
    fi
    merge_id=$(queued "$name-$array_id") || exit
    if [ -z "$merge_id" ]; then
        # A dependency among the options is that of the array, after which this one comes.
        merge_id=$(sbatch --parsable --requeue \
            --open-mode=append --output="$logs/slurm-%j.log" "${options[@]}" \
            --job-name="$name-$array_id" --dependency="afterany:$array_id" "$0" \
            run-merge "$program" "$@") || stop "sbatch failed"
    fi
    echo "$array_id ${merge_id%%;*}"
}

# How far a manifest is: its successes, and its models. Trying failures again and again does not change it.
progress_of() {
    [ -f "$1" ] || return
    grep -c '"status":"ok"' "$1"
    grep -o '^{"input":"[^"]*"' "$1" | sort -u | wc -l
}

# A task of the array.
run_shard() {
    local program=$1 folder=$2 shards=$3 retries=$4 threads=()
    [ -n "$5" ] || threads=(--threads "${SLURM_CPUS_PER_TASK:-1}")
    shift 5
    local shard=$SLURM_ARRAY_TASK_ID/$shards manifest=$folder/manifest.$SLURM_ARRAY_TASK_ID-of-$shards.jsonl
    [ "$shards" -gt 1 ] || manifest=$folder/manifest.jsonl
    local before batch status is_stopped=
    before=$(progress_of "$manifest")
    trap 'is_stopped=1; kill -TERM "$batch"' TERM
    RIMLINE_BATCH_PROCESS=$$ "$program" batch --retry --wait --shard "$shard" "${threads[@]}" "$@" &
    batch=$!
    wait "$batch"
    status=$?
    while kill -0 "$batch" 2>/dev/null; do  # A signal interrupts `wait`.
        wait "$batch"
        status=$?
    done
    if [ -n "$is_stopped" ]; then
        [ "$(progress_of "$manifest")" = "$before" ] || run_again
    elif [ "$status" -eq 1 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt "$retries" ]; then
        run_again
    fi
    exit "$status"
}

# Slurm ends this script and puts the task back into the queue. A task that was canceled has another state and
# stays so. The last task's SLURM_JOB_ID is the whole array's.
run_again() {
    trap - TERM
    local task=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID
    [ "$(squeue --noheader --jobs="$task" --format=%T)" = RUNNING ] || return
    scontrol requeue "$task" && sleep 600
}

case "${1:-}" in
    run-shard)
        shift
        run_shard "$@"
        ;;
    run-merge)
        shift
        exec "$1" batch --merge --wait "${@:2}"
        ;;
    *) submit "$@" ;;
esac
