#pragma once

// Runs a check once for every instruction set that this machine has and the index was compiled for.

#include <hwy/targets.h>

#include <cstdint>
#include <set>
#include <string>

#include "silhouette/hough/hough_octree.h"

namespace rimline::tests {

/// Calls check(name) with each in use; afterwards the best is again.
template <typename Check>
void for_each_instruction_set(Check&& check) {
    struct Restore {
        ~Restore() { hwy::GetChosenTarget().Update(hwy::SupportedTargets()); }
    } restore;
    std::set<std::string> seen;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        hwy::GetChosenTarget().Update(left & -left);
        const std::string name(HoughOctree::instruction_set());
        if (seen.insert(name).second) check(name);
    }
}

}  // namespace rimline::tests
