#!/usr/bin/env python3
"""Runs `rimline batch` on a Dask cluster: a task a shard, and a merge of the manifests when all have ended.

    dask_batch.py SHARDS --scheduler ADDRESS -- MODELS... [BATCH OPTION...] -- SUBCOMMAND...
    dask_batch.py 64 --scheduler tcp://head:8786 -- models -o out -- views -k 4 -o {out}/{path}

Workers share this folder, the models, the outputs and the program. A thread of a worker does one model at a time. Dask
starts a shard again when its worker was lost, and up to --retries times when models failed: these alone are tried
again, and a wrong command line never. Tasks go on when this program is killed: the same command again waits for them,
and merges. Ctrl-C cancels those that have not begun. The exit status is that of `rimline batch`: 1 if a model failed or
is left to do.

In Python, with a `distributed.Client`: run_batch(client, 64, ["models", "-o", "out", "--", "info"]).
"""

import argparse
import collections.abc
import operator
import os
import shutil
import subprocess
import sys

from distributed import Client, as_completed, fire_and_forget

WRONG_USAGE = 2  # An exit status of rimline.


class ShardFailed(Exception):
    """Models of a shard failed, or its batch did. The message is the line that the program printed."""


def run_shard(program, folder, shard, arguments):
    """On a worker: does the shard "I/N". The program ends when the worker does. Raises ShardFailed, so that Dask tries
    again. No retry mends a wrong command line: then returns what the program printed of it."""
    options = ["--retry", "--wait", "--quiet", "--shard", shard]
    own = arguments[:arguments.index("--")]
    if not any(word.split("=")[0] == "--threads" for word in own):
        options += ["--threads", "1"]
    result = subprocess.run([program, "batch", *options, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
                            env={**os.environ, "RIMLINE_BATCH_PROCESS": str(os.getpid())})
    if result.returncode != 0:
        line = result.stderr.strip().rpartition("\n")[2]
        line = f"shard {shard}: {line or f'ended with status {result.returncode}'}"
        if result.returncode == WRONG_USAGE:
            return line
        raise ShardFailed(line)
    return None


def checked_count(value, name, least):
    """`value` as an int. Raises TypeError or ValueError."""
    try:
        count = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected an integer, not {type(value).__name__}") from None
    if count < least:
        raise ValueError(f"{name}: expected at least {least}, not {count}")
    return count


def checked_arguments(arguments):
    """The words of a batch, some of which may be paths, as a list of str. Raises TypeError or ValueError."""
    if isinstance(arguments, (str, bytes)) or not isinstance(arguments, collections.abc.Iterable):
        raise TypeError(f"arguments: expected a list of words, not {type(arguments).__name__}")
    words = []
    for word in arguments:
        try:
            words.append(os.fsdecode(word))
        except TypeError:
            raise TypeError(f"arguments[{len(words)}]: expected text or a path, not {type(word).__name__}") from None
    if "--" not in words[:-1]:
        raise ValueError("arguments: expected models, -- and a subcommand")
    return words


def submit_shards(client, shards, arguments, program="rimline", retries=2):
    """Submits the shards and returns their futures. They go on without a client. Those of an equal call, also of a client
    that is gone, are others: a shard waits while another process does it, and then finds it done. Raises TypeError,
    ValueError or FileNotFoundError before anything is submitted."""
    shards, retries = checked_count(shards, "shards", 1), checked_count(retries, "retries", 0)
    arguments = checked_arguments(arguments)
    path = shutil.which(program)
    if path is None:
        raise FileNotFoundError(f"there is no program {program}: name it with --program")
    path, folder = os.path.abspath(path), os.getcwd()
    # With keys of their own. A result that the scheduler has of an earlier call says nothing of what is to do now.
    futures = [client.submit(run_shard, path, folder, f"{shard}/{shards}", arguments, retries=retries, pure=False)
               for shard in range(1, shards + 1)]
    fire_and_forget(futures)
    return futures


def merge(arguments, program="rimline"):
    """Merges the manifests of shards, prints the summary, and returns the exit status."""
    words = checked_arguments(arguments)
    return subprocess.run([program, "batch", "--merge", "--wait", *words], check=False).returncode


def run_batch(client, shards, arguments, program="rimline", retries=2):
    """Does the batch with the arguments of `rimline batch`, text or paths, and returns its exit status. What Dask gave up
    is named on standard error; the same call again tries it again. Raises as submit_shards()."""
    arguments = checked_arguments(arguments)
    futures = submit_shards(client, shards, arguments, program, retries)
    try:
        for future in as_completed(futures):
            if future.status == "cancelled":
                continue
            try:
                # Not of its status alone: where the worker is lost meanwhile, the shard is done again.
                line = future.result()
            except Exception as error:
                line = error if isinstance(error, ShardFailed) else repr(error)
            if line is not None:
                print(line, file=sys.stderr)
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
    try:
        checked_count(options.shards, "SHARDS", 1)
        checked_count(options.retries, "--retries", 0)
        checked_arguments(arguments)
    except ValueError as error:
        parser.error(str(error).replace("arguments: ", "after --: "))
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
