#pragma once

// Skipping: a case that needs something which this machine lacks names it, and counts as skipped, not as passed.

#include <cstdio>
#include <string>

namespace rimline::tests {

/// Whether a case of this program was skipped. test_main.cpp turns it into the exit status.
inline bool case_skipped = false;

/// The exit status by which CTest knows a skipped case.
constexpr int k_skipped_status = 77;

}  // namespace rimline::tests

/// Ends the running test case as skipped. Checks that failed before still count. `reason` names what is
/// missing.
#define RIMLINE_SKIP(reason)                                       \
    do {                                                           \
        std::printf("SKIPPED: %s\n", std::string(reason).c_str()); \
        std::fflush(stdout);                                       \
        rimline::tests::case_skipped = true;                       \
        return;                                                    \
    } while (false)
