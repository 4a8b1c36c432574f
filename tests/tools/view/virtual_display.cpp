#include "tests/tools/view/virtual_display.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

namespace rimline::tests {

namespace {

constexpr int k_start_limit_ms = 60'000;

// One line from `descriptor`, without its end; empty when none comes in time.
std::string read_line(int descriptor) {
    std::string line;
    for (;;) {
        pollfd ready{.fd = descriptor, .events = POLLIN, .revents = 0};
        if (poll(&ready, 1, k_start_limit_ms) <= 0) return {};
        char c = 0;
        if (read(descriptor, &c, 1) != 1) return {};
        if (c == '\n') return line;
        line += c;
    }
}

}  // namespace

std::unique_ptr<VirtualDisplay> VirtualDisplay::open(std::string& reason) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        reason = "no pipe to Xvfb";
        return nullptr;
    }
    const std::string write_end = std::to_string(ends[1]);
    const pid_t server = fork();
    if (server == 0) {
        close(ends[0]);
        if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(126);
        // Without -noreset it starts again after each window, and refuses the next one meanwhile.
        execlp("Xvfb", "Xvfb", "-displayfd", write_end.c_str(), "-screen", "0", "1600x1200x24",
               "-nolisten", "tcp", "-noreset", static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[1]);
    const std::string number = server > 0 ? read_line(ends[0]) : "";
    close(ends[0]);
    if (server <= 0 || number.empty()) {
        // Its end is waited for.
        if (server > 0) VirtualDisplay ended(server);
        reason = "Xvfb is not installed or does not start";
        return nullptr;
    }
    setenv("DISPLAY", (":" + number).c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    return std::unique_ptr<VirtualDisplay>(new VirtualDisplay(server));
}

VirtualDisplay::~VirtualDisplay() {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

}  // namespace rimline::tests
