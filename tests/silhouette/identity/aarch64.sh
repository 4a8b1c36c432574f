#!/usr/bin/env bash
# The identity tests on another kind of processor: builds the CPU library and the tests for AArch64, with Debian's
# arm64 packages in a folder of their own, and runs them by qemu-user. Takes a quarter of an hour and needs a network.
# As root once: apt-get install g++-aarch64-linux-gnu qemu-user
#
#   tests/silhouette/identity/aarch64.sh [ARGUMENTS of identity_tests...]
set -eu
cd "$(dirname "$0")/../../.."

folder=$PWD/build/aarch64
root=$folder/root
libraries=$root/usr/lib/aarch64-linux-gnu
packages=(libtbb-dev libtbb12 libtbbmalloc2 libtbbbind-2-5 libhwy-dev libhwy1 libpng-dev libpng16-16 zlib1g-dev zlib1g
    libjpeg62-turbo-dev libjpeg62-turbo libgmp-dev libgmp10 libgmpxx4ldbl libtinyobjloader-dev libtinyobjloader2rc10
    libglm-dev libstb-dev libstb0 nlohmann-json3-dev libnanoflann-dev doctest-dev)

if [ ! -d "$root" ]; then
    mkdir -p "$folder"/apt/lists/partial "$folder"/apt/cache/archives/partial
    : >"$folder"/apt/status
    apt=(-qq -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State::lists="$folder"/apt/lists
        -o Dir::State::status="$folder"/apt/status -o Dir::Cache="$folder"/apt/cache -o APT::Sandbox::User=)
    apt-get "${apt[@]}" update
    (cd "$folder"/apt && apt-get "${apt[@]}" download "${packages[@]}")
    mkdir "$root".part
    for package in "$folder"/apt/*.deb; do dpkg -x "$package" "$root".part; done
    # Debian 12's zlib lies in /lib.
    cp -a "$root".part/lib/. "$root".part/usr/lib/ 2>/dev/null || true
    ln -sfn libz.so.1 "$root".part/usr/lib/aarch64-linux-gnu/libz.so
    mv "$root".part "$root"
fi

cmake -S . -B "$folder"/build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
    -DCMAKE_FIND_ROOT_PATH="$root" -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY \
    -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY \
    -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -DCMAKE_CXX_FLAGS="-isystem $root/usr/include/aarch64-linux-gnu" \
    -DCMAKE_EXE_LINKER_FLAGS="-Wl,-rpath-link,$libraries" \
    -DCMAKE_CROSSCOMPILING_EMULATOR="qemu-aarch64;-L;/usr/aarch64-linux-gnu;-E;LD_LIBRARY_PATH=$libraries" \
    -DRIMLINE_ENGINE=OFF -DRIMLINE_TOOLS=OFF -DRIMLINE_METHODS=OFF -DRIMLINE_INSTALL=OFF -DRIMLINE_TESTS=ON
cmake --build "$folder"/build --target identity_tests
qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$libraries" \
    "$folder"/build/tests/silhouette/identity/identity_tests "$@"
