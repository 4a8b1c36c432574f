#include "tools/process/thread_limit.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

using rimline::tools::allowed_threads;
using rimline::tools::startable_threads;
using rimline::tools::usual_threads;

TEST_CASE("threads are allowed up to a limit of oneTBB") {
    CHECK(allowed_threads() >= 1);
    const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(allowed_threads() == 1);
}

TEST_CASE("as many threads are startable as are wanted where nothing limits them") {
    CHECK(startable_threads(0) == 1);
    CHECK(startable_threads(1) == 1);
    CHECK(startable_threads(5) == 5);
    CHECK(usual_threads() >= 1);
}

TEST_SUITE("plain") {
    TEST_CASE("fewer threads are startable than memory has stacks for") {
        const pid_t child = fork();
        if (child == 0) {
            // The limit is of this process alone.
            const rlimit stack{64u << 20, 64u << 20}, space{2048ul << 20, 2048ul << 20};
            setrlimit(RLIMIT_AS, &space);
            setrlimit(RLIMIT_STACK, &stack);
            const std::uint32_t count = startable_threads(4096);
            _exit(count >= 1 && count < 1000 ? 0 : 1);
        }
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        CHECK(status == 0);
    }
}
