"""rimline devices."""
import os

from program import fail, have_device, run, succeed


def test_devices_tells_why_each_was_or_was_not_chosen():
    have_device()
    devices = succeed("devices")["devices"]
    assert [d["chosen"] for d in devices].count(True) == 1
    for device in devices:
        assert device["name"] in device["reason"] and isinstance(device["lacks"], list)
    line = fail(1, "devices", "--device", "no such device")
    assert "'no such device'" in line and devices[0]["name"] in line


def test_every_command_that_opens_a_device_lists_all_where_the_one_asked_for_is_missing():
    have_device()
    names = [d["name"] for d in succeed("devices")["devices"]]
    box = "shape:box"
    for command in (["devices"], ["render", box], ["animate", box, "--frames", "1"], ["views", box], ["path", box],
                    ["points", box, "--as-points", "-o", "points.png"], ["bench", "engine", box],
                    ["bench", "frames", box], ["bench", "views", box]):
        line = fail(1, *command, "--device", "nowhere")
        assert "'nowhere'" in line and all(name in line for name in names), line


def test_the_variable_rimline_device_is_the_default_of_device():
    have_device()
    chosen = next(d for d in succeed("devices")["devices"] if d["chosen"])
    lost = run("render", "shape:box", "-o", os.devnull, env={**os.environ, "RIMLINE_DEVICE": "nowhere"})
    assert lost.returncode == 1 and "'nowhere'" in lost.stderr
    # Of those that draw nothing it asks nothing.
    for arguments in (["points", "shape:sphere:500", "--as-points"], ["path", "shape:knot:2000", "--no-ratio"]):
        unused = run(*arguments, env={**os.environ, "RIMLINE_DEVICE": "nowhere"})
        assert unused.returncode == 0, unused
    found = run("devices", "--device", str(chosen["index"]), env={**os.environ, "RIMLINE_DEVICE": "nowhere"})
    assert found.returncode == 0, found.stderr
