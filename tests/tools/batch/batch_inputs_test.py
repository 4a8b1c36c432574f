"""The models of a batch: what folders, lists and names stand for."""
import json
import os
import pathlib
import tempfile

from batches import TRIANGLE, batch, entries, models, succeed
from program import fail, run


def test_lists_shapes_and_names():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder), f"{folder}/out"
        (pathlib.Path(folder) / "list.txt").write_text(f"# models\n{root}/m0.obj\n\nshape:box\n{root}/more\r\n")
        told = succeed(f"@{folder}/list.txt", f"{root}/m0.obj", "-o", out, "--", "info")
        assert told["models"] == told["done"] == 4  # m0 once.
        names = {line["input"] for line in entries(f"{out}/manifest.jsonl")}
        assert names == {f"{root}/m0.obj", "shape:box", f"{root}/more/m1.obj", f"{root}/more/m3.obj"}


def test_odd_names_and_links_are_models_once():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder) / "odd"
        root.mkdir()
        for name in (b"{name}.obj", b"a b.obj", b"bad\xff.obj", b"bad\xfe.obj", b"-x.obj", b"n\nl.obj"):
            with open(os.path.join(os.fsencode(root), name), "w") as file:
                file.write(TRIANGLE)
        for name in ("one", "two"):
            os.symlink(".", root / name)
        # Where names say bytes by a backslash, names with a backslash say another.
        (root / "n\\x0al.obj").write_text(TRIANGLE)
        arguments = (str(root), "-o", f"{folder}/out", "--", "draw", "-o", "{out}/{path}.svg")
        assert succeed(*arguments)["done"] == 7
        assert succeed(*arguments)["skipped"] == 7
        assert os.path.exists(f"{folder}/out/{{name}}.svg")
        (pathlib.Path(folder) / "list").write_text(f"{root}/a b.obj\n{root}/../odd/a b.obj\n./-x.obj\n-x.obj\n")
        result = run("batch", "--json", f"@{folder}/list", "-o", "more", "--", "info", cwd=root)
        assert json.loads(result.stdout)["done"] == 2, result


def test_outputs_in_the_folder_of_the_models_are_no_models():
    with tempfile.TemporaryDirectory() as folder:
        root = models(folder)
        for name in ("{stem}", "{path}"):
            out = f"{root}/made-{name[1:5]}"
            arguments = (str(root), "-o", out, "--", "convert", "-o", "{out}/" + name + ".glb")
            assert succeed(*arguments)["done"] == 5
            assert succeed(*arguments)["skipped"] == 5
            for made in pathlib.Path(out).rglob("*.glb"):
                made.unlink()
        # A folder that is named itself is one of models.
        assert succeed(str(root), "-o", str(root), "--", "info")["done"] == 5


def test_what_cannot_be_read_fails_alone():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder), f"{folder}/out"
        os.symlink("nowhere.obj", root / "dangling.obj")
        listed = pathlib.Path(f"{folder}/list.txt")
        listed.write_bytes(b"\xef\xbb\xbf# from a spreadsheet\r\n" + f"{root}\r\n{root}/gone.obj\n".encode())
        arguments = (f"@{listed}", "-o", out, "--", "draw", "-o", "{out}/{path}.svg")
        result, told = batch(*arguments)
        assert result.returncode == 1 and told["kinds"] == {"failed": 2} and told["done"] == 5, (result, told)
        failed = {line["input"]: line["error"] for line in entries(f"{out}/manifest.jsonl") if line["error"]}
        assert set(failed) == {str(root / "dangling.obj"), str(root / "gone.obj")}
        assert all("cannot open it" in error for error in failed.values()), failed
        # A model that is gone after it was done fails alone, too; merging needs no models.
        os.remove(root / "m0.obj")
        result, told = batch(f"@{listed}", "-o", out, "--merge", "--", "draw", "-o", "{out}/{path}.svg")
        assert told["models"] == 6, (result, told)
        # An output that has a file for its folder.
        pathlib.Path(f"{folder}/blocked").mkdir()
        pathlib.Path(f"{folder}/blocked/more").write_text("")
        result, told = batch(str(root), "-o", f"{folder}/blocked", "--", "draw", "-o", "{out}/{path}.svg")
        assert told["kinds"] == {"failed": 3} and told["done"] == 2, (result, told)  # Two in it, and the link.
        if os.geteuid() == 0:
            return  # Who may read everything.
        os.chmod(root / "more", 0)
        try:
            assert batch(str(root), "-o", f"{folder}/other", "--", "info")[1]["kinds"] == {"failed": 2}
        finally:
            os.chmod(root / "more", 0o700)


def test_what_is_no_file_fails_alone_and_at_once():
    with tempfile.TemporaryDirectory() as folder:
        out, pipe, listed = f"{folder}/out", f"{folder}/pipe.obj", f"{folder}/list.txt"
        os.mkfifo(pipe)
        pathlib.Path(listed).write_text(f"shape:box\n{pipe}\n/dev/zero\nshape:kont\nshape:box:99999999999999\n")
        result, told = batch(f"@{listed}", "-o", out, "--", "info")
        assert result.returncode == 1 and told["done"] == 1 and told["models"] == 5, (result, told)
        failed = {line["input"]: line["error"] for line in entries(f"{out}/manifest.jsonl") if line["error"]}
        assert all("is not a regular file" in failed[name] for name in (pipe, "/dev/zero")), failed
        assert "did you mean 'knot'" in failed["shape:kont"], failed
        # In the command line it is a usage error.
        line = fail(2, "batch", "shape:kont", "-o", out, "--", "info")
        assert "did you mean 'knot'" in line and "unexpected" not in line


def test_models_have_the_names_of_folders_and_not_of_links_to_them():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder) / "tree"
        for place in ("real", "z/deep"):
            (root / place).mkdir(parents=True)
            (root / place / "a.obj").write_text(TRIANGLE)
        os.symlink("real", root / "again")
        os.symlink("../real", root / "z/0")
        os.symlink("../z/deep", root / "real/0")
        other = pathlib.Path(folder) / "other"
        other.mkdir()
        (other / "b.obj").write_text(TRIANGLE)
        os.symlink("../other", root / "b")
        os.symlink("../other", root / "a")
        succeed(str(root), "-o", f"{folder}/out", "--", "info")
        names = {os.path.relpath(line["input"], root) for line in entries(f"{folder}/out/manifest.jsonl")}
        assert names == {"real/a.obj", "z/deep/a.obj", "a/b.obj"}, names


def test_hidden_files_of_a_folder_are_no_models():
    with tempfile.TemporaryDirectory() as folder:
        root = models(folder, 2)
        (root / ".hidden").mkdir()
        for name in ("._m0.obj", ".m.obj", ".hidden/m.obj"):
            (root / name).write_text("no model\n")
        assert succeed(str(root), "-o", f"{folder}/out", "--", "info")["models"] == 2
        # One that is named itself is.
        (root / ".hidden/m.obj").write_text(TRIANGLE)
        assert succeed(f"{root}/.hidden", "-o", f"{folder}/out", "--", "info")["models"] == 1


def test_a_folder_is_no_list():
    with tempfile.TemporaryDirectory() as folder:
        assert f"{folder}: this is a folder, no list" in fail(1, "batch", f"@{folder}", "--", "info")
