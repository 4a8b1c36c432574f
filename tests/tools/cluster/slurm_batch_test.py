"""What slurm_batch.sh asks sbatch for: tools/cluster/slurm_test.sh runs a real Slurm."""

import os
import pathlib
import subprocess
import tempfile

from program import PROGRAM

SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "tools" / "cluster" / "slurm_batch.sh"


def submissions(folder, *arguments):
    """The words of each sbatch, and how the script ended."""
    tools = pathlib.Path(folder) / "bin"
    tools.mkdir(exist_ok=True)
    log = pathlib.Path(folder) / "log"
    log.unlink(missing_ok=True)
    (tools / "sbatch").write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" --end-- >> "{log}"\ngrep -c -e --end-- "{log}"\n')
    (tools / "squeue").write_text("#!/bin/sh\n")
    for tool in tools.iterdir():
        tool.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "RIMLINE": PROGRAM}
    result = subprocess.run(["bash", SCRIPT, *arguments], cwd=folder, env=environment, capture_output=True, text=True)
    text = log.read_text() if log.exists() else ""
    return [part.strip("\n").split("\n") for part in text.split("--end--\n") if part], result


def last(words, option):
    """The value that sbatch takes: of several the last."""
    return [word.split("=", 1)[1] for word in words if word.startswith(option + "=")][-1]


def test_options_of_sbatch_do_not_part_the_merge_from_its_array():
    with tempfile.TemporaryDirectory() as folder:
        (array, merge), result = submissions(folder, "4%2", "--dependency=afterok:77", "--time=5", "--", "shape:box", "-o", "out",
                                             "--", "info")
        assert result.returncode == 0 and result.stdout == "1 2\n", result
        assert last(array, "--array") == "1-4%2" and last(array, "--dependency") == "afterok:77"
        assert last(merge, "--dependency") == "afterany:1"
        assert last(array, "--time") == last(merge, "--time") == "5"
        assert last(merge, "--job-name") == last(array, "--job-name") + "-1"
        for option in ("--job-name=mine", "-Jmine", "--array=1-9", "-a"):
            sent, result = submissions(folder, "2", option, "--", "shape:box", "--", "info")
            assert sent == [] and result.returncode == 2 and option in result.stderr, result


def test_a_folder_with_a_pattern_has_its_logs():
    with tempfile.TemporaryDirectory() as folder:
        (array, merge), _ = submissions(folder, "2", "--", "shape:box", "-o", "p%j/o", "--", "info")
        assert last(array, "--output") == "p%%j/o/slurm-%A_%a.log" and last(merge, "--output") == "p%%j/o/slurm-%j.log"
        assert os.path.isdir(f"{folder}/p%j/o")
