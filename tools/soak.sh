#!/usr/bin/env bash
# Runs Rimline for MINUTES: moves of a tracker, frames under 24 lights, and windows that open, get a file, change
# their size and close. Builds first if needed. Fails where memory grows by more than a hundredth after the first
# tenth of the time, a descriptor, thread or Vulkan object is left, or one step in a thousand takes longer than four
# medians (tests/soak/soak_record.h).
#
#   tools/soak.sh [MINUTES]     5 without a number
set -u
source "$(dirname "$0")/steps.sh"

minutes=${1:-5}
case $minutes in
    --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$script_name"
            exit 0 ;;
    *[!0-9.]* | "" | .) stop "not a number of minutes: $minutes; see $script_name --help" ;;
esac

step "tools/install_packages.sh tests installs what is missing" \
    cmake --preset release -DRIMLINE_ENGINE=ON -DRIMLINE_TOOLS=ON -DRIMLINE_TESTS=ON
step "fix what the compiler says above, and run this again" cmake --build --preset release --target soak
build/release/tests/soak/soak "$minutes"
