"""Interrupts: the program ends by the signal and leaves no file behind."""
import os
import signal
import subprocess
import tempfile
import time

from program import PROGRAM, has_methods, skip


def test_an_interrupt_ends_the_program_by_its_signal_and_leaves_nothing():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "lines.svg")
        for number, arguments in ((signal.SIGINT, ["track", "shape:knot:20000", "--frames", "10000000", "--verify"]),
                                  (signal.SIGINT, ["draw", "shape:knot:4000", "--subdivide", "5", "-o", path]),
                                  (signal.SIGTERM, ["silhouette", "shape:knot:4000", "--subdivide", "5",
                                                    "--from", "3,2,1", "-o", path])):
            process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            process.send_signal(number)
            out, err = process.communicate(timeout=300)
            assert process.returncode == -number, (process.returncode, err)
            assert out == "" and err == "rimline: error: cancelled\n", (out, err)
            assert os.listdir(folder) == []

        if not has_methods():
            skip("the second signal needs a method without checkpoints: built without the other methods")
        # Seconds of work without a checkpoint, which a second signal ends.
        process = subprocess.Popen([PROGRAM, "silhouette", "shape:knot:4000", "--subdivide", "5", "--method",
                                    "literal", "--from", "3,2,1", "-o", path], stdout=subprocess.DEVNULL)
        time.sleep(2.5)
        assert len(os.listdir(folder)) == 1
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=300) in (-signal.SIGINT, -signal.SIGTERM)
        assert os.listdir(folder) == []


def test_an_interrupt_ends_the_program_where_nothing_asks_for_it():
    with tempfile.TemporaryDirectory() as folder:
        pipe = os.path.join(folder, "pipe.svg")
        os.mkfifo(pipe)  # Opening it waits for a reader, and there is none.
        for signals in ((signal.SIGTERM,), (signal.SIGINT, signal.SIGTERM)):
            process = subprocess.Popen([PROGRAM, "silhouette", "shape:box", "--from", "3,2,1", "-o", pipe],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            for number in signals:
                process.send_signal(number)
                time.sleep(0.2)
            start = time.monotonic()
            try:
                _, err = process.communicate(timeout=60)
            finally:
                process.kill()  # Else one that hangs would outlive its test.
            assert process.returncode == -signals[-1], (process.returncode, err)
            assert err == ("rimline: error: cancelled\n" if len(signals) == 1 else ""), err
            # The second signal ends it at once; without one it had its seconds of grace.
            assert len(signals) == 1 or time.monotonic() - start < 4
