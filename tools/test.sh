#!/usr/bin/env bash
# All tests but those of minutes, from nothing: installs missing packages (Debian's apt), builds with warnings
# as errors, fetches freely packaged meshes, runs the tests, and says in one line what was skipped and why.
# Tests look for models in the folders of RIMLINE_MODELS, then in build/meshes, and are skipped where there
# are none.
set -u
source "$(dirname "$0")/steps.sh"

# skipped LOG: one line for all "SKIPPED: reason" lines in a log of ctest, with the tests for each reason.
skipped() {
    awk -v script="$script_name" '
        /^[0-9]+\/[0-9]+ Testing: / { delete seen; counted = 0 }
        sub(/^SKIPPED: /, "") {
            if (!counted++) ++tests
            if (seen[$0]++) next
            if (!count[$0]++) reasons[++last] = $0
        }
        END {
            for (i = 1; i <= last; ++i) line = line (i > 1 ? "; " : "") reasons[i] " (" count[reasons[i]] ")"
            if (tests) printf "%s: %d tests were skipped in whole or in part: %s\n", script, tests, line
            else printf "%s: no test was skipped\n", script
        }' "$1"
}

tools/install_packages.sh tests || exit 1
step "see CMake's message above; remove build/release if it is from another machine or compiler" \
    cmake --preset release -DRIMLINE_ENGINE=ON -DRIMLINE_TOOLS=ON -DRIMLINE_TESTS=ON \
    -DRIMLINE_C=ON -DRIMLINE_PYTHON=ON -DRIMLINE_WERROR=ON
step "fix what the compiler says above, and run this again" cmake --build --preset release

# The network may be missing or slow: the tests go on without the meshes.
timeout 300 tools/fetch_meshes.sh ||
    echo "$script_name: going on without build/meshes: tests that need them are skipped"
[ ! -d build/meshes ] || export RIMLINE_MODELS=${RIMLINE_MODELS:+$RIMLINE_MODELS:}$PWD/build/meshes

# Those of minutes, which compare millions of silhouettes: ctest --preset release -L '^long$'.
log=build/release/Testing/Temporary/LastTest.log
tests() {
    ctest --preset release -LE '^long$'
    local status=$?
    [ ! -f $log ] || skipped $log
    return $status
}
rm -f $log
step "to see one alone: ctest --preset release -R 'ITS NAME' -V" tests
