#include "tools/bench/python_script.h"

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <stop_token>
#include <string>
#include <thread>

#include "silhouette/error.h"
#include "tests/tools/scratch_folder.h"

using namespace rimline;
using namespace rimline::tools;
using rimline::tests::ScratchFolder;

TEST_CASE("a script reads what was added and its print is what comes back") {
    ScriptInput input;
    input.add(std::array<std::uint64_t, 2>{3, 5'000'000'000});
    input.add(std::array<float, 1>{0.5f});
    REQUIRE(input.is_complete());
    const auto text = run_python(
        "import struct, sys\nprint(struct.unpack('<QQf', sys.stdin.buffer.read()), end='')", input,
        {});
    REQUIRE(text);
    CHECK(*text == "(3, 5000000000, 0.5)");
}

TEST_CASE("a script that fails has no output whatever it has printed") {
    ScriptInput input;
    REQUIRE(input.is_complete());
    CHECK_FALSE(run_python("import sys\nprint('half')\nsys.exit(77)", input, {}));
}

TEST_CASE("a program reads its input from the beginning, and one that fails gives nothing") {
    ScriptInput input;
    input.add(std::string("text"));
    REQUIRE(input.is_complete());
    const Context quiet{.json = false, .stop = {}};
    for (int time = 0; time < 2; ++time)
        CHECK(run_program(std::array{"cat"}, input, quiet) == "text");
    CHECK_FALSE(run_program(std::array{"sh", "-c", "cat; exit 1"}, input, quiet).has_value());
    CHECK_FALSE(run_program(std::array{"rimline-no-such-program"}, input, quiet).has_value());
}

// Runs what makes the file, and cancels it then.
void cancel_when_made(const std::filesystem::path& made, const std::string& script) {
    std::stop_source stop;
    const std::jthread canceller([&](const std::stop_token& done) {
        while (!std::filesystem::exists(made) && !done.stop_requested()) std::this_thread::yield();
        stop.request_stop();
    });
    ScriptInput input;
    REQUIRE(input.is_complete());
    CHECK_THROWS_AS(run_python(script.c_str(), input, {.json = false, .stop = stop.get_token()}),
                    Error);
}

TEST_CASE("a cancelled script is ended and clears away what it made") {
    const ScratchFolder folder;
    const std::filesystem::path made = folder / "made";
    cancel_when_made(made, "import os, signal, sys, time\npath = '" + made.string() +
                               "'\n"
                               "signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))\n"
                               "try:\n    open(path, 'w').close()\n    time.sleep(600)\n"
                               "finally:\n    os.remove(path)\n");
    CHECK_FALSE(std::filesystem::exists(made));
}

TEST_CASE("a script that ignores the signal is ended nevertheless") {
    const ScratchFolder folder;
    const std::filesystem::path made = folder / "made";
    cancel_when_made(made,
                     "import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\nopen('" +
                         made.string() + "', 'w').close()\ntime.sleep(600)\n");
}
