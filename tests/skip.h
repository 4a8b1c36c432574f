#pragma once

// A test that needs what this machine lacks says so and is counted as skipped, not as passed.

#include <cstdio>
#include <string>

/// Ends the running test case as skipped. `reason` names what is missing.
#define RIMLINE_SKIP(reason)                                         \
    do {                                                             \
        std::printf("SKIPPED: %s\n", std::string(reason).c_str());   \
        std::fflush(stdout);                                         \
        return;                                                      \
    } while (false)
