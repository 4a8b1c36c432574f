"""Signals: the program ends by them at once and leaves no file behind."""
import os
import resource
import signal
import subprocess
import tempfile
import time

from program import PROGRAM, has_methods, run, skip

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGPIPE, signal.SIGXFSZ, signal.SIGXCPU)
# On an idle machine it takes at most 0.2 s. The rest is for a machine that runs other tests.
LONGEST_WAIT_S = 2.0


def without_core():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def wait_until(holds):
    end = time.monotonic() + 30.0
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.02)


def waits_for_signals(process):
    # A thread of its own waits for them, so that all others block them.
    with open(f"/proc/{process.pid}/status") as status:
        blocked = next(line for line in status if line.startswith("SigBlk:"))
    return int(blocked.split()[1], 16) >> (signal.SIGTERM - 1) & 1


def started(*arguments, preexec_fn=without_core):
    """Begun, and a while in its work."""
    process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               preexec_fn=preexec_fn)
    wait_until(lambda: waits_for_signals(process))
    time.sleep(0.3)
    return process


def check_end_by(number, process):
    """Sends the signal and checks that the program says so and ends by it."""
    start = time.monotonic()
    process.send_signal(number)
    try:
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()  # Else one that hangs would outlive its test.
    assert process.returncode == -number, (process.returncode, err)
    assert out == "" and err == "rimline: error: cancelled\n", (out, err)
    assert time.monotonic() - start < LONGEST_WAIT_S, (number, time.monotonic() - start)


def test_a_signal_ends_the_program_and_leaves_nothing():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "lines.svg")
        for number in ENDING:
            process = started("draw", "shape:knot:4000", "--subdivide", "5", "-o", path)
            check_end_by(number, process)
            assert os.listdir(folder) == []
        for arguments in (["track", "shape:knot:20000", "--frames", "10000000", "--verify"],
                          ["silhouette", "shape:knot:4000", "--subdivide", "5", "--from", "3,2,1", "-o", path]):
            process = started(*arguments)
            check_end_by(signal.SIGINT, process)
            assert os.listdir(folder) == []


def test_a_signal_ends_the_program_where_nothing_asks_for_it():
    with tempfile.TemporaryDirectory() as folder:
        pipe = os.path.join(folder, "pipe.svg")
        os.mkfifo(pipe)  # Opening it waits for a reader, and there is none.
        for number in (signal.SIGTERM, signal.SIGHUP):
            process = started("silhouette", "shape:box", "--from", "3,2,1", "-o", pipe)
            check_end_by(number, process)
        assert os.listdir(folder) == ["pipe.svg"]
        if not has_methods():
            return
        process = started("silhouette", "shape:knot:4000", "--subdivide", "5", "--method", "literal",
                          "--from", "3,2,1", "-o", os.path.join(folder, "lines.svg"))
        time.sleep(2.5)
        check_end_by(signal.SIGINT, process)
        assert os.listdir(folder) == ["pipe.svg"]


def test_a_signal_that_was_ignored_stays_ignored():
    process = started("track", "shape:knot:20000", "--frames", "10000000", "--verify",
                      preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    process.send_signal(signal.SIGHUP)
    time.sleep(0.5)
    assert process.poll() is None
    check_end_by(signal.SIGTERM, process)


def test_a_program_that_is_killed_leaves_nothing():
    with tempfile.TemporaryDirectory() as folder:
        try:
            os.close(os.open(folder, os.O_TMPFILE | os.O_WRONLY))
        except OSError:
            skip("the file system of temporary files has no files without names")
        process = started("draw", "shape:knot:4000", "--subdivide", "5", "-o", os.path.join(folder, "lines.svg"))

        def has_output():
            descriptors = f"/proc/{process.pid}/fd"
            try:
                return any(os.readlink(os.path.join(descriptors, file)).startswith(folder)
                           for file in os.listdir(descriptors))
            except FileNotFoundError:  # Closed in the meantime.
                return False

        wait_until(has_output)
        process.kill()
        process.communicate(timeout=60)
        assert os.listdir(folder) == []


def test_a_write_that_raises_a_signal_is_reported():
    def limit_files():
        without_core()
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "lines.svg")
        with open(path, "w") as file:
            file.write("old")
        result = run("draw", "shape:knot:2000", "-o", path, preexec_fn=limit_files)
        assert result.returncode == -signal.SIGXFSZ, result
        assert result.stderr == f"rimline: error: {path}: cannot write: File too large\n", result.stderr
        with open(path) as file:
            assert file.read() == "old"
        assert os.listdir(folder) == ["lines.svg"]
    for arguments in (["silhouette", "shape:knot:20000", "--from", "3,2,1", "--json"], ["info", "shape:box"],
                      ["silhouette", "shape:knot", "--from", "3,2,1", "-o", "-"]):
        read_end, write_end = os.pipe()
        os.close(read_end)
        result = subprocess.run([PROGRAM, *arguments], stdout=write_end, stderr=subprocess.PIPE, text=True, timeout=60)
        os.close(write_end)
        assert result.returncode == -signal.SIGPIPE, result
        assert result.stderr == "rimline: error: standard output: cannot write: Broken pipe\n", result.stderr
