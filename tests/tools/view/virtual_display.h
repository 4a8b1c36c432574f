#pragma once

// A display without a screen, for tests of windows: Xvfb, started when needed and ended with the object.

#include <sys/types.h>

#include <memory>
#include <string>

namespace rimline::tests {

class VirtualDisplay {
public:
    /// Null where Xvfb is not installed or does not start; `reason` then says why. Sets DISPLAY and
    /// clears WAYLAND_DISPLAY for this process.
    static std::unique_ptr<VirtualDisplay> open(std::string& reason);
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

private:
    explicit VirtualDisplay(pid_t server) noexcept : server_(server) {}

    pid_t server_;
};

}  // namespace rimline::tests
