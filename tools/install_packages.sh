#!/usr/bin/env bash
# Installs the Debian packages that Rimline needs and this machine lacks, and names them first. Where none is
# missing it needs neither root nor a network.
#
#   tools/install_packages.sh cpu         to build the CPU library and its commands (RIMLINE_ENGINE=OFF)
#   tools/install_packages.sh cpu-tests   to build and run their tests too
#   tools/install_packages.sh demo        to build and run everything but the tests
#   tools/install_packages.sh packages    to make Debian packages of it too
#   tools/install_packages.sh tests       to build and run everything
#   tools/install_packages.sh fuzz        to build and run the fuzz targets
#   tools/install_packages.sh cluster     to run the tests of Slurm and Dask too
#   tools/install_packages.sh web         to build and test the package for browsers too
set -u
source "$(dirname "$0")/steps.sh"

# Debian 12 names.
cpu=(g++ cmake ninja-build libglm-dev libtinyobjloader-dev libstb-dev nlohmann-json3-dev
    libpng-dev libjpeg62-turbo-dev libcli11-dev libhwy-dev libtbb-dev libnanoflann-dev)
engine=(libvulkan-dev mesa-vulkan-drivers glslang-tools libglfw3-dev libimgui-dev
    fonts-dejavu-core libmeshoptimizer-dev libqhull-dev)
python=(pybind11-dev python3-dev python3-numpy)
packages=(dpkg-dev file "${python[@]}")
site=(doxygen python3-sphinx python3-myst-parser furo python3-breathe)
cpu_tests=(ccache doctest-dev libgmp-dev python3 librsvg2-bin poppler-utils python3-ezdxf
    zsh fish)
engine_tests=("${packages[@]}" libembree-dev libvulkan-volk-dev vulkan-validationlayers spirv-tools xvfb
    python3-pytest python3-pip python3-setuptools python3-wheel mypy "${site[@]}")
fuzz=(clang-16 libclang-rt-16-dev python3)
web=(emscripten nodejs chromium)
cluster=(slurm-wlm munge procps util-linux python3 python3-distributed)

case "${1:-}" in
    cpu) wanted=("${cpu[@]}") ;;
    cpu-tests) wanted=("${cpu[@]}" "${cpu_tests[@]}") ;;
    demo) wanted=("${cpu[@]}" "${engine[@]}") ;;
    packages) wanted=("${cpu[@]}" "${engine[@]}" "${packages[@]}") ;;
    tests) wanted=("${cpu[@]}" "${engine[@]}" "${cpu_tests[@]}" "${engine_tests[@]}") ;;
    fuzz) wanted=("${cpu[@]}" "${fuzz[@]}") ;;
    cluster) wanted=("${cluster[@]}") ;;
    web)
        wanted=("${cpu[@]}" "${web[@]}")
        command -v npm >/dev/null || wanted+=(npm)  # Other nodejs packages than Debian's contain it.
        ;;
    *) stop "usage: $script_name cpu|cpu-tests|demo|packages|tests|fuzz|cluster|web" ;;
esac

command -v apt-get >/dev/null && command -v dpkg-query >/dev/null ||
    stop "no apt here: install your system's packages for: ${wanted[*]}; then build as README.md says"

missing=()
for package in "${wanted[@]}"; do
    # dpkg-query prints one line for each architecture.
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
        missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
        stop "missing packages and no sudo: as root, run: apt-get install ${missing[*]}"
    as_root=(sudo)
fi

log=build/install_packages.log
echo "$script_name: installing with apt: ${missing[*]} (log: $log)"
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"; }

# One unreachable third-party source fails the whole update. The installation reports missing packages.
apt update >"$log" 2>&1 || echo "$script_name: apt-get update reported errors; going on"
apt install --yes --no-install-recommends "${missing[@]}" >>"$log" 2>&1 ||
    stop "apt-get install failed: read the end of $log, connect to the network or free apt, run this again"
