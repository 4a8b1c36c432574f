#include "tools/python/unlocked.h"

#include <cxxabi.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace rimline::python {

namespace {

// Threads that work without the interpreter's lock.
std::atomic<int> g_working = 0;

// Destructors of static objects must not meet the work of other threads.
void wait_for_working_threads() {
    while (g_working > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void take_lock(PyThreadState* state) {
    try {
        PyEval_RestoreThread(state);
    } catch (abi::__forced_unwind&) {
        sleep_until_exit();
    }
}

}  // namespace

Unlocked::Unlocked() noexcept {
    ++g_working;
    state_ = PyEval_SaveThread();
}

Unlocked::~Unlocked() {
    --g_working;
    take_lock(state_);
}

void sleep_until_exit() noexcept {
    for (;;) pause();
}

void bind_unlocked() {
    Py_AtExit(wait_for_working_threads);
    // A child of fork() has none of these threads.
    pthread_atfork(nullptr, nullptr, [] { g_working = 0; });
}

}  // namespace rimline::python
