"""rimline bench: what several suites share."""
import os
import tempfile

from program import TRIANGLE, fail, have_device, have_methods, run, succeed, write_faces


def test_bench_refuses_options_without_an_effect():
    have_methods()
    suite, service = ["bench", "hough", "shape:box"], ["bench", "service", "shape:box"]
    assert "not expected: --growth" in fail(2, *service, "--growth")
    assert "not expected: --fps" in fail(2, *suite, "--fps", "30")
    assert "--least-faces: belongs to --growth" in fail(2, *suite, "--least-faces", "10")
    assert "--check: not together with" in fail(2, *suite, "--methods", "--check")
    assert "--methods: not together with --growth" in fail(2, *suite, "--methods", "--growth")
    assert "has no size from 5 to 6 faces" in fail(
        2, "bench", "hough", "shape:knot", "--growth", "--least-faces", "5", "--most-faces", "6")


def test_bench_takes_models_of_hardly_any_faces_and_refuses_what_is_one_point():
    have_device()
    few = ("--frames", "2", "--rounds", "1", "--viewpoints", "4")
    with tempfile.TemporaryDirectory() as folder:
        point = write_faces(os.path.join(folder, "point.obj"), ((1, 2, 3),) * 3)
        for suite in (["views"], ["views", "--pictures", os.path.join(folder, "p")], ["engine", *few]):
            assert point + ": its radius is 0" in fail(1, "bench", *suite, point)
        assert os.listdir(folder) == ["point.obj"]
        one = write_faces(os.path.join(folder, "one.obj"), TRIANGLE)
        # Without any plane, along the axis that models are bent around.
        line = write_faces(os.path.join(folder, "line.obj"), ((0, 0, 0), (0, 1, 0), (0, 2, 0)))
        for path in (one, line):
            views = succeed("bench", "views", path)["models"][0]["views"]
            # No quarter of one face is left to be seen.
            assert all(row["simplified_deg"] is None for row in views)
            assert [row["noisy_deg"] is None for row in views] == 6 * [False] + 2 * [True]
            assert run("bench", "views", path).returncode == 0
            assert succeed("bench", "engine", path, *few)["models"][0]["verified"] is True
        succeed("bench", "views", line, "--pictures", os.path.join(folder, "p"))
