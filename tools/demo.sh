#!/usr/bin/env bash
# The first picture, from nothing: installs missing packages (Debian's apt), builds, and draws the built-in
# scene into rimline.png. A second run builds only what changed, and needs no network.
set -u
source "$(dirname "$0")/steps.sh"

tools/install_packages.sh demo || exit 1

# An existing build folder keeps its tests. A new one is built without tests and without the packages that
# they need.
options=(-DRIMLINE_ENGINE=ON -DRIMLINE_TOOLS=ON)
[ -f build/release/build.ninja ] || options+=(-DRIMLINE_TESTS=OFF)
step "see CMake's message above; remove build/release if it is from another machine or compiler" \
    cmake --preset release "${options[@]}"
step "the compiler's message above says where; on Debian 12 with an unchanged tree please report it" \
    cmake --build --preset release --target rimline

step "build/release/rimline devices lists the Vulkan devices of this machine" \
    build/release/rimline render -o rimline.png
echo "$script_name: the picture is $PWD/rimline.png"
