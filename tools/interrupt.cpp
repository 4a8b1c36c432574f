#include "tools/interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <thread>

namespace rimline::tools {

namespace {

std::atomic<int> g_signal_received{0};

bool is_ignored(int signal_number) {
    struct sigaction action {};
    return sigaction(signal_number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void raise_unblocked(int signal_number) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    raise(signal_number);
}

// Does not use stdio: a thread that hangs in a write may hold its locks.
void write_line(std::string_view line) {
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace

std::stop_token stop_on_interrupt(void (*clean_up)() noexcept) {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal_number : {SIGINT, SIGTERM})
        if (!is_ignored(signal_number)) sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);

    // A thread that waits, rather than a handler: requesting a stop is not async-signal-safe.
    std::stop_source source;
    std::thread([signals, source, clean_up]() mutable {
        int received = 0;
        if (sigwait(&signals, &received) != 0) return;
        g_signal_received = received;
        source.request_stop();
        const timespec grace{k_grace_seconds, 0};
        int second = 0;
        do second = sigtimedwait(&signals, nullptr, &grace);
        while (second < 0 && errno == EINTR);
        clean_up();
        if (second < 0) write_line("rimline: error: cancelled\n");
        raise_unblocked(second < 0 ? received : second);
    }).detach();
    return source.get_token();
}

void end_as_interrupted() {
    const int received = g_signal_received;
    if (received == 0) return;
    std::fflush(nullptr);
    raise_unblocked(received);
}

}  // namespace rimline::tools
