"""packages.py BUILD SCRATCH PYTHON: the Debian packages of a build are made, installed into an empty root, run, and removed.

Checks too, where they are installed: lintian finds no error, desktop-file-validate and appstreamcli no fault. Ends with
status 77 where there is no dpkg.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

build, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
python = sys.argv[3]
if any(shutil.which(tool) is None for tool in ("dpkg", "dpkg-shlibdeps", "file")):
    print("SKIPPED: no dpkg, dpkg-dev and file")
    sys.exit(77)


def run(*command, **options):
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    assert result.returncode == 0, f"{command}: {result.returncode}\n{result.stdout}\n{result.stderr}"
    return result.stdout


def files_in(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir()}


shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
run("cpack", "--config", build / "CPackConfig.cmake", "-B", scratch)
packages = {path.name.split("_")[0]: path for path in scratch.glob("*.deb")}
print("packages:", *sorted(packages))
assert "rimline" in packages and "librimline-dev" in packages

needed = {
    "rimline": ["usr/bin/rimline", "usr/share/man/man1/rimline.1.gz", "usr/share/zsh/site-functions/_rimline",
                "usr/share/bash-completion/completions/rimline", "usr/share/fish/vendor_completions.d/rimline.fish"],
    "librimline1": ["usr/lib/librimline.so.1", "usr/lib/librimline.so.1.0.0"],
    "librimline-dev": ["usr/lib/librimline_silhouette.a", "usr/include/rimline/silhouette/rimline.h",
                       "usr/lib/cmake/Rimline/RimlineConfig.cmake"],
    "python3-rimline": ["usr/lib/python3/dist-packages/rimline/__init__.py",
                        "usr/lib/python3/dist-packages/rimline/py.typed"],
}
if "librimline1" in packages:
    needed["librimline-dev"] += ["usr/lib/librimline.so", "usr/include/rimline.h"]
synopses = set()
for name, path in packages.items():
    contents = {line.split(maxsplit=5)[5].split(" -> ")[0].removeprefix("./")
                for line in run("dpkg-deb", "--contents", path).splitlines()}
    wanted = needed[name] + [f"usr/share/doc/{name}/{file}" for file in ("copyright", "changelog.gz")]
    assert not set(wanted) - contents, f"{path.name} lacks {sorted(set(wanted) - contents)}"
    assert all(line == "" or line.startswith(("usr/", "./")) for line in contents), sorted(contents)[:5]
    control = run("dpkg-deb", "--field", path)
    synopsis, body = re.search(r"^Description: (.*)\n((?: .*\n?)+)", control, re.M).groups()
    assert synopsis not in synopses, f"{name} has the synopsis of another package: {synopsis}"
    synopses.add(synopsis)
    assert all(re.match(r" \S", line) for line in body.splitlines()), body
    if name != "librimline-dev":
        assert re.search(r"^Depends: .*libc6", control, re.M), control

# Each package that the CMake package looks for comes with one that the development package depends on.
config = (build / "RimlineConfig.cmake").read_text()
debian_name = {"Threads": None, "glm": "libglm-dev", "JPEG": "libjpeg62-turbo-dev", "PNG": "libpng-dev", "hwy": "libhwy-dev",
               "TBB": "libtbb-dev", "tinyobjloader": "libtinyobjloader-dev", "Vulkan": "libvulkan-dev"}
depends = run("dpkg-deb", "--field", packages["librimline-dev"], "Depends")
for name in re.findall(r"^ *find_(?:dependency|package)\((\w+)", config, re.M):
    assert debian_name[name] is None or debian_name[name] in depends, f"librimline-dev needs {name}: {depends}"

if shutil.which("lintian"):
    # The changelog closes no bug of Debian: Rimline is not in it.
    found = subprocess.run(["lintian", "--allow-root", "--fail-on", "error", *map(str, packages.values())],
                           capture_output=True, text=True)
    errors = [line for line in found.stdout.splitlines() if line.startswith("E: ")]
    assert not errors, "\n".join(errors)
    print("lintian: no error,", found.stdout.count("W: "), "warnings")

root = scratch / "root"
for folder in ("info", "updates", "triggers"):
    (root / "var/lib/dpkg" / folder).mkdir(parents=True)
for file in ("status", "available"):
    (root / "var/lib/dpkg" / file).touch()
before = files_in(root)
# The packages that these depend on are the machine's own.
dpkg = ("dpkg", f"--root={root}", "--force-not-root", "--force-depends", "--force-script-chrootless", "--force-bad-path",
        "--log=/dev/null")
run(*dpkg, "--install", *packages.values())

environment = {**os.environ, "PATH": f"{root}/usr/bin:{os.environ['PATH']}", "LD_LIBRARY_PATH": f"{root}/usr/lib"}
assert run("rimline", "--version", env=environment).strip()
run("rimline", "silhouette", "shape:knot", "--from", "3,2,1", "--json", env=environment, cwd=scratch)
assert "rimline" in run("man", "-l", root / "usr/share/man/man1/rimline.1.gz") if shutil.which("man") else True
if "python3-rimline" in packages:
    code = "import rimline; print(len(rimline.load('shape:box').silhouette((3, 2, 1))), rimline.__file__)"
    told = run(python, "-B", "-c", code, env={**environment,
                                              "PYTHONPATH": f"{root}/usr/lib/python3/dist-packages"})
    assert told.startswith("6 ") and str(root) in told, told
if "librimline1" in packages:
    source = pathlib.Path(__file__).resolve().parents[2] / "tools/samples/silhouette.c"
    run("cc", f"-I{root}/usr/include", source, f"-L{root}/usr/lib", "-lrimline", "-lm", "-o", scratch / "sample")
    run(scratch / "sample", "shape:knot:2000", scratch / "knot.svg", env=environment)
share = root / "usr/share"
if shutil.which("desktop-file-validate"):
    for entry in share.glob("applications/*.desktop"):
        told = run("desktop-file-validate", entry)
        assert told == "", told
if shutil.which("appstreamcli"):
    for entry in share.glob("metainfo/*.xml"):
        run("appstreamcli", "validate", "--no-net", entry)

run(*dpkg, "--remove", *packages)
left = {file for file in files_in(root) - before if not file.startswith("var/lib/dpkg/")}
assert not left, sorted(left)[:10]
print("installed, run and removed")
