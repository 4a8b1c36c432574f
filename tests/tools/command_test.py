"""What all subcommands share: help, wrong usage, bad input, a machine or a build that lacks something."""
import errno
import json
import os
import re
import resource
import subprocess
import tempfile

from program import (COMMANDS, PROGRAM, SMALL, fail, has_methods, have_device, limit_memory, read_file, run, skip,
                     starts_within, succeed)


def test_version_and_help_go_to_standard_output():
    version = run("--version")
    assert version.returncode == 0 and re.fullmatch(r"rimline \d+\.\d+\.\d+\n", version.stdout)
    help_text = run("--help")
    assert help_text.returncode == 0 and help_text.stderr == ""
    assert all(command in help_text.stdout for command in COMMANDS)


def test_every_subcommand_has_help():
    suites = [("bench", suite) for suite in ("hough", "service", "engine", "fields", "views", "points", "edges")]
    assert all("  " + suite in run("bench", "--help").stdout for _, suite in suites)
    for command in [(name,) for name in COMMANDS] + suites:
        result = run(*command, "--help")
        assert result.returncode == 0 and result.stderr == "", command
        assert "Usage: rimline " + " ".join(command) in result.stdout
        assert "--json" in result.stdout or command == ("view",)
        assert "\n\n\n" not in result.stdout
        assert all(len(line) <= 110 for line in result.stdout.splitlines()), command


def test_wrong_usage_exits_2():
    result = run()
    assert result.returncode == 2 and result.stdout == ""
    assert all(command in result.stderr for command in COMMANDS)
    box = "shape:box"
    for arguments in (
            ["frobnicate"], ["frobnicate", "--help"], ["--frobnicate"], ["info"], ["info", box, "--frobnicate"], ["info", box, box],
            ["info", "shape:cube"], ["info", "shape:box:0"], ["info", box, "--subdivide", "-1"],
            ["info", box, "--subdivide", "99"],
            ["silhouette", box], ["silhouette", "--from", "1,2,3"],
            ["silhouette", box, "--from", "1,2"], ["silhouette", box, "--from", "1,2,nan"],
            ["silhouette", box, "--from", "1,2,1e19"], ["silhouette", box, "--direction", "0,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--direction", "1,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--from", "1,2,3"],
            ["silhouette", box, "--from", "1,2,3", "--method", "nonsense"], ["silhouette", box, "--from", "1,2,3", "--method", "gauss"],
            ["silhouette", box, "--from", "1,2,3", "--method", "dual", "--origin", "0,0,0", "--origin", "1,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--method", "brute", "--origin", "0,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--seed", "3"], ["info", box, "--threads", "0"],
            ["silhouette", box, "--from", "1,2,3", "-o", "lines.pdf"], ["silhouette", box, "--from"],
            ["track", box, "--frames", "0"], ["track", box, "--frames", "2.5"], ["track", box, "--step", "x"],
            ["info", ""], ["info", "--json", "--json=maybe", box], ["help", "frobnicate"], ["--json", "frobnicate"],
            ["track", box, "--path", ""], ["track", box, "--up", "0,0,0"], ["track", box, "--radius", "-1"], ["track", box, "--radius", "inf"],
            ["points"], ["points", "shape:cube"], ["points", box, "--eye", "1,2"], ["points", box, "-k", "3"],
            ["points", box, "--as-points", "--from", "1,2,3", "--direction", "1,0,0"],
            ["points", box, "--as-points", "--method", "best"], ["points", box, "--as-points", "--omega", "90"],
            ["points", box, "--as-points", "--gap-ratio", "2", "--omega", "30"],
            ["points", box, "--as-points", "--method", "robust", "--gamma", "2"],
            ["points", box, "--as-points", "--omega", "20", "--omega-t", "25"],
            ["points", box, "--as-points", "--export", "labels.obj"], ["points", box, "--as-points", "--mode", "all"],
            ["points", box, "--as-points", "--verify"], ["points", box, "--as-points", "--turn", "0"],
            ["bench"], ["bench", "nothing"], ["bench", "fields", box, "--rounds", "0"]):
        line = fail(2, *arguments)
        assert "--help" in line, line


def test_help_and_version_stand_wherever_one_looks_for_them():
    assert run("help").stdout == run("--help").stdout != ""
    assert run("help", "track").stdout == run("track", "--help").stdout != ""
    assert "\n  rimline render " in run("help").stdout and "rimline render" in run().stderr
    for command in COMMANDS:
        result = run(command, "--version")
        assert result.returncode == 0 and result.stdout == run("--version").stdout, command
    before, after = run("--json", "info", "shape:box"), run("info", "shape:box", "--json")
    assert before.returncode == 0 and before.stdout == after.stdout


def test_wrong_usage_is_told_in_plain_words():
    view = ["silhouette", "shape:box", "--from", "1,2,3"]
    assert "--from: give it only once" in fail(2, *view, "--from", "1,2,3")
    assert "--from: expects a value" in fail(2, "silhouette", "shape:box", "--from")
    assert "--method: expected octree, literal, brute, brute-scalar, edge-buffer, dual, plane-tree, gauss, cone-tree, quadric or randomised, not 'foo'" in fail(2, *view, "--method", "foo")
    assert "--method gauss: takes directions only" in fail(2, *view, "--method", "gauss")
    assert "--origin: belongs to --method octree, literal or dual" in fail(2, *view, "--method", "brute", "--origin", "0,0,0")
    assert "several belong to --method octree" in fail(2, *view, "--method", "literal", "--origin", "0,0,0", "--origin", "1,0,0")
    assert "--seed: belongs to --method randomised" in fail(2, *view, "--seed", "3")
    assert "SUITE: expected one of {hough,service,engine,frames,fields,views,points,lines,edges}, not 'foo'" in fail(2, "bench", "foo")
    assert "MODEL: expected a file or shape:NAME" in fail(2, "info", "")
    apart = succeed("silhouette", "shape:box", "--from", " 1, 2 ,+3")
    assert apart["edges"] == succeed(*view)["edges"]


def test_what_is_too_large_is_refused_by_its_name():
    for command in (["info"], ["silhouette", "--from", "1,2,3"], ["track"], ["bench", "fields"]):
        line = fail(1, *command, "shape:sphere:10", "--subdivide", "14")
        assert line.startswith("rimline: error: shape:sphere:10: 20 faces refined 14 times"), line
        assert "; take fewer" in line
    if not starts_within(1 << 30):
        skip("the program does not start with 1 GiB of memory, as under sanitizers")
    # The first does not hold the shape, the second not its mesh.
    for shape, commands in (("shape:knot:200000000", (["info"], ["silhouette", "--from", "1,2,3"], ["track"], ["bench", "fields"])),
                            ("shape:knot:16000000", (["track"],))):
        for command in commands:
            result = run(*command, shape, preexec_fn=limit_memory(1 << 30))
            assert result.returncode == 1, (result.returncode, result.stderr)
            assert result.stderr.startswith(f"rimline: error: {shape}: there is not enough memory"), result.stderr


def test_bad_input_exits_1_with_one_line_that_names_it():
    with tempfile.TemporaryDirectory() as folder:
        bad = os.path.join(folder, "bad.obj")
        with open(bad, "w") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n")
        points = os.path.join(folder, "points.txt")
        with open(points, "w") as file:
            file.write("1 2 3\n1 2\n")
        gone = os.path.join(folder, "gone.obj")
        for command in (["info"], ["silhouette", "--from", "1,2,3"], ["track"], ["bench", "fields"]):
            assert gone in fail(1, *command, gone)
            assert bad + ":3" in fail(1, *command, bad, "--json")
            assert folder in fail(1, *command, folder)
        assert points + ":2" in fail(1, "track", "shape:box", "--path", points)
        assert gone in fail(1, "track", "shape:box", "--path", gone)


def test_a_model_too_small_to_be_seen_is_an_error():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "tiny.obj")
        for size in (1e-14, 1e-18, 1e-40):
            with open(path, "w") as file:
                for a in (0, 1):
                    for corner in ((a, 0, 0), (0, a, 0), (0, 0, a)):
                        file.write("v %g %g %g\n" % tuple(size * x for x in corner))
                file.write("f 1 5 4\nf 1 6 5\nf 1 4 6\nf 4 5 6\n")
            for command in (["info"], ["silhouette", "--from", "1,2,3"]):
                if size < 1e-14:
                    assert path + ": too small" in fail(1, *command, path)
                else:
                    succeed(*command, path)


def test_a_model_too_large_to_be_seen_from_around_is_an_error():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "huge.obj")
        with open(path, "w") as file:
            file.write("v 9e17 0 0\nv 0 9e17 0\nv 0 0 9e17\nv -9e17 0 0\nf 1 2 3\nf 2 4 3\n")
        assert path in fail(1, "bench", "service", path)
        assert path in fail(1, "bench", "fields", path)
        have_device()
        output = os.path.join(folder, "views")
        for command in (["views", "-o", output], ["path", "-o", output], ["bench", "views"], ["bench", "engine"]):
            assert path + ": too large" in fail(1, *command, path)


def test_a_full_disk_behind_standard_output_is_an_error():
    if not os.path.exists("/dev/full"):
        skip("no /dev/full")
    # Some texts are longer than the buffer of standard output.
    for arguments in (["info", "shape:box", "--json"], ["--help"], ["track", "--help"], ["--version"], ["info", "--version"],
                      ["--manual"], ["--completion", "bash"], ["silhouette", "shape:knot:9000", "--from", "3,2,4", "--json"]):
        for where in (">/dev/full", ">&-"):
            result = subprocess.run(["sh", "-c", 'exec "$0" "$@" ' + where, PROGRAM, *arguments],
                                    stderr=subprocess.PIPE, text=True, timeout=60)
            assert result.returncode == 1 and result.stderr.count("\n") == 1, (arguments, where, result)
            assert result.stderr.startswith("rimline: error: standard output: cannot write: "), result.stderr
            reason = os.strerror(errno.ENOSPC if where == ">/dev/full" else errno.EBADF)
            assert reason in result.stderr, (arguments, where, result)


def test_a_build_without_the_other_methods_says_so():
    view = ["silhouette", "shape:knot:2000", "--from", "4,1,2"]
    octree, brute = (succeed(*view, "--method", name) for name in ("octree", "brute-scalar"))
    assert octree["edges"] == brute["edges"] != []
    if has_methods():
        skip("built with the other silhouette methods")
    why = ": this rimline was built without the other silhouette methods; configure it with -DRIMLINE_METHODS=ON"
    assert "silhouette --method literal" + why in fail(1, *view, "--method", "literal")
    assert "origins --literal" + why in fail(1, "origins", "shape:box", "--literal")
    assert "bench hough" + why in fail(1, "bench", "hough", "shape:box", "--check")
    assert succeed("bench", "fields", "shape:knot:2000", "--rounds", "1")["machine"]["instruction_set"]


def test_a_machine_without_devices_ends_with_one_line():
    with tempfile.TemporaryDirectory() as folder:
        for variable in ("VK_ICD_FILENAMES", "VK_DRIVER_FILES"):
            result = run("render", "shape:box", "-o", os.path.join(folder, "a.png"),
                         env={**os.environ, variable: "/nonexistent"})
            assert result.returncode == 1, result
            assert result.stderr.startswith("rimline: error: there is no Vulkan device: "), result.stderr
            assert result.stderr.count("\n") == 1, result.stderr
            assert os.listdir(folder) == []


def test_a_mistyped_name_is_answered_with_the_one_that_was_meant():
    box = "shape:box"
    for arguments, meant in (
            (["rendr"], "render"), (["redner", box], "render"), (["help", "animte"], "animate"), (["bench", "huogh"], "hough"),
            (["info", box, "--jsn"], "--json"), (["track", box, "--freams=3"], "--frames"), (["info", "shape:shpere"], "sphere"),
            (["silhouette", box, "--from", "1,2,3", "--method", "octre"], "octree"),
            (["draw", box, "--lines", "silhouete", "-o", "a.svg"], "silhouette"), (["draw", box, "--hidden", "layr", "-o", "a.svg"], "layer")):
        assert f"; did you mean '{meant}'? (see " in fail(2, *arguments), (arguments, fail(2, *arguments))
    for arguments, meant in ((["--eye", "frnt"], "front"), (["--line-color", "materal"], "material")):
        assert f"; did you mean '{meant}'? (see " in fail(2, "draw", box, "-o", "a.svg", *arguments)
    for option, names in (("--up", "x, y, z, -x, -y, -z, auto"), ("--eye", "auto, front, back, left")):
        assert names in fail(2, "draw", box, "-o", "a.svg", option, "q")
    for arguments in (["frobnicate"], ["info", box, "--frobnicate"], ["info", box, "-x"], ["info", box, box]):
        assert "did you mean" not in fail(2, *arguments), arguments
    assert "not expected: --frobnicate (see" in fail(2, "info", box, "--frobnicate", "7")


def test_an_option_that_there_is_not_is_told_before_one_that_is_missing():
    for arguments, words in (
            (["light", "shape:box", "--eyes", "1,2,3"], "option not expected: --eyes; did you mean '--eye'?"),
            (["light", "shape:box", "--eyes=-1,2,3"], "option not expected: --eyes; did you mean '--eye'?"),
            (["light", "--eyes", "-1,2,3", "shape:box"], "option not expected: --eyes; did you mean '--eye'?"),
            (["convert", "shape:box", "--out", "x.glb"], "option not expected: --out; did you mean '--output'?"),
            (["convert", "shape:box", "-O", "x.glb"], "option not expected: -O (see"),
            (["convert", "shape:box", "--crease", "20", "-o", "x.glb", "--edgs"], "option not expected: --edgs; did you mean '--edges'?"),
            (["draw", "--elev=3"], "option not expected: --elev; did you mean '--elevation'?"),
            (["draw", "--widht"], "option not expected: --widht; did you mean '--width'?"),
            # A value without an option, and nothing wrong but what is missing.
            (["light", "shape:box", "-1,2,3"], "--eye is required"), (["light", "shape:box", "-.5,2,3"], "--eye is required"),
            (["light", "shape:box"], "--eye is required"), (["convert", "shape:box"], "--output is required"),
            (["info", "shape:box", "-1,2,3"], "argument not expected: -1,2,3"), (["draw"], "MODEL is required"),
            # Several begin so.
            (["draw", "shape:box", "--hidden-"], "option not expected: --hidden-"),
            # A wrong value is told first, and the first one typed.
            (["light", "shape:box", "--eye", "1,2", "--upp", "z"], "--eye: ")):
        line = fail(2, *arguments)
        assert line.startswith("rimline: error: " + words), (arguments, line)


def test_after_two_dashes_come_names():
    with tempfile.TemporaryDirectory() as folder:
        for name in ("-dash.obj", "--json", "a.obj"):
            with open(os.path.join(folder, name), "w") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        for arguments in (["info"], ["draw", "-o", "q.svg"], ["silhouette", "--from", "3,2,1"], ["track", "--frames", "2"],
                          ["light", "--eye", "3,2,1"], ["origins"], ["convert", "-o", "q.glb"], ["field", "--at", "3,2,1"],
                          ["points", "--as-points"]):
            for name in ("-dash.obj", "--json"):
                result = run(*arguments, "--json", "--", name, cwd=folder)
                assert result.returncode == 0, (arguments, name, result.stderr)
                assert "./" + name in result.stdout, (arguments, result.stdout)
            assert run(*arguments, "--quiet", "a.obj", "--", cwd=folder).returncode == 0, arguments
        for arguments in (["field", "--", "-dash.obj", "-o", "q.png"], ["info", "a.obj", "--", "--json"], ["info", "--", "a.obj", "--", "x"]):
            result = run(*arguments, cwd=folder)
            assert result.returncode == 2 and "argument not expected: " in result.stderr, (arguments, result)
            assert "; what follows -- are names, no options (see" in result.stderr
        assert "--eye is required; what follows -- are names" in fail(2, "light", "--", "a.obj", "--eye", "1,2,3")
        # A lone dash stays standard input.
        with open(os.path.join(folder, "a.obj")) as file:
            assert run("info", "--format", "obj", "--", "-", stdin=file).returncode == 0
        have_device()
        for models in (["--", "-dash.obj"], ["a.obj", "--", "-dash.obj"], ["--", "-dash.obj", "a.obj", "--json"]):
            result = run("render", *SMALL, "--json", "-o", "q.png", *models, cwd=folder)
            assert result.returncode == 0, (models, result.stderr)


def test_quiet_leaves_only_errors():
    with tempfile.TemporaryDirectory() as folder:
        painted = os.path.join(folder, "painted.obj")
        with open(painted, "w") as file:
            file.write("mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        loud = run("info", painted)
        assert loud.stdout != "" and "warning" in loud.stderr, loud
        for arguments in (["info", painted, "--quiet"], ["--quiet", "info", painted]):
            quiet = run(*arguments)
            assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", ""), (arguments, quiet)
        assert succeed("info", painted, "--quiet")["faces"] == 1
        fail(1, "info", os.path.join(folder, "gone.obj"), "--quiet")
        # Files are written all the same, also to standard output.
        lines = os.path.join(folder, "lines.obj")
        assert run("silhouette", "shape:box", "--from", "4,3,2", "-o", lines, "--quiet").stdout == ""
        assert os.path.getsize(lines) > 0


def test_a_model_comes_from_standard_input():
    with tempfile.TemporaryDirectory() as folder:
        texts = {"obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "off": "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 "stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
                 "ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"}
        for name, text in texts.items():
            result = run("info", "-", "--format", name, "--json", input=text)
            assert result.returncode == 0, result.stderr
            assert '"faces":1' in result.stdout and '"model":"-"' in result.stdout
        wrong = run("info", "-", "--format", "obj", input=texts["ply"])
        assert wrong.returncode == 1 and "standard input: its content is ply, not obj" in wrong.stderr
        bad = run("info", "-", "--format", "obj", input="v 0 0 zero\n")
        assert bad.returncode == 1 and "standard input:1" in bad.stderr, bad.stderr
        empty = run("info", "-", "--format", "obj", input="")
        assert empty.returncode == 1 and "standard input: " in empty.stderr, empty.stderr
        none = run("info", "-", input=texts["obj"])
        assert none.returncode == 2 and "needs --format" in none.stderr
    assert "did you mean 'glb'" in fail(2, "info", "-", "--format", "gbl")


def test_a_cloud_where_faces_are_needed_names_what_takes_it():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cloud.xyz")
        with open(path, "w") as file:
            file.write("0 0 0\n1 0 0\n0 1 0\n")
        for command in (["silhouette", "--from", "1,2,3"], ["render"], ["track"]):
            if command[0] == "render" and "without the engine" in run("render", path).stderr:
                continue
            line = fail(1, command[0], path, *command[1:])
            assert path + ": no faces: it is a cloud of 3 points; rimline points" in line, line


def test_a_scene_file_where_a_model_is_needed_names_what_takes_it():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "s.json")
        with open(path, "w") as file:
            file.write('{"rimline_scene": 1, "models": [{"model": "shape:box"}]}')
        for command in (["info"], ["light", "--eye", "1,2,3"], ["views", "--no-ratio"], ["points"],
                        ["silhouette", "--from", "1,2,3"]):
            line = fail(1, command[0], path, *command[1:])
            if "without the engine" in line:
                continue
            assert path + ": is a scene file, which only render, animate, view, draw and convert take" in line, line
        # Of another file with this ending it is not said.
        with open(path, "w") as file:
            file.write('{"scene": 0}')
        assert "'asset'" in fail(1, "info", path)
        assert sorted(os.listdir(folder)) == ["s.json"]


def test_no_file_takes_the_number_of_a_standard_stream():
    with tempfile.TemporaryDirectory() as folder:
        model, path = os.path.join(folder, "a.obj"), os.path.join(folder, "a.svg")
        with open(model, "w") as file:  # It has a warning, for standard error.
            file.write("mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        arguments = ["silhouette", model, "--from", "3,2,1", "--borders", "-o", path]
        result = run(*arguments)
        assert result.returncode == 0 and "gone.mtl" in result.stderr, result
        expected = read_file(path)
        for closed in ((0,), (1,), (2,), (0, 1, 2)):
            os.remove(path)
            result = subprocess.run([PROGRAM, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, text=True, timeout=60,
                                    preexec_fn=lambda: [os.close(number) for number in closed])
            assert read_file(path) == expected, closed
            # What cannot be printed is an error, as for a full disk.
            assert result.returncode == (1 if 1 in closed else 0), (closed, result)
            assert closed != (1,) or "standard output: cannot write: Bad file descriptor" in result.stderr, result.stderr


def test_a_machine_with_few_threads_takes_longer():
    # No thread but the first: the system counts those of other programs of the same user too.
    def limit_threads():
        if os.geteuid() == 0:  # Root has no limit.
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)
        resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))

    limited = {"preexec_fn": limit_threads, "cwd": "/"}
    try:
        run("--version", **limited)
    except (PermissionError, subprocess.SubprocessError):
        skip("the program cannot be run by another user")
    for arguments in (["silhouette", "shape:knot:20000", "--from", "3,2,1", "--no-edges"],
                      ["track", "shape:knot:20000", "--frames", "30", "--verify"], ["origins", "shape:knot:2000"],
                      ["field", "shape:knot:2000", "--at", "0,0,0"], ["points", "shape:knot:2000", "--as-points"]):
        expected, result = succeed(*arguments), run(*arguments, "--json", **limited)
        assert result.returncode == 0 and result.stderr == "", (arguments, result.returncode, result.stderr)
        assert json.loads(result.stdout).keys() == expected.keys()


def test_short_memory_is_an_error_and_not_an_end():
    for megabytes in (150, 200, 300, 400, 600):
        limit = megabytes << 20
        for arguments in (["silhouette", "shape:knot:100000", "--from", "3,2,1", "--no-edges"],
                          ["bench", "service", "shape:knot:20000", "--trackers", "300", "--frames", "2"]):
            result = run(*arguments, preexec_fn=limit_memory(limit))
            assert result.returncode in (0, 1), (megabytes, arguments, result.returncode, result.stderr)
            assert "unexpected" not in result.stderr, (megabytes, arguments, result.stderr)
    # The loader says nothing of a driver for which there is no memory.
    limit = 250 << 20
    result = run("views", "shape:box", preexec_fn=limit_memory(limit))
    assert "no Vulkan device" not in result.stderr or "ulimit -v" in result.stderr, result.stderr
