"""rimline devices."""
from program import fail, have_device, succeed


def test_devices_tells_why_each_was_or_was_not_chosen():
    have_device()
    devices = succeed("devices")["devices"]
    assert [d["chosen"] for d in devices].count(True) == 1
    for device in devices:
        assert device["name"] in device["reason"] and isinstance(device["lacks"], list)
    line = fail(1, "devices", "--device", "no such device")
    assert "'no such device'" in line and devices[0]["name"] in line
