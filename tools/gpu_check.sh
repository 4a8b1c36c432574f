#!/usr/bin/env bash
# One command for a machine with a GPU: builds if needed, runs the tests that need a Vulkan device on one
# device, and measures what a frame's time depends on there (`rimline bench frames`). The table is the last
# thing printed, under the names of the device and its driver.
#
#   tools/gpu_check.sh [--device DEVICE] [--quick] [--gpu-assisted] [--no-tests]
#
#   --device DEVICE  gpu, cpu, an index or a part of a name. Without it, RIMLINE_DEVICE, or the default device.
#   --quick          small pictures and meshes; the default of devices of the CPU type
#   --gpu-assisted   runs the tests once more with the validation layer's checks on the GPU. Slow. Layers older
#                    than 1.3.261 report reads of the last vec3 of a buffer that are none (its issue 4577).
#   --no-tests       measures only
set -u
source "$(dirname "$0")/steps.sh"

usage() { sed -n '/^#   tools/,/^set/{/^#/s/^# \{0,3\}//p}' "$script_name"; }

quick=() gpu_assisted= tests=1
while [ $# -gt 0 ]; do
    case $1 in
        --device) [ $# -gt 1 ] || stop "--device needs a device: see $script_name --help"
                  export RIMLINE_DEVICE=$2
                  shift ;;
        --quick) quick=(--quick) ;;
        --gpu-assisted) gpu_assisted=1 ;;
        --no-tests) tests= ;;
        --help) usage
                exit 0 ;;
        *) stop "not expected: $1: see $script_name --help" ;;
    esac
    shift
done

rimline=build/release/rimline
options=(-DRIMLINE_ENGINE=ON -DRIMLINE_TOOLS=ON)
[ -z "$tests" ] || options+=(-DRIMLINE_TESTS=ON)
if [ -n "$tests" ] || [ ! -x $rimline ]; then
    step "tools/install_packages.sh tests installs what is missing" \
        cmake --preset release "${options[@]}" >&2
    step "fix what the compiler says above, and run this again" cmake --build --preset release >&2
fi

# Before minutes of tests: an unknown device is an error that lists all.
"$rimline" devices || exit 1

failed=
if [ -n "$tests" ]; then
    ctest --preset release -L '^device$' -LE '^long$' || failed="tests failed: see above"
    if [ -n "$gpu_assisted" ]; then
        # The other checks have run. lavapipe optimizes shaders with checks for minutes.
        GALLIVM_PERF=no_opt VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT \
            VK_LAYER_DISABLES=VK_VALIDATION_FEATURE_DISABLE_CORE_CHECKS_EXT \
            ctest --preset release -L '^device$' -LE '^long$' ||
            failed="${failed:+$failed; }tests failed with checks on the GPU: see above"
    fi
fi

echo
"$rimline" bench frames "${quick[@]}" || failed="${failed:+$failed; }not all was measured: see above"
[ -z "$failed" ] || stop "$failed"
