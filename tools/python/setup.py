"""pip install ./tools/python: builds the extension module by CMake from the sources that this folder belongs to.

Needs the packages of tools/install_packages.sh packages; no network. RIMLINE_BUILD_DIR names
a build folder that is configured with -DRIMLINE_PYTHON=ON for the same Python, to use it instead of a new one.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROJECT = ROOT / "CMakeLists.txt"
if not PROJECT.is_file():
    sys.exit("rimline: tools/python builds only in its place in the sources of Rimline")


# Nothing is written beside the sources.
SCRATCH = ROOT / "build" / "pip"
SCRATCH.mkdir(parents=True, exist_ok=True)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = os.environ.get("RIMLINE_BUILD_DIR")
        if not build:
            build = str(pathlib.Path(self.build_temp).resolve() / "cmake")
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            options = {
                "CMAKE_BUILD_TYPE": "RelWithDebInfo",
                "CMAKE_MODULE_LINKER_FLAGS": "-s",
                "CMAKE_UNITY_BUILD": "ON",
                "CMAKE_UNITY_BUILD_BATCH_SIZE": "12",
                "RIMLINE_PYTHON": "ON",
                "RIMLINE_PYTHON_EXECUTABLE": sys.executable,
                "RIMLINE_INSTALL": "OFF",
                "RIMLINE_METHODS": "OFF",
                "RIMLINE_TESTS": "OFF",
                "RIMLINE_VIEW": "OFF",
            }
            defined = [f"-D{name}={value}" for name, value in options.items()]
            subprocess.run(["cmake", "-S", str(ROOT), "-B", build, *generator, *defined], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "rimline_python", "--parallel"], check=True)
        built = list((pathlib.Path(build) / "python" / "rimline").glob("_rimline.*.so"))
        if len(built) != 1:
            sys.exit(f"rimline: expected one extension module in {build}, found {len(built)}")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built[0], target)


setup(
    name="rimline",
    version=re.search(r"project\(Rimline VERSION ([0-9.]+)", PROJECT.read_text()).group(1),
    description="Silhouettes of meshes and point clouds: found, kept up to date, drawn",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy>=1.20"],
    extras_require={"progress": ["tqdm"], "vtk": ["vtk"]},
    packages=["rimline"],
    package_dir={"rimline": "rimline"},
    package_data={"rimline": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("rimline._rimline", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
    options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}},
)
