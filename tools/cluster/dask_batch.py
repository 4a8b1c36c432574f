#!/usr/bin/env python3
"""Runs `rimline batch` on a Dask cluster: a task a shard, and a merge of the manifests when all have ended.

    dask_batch.py SHARDS --scheduler ADDRESS -- MODELS... [BATCH OPTION...] -- SUBCOMMAND...
    dask_batch.py 64 --scheduler tcp://head:8786 -- models -o out -- views -k 4 -o {out}/{path}

Workers share this folder, the models, the outputs and the program. A thread of a worker does one model at a time. Dask
starts a shard again when its worker was lost, and up to --retries times when models failed: these alone are tried
again. Tasks go on when this program is killed: the same command again waits for them, and merges. Ctrl-C cancels those
that have not begun. The exit status is that of `rimline batch`: 1 if a model failed or is left to do.

In Python, with a `distributed.Client`: run_batch(client, 64, ["models", "-o", "out", "--", "info"]).
"""

import argparse
import os
import shutil
import subprocess
import sys

from distributed import Client, as_completed, fire_and_forget


class ShardFailed(Exception):
    """Models of a shard failed, or its batch did. The message is the line that the program printed."""


def run_shard(program, folder, shard, arguments):
    """On a worker: does the shard "I/N". The program ends when the worker does. Raises ShardFailed."""
    options = ["--retry", "--wait", "--quiet", "--shard", shard]
    own = arguments[:arguments.index("--")]
    if not any(word.split("=")[0] == "--threads" for word in own):
        options += ["--threads", "1"]
    result = subprocess.run([program, "batch", *options, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
                            env={**os.environ, "RIMLINE_BATCH_PROCESS": str(os.getpid())})
    if result.returncode != 0:
        line = result.stderr.strip().rpartition("\n")[2]
        raise ShardFailed(f"shard {shard}: {line or f'ended with status {result.returncode}'}")


def submit_shards(client, shards, arguments, program="rimline", retries=2):
    """Submits the shards and returns their futures. They go on without a client. Those of an equal call, also of a client
    that is gone, are others: a shard waits while another process does it, and then finds it done."""
    path = shutil.which(program)
    if path is None:
        raise FileNotFoundError(f"there is no program {program}: name it with --program")
    path, folder = os.path.abspath(path), os.getcwd()
    # With keys of their own. A result that the scheduler has of an earlier call says nothing of what is to do now.
    futures = [client.submit(run_shard, path, folder, f"{shard}/{shards}", list(arguments), retries=retries, pure=False)
               for shard in range(1, shards + 1)]
    fire_and_forget(futures)
    return futures


def merge(arguments, program="rimline"):
    """Merges the manifests of shards, prints the summary, and returns the exit status."""
    return subprocess.run([program, "batch", "--merge", "--wait", *arguments], check=False).returncode


def run_batch(client, shards, arguments, program="rimline", retries=2):
    """Does the batch with the arguments of `rimline batch` and returns its exit status. What Dask gave up is named on
    standard error; the same call again tries it again."""
    futures = submit_shards(client, shards, arguments, program, retries)
    try:
        for future in as_completed(futures):
            if future.status == "error":
                error = future.exception()
                print(error if isinstance(error, ShardFailed) else repr(error), file=sys.stderr)
    finally:
        # What has ended, too: the scheduler would do it again if its worker were lost.
        client.cancel(futures, force=True)
    return merge(arguments, program)


def main():
    cut = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     usage="%(prog)s SHARDS --scheduler ADDRESS [OPTION...] -- MODELS... "
                                           "[BATCH OPTION...] -- SUBCOMMAND...")
    parser.add_argument("shards", metavar="SHARDS", type=int, help="number of tasks: some for each thread")
    parser.add_argument("--scheduler", metavar="ADDRESS", required=True, help="of the scheduler: tcp://HOST:PORT")
    parser.add_argument("--retries", metavar="N", type=int, default=2,
                        help="how often a shard with failures starts again (2)")
    parser.add_argument("--program", metavar="FILE", default="rimline", help="the rimline to run (of the PATH)")
    options, arguments = parser.parse_args(sys.argv[1:cut]), sys.argv[cut + 1:]
    if options.shards < 1 or "--" not in arguments:
        parser.error("expected a number of shards, and after -- the models and the subcommand of a batch")
    try:
        with Client(options.scheduler) as client:
            return run_batch(client, options.shards, arguments, options.program, options.retries)
    except OSError as error:
        print(f"dask_batch.py: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
