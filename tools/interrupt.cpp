#include "tools/interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <thread>

namespace rimline::tools {

namespace {

std::atomic<int> g_signal_received{0};

bool is_ignored(int signal_number) {
    struct sigaction action {};
    return sigaction(signal_number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

std::stop_token stop_on_interrupt() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal_number : {SIGINT, SIGTERM})
        if (!is_ignored(signal_number)) sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);

    // A thread that waits, rather than a handler: requesting a stop is not async-signal-safe.
    std::stop_source source;
    std::thread([signals, source]() mutable {
        int received = 0;
        if (sigwait(&signals, &received) != 0) return;
        g_signal_received = received;
        source.request_stop();
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
        for (;;) pause();
    }).detach();
    return source.get_token();
}

void end_as_interrupted() {
    const int received = g_signal_received;
    if (received == 0) return;
    std::fflush(nullptr);
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, received);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    raise(received);
}

}  // namespace rimline::tools
