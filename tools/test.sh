#!/usr/bin/env bash
# Every test but the long proof, from nothing: installs what is missing (Debian's apt), builds with warnings as errors,
# runs the tests, and ends with ctest's summary. Tests that need models look for them in the folders
# of RIMLINE_MODELS and are skipped without.
set -u
source "$(dirname "$0")/steps.sh"

tools/install_packages.sh tests || exit 1
step "see CMake's message above; remove build/release if it is from another machine or compiler" \
    cmake --preset release -DRIMLINE_ENGINE=ON -DRIMLINE_TOOLS=ON -DRIMLINE_TESTS=ON \
    -DRIMLINE_WERROR=ON
step "fix what the compiler says above, and run this again" cmake --build --preset release
# The proof of millions of silhouettes takes minutes more: ctest --preset release -L long.
step "to see one alone: ctest --preset release -R 'ITS NAME' -V" \
    ctest --preset release -LE '^long$'
