"""Known real models through several subcommands."""
from program import check_silhouette, check_track, model, succeed


def test_the_bunny_is_counted_and_verified():
    bunny = model("stanford-bunny.obj")
    found = succeed("info", bunny)
    assert (found["vertices"], found["file_vertices"], found["faces"]) == (34834, 35947, 69451)
    assert found["border_edges"] == 223 and found["closed"] is False
    view = ["silhouette", bunny, "--from", "0.3,0.4,0.5"]
    octree, brute = succeed(*view), succeed(*view, "--method", "brute-scalar")
    check_silhouette(octree)
    assert octree["edges"] == brute["edges"]
    track = succeed("track", bunny, "--step", "0.5", "--frames", "30", "--verify")
    check_track(track, 30)
    assert track["verified"] is True


def test_igea_is_counted_and_verified():
    igea = model("igea.ply")
    found = succeed("info", igea)
    assert (found["vertices"], found["faces"], found["closed"]) == (134345, 268686, True)
    track = succeed("track", igea, "--path", "random", "--frames", "60", "--verify")
    check_track(track, 60)
    assert track["verified"] is True
