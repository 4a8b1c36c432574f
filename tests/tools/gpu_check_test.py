"""tools/gpu_check.sh, in a tree of its own whose cmake and ctest only say what they were asked."""
import os
import pathlib
import shutil
import subprocess
import tempfile

from program import PROGRAM, have_device, succeed

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"


def write_script(path, text):
    path.write_text("#!/usr/bin/env bash\n" + text)
    path.chmod(0o755)


class Tree:
    """A tree with the script, where every call is a line of `calls`."""

    def __init__(self, folder):
        self.root = pathlib.Path(folder)
        self.log = self.root / "calls"
        for name in ("tools", "build/release", "bin"):
            (self.root / name).mkdir(parents=True)
        for name in ("gpu_check.sh", "steps.sh"):
            shutil.copy(TOOLS / name, self.root / "tools" / name)
        for name in ("cmake", "ctest"):
            write_script(self.root / "bin" / name,
                         f'echo "{name} $* | $RIMLINE_DEVICE | ${{VK_LAYER_ENABLES:-}}" >> {self.log}\n'
                         f'[ "${{FAILING:-}}" != {name} ]\n')
        # The real program, with as little work as it takes.
        few = "shape:knot:500 --size 32x24 --frames 1 --most-faces 1"
        write_script(self.root / "build/release/rimline",
                     f'echo "rimline $* | ${{RIMLINE_DEVICE:-}}" >> {self.log}\n'
                     f'if [ "$1" = bench ]; then exec {PROGRAM} "$@" {few}; fi\nexec {PROGRAM} "$@"\n')

    def run(self, *arguments, **variables):
        self.log.write_text("")
        path = f"{self.root / 'bin'}:{os.environ['PATH']}"
        result = subprocess.run([self.root / "tools/gpu_check.sh", *arguments], capture_output=True, text=True,
                                timeout=500, env={**os.environ, "PATH": path, **variables})
        result.calls = self.log.read_text().splitlines()
        return result


def test_gpu_check_builds_and_tests_and_measures_on_the_device_asked_for():
    have_device()
    chosen = next(d for d in succeed("devices")["devices"] if d["chosen"])
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(folder)
        device = str(chosen["index"])
        result = tree.run("--device", device, "--quick", "--gpu-assisted")
        assert result.returncode == 0, result.stderr
        assert [call.split()[0] for call in result.calls] == [
            "cmake", "cmake", "rimline", "ctest", "ctest", "rimline"], result.calls
        assert all(f"| {device}" in call for call in result.calls), result.calls
        tests = [call for call in result.calls if call.startswith("ctest")]
        assert all("-L ^device$" in call for call in tests)
        assert ["GPU_ASSISTED" in call for call in tests] == [False, True]
        assert result.calls[-1].startswith("rimline bench frames --quick")
        assert f"{chosen['name']}, {chosen['driver']}" in result.stdout
        # The table is the last thing.
        assert result.stdout.splitlines()[-1].startswith("lines "), result.stdout


def test_gpu_check_measures_after_failed_tests_and_fails():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(folder)
        result = tree.run(FAILING="ctest")
        assert result.returncode == 1 and "adjacency, geometry shader" in result.stdout
        assert result.stderr.splitlines()[-1].endswith("tests failed: see above")
        result = tree.run(FAILING="cmake")
        assert result.returncode == 1 and [call.split()[0] for call in result.calls] == ["cmake"]


def test_gpu_check_stops_at_an_unknown_device_before_any_test():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(folder)
        result = tree.run("--no-tests", "--device", "nowhere")
        assert result.returncode == 1 and result.calls == ["rimline devices | nowhere"]
        assert "'nowhere'" in result.stderr
        for arguments, line in ((["--device"], "needs a device"), (["--fast"], "not expected: --fast")):
            result = tree.run(*arguments)
            assert result.returncode == 1 and line in result.stderr and result.calls == []
        result = tree.run("--help")
        assert result.returncode == 0 and "--gpu-assisted" in result.stdout and result.calls == []
