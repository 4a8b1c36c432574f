#include "tools/process/interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <thread>

namespace rimline::tools {

namespace {

// SIGXCPU is of a limit (ulimit -t), as SIGXFSZ is.
constexpr std::array k_ending_signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ, SIGXCPU};

std::atomic<int> g_signal_received{0};
std::atomic_bool g_has_words{true};
std::atomic_flag g_is_ending = ATOMIC_FLAG_INIT;

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
void write_error(std::string_view text) {
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, text.data(), text.size());
}

// One of two threads that end the program prints the line.
void end_by(int signal_number) {
    while (g_is_ending.test_and_set()) pause();
    if (isatty(STDERR_FILENO) == 1) write_error("\r\033[K");  // Erases a line of progress.
    if (g_has_words) write_error("rimline: error: cancelled\n");
    raise_unblocked(signal_number);
}

}  // namespace

std::stop_token stop_on_interrupt(void (*clean_up)() noexcept) {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal_number : k_ending_signals)
        if (!is_ignored(signal_number)) sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);

    // A thread that waits, rather than a handler: requesting a stop is not async-signal-safe.
    std::stop_source source;
    try {
        std::thread([signals, source, clean_up]() mutable {
            int received = 0;
            if (sigwait(&signals, &received) != 0) return;
            g_signal_received = received;
            source.request_stop();
            std::this_thread::sleep_for(k_grace);
            clean_up();
            end_by(received);
        }).detach();
    } catch (const std::system_error&) {
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
        return {};
    }
    return source.get_token();
}

void end_without_words() noexcept { g_has_words = false; }

void end_as_interrupted() {
    const int received = g_signal_received;
    if (received == 0) return;
    std::fflush(nullptr);
    end_by(received);
}

void end_as_write_failed() {
    // The system sends them to the thread that writes, which blocks them.
    sigset_t pending;
    sigemptyset(&pending);
    sigpending(&pending);
    for (const int signal_number : {SIGPIPE, SIGXFSZ})
        if (sigismember(&pending, signal_number) == 1) raise_unblocked(signal_number);
}

}  // namespace rimline::tools
